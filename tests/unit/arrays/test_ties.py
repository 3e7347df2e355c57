# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that are equal but for rounding, and numbers in whole steps."""

import numpy as np
import pytest

from core.arrays.ties import DENSE, TIE, first_largest, first_least, ranks, rounded, square_roots, whole_steps

BELOW = 1 - TIE / 4  # what rounding does to a number
FAR = 1 - 4 * TIE  # what it does not


@pytest.mark.parametrize("scale", [1e-9, 1.0, 3e7])
def test_of_numbers_that_differ_by_rounding_the_first_is_chosen(scale):
    assert first_largest(scale * np.array([0.5, BELOW, 1.0, BELOW])) == 1
    assert first_largest(scale * np.array([0.5, FAR, 1.0, BELOW])) == 2
    rows = np.array([(2.0, 1.0, BELOW), (2.0, 1.0, FAR), (0.0, 0.0, 1.0)])
    assert first_least(scale * rows).tolist() == [1, 2, 0]


def test_numbers_on_both_sides_of_a_power_of_two_are_rounded_alike():
    assert rounded(np.array([1 - 1e-12, 1.0, 1 + 1e-12, -3.0, 0.0])).tolist() == [1.0, 1.0, 1.0, -3.0, 0.0]
    assert rounded(np.array([FAR]))[0] != 1.0


def test_ranks_are_those_of_the_values_and_equal_where_only_rounding_differs():
    values = np.array([3.0, 1.0, 3.0 + TIE / 2, 2.0, 1.0 - TIE / 2])
    assert ranks(values, 1.0).tolist() == [2, 0, 2, 1, 0]
    assert ranks(values, 1e-6).tolist() == [3, 1, 4, 2, 0]
    assert ranks(np.empty(0), 1.0).tolist() == []


@pytest.mark.parametrize("count", [DENSE // 2, 2 * DENSE])
def test_a_long_row_of_values_near_each_other_is_not_all_of_one_rank(count):
    rank = ranks(np.linspace(0, count * TIE / 4, count), 1.0)
    assert (np.diff(rank) >= 0).all()
    assert np.bincount(rank - rank[0]).max() <= 40
    assert len(np.unique(rank)) > count / 40


def test_roots_of_what_would_be_0_but_for_rounding_are_0():
    assert square_roots(np.array([-1e-16, 1e-16, 4.0]), np.array([1.0, 1.0, 9.0])).tolist() == [0.0, 0.0, 2.0]


def test_of_ways_that_are_equally_long_that_of_fewest_steps_is_the_shortest():
    steps = whole_steps(np.array([0.0, 0.1, 0.2, 0.3]))
    assert (steps == np.rint(steps)).all()
    assert steps[0] == 1
    assert steps[1:] * 2.0**-22 == pytest.approx([0.1, 0.2, 0.3], abs=2.0**-23)
