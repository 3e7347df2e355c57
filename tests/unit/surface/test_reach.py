# SPDX-License-Identifier: GPL-3.0-or-later
"""What rays and triangles can meet is found without a miss, and little else."""

import numpy as np
import pytest
import shapes

from core.surface.reach import within_reach


def hit(points, triangles, start, direction):
    """Which triangles each ray meets, by solving for it, (r, t) bool."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        way = ((a[None] - start[:, None]) * normal).sum(axis=2) / (direction[:, None] * normal).sum(axis=2)
        place = start[:, None] + way[:, :, None] * direction[:, None]
        inside = np.ones(way.shape, bool)
        for p, q in ((a, b), (b, c), (c, a)):
            inside &= (np.cross(q - p, place - p) * normal).sum(axis=2) >= 0
    return inside & (way >= 0)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("moved", [0.0, 1e3])
def test_no_triangle_that_a_ray_meets_is_missed(seed, moved):
    rng = np.random.default_rng(seed)
    vertices, triangles = shapes.icosphere(4)
    points = vertices * (1.0, 0.4, 2.0) + 0.05 * rng.standard_normal(vertices.shape) + moved
    some = rng.choice(len(triangles), 12, replace=False)
    start = points[triangles[some]].mean(axis=1)
    direction = rng.standard_normal((12, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    met = hit(points, triangles, start, direction).any(axis=0)
    reached = within_reach(points, triangles, np.zeros(len(triangles), bool), start, direction)
    assert met.sum() > 12
    assert reached[met].all()
    assert reached.mean() < 0.5


@pytest.mark.parametrize("seed", range(4))
def test_all_triangles_near_one_that_is_tried_are_reached(seed):
    """Those whose boxes meet the box of one, also if one is as large as the whole."""
    rng = np.random.default_rng(seed)
    vertices, triangles = shapes.icosphere(3)
    points = np.concatenate([vertices, 1.5 * rng.standard_normal((3, 3))])
    triangles = np.concatenate([triangles, [len(vertices) + np.arange(3)]])
    tried = np.zeros(len(triangles), bool)
    tried[rng.choice(len(triangles), 3, replace=False)] = True
    tried[-1] = seed % 2 == 0
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    near = ((low[:, None] <= high[tried]) & (high[:, None] >= low[tried])).all(axis=2).any(axis=1)
    reached = within_reach(points, triangles, tried, np.empty((0, 3)), np.empty((0, 3)))
    assert reached[near].all()
    assert reached[tried].all()
    assert tried[-1] or reached.mean() < 0.4


def test_a_flat_mesh_and_one_of_one_place_are_reached():
    flat = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    triangle = np.array([[0, 1, 2]])
    down = np.array([[0.2, 0.2, 1.0]]), np.array([[0.0, 0.0, -1.0]])
    assert within_reach(flat, triangle, np.zeros(1, bool), *down).all()
    assert within_reach(np.zeros((3, 3)), triangle, np.ones(1, bool), *down).all()
