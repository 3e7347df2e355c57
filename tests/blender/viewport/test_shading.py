# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a viewport shows parts, and that a button makes it show them."""

import sys

import bpy
import pytest
from snapshot import activate


@pytest.fixture
def space():
    """A viewport, set back afterwards."""
    area = next(area for area in bpy.context.window_manager.windows[0].screen.areas if area.type == "VIEW_3D")
    shading = area.spaces.active.shading
    before = shading.type, shading.color_type
    yield area.spaces.active
    shading.type, shading.color_type = before


SEEN = [("SOLID", "VERTEX", True, False, False), ("SOLID", "VERTEX", False, False, True),
        ("SOLID", "MATERIAL", True, False, True), ("SOLID", "MATERIAL", False, True, False),
        ("MATERIAL", "VERTEX", True, False, True), ("MATERIAL", "VERTEX", True, True, False),
        ("WIREFRAME", "MATERIAL", True, False, False)]


@pytest.mark.parametrize(("kind", "color", "colors", "materials", "hidden"), SEEN)
def test_what_a_viewport_does_not_show(package, space, kind, color, colors, materials, hidden):
    space.shading.color_type = color
    space.shading.type = kind
    panel = sys.modules[f"{package}.ui.panel"]
    assert panel.hides_parts(space, colors, materials) == hidden


def test_the_button_shows_the_colors(package, space, obj):
    bpy.ops.reeb_parts.decompose()
    space.shading.type = "MATERIAL"
    panel = sys.modules[f"{package}.ui.panel"]
    assert panel.hides_parts(space, True, False)
    bpy.ops.reeb_parts.show_colors()
    assert not panel.hides_parts(space, True, False)
    bpy.ops.reeb_parts.decompose(colors=False)
    with pytest.raises(RuntimeError, match="no colors"):
        bpy.ops.reeb_parts.show_colors()


def test_clear_leaves_the_view_as_long_as_a_model_has_parts(package, space, obj, make, tree):
    """The colors of all others were gone, and lines led from each node of their graphs to them."""
    other, area = make(tree, "Other"), next(area for area in bpy.context.screen.areas if area.type == "VIEW_3D")
    space.shading.type, space.shading.color_type, space.overlay.show_relationship_lines = "SOLID", "MATERIAL", True
    with bpy.context.temp_override(area=area):
        for each in (obj, other):
            activate(each)
            bpy.ops.reeb_parts.decompose()
        sys.modules[f"{package}.viewport.shading"].show_colors(bpy.context)  # as the panel's button does
        bpy.ops.reeb_parts.clear()
        assert (space.shading.color_type, space.overlay.show_relationship_lines) == ("VERTEX", False)
        activate(obj)
        bpy.ops.reeb_parts.clear()
    assert (space.shading.color_type, space.overlay.show_relationship_lines) == ("MATERIAL", True)


def test_the_button_shows_the_colors_of_a_linked_model(package, space, obj, tmp_path):
    """It was grey: the model cannot be written."""
    bpy.ops.reeb_parts.decompose()
    path, name = str(tmp_path / "library.blend"), obj.name
    bpy.data.libraries.write(path, {obj})
    bpy.data.objects.remove(obj)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = [name]
    bpy.context.scene.collection.objects.link(wanted.objects[0])
    activate(wanted.objects[0])
    space.shading.type = "MATERIAL"
    bpy.ops.reeb_parts.show_colors()
    assert not sys.modules[f"{package}.ui.panel"].hides_parts(space, True, False)


def test_levels_of_multires_are_sculpted_in_colors_of_materials(package, space, obj):
    """Blender shows them without color attributes: the model became black."""
    obj.modifiers.new("Multires", "MULTIRES")
    bpy.ops.object.multires_subdivide(modifier="Multires")
    space.shading.type, space.shading.color_type = "SOLID", "VERTEX"
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.reeb_parts.decompose()
    modes = sys.modules[f"{package}.scene.modes"]
    assert modes.lacks_colors(obj)
    bpy.ops.reeb_parts.show_colors()
    assert space.shading.color_type == "MATERIAL"
    obj.modifiers["Multires"].sculpt_levels = 0
    assert not modes.lacks_colors(obj)
    bpy.ops.reeb_parts.show_colors()
    assert space.shading.color_type == "VERTEX"
    bpy.ops.object.mode_set(mode="OBJECT")


def test_materials_are_shown_while_levels_of_multires_are_sculpted(space, obj):
    """Decomposed in Object Mode, the model was black in Sculpt Mode, and black again with a material for each part."""
    obj.modifiers.new("Multires", "MULTIRES")
    bpy.ops.object.multires_subdivide(modifier="Multires")
    space.shading.type, space.shading.color_type = "SOLID", "VERTEX"
    bpy.ops.reeb_parts.decompose()
    area = next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")
    with bpy.context.temp_override(area=area):
        bpy.ops.reeb_parts.materials()
        assert space.shading.color_type == "VERTEX"
        bpy.ops.object.mode_set(mode="SCULPT")
        bpy.ops.reeb_parts.materials()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert space.shading.color_type == "MATERIAL"


def test_once_all_pieces_are_deleted_the_colors_of_the_parts_are_seen_again(space, obj):
    """The model was grey, as the viewport went on showing the colors of objects."""
    area = next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")
    with bpy.context.temp_override(area=area):
        bpy.ops.reeb_parts.decompose()
        bpy.ops.reeb_parts.show_colors()
        bpy.ops.reeb_parts.separate()
    pieces = list(bpy.context.selected_objects)
    assert len(pieces) > 2
    for left, piece in enumerate(pieces, 1 - len(pieces)):
        assert space.shading.color_type == "OBJECT"
        bpy.data.objects.remove(piece)
        bpy.context.view_layer.update()
        assert space.shading.color_type == ("VERTEX" if left == 0 else "OBJECT")
