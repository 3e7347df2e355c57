# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands on the parts in Blender's real window, with the real pointer; hands.py says how.

The pictures stay in out/hands, to be looked at.
"""

import pytest


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("hands.py", "hands", size="1280x1000")


def test_escape_cancels_and_leaves_nothing(seen):
    """How soon is in test_fluid.py."""
    assert seen["goes on"] is False
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


def test_the_view_is_turned_while_a_boundary_is_slid(seen):
    slid, turned, nearer, further = seen["slide"]
    assert slid[0] == turned[0] == nearer[0] < further[0]
    assert slid[1] != turned[1] != nearer[1] == further[1]
    assert slid[2] == turned[2] > nearer[2] == further[2]


def test_a_slide_is_one_step_of_undo(seen):
    assert seen["slide undone"]["shares"] == seen["drag undone"]["shares"]


def test_a_number_of_parts_is_typed(seen):
    assert len(seen["typed"]["shares"]) == 4


def test_the_faces_follow_the_colour_chosen_in_the_popup(seen):
    assert seen["color"] == [1.0, 0.0, 1.0]
    assert seen["recolored"] == [[1.0, 0.0, 1.0, 1.0]]
    assert seen["recolored parts"] == [2]


def test_a_double_click_renames(seen):
    assert "Leg" in seen["renamed"]
    assert "Part 03" not in seen["renamed"]


def test_locks_and_ticks(seen):
    assert seen["locked"] == ["Part 02"]
    assert seen["ticked"] == ["Part 04", "Part 06"]


def test_ticks_by_drawing_the_pointer_over_the_boxes(seen):
    assert seen["swept"] == seen["swept over"]


def test_a_double_click_beside_the_name_looks_at_the_part_from_near(seen):
    framed = seen["framed"]
    assert framed["active"] == 4
    assert framed["nearer"] > 1.5
    assert framed["off"] < 0.3
    assert framed["names"] == seen["decomposed"]["groups"]


def test_parts_are_merged_from_the_menu_of_the_list(seen):
    before, after = seen["decomposed"]["shares"], seen["merged"]
    assert len(after) == len(before) - 1
    assert after["Part 04"] == pytest.approx(before["Part 06"] + before["Part 04"], abs=2e-4)


def test_the_explode_slider_leaves_nothing_at_zero(seen):
    assert len(seen["exploded"]) == 1
    assert seen["together"] == []


def test_the_graph_goes_with_the_exploded_parts(seen):
    assert seen["nodes apart"] == 1.0
    assert seen["nodes together"] == []


def test_the_graph_hides_and_shows_at_once(seen):
    assert seen["graph"] == [True, False, True]


def test_another_palette_recolours_at_once(seen):
    palette, changed = seen["palette"]
    assert palette == "Pastel"
    assert changed


@pytest.mark.parametrize("scene", ["numbered", "recolored", "renamed", "locked", "swept", "framed", "merged_by_menu",
                                   "exploded", "graph_hidden", "palette_chosen"])
def test_undo_takes_it_back(seen, scene):
    assert seen[f"{scene}, undone"] == []


def test_a_fast_stroke_has_no_gaps(seen):
    assert seen["fast stroke"] == 1


def test_in_sculpt_mode_each_change_is_one_step_of_undo(seen):
    states = seen["sculpted"]
    assert len({str(state) for state in states}) == 4
    assert {mode for mode, _ in states} == {"SCULPT"}
    assert seen["sculpted, ctrl+z"] == states[-2::-1]
    assert seen["sculpted, ctrl+shift+z"] == states[1:]
