# SPDX-License-Identifier: GPL-3.0-or-later
"""Average linkage by hand, and against means over all pairs of two groups."""

import numpy as np
import pytest

from core.arrays.components import components
from core.cuts.joining.linkage import JudgedPairs, average_linkage


def judged(pairs, score, weight=None, near=None):
    """Pairs that all count alike, and all are near, unless it is said."""
    one = np.ones(len(pairs))
    return JudgedPairs(np.array(pairs), np.array(score, float), np.array(one if weight is None else weight),
                       np.array(one if near is None else near, bool))


def test_four_members_by_hand():
    pairs = np.array([(0, 1), (1, 2), (0, 2), (2, 3)])
    merges, scores, rows = average_linkage(
        4, judged(pairs, [3.0, 2.0, -1.0, 1.0], [1.0, 1.0, 3.0, 2.0]))
    # 0 and 1 first; then 2 and 3, because {0, 1} and 2 score (2 - 3) / 4.
    assert [set(m) for m in merges.tolist()] == [{0, 1}, {2, 3}, {0, 2}]
    assert scores.tolist() == [3.0, 1.0, -0.25]
    assert rows.tolist() == [0, 3, 1]  # of the last two groups 1 and 2 are the best pair


def test_small_groups_join_more_easily():
    pairs, score, size = np.array([(0, 1), (1, 2), (2, 3)]), np.array([1.0, 0.8, 1.5]), np.exp([-2.0, -2.0, 0.0, 1.0])
    merges, scores, _ = average_linkage(4, judged(pairs, score), size, 0.5)
    # Half of the logarithm of the smaller, which is -2, is taken from the score of 0 and 1; 2 and 3 are large, and
    # {0, 1} is twice as large as either.
    assert [set(m) for m in merges.tolist()] == [{0, 1}, {2, 3}, {0, 2}]
    assert scores.tolist() == pytest.approx([2.0, 1.5, 0.8 + 0.5 * (2 - np.log(2))])


def test_what_was_not_compared_stays_apart():
    merges, scores, rows = average_linkage(4, judged([(0, 3)], [-9.0]))
    assert merges.tolist() == [[0, 3]]
    assert (scores.tolist(), rows.tolist()) == ([-9.0], [0])
    nothing = average_linkage(3, judged(np.empty((0, 2), int), []))
    assert [x.shape for x in nothing] == [(0, 2), (0,), (0,)]


def test_far_pairs_count_and_join_nothing():
    # Both arms, 0 and 2, are as much of the shoulder, 1, as could be; that they are not one part is said of them alone.
    pairs, score = np.array([(0, 1), (1, 2), (0, 2), (2, 3)]), np.array([2.0, 2.0, -9.0, 5.0])
    merges, scores, rows = average_linkage(4, judged(pairs, score, near=[True, True, False, False]))
    assert [set(m) for m in merges.tolist()] == [{0, 1}, {0, 2}]
    assert scores.tolist() == [2.0, -3.5]
    assert rows.tolist() == [0, 1]


@pytest.mark.parametrize("share_near", [0.4, 1.0])
@pytest.mark.parametrize("ease", [0.0, 0.3])
@pytest.mark.parametrize("seed", range(5))
def test_every_merge_joins_two_groups_with_the_mean_of_their_pairs(seed, ease, share_near):
    rng = np.random.default_rng(seed)
    pairs = np.stack(np.triu_indices(25, 1), axis=1)
    pairs = pairs[rng.random(len(pairs)) < 0.2]
    score, weight = rng.normal(size=len(pairs)), 0.1 + rng.random(len(pairs))
    size = 0.1 + rng.random(25)
    near = rng.random(len(pairs)) < share_near
    merges, scores, rows = average_linkage(25, judged(pairs, score, weight, near), size, ease)
    group = np.arange(25)
    for (a, b), found, row in zip(merges.tolist(), scores, rows, strict=True):
        assert group[a] == a < b == group[b]  # each group is named by its lowest member
        means = {}
        for x, y in {tuple(sorted(p)) for p in group[pairs[near]].tolist() if p[0] != p[1]}:
            between = (np.sort(group[pairs], axis=1) == (x, y)).all(axis=1)
            smaller = min(size[group == x].sum(), size[group == y].sum())
            means[x, y] = np.average(score[between], weights=weight[between]) - ease * np.log(min(smaller, 1))
            if {x, y} == {a, b}:
                assert score[row] == score[between & near].max()
                assert (between & near)[row]
        assert found == pytest.approx(means[min(a, b), max(a, b)])
        assert found == pytest.approx(max(means.values()))
        group[group == b] = a
    assert len(np.unique(group)) == components(25, *pairs[near].T)[0]
