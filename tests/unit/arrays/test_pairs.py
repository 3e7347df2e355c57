# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of pairs, and pairs among others, by hand."""

import numpy as np

from core.arrays.pairs import are_among, pair_keys


def test_keys_of_pairs_are_in_the_order_of_the_pairs():
    pairs = np.array([(i, j) for i in range(3) for j in range(3)])
    assert pair_keys(pairs, 3).tolist() == list(range(9))


def test_which_pairs_are_among_others():
    pairs, others = np.array([(1, 2), (2, 1), (0, 0), (5, 9)]), np.array([(5, 9), (2, 1)])
    assert are_among(pairs, others).tolist() == [False, True, False, True]
    assert are_among(pairs, others[:0]).tolist() == 4 * [False]
    assert are_among(pairs[:0], others).tolist() == []
