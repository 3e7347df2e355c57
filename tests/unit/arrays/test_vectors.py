# SPDX-License-Identifier: GPL-3.0-or-later
"""Products and lengths of vectors, as NumPy has them."""

import numpy as np
import pytest

from core.arrays.vectors import (
    BLOCK,
    across,
    cross,
    distances_between,
    lengths,
    middles_of_each,
    second_moments,
    second_moments_of_each,
)


@pytest.mark.parametrize("count", [0, 500, BLOCK, 2 * BLOCK + 1])
def test_products_and_lengths_are_those_of_numpy(count):
    a, b = np.random.default_rng(0).normal(size=(2, count, 3))
    assert (cross(a, b) == np.cross(a, b)).all()
    assert (lengths(a) == np.linalg.norm(a, axis=1)).all()
    turned = np.arange(count)[::-1]
    assert (distances_between(np.concatenate([a, b]), turned, count + turned) == lengths(a - b)[::-1]).all()


@pytest.mark.parametrize("direction", [(0.0, 0.0, 1.0), (-3e9, 3e9, 0.0), (1e-9, 2e-9, -2e-9)])
def test_what_lies_across_a_direction_is_at_a_right_angle_to_it(direction):
    found = across(np.array(direction))
    assert np.linalg.norm(found) == pytest.approx(1.0)
    assert abs(found @ np.array(direction)) <= 1e-15 * np.abs(direction).max()


def test_middles_and_moments_of_each_are_those_of_its_points():
    rng = np.random.default_rng(0)
    points, weights = rng.normal(size=(50, 3)), rng.uniform(size=50)
    index = rng.integers(0, 3, 50) + (rng.random(50) < 0.3)  # of 5 the last has no points
    total, middle = middles_of_each(index, points, weights, 5)
    moments = second_moments_of_each(index, points, weights, 5)
    for i in range(4):
        own = index == i
        assert total[i] == pytest.approx(weights[own].sum())
        assert middle[i] == pytest.approx(np.average(points[own], axis=0, weights=weights[own]))
        assert moments[i] == pytest.approx((points[own].T * weights[own]) @ points[own])
        assert second_moments(points[own], weights[own]) == pytest.approx(moments[i])
    assert (total[4], *middle[4], *moments[4].ravel()) == (0.0,) * 13
