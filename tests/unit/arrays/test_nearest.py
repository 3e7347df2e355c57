# SPDX-License-Identifier: GPL-3.0-or-later
"""The nearest of the points before each one; of equally near ones the first."""

from itertools import product

import numpy as np
import pytest

from core.arrays.nearest import nearest_before

RNG = np.random.default_rng(0)
POINTS = {
    "none": np.empty((0, 3)), "one": np.zeros((1, 3)), "two": np.eye(3)[:2], "at random": RNG.random((700, 3)),
    "on a grid": RNG.permutation(np.array(list(product(range(7), repeat=3)), float)),
    "several in each place": np.repeat(RNG.random((30, 3)), 20, axis=0)[RNG.permutation(600)],
    "all in one place": np.ones((300, 3)),
}  # fmt: skip


@pytest.mark.parametrize("name", POINTS)
def test_against_all_points_before(name):
    points = POINTS[name]
    apart = np.linalg.norm(points[:, None] - points, axis=2)
    wanted = [int((row[:k] <= row[:k].min() + 1e-9).argmax()) if k else -1 for k, row in enumerate(apart)]
    assert nearest_before(points).tolist() == wanted
