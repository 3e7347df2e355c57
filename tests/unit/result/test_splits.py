# SPDX-License-Identifier: GPL-3.0-or-later
"""The sequence of splits: an answer worked out by hand; the levels themselves are in test_numbering."""

from dataclasses import replace

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.cuts.hierarchy import Hierarchy
from core.result.splits import Splits


@pytest.fixture
def chain():
    """Four candidates in a row; 2 and 3 merge first, then 0 and 1, then all."""
    hierarchy = Hierarchy.of(4, [(2, 3), (0, 1), (1, 2)], [0.2, 0.4, 0.9])
    any_other = decompose(*shapes.tube_tree(), Parameters(method="berretti"))
    return replace(any_other, hierarchy=hierarchy, candidate_area=np.ones(4),
                   candidate_pairs=np.array([(0, 1), (1, 2), (2, 3)]), candidate_pair_length=np.ones(3))


def same(a, b):
    """Whether two groupings are the same up to their labels."""
    return len(set(zip(a, b, strict=True))) == len(set(a)) == len(set(b))


def test_merge_of_pairs(chain):
    assert chain.pair_merge.tolist() == [1, 2, 0]
    assert chain.hierarchy.merge_of(np.array([0, 0]), np.array([3, 0])).tolist() == [2, 0]
    loose = Hierarchy.of(3, [(0, 1)], [0.5])
    assert loose.merge_of(np.array([0, 0]), np.array([1, 2])).tolist() == [0, 1]  # the last never merge


def test_nothing_fixed(chain):
    splits = Splits.of(chain, np.zeros(4, int))
    assert splits.n_roots == 1
    assert splits.merge.tolist() == [2, 1, 0]
    for done, level in enumerate(([0, 0, 0, 0], [0, 0, 1, 1], [0, 1, 2, 2], [0, 1, 2, 3])):
        assert same(splits.parts(done).tolist(), level)
    assert [splits.n_done(chain, 0.0, count) for count in (1, 2, 4, 9)] == [0, 1, 3, 3]
    # Cuts of salience 1 - detail and above stay.
    assert [splits.n_done(chain, detail) for detail in (0.0, 0.1, 0.5, 0.6, 0.8)] == [0, 1, 1, 2, 3]


def test_what_is_fixed_is_apart_from_the_start_and_leaves_pieces(chain):
    splits = Splits.of(chain, np.array([0, 7, 0, 0]))
    assert splits.n_roots == 3
    assert same(splits.parts(0).tolist(), [0, 1, 2, 2])
    assert splits.merge.tolist() == [0]
    assert same(splits.parts(1).tolist(), [0, 1, 2, 3])


def test_fixed_candidates_stay_together_though_they_do_not_touch(chain):
    splits = Splits.of(chain, np.array([5, 0, 5, 0]))
    assert splits.n_roots == 3
    assert len(splits.intervals) == 0
    assert same(splits.parts(0).tolist(), [0, 1, 0, 2])


def test_what_touches_and_never_merges_stays_apart_beside_what_is_fixed(chain):
    loose = replace(chain, hierarchy=Hierarchy.of(4, [(2, 3)], [0.2]))
    splits = Splits.of(loose, np.array([0, 0, 7, 7]))
    assert splits.n_roots == 3
    assert same(splits.parts(0).tolist(), [0, 1, 2, 2])
