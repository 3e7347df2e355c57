# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of pairs, and pairs among others, by hand."""

import numpy as np

from core.arrays.pairs import are_among, edge_keys, pair_keys, partners_of, repeated_in


def test_keys_of_pairs_are_in_the_order_of_the_pairs():
    pairs = np.array([(i, j) for i in range(3) for j in range(3)])
    assert pair_keys(pairs, 3).tolist() == list(range(9))


def test_keys_of_edges_are_whole_numbers_of_64_bits_whichever_end_comes_first():
    start, end = np.array([[0, 70_000], [69_999, 70_000]], np.int32)
    assert edge_keys(start, end, count=70_001).tolist() == [69_999, 70_000 * 70_001 + 70_000]
    assert np.array_equal(edge_keys(start, end, count=70_001), edge_keys(end, start, count=70_001))


def test_partners_are_listed_in_the_order_of_the_pairs():
    assert partners_of(np.array([(2, 0), (0, 1), (2, 3), (0, 2)]), 5) == [[2, 1, 2], [0], [0, 3, 0], [2], []]


def test_members_that_a_group_has_more_than_once_whatever_lies_between():
    group, member = np.array([[70_000, 5], [1, 5], [70_000, 5], [2, 3], [70_000, 5], [1, 4], [2, 3]], np.int32).T
    assert repeated_in(group, member, count=70_000).tolist() == [3, 5, 5]
    assert repeated_in(group[:2], member[:2], count=70_000).tolist() == []


def test_which_pairs_are_among_others():
    pairs, others = np.array([(1, 2), (2, 1), (0, 0), (5, 9)]), np.array([(5, 9), (2, 1)])
    assert are_among(pairs, others).tolist() == [False, True, False, True]
    assert are_among(np.array([(1, 4), (2, 1)]), np.array([(2, 1)])).tolist() == [False, True]
    assert are_among(np.array([(2, 1)]), np.array([(1, 4)])).tolist() == [False]
    assert are_among(pairs, others[:0]).tolist() == 4 * [False]
    assert are_among(pairs[:0], others).tolist() == []
