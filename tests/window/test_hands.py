# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands on the parts in Blender's real window, with the real pointer; hands.py says how.

The pictures stay in out/hands, to be looked at.
"""

import pytest


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("hands.py", "hands")


def test_escape_cancels_soon_and_leaves_nothing(seen):
    assert seen["cancelled after"] < 0.5
    assert seen["cancelled"]["shares"] == {}
    assert seen["cancelled"]["groups"] == []
    assert seen["cancelled"]["objects"] == ["spot"]


def test_dragging_detail_shows_more_parts(seen):
    before, after = seen["decomposed"], seen["dragged"]
    assert after["detail"] > before["detail"]
    assert len(after["shares"]) > len(before["shares"])
    assert after["groups"] == sorted(after["shares"])


def test_a_drag_is_one_step_of_undo(seen):
    assert seen["drag undone"] == seen["decomposed"]


def test_a_click_in_the_list_makes_a_part_active(seen):
    assert seen["active"] > 0  # the first was


def test_a_boundary_follows_the_mouse(seen):
    before, after = seen["drag undone"]["shares"], seen["slid"]["shares"]
    name = list(before)[seen["active"]]
    assert after[name] > before[name]


def test_a_slide_is_one_step_of_undo(seen):
    assert seen["slide undone"]["shares"] == seen["drag undone"]["shares"]
