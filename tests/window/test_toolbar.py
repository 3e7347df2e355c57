# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool of the toolbar, in Blender's real window; toolbar.py says how.

The pictures stay in out/toolbar, to be looked at.
"""

import pytest


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("toolbar.py", "toolbar", seconds=240)


def test_the_button_of_the_sidebar_makes_it_the_active_tool(seen):
    assert seen["tool"] == "reeb_parts.parts"


def test_the_part_under_the_pointer_is_filled_and_named(seen):
    assert seen["hover Part 06"] == "Part 06"
    assert seen["hover Part 01"] == "Part 01"
    assert seen["hover beside"] is None


def test_a_thin_wall_is_filled_once(seen):
    """Its inner side was drawn over the outer one, here and there: triangles of a wheelbarrow made a pattern."""
    assert seen["a thin wall"] == pytest.approx([0.25, 0.25], abs=0.01)


def test_a_click_chooses_a_part_and_shift_adds_another(seen):
    assert seen["clicked"] == ["Part 06", []]
    assert seen["shift-clicked"] == ["Part 03", ["Part 03", "Part 06"]]


def test_a_click_beside_everything_changes_nothing(seen):
    assert seen["clicked beside"] == [seen["shift-clicked"], True]


def test_a_box_chooses_all_parts_that_are_seen_in_it_and_no_others(seen):
    assert seen["box"][1] == seen["seen"]
    assert len(seen["seen"]) < len(seen["merged"]) + 1  # one is behind the others


def test_a_box_is_around_what_is_seen_there_in_a_pose_or_by_a_modifier(seen):
    """It was around the places of the parts without modifiers."""
    assert seen["box where it is seen"] == ["Part 06", []]


def test_m_merges_the_chosen_parts(seen):
    assert "Part 01" not in seen["merged"]
    assert sum(seen["merged"].values()) == pytest.approx(1.0, abs=5e-3)


def test_c_cuts_and_p_paints(seen):
    assert seen["C"] == ["REEB_PARTS_OT_cut"]
    assert seen["ring after C"]  # it waited for the pointer to move
    assert len(seen["cut"]) == len(seen["merged"]) + 2
    assert seen["P"] == ["REEB_PARTS_OT_paint"]
    assert seen["painted"] > seen["before painting"]


def test_g_grows_by_the_wheel_or_a_number_and_the_view_stays(seen):
    assert seen["G"] == [["REEB_PARTS_OT_grow"], 1]
    assert seen["G and the wheel"] == [4, True]
    assert seen["G and a number"] == 10
    before, after = seen["before growing"], seen["grown"]
    assert after["Part 03"] > before["Part 03"]
    changed = {name for name in before if before[name] != after[name]}
    assert changed == {"Part 01", "Part 03"}
    assert seen["G and the wheel back"] == -2


def test_s_slides_the_boundary_that_is_pointed_at_and_no_other(seen):
    before, after = seen["before sliding"], seen["slid"]
    assert {name for name in before if before[name] != after[name]} == {"Part 01", "Part 03"}
    assert after["Part 01"] > before["Part 01"]


def test_f2_renames_the_part_under_the_pointer(seen):
    names, active = seen["renamed"]
    assert "Head" in names
    assert "Part 06" not in names
    assert active == "Head"
    assert seen["name beside the pointer"] == "Head"


def test_h_hides_and_alt_h_shows(seen):
    assert seen["hidden"] == ["Part 06"]
    assert seen["shown again"] == []


def test_the_dot_of_the_numeric_pad_looks_from_near(seen):
    assert seen["framed"]


def test_no_key_moves_or_deletes_the_object(seen):
    assert [seen[f"{key} at work"] for key in ("r", "x", "Delete")] == [[], [], []]
    assert seen["kept"] == []


def test_on_an_object_without_parts_the_keys_are_blenders(seen):
    assert seen["g on a cube"] == ["TRANSFORM_OT_translate"]


def test_a_click_selects_another_object(seen):
    assert seen["to the cube"] == "Cube"


@pytest.mark.parametrize("name", ["clicks undone", "box undone", "box where it is seen undone", "merge undone",
                                  "choice undone", "cut undone", "cut escaped", "paint undone",
                                  "grow undone", "grow escaped", "slide undone", "rename undone", "hiding undone"])
def test_undo_is_exact(seen, name):
    assert seen[name] == []
