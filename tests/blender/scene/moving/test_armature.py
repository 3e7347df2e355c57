# SPDX-License-Identifier: GPL-3.0-or-later
"""reeb_parts.armature: a bone for each part, which moves the part, smoothly across its cuts."""

import bpy
import numpy as np
import pytest
import shapes
from mathutils import Euler
from places import seen_points
from results import numbers as numbers_of
from roles import the_rig
from scipy.spatial import cKDTree
from snapshot import activate, check_undo, snapshot

DEFORM = "DEF-"


def test_a_bone_for_each_part_in_one_tree(obj):
    bpy.ops.reeb_parts.decompose()
    assert bpy.ops.reeb_parts.armature() == {"FINISHED"}
    bones = the_rig().data.bones
    assert sorted(bones.keys()) == [DEFORM + part.name for part in obj.data.reeb_parts.parts]
    assert sum(bone.parent is None for bone in bones) == 1
    assert min(bone.length for bone in bones) > 0.01
    assert [modifier.object for modifier in obj.modifiers] == [the_rig()]
    bpy.ops.reeb_parts.armature(deform=False)
    assert not obj.modifiers


@pytest.mark.parametrize("detail", [0.5, 0.9])
def test_bones_of_a_posed_figure_are_there_on_both_sides(make, detail):
    """No plane says so, but the faces' images do."""
    vertices, faces = shapes.mirrored_figure()
    make(shapes.Shape(shapes.posed(vertices), faces))
    bpy.ops.reeb_parts.decompose(detail=detail)
    bpy.ops.reeb_parts.armature()
    bones = the_rig().data.bones
    assert sum(bone.name.endswith(".L") for bone in bones) > 1
    for bone in bones:
        image = bones[bpy.utils.flip_name(bone.name)]
        assert bone.parent is None or image.parent.name == bpy.utils.flip_name(bone.parent.name)


def test_a_bone_starts_at_the_cut_and_ends_in_the_tip(make):
    """A dumbbell in three parts: the neck is a bone between the balls, or one ball is the body."""
    obj = make(shapes.tube_tree())
    obj.scale, obj.location, obj.rotation_euler = (1, 2, -1), (3, 4, 5), (0.3, 0.5, 0.7)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    rig, points, numbers = the_rig(), seen_points(obj), numbers_of(obj.data)
    assert tuple(rig.scale) == pytest.approx((1, 1, 1))
    for part in obj.data.reeb_parts.parts:
        bone = rig.data.bones[DEFORM + part.name]
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
    before = seen_points(obj)
    bpy.ops.reeb_parts.armature(weights="PARTS")
    assert seen_points(obj) == pytest.approx(before, abs=1e-4)
    rig = the_rig()
    leaf = next(bone for bone in rig.pose.bones if bone.parent and not bone.children)
    leaf.rotation_mode = "XYZ"
    leaf.rotation_euler = Euler((0.5, 0, 0))
    moved = np.linalg.norm(seen_points(obj) - before, axis=1) > 1e-4
    number = next(part.number for part in obj.data.reeb_parts.parts if part.group == leaf.name)
    mine = {v for p in obj.data.polygons if numbers_of(obj.data)[p.index] == number for v in p.vertices}
    assert set(np.flatnonzero(moved).tolist()) <= mine
    assert moved.sum() > 0.8 * len(mine)


def test_another_armature_of_the_model_is_named(obj, capfd):
    """Its pose moves the model away from the new bones, and nothing said why they lie beside it."""
    rig = bpy.data.objects.new("Mine", bpy.data.armatures.new("Mine"))
    obj.modifiers.new("Armature", "ARMATURE").object = rig
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    assert "Tree is moved by Mine, too: the new bones lie where it is at rest" in capfd.readouterr().out


@pytest.mark.parametrize("weights", ["SMOOTH", "PARTS"])
def test_pieces_are_posed_as_the_whole(obj, weights):
    """Each has the groups of the bones that move it, and those of the user's, which may be empty."""
    obj.vertex_groups.new(name="Mine").lock_weight = True
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(weights=weights)
    bpy.ops.reeb_parts.separate(cut="FACES", hide=False)
    bone = next(bone for bone in the_rig().pose.bones if bone.parent and not bone.children)
    bone.rotation_mode, bone.rotation_euler = "XYZ", Euler((0.5, 0.0, 0.0))
    whole = cKDTree(seen_points(obj))
    for piece in obj.reeb_parts_made.pieces.objects:
        if piece.type == "MESH":
            assert whole.query(seen_points(piece))[0].max() < 1e-5
            used = {entry.group for vertex in piece.data.vertices for entry in vertex.groups}
            (mine,) = {group.index for group in piece.vertex_groups} - used
            assert piece.vertex_groups[mine].name == "Mine"
            assert piece.vertex_groups[mine].lock_weight


def weights_of(obj):
    """Weight of each vertex in the group of each bone, and what all are called."""
    names = [name for name in obj.vertex_groups.keys() if name in the_rig().data.bones]
    column = {obj.vertex_groups[name].index: i for i, name in enumerate(names)}
    found = np.zeros((len(obj.data.vertices), len(names)))
    for vertex in obj.data.vertices:
        for entry in vertex.groups:
            if entry.group in column:
                found[vertex.index, column[entry.group]] = entry.weight
    return found, names


@pytest.mark.parametrize("weights", ["SMOOTH", "AUTOMATIC"])
def test_weights_are_few_and_add_up(obj, weights):
    bpy.ops.reeb_parts.decompose()
    groups = obj.vertex_groups.keys()
    bpy.ops.reeb_parts.armature(weights=weights)
    found, names = weights_of(obj)
    assert names == [DEFORM + part.name for part in obj.data.reeb_parts.parts]
    assert found.sum(axis=1) == pytest.approx(1, abs=1e-6)
    assert (found > 0).sum(axis=1).max() <= 4
    assert obj.vertex_groups.keys() == [*groups, *names]
    if weights == "SMOOTH":  # across an edge no weight changes by much
        ends = np.array([edge.vertices[:] for edge in obj.data.edges])
        assert np.abs(found[ends[:, 0]] - found[ends[:, 1]]).max() < 0.35


@pytest.mark.parametrize("weights", ["SMOOTH", "AUTOMATIC", "PARTS"])
def test_a_floor_moves_by_its_own_bone_alone(make, weights):
    """By Blender's own weights it went with the limbs that stood on it, and these with it."""
    tree = shapes.tube_tree()
    floor = shapes.box((20, 20, 0.4))
    for _ in range(4):
        floor = shapes.subdivide(floor)
    low = tree.vertices[:, 2].min()
    obj = make(shapes.together(tree, shapes.moved(floor, (-10, -10, low - 0.4))))
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(weights=weights)
    found, names = weights_of(obj)
    number = numbers_of(obj.data)[-1]
    (ground,) = [names.index(DEFORM * (weights != "PARTS") + part.name) for part in obj.data.reeb_parts.parts
                 if part.number == number]
    is_floor = np.arange(len(found)) >= len(tree.vertices)
    np.testing.assert_array_equal(found[:, ground], is_floor)
    assert (found[is_floor] > 0).sum() == is_floor.sum()


@pytest.mark.parametrize("mirrored", [False, True])
def test_bent_by_60_degrees_no_face_is_turned_over(obj, mirrored):
    """Each joint, to four sides, as Blender poses it; the volume stays within a tenth."""
    obj.scale, obj.rotation_euler = (-1 if mirrored else 1, 1, 1), (0.1, 0.2, 0.3)
    bpy.ops.reeb_parts.decompose()
    before = seen_points(obj)
    bpy.ops.reeb_parts.armature()
    assert seen_points(obj) == pytest.approx(before, abs=1e-4)
    rig, faces = the_rig(), np.array([polygon.vertices[:] for polygon in obj.data.polygons])
    bones = [bone for bone in rig.pose.bones if bone.parent]
    assert bones
    for bone in bones:
        bone.rotation_mode = "XYZ"
        for turn in ((1, 0, 0), (-1, 0, 0), (0, 0, 1), (0, 0, -1)):
            bone.rotation_euler = Euler(np.radians(60) * np.array(turn, float))
            after = seen_points(obj)
            assert abs(shapes.volume(after, faces) / shapes.volume(before, faces) - 1) < 0.1
            bend = np.array(rig.matrix_world @ bone.matrix @ bone.bone.matrix_local.inverted()
                            @ rig.matrix_world.inverted())[:3, :3]
            rest = normals(before, faces)
            # A face looks as if it had not moved, or as if it had gone with the bone, or between the two.
            seen = [(normals(after, faces) * (rest @ way.T)).sum(axis=1) for way in (np.eye(3), bend)]
            assert (np.maximum(*seen) > 0).all()
        bone.rotation_euler = Euler()


def normals(points, faces):
    a, b, c = points[faces].transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def test_a_group_of_the_user_is_left_alone(obj):
    bpy.ops.reeb_parts.decompose()
    name = DEFORM + obj.data.reeb_parts.parts[0].name
    mine = obj.vertex_groups.new(name=name)
    mine.add([0, 1, 2], 0.25, "REPLACE")
    bpy.ops.reeb_parts.armature()
    assert name not in the_rig().data.bones
    assert weights_of(obj)[0].sum(axis=1) == pytest.approx(1, abs=1e-6)
    bpy.ops.reeb_parts.clear()
    assert obj.vertex_groups.keys() == [name]
    assert [obj.vertex_groups[name].weight(index) for index in range(3)] == [0.25] * 3


def test_groups_of_long_names_can_be_read(obj):
    """Behind DEF- there is no room for all of such a name; Blender 4.2 cut it off within a letter, and the names of all
    groups of the mesh were unreadable from then on."""
    bpy.ops.reeb_parts.decompose(detail=0.3)
    for part in obj.data.reeb_parts.parts:
        part.name = 21 * "足"
    bpy.ops.reeb_parts.armature()
    groups = obj.vertex_groups.keys()
    assert sorted(the_rig().data.bones.keys()) == sorted(name for name in groups if name.startswith(DEFORM))
    assert len(groups) == 2 * len(obj.data.reeb_parts.parts) > 2


def test_groups_are_made_if_they_are_not_there(obj):
    bpy.ops.reeb_parts.decompose(vertex_groups=False)
    bpy.ops.reeb_parts.armature(weights="PARTS")
    assert sorted(the_rig().data.bones.keys()) == obj.vertex_groups.keys()
    assert len(obj.vertex_groups) == len(obj.data.reeb_parts.parts)


def test_loose_parts_have_roots_of_their_own(make):
    make(shapes.together(shapes.tube_tree(), shapes.moved(shapes.icosphere(2), (9, 0, 0))))
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    assert sum(bone.parent is None for bone in the_rig().data.bones) == 2


@pytest.mark.parametrize("kind", ["LIMBS", "PARTS"])
def test_a_symmetric_model_has_symmetric_bones(make, kind):
    """Of one piece, and with a hat and shoes, or with a stick in one hand, as pieces of their own."""
    figure = shapes.mirrored_figure()
    shoes = [shapes.moved(shapes.box((0.5, 0.9, 0.2)), (x - 0.25, -0.4, -1.8)) for x in (-0.55, 0.55)]
    hat, stick = shapes.moved(shapes.icosphere(2, 0.4), (0, 0, 2.3)), shapes.moved(
        shapes.box((0.1, 0.1, 3.0)), (1.4, 0.05, -0.5))
    for shape, n_lone in ((figure, 0), (shapes.together(figure, hat, *shoes), 0), (shapes.together(figure, stick), 1)):
        obj = make(shape, f"Figure {len(shape.faces)} {kind}")
        obj.rotation_euler, obj.location, obj.scale = (0.3, 1.0, -0.4), (1, 2, 3), (1.5, 1.5, 1.5)
        bpy.ops.reeb_parts.decompose()
        bpy.ops.reeb_parts.armature(weights="SMOOTH" if kind == "LIMBS" else "PARTS")
        (rig,) = [modifier.object for modifier in obj.modifiers]
        turn = np.array(obj.matrix_world.inverted() @ rig.matrix_world)
        ends = np.array([[bone.head_local, bone.tail_local] for bone in rig.data.bones]) @ turn[:3, :3].T + turn[:3, 3]
        parent = np.array([rig.data.bones.find(bone.parent.name) if bone.parent else -1 for bone in rig.data.bones])
        assert (parent < 0).sum() == 1
        off = np.linalg.norm(ends[:, None] * (-1, 1, 1) - ends[None], axis=3).max(axis=2)
        image, even = off.argmin(axis=1), off.min(axis=1) < 1e-5
        assert even.sum() == len(even) - n_lone >= 5
        assert (np.where(parent < 0, -1, image[parent]) == parent[image])[even].all()


def test_a_linked_duplicate_does_not_take_the_weights_of_the_first(obj):
    """Weights belong to the mesh, which both have: bones of the first moved nothing from then on."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    bpy.ops.object.duplicate(linked=True)
    copy = bpy.context.object
    copy.modifiers.clear()
    before = snapshot()
    with pytest.raises(RuntimeError, match="shares its mesh"):
        bpy.ops.reeb_parts.armature()
    assert snapshot() == before
    copy.data = obj.data.copy()
    assert bpy.ops.reeb_parts.armature() == {"FINISHED"}
    assert [modifier.object for modifier in copy.modifiers] != [modifier.object for modifier in obj.modifiers]


def test_pieces_that_only_touch_have_a_bone_that_moves_each(make):
    """A robot of boxes: all bones but the root's moved nothing, since no edge is between two of its parts."""
    obj = make(shapes.together(*(shapes.moved(shapes.box(size), place) for size, place in (
        ((2, 1, 3), (0, 0, 0)), ((1, 1, 1), (0.5, 0, 3)), ((3, 0.4, 0.4), (2, 0.3, 2)), ((3, 0.4, 0.4), (-3, 0.3, 2)),
        ((0.5, 0.5, 3), (0, 0, -3)), ((0.5, 0.5, 3), (1.5, 0, -3))))))
    bpy.ops.reeb_parts.decompose(n_parts=6)
    bpy.ops.reeb_parts.armature()
    numbers = numbers_of(obj.data)
    for part in obj.data.reeb_parts.parts:
        group = obj.vertex_groups[DEFORM + part.name]
        mine = {v for p in obj.data.polygons if numbers[p.index] == part.number for v in p.vertices}
        assert {v.index for v in obj.data.vertices for g in v.groups if g.group == group.index and g.weight > 0} == mine


def test_twice_is_once_and_a_used_armature_is_kept(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(deform=True)
    once = snapshot()
    bpy.ops.reeb_parts.armature(deform=True)
    assert snapshot() == once
    rig = the_rig()
    rig.location.x = 1
    bpy.ops.reeb_parts.armature(deform=True)
    assert rig in bpy.data.objects[:]
    assert the_rig() != rig
    assert obj.modifiers.keys() == ["Reeb Parts Armature"]


USE = {
    "constraint": lambda rig: rig.constraints.new("COPY_LOCATION"),
    "bone collection": lambda rig: rig.data.collections.new("Left").assign(rig.data.bones[0]),
    "property of a bone": lambda rig: rig.data.bones[0].__setitem__("mine", 1),
    "setting of a bone": lambda rig: setattr(rig.data.bones[0], "use_deform", False),
    "property of a posed bone": lambda rig: rig.pose.bones[0].__setitem__("mine", 1),
    "pose": lambda rig: setattr(rig.pose.bones[0], "location", (0, 0, 1)),
    "lock": lambda rig: setattr(rig.pose.bones[0], "lock_rotation", (True, True, True)),
    "driver of a bone at rest": lambda rig: rig.data.bones[0].driver_add("bbone_curveinx"),
}


@pytest.mark.parametrize("use", USE)
def test_whatever_is_done_to_an_armature_it_is_kept(obj, use):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(deform=True)
    rig = the_rig()
    USE[use](rig)
    activate(obj)
    bpy.ops.reeb_parts.armature(deform=True)
    assert rig in bpy.data.objects[:]
    assert the_rig() != rig


def painted(obj):
    """Paint weights of a bone, as in Weight Paint; what all weights are then."""
    obj.vertex_groups[DEFORM + obj.data.reeb_parts.parts[0].name].add([0, 1, 2], 0.25, "REPLACE")
    return weights_by_name(obj)


def weights_by_name(obj):
    names = obj.vertex_groups.keys()
    return {(names[entry.group], vertex.index): entry.weight for vertex in obj.data.vertices
            for entry in vertex.groups if names[entry.group].startswith(DEFORM)}


def test_weights_that_were_painted_stay_with_their_armature(obj):
    """Another run replaced them, with hours of work."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    rig, weights = the_rig(), painted(obj)
    bones = rig.data.bones.keys()
    bpy.ops.reeb_parts.armature()
    assert rig in bpy.data.objects[:]
    assert the_rig() != rig
    assert rig.data.bones.keys() == bones
    assert not set(bones) & set(the_rig().data.bones.keys())
    assert weights.items() <= weights_by_name(obj).items()
    new = the_rig()
    bpy.ops.reeb_parts.armature()  # of the new ones nothing was changed
    assert new not in bpy.data.objects[:]
    assert weights.items() <= weights_by_name(obj).items()
    assert len(weights_by_name(obj)) < 3 * len(weights)
    bpy.ops.reeb_parts.clear()
    assert weights_by_name(obj) == weights


def test_clear_leaves_weights_that_were_painted_and_the_modifier(obj, capfd, tmp_path):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    rig, weights = the_rig().name, painted(obj)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "rig.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "rig.blend"))
    obj = bpy.data.objects["Tree"]
    bpy.ops.reeb_parts.clear()
    assert "weights of the armature were changed by hand and stay" in capfd.readouterr().out
    assert weights_by_name(obj) == weights
    assert [modifier.object.name for modifier in obj.modifiers] == [rig]
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    bpy.ops.reeb_parts.clear()
    assert weights_by_name(obj) == weights
    assert [modifier.object.name for modifier in obj.modifiers] == [rig]


@pytest.mark.parametrize("posed", [False, True])
def test_weights_of_an_edited_mesh_stay_if_the_armature_was_worked_on(obj, posed):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    rig = the_rig()
    if posed:
        rig.pose.bones[0].location = (0, 0, 1)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    bpy.ops.object.mode_set(mode="OBJECT")
    weights = weights_by_name(obj)
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    assert (rig in bpy.data.objects[:]) == posed
    assert (weights.items() <= weights_by_name(obj).items()) == posed
    names = {DEFORM + part.name for part in obj.data.reeb_parts.parts}
    assert (set(the_rig().data.bones.keys()) <= names) != posed


def test_a_modifier_that_was_given_another_armature_is_the_users(obj):
    """Another run gave it ours, and Clear took it away."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    mine = bpy.data.objects.new("Mine", bpy.data.armatures.new("Mine"))
    bpy.context.scene.collection.objects.link(mine)
    obj.modifiers["Reeb Parts Armature"].object = mine
    for _ in range(2):
        bpy.ops.reeb_parts.armature()
        assert obj.modifiers[0].object == mine
        assert len(obj.modifiers) == 2
    bpy.ops.reeb_parts.clear()
    assert [modifier.object for modifier in obj.modifiers] == [mine]


def test_undo_with_weights_that_were_painted(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    painted(obj)
    check_undo(bpy.ops.reeb_parts.armature)


def test_clear_removes_the_modifier_and_leaves_the_armature(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature(deform=True)
    bpy.ops.reeb_parts.clear()
    assert not obj.modifiers
    assert the_rig()


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT"])
def test_from_every_mode(obj, mode):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.reeb_parts.armature()
    assert obj.mode == mode
    assert bpy.context.view_layer.objects.active == obj
    assert len(the_rig().data.bones) == len(obj.data.reeb_parts.parts)


def test_undo(obj):
    bpy.ops.reeb_parts.decompose()
    check_undo(lambda: bpy.ops.reeb_parts.armature(deform=True))


def test_every_bone_has_vertices_however_small_its_part(obj):
    """Some had none, when a part ended just within reach of its joint, and others were not written for that."""
    bpy.ops.reeb_parts.decompose(n_parts=500)
    assert bpy.ops.reeb_parts.armature() == {"FINISHED"}
    used = {entry.group for vertex in obj.data.vertices for entry in vertex.groups if entry.weight > 0}
    bones = [group.index for group in obj.vertex_groups if group.name.startswith(DEFORM)]
    assert len(bones) > 2
    assert set(bones) <= used
    at_rest = seen_points(obj)
    np.testing.assert_allclose(at_rest, [obj.matrix_world @ v.co for v in obj.data.vertices], atol=1e-5)
