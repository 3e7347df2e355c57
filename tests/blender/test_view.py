# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen: the graph hidden and shown, parameters that differ from their preset, menus."""

import re
import sys
from pathlib import Path

import bpy
import pytest
from snapshot import activate


@pytest.fixture
def settings(obj):
    bpy.ops.reeb_parts.decompose(method="berretti")
    return bpy.context.scene.reeb_parts


def layer_of(name):
    """The graph's collection in the view layer."""
    return bpy.context.view_layer.layer_collection.children[name]


def graph_facts():
    """All nodes and arcs, by kind and place."""
    nodes = sorted((item["kind"], item["part"], *(round(x, 5) for x in item.location))
                   for item in bpy.data.objects if item.get("reeb_parts_role") == "node")
    (arcs,) = [item for item in bpy.data.objects if item.get("reeb_parts_role") == "arcs"]
    return nodes, [[round(x, 5) for point in spline.points for x in point.co] for spline in arcs.data.splines]


def test_the_graph_is_hidden_and_shown_at_once(obj, settings):
    before = graph_facts()
    settings.graph = False
    assert layer_of("Reeb Graph Tree").hide_viewport
    assert graph_facts() == before
    settings.graph = True
    assert not layer_of("Reeb Graph Tree").hide_viewport
    assert graph_facts() == before


def test_a_graph_that_was_not_asked_for_is_drawn_when_it_is(obj, settings):
    expected = graph_facts()
    bpy.ops.reeb_parts.decompose(method="berretti", graph=False)
    assert "Reeb Graph Tree" not in bpy.data.collections
    settings.graph = False
    settings.graph = True
    assert graph_facts() == expected


def test_the_graph_follows_the_detail_while_it_is_hidden(obj, settings):
    settings.graph = False
    obj.data.reeb_parts.detail = 0.9
    settings.graph = True
    numbers = {part.number for part in obj.data.reeb_parts.parts}
    assert {node[1] for node in graph_facts()[0]} <= numbers


def test_separate_hides_the_graph_with_the_original(obj, settings):
    bpy.ops.reeb_parts.separate()
    assert obj.hide_get()
    assert layer_of("Reeb Graph Tree").hide_viewport
    bpy.ops.reeb_parts.show_original()
    assert not obj.hide_get()
    assert not layer_of("Reeb Graph Tree").hide_viewport
    assert bpy.context.view_layer.objects.active == obj


def test_the_original_comes_back_without_a_graph_that_was_hidden_before(obj, settings):
    settings.graph = False
    bpy.ops.reeb_parts.separate()
    bpy.ops.reeb_parts.show_original()
    assert layer_of("Reeb Graph Tree").hide_viewport


def test_pieces_and_nodes_have_the_colours_of_the_list_in_the_view(obj, settings):
    """Object colours are linear, those of the list are not."""
    bpy.ops.reeb_parts.separate()
    colors = {part.name: part.color[:] for part in obj.data.reeb_parts.parts}
    for name, color in colors.items():
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in color]
        assert bpy.data.objects[name].color[:3] == pytest.approx(linear, abs=1e-5)


def test_parameters_are_set_back_to_the_preset(settings):
    assert not settings.differs_from_preset()
    settings.detail = 0.8
    assert not settings.differs_from_preset()
    settings.small_region = 0.01
    settings.equalise = False
    assert settings.differs_from_preset()
    bpy.ops.reeb_parts.reset_parameters()
    assert not settings.differs_from_preset()
    assert settings.detail == pytest.approx(0.8)
    settings.preset = "Berretti 2009"
    assert not settings.differs_from_preset()
    settings.method = "perceptual"
    assert settings.differs_from_preset()


def test_every_operator_is_in_a_menu(package, settings):
    """Blender's search looks through menus; what is in none of them is not found."""
    operators = sys.modules[f"{package}.operators"]
    menus = Path(sys.modules[f"{package}.ui.menus"].__file__).read_text(encoding="utf-8")
    found = set(re.findall(r'"(reeb_parts\.\w+)"', menus)) | {
        f"reeb_parts.{name}" for name in re.findall(r'"(\w+)"', re.search(r"for name in \((.*?)\)", menus)[1])}
    wanted = {cls.bl_idname for cls in operators.CLASSES if issubclass(cls, bpy.types.Operator)
              and "INTERNAL" not in cls.bl_options}
    assert wanted - found == set()


def test_the_menu_is_there_in_every_mode_that_operators_work_in(obj, settings, package):
    menus = sys.modules[f"{package}.ui.menus"]
    activate(obj)
    for mode, menu in (("OBJECT", "object"), ("EDIT", "edit_mesh"), ("SCULPT", "sculpt"),
                       ("WEIGHT_PAINT", "paint_weight"), ("VERTEX_PAINT", "paint_vertex")):
        bpy.ops.object.mode_set(mode=mode)
        drawn = getattr(bpy.types, f"VIEW3D_MT_{menu}").draw._draw_funcs
        assert menus._draw in drawn
    bpy.ops.object.mode_set(mode="OBJECT")
