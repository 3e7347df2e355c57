# SPDX-License-Identifier: GPL-3.0-or-later
"""Armatures and names of half models: those of the whole that is seen, with left and right."""

from pathlib import Path

import bmesh
import bpy
import numpy as np
import pytest
import shapes
from mathutils import Euler, Matrix
from roles import the_rig
from snapshot import check_undo

DEFORM = "DEF-"
SPOT = Path(__file__).resolve().parents[4] / "models" / "spot.obj"


@pytest.fixture
def figure():
    return shapes.mirrored_figure()


@pytest.fixture
def half(make, figure):
    obj = make(shapes.half_of(figure), "Figure")
    obj.modifiers.new("Mirror", "MIRROR")
    return obj


def rigged(obj, **options):
    """The armature of an object, which is decomposed first and gets the suggested names."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.suggest_names()
    assert bpy.ops.reeb_parts.armature(**options) == {"FINISHED"}
    return the_rig()


def seen(obj):
    """Points as the viewport shows them, in the object's coordinates."""
    bpy.context.view_layer.update()
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    return np.array([vertex.co for vertex in mesh.vertices])


def bent(rig, name, angle=0.6):
    bone = rig.pose.bones[name]
    bone.rotation_mode, bone.rotation_euler = "XYZ", Euler((angle, 0, 0))


def sided(rig):
    return [bone.name for bone in rig.data.bones if bone.name.endswith((".L", ".R"))]


def nearest(points, others):
    """How far each point is from the nearest of others."""
    return np.linalg.norm(points[:, None] - others, axis=2).min(axis=1)


def test_a_half_has_the_names_of_the_whole(make, figure, half):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.suggest_names()
    found = {part.name for part in half.data.reeb_parts.parts}
    assert found == {"body", "head", "arm.L", "leg.L"}
    whole = make(figure, "Whole")
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.suggest_names()
    assert {part.name for part in whole.data.reeb_parts.parts} == found | {bpy.utils.flip_name(name) for name in found}


def as_it_is(obj):
    pass


def elsewhere(obj):
    obj.scale, obj.rotation_euler, obj.location = (1.5, 0.7, 2.0), (0.3, 1.0, -0.4), (1, 2, 3)


def the_other_side(obj):
    obj.data.transform(Matrix.Scale(-1, 4, (1, 0, 0)))
    obj.data.flip_normals()


@pytest.mark.parametrize("change", [as_it_is, elsewhere, the_other_side])
def test_bones_are_mirror_images_and_those_of_the_middle_lie_there(half, change):
    change(half)
    rig = rigged(half)
    assert len(sided(rig)) >= 4
    to_object = half.matrix_world.inverted() @ rig.matrix_world
    for bone in rig.data.bones:
        ends = [np.array(to_object @ end) for end in (bone.head_local, bone.tail_local)]
        image = rig.data.bones[bpy.utils.flip_name(bone.name)]
        for mine, other in zip(ends, (image.head_local, image.tail_local), strict=True):
            assert mine * (-1, 1, 1) == pytest.approx(np.array(to_object @ other), abs=1e-5)
        if image == bone:
            assert bone.parent is None or bone.parent.name not in sided(rig)
        else:
            assert (ends[1][0] > 0) == bone.name.endswith(".L")
            assert bpy.utils.flip_name(bone.parent.name) == image.parent.name


@pytest.mark.parametrize("weights", ["SMOOTH", "AUTOMATIC", "PARTS"])
def test_a_bone_of_one_side_moves_that_side(half, weights):
    """Near the middle, where weights change smoothly, the other side follows a little; with stiff parts not at all."""
    rig = rigged(half, weights=weights)
    rest = seen(half)
    assert len(sided(rig)) >= 4
    for name in sided(rig):
        bent(rig, name)
        moved = np.linalg.norm(seen(half) - rest, axis=1)
        bent(rig, name, 0.0)
        mine = rest[:, 0] * (1 if name.endswith(".L") else -1)
        assert moved[mine > 0].max() > 0.2, name
        assert moved[mine < 0].max() < (1e-5 if weights == "PARTS" else 0.2 * moved.max()), name


@pytest.mark.parametrize("weights", ["SMOOTH", "AUTOMATIC", "PARTS"])
def test_bent_alike_both_sides_stay_images(half, weights):
    rig = rigged(half, weights=weights)
    for bone in rig.pose.bones:
        bent(rig, bone.name, 0.4)
    points = seen(half)
    assert nearest(points * (-1, 1, 1), points).max() < 1e-4
    assert np.abs(points[:, 0]).max() > 0.5


def test_every_vertex_has_weights_and_every_group_its_image(half):
    rig = rigged(half)
    groups = [group.name for group in half.vertex_groups if group.name.startswith(DEFORM)]
    assert sorted(groups) == sorted(rig.data.bones.keys())
    assert {bpy.utils.flip_name(name) for name in groups} == set(groups)
    index = {half.vertex_groups[name].index for name in groups}
    for vertex in half.data.vertices:
        weights = [entry.weight for entry in vertex.groups if entry.group in index and entry.weight > 0]
        assert sum(weights) == pytest.approx(1, abs=1e-6)
        assert len(weights) <= 4
    assert seen(half) == pytest.approx(seen_at_rest(half), abs=1e-5)


def seen_at_rest(obj):
    """What is seen without our modifier."""
    modifier = obj.modifiers["Reeb Parts Armature"]
    modifier.show_viewport = False
    found = seen(obj)
    modifier.show_viewport = True
    return found


def test_a_name_with_a_side_is_that_of_the_side_that_is_there(half):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.suggest_names()
    arm = next(part for part in half.data.reeb_parts.parts if part.name == "arm.L")
    arm.name = "Arm.R"
    bpy.ops.reeb_parts.armature()
    bones = the_rig().data.bones
    assert bones[f"{DEFORM}Arm.R"].tail_local.x > 0 > bones[f"{DEFORM}Arm.L"].tail_local.x


def test_a_group_of_the_user_is_left_alone_and_pairs_stay_pairs(half):
    name = f"{DEFORM}arm.R"
    half.vertex_groups.new(name=name).add([0], 0.25, "REPLACE")
    rig = rigged(half)
    assert {f"{DEFORM}arm.L.001", f"{DEFORM}arm.R.001"} < set(rig.data.bones.keys())
    assert half.vertex_groups[name].weight(0) == 0.25
    bpy.ops.reeb_parts.clear()
    assert half.vertex_groups.keys() == [name]


def test_long_names_keep_their_sides(half):
    bpy.ops.reeb_parts.decompose()
    for part in half.data.reeb_parts.parts:
        part.name = f"{part.number}" + "a long name " * 5
    bpy.ops.reeb_parts.armature()
    assert len(sided(the_rig())) == 4


def test_while_the_mirror_is_hidden_all_is_as_for_any_model(half):
    bpy.ops.reeb_parts.decompose()
    half.modifiers["Mirror"].show_viewport = False
    bpy.ops.reeb_parts.armature()
    assert len(the_rig().data.bones) == len(half.data.reeb_parts.parts)
    assert not sided(the_rig())


def test_undo(half):
    bpy.ops.reeb_parts.decompose()
    check_undo(lambda: bpy.ops.reeb_parts.armature())


@pytest.mark.parametrize("detail", [0.8, 1.0])
def test_a_half_in_many_parts_gets_its_bones(detail):
    """Some images hang on what they do not touch."""
    bpy.ops.wm.obj_import(filepath=str(SPOT))
    mesh = bpy.context.object.data
    edited = bmesh.new()
    edited.from_mesh(mesh)
    bmesh.ops.bisect_plane(edited, geom=[*edited.verts, *edited.edges, *edited.faces], plane_co=(0, 0, 0),
                           plane_no=(1, 0, 0), clear_inner=True)
    bmesh.ops.dissolve_degenerate(edited, edges=edited.edges, dist=1e-5)
    edited.to_mesh(mesh)
    edited.free()
    bpy.context.object.modifiers.new("Mirror", "MIRROR")
    bpy.ops.reeb_parts.decompose(detail=detail)
    assert bpy.ops.reeb_parts.armature() == {"FINISHED"}
    assert 1 < len(the_rig().data.bones) < len(mesh.reeb_parts.parts)
