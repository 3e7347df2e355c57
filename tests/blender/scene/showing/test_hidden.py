# SPDX-License-Identifier: GPL-3.0-or-later
"""Hidden parts vanish from every mode, the mesh stays as it is, and Show All and Clear leave nothing."""

import importlib

import bmesh
import bpy
import numpy as np
import pytest
import shapes
from bulk import read
from results import numbers
from snapshot import changes, snapshot


@pytest.fixture
def parameters_of_result():
    return {"method": "berretti"}  # of few parts


def seen(obj):
    """Numbers of the parts that the viewport shows, with how many faces."""
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return dict(zip(*(values.tolist() for values in np.unique(numbers(mesh), return_counts=True)), strict=True))


def choose(result, index):
    result.active = index
    for part in result.parts:
        part.selected = False
    return result.parts[index].number


def test_hidden_parts_are_not_seen_and_all_come_back(obj, result):
    everything = seen(obj)
    before = snapshot()
    first, second = choose(result, 1), None
    bpy.ops.reeb_parts.hide()
    assert seen(obj) == {number: count for number, count in everything.items() if number != first}
    second = choose(result, 2)
    bpy.ops.reeb_parts.hide()
    assert seen(obj) == {number: count for number, count in everything.items() if number not in (first, second)}
    bpy.ops.reeb_parts.isolate()
    assert set(seen(obj)) == {second}
    bpy.ops.reeb_parts.isolate(show_all=True)
    assert seen(obj) == everything
    choose(result, 0)
    # But for the order of attributes, since Blender has made its own of what is hidden.
    other = ("result", ".hide_", "/order")
    left = [change for change in changes(before, snapshot())
            if "/Tree" in change[0] and not any(word in change[0] for word in other)]
    assert left == []


@pytest.mark.parametrize("edit", ["move", "subdivide"])
def test_show_all_shows_what_was_isolated_and_edited(obj, result, edit):
    """It was refused until the mesh was decomposed again."""
    sizes = {node.name: node.empty_display_size for node in obj.children}
    choose(result, 1)
    bpy.ops.reeb_parts.isolate()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    if edit == "move":
        bpy.ops.transform.translate(value=(0.1, 0.0, 0.0))
    else:
        bpy.ops.mesh.subdivide()
    bpy.ops.reeb_parts.isolate(show_all=True)
    assert obj.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert sum(seen(obj).values()) == len(obj.data.polygons)
    assert not obj.modifiers
    assert not any(polygon.hide for polygon in obj.data.polygons)
    assert {node.name: node.empty_display_size for node in obj.children} == sizes
    with pytest.raises(RuntimeError, match="was edited since it was decomposed"):
        bpy.ops.reeb_parts.isolate()


def test_renders_show_everything(obj, result):
    choose(result, 1)
    bpy.ops.reeb_parts.hide()
    (modifier,) = obj.modifiers
    assert modifier.show_viewport
    assert not modifier.show_render


def test_all_objects_of_a_mesh_hide_together_and_clear_takes_it_back(obj, result):
    other = bpy.data.objects.new("Second", obj.data)
    bpy.context.scene.collection.objects.link(other)
    choose(result, 1)
    bpy.ops.reeb_parts.hide()
    assert seen(other) == seen(obj)
    bpy.ops.reeb_parts.clear()
    assert [len(item.modifiers) for item in (obj, other)] == [0, 0]
    assert "reeb_hidden" not in obj.data.attributes
    assert not [group for group in bpy.data.node_groups if "reeb_parts_hide" in group]


@pytest.mark.parametrize("way", ["hide", "isolate"])
def test_clear_shows_hidden_parts_in_edit_mode_too(obj, way):
    """They were seen in Object Mode, and in Edit Mode all but one part of the mesh was gone."""
    before = snapshot()["meshes"][obj.data.name]["flags"]
    bpy.ops.reeb_parts.decompose(method="berretti")
    choose(obj.data.reeb_parts, 1)
    getattr(bpy.ops.reeb_parts, way)()
    assert any(polygon.hide for polygon in obj.data.polygons)
    bpy.ops.reeb_parts.clear()
    assert snapshot()["meshes"][obj.data.name]["flags"] == before


def test_clear_leaves_hidden_what_was_hidden_in_edit_mode_since(obj, result):
    numbers_ = numbers(obj.data)
    choose(result, 1)
    bpy.ops.reeb_parts.hide()
    mine = int(np.flatnonzero(numbers_ == result.parts[2].number)[0])
    obj.data.polygons[mine].hide = True
    bpy.ops.reeb_parts.clear()
    assert [polygon.index for polygon in obj.data.polygons if polygon.hide] == [mine]


@pytest.mark.parametrize("way", ["hide", "isolate"])
def test_clear_leaves_hidden_what_was_hidden_in_edit_mode_before(obj, result, way):
    """It was shown with the parts, and in Object Mode it vanished with the first part that was hidden."""
    of_part = {part: np.flatnonzero(numbers(obj.data) == result.parts[part].number)[:3] for part in (1, 2)}
    kept = of_part[2] if way == "isolate" else np.concatenate([of_part[1], of_part[2]])
    everything = seen(obj)
    for face in kept:
        obj.data.polygons[face].hide = True
    first = choose(result, 1)
    for _ in range(2):  # the second time what is hidden is ours
        getattr(bpy.ops.reeb_parts, way)()
    alone = way == "isolate"
    assert seen(obj) == {number: count for number, count in everything.items() if (number == first) == alone}
    choose(result, 3)
    bpy.ops.reeb_parts.hide()
    bpy.ops.reeb_parts.clear()
    assert [polygon.index for polygon in obj.data.polygons if polygon.hide] == sorted(kept.tolist())
    assert not [name for name in obj.data.attributes.keys() if "reeb" in name]


def test_where_the_user_has_renamed_a_node_parts_are_hidden_all_the_same(obj, result):
    """It ended in an error; the nodes that were changed stay in the file."""
    result.active = 0
    bpy.ops.reeb_parts.hide()
    mine = obj.modifiers[0].node_group
    mine.nodes["Hidden"].name = "Mine"
    result.active = 1
    assert bpy.ops.reeb_parts.hide() == {"FINISHED"}
    assert {part.number for part in result.parts[:2]}.isdisjoint(seen(obj))
    assert "Mine" in mine.nodes
    assert mine.use_fake_user


def test_pieces_of_hidden_parts_are_seen(obj, result):
    count = len(result.parts)
    choose(result, 1)
    bpy.ops.reeb_parts.hide()
    bpy.ops.reeb_parts.separate()
    pieces = obj.reeb_parts_made.pieces.objects
    assert len(pieces) == count
    for piece in pieces:
        assert not piece.modifiers
        assert "reeb_hidden" not in piece.data.attributes
        assert len(piece.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.polygons) > 0


def test_the_outline_of_a_hidden_part_is_hidden_and_that_of_its_neighbors_is_not(obj, result, package):
    outline = importlib.import_module(f"{package}.viewport.highlight").outline
    first, second = (result.parts[index].number for index in (1, 2))
    (around,), (other,) = outline(obj, [first]), outline(obj, [second])
    choose(result, 1)
    bpy.ops.reeb_parts.hide()
    assert len(around)
    assert not len(outline(obj, [first])[0])
    assert np.array_equal(outline(obj, [second])[0], other)
    assert np.array_equal(outline(obj, [first, second])[0], other)
    bpy.ops.reeb_parts.isolate(show_all=True)
    assert np.array_equal(outline(obj, [first])[0], around)


def test_parts_that_border_on_none_are_filled_instead_of_outlined(make, package):
    highlight = importlib.import_module(f"{package}.viewport.highlight")
    obj = make(shapes.two_spheres(), "Spheres")
    bpy.ops.reeb_parts.decompose(method="berretti", loose_part=0.0)
    result = obj.data.reeb_parts
    assert len(result.parts) == 2
    for part in result.parts:
        assert not len(highlight.outline(obj, [part.number])[0])
        filled = highlight.without_outline(obj, [part.number])
        assert len(filled) == (numbers(obj.data) == part.number).sum()
    assert len(highlight.without_outline(obj, [part.number for part in result.parts])) == len(obj.data.polygons)
    choose(result, 1)
    bpy.ops.reeb_parts.hide()
    assert not len(highlight.without_outline(obj, [result.parts[1].number]))


def test_parts_with_an_outline_are_not_filled(obj, result, package):
    highlight = importlib.import_module(f"{package}.viewport.highlight")
    assert not len(highlight.without_outline(obj, [result.parts[1].number]))


@pytest.mark.parametrize("way", ["hide", "isolate"])
def test_the_graph_of_hidden_parts_is_hidden_and_not_pointed_at(obj, result, package, way):
    pointing = importlib.import_module(f"{package}.viewport.pointing")
    shown = len(pointing.model_of(obj).shown_lines.segments)
    nodes = [item for item in bpy.data.objects if item.get("reeb_parts_role") == "node"]
    seen = [node.name for node in nodes if not node["folded"]]
    choose(result, 1)
    getattr(bpy.ops.reeb_parts, way)()
    left = len(pointing.model_of(obj).shown_lines.segments)
    assert left == len(pointing.Model(obj).shown_lines.segments) < shown
    assert len([node for node in nodes if not node["folded"]]) < len(seen)
    bpy.ops.reeb_parts.isolate(show_all=True)
    assert len(pointing.model_of(obj).shown_lines.segments) == shown
    assert [node.name for node in nodes if not node["folded"]] == seen


@pytest.mark.parametrize("way", ["hide", "isolate"])
def test_the_curve_ends_where_the_overlay_of_the_graph_does(obj, result, package, way):
    """Blender draws the curve's own wire, which led on to hidden parts as a thin black line."""
    overlay = importlib.import_module(f"{package}.viewport.graph_overlay")
    (arcs,) = [item for item in obj.children if item.get("reeb_parts_role") == "arcs"]

    def places(points):
        return {tuple(np.round(point, 4).tolist()) for point in np.asarray(points, np.float64)}

    def curve():
        return places([point.co[:3] for spline in arcs.data.splines for point in spline.points])

    whole = curve()
    for index in range(len(result.parts)):
        choose(result, index)
        getattr(bpy.ops.reeb_parts, way)()
        # The overlay has points in the middle of segments, too.
        assert curve() == places(overlay.colored_arcs(obj.data)[0].reshape(-1, 4, 3)[:, [0, 3]].reshape(-1, 3))
        assert all(len(spline.points) > 1 for spline in arcs.data.splines)
        bpy.ops.reeb_parts.isolate(show_all=True)
        assert curve() == whole


@pytest.mark.parametrize("way", ["hide", "isolate"])
def test_no_piece_of_an_arc_has_the_color_of_a_hidden_part(obj, result, package, way):
    """Half of each segment that led across the cut was left, as a stub, or as scraps beside the model."""
    overlay = importlib.import_module(f"{package}.viewport.graph_overlay")
    colors = {tuple(part.color[:3]) for part in result.parts}
    for index, part in enumerate(result.parts):
        choose(result, index)
        getattr(bpy.ops.reeb_parts, way)()
        drawn = {tuple(color) for color in overlay.colored_arcs(obj.data)[1][:, :3].tolist()}
        own = {tuple(part.color[:3])}
        assert drawn <= (colors - own if way == "hide" else own)
        bpy.ops.reeb_parts.isolate(show_all=True)


@pytest.mark.parametrize("again", [False, True])
@pytest.mark.parametrize("way", ["hide", "isolate"])
@pytest.mark.parametrize("kind", ["verts", "edges", "faces"])
def test_clear_hides_what_was_hidden_before_to_the_edge(obj, kind, way, again):
    """Of what was hidden by vertices or edges, others were hidden then, and nothing of what was isolated was."""
    mesh = obj.data
    bm = bmesh.new()
    bm.from_mesh(mesh)
    loose = [bm.verts.new((x, 5.0, 5.0)) for x in (0.0, 1.0, 2.0)]
    bm.edges.new(loose[:2])
    for element in list(getattr(bm, kind))[::7]:
        element.hide_set(True)
    loose[2].hide_set(True)
    bm.to_mesh(mesh)
    bm.free()
    before = [read(items, "hide", bool).tolist() for items in (mesh.polygons, mesh.edges, mesh.vertices)]
    names = sorted(mesh.attributes.keys())
    bpy.ops.reeb_parts.decompose()
    choose(mesh.reeb_parts, 1)
    getattr(bpy.ops.reeb_parts, way)()
    if again:
        choose(mesh.reeb_parts, 2)
        bpy.ops.reeb_parts.hide()
        bpy.ops.reeb_parts.isolate()
    bpy.ops.reeb_parts.clear()
    assert [read(items, "hide", bool).tolist() for items in (mesh.polygons, mesh.edges, mesh.vertices)] == before
    assert sorted(mesh.attributes.keys()) == names


def test_what_is_hidden_by_hand_meanwhile_stays_hidden_after_clear(obj, result):
    mesh = obj.data
    mesh.polygons[0].hide = True
    number = choose(result, 1)
    bpy.ops.reeb_parts.hide()
    other = next(face for face in range(1, len(mesh.polygons)) if numbers(mesh)[face] != number)
    mesh.polygons[other].hide = True
    choose(result, 2)
    bpy.ops.reeb_parts.hide()
    bpy.ops.reeb_parts.clear()
    assert np.flatnonzero(read(mesh.polygons, "hide", bool)).tolist() == [0, other]
