# SPDX-License-Identifier: GPL-3.0-or-later
"""Idioms of whole arrays, by hand."""

import numpy as np

from core.surface.arrays import expanded


def test_ranges_are_listed_one_after_the_other():
    row, number = expanded(np.array([5, 0, 7, 2]), np.array([2, 0, 1, 3]))
    assert row.tolist() == [0, 0, 2, 3, 3, 3]
    assert number.tolist() == [5, 6, 7, 2, 3, 4]
