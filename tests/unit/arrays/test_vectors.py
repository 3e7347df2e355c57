# SPDX-License-Identifier: GPL-3.0-or-later
"""Products and lengths of vectors, as NumPy has them."""

import numpy as np
import pytest

from core.arrays.vectors import BLOCK, across, cross, distances_between, lengths


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
