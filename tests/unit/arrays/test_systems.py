# SPDX-License-Identifier: GPL-3.0-or-later
"""Sparse linear systems: what solves them, and how much a long row fills."""

import numpy as np
from scipy.sparse import csr_array

from core.arrays.systems import solved


def test_a_system_is_solved():
    """Of a path of six, whose ends are held."""
    matrix = csr_array(2 * np.eye(6) - np.eye(6, k=1) - np.eye(6, k=-1))
    wanted = np.array([[3.0, 1], [1, 2], [4, 3], [1, 4], [5, 5], [9, 6]])
    np.testing.assert_allclose(solved(matrix, matrix @ wanted), wanted, rtol=1e-12)
    np.testing.assert_allclose(solved(matrix, matrix @ wanted[:, 0]), wanted[:, 0], rtol=1e-12)
