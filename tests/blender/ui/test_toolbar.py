# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool of the toolbar: its keys call operators that there are, as they can be called; it comes and goes."""

import sys
from pathlib import Path

import bpy
import pytest


@pytest.fixture
def toolbar(package):
    return sys.modules[f"{package}.ui.toolbar"]


def tools():
    """Ids of the tools of Object Mode."""
    from bl_ui.space_toolsystem_common import ToolSelectPanelHelper

    helper = ToolSelectPanelHelper._tool_class_from_space_type("VIEW_3D")
    return [item.idname for item in helper._tools_flatten(helper._tools["OBJECT"]) if item is not None]


def keymap(toolbar):
    """The keymap that Blender made of the tool's."""
    return bpy.context.window_manager.keyconfigs.addon.keymaps[toolbar.ReebPartsTool._bl_tool.keymap[0]]


def test_the_tool_is_in_the_toolbar_once(toolbar):
    assert tools().count(toolbar.IDNAME) == 1


def test_the_tool_has_an_icon_of_its_own_that_blender_can_read(toolbar):
    """It had that of Box Select, and stood below it as if it were a second one."""
    own = Path(f"{toolbar.ReebPartsTool.bl_icon}.dat")
    blenders = Path(bpy.utils.system_resource("DATAFILES", path="icons"))
    assert own.parent != blenders
    content = own.read_bytes()
    magic, rest = content[:8], content[8:]
    assert magic == (blenders / "ops.generic.select_box.dat").read_bytes()[:8]
    assert len(rest) % 18 == 0  # two bytes for each corner of each triangle, and four for its color
    assert bpy.app.icons.new_triangles_from_file(str(own))


def test_every_key_calls_an_operator_with_properties_that_it_has(toolbar):
    items = list(keymap(toolbar).keymap_items)
    assert len(items) == len(toolbar.KEYMAP)
    for item, (name, event, given) in zip(items, toolbar.KEYMAP, strict=True):
        assert (item.idname, item.type, item.value) == (name, event["type"], event["value"])
        folder, word = name.split(".")
        known = getattr(getattr(bpy.ops, folder), word).get_rna_type().properties
        for key, value in (given or {"properties": []})["properties"]:
            assert key in known
            assert getattr(item.properties, key) == value


def test_no_two_operators_have_one_key(toolbar):
    keys = [(event["type"], *(event.get(held, False) for held in ("shift", "ctrl", "alt")))
            for _, event, _ in toolbar.KEYMAP]
    assert len(set(keys)) == len(keys)


def test_no_single_key_of_blenders_that_changes_objects_is_left(toolbar):
    """G, R and S, X and Delete, M and H: by themselves, Blender moves, deletes or hides the object by them."""
    plain = {event["type"] for _, event, _ in toolbar.KEYMAP if not {"shift", "ctrl", "alt"} & event.keys()}
    assert {"G", "R", "S", "X", "DEL", "M", "H"} <= plain


def test_what_the_status_bar_says_has_a_key(toolbar):
    assert set(toolbar.SHOWN) <= {name for name, _, _ in toolbar.KEYMAP}


def test_without_parts_every_key_is_blenders(toolbar, obj):
    for name, _, _ in toolbar.KEYMAP:
        folder, word = name.split(".")
        assert not getattr(getattr(bpy.ops, folder), word).poll(), name


def test_the_gizmo_is_there_while_there_are_parts_in_object_mode(package, obj):
    group = sys.modules[f"{package}.viewport.hover"].REEB_PARTS_GGT_hover
    assert bpy.types.GizmoGroup.bl_rna_get_subclass_py(group.bl_idname) is group
    assert not group.poll(bpy.context)
    bpy.ops.reeb_parts.decompose(method="berretti")
    assert group.poll(bpy.context)
    bpy.ops.object.mode_set(mode="EDIT")
    assert not group.poll(bpy.context)
    bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT"])
def test_buttons_of_what_needs_object_mode_are_grey_in_others(obj, mode):
    """They could be pressed, and all that happened was that they said so."""
    bpy.ops.reeb_parts.decompose(method="berretti")
    bpy.ops.object.mode_set(mode=mode)
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = {region.type: region for region in area.regions}
    can = {}
    for kind in ("UI", "WINDOW"):  # search, which is over the view, finds them
        with bpy.context.temp_override(window=window, area=area, region=region[kind]):
            can[kind] = {name for name in ("pick", "cut", "slide", "paint", "grow", "shrink")
                         if getattr(bpy.ops.reeb_parts, name).poll()}
    assert can == {"UI": {"grow", "shrink"}, "WINDOW": {"pick", "cut", "slide", "paint", "grow", "shrink"}}


def test_switched_off_nothing_of_it_is_left(toolbar):
    name = toolbar.ReebPartsTool._bl_tool.keymap[0]
    drawn = bpy.types.STATUSBAR_HT_header.draw._draw_funcs
    toolbar.unregister()
    assert toolbar.IDNAME not in tools()
    assert bpy.context.window_manager.keyconfigs.addon.keymaps.get(name) is None
    assert toolbar._draw_keys not in drawn
    toolbar.register()
    assert toolbar._draw_keys in drawn
    assert tools().count(toolbar.IDNAME) == 1
