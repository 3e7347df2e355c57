# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints of rigid bodies: in the middle of each cut, along and across it; which hulls overlap."""

import itertools

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.uses.moving.body_joints import body_joints, overlapping
from core.uses.moving.hulls import Hull, part_hulls


def bar(size=(4.0, 1.0, 0.5), n=(8, 2, 2)):
    """A long box whose faces are divided, from 0 to ``size``."""
    axes = [np.linspace(0, s, k + 1) for s, k in zip(size, n, strict=True)]
    quads, points = [], {}
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side, low in ((0.0, True), (size[axis], False)):
            for i in range(n[u]):
                for j in range(n[v]):
                    corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    quad = []
                    for a, b in corners[::-1] if low else corners:
                        place = [0.0, 0.0, 0.0]
                        place[axis], place[u], place[v] = side, axes[u][a], axes[v][b]
                        quad.append(points.setdefault(tuple(place), len(points)))
                    quads.append(quad)
    return np.array(list(points)), np.array(quads)


def halves(vertices, faces):
    return (vertices[faces].mean(axis=1)[:, 0] > 2).astype(int)


def test_a_joint_of_a_bar():
    vertices, faces = bar()
    joints = body_joints(CornerTable.of(vertices, faces), halves(vertices, faces))
    assert joints.pairs.tolist() == [[0, 1]]
    assert joints.center[0] == pytest.approx([2, 0.5, 0.25])
    assert joints.axis[0] == pytest.approx([1, 0, 0])  # toward the second part
    assert abs(joints.hinge[0]) == pytest.approx([0, 1, 0])  # the cut is twice as wide as high


def test_joints_turn_and_grow_with_the_mesh():
    vertices, faces = bar()
    labels = halves(vertices, faces)
    turn = shapes.rotation(np.random.default_rng(1))
    before = body_joints(CornerTable.of(vertices, faces), labels)
    after = body_joints(CornerTable.of(3 * vertices @ turn.T + 5, faces), labels)
    assert after.center == pytest.approx(3 * before.center @ turn.T + 5)
    assert after.axis == pytest.approx(before.axis @ turn.T)
    assert abs((after.hinge * (before.hinge @ turn.T)).sum(axis=1)) == pytest.approx(1)


def test_a_round_cut_bends_about_a_horizontal_line():
    vertices, faces = shapes.cylinder(16, 24)
    along = np.ptp(vertices, axis=0).argmax()
    vertices = np.roll(vertices, 2 - along, axis=1)  # upright
    labels = (vertices[faces].mean(axis=1)[:, 2] > vertices[:, 2].mean()).astype(int)
    joints = body_joints(CornerTable.of(vertices, faces), labels)
    assert joints.axis[0] == pytest.approx([0, 0, 1], abs=1e-6)
    assert joints.hinge[0] @ joints.axis[0] == pytest.approx(0, abs=1e-6)


def test_two_joints_where_a_ring_is_cut_twice():
    vertices, faces = shapes.torus()
    labels = (vertices[faces].mean(axis=1)[:, 0] > 0).astype(int)
    joints = body_joints(CornerTable.of(vertices, faces), labels)
    assert joints.pairs.tolist() == [[0, 1], [0, 1]]
    assert sorted(joints.center[:, 1].round(6).tolist()) == pytest.approx([-1, 1], abs=0.05)


def three_boxes(gap):
    """Boxes in a row, of no common vertices: two with ``gap`` between them, one far away."""
    vertices, faces = bar((1.0, 1.0, 1.0), (4, 4, 4))
    shapes_ = [vertices, vertices + [1 + gap, 0, 0], vertices + [9, 0, 0]]
    return CornerTable.of(np.concatenate(shapes_), np.concatenate([faces + i * len(vertices) for i in range(3)]))


def test_parts_that_touch_without_a_cut_are_held_where_they_touch():
    table = three_boxes(gap=0.05)
    joints = body_joints(table, np.repeat([0, 1, 2], table.n_faces // 3))
    assert joints.pairs.tolist() == [[0, 1]]
    assert joints.center[0] == pytest.approx([1.025, 0.5, 0.5])
    assert joints.axis[0] == pytest.approx([1, 0, 0])


def test_nothing_is_joined_to_a_ground():
    table = three_boxes(gap=0.05)
    labels = np.repeat([0, 1, 2], table.n_faces // 3)
    assert len(body_joints(table, labels, np.array([True, False, False])).pairs) == 0
    one_surface = CornerTable.of(*shapes.flat_grid(3, 1))
    for ground, pairs in (([False] * 3, [[0, 1], [1, 2]]), ([True, False, False], [[1, 2]])):
        assert body_joints(one_surface, np.repeat([0, 1, 2], 2), np.array(ground)).pairs.tolist() == pairs


def test_no_joint_where_nothing_touches():
    table = three_boxes(gap=2.0)
    assert len(body_joints(table, np.repeat([0, 1, 2], table.n_faces // 3)).pairs) == 0


@pytest.mark.parametrize(("distance", "pairs"), [(0.9, [[0, 1]]), (1.1, [])])
def test_which_boxes_overlap(distance, pairs):
    vertices, faces = shapes.box_quads()
    vertices = vertices / np.ptp(vertices, axis=0)
    both = np.concatenate([vertices, vertices + [distance, 0.2, 0.3]])
    table = CornerTable.of(both, np.concatenate([faces, faces + 8]))
    hulls = [hull for (hull,) in part_hulls(table, np.repeat([0, 1], 6))]
    assert overlapping(hulls).tolist() == pairs


@pytest.mark.parametrize("seed", range(3))
def test_every_two_hulls_with_a_point_in_common_overlap(seed):
    """Random tetrahedra: those with points inside each other overlap, those whose boxes are apart do not."""
    rng = np.random.default_rng(seed)
    hulls = []
    for corners in rng.random((12, 4, 3)) + 1.5 * rng.random((12, 1, 3)):
        faces = np.array([(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)])
        outwards = np.linalg.det(corners[:3] - corners[3]) > 0
        hulls.append(Hull(corners, faces if outwards else faces[:, ::-1]))
    found = {tuple(pair) for pair in overlapping(hulls).tolist()}
    share = rng.dirichlet(np.ones(4), 500)
    for a, b in itertools.combinations(range(len(hulls)), 2):
        if any(_inside(hulls[one], share @ hulls[other].vertices).any() for one, other in ((a, b), (b, a))):
            assert (a, b) in found
        low, high = (np.array([bound(hulls[one].vertices, axis=0) for one in (a, b)]) for bound in (np.min, np.max))
        if (low.max(axis=0) > high.min(axis=0)).any():
            assert (a, b) not in found
    assert found


def _inside(hull, points):
    """Which points, (k, 3), lie within a hull."""
    a, b, c = hull.vertices[hull.triangles].transpose(1, 0, 2)
    return (((points[:, None] - a) * np.cross(b - a, c - a)).sum(axis=2) < 0).all(axis=1)


def test_no_hull_overlaps_nothing():
    assert overlapping([]).shape == (0, 2)
