# SPDX-License-Identifier: GPL-3.0-or-later
"""Products and lengths of vectors, as NumPy has them."""

import numpy as np

from core.surface.vectors import cross, lengths


def test_products_and_lengths_are_those_of_numpy():
    a, b = np.random.default_rng(0).normal(size=(2, 500, 3))
    assert (cross(a, b) == np.cross(a, b)).all()
    assert (lengths(a) == np.linalg.norm(a, axis=1)).all()
