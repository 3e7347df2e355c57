# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed extension in Blender's real window, used with the real pointer; driver.py says how.

The pictures stay in out/window, to be looked at.
"""

from pathlib import Path

import pytest

OUT = Path(__file__).resolve().parents[2] / "out" / "window"


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("driver.py", "window", smooth=True)


def test_the_tab_opens(seen):
    assert seen["tab"] == "Reeb Parts"


def test_a_click_on_decompose_writes_the_parts_and_the_graph(seen):
    before, after = seen["before"], seen["after"]
    assert before["parts"] == []
    assert after["parts"] == list(range(1, len(after["groups"]) + 1))
    assert len(after["groups"]) > 1
    assert after["active_color"] == "Reeb Parts"
    assert set(after["collections"]) - set(before["collections"]) == {"Reeb Graph spot"}
    assert (after["vertices"], after["faces"]) == (before["vertices"], before["faces"])


def test_undo_takes_all_of_it_back(seen):
    assert seen["undone"] == seen["before"]


def test_redo_brings_all_of_it_again(seen):
    assert seen["redone"] == seen["after"]


def test_separate_can_be_adjusted_once_a_piece_is_active(seen):
    assert len(seen["separated"]) == len(seen["after"]["parts"])
    assert seen["separated"] == dict.fromkeys(seen["separated"], False)
    assert seen["adjusted"] == dict.fromkeys(seen["separated"], True)


def test_separate_again_is_refused_in_a_sentence(seen):
    """As what was done last it can be pressed whatever is active, so that it can be adjusted; it showed a traceback."""
    assert seen["separated nothing"] == ["Error: Decompose the mesh first"]


def test_what_is_adjusted_is_as_if_it_were_done_once(seen):
    assert seen["hulls"]
    assert seen["hulls again"] == seen["hulls"]


def test_what_is_adjusted_in_edit_mode_is_the_part_that_was_chosen_there(seen):
    """Undo took back the choice as well, and another part was renamed."""
    assert seen["names"].index("Two") == 2
    assert seen["chosen"] == [2, [False, True, False]]


def test_pictures_are_left(seen):
    assert [path.name for path in sorted(OUT.glob("*.png"))] == [
        "1_tab.png", "2_decomposed.png", "3_undone.png", "4_redone.png", "5_adjusted.png",
    ]
