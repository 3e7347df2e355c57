# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph is seen where its parts are: apart when they are exploded, along when they are posed, gone when hidden."""

import math
import sys

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Vector
from snapshot import changes, snapshot


@pytest.fixture
def follow(package, obj):
    """Lets the graph of the decomposed object follow, as a timer does in a window."""
    bpy.ops.reeb_parts.decompose()
    bpy.context.view_layer.update()
    return lambda: sys.modules[f"{package}.scene.graph.graph_follow"].follow(bpy.context, obj)


def nodes():
    return {item["node"]: item for item in bpy.data.objects if item.get("reeb_parts_role") == "node"}


def arcs():
    (item,) = [item for item in bpy.data.objects if item.get("reeb_parts_role") == "arcs"]
    return item


def seen():
    """Where the nodes are seen, (k, 3), and the points of the arcs."""
    bpy.context.view_layer.update()
    found = nodes()
    points = [point.co[:3] for spline in arcs().data.splines for point in spline.points]
    return np.array([found[i].matrix_world.translation for i in sorted(found)]), np.array(points)


def shifts(obj):
    """What Explode adds to each part at 1, by number: from the middle of all to its own."""
    numbers, area = (np.zeros(len(obj.data.polygons), kind) for kind in (np.int32, np.float32))
    center = np.zeros(3 * len(numbers), np.float32)
    obj.data.attributes["reeb_part"].data.foreach_get("value", numbers)
    obj.data.polygons.foreach_get("area", area)
    obj.data.polygons.foreach_get("center", center)
    middle = np.average(center.reshape(-1, 3), axis=0, weights=area)
    return {number: np.average(center.reshape(-1, 3)[numbers == number], axis=0, weights=area[numbers == number])
            - middle for number in set(numbers.tolist())}


@pytest.fixture
def visibility(package):
    return sys.modules[f"{package}.scene.graph.graph_visibility"]


def test_it_is_hidden_with_its_model_and_comes_back(obj, follow, visibility):
    """Hidden by H, or with the model's collection; the graph was left floating in the view."""
    assert arcs().visible_get()
    for hide in (obj.hide_set, lambda hidden: setattr(obj, "hide_viewport", hidden)):
        for hidden in (True, False):
            hide(hidden)
            bpy.context.view_layer.update()
            assert visibility.is_due(bpy.context)
            visibility.follow(bpy.context)
            assert not visibility.is_due(bpy.context)
            assert [item.visible_get() for item in (arcs(), *nodes().values())] == [not hidden] * (1 + len(nodes()))


def test_a_graph_is_shown_without_its_model_and_stays_hidden_beside_it(obj, follow, visibility):
    """As whoever looks at it has chosen."""
    def look(hidden):
        obj.hide_set(hidden)
        bpy.context.view_layer.update()
        visibility.follow(bpy.context)

    look(True)
    bpy.context.scene.reeb_parts.graph = False
    bpy.context.scene.reeb_parts.graph = True
    bpy.context.view_layer.update()
    visibility.follow(bpy.context)
    assert arcs().visible_get()
    look(False)
    bpy.ops.reeb_parts.show_graph()
    look(True)
    look(False)
    assert not arcs().visible_get()


def test_it_drifts_apart_with_the_parts_and_comes_back_whole(obj, follow):
    before, arcs_before = seen()
    everything = snapshot()
    by_part = shifts(obj)
    obj.reeb_parts_made.explode = 0.7
    follow()
    expected = np.array([0.7 * by_part[nodes()[i]["part"]] for i in sorted(nodes())])
    apart, arcs_apart = seen()
    assert apart - before == pytest.approx(expected, abs=1e-4)
    # Each point of the arcs has moved as one of the parts has.
    moved = np.linalg.norm((arcs_apart - arcs_before)[:, None] - 0.7 * np.array(list(by_part.values())), axis=2)
    assert moved.min(axis=1).max() < 1e-4
    assert len(set(moved.argmin(axis=1).tolist())) == len(by_part)
    # Scripts read the graph where it is.
    assert all((np.array(node.location) + obj.location - before[i] == pytest.approx(np.zeros(3), abs=1e-5))
               for i, node in nodes().items())
    obj.reeb_parts_made.explode = 0.0
    follow()
    assert all(np.array_equal(a, b) for a, b in zip((before, arcs_before), seen(), strict=True))
    # But for Explode itself, which is 0.
    assert {path for path, *_ in changes(everything, snapshot())} <= {
        "/objects/Tree/made", "/objects/Tree/properties/reeb_parts_made"}


@pytest.mark.parametrize("divided", [False, True])
def test_it_goes_with_the_bones(obj, follow, divided):
    """Those of a figure with Subdivision, too, as most that are posed have."""
    bpy.ops.reeb_parts.armature(weights="PARTS")
    before, _ = seen()
    if divided:
        obj.modifiers.new("Subdivision", "SUBSURF")
    (rig,) = [item for item in bpy.data.objects if item.type == "ARMATURE"]
    leaves = [bone for bone in rig.pose.bones if bone.parent is not None and not bone.children]
    for bone in leaves:
        bone.rotation_mode, bone.rotation_euler = "XYZ", (0.0, 0.0, math.radians(40))
    bpy.context.view_layer.update()
    follow()
    after, _ = seen()
    names = {part.number: part.name for part in obj.data.reeb_parts.parts}
    for index, node in nodes().items():
        bone = rig.pose.bones[names[node["part"]]]
        way = rig.matrix_world @ bone.matrix @ bone.bone.matrix_local.inverted() @ rig.matrix_world.inverted()
        # Faces at a cut have vertices that rest.
        assert after[index] == pytest.approx(np.array(way @ Vector(before[index])), abs=0.1)
    assert np.linalg.norm(after - before, axis=1).max() > 0.5


@pytest.mark.parametrize("divided", [False, True])
def test_that_of_a_half_model_goes_with_the_bones_of_both_sides(package, make, divided):
    """It stayed where it was; beside Subdivision, as most half models have it, for longer."""
    obj = make(shapes.half_of(shapes.mirrored_figure()), "Figure")
    obj.scale = (1.0, 1.5, 0.5)
    obj.modifiers.new("Mirror", "MIRROR")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(weights="PARTS")
    if divided:
        obj.modifiers.new("Subdivision", "SUBSURF")
    bpy.context.view_layer.update()
    follow = sys.modules[f"{package}.scene.graph.graph_follow"].follow
    follow(bpy.context, obj)
    before, _ = seen()
    (rig,) = [item for item in bpy.data.objects if item.type == "ARMATURE"]
    sides = [bone.name for bone in rig.pose.bones if bone.name.endswith((".L", ".R"))]
    assert len(sides) > 2
    turned = [name for name in sides if name.endswith(".R")]
    for name in turned:
        rig.pose.bones[name].location = (0.0, 0.0, 0.25)
    bpy.context.view_layer.update()
    follow(bpy.context, obj)
    after, _ = seen()
    names = {part.number: part.name for part in obj.data.reeb_parts.parts}
    moved = np.linalg.norm(after - before, axis=1)
    limb = np.array([f"DEF-{names[node['part']]}.R" in turned for _, node in sorted(nodes().items())])
    left, right = before[:, 0] > 0.3, before[:, 0] < -0.3
    assert moved[limb & right] == pytest.approx(0.25, abs=0.05)
    assert moved[limb & left] == pytest.approx(0.0, abs=1e-4)
    assert (limb & left).sum() == (limb & right).sum() > 1


@pytest.mark.parametrize("place", [None, 1, 2])
def test_the_outline_of_parts_of_a_half_model_goes_with_the_bones(package, make, place):
    """It stayed where it was. place : of Subdivision among the modifiers."""
    obj = make(shapes.half_of(shapes.mirrored_figure()), "Figure")
    obj.modifiers.new("Mirror", "MIRROR")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(weights="PARTS")
    (rig,) = [item for item in bpy.data.objects if item.type == "ARMATURE"]
    for bone in rig.pose.bones:
        bone.location = (0.0, 0.0, 0.25)
    half = obj.copy()  # as the bones move it alone
    half.modifiers.remove(half.modifiers["Mirror"])
    bpy.context.scene.collection.objects.link(half)
    if place is not None:
        obj.modifiers.new("Subdivision", "SUBSURF").subdivision_type = "SIMPLE"  # vertices stay
        obj.modifiers.move(2, place)
    bpy.context.view_layer.update()
    seen_points = sys.modules[f"{package}.scene.reading.seen_points"].seen_points
    points = seen_points(bpy.context, half)
    assert np.abs(points - [vertex.co[:] for vertex in obj.data.vertices]).max() > 0.2
    assert seen_points(bpy.context, obj) == pytest.approx(points, abs=1e-6)


def test_nodes_and_arcs_of_hidden_parts_are_folded(obj, follow):
    before, splines = seen(), len(arcs().data.splines)
    shown = {i for i, node in nodes().items() if not node["folded"]}
    result = obj.data.reeb_parts
    result.active = 1
    number = result.parts[1].number
    bpy.ops.reeb_parts.isolate()
    assert {i for i, node in nodes().items() if not node["folded"]} == {
        i for i in shown if nodes()[i]["part"] == number} != set()
    assert 0 < len(arcs().data.splines) < splines
    bpy.ops.reeb_parts.isolate(show_all=True)
    assert {i for i, node in nodes().items() if not node["folded"]} == shown
    assert all(np.array_equal(a, b) for a, b in zip(before, seen(), strict=True))


def test_a_mesh_of_other_faces_has_its_graph_where_it_was(obj, follow):
    before, _ = seen()
    obj.modifiers.new("Subdivision", "SUBSURF")
    bpy.context.view_layer.update()
    follow()
    assert np.array_equal(before, seen()[0])
