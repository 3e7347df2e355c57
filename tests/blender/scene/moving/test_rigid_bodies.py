# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.rigid_bodies: separated parts fall, and what was joined stays together at the cuts."""

import sys

import bpy
import numpy as np
import pytest
from snapshot import activate, check_undo, snapshot


def joints_of():
    every = [o for o in bpy.data.objects if o.get("reeb_parts_role") == "joint"]
    return [joint for joint in every if joint.rigid_body_constraint.type != "GENERIC"]


def bodies():
    return [o for o in bpy.data.objects if o.rigid_body is not None and o.rigid_body.type == "ACTIVE"]


def separated(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate()
    return [o for o in bpy.data.objects if "reeb_parts_number" in o]


def floor(below):
    mesh = bpy.data.meshes.new("Floor")
    mesh.from_pydata([(-50, -50, below), (50, -50, below), (50, 50, below), (-50, 50, below)], [], [(0, 1, 2, 3)])
    plane = bpy.data.objects.new("Floor", mesh)
    bpy.context.scene.collection.objects.link(plane)
    bpy.context.scene.rigidbody_world.collection.objects.link(plane)
    plane.rigid_body.type, plane.rigid_body.collision_shape = "PASSIVE", "MESH"
    return plane


def matrices(objects):
    return [np.array(obj.matrix_world) for obj in objects]


def test_what_stands_on_a_floor_of_the_same_mesh_stays_there(make, tree):
    """The floor fell with what stood on it, joined to it."""
    low = tree[0][:, 2].min()
    corners = [(x, y, low) for x, y in ((-20, -20), (20, -20), (20, 20), (-20, 20))]
    obj, n = make((np.concatenate([tree[0], corners]), [*map(list, tree[1]), [len(tree[0]) + i for i in range(4)]])), 5
    assert len(separated(obj)) == n + 1
    bpy.ops.reeb_parts.rigid_bodies(joints="FIXED")
    (ground,) = [o for o in bpy.data.objects if o.rigid_body is not None and o.rigid_body.type == "PASSIVE"]
    assert [len(ground.data.polygons), len(bodies())] == [1, n]
    held = [joint.rigid_body_constraint for joint in bpy.data.objects if joint.rigid_body_constraint is not None]
    assert ground not in [end for joint in held for end in (joint.object1, joint.object2)]
    for frame in range(1, 31):
        bpy.context.scene.frame_set(frame)
    points = np.array([piece.matrix_world @ v.co for piece in bodies() for v in piece.data.vertices])
    assert points[:, 2].min() > low - 0.2


@pytest.mark.parametrize("kind", ["HINGE", "POINT", "FIXED"])
def test_pieces_that_fall_stay_together_at_the_cuts(obj, kind):
    pieces = separated(obj)
    assert bpy.ops.reeb_parts.rigid_bodies(joints=kind) == {"FINISHED"}
    assert set(bodies()) == set(pieces)
    assert {piece.rigid_body.collision_shape for piece in pieces} == {"CONVEX_HULL"}
    joints = joints_of()
    assert {joint.rigid_body_constraint.type for joint in joints} == {kind}
    assert len(joints) >= len(pieces) - 1
    points = np.concatenate([[piece.matrix_world @ v.co for v in piece.data.vertices] for piece in pieces])
    size = np.linalg.norm(np.ptp(points, axis=0))
    floor(points[:, 2].min() - 0.1 * size)
    ends = [[getattr(joint.rigid_body_constraint, name) for name in ("object1", "object2")] for joint in joints]
    before = [matrices(pair) for pair in ends]
    places = [np.append(joint.matrix_world.translation, 1.0) for joint in joints]
    heights = [piece.matrix_world.translation.z for piece in pieces]
    for frame in range(1, 31):
        bpy.context.scene.frame_set(frame)
        for place, pair, old in zip(places, ends, before, strict=True):
            first, second = (new @ np.linalg.inv(start) @ place for new, start in zip(matrices(pair), old, strict=True))
            assert np.linalg.norm(first - second) < 0.02 * size
    assert all(piece.matrix_world.translation.z < height for piece, height in zip(pieces, heights, strict=True))
    if kind == "FIXED":
        turns = [now[:3, :3] @ np.linalg.inv(old[0][:3, :3]) for (now, _), old in
                 ((matrices(pair), old) for pair, old in zip(ends, before, strict=True))]
        others = [now[:3, :3] @ np.linalg.inv(old[1][:3, :3]) for (_, now), old in
                  ((matrices(pair), old) for pair, old in zip(ends, before, strict=True))]
        assert np.allclose(turns, others, atol=0.1)


def in_world(pieces):
    """Middle of each face of pieces and its area, a vector that looks out of what is seen, (f, 6)."""
    faces = []
    for piece in pieces:
        world, turned = piece.matrix_world, -1 if piece.matrix_world.determinant() < 0 else 1
        for polygon in piece.data.polygons:
            corners = np.array([world @ piece.data.vertices[index].co for index in polygon.vertices])
            area = 0.5 * np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
            faces.append([*corners.mean(axis=0), *(turned * area)])
    return np.array(faces)


@pytest.mark.parametrize(("scale", "is_sheared"), [((-1, 2, 0.5), False), ((1, 2, 0.5), True), ((-1, 2, 0.5), True)])
def test_a_mirrored_or_sheared_piece_keeps_its_shape_when_it_moves(obj, scale, is_sheared):
    """Blender drops both of a body: pieces became their mirror images or straight at the second frame, and in files."""
    obj.scale, obj.rotation_euler = scale, (0.4, 0.2, 0.9)
    if is_sheared:
        obj.parent = bpy.data.objects.new("Parent", None)
        bpy.context.scene.collection.objects.link(obj.parent)
        obj.parent.scale, obj.parent.rotation_euler = (1, 3, 1), (0.1, 0.5, 0.2)
    bpy.context.view_layer.update()
    pieces = separated(obj)
    child = bpy.data.objects.new("Child", None)
    bpy.context.scene.collection.objects.link(child)
    child.parent, child.location = pieces[0], (1, 2, 3)
    bpy.context.view_layer.update()
    before, place = in_world(pieces), np.array(child.matrix_world)
    names = [piece.data.name for piece in pieces]
    bpy.ops.reeb_parts.rigid_bodies(joints="FIXED")
    bpy.context.view_layer.update()
    assert np.allclose(in_world(pieces), before, atol=1e-4)
    assert np.allclose(np.array(child.matrix_world), place, atol=1e-4)
    bpy.context.scene.frame_set(1)
    bpy.context.scene.frame_set(2)
    assert np.allclose(in_world(pieces), before, atol=0.05)
    assert [piece.data.name for piece in pieces] == names


def test_what_refers_to_the_mesh_of_a_mirrored_piece_refers_to_its_body(obj):
    """A fake user, or a property, was taken for another object that shares the mesh, which stayed as a second one."""
    obj.scale.x = -1
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Fat")
    piece, other, *_ = separated(obj)
    piece.data.use_fake_user, piece.data.name, piece.data.shape_keys.name = True, "Mine", "My keys"
    bpy.context.scene["mine"] = piece.data
    double = bpy.data.objects.new("Double", other.data)
    bpy.context.scene.collection.objects.link(double)
    former, shared, shape, n_meshes = piece.data.session_uid, other.data, read_points(other.data), len(bpy.data.meshes)
    bpy.ops.reeb_parts.rigid_bodies()
    assert piece.data.session_uid != former
    assert bpy.context.scene["mine"] == piece.data
    assert (piece.data.name, piece.data.shape_keys.name) == ("Mine", "My keys")
    assert piece.data.use_fake_user
    assert (double.data, other.data == shared) == (shared, False)  # which is of two objects, and stands as it was
    assert np.array_equal(read_points(shared), shape)
    assert len(bpy.data.meshes) == n_meshes + 1


def read_points(mesh):
    return np.array([vertex.co for vertex in mesh.vertices])


def test_joints_of_mirrored_pieces_are_not_mirrored(obj):
    """Those between pieces of one part, which was cut to fit a bed, stand where one of these does."""
    obj.scale.x = -1
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(fit_bed=True, bed=(900.0, 900.0, 900.0))
    bpy.ops.reeb_parts.rigid_bodies()
    bpy.context.view_layer.update()
    joints = [item for item in bpy.data.objects if item.rigid_body_constraint]
    assert "FIXED" in {joint.rigid_body_constraint.type for joint in joints}
    assert all(joint.matrix_world.determinant() == pytest.approx(1, abs=1e-4) for joint in joints)


def test_a_mirrored_piece_is_as_it_was_if_its_body_cannot_be_made(obj, package, monkeypatch):
    module = sys.modules[f"{package}.scene.moving.rigid_bodies"]
    obj.scale.x = -1
    separated(obj)
    bpy.context.view_layer.update()
    before = snapshot()
    monkeypatch.setattr(module, "_joints_at_cuts", lambda *_: 1 / 0)
    with pytest.raises(RuntimeError):
        bpy.ops.reeb_parts.rigid_bodies()
    assert snapshot() == before


def test_joints_are_where_parts_meet(obj):
    separated(obj)
    bpy.ops.reeb_parts.rigid_bodies()
    for joint in joints_of():
        ends = joint.rigid_body_constraint.object1, joint.rigid_body_constraint.object2
        points = [np.array([piece.matrix_world @ v.co for v in piece.data.vertices]) for piece in ends]
        rims = [{tuple(p) for p in some.round(4).tolist()} for some in points]
        rim = np.array(sorted(rims[0] & rims[1]))
        place = np.array(joint.matrix_world)
        assert np.linalg.norm(rim - place[:3, 3], axis=1).max() < np.ptp(rim, axis=0).max()
        assert np.allclose(place[:3, :3].T @ place[:3, :3], np.eye(3), atol=1e-5)
        assert np.linalg.det(place[:3, :3]) == pytest.approx(1, abs=1e-5)
        # x leads from the one part into the other.
        assert (points[1].mean(axis=0) - points[0].mean(axis=0)) @ place[:3, 0] > 0


def test_a_world_and_a_body_that_are_there_are_kept(obj):
    pieces = separated(obj)
    scene = bpy.context.scene
    bpy.ops.rigidbody.world_add()
    mine = bpy.data.collections.new("Mine")
    scene.rigidbody_world.collection = mine
    scene.rigidbody_world.substeps_per_frame = 7
    mine.objects.link(pieces[0])
    pieces[0].rigid_body.type, pieces[0].rigid_body.collision_shape = "PASSIVE", "MESH"
    bpy.ops.reeb_parts.rigid_bodies()
    assert scene.rigidbody_world.collection == mine
    assert scene.rigidbody_world.substeps_per_frame == 7
    assert (pieces[0].rigid_body.type, pieces[0].rigid_body.collision_shape) == ("PASSIVE", "MESH")
    assert set(mine.objects) == set(pieces)


def test_twice_is_once_and_a_used_joint_is_kept(obj):
    separated(obj)
    bpy.ops.reeb_parts.rigid_bodies()
    once = snapshot()
    bpy.ops.reeb_parts.rigid_bodies()
    assert snapshot() == once
    count = len(joints_of())
    mine = joints_of()[0]
    mine.rigid_body_constraint.use_breaking = True
    bpy.ops.reeb_parts.rigid_bodies(joints="POINT")
    assert mine in bpy.data.objects[:]
    assert mine not in joints_of()
    assert [joint.rigid_body_constraint.type for joint in joints_of()] == ["POINT"] * count


def test_a_joint_that_was_given_a_body_of_the_users_is_kept(obj):
    """It was made anew between the pieces alone."""
    separated(obj)
    bpy.ops.reeb_parts.rigid_bodies()
    mine, holds = joints_of()[0], joints_of()[0].rigid_body_constraint
    holds.object2 = floor(-9)
    bpy.ops.reeb_parts.rigid_bodies()
    assert mine in bpy.data.objects[:]
    assert mine not in joints_of()
    assert mine.rigid_body_constraint.object2.name == "Floor"


def test_separate_again_takes_the_joints_of_earlier_pieces_away(obj):
    separated(obj)
    bpy.ops.reeb_parts.rigid_bodies()
    bpy.ops.reeb_parts.show_original()
    activate(obj)
    bpy.ops.reeb_parts.separate()
    assert [o for o in bpy.data.objects if o.get("reeb_parts_role") == "joint"] == []
    assert bodies() == []


def test_parts_that_are_not_separated_are_refused(obj):
    bpy.ops.reeb_parts.decompose()
    assert not bpy.ops.reeb_parts.rigid_bodies.poll()


@pytest.mark.parametrize(("before", "after"), [(5, 2), (2, 5)])
def test_pieces_of_other_parts_than_are_shown_are_refused(obj, before, after):
    """Where the detail had changed, bodies or joints were missing without a word."""
    bpy.ops.reeb_parts.decompose(n_parts=before)
    bpy.ops.reeb_parts.separate()
    obj.data.reeb_parts.n_parts = after
    there = snapshot()
    with pytest.raises(RuntimeError, match="of Tree are of other parts than are shown now"):
        bpy.ops.reeb_parts.rigid_bodies()
    assert snapshot() == there
    obj.data.reeb_parts.n_parts = before
    assert bpy.ops.reeb_parts.rigid_bodies() == {"FINISHED"}
    assert len(bodies()) == before


def test_some_of_the_pieces_become_bodies(obj):
    """Of chosen parts alone, and where one is deleted; also if they are of a version that kept numbers only."""
    bpy.ops.reeb_parts.decompose(n_parts=5)
    for part in obj.data.reeb_parts.parts[:3]:
        part.selected = True
    bpy.ops.reeb_parts.separate(which="CHOSEN")
    pieces = [o for o in bpy.data.objects if "reeb_parts_number" in o]
    activate(pieces[1])
    bpy.data.objects.remove(pieces[0])
    for piece in pieces[1:]:
        del piece["reeb_parts_faces"]
    assert bpy.ops.reeb_parts.rigid_bodies() == {"FINISHED"}
    assert set(bodies()) == set(pieces[1:])


def test_undo(obj):
    separated(obj)
    check_undo(bpy.ops.reeb_parts.rigid_bodies)
    bpy.ops.ed.undo()
    assert bpy.context.scene.rigidbody_world is None
    assert bodies() == []


def test_a_piece_with_pieces_of_its_own_gives_bodies_of_these(obj):
    """Its original's pieces, of which it is one, became bodies."""
    bpy.ops.reeb_parts.decompose(n_parts=2)
    bpy.ops.reeb_parts.separate(hide=False)
    piece = max((item for item in bpy.data.collections["Parts of Tree"].objects if "reeb_parts_number" in item),
                key=lambda item: len(item.data.polygons))
    activate(piece)
    bpy.ops.reeb_parts.decompose(n_parts=3)
    bpy.ops.reeb_parts.separate(hide=False)
    activate(piece)
    bpy.ops.reeb_parts.rigid_bodies()
    bodies = {item for item in bpy.data.objects if item.rigid_body}
    assert len(bodies) == 3
    assert bodies <= set(bpy.data.collections[f"Parts of {piece.name}"].objects)
