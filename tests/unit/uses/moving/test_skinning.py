# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights of bones: smooth, few, fair to all sides of a joint; and what bending does to faces."""

import numpy as np
import pytest
import shapes
from scipy.sparse import csr_array

from core import decompose
from core.mesh.corners import CornerTable
from core.uses.moving import skinning
from core.uses.moving.bone_trees import following
from core.uses.moving.bones import Bones, BoneSurface
from core.uses.moving.limbs import limb_bones
from core.uses.moving.skinning import bends, limited, smooth_weights, turned_over


def rod(length=12.0, around=24, along=97):
    """A tube of radius 1 along x from -length/2 to length/2, its faces in three parts of equal length."""
    angle, x = np.meshgrid(2 * np.pi * np.arange(around) / around, np.linspace(-length / 2, length / 2, along))
    vertices = np.stack([x, np.cos(angle), np.sin(angle)], axis=2).reshape(-1, 3)
    here = np.arange(around * (along - 1)).reshape(-1, around)
    beside = np.roll(here, -1, axis=1)
    faces = np.stack([here, beside, beside + around, here + around], axis=2).reshape(-1, 4)
    middle = vertices[faces].mean(axis=1)[:, 0]
    return CornerTable.of(vertices, faces), np.digitize(middle, [-length / 6, length / 6])


def chain(*joints):
    """Bones along x from joint to joint."""
    head = np.array([(x, 0.0, 0.0) for x in joints[:-1]])
    tail = np.array([(x, 0.0, 0.0) for x in joints[1:]])
    parent = np.arange(len(head)) - 1
    return Bones(head, tail, parent, parent >= 0, tuple(range(len(head))))


def dense(weights, count):
    full = np.zeros((len(weights.bone), count + 1))
    np.add.at(full, (np.arange(len(full))[:, None], weights.bone), weights.weight)
    return full[:, :count]


def test_half_and_half_at_the_joint_all_far_from_it():
    table, labels = rod()
    found = dense(smooth_weights(table, labels, chain(-6, -2, 2, 6)), 3)
    x = table.vertices[:, 0]
    assert found.sum(axis=1) == pytest.approx(1, abs=1e-12)
    assert found[np.isclose(x, -2), :2] == pytest.approx(0.5, abs=0.01)
    assert found[x < -2 - 1.7, 0] == pytest.approx(1)
    assert found[np.abs(x) < 0.3, 1] == pytest.approx(1)
    # Along the rod what is beyond the first joint only grows, and no step is larger than 1 / (60 degrees).
    rings = 1 - found[:, 0].reshape(-1, 24).mean(axis=1)
    assert (np.diff(rings) > -1e-9).all()
    assert np.diff(rings).max() < (x.reshape(-1, 24)[1, 0] - x[0]) / (np.pi / 3)
    # The rod is the same from both ends.
    assert found[:, 0].reshape(-1, 24) == pytest.approx(found[:, 2].reshape(-1, 24)[::-1], abs=0.002)


@pytest.mark.parametrize("length", [1.0, 1.375, 1.5, 2.0])
def test_a_part_that_ends_just_within_reach_has_weights(length):
    """The ear of a cow, 0.93 of the reach long, was moved by no bone of its own: nothing held its end."""
    table, _ = rod()
    x = table.vertices[:, 0]
    labels = (table.face_means(table.vertices)[:, 0] > 6 - length).astype(int)
    beyond = dense(smooth_weights(table, labels, chain(-6, 6 - length, 6)), 2)[:, 1]
    assert beyond[np.isclose(x, 6 - length)] == pytest.approx(0.5, abs=0.01)
    assert (beyond[np.isclose(x, 6)] > 0.7).all()


def test_a_part_that_only_touches_its_parent_goes_with_its_own_bone():
    """A hand, a hat: between pieces there is no border, and no bone but the root's moved anything."""
    row = shapes.together(*(shapes.moved(shapes.box(), (x, 0, 0)) for x in (-2, -1, 0)))
    labels = np.repeat([0, 1, 2], len(row[1]) // 3)
    table = CornerTable.of(*row)
    found = dense(smooth_weights(table, labels, chain(-2, -1, 0, 1)), 3)
    assert (found[table.corner_vertex] == np.eye(3)[labels[table.corner_face]]).all()


def test_no_face_is_turned_over_by_60_degrees():
    table, labels = rod()
    bones = chain(-6, -2, 2, 6)
    found = dense(smooth_weights(table, labels, bones), 3)
    for bone, share in ((1, found[:, 1] + found[:, 2]), (2, found[:, 2])):
        assert not turned_over(table, share, bones.head[bone], np.array([1.0, 0, 0]), np.pi / 3).any()
        assert turned_over(table, (share > 0.5).astype(float), bones.head[bone], np.array([1.0, 0, 0]), 2.5).any()


def turned_faces(table, labels, bones):
    """How many faces some joint turns over when it is bent by 60 degrees."""
    found, turned = dense(smooth_weights(table, labels, bones), len(bones.head)), np.zeros(table.n_faces, bool)
    for bone in np.flatnonzero(bones.parent >= 0):
        share = found[:, following(bones.parent, bones.order)[bone]].sum(axis=1)
        turned |= turned_over(table, share, bones.head[bone], bones.tail[bone] - bones.head[bone], np.pi / 3)
    return turned.sum()


def test_where_faces_turn_over_the_surface_is_made_stiffer(monkeypatch):
    """For 60 degrees weights must change over pi / 6 radii on either side, and evenly if over hardly more."""
    table, labels = rod()
    bones = chain(-6, -2, 2, 6)
    monkeypatch.setattr(skinning, "WAYS", [(0.54, 0.0)])
    assert turned_faces(table, labels, bones) == 0
    _, turned = next(skinning._tries(table, labels, bones))  # before any face is
    assert turned > 0


def test_where_that_is_in_vain_other_ways_are_gone_and_the_best_kept(monkeypatch):
    table, labels = rod()
    bones = chain(-6, -2, 2, 6)

    def with_ways(*ways):
        monkeypatch.setattr(skinning, "WAYS", [(reach, 0.0) for reach in ways])
        return dense(smooth_weights(table, labels, bones), 3), turned_faces(table, labels, bones)

    nearest, turned = with_ways(0.1)  # within two rings of faces
    assert 0 < turned < with_ways(0.3)[1]
    for ways, best in (((0.3, 0.1), nearest), ((0.1, 0.3), nearest), ((0.3, 1.6), with_ways(1.6)[0])):
        np.testing.assert_array_equal(with_ways(*ways)[0], best)


def test_many_short_bones_bend_though_a_vertex_has_only_four():
    table, _ = rod()
    ends = np.linspace(-6, 6, 21)
    labels = np.digitize(table.face_means(table.vertices)[:, 0], ends[1:-1])
    assert turned_faces(table, labels, chain(*ends)) == 0


@pytest.mark.parametrize("seed", range(2))
def test_weights_do_not_depend_on_order_pose_or_size(seed):
    rng = np.random.default_rng(seed)
    table, labels = rod(along=49)
    bones = chain(-6, -2, 2, 6)
    known = dense(smooth_weights(table, labels, bones), 3)
    turn, shift = np.linalg.qr(rng.normal(size=(3, 3)))[0], rng.normal(size=3)
    place, order = rng.permutation(len(table.vertices)), rng.permutation(len(labels))
    points = np.empty_like(table.vertices)
    points[place] = 9.0 * table.vertices @ turn.T + shift
    faces = place[table.corner_vertex.reshape(-1, 4)][order]
    moved = Bones(9.0 * bones.head @ turn.T + shift, 9.0 * bones.tail @ turn.T + shift, bones.parent, bones.connected,
                  bones.order)
    found = dense(smooth_weights(CornerTable.of(points, faces), labels[order], moved), 3)
    assert found[place] == pytest.approx(known, abs=2 / 1024)


def unjoined(table, apart):
    """The table where some vertices, (n,) bool, are apart for each of their corners; which vertex each was."""
    corner = apart[table.corner_vertex]
    own = np.where(corner, len(apart) + np.cumsum(corner) - 1, table.corner_vertex)
    source = np.concatenate([np.arange(len(apart)), table.corner_vertex[corner]])
    return CornerTable.of(table.vertices[source], own.reshape(-1, 4)), source


@pytest.mark.parametrize("share", [0.1, 0.5, 1.0])
def test_seams_of_textures_and_normals_do_not_tear(share):
    table, labels = rod(along=49)
    other, source = unjoined(table, np.random.default_rng(0).random(len(table.vertices)) < share)
    height = table.vertices[:, 0]
    bones, part_bone = limbs(table, labels, height)
    again, other_bone = limbs(other, labels, height[source])
    assert other_bone.tolist() == part_bone.tolist()
    np.testing.assert_allclose(again.head, bones.head, atol=1e-9)
    used = np.unique(other.corner_vertex)
    np.testing.assert_allclose(dense(smooth_weights(other, labels, again), 3)[used],
                               dense(smooth_weights(table, labels, bones), 3)[source[used]], atol=1.5 / 1024)


def test_trees_apart_do_not_move_each_other():
    vertices, faces = shapes.icosphere(1)
    table = CornerTable.of(np.concatenate([vertices, vertices + 3]), np.concatenate([faces, faces + len(vertices)]))
    apart = Bones(np.zeros((2, 3)), np.ones((2, 3)), np.array([-1, -1]), np.zeros(2, bool), (0, 1))
    found = dense(smooth_weights(table, np.repeat([0, 1], len(faces)), apart), 2)
    assert (found == np.repeat(np.eye(2), len(vertices), axis=0)).all()


def test_only_the_four_largest_are_kept():
    found = limited(np.array([[5.0, 1, 4, 2, 3], [0, 0, 0, 0, 0], [0, 0, 2, 0, 0]]))
    assert found.bone.tolist() == [[0, 2, 4, 3], [-1] * 4, [2, -1, -1, -1]]
    assert found.weight[0] == pytest.approx(np.array([5, 4, 3, 2]) / 14, abs=1 / 1024)
    assert found.weight.sum(axis=1).tolist() == [1, 0, 1]


def less_fifth(mass, fifth):
    """``limited``, less a share of the fifth largest of each vertex."""
    vertex, bone = np.nonzero(mass)
    return skinning._limited(vertex, bone, mass[vertex, bone], len(mass), fifth)


def test_weights_without_the_fifth_change_as_slowly_as_what_they_are_made_of():
    share = np.linspace(0, 1, 2001)[:, None]
    mass = (1 - share) * [6.0, 3, 3, 2, 1, 0] + share * [6.0, 3, 3, 1, 2, 0]  # one bone takes the place of another

    def largest_step(fifth):
        return np.abs(np.diff(less_fifth(mass, fifth).of_bones(6), axis=0)).max()

    assert largest_step(0.0) > 0.09
    assert largest_step(1.0) < 3 / 1024
    assert less_fifth(np.ones((1, 6)), 1.0).weight == pytest.approx(0.25, abs=1 / 1024)  # equal ones are not lost


def test_a_needle_is_not_turned_over():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [2, 1e-7, 0], [1, 1, 0]])
    table = CornerTable.of(points, np.array([[0, 1, 2], [1, 2, 3]]))
    joint, along = np.array([0.0, 0, 5]), np.array([0.0, 1, 0])
    share = np.array([0.0, 1, 0, 0])
    assert turned_over(table, share, joint, along, 3.0).tolist() == [False, True]
    thicker = CornerTable.of(points * [1, 1e3, 1], np.array([[0, 1, 2], [1, 2, 3]]))
    assert turned_over(thicker, share, joint, along, 3.0)[0]


def test_bends_are_rotations_across_the_bone():
    for turn in bends(np.array([1.0, 2.0, 3.0]), np.pi / 3):
        assert turn @ turn.T == pytest.approx(np.eye(3))
        assert (np.trace(turn), np.linalg.det(turn)) == (pytest.approx(2), pytest.approx(1))
        direction = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
        assert direction @ turn @ direction == pytest.approx(0.5)


def limbs(table, labels, height):
    """Bones of the parts that can be bent, and the bone of each face."""
    area = np.linalg.norm(table.face_vectors(), axis=1)
    bones, bone_part, part_bone = limb_bones(
        BoneSurface(table, labels, area, height, np.empty((0, 3)), np.empty(0, np.int64)))
    assert (part_bone[bone_part] == np.arange(len(bone_part))).all()
    return bones, part_bone


def test_a_slice_hangs_on_its_neighbor_and_a_limb_has_a_bone():
    table, _ = rod()
    x = table.face_means(table.vertices)[:, 0]
    _, part_bone = limbs(table, np.digitize(x, [-2, 2]), table.vertices[:, 0])
    assert part_bone.tolist() == [0, 1, 2]
    _, part_bone = limbs(table, np.digitize(x, [-2, 5.5]), table.vertices[:, 0])  # a quarter of its width thick
    assert part_bone.tolist() == [0, 1, 1]
    bones, part_bone = limbs(table, np.digitize(x, [5, 5.5]), table.vertices[:, 0])  # one after the other
    assert part_bone.tolist() == [0, 0, 0]
    assert len(bones.head) == 1


def test_a_joint_is_in_the_middle_of_all_that_divides_its_sides():
    """A limb that meets two other parts around its rim turns about the middle of the rim."""
    table, _ = rod()
    center = table.face_means(table.vertices)
    labels = np.where(center[:, 0] > 2, 2, (center[:, 1] + 0.2 > 0).astype(int))
    bones, part_bone = limbs(table, labels, table.vertices[:, 0])
    assert part_bone[2] > 0
    assert bones.head[part_bone[2]] == pytest.approx([2, 0, 0], abs=1e-9)


@pytest.mark.parametrize(("shape", "count"), [(shapes.tube_tree(), 8), (shapes.torus(), 8), (shapes.dumbbell(), 7),
                                              (shapes.horse(0.09), 8)])
def test_every_joint_there_is_bends_by_60_degrees_and_keeps_the_volume(shape, count):
    vertices, faces = shape
    table = CornerTable.of(vertices, faces)
    found = decompose(vertices, faces)
    labels = found.parts(n_parts=min(count, found.n_candidates)).labels
    bones, part_bone = limbs(table, labels, found.field)
    found = dense(smooth_weights(table, part_bone[labels], bones), len(bones.head))

    for bone in np.flatnonzero(bones.parent >= 0):
        share = found[:, following(bones.parent, bones.order)[bone]].sum(axis=1)
        along = bones.tail[bone] - bones.head[bone]
        assert not turned_over(table, share, bones.head[bone], along, np.pi / 3).any()
        for turn in bends(along, np.pi / 3):
            moved = vertices + share[:, None] * ((vertices - bones.head[bone]) @ (turn - np.eye(3)).T)
            assert shapes.volume(moved, faces) == pytest.approx(shapes.volume(vertices, faces), rel=0.1)


def test_a_vertex_that_hangs_on_nothing_keeps_its_share():
    """As one whose faces have no area: the system was singular, and no armature was made."""
    laplacian = csr_array(np.diag([1.0, 2.0, 2.0, 2.0, 1.0, 0.0]) - np.diag([1.0] * 4 + [0.0], 1)
                          - np.diag([1.0] * 4 + [0.0], -1))
    joint = skinning._Joint(0, np.array([1, 2, 3, 5]), np.array([0.95, 0.0, 0.95, 0.5]),
                            np.array([-1, -1, 0, 1, 1, 1], np.int8), {1: True, -1: True})
    share = np.array([0.0, 0.25, 0.5, 0.75, 1.0, 0.75])
    eased = 0.5 * share + 0.5 * share**2 * (3 - 2 * share)
    np.testing.assert_allclose(joint.odds(laplacian), eased / np.maximum(1 - eased, 1e-9), rtol=1e-6)
