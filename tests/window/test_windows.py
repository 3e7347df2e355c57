# SPDX-License-Identifier: GPL-3.0-or-later
"""A window is closed in which something is at work, in Blender's real windows; windows.py says how.

The picture stays in out/windows, to be looked at.
"""

import pytest

PHASES = ("computing", "reading", "writing")


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("windows.py", "windows")


@pytest.mark.parametrize("when", PHASES)
def test_decompose_goes_on_in_the_other_window(seen, when):
    """It ended without a word."""
    assert seen[f"at work while {when}"] == [True, "REEB_PARTS_OT_decompose"]
    assert seen[f"windows while {when}"] == 1
    assert seen[f"parts, closed while {when}"] > 1
    assert seen[f"at work after what was closed while {when}"] == []


@pytest.mark.parametrize("when", [*PHASES, "separating"])
def test_it_is_one_step_of_undo(seen, when):
    assert seen[f"undone, closed while {when}"] == []


def test_separate_begins_anew_in_the_other_window(seen):
    assert seen["at work while separating"] == [True, "REEB_PARTS_OT_separate"]
    pieces, parts = seen["pieces"]
    assert pieces == parts


def test_beside_another_scene_it_ends_and_nothing_is_changed(seen):
    """A note says so; see the picture."""
    assert seen["at work beside another scene"] == [True, "REEB_PARTS_OT_decompose"]
    assert seen["windows beside another scene"] == 1
    assert seen["beside another scene"] == []
    assert seen["computing beside another scene"] is False


def test_the_status_bar_is_blenders_again_in_the_workspace_that_was_left(seen):
    """It said for ever how far the computation was when another workspace was shown."""
    assert seen["status bar after another workspace"] is True
