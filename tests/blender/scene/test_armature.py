# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.armature: a bone for each part, which moves the part."""

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Euler
from snapshot import check_undo, snapshot


def rig_of(obj):
    (rig,) = [o for o in bpy.data.objects if o.type == "ARMATURE" and "reeb_parts_role" in o]
    return rig


def world(obj):
    """Points as the viewport shows them, in the world."""
    bpy.context.view_layer.update()
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = np.zeros(3 * len(evaluated.data.vertices), np.float32)
    evaluated.data.vertices.foreach_get("co", points)
    matrix = np.array(obj.matrix_world)
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def numbers_of(obj):
    values = np.zeros(len(obj.data.polygons), np.int32)
    obj.data.attributes["reeb_part"].data.foreach_get("value", values)
    return values


def test_a_bone_for_each_part_in_one_tree(obj):
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.armature() == {"FINISHED"}
    bones = rig_of(obj).data.bones
    assert sorted(bones.keys()) == [part.group for part in obj.data.reeb_parts.parts]
    assert sum(bone.parent is None for bone in bones) == 1
    assert min(bone.length for bone in bones) > 0.01
    assert not obj.modifiers


def test_a_bone_starts_at_the_cut_and_ends_in_the_tip(make):
    """A dumbbell in three parts: the neck is a bone between the balls, or one ball is the body."""
    obj = make(shapes.tube_tree())
    obj.scale, obj.location, obj.rotation_euler = (1, 2, -1), (3, 4, 5), (0.3, 0.5, 0.7)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    rig, points, numbers = rig_of(obj), world(obj), numbers_of(obj)
    assert tuple(rig.scale) == pytest.approx((1, 1, 1))
    for part in obj.data.reeb_parts.parts:
        bone = rig.data.bones[part.group]
        if bone.parent is None or bone.children:
            continue
        mine = {v for p in obj.data.polygons if numbers[p.index] == part.number for v in p.vertices}
        others = {v for p in obj.data.polygons if numbers[p.index] != part.number for v in p.vertices}
        cut, part_points = points[sorted(mine & others)], points[sorted(mine)]
        head = np.array(rig.matrix_world @ bone.head_local)
        tail = np.array(rig.matrix_world @ bone.tail_local)
        size = np.linalg.norm(np.ptp(part_points, axis=0))
        assert np.linalg.norm(head - cut.mean(axis=0)) < 0.25 * size
        assert (tail > part_points.min(axis=0) - 0.1 * size).all()
        assert (tail < part_points.max(axis=0) + 0.1 * size).all()
        assert np.linalg.norm(tail - head) > 0.2 * size


def test_at_rest_nothing_moves_and_a_turned_bone_moves_its_part(obj):
    obj.location = (1, 2, 3)
    bpy.ops.reeb_parts.decompose()
    before = world(obj)
    bpy.ops.reeb_parts.armature(deform=True)
    assert world(obj) == pytest.approx(before, abs=1e-4)
    rig = rig_of(obj)
    leaf = next(bone for bone in rig.pose.bones if bone.parent and not bone.children)
    leaf.rotation_mode = "XYZ"
    leaf.rotation_euler = Euler((0.5, 0, 0))
    moved = np.linalg.norm(world(obj) - before, axis=1) > 1e-4
    number = next(part.number for part in obj.data.reeb_parts.parts if part.group == leaf.name)
    mine = {v for p in obj.data.polygons if numbers_of(obj)[p.index] == number for v in p.vertices}
    assert set(np.flatnonzero(moved).tolist()) <= mine
    assert moved.sum() > 0.8 * len(mine)


def test_groups_are_made_if_they_are_not_there(obj):
    bpy.ops.reeb_parts.decompose(vertex_groups=False)
    bpy.ops.reeb_parts.armature()
    assert sorted(rig_of(obj).data.bones.keys()) == obj.vertex_groups.keys()
    assert len(obj.vertex_groups) == len(obj.data.reeb_parts.parts)


def test_loose_parts_have_roots_of_their_own(make):
    obj = make(shapes.together(shapes.tube_tree(), shapes.moved(shapes.icosphere(2), (9, 0, 0))))
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    assert sum(bone.parent is None for bone in rig_of(obj).data.bones) == 2


def test_twice_is_once_and_a_used_armature_is_kept(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(deform=True)
    once = snapshot()
    bpy.ops.reeb_parts.armature(deform=True)
    assert snapshot() == once
    rig = rig_of(obj)
    rig.location.x = 1
    bpy.ops.reeb_parts.armature(deform=True)
    assert rig in bpy.data.objects[:]
    assert rig_of(obj) != rig
    assert obj.modifiers.keys() == ["Reeb Parts Armature"]


def test_clear_removes_the_modifier_and_leaves_the_armature(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(deform=True)
    bpy.ops.reeb_parts.clear()
    assert not obj.modifiers
    assert rig_of(obj)


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT"])
def test_from_every_mode(obj, mode):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.reeb_parts.armature()
    assert obj.mode == mode
    assert bpy.context.view_layer.objects.active == obj
    assert len(rig_of(obj).data.bones) == len(obj.data.reeb_parts.parts)


def test_undo(obj):
    bpy.ops.reeb_parts.decompose()
    check_undo(lambda: bpy.ops.reeb_parts.armature(deform=True))
