# SPDX-License-Identifier: GPL-3.0-or-later
"""The tools that are used over the model, in Blender's real window; tools.py says how.

The pictures stay in out/tools, to be looked at.
"""

import pytest

TOOLS = ("Pick Parts", "Cut Part", "Paint into", "Slide Boundary")
IDS = {"Pick Parts": "pick", "Cut Part": "cut", "Paint into": "paint", "Slide Boundary": "slide"}


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("tools.py", "tools", seconds=330)


def test_the_menu_of_the_shortcut_does_what_the_panel_says(seen):
    """It executed: all commands ran with their defaults, and tools did not start."""
    assert seen["by menu"] == 0.1
    assert seen["by menu undone"] is False


def test_so_does_a_menu_within_it(seen):
    assert seen["by submenu"] == ["REEB_PARTS_OT_cut"]
    assert seen["by submenu, escaped"] == []


def test_the_graph_is_hidden_with_its_model(seen):
    assert seen["graph after h"] is False
    assert seen["graph after alt+h"] is True


def test_a_click_on_the_model_or_the_graph_picks_a_part(seen):
    assert seen["picked one"] == ["Part 06", []]
    assert seen["picked on an arc"] == ["Part 02", []]


def test_shift_picks_several(seen):
    assert seen["picked two"] == ["Part 03", ["Part 03", "Part 06"]]


def test_several_picks_are_one_thing_to_adjust_and_to_repeat(seen):
    """Only the last one was known."""
    assert seen["picked several"] == ["Part 06", ["Part 02", "Part 03"]]
    assert seen["picked several, adjusted"] == seen["picked several"]
    assert seen["picked several, repeated"] == seen["picked several"]


def test_enter_ends_picking(seen):
    assert seen["after Enter"] == seen["picked on an arc"]


def test_a_click_cuts_a_part(seen):
    assert len(seen["cut"]) == len(seen["before painting"]) + 1  # the cut was taken back before


def test_a_stroke_with_a_larger_brush_gives_faces_to_the_active_part(seen):
    before, after = seen["before painting"], seen["painted"]
    assert after["Part 01"] > before["Part 01"] + 0.02
    assert after["Part 06"] < before["Part 06"]


@pytest.mark.parametrize("name", [
    "pick undone", "several picks undone", "cut undone", "cut redone", "cut undone again", "paint undone",
    "paint redone", "paint undone again", "arc undone", "choice undone", "pick next door undone",
    "cut next door undone", "paint next door undone", "Detail undone", "Detail within Paint into undone",
])
def test_undo_and_redo_are_exact(seen, name):
    assert seen[name] == []


@pytest.mark.parametrize("name", ["cut escaped", "paint escaped", *(f"{tool} escaped at once" for tool in TOOLS),
                                  *(f"{tool} next door escaped" for tool in TOOLS[1:])])
def test_escape_leaves_everything_as_it_was(seen, name):
    assert seen[name] == []


@pytest.mark.parametrize("name", TOOLS)
def test_the_view_is_turned_with_alt_and_a_button(seen, name):
    """Alt and the right button, which zoom in one of Blender's keymaps, ended tools; Paint took the left one."""
    assert seen[f"{name} with Alt"] == [True, [f"REEB_PARTS_OT_{IDS[name]}"]]


def test_a_click_on_a_node_chooses_its_part(seen):
    part, active, clicked = seen["a node"]
    assert part == ["Part 02", []]
    assert active == clicked


def test_a_click_on_an_arc_chooses_its_part_and_the_mesh_is_active_again(seen):
    assert seen["an arc of Part 06"] == [["Part 06", []], "spot"]
    assert seen["an arc of Part 03"] == [["Part 03", []], "spot"]


@pytest.mark.parametrize("tool", TOOLS)
def test_undo_while_a_tool_is_at_work(seen, tool):
    assert seen[f"undo within {tool}"] == []
    assert seen[f"at work after {tool}"] == []


def test_nothing_of_a_stroke_is_left_when_the_detail_changes_under_it(seen):
    more, before = seen["more parts"]
    assert more > before
    assert seen["Detail within Paint into"] == []


def test_picking_goes_on_beside_other_commands_and_without_the_sidebar(seen):
    assert seen["picked after Decompose"] == ["Part 06", []]
    assert seen["picked without the sidebar"] == ["Part 03", []]
    assert seen["at work after Enter"] == []


@pytest.mark.parametrize("name", ["Cut", "Slide", "Paint"])
def test_a_tool_starts_from_its_button(seen, name):
    assert seen[f"button {name}"] == [f"REEB_PARTS_OT_{name.lower()}"]


def test_buttons_of_tools_are_grey_in_edit_mode(seen):
    """They could be pressed, since Blender asked for the view, in which no button is, whether they can."""
    assert seen["pressed in OBJECT"] == [f"REEB_PARTS_OT_{name}" for name in ("cut", "slide", "paint")]
    assert seen["pressed in EDIT"] == []


def test_the_graph_is_seen_with_its_model_in_local_view(seen):
    """It stayed behind, and the eye said that it was shown."""
    assert seen["graph in local view"] == [True, False, True]


def test_the_graph_leaves_the_local_view_with_its_model(seen):
    """Alt and numpad / took the model out, and the graph was seen alone."""
    assert seen["graph in local view without its model"] == []


def test_picking_in_local_view_maximised_and_in_each_of_four_views(seen):
    assert seen["picked in local view"] == ["Part 02", []]
    assert seen["picked while maximised"] == ["Part 06", []]
    found = seen["picked in four views"]
    assert len(found) == 8
    assert [name for name, _ in found] == [name for _, name in found]


def test_what_alt_b_leaves_out_of_the_view_is_not_picked(seen):
    left, right, *found = seen["picked where the view is clipped"]
    assert left != right
    assert found == [left, left]


def test_a_tool_is_carried_into_another_viewport(seen):
    assert {"Part 01", "Part 06"} <= set(seen["seen next door"])
    assert seen["picked next door"] == ["Part 06", ["Part 01", "Part 06"]]
    before, cut, painted = seen["before painting"], seen["cut next door"], seen["painted next door"]
    (new,) = set(cut) - set(before)
    assert cut["Part 06"] + cut[new] == pytest.approx(before["Part 06"], abs=2e-3)
    assert painted["Part 01"] > before["Part 01"]
    assert painted["Part 06"] < before["Part 06"]


def test_what_a_tool_shows_in_another_viewport_is_where_the_pointer_is(seen):
    ring, brush = seen["Cut Part next door"], seen["Paint into next door"]
    assert ring["nearest"] < 0.05 * ring["size"]  # through the pointer
    assert brush["middle"] < 0.05 * brush["size"]  # around it


@pytest.mark.parametrize("tool", TOOLS)
def test_escape_ends_a_tool_in_another_viewport(seen, tool):
    assert seen[f"at work after {tool} next door"] == []


@pytest.mark.parametrize("tool", ["Pick Parts", "Cut Part", "Paint into"])
def test_a_tool_ends_when_its_object_is_deleted(seen, tool):
    assert seen[f"at work before deleting within {tool}"] == [f"REEB_PARTS_OT_{IDS[tool]}"]
    assert seen[f"deleted within {tool}"] == [True, []]


@pytest.mark.parametrize("tool", TOOLS)
def test_deleting_is_undone(seen, tool):
    assert seen[f"at work after deleting within {tool}"] == []
    assert seen[f"deletion within {tool} undone"] == []


def test_nothing_goes_on_when_the_extension_is_switched_off_or_updated(seen):
    """The stroke stayed, and so did the progress: nothing could be decomposed until Blender was started again."""
    assert seen["at work before it is switched off"] == ["REEB_PARTS_OT_decompose", "REEB_PARTS_OT_paint"]
    assert seen["at work when it is switched off"] == []
    assert seen["ready when it is on again"] is True
    assert seen["switched off and on again"] == []
