# SPDX-License-Identifier: GPL-3.0-or-later
"""The marks of nodes as triangles; that they are drawn, tests/window shows."""

import sys

import bpy
import numpy as np
import pytest


@pytest.fixture
def markers(package):
    return sys.modules[f"{package}.viewport.graph_overlay"]


def test_marks_lie_in_the_view_plane_around_their_node(markers):
    places = np.array([(0.0, 0.0, 0.0), (5.0, 1.0, 2.0), (-3.0, 0.0, 1.0)])
    kinds = ["minimum", "saddle", "maximum"]
    colors = np.array([(1, 1, 0, 1), (0, 0, 0.2, 1), (0.2, 0.6, 0.9, 1)], float)
    points, shades = markers.marks(places, kinds, colors, np.eye(3)[1:], np.array([1.0, 2.0, 3.0]))
    assert points.dtype == shades.dtype == np.float32
    assert points.flags.c_contiguous
    assert shades.flags.c_contiguous
    assert len(points) == len(shades) == 2 * 3 * (20 + 4 + 3)
    start = 0
    for place, color, radius, sides in zip(places, colors, (1.0, 2.0, 3.0), (20, 4, 3), strict=True):
        own = slice(start, start + 6 * sides)
        start += 6 * sides
        offset = points[own] - place
        assert np.abs(offset[:, 0]).max() < 1e-5  # towards the viewer
        size = np.linalg.norm(offset, axis=1)
        assert size.max() <= 1.4 * markers.RIM * radius * 1.001
        assert size.max() >= radius
        # The rim first, the mark over it.
        assert (shades[own][-3 * sides:] == color.astype(np.float32)).all()
        bright = color[:3] @ (0.2126, 0.7152, 0.0722) > 0.3
        assert (shades[own][: 3 * sides, 0] < 0.5).all() == bright


def test_a_chosen_mark_has_a_bright_rim_around_the_dark_one(markers):
    place, color, axes = np.zeros((1, 3)), np.array([(1.0, 1.0, 0.0, 1.0)]), np.eye(3)[:2]
    plain, _ = markers.marks(place, ["minimum"], color, axes, np.ones(1), [False])
    points, shades = markers.marks(place, ["minimum"], color, axes, np.ones(1), [True])
    assert np.array_equal(points[-len(plain):], plain)
    assert np.linalg.norm(points[:-len(plain)], axis=1).max() == pytest.approx(markers.LIT)
    assert shades[0].min() > 0.8


def test_kinds_look_different(markers):
    assert set(markers.SHAPES) == {"minimum", "saddle", "maximum"}
    assert len({len(outline) for outline in markers.SHAPES.values()}) == 3


@pytest.fixture
def arcs(markers, obj):
    """The arcs of a decomposed mesh, looked up anew since undo and modes replace it."""
    bpy.ops.reeb_parts.decompose(method="berretti")
    return lambda: markers.colored_arcs(obj.data)


def refused(package):
    return pytest.raises(sys.modules[f"{package}.scene.errors"].SceneError)


def test_arcs_have_the_colours_of_the_parts_that_they_pass(obj, arcs):
    points, colors = arcs()
    assert points.dtype == colors.dtype == np.float32
    assert len(points) == len(colors) > 100
    assert {tuple(color[:3]) for color in colors} == {tuple(part.color) for part in obj.data.reeb_parts.parts}


@pytest.mark.parametrize("deleted", [False, True])
def test_a_graph_is_drawn_wherever_its_objects_are(markers, obj, arcs, deleted):
    """What was moved to another collection was not drawn in colors, but by Blender."""
    collection, other = bpy.data.collections["Reeb Graph Tree"], bpy.data.collections.new("Mine")
    bpy.context.scene.collection.children.link(other)
    graph = set(collection.objects)
    moved = list(graph) if deleted else list(graph)[::2]
    for item in moved:
        other.objects.link(item)
        collection.objects.unlink(item)
    if deleted:
        bpy.data.collections.remove(collection)
    (found,) = markers.seen_graphs(bpy.context.view_layer).items()
    assert (found[0], set(found[1]), len(found[1])) == (obj, graph, len(graph))
    moved[0].hide_set(True)
    assert set(markers.seen_graphs(bpy.context.view_layer)[obj]) == graph - {moved[0]}


def test_arcs_are_colored_anew_once_the_mesh_is_edited(package, markers, obj, arcs):
    """Those of before were drawn on over the model as it was."""
    before = markers.state(obj, list(obj.children))
    obj.data.vertices[0].co.x += 0.5
    sys.modules[f"{package}.scene.changes.watch"].check(obj.data)  # as a timer does
    assert markers.state(obj, list(obj.children)) != before
    with refused(package):
        arcs()


def test_arcs_are_colored_anew_once_an_unreadable_result_is_replaced(markers, obj, arcs):
    """The same parts, of a file that a newer version wrote, were drawn without colors for the rest of the session."""
    result = obj.data.reeb_parts
    arcs()
    for _ in range(2):  # numbers and all that is shown are the same after both
        numbers, result.data = result.numbers, b"of a newer version"
        result.seconds = 12.5
        before = markers.state(obj, list(obj.children))
        bpy.ops.reeb_parts.decompose()
    assert result.numbers == numbers
    assert markers.state(obj, list(obj.children)) != before


def test_arcs_keep_their_colours_in_edit_mode(obj, arcs):
    before = arcs()
    bpy.ops.object.mode_set(mode="EDIT")
    for one, other in zip(before, arcs(), strict=True):
        assert np.array_equal(one, other)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.translate(value=(1.0, 0.0, 0.0))
    for one, other in zip(before, arcs(), strict=True):
        assert np.array_equal(one, other)


def test_arcs_of_hidden_parts_are_not_drawn_in_edit_mode_either(obj, arcs):
    """Where Isolate leaves one part: all of the graph came back with Edit Mode."""
    whole = arcs()
    obj.data.reeb_parts.active = 0
    bpy.ops.reeb_parts.isolate()
    before = arcs()
    assert 0 < len(before[0]) < len(whole[0])
    bpy.ops.object.mode_set(mode="EDIT")
    for one, other in zip(before, arcs(), strict=True):
        assert np.array_equal(one, other)


def test_arcs_are_out_of_date_once_edits_are_left(package, obj, arcs):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.translate(value=(1.0, 0.0, 0.0))
    bpy.ops.object.mode_set(mode="OBJECT")
    with refused(package):
        arcs()
    obj.data.reeb_parts.edited = True  # as is noticed after a moment
    bpy.ops.object.mode_set(mode="EDIT")
    with refused(package):
        arcs()
