# SPDX-License-Identifier: GPL-3.0-or-later
"""The nearest of the points before each one, of equally near ones the first; and of the larger ones."""

from itertools import product

import numpy as np
import pytest

from core.arrays.nearest import nearest_before, nearest_larger

RNG = np.random.default_rng(0)
POINTS = {
    "none": np.empty((0, 3)), "one": np.zeros((1, 3)), "two": np.eye(3)[:2], "at random": RNG.random((700, 3)),
    "on a grid": RNG.permutation(np.array(list(product(range(7), repeat=3)), float)),
    "several in each place": np.repeat(RNG.random((30, 3)), 20, axis=0)[RNG.permutation(600)],
    "all in one place": np.ones((300, 3)),
}


@pytest.mark.parametrize("name", POINTS)
def test_against_all_points_before(name):
    points = POINTS[name]
    apart = np.linalg.norm(points[:, None] - points, axis=2)
    wanted = [int((row[:k] <= row[:k].min() + 1e-9).argmax()) if k else -1 for k, row in enumerate(apart)]
    assert nearest_before(points).tolist() == wanted


def test_of_points_equally_near_but_for_rounding_the_first():
    """Of the grid, hundreds of points have several that are equally near; 1e-7 is what single precision leaves."""
    grid = POINTS["on a grid"]
    moved = grid + RNG.uniform(-1e-7, 1e-7, grid.shape)
    assert nearest_before(moved).tolist() == nearest_before(grid).tolist()


@pytest.mark.parametrize("name", POINTS)
def test_links_lead_to_larger_points_and_never_apart(name):
    points = POINTS[name]
    size = np.random.default_rng(1).integers(1, 9, len(points)) / 8.0
    links = nearest_larger(size, points)
    rank = {point: k for k, point in enumerate(np.lexsort((np.arange(len(points)), -size)).tolist())}
    assert [rank[a] for a, _ in links.tolist()] == list(range(1, len(points)))
    for a, b in links.tolist():
        larger = [c for c in rank if rank[c] < rank[a]]
        distance = np.linalg.norm(points[larger] - points[a], axis=1)
        assert rank[b] < rank[a]
        assert np.linalg.norm(points[b] - points[a]) <= distance.min() + 1e-9
