# SPDX-License-Identifier: GPL-3.0-or-later
"""The hierarchy: every number of parts exactly, each level a union of the finer."""

import numpy as np
import pytest

from core.cuts.hierarchy import Candidates, Dendrogram, Hierarchy
from core.errors import ParameterError


def random_hierarchy(rng, n=30, loose=1):
    """Random merges of n candidates in ``loose`` groups."""
    part = np.arange(n)
    group = rng.integers(0, loose, n)
    group[:loose] = np.arange(loose)
    merges = []
    while True:
        a, b = rng.integers(0, n, 2)
        if group[a] == group[b] and part[a] != part[b]:
            merges.append((a, b))
            part[part == part[b]] = part[a]
        if len(np.unique(part)) == loose:
            return Hierarchy.of(n, merges, rng.random(len(merges)) ** 2)


@pytest.fixture(params=[(seed, loose) for seed in range(3) for loose in (1, 3)], ids=str)
def hierarchy(request):
    seed, loose = request.param
    return random_hierarchy(np.random.default_rng(seed), loose=loose)


def test_by_hand():
    hierarchy = Hierarchy.of(4, [(2, 3), (0, 1), (1, 2)], [0.2, 0.4, 0.9])
    assert hierarchy.n_loose == 1
    assert hierarchy.parts(4).tolist() == [0, 1, 2, 3]
    assert hierarchy.parts(3).tolist() == [0, 1, 2, 2]
    assert hierarchy.parts(2).tolist() == [0, 0, 1, 1]
    assert hierarchy.parts(1).tolist() == [0, 0, 0, 0]
    # Cuts of salience 1 - detail and above stay.
    assert [hierarchy.n_parts(d) for d in (0, 0.05, 0.1, 0.5, 0.6, 0.8, 0.9, 1)] == [1, 1, 2, 2, 3, 4, 4, 4]
    a, b = np.array([(2, 3), (0, 1), (0, 3), (1, 2)]).T
    assert hierarchy.merge_of(a, b).tolist() == [0, 1, 2, 2]


def test_detail_in_decimal_tenths_meets_salience_in_tenths():
    hierarchy = Hierarchy.of(11, [(i, i + 1) for i in range(10)], np.arange(1, 11) / 10)
    for tenth in range(10):
        # Salience 1 - tenth / 10 and above stays: one cut at detail 0, two at 0.1, ...
        assert hierarchy.n_parts(tenth / 10) == tenth + 2


def test_every_number_of_parts_exactly(hierarchy):
    for n in range(hierarchy.n_loose, hierarchy.n_candidates + 1):
        assert np.unique(hierarchy.parts(n)).tolist() == list(range(n))
    assert hierarchy.parts(0).max() + 1 == hierarchy.n_loose
    assert hierarchy.parts(10**6).max() + 1 == hierarchy.n_candidates


def test_the_coarsest_candidates_have_all_that_is_coarser(hierarchy):
    for n in (0, hierarchy.n_loose, 5, hierarchy.n_candidates, 10**6):
        part, coarse = hierarchy.coarsest(n)
        assert coarse.n_candidates == min(max(n, hierarchy.n_loose), hierarchy.n_candidates)
        assert coarse.n_loose == hierarchy.n_loose
        assert part.tolist() == hierarchy.parts(n).tolist()
        for fewer in range(hierarchy.n_loose, coarse.n_candidates + 1):
            assert coarse.parts(fewer)[part].tolist() == hierarchy.parts(fewer).tolist()
        for detail in np.linspace(0, 1, 11):
            assert coarse.n_parts(detail) == min(hierarchy.n_parts(detail), coarse.n_candidates)


def test_nested(hierarchy):
    for n in range(hierarchy.n_loose, hierarchy.n_candidates):
        coarse, fine = hierarchy.parts(n), hierarchy.parts(n + 1)
        assert len(np.unique(fine * 1000 + coarse)) == n + 1  # each finer part in one coarser


def test_salience_never_falls_and_detail_never_merges(hierarchy):
    assert (np.diff(hierarchy.salience) >= 0).all()
    counts = [hierarchy.n_parts(d) for d in np.linspace(0, 1, 21)]
    assert counts == sorted(counts)
    assert counts[0] == hierarchy.n_loose + (hierarchy.salience >= 1).sum()
    assert counts[-1] == hierarchy.n_candidates
    for detail in (0.2, 0.5, 0.7):
        kept = hierarchy.n_candidates - hierarchy.n_parts(detail)
        assert (hierarchy.salience[:kept] < 1 - detail).all()
        assert (hierarchy.salience[kept:] >= 1 - detail - 1e-9).all()


def test_the_merge_of_a_pair_is_the_first_level_that_joins_it(hierarchy):
    a, b = (x.ravel() for x in np.meshgrid(*[np.arange(hierarchy.n_candidates)] * 2))
    a, b = a[a != b], b[a != b]
    merge = hierarchy.merge_of(a, b)
    np.testing.assert_array_equal(merge, hierarchy.merge_of(b, a))
    for n in range(hierarchy.n_loose, hierarchy.n_candidates + 1):
        part = hierarchy.parts(n)
        np.testing.assert_array_equal(part[a] == part[b], merge < hierarchy.n_candidates - n)


def test_salience_becomes_its_running_maximum_within_zero_and_one():
    hierarchy = Hierarchy.of(5, [(0, 1), (1, 2), (2, 3), (3, 4)], [-0.5, 0.6, 0.3, 2.0])
    assert hierarchy.salience.tolist() == [0, 0.6, 0.6, 1]


def test_join_keeps_parts_apart_and_merges_the_weakest_first():
    rng = np.random.default_rng(0)
    parts = [random_hierarchy(rng, n) for n in (5, 1, 7)]
    joined = Hierarchy.join(parts)
    assert joined.n_candidates == 13
    assert joined.n_loose == 3
    assert joined.parts(3).tolist() == [0] * 5 + [1] + [2] * 7
    assert (np.diff(joined.salience) >= 0).all()
    for detail in np.linspace(0, 1, 11):
        assert joined.n_parts(detail) == sum(h.n_parts(detail) for h in parts)
        expected = np.concatenate([
            100 * i + h.parts_at(detail) for i, h in enumerate(parts)])
        got = joined.parts_at(detail)
        assert len(np.unique(got * 1000 + expected)) == len(np.unique(got)) == len(np.unique(expected))


def test_salience_between_two_candidates_is_that_at_which_they_come_together():
    rng = np.random.default_rng(0)
    joined = Hierarchy.join([random_hierarchy(rng, n) for n in (5, 1, 7)])
    a, b = np.indices((13, 13)).reshape(2, -1)
    between = joined.salience_between(a, b)
    np.testing.assert_array_equal(between.reshape(13, 13), joined.salience_table(np.arange(13)))
    for one, other, salience in zip(a, b, between, strict=True):
        together = [joined.parts(13 - done)[one] == joined.parts(13 - done)[other] for done in range(11)]
        expected = np.append(0.0, joined.salience)[together.index(True)] if any(together) else 1.0
        assert salience == expected


def test_one_candidate():
    hierarchy = Hierarchy.of(1, [], [])
    assert hierarchy.n_loose == 1
    assert hierarchy.n_parts(0) == hierarchy.n_parts(1) == 1
    assert hierarchy.parts(5).tolist() == [0]
    assert Hierarchy.join([hierarchy, hierarchy]).parts(1).tolist() == [0, 1]


def test_dendrogram_by_hand():
    """2-0 and 3-1 join, 0-2 is joined already, 1-2 joins all but 4."""
    tree = Dendrogram.of(5, np.array([(2, 0), (3, 1), (0, 2), (1, 2)]))
    assert tree.order.tolist() == [3, 1, 2, 0, 4]
    assert tree.roots.tolist() == [[0, 4], [4, 5]]
    assert tree.joins.tolist() == [[2, 3, 4], [0, 1, 2], [0, 2, 4]]
    assert tree.rows.tolist() == [0, 1, 3]
    never = np.iinfo(np.int64).max
    assert tree.row_of(np.array([0, 3, 0, 4]), np.array([2, 1, 3, 0])).tolist() == [0, 1, 3, never]


def test_candidates_in_several_pieces_are_split_and_merge_within_pieces():
    # Elements of pieces 0 0 0 1 1 1; candidates 0, 1 and 2 in each but 2 not in the second, 3 only there.
    given = Candidates(np.array([0, 1, 2, 1, 0, 3]), Hierarchy.of(4, [(0, 1), (2, 3), (1, 3)], [0.1, 0.2, 0.6]))
    split = given.within(np.array([0, 0, 0, 1, 1, 1]))
    hierarchy = split.hierarchy
    assert hierarchy.n_candidates == 6
    assert len(np.unique(split.element_candidate)) == 6
    assert hierarchy.salience.tolist() == [0.1, 0.1, 0.6, 0.6]
    assert hierarchy.parts(4)[split.element_candidate].tolist() in ([0, 0, 1, 2, 2, 3], [0, 0, 2, 1, 1, 3])
    assert len(np.unique(hierarchy.parts(1)[split.element_candidate[:3]])) == 1
    assert hierarchy.n_loose == 2


def test_a_candidate_is_not_parted_from_itself():
    hierarchy = Hierarchy.of(3, [(0, 1), (1, 2)], [0.2, 0.7])
    table = [(0, 0, 0.7, 0.2), (0, 0, 0.7, 0.2), (0.7, 0.7, 0, 0.7), (0.2, 0.2, 0.7, 0)]
    np.testing.assert_array_equal(hierarchy.salience_table(np.array([1, 1, 2, 0])), table)


def test_a_number_of_parts_of_any_type_that_is_whole():
    """Of NumPy's int8, the number of candidates became one, too, or could not."""
    hierarchy = Hierarchy.of(300, [(i, i + 1) for i in range(299)], np.linspace(0, 1, 299))
    for number in (100, np.int8(100), np.uint64(100)):
        assert hierarchy.parts(number).max() == 99
    for number in ("3", 2.0, None):
        with pytest.raises(ParameterError, match="^n_parts must be a whole number, not"):
            hierarchy.parts(number)
