# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints between separated parts: they fit, they leave walls, and what they cannot hold in stays as it was."""

import importlib

import bpy
import numpy as np
import pytest
import shapes
from mathutils.bvhtree import BVHTree
from pieces import is_sound, pieces_of, volume
from snapshot import activate, changes, check_undo, snapshot

KEEP = {"hide": False, "center": False}
MILLIMETER = 1e-3  # of Blender's default scene


def dowels(name="Tree"):
    return [o for o in bpy.data.collections[f"Parts of {name}"].objects if "reeb_parts_dowel" in o]


def tree_of(obj, only=None):
    """The surface of an object in the world, or of some of its faces."""
    points = [obj.matrix_world @ vertex.co for vertex in obj.data.vertices]
    return BVHTree.FromPolygons(points, [p.vertices[:] for p in obj.data.polygons if only is None or only(p)])


@pytest.fixture
def joined(package):
    """The module behind the operator."""
    return importlib.import_module(f"{package}.scene.joints")


@pytest.mark.parametrize("kind", ["ROUND", "SQUARE", "KEY"])
def test_pegs_and_holes_fill_each_other(make, kind):
    """Without clearance, the pieces together enclose what the mesh encloses."""
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=3)
    assert bpy.ops.reeb_parts.separate(joints=kind, joint_clearance=0.0, joint_count=2, **KEEP) == {"FINISHED"}
    assert all(is_sound(piece) for piece in pieces_of())
    whole, volumes = volume(obj.data), [volume(piece.data) for piece in pieces_of()]
    assert sum(volumes) == pytest.approx(whole, rel=1e-4)
    activate(obj)
    bpy.ops.reeb_parts.separate(caps=True, **KEEP)
    plain = [volume(piece.data) for piece in pieces_of()]
    # The smaller pieces have gained what the larger one has lost.
    assert all(abs(a - b) > 1e-3 * b for a, b in zip(volumes, plain, strict=True))


@pytest.mark.parametrize("clearance", [0.15, 2.0])
def test_a_peg_stands_in_its_hole_with_the_clearance(make, clearance):
    """Nowhere nearer, all around as near as asked; in millimeters, for a unit is a meter."""
    make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(joints="ROUND", joint_clearance=clearance, **KEEP)
    assert all(is_sound(piece) for piece in pieces_of())
    peg, hole = sorted(pieces_of(), key=lambda piece: volume(piece.data))
    caps = [piece.data.attributes["reeb_cap"].data for piece in (peg, hole)]
    # What sticks out of one and what is hollow in the other: the faces of joints that lie beyond the cap.
    hole_tree = tree_of(hole, lambda p: caps[1][p.index].value == 1)
    others = tree_of(hole, lambda p: caps[1][p.index].value == 0)
    distances = []
    for polygon in peg.data.polygons:
        if caps[0][polygon.index].value == 1 and others.find_nearest(polygon.center)[3] > 0.05:
            distances.append(hole_tree.find_nearest(polygon.center)[3] / MILLIMETER)
    beyond = np.array([d for d in distances if d > 1e-3])
    assert len(beyond) > 48
    assert np.median(beyond) == pytest.approx(clearance, rel=0.02)
    assert not BVHTree.overlap(tree_of(peg, lambda p: caps[0][p.index].value == 1 and p.area < 0.002), others)


def test_holes_for_magnets_and_dowels_in_both_pieces(make):
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(caps=True, **KEEP)
    plain = [volume(piece.data) for piece in pieces_of()]
    for kind, count in (("MAGNET", 0), ("DOWEL", 1)):
        activate(obj)
        bpy.ops.reeb_parts.separate(joints=kind, joint_size=100.0, joint_depth=80.0, joint_clearance=1.0, **KEEP)
        assert all(is_sound(piece) for piece in pieces_of())
        lost = [before - volume(piece.data) for before, piece in zip(plain, pieces_of(), strict=True)]
        area = 48 * np.tan(np.pi / 48) * 51**2 * MILLIMETER**2
        assert lost == pytest.approx([81 * MILLIMETER * area] * 2, rel=0.1)
        assert len(dowels()) == count
    (dowel,) = dowels()
    assert sorted(dowel.dimensions) == pytest.approx([0.1, 0.1, 0.16], rel=0.02)
    holes = [tree_of(piece, lambda p: False) for piece in pieces_of()]
    assert len(holes) == 2


def test_dowels_of_an_earlier_run_go_unless_somebody_worked_on_them(make):
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(joints="DOWEL", **KEEP)
    mine = dowels()[0]
    count = len(dowels())
    mine.location.z += 1
    activate(obj)
    bpy.ops.reeb_parts.separate(joints="DOWEL", **KEEP)
    assert mine not in dowels()
    assert len(dowels()) == count
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    assert dowels() == []
    assert mine in bpy.data.objects[:]


def test_quads_that_are_bent_keep_no_cut_from_its_joint():
    """The booleans turn them round, which changed what a piece encloses, and so joints were said to spoil it."""
    bpy.ops.mesh.primitive_monkey_add()
    bpy.ops.reeb_parts.decompose(n_parts=16)
    obj = bpy.context.object
    largest = max(obj.data.reeb_parts.parts, key=lambda part: part.share)
    obj.data.reeb_parts.active = list(obj.data.reeb_parts.parts).index(largest)
    bpy.ops.reeb_parts.split()
    bpy.ops.reeb_parts.separate(joints="ROUND", **KEEP)
    cuts = obj.reeb_parts_made.cuts
    # A cut may be too small for a joint; which there are hangs on what judges her parts.
    assert {cut.why for cut in cuts if not cut.count} <= {"ROOM"}
    assert len([cut for cut in cuts if cut.count]) > 20


def hollow_tube(thickness, n_around=48):
    """A closed tube with a wall: quads around a profile that goes up outside and down inside."""
    z = np.linspace(0.0, 3.0, 40)
    profile = np.concatenate([np.column_stack([np.full(40, 0.5), z]),
                              np.column_stack([np.full(40, 0.5 - thickness), z[::-1]])])
    angle = 2 * np.pi * np.arange(n_around) / n_around
    points = np.stack([profile[:, :1] * np.cos(angle), profile[:, :1] * np.sin(angle),
                       np.broadcast_to(profile[:, 1:], (80, n_around))], axis=-1).reshape(-1, 3)
    k, j = np.meshgrid(np.arange(80), np.arange(n_around), indexing="ij")
    up, on = (k + 1) % 80, (j + 1) % n_around
    quads = np.stack([k * n_around + j, k * n_around + on, up * n_around + on, up * n_around + j], axis=-1)
    return points, quads.reshape(-1, 4)


@pytest.fixture
def tube_pieces(make, package):
    """Two halves of a tube with a wall, closed, as joints.join takes them."""
    part_meshes = importlib.import_module(f"{package}.scene.pieces.part_meshes")

    def halves(thickness):
        obj = make(hollow_tube(thickness), "Tube")
        assert volume(obj.data) == pytest.approx(3 * np.pi * (0.25 - (0.5 - thickness) ** 2), rel=0.01)
        numbers = np.array([1 + (polygon.center.z > 1.5) for polygon in obj.data.polygons])
        return part_meshes.piece_meshes(obj.data, numbers, [1, 2], True, np.eye(3)).meshes

    return halves


@pytest.mark.parametrize(("thickness", "is_joined"), [(0.003, False), (0.02, True), (0.25, True)])
def test_no_joint_through_the_wall_of_a_tube(tube_pieces, joined, package, thickness, is_joined):
    """Pegs stand in the wall, not in what is hollow; in a thin wall there are none, and that is said."""
    style = bpy.context.scene.reeb_parts_use
    style.joints = "ROUND"
    meshes = tube_pieces(thickness)
    whole = sum(volume(mesh) for mesh in meshes.values())
    before = {key: volume(mesh) for key, mesh in meshes.items()}
    steps = importlib.import_module(f"{package}.core.steps")
    found = steps.finished(joined.joining(
        bpy.context, meshes, np.eye(3), joined.wanted_joints(style), lambda one, other: "", None))
    assert any(cut.count for cut in found.cuts) == is_joined
    assert all(cut.count or cut.why for cut in found.cuts)
    if not is_joined:
        assert {key: volume(mesh) for key, mesh in found.meshes.items()} == before
        return
    assert sum(volume(mesh) for mesh in found.meshes.values()) == pytest.approx(whole, rel=5e-3)
    for mesh in found.meshes.values():
        points = np.array([vertex.co for vertex in mesh.vertices])
        radius = np.hypot(points[:, 0], points[:, 1])
        assert radius.min() >= 0.5 - thickness - 1e-5
        assert radius.max() <= 0.5 + 1e-5


def test_a_joint_of_two_cuts_near_each_other_leaves_a_wall_between(make, joined, package):
    """In a slice between two cuts, the holes from both sides do not meet."""
    part_meshes = importlib.import_module(f"{package}.scene.pieces.part_meshes")
    obj = make(shapes.cylinder(40, 48, 1.0, 4.0))
    numbers = np.array([1 + (p.center.z > 1.7) + (p.center.z > 2.3) for p in obj.data.polygons])
    meshes = part_meshes.piece_meshes(obj.data, numbers, [1, 2, 3], True, np.eye(3)).meshes
    style = bpy.context.scene.reeb_parts_use
    style.joints, style.joint_wall = "DOWEL", 50.0
    steps = importlib.import_module(f"{package}.core.steps")
    found = steps.finished(joined.joining(
        bpy.context, meshes, np.eye(3), joined.wanted_joints(style), lambda one, other: "", None))
    assert [cut.count for cut in found.cuts] == [1, 1]
    slice_ = found.meshes[2]
    hollow = [p for p in slice_.polygons if slice_.attributes["reeb_cap"].data[p.index].value and p.area < 1.0]
    z = np.array([slice_.vertices[i].co.z for p in hollow for i in p.vertices])
    ends = z[(z > 1.75) & (z < 2.25)]
    assert np.diff(np.sort(ends)).max() >= 0.05


def test_shape_keys_and_all_else_is_carried_on(obj):
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Fat")
    key.value = 0.7
    for point in key.data:
        point.co *= 1.5
    group = obj.vertex_groups.new(name="Arm")
    group.add(range(len(obj.data.vertices)), 0.25, "REPLACE")
    obj.data.materials.append(bpy.data.materials.new("Gold"))
    obj.data.uv_layers.new(name="Map")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(joints="ROUND", **KEEP)
    for piece in pieces_of():
        mesh = piece.data
        basis, fat = (np.array([p.co for p in mesh.shape_keys.key_blocks[name].data]) for name in ("Basis", "Fat"))
        assert mesh.shape_keys.key_blocks["Fat"].value == pytest.approx(0.7)
        here = np.array([v.co for v in mesh.vertices])
        assert basis == pytest.approx(here)
        # Points of joints move as the nearest of the cap does.
        cap = mesh.attributes["reeb_cap"].data
        own = np.unique([i for p in mesh.polygons if not cap[p.index].value for i in p.vertices])
        assert fat[own] == pytest.approx(1.5 * basis[own], abs=1e-5)
        assert np.linalg.norm(fat - 1.5 * basis, axis=1).max() < 0.5
        assert piece.vertex_groups.keys() == ["Arm"]
        assert mesh.uv_layers.keys() == ["Map"]
        assert [material.name for material in mesh.materials] == ["Gold"]
        assert is_sound(piece)


def test_scaled_and_turned_objects(make):
    """Millimeters are those of the world: joints stay round, and as wide, on an object that is stretched."""
    obj = make(shapes.dumbbell(), "Tree")
    obj.scale, obj.rotation_euler, obj.location = (2.0, 2.0, 0.5), (0.3, 0.5, 0.7), (1, 2, 3)
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(joints="DOWEL", joint_size=60.0, **KEEP)
    (dowel,) = dowels()
    bpy.context.view_layer.update()
    points = np.array([dowel.matrix_world @ v.co for v in dowel.data.vertices])
    points -= points.mean(axis=0)
    width = np.linalg.svd(points)[2] @ points.T
    assert sorted(np.ptp(width, axis=1))[:2] == pytest.approx([0.06, 0.06], rel=0.01)
    assert all(is_sound(piece) for piece in pieces_of())


def test_parts_that_are_not_closed_stay_without_and_it_is_said(make, capfd):
    make(shapes.cylinder(40, 24, 0.5, 6.0, capped=False), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(joints="ROUND", **KEEP)
    out = capfd.readouterr().out
    assert "Info: 0 of 1 cut has joints" in out
    assert "Warning: No joint where a part is not closed or crosses itself: Part 01 - Part 02" in out


def test_of_many_cuts_without_joints_the_first_are_named(scene_module):
    listed, names = scene_module("reporting").listed, [f"{k} - {k + 1}" for k in range(15)]
    assert listed(names[:12]) == ", ".join(names[:12])
    assert listed(names) == f"{', '.join(names[:12])} and 3 more"


def test_without_any_cut_it_is_said_that_there_are_no_joints(make, capfd):
    """It was reported as if all were well: 0 of 0 cuts have joints."""
    make(shapes.cylinder(40, 24, 0.5, 6.0), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=1)
    bpy.ops.reeb_parts.separate(joints="ROUND", **KEEP)
    out = capfd.readouterr().out
    assert "Warning: No joints: there is no cut that could have one." in out
    assert "0 of 0" not in out


def test_a_second_run_makes_the_same_again(make):
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(joints="DOWEL", joint_count=2, hide=False)
    first = snapshot()
    activate(obj)
    bpy.ops.reeb_parts.separate(joints="DOWEL", joint_count=2, hide=False)
    # Blender's booleans leave attributes in an order of their own, which is another one each time.
    assert [change for change in changes(first, snapshot()) if not change[0].endswith("/order")] == []


def test_undo(obj):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    check_undo(lambda: bpy.ops.reeb_parts.separate(joints="DOWEL", joint_count=2))


def test_each_cut_can_have_its_own(make):
    """Chosen in the list, kept by the next run, and by one that does not have the cut."""
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(joints="ROUND", **KEEP)
    cuts = obj.reeb_parts_made.cuts
    assert [(cut.joint, cut.count > 0, cut.why) for cut in cuts] == [("ALL", True, "")] * 2
    cuts[0].joint, cuts[1].joint = "DOWEL", "NONE"
    names = [(cut.low, cut.high) for cut in cuts]
    activate(obj)
    bpy.ops.reeb_parts.separate(joints="ROUND", **KEEP)
    assert [(cut.low, cut.high) for cut in cuts] == names
    assert [(cut.joint, cut.count, cut.why) for cut in cuts] == [("DOWEL", 1, ""), ("NONE", 0, "")]
    assert len(dowels()) == 1
    activate(obj)
    bpy.ops.reeb_parts.separate(joints="NONE", **KEEP)
    assert dowels() == []
    assert [cut.joint for cut in cuts] == ["DOWEL", "NONE"]


def test_a_part_separated_again_alone_leaves_the_dowels_of_others(make):
    obj = make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(joints="DOWEL", **KEEP)
    cuts = obj.reeb_parts_made.cuts
    pairs = [(cut.low, cut.high) for cut in cuts]
    assert sorted(tuple(dowel["reeb_parts_dowel"]) for dowel in dowels()) == pairs
    ends = [number for pair in pairs for number in pair]
    (alone,) = (number for number in pairs[0] if ends.count(number) == 1)
    obj.data.reeb_parts.active = next(
        place for place, part in enumerate(obj.data.reeb_parts.parts) if part.number == alone)
    activate(obj)
    bpy.ops.reeb_parts.separate(joints="DOWEL", which="CHOSEN", **KEEP)
    assert [tuple(dowel["reeb_parts_dowel"]) for dowel in dowels()] == [pairs[1]]
    assert [(cut.low, cut.high, cut.count) for cut in cuts] == [(*pairs[1], 1)]


def test_an_error_leaves_all_as_it_was(make, package, monkeypatch):
    """Even in the midst of making joints."""
    fitting = importlib.import_module(f"{package}.scene.joints.fitting")
    make(shapes.dumbbell(), "Tree")
    bpy.ops.reeb_parts.decompose(n_parts=3)
    before = snapshot()
    whole = fitting._is_fine
    asked = []

    def stumble(*arguments):
        asked.append(arguments)
        if len(asked) == 3:
            raise KeyError("something unforeseen")
        return whole(*arguments)

    monkeypatch.setattr(fitting, "_is_fine", stumble)
    with pytest.raises(RuntimeError, match="something unforeseen"):
        bpy.ops.reeb_parts.separate(joints="DOWEL", **KEEP)
    assert changes(before, snapshot()) == []
