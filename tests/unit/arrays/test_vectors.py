# SPDX-License-Identifier: GPL-3.0-or-later
"""Products and lengths of vectors, as NumPy has them."""

import numpy as np
import pytest

from core.arrays.vectors import BLOCK, cross, lengths


@pytest.mark.parametrize("count", [0, 500, BLOCK, 2 * BLOCK + 1])
def test_products_and_lengths_are_those_of_numpy(count):
    a, b = np.random.default_rng(0).normal(size=(2, count, 3))
    assert (cross(a, b) == np.cross(a, b)).all()
    assert (lengths(a) == np.linalg.norm(a, axis=1)).all()
