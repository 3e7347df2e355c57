# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones of parts, on parts small enough to see the answer."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.corners import CornerTable
from core.symmetry.plane import MirrorPlane
from core.uses.moving.bones import BoneSurface, part_bones
from core.uses.moving.limbs import limb_bones
from core.uses.moving.part_images import PartImages


def bones(centers, cuts, joints, line=(), line_part=(), height=None, length=None, twin=None, limbs=False, plane=True):
    """Parts of one face each, with the given middles; an edge of the given middle and length at each cut.

    limbs : what ``limb_bones`` says of them. plane : whether there is one, x = 0, if there are images.
    """
    count = len(centers)
    height = np.arange(count, dtype=float) if height is None else height
    vertices, edges, at_vertex = [], [], []
    corners = [[] for _ in range(count)]  # of each face: vertex, edge
    for cut, joint, size in zip(cuts, joints, length or np.ones(len(cuts)), strict=True):
        ends = len(vertices), len(vertices) + 1
        vertices += [np.add(joint, (0, 0, size / 2)), np.add(joint, (0, 0, -size / 2))]
        at_vertex += [0.0, 0.0]
        edges.append(ends)
        for face in cut:
            corners[face] += [(ends[0], len(edges) - 1), (ends[1], len(edges))]
        edges.append(ends[::-1])
    for face, center in enumerate(centers):  # one more vertex brings the middle and the height to where they should be
        n = len(corners[face]) + 1
        vertices.append(n * np.array(center, float) - sum((vertices[v] for v, _ in corners[face]), np.zeros(3)))
        at_vertex.append(n * height[face])
        corners[face].append((len(vertices) - 1, len(edges)))
        edges.append((len(vertices) - 1, len(vertices) - 1))
    vertex, edge = np.array([corner for face in corners for corner in face]).T
    face = np.repeat(np.arange(count), [len(found) for found in corners])
    table = CornerTable(np.array(vertices), np.array(edges), vertex, edge, face, count)
    mirror = MirrorPlane(np.array([1.0, 0, 0]), 0.0) if plane else None
    images = None if twin is None else PartImages(np.array(twin), mirror)
    return (limb_bones if limbs else part_bones)(BoneSurface(
        table, np.arange(count), np.ones(count), np.array(at_vertex), np.array(line, float).reshape(-1, 3),
        np.array(line_part, int), images))


def test_an_arm_of_three_parts_is_a_chain():
    """Body, upper arm, lower arm along x: each bone ends where the next begins."""
    made = bones([(0, 0, 0), (3, 0, 0), (5, 0, 0)], [(0, 1), (1, 2)], [(2, 0, 0), (4, 0, 0)],
                 line=[(5, 0, 0), (6, 0, 0)], line_part=[2, 2])
    assert made.parent.tolist() == [-1, 0, 1]
    assert made.head.tolist() == [[0, 0, 0], [2, 0, 0], [4, 0, 0]]
    assert made.tail.tolist() == [[2, 0, 0], [4, 0, 0], [6, 0, 0]]
    assert made.connected.tolist() == [False, True, True]


def test_the_body_is_the_lowest_part():
    made = bones([(0, 0, 0), (3, 0, 0)], [(0, 1)], [(2, 0, 0)], height=[1, 0])
    assert made.parent.tolist() == [1, -1]


def test_a_palm_ends_amid_its_fingers():
    """Body, palm, two fingers: the fingers do not hang at the end of the palm's bone."""
    made = bones([(0, 0, 0), (3, 0, 0), (5, 1, 0), (5, -1, 0)], [(0, 1), (1, 2), (1, 3)],
                 [(2, 0, 0), (4, 1, 0), (4, -1, 0)])
    assert made.tail[1].tolist() == [4, 0, 0]
    assert made.connected.tolist() == [False, True, False, False]
    # Without a center line a bone goes through the middle of its part.
    assert made.tail[2].tolist() == [6, 1, 0]


def test_of_a_ring_of_parts_the_shortest_cut_is_no_joint():
    made = bones([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1), (1, 2), (0, 2)],
                 [(0.5, 0, 0), (1, 0.5, 0), (0.5, 0.5, 0)], length=[3, 2, 1])
    assert made.parent.tolist() == [-1, 0, 1]


def test_loose_parts_have_no_parent_and_no_bone_is_without_length():
    made = bones([(0, 0, 0), (9, 0, 0)], [], [])
    assert made.parent.tolist() == [-1, -1]
    assert np.linalg.norm(made.tail - made.head, axis=1) == pytest.approx(0.09)


@pytest.mark.parametrize("scale", [2.0**-20, 2.0**20])
def test_bones_are_the_same_at_any_scale(scale):
    """Of a ball around another, whose middles are one, the bones have the least length."""
    def made(scale):
        vertices, faces = shapes.together(shapes.icosphere(2), shapes.icosphere(2, 0.5))
        table = CornerTable.of(scale * vertices, faces)
        area = np.linalg.norm(table.face_vectors(), axis=1)
        labels = np.repeat([0, 1], len(faces) // 2)
        return part_bones(
            BoneSurface(table, labels, area, np.zeros(len(vertices)), np.empty((0, 3)), np.empty(0, np.int64)))

    assert np.linalg.norm(made(1.0).tail - made(1.0).head, axis=1) == pytest.approx(0.02 * np.sqrt(3))
    np.testing.assert_allclose(made(scale).tail / scale, made(1.0).tail, rtol=1e-12, atol=1e-12)
    assert made(scale).parent.tolist() == made(1.0).parent.tolist()


def test_joints_are_weighted_by_the_length_of_their_edges():
    made = bones([(0, 0, 0), (4, 0, 0)], [(0, 1), (0, 1)], [(2, 0, 0), (2, 4, 0)], length=[3, 1])
    assert made.head[1].tolist() == [2, 1, 0]


def mirrored(points):
    return points * (-1, 1, 1)


def test_bones_of_images_are_images():
    """Body, arm.L, arm.R, head, hand.L, hand.R; the given places are not quite even, and the first hand counts."""
    made = bones([(0.1, 0, 0), (3, 0, 0), (-3, 0.2, 0), (0, 0, 3), (5, 0, 0), (-5, 0, 1)],
                 [(0, 1), (0, 2), (0, 3), (1, 4), (2, 5)],
                 [(2, 0, 0), (-2, 0, 0), (0.1, 0, 2), (4, 0, 0), (-4, 0.1, 0)],
                 line=[(6, 1, 0), (-6, 0, 0), (0.2, 0, 4)], line_part=[4, 5, 3], twin=[0, 2, 1, 3, 5, 4])
    assert made.parent.tolist() == [-1, 0, 0, 0, 1, 2]
    assert made.connected.tolist() == [False, False, False, False, True, True]
    for own, image in ((1, 2), (4, 5)):
        np.testing.assert_allclose(made.head[image], mirrored(made.head[own]))
        np.testing.assert_allclose(made.tail[image], mirrored(made.tail[own]))
    assert made.tail[4].tolist() == [6, 1, 0]
    assert made.head[[0, 3], 0].tolist() == made.tail[[0, 3], 0].tolist() == [0, 0]
    assert sorted(made.order) == list(range(6))
    assert all(made.parent[bone] < 0 or made.order.index(made.parent[bone]) < made.order.index(bone)
               for bone in range(6))


def test_what_lies_in_the_plane_hangs_on_what_lies_there():
    """A ring of body, two arms and what both hold: held by one arm alone, it would not go with the other."""
    made = bones([(0, 0, 0), (3, 2, 0), (-3, 2, 0), (0, 4, 0)], [(0, 1), (0, 2), (1, 3), (2, 3)],
                 [(2, 0, 0), (-2, 0, 0), (2, 4, 0), (-2, 4, 0)], height=[1, 0, 0, 2], twin=[0, 2, 1, 3])
    assert made.parent.tolist() == [-1, 0, 0, 0]


def test_without_anything_in_the_plane_there_are_two_trees():
    made = bones([(2, 0, 0), (-2, 0, 0), (4, 0, 0), (-4, 0, 0)], [(0, 1), (0, 2), (1, 3)],
                 [(0, 0, 0), (3, 0, 0), (-3, 0, 0)], twin=[1, 0, 3, 2])
    assert made.parent.tolist() == [-1, -1, 0, 1]
    np.testing.assert_allclose(made.head[[1, 3]], mirrored(made.head[[0, 2]]))


@pytest.mark.parametrize("plane", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_limbs_are_images_however_parts_hang_together(seed, plane):
    """Three parts in the middle, eight beside it with their images, one without; some cuts are no necks.

    A bone could be named by a part that another bone moves. The image of the name was not that of the bone then, and a
    boot had a bone where the other one had none.
    """
    rng = np.random.default_rng(seed)
    twin = np.array([0, 1, 2, *np.arange(11, 19), *np.arange(3, 11), -1])
    image = np.where(twin < 0, np.arange(20), twin)
    center = rng.normal(size=(20, 3)) * 5
    center[:3, 0] = 0
    center[11:19] = mirrored(center[3:11])
    drawn = np.sort(rng.integers(0, 20, (12, 2)), axis=1)
    cuts = np.unique(np.sort(np.concatenate([drawn, image[drawn]]), axis=1), axis=0)
    cuts = cuts[cuts[:, 0] != cuts[:, 1]]
    joints = (center[cuts[:, 0]] + center[cuts[:, 1]]) / 2
    made, bone_part, part_bone = bones(center, cuts.tolist(), joints, height=np.arange(20.0), twin=twin, limbs=True,
                                       plane=plane)
    with_image = bone_part[twin[bone_part] >= 0]
    of_bone = part_bone[image[bone_part]]
    assert 1 < len(bone_part) < 20
    for part in with_image.tolist():
        bone = part_bone[part]
        assert bone_part[of_bone[bone]] == twin[part]
        above = made.parent[bone]
        assert made.parent[of_bone[bone]] == (-1 if above < 0 else of_bone[above])


@pytest.mark.parametrize("normal", [(1, 0, 0), (0, 0, 1), (0.6, 0, 0.8)])
def test_a_bone_without_length_stays_in_the_plane(normal):
    table = CornerTable.of(*shapes.octahedron())
    images = PartImages(np.array([0]), MirrorPlane(np.array(normal, float), 0.0))
    made = part_bones(
        BoneSurface(table, np.zeros(8, int), np.ones(8), np.zeros(6), np.zeros((0, 3)), np.zeros(0, int), images))
    assert np.linalg.norm(made.tail - made.head) > 0.01
    assert np.abs(images.mirror.heights(np.concatenate([made.head, made.tail]))).max() < 1e-12


def boxes(*places, twin=None, ground=None, limbs=False):
    """Bones of boxes, each a part of its own: (middle, size) of each."""
    table = CornerTable.of(*shapes.together(*(box_about(*place) for place in places)))
    labels = np.repeat(np.arange(len(places)), 12)
    images = None if twin is None else PartImages(np.array(twin), MirrorPlane(np.array([1.0, 0, 0]), 0.0))
    part = np.zeros(len(table.vertices), int)
    part[table.corner_vertex] = labels[table.corner_face]
    return (limb_bones if limbs else part_bones)(BoneSurface(
        table, labels, np.linalg.norm(table.face_vectors(), axis=1), part.astype(float), np.zeros((0, 3)),
        np.zeros(0, int), images, ground))


def box_about(middle, size=(1, 1, 1)):
    return shapes.moved(shapes.box(size), np.subtract(middle, np.divide(size, 2)))


def test_pieces_that_touch_hang_on_each_other_and_others_do_not():
    """A trunk, an arm that ends 0.1 beside it with a hand in its end, and a ball far away."""
    made = boxes(((0, 0, 0), (2, 2, 6)), ((4.1, 0, 0), (6, 1, 1)), ((7.5, 0, 0), (1.2, 0.8, 0.8)),
                 ((0, 0, 20), (1, 1, 1)))
    assert made.parent.tolist() == [-1, 0, 1, -1]
    assert made.head[1] == pytest.approx((1.05, 0, 0), abs=0.02)
    assert made.head[2] == pytest.approx((7, 0, 0), abs=0.2)


def test_pieces_of_two_sides_hang_on_their_own_side_whatever_their_order():
    """Trunk, leg.L, leg.R, foot.R, foot.L, and a sword in the hand of the right arm, which has no image."""
    made = boxes(((0, 0, 0), (4, 1, 4)), ((1.5, 0, -4), (1, 1, 4)), ((-1.5, 0, -4), (1, 1, 4)),
                 ((-1.5, 1, -6.4), (1, 3, 0.8)), ((1.5, 1, -6.4), (1, 3, 0.8)),
                 ((3.5, 0, 1), (3, 1, 1)), ((-3.5, 0, 1), (3, 1, 1)), ((-5.2, 0, 4), (0.4, 0.4, 8)),
                 twin=[0, 2, 1, 4, 3, 6, 5, -1])
    assert made.parent.tolist() == [-1, 0, 0, 2, 1, 0, 0, 6]
    for left, right in ((1, 2), (4, 3), (5, 6)):
        np.testing.assert_array_equal(made.head[right], mirrored(made.head[left]))
        np.testing.assert_array_equal(made.tail[right], mirrored(made.tail[left]))
    assert (made.head[0, 0], made.tail[0, 0]) == (0, 0)
    assert made.head[7, 0] < -4.5


@pytest.mark.parametrize("wide", [20, 2_000])
@pytest.mark.parametrize("twin", [None, [0, 2, 1, 3, -1]])
def test_what_stands_on_a_floor_does_not_hang_on_it(wide, twin):
    """Trunk, two legs, a stone beside them, which a wide floor makes near to all, and the floor."""
    places = [((0, 0, 0), (4, 1, 4)), ((1.5, 0, -4), (1, 1, 4)), ((-1.5, 0, -4), (1, 1, 4)), ((0, 5, -5), (1, 1, 2))]
    floor, ground = ((0, 0, -6.5), (wide, wide, 1)), np.arange(5) == 4
    alone = boxes(*places, twin=twin and twin[:4])
    found = boxes(*places, floor, twin=twin, ground=ground)
    assert found.parent.tolist() == [*alone.parent.tolist(), -1] == [-1, 0, 0, -1, -1]
    np.testing.assert_allclose(found.head[:4], alone.head)
    np.testing.assert_allclose(found.tail[:4], alone.tail)
    assert boxes(*places, floor, twin=twin, ground=ground, limbs=True)[1].tolist() == [0, 1, 2, 3, 4]


def test_what_is_one_surface_with_the_ground_has_the_bones_that_it_has_alone():
    """With a scan's ground, all of a figure was one limb of it."""
    shape = shapes.figure_on_ground(5.0, step=0.2)
    found = decompose(*shape)
    parts = found.parts()
    standing = ~parts.ground[parts.labels]

    def bones(make, faces, labels, ground=None):
        table = CornerTable.of(shape.vertices, faces)
        area = np.linalg.norm(table.face_vectors(), axis=1)
        return make(BoneSurface(table, labels, area, found.field, np.zeros((0, 3)), np.zeros(0, int), ground=ground))

    kept, labels = np.unique(parts.labels[standing], return_inverse=True)
    with_ground = bones(part_bones, shape.faces, parts.labels, parts.ground)
    alone = bones(part_bones, shape.faces[standing], labels)
    assert with_ground.parent[parts.ground].tolist() == [-1]
    assert with_ground.parent[kept].tolist() == np.append(kept, -1)[alone.parent].tolist()
    np.testing.assert_allclose(with_ground.head[kept], alone.head, atol=1e-9)
    limbs, of_limb, _ = bones(limb_bones, shape.faces, parts.labels, parts.ground)
    assert kept[bones(limb_bones, shape.faces[standing], labels)[1]].tolist() == [
        part for part in of_limb if not parts.ground[part]]
    assert len(limbs.head) >= 5


def test_a_head_does_not_end_at_its_eyes():
    head = ((0, 0, 0), (2, 2, 2))
    alone = boxes(((0, 0, -4), (4, 4, 6)), head)
    eyes = boxes(((0, 0, -4), (4, 4, 6)), head, ((0.5, -1, 0.5), (0.2, 0.2, 0.2)), ((-0.5, -1, 0.5), (0.2, 0.2, 0.2)))
    assert eyes.parent.tolist() == [-1, 0, 1, 1]
    np.testing.assert_array_equal(eyes.tail[1], alone.tail[1])


def test_a_part_that_was_posed_has_no_image():
    table = CornerTable.of(*shapes.together(*(box_about(middle) for middle in (
        (0, 0, 0), (3, 0, 0), (-3, 0, 0), (5, 0, 0), (-5, 0, 2)))))
    labels, twin = np.repeat(np.arange(5), 12), np.array([0, 2, 1, 4, 3])
    plane = MirrorPlane(np.array([1.0, 0, 0]), 0.0)
    surface = BoneSurface(table, labels, np.ones(60), np.zeros(len(table.vertices)), np.empty((0, 3)),
                          np.empty(0, np.int64))
    images = surface.with_images(twin, plane).images
    assert images.twin.tolist() == [0, 2, 1, -1, -1]
    assert images.first.tolist() == [0, 1, 1, 3, 4]
    beside = np.where(twin == 0, -1, twin)
    assert surface.with_images(beside, plane).images is None
