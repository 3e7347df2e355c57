# SPDX-License-Identifier: GPL-3.0-or-later
"""Hashes: equal for equal things only."""

import numpy as np

from core.arrays.hashes import hashed_rows, hashed_sets


def test_points_have_one_number_if_and_only_if_they_are_one_place():
    """A grid of whole numbers and halves, whose bits are nearly all zeros, on both sides of 0, twice."""
    line = np.arange(-10, 10) / 2
    points = np.stack(np.meshgrid(line, line, line), axis=-1).reshape(-1, 3)
    found = hashed_rows(np.concatenate([points, points]))
    assert np.array_equal(found[: len(points)], found[len(points) :])
    assert len(np.unique(found)) == len(points)
    assert hashed_rows(np.array([[0.0, 1, -0.0]])) == hashed_rows(np.array([[-0.0, 1, 0.0]]))


def test_owners_of_the_same_members_have_one_number_in_any_order():
    sets = [(4, 7, 1), (7, 1, 4), (4, 7), (4, 7, 2), (), (7, 4), ()]
    owner = np.repeat(np.arange(len(sets)), [len(members) for members in sets])
    found = hashed_sets(owner, np.concatenate(sets).astype(np.int64), len(sets))
    assert [found.tolist().index(number) for number in found] == [0, 0, 2, 3, 4, 2, 4]
