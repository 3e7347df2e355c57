# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls of parts: closed, convex, around their parts, and not too fine."""

import numpy as np
import pytest
import shapes

from core.surface.corners import CornerTable
from core.uses.hulls import part_hulls


def hulls(shape, labels=None, **more):
    vertices, faces = shape
    return part_hulls(CornerTable.of(vertices, faces), np.zeros(len(faces), int) if labels is None else labels, **more)


def check(hull):
    """Closed, looking outward, and convex."""
    sides = np.concatenate([hull.triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    assert {tuple(side) for side in sides.tolist()} == {tuple(side) for side in sides[:, ::-1].tolist()}
    assert len(np.unique(sides, axis=0)) == len(sides)
    a, b, c = hull.vertices[hull.triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    size = np.linalg.norm(np.ptp(hull.vertices, axis=0))
    assert (hull.vertices @ normal.T - (a * normal).sum(axis=1)).max() < 1e-9 * size


def volume(hull):
    a, b, c = (hull.vertices - hull.vertices.mean(axis=0))[hull.triangles].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 6


@pytest.mark.parametrize("size", [1e-5, 1.0, 1e5])
def test_a_box_is_its_own_hull(size):
    vertices, faces = shapes.box_quads()
    (hull,) = hulls((size * vertices, faces))
    check(hull)
    assert {tuple(v) for v in hull.vertices.tolist()} == {tuple(v) for v in (size * vertices).tolist()}
    assert volume(hull) == pytest.approx(np.prod(np.ptp(size * vertices, axis=0)))


def test_each_part_has_one_around_it():
    vertices, faces = shapes.two_spheres()
    labels = (vertices[faces].mean(axis=1)[:, 0] > vertices[:, 0].mean()).astype(int)
    found = hulls((vertices, faces), labels, most=10_000)
    assert len(found) == 2
    for label, hull in enumerate(found):
        check(hull)
        assert {tuple(v) for v in hull.vertices.tolist()} <= {tuple(v) for v in vertices[faces[labels == label]]
                                                              .reshape(-1, 3).tolist()}


def test_a_fine_ball_gets_few_corners_and_keeps_its_size():
    vertices, faces = shapes.icosphere(4)
    (hull,) = hulls((vertices, faces))
    check(hull)
    assert len(hull.vertices) <= 64
    assert volume(hull) > 0.85 * volume(hulls((vertices, faces), most=10_000)[0])


@pytest.mark.parametrize("points", [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
                                    [[1, 2, 3], [1, 2, 3], [1, 2, 3]]])
def test_what_is_flat_gets_a_thin_one(points):
    (hull,) = hulls((np.array(points, float), np.array([[0, 1, 2]])))
    check(hull)
    assert 0 < volume(hull) < 0.1
