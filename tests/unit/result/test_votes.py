# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces divided among several candidates: each level of detail has them where most of them is."""

import numpy as np
import pytest

from core.cuts.hierarchy import Hierarchy
from core.mesh.labels import majority
from core.result.votes import FaceVotes


def random_votes(seed, n_faces=40, count=12, each=5):
    """Votes of faces for candidates that merge in a random order, and the table (faces, candidates) of their areas."""
    rng = np.random.default_rng(seed)
    merges = [(rng.integers(0, k), k) for k in range(1, count)][::-1]
    hierarchy = Hierarchy.of(count, merges, np.sort(rng.random(count - 1)))
    owner, label = np.repeat(np.arange(n_faces), each), rng.integers(0, count, n_faces * each)
    weight = rng.random(len(owner)) + 0.01
    area = np.zeros((n_faces, count))
    np.add.at(area, (owner, label), weight)
    return FaceVotes(owner, label, weight, n_faces, hierarchy), hierarchy, area, (owner, label, weight)


def test_the_larger_side_of_the_last_merge_wins_though_its_candidates_are_smaller():
    hierarchy = Hierarchy.of(4, [(0, 1), (2, 3), (0, 2)], [0.1, 0.2, 0.3])
    owner = np.array([0, 0, 0, 2, 2, 3, 4, 4, 4])
    label = np.array([0, 1, 2, 3, 2, 1, 0, 3, 2])
    weight = np.array([0.3, 0.25, 0.45, 1.0, 1.0, 0.5, 0.4, 0.35, 0.25])
    votes = FaceVotes(owner, label, weight, 5, hierarchy)
    # 0: sides 0.55 and 0.45; 1 has no vote; 2: a tie, the first of the merge; 3: one vote; 4: sides 0.4 and 0.6.
    assert votes.winners().tolist() == [0, -1, 2, 1, 3]
    assert votes.loss(np.array([0, 0, 2]), np.array([0, 0, 3]), np.array([2, 1, 0])) == pytest.approx([0.1, 0.05, 2.0])


@pytest.mark.parametrize("seed", range(5))
def test_every_merge_leaves_a_face_on_the_side_that_has_more_of_it(seed):
    votes, hierarchy, area, _ = random_votes(seed)
    winner = votes.winners()
    for n in range(2, hierarchy.n_candidates + 1):
        before, after = hierarchy.parts(n), hierarchy.parts(n - 1)
        sides = area @ np.eye(n)[before]
        mine = before[winner]
        # The part that the winner's part merges with next, of those whose winner takes part in this merge.
        for face in range(len(winner)):
            rivals = np.unique(before[after == after[winner[face]]])
            assert sides[face, mine[face]] >= sides[face, rivals].max() - 1e-12


@pytest.mark.parametrize("seed", range(5))
def test_loss_is_what_the_two_sides_of_the_merge_have(seed):
    votes, hierarchy, area, _ = random_votes(seed)
    own, other = np.random.default_rng(seed).integers(0, hierarchy.n_candidates, (2, len(area)))
    loss = votes.loss(np.arange(len(area)), own, other)
    for face, (a, b) in enumerate(zip(own, other, strict=True)):
        if a != b:
            row = int(hierarchy.merge_of(np.array([a]), np.array([b]))[0])
            part = hierarchy.parts(hierarchy.n_candidates - row)
            assert loss[face] == pytest.approx(area[face, part == part[a]].sum() - area[face, part == part[b]].sum())


@pytest.mark.parametrize("seed", range(3))
def test_faces_of_two_candidates_go_to_the_larger(seed):
    votes, _, _, (owner, label, weight) = random_votes(seed, each=2)
    np.testing.assert_array_equal(votes.winners(), majority(owner, label, weight, votes.n_faces))


def test_one_candidate_needs_no_merge():
    votes = FaceVotes(np.array([0, 2]), np.array([0, 0]), np.ones(2), 3, Hierarchy.of(1, [], []))
    assert votes.winners().tolist() == [0, -1, 0]


def test_rounding_does_not_decide_between_sides_that_have_equally_much():
    weight = np.array([0.3, 0.1, 0.2])  # the sum of the last two is larger, by its last digit
    assert weight[1] + weight[2] > weight[0]
    hierarchy = Hierarchy.of(3, [(1, 2), (0, 1)], [0.1, 0.3])
    assert FaceVotes(np.zeros(3, np.int64), np.arange(3), weight, 1, hierarchy).winners().tolist() == [0]
