# SPDX-License-Identifier: GPL-3.0-or-later
"""Part numbers that follow the parts: answers worked out by hand, and identities."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.numbering import follow, numbered_parts, transfer


def test_follow_takes_the_largest_overlap_first():
    part = np.array([0, 0, 0, 1, 1, 2])
    former = np.array([5, 5, 2, 2, 5, 0])
    # Part 0 covers two of number 5; part 1 one each of 2 and 5; part 2 is new.
    assert follow(part, former, np.ones(6)).tolist() == [5, 2, 1]


def test_follow_weighs_elements():
    part = np.array([0, 0, 1])
    former = np.array([1, 2, 2])
    assert follow(part, former, np.array([1.0, 3.0, 2.0])).tolist() == [2, 3]


def test_follow_gives_new_parts_numbers_nobody_had():
    part = np.array([0, 1, 2, 2])
    former = np.array([1, 1, 1, 3])
    assert follow(part, former, np.array([3.0, 1.0, 1.0, 1.0])).tolist() == [1, 2, 3]


@pytest.mark.parametrize("seed", range(5))
def test_follow_of_the_same_parts_is_the_identity(seed):
    rng = np.random.default_rng(seed)
    part = np.unique(rng.integers(0, 8, 50), return_inverse=True)[1]
    numbers = rng.permutation(20)[: part.max() + 1] + 1
    assert (follow(part, numbers[part], rng.random(50) + 0.1) == numbers).all()


def test_transfer_is_a_majority_and_allows_zero():
    part = np.array([0, 0, 0, 1, 1, 1])
    former = np.array([4, 4, 1, 0, 0, 1])
    assert transfer(part, former, np.ones(6)).tolist() == [4, 0]


@pytest.fixture(scope="module")
def result():
    return decompose(*shapes.tube_tree(), Parameters(method="berretti"))


def test_first_numbers_are_the_labels(result):
    numbered = numbered_parts(result, 0.5)
    assert (numbered.face_numbers == result.parts(0.5).labels + 1).all()
    assert numbered.names == result.parts(0.5).names


def test_coarser_parts_keep_numbers_and_come_back(result):
    fine = numbered_parts(result, n_parts=result.n_candidates)
    former = fine.candidate_numbers
    for count in range(1, result.n_candidates):
        coarse = numbered_parts(result, n_parts=count, former=former)
        assert set(coarse.numbers) <= set(fine.numbers)
        assert (np.diff(coarse.numbers) > 0).all()
        # The number comes from a candidate inside the part.
        own = coarse.candidate_numbers == former
        assert set(coarse.candidate_numbers[own]) == set(coarse.numbers)
    again = numbered_parts(result, n_parts=result.n_candidates, former=former)
    assert (again.candidate_numbers == former).all()


def test_fixed_parts_stay_at_every_detail(result):
    fine = numbered_parts(result, n_parts=result.n_candidates)
    fixed = np.where(np.isin(fine.candidate_numbers, [1, 2]), 7, 0)
    for count in range(1, result.n_candidates):
        numbered = numbered_parts(result, n_parts=count, former=fine.candidate_numbers, fixed=fixed)
        assert ((numbered.candidate_numbers == 7) == (fixed == 7)).all()
        assert len(numbered.numbers) == max(count, len(set(numbered.numbers) - {7}) + 1)


def test_order_of_labels_is_order_of_numbers(result):
    former = np.arange(result.n_candidates)[::-1] + 1
    numbered = numbered_parts(result, n_parts=result.n_candidates, former=former)
    assert (numbered.candidate_numbers == former).all()
    parts = numbered.parts
    assert parts.area == pytest.approx(np.bincount(parts.candidate_part, result.candidate_area))
    assert (parts.cuts[:, 0] < parts.cuts[:, 1]).all()
