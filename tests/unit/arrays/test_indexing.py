# SPDX-License-Identifier: GPL-3.0-or-later
"""Idioms of whole arrays, by hand."""

import sys

import numpy as np
import pytest

from core.arrays.indexing import (
    bounds_of_each,
    ends_run,
    even_steps,
    expanded,
    first_of_rows,
    is_last_of_each,
    largest_of_each,
    last_of_each,
    place_among,
    places_of_ties,
    ranges,
    renumbered,
    rounded_order,
    run_starts,
    stable_order,
    sums_by,
    taken,
)


@pytest.mark.parametrize("index", [[3, 0, -1, 3], [[1, 2], [0, 0]], [], [True, False, False, True]])
def test_rows_are_those_of_an_index(index):
    values, index = np.arange(8.0).reshape(4, 2), np.array(index, None if index else np.int64)
    found = taken(values, index)
    assert np.array_equal(found, values[index])
    assert not np.shares_memory(found, values)


def test_ranges_are_listed_one_after_the_other():
    row, number = expanded(np.array([5, 0, 7, 2]), np.array([2, 0, 1, 3]))
    assert row.tolist() == [0, 0, 2, 3, 3, 3]
    assert number.tolist() == [5, 6, 7, 2, 3, 4]
    assert not len(ranges(np.empty(0, np.int32), np.empty(0, np.int32)))


@pytest.mark.parametrize(("values", "starts"), [([], []), ([4], [0]), ([2, 2, 0, 0, 0, 2, 5], [0, 2, 5, 6])])
def test_runs_begin_where_the_value_is_another(values, starts):
    assert run_starts(np.array(values, np.uint8)).tolist() == starts
    ends = np.flatnonzero(ends_run(np.array(values, np.uint8))) + 1
    assert [0, *ends][: len(starts)] == starts
    assert len(ends) == len(starts)


def test_ties_are_beside_each_other():
    assert places_of_ties(np.array([2, 2, 0, 2, 5, 5, 5])).tolist() == [0, 1, 4, 5, 6]
    assert not len(places_of_ties(np.empty(0)))


def test_what_is_not_chosen_has_no_place():
    assert place_among(np.array([4, 0, 2]), 6).tolist() == [1, -1, 2, -1, 0, -1]


@pytest.mark.parametrize(("low", "high"), [
    (0, 7), (-4, 4), (-3, 65_533), (-3, 65_534), (7, 90_000), (0, 2**40),
    (-(2**61), 2**61), (0, 2**63 - 1), (-(2**63), 2**63 - 1)])
@pytest.mark.parametrize("n", [0, 1, 50, 100_000])
def test_equal_numbers_stay_in_their_order(low, high, n):
    keys = np.random.default_rng(n).integers(low, high, n)
    keys[:2] = np.array([high - 1, low])[:n]  # so that both bounds are there: of 65,536 numbers, and one more
    assert (stable_order(keys) == np.argsort(keys, kind="stable")).all()


def test_numbers_alike_in_their_first_digits_are_told_apart_by_the_last():
    random = np.random.default_rng(0)
    keys = (random.integers(0, 5_000, 100_000) << 49) + random.integers(0, 3, 100_000)
    assert (stable_order(keys) == np.argsort(keys, kind="stable")).all()


def test_the_order_of_numbers_does_not_need_scipy(monkeypatch):
    keys = np.random.default_rng(0).integers(0, 90_000, 100_000)
    monkeypatch.setitem(sys.modules, "scipy.sparse", None)
    assert (stable_order(keys) == np.argsort(keys, kind="stable")).all()


@pytest.mark.parametrize("shape", [(0,), (1,), (2, 30), (4_000, 3)])
@pytest.mark.parametrize(("low", "high"), [(0, 3), (-9, 7), (1_000_000, 1_000_040), (-(2**62), 2**62)])
@pytest.mark.parametrize("dtype", [np.int64, np.int32])
def test_values_are_numbered_as_numpy_numbers_them(shape, low, high, dtype):
    bounds = np.clip([low, high], np.iinfo(dtype).min, np.iinfo(dtype).max)
    labels = np.random.default_rng(0).integers(*bounds, shape, dtype)
    names, index = renumbered(labels)
    wanted, places = np.unique(labels, return_inverse=True)
    assert names.dtype == dtype
    assert index.dtype == np.int64
    assert np.array_equal(names, wanted)
    assert np.array_equal(index, places.reshape(shape))


def test_numbers_that_differ_by_rounding_stay_in_their_order():
    values = np.tile([0.3, 0.1 + 0.2, 0.0, -0.0, 1e-3, 5.0], 1_000)
    values[6] += 1e-7  # as in single precision
    order = rounded_order(values)
    for group in ([2, 3], [4], [0, 1], [5]):
        count = 1_000 * len(group)
        assert (order[:count] == np.flatnonzero(np.isin(np.arange(6_000) % 6, group))).all()
        order = order[count:]
    assert (values[rounded_order(-values)] == 5.0)[:1_000].all()


def test_the_first_of_equal_rows():
    rows = np.random.default_rng(0).integers(0, 12, (5_000, 3))
    for scale in (1, 2**31, 2**45):  # packed into one integer, and too wide for that
        first = first_of_rows(rows * scale, 12 * scale)
        assert (first == np.unique(rows, axis=0, return_index=True)[1]).all()


def test_the_last_of_a_group_without_elements_is_none():
    group, key = np.array([0, 2, 2, 0]), np.array([1.0, 1.0, 3.0, 1.0])
    assert last_of_each(group, key, count=4).tolist() == [3, -1, 2, -1]
    assert is_last_of_each(group, key, count=4).tolist() == [False, False, True, True]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_of_keys_that_differ_by_rounding_the_next_key_decides(sign):
    first = sign * np.array([2.0, 2.0 * (1 - sign * 1e-6), 2.0 * (1 - sign * 1e-4)])
    assert last_of_each(np.zeros(3, int), first, np.array([0.0, 1.0, 2.0]), count=1).tolist() == [1]


@pytest.mark.parametrize("off", [-1e-12, 0.0, 1e-12])
def test_an_element_that_ends_at_a_step_but_for_rounding_has_it(off):
    """Of eight equal weights, two steps are at the ends of the second and of the sixth."""
    weight = np.ones(8)
    weight[1] += off
    assert even_steps(weight, 2).tolist() == [1, 5]


@pytest.mark.parametrize("shape", [(0,), (0, 2), (4,), (4, 2)])
def test_sums_are_float64_of_no_rows_too(shape):
    found = sums_by(np.full(shape[0], 1), np.ones(shape), 3)
    assert found.dtype == np.float64
    assert found.shape == (3, *shape[1:])
    assert np.array_equal(found.reshape(3, -1)[:, 0], [0, shape[0], 0])


def test_the_bounds_of_a_group_without_values_are_infinite():
    low, high = bounds_of_each(np.array([2, 0, 2]), np.array([[1, 5], [2, 2], [3, -4]]), 3)
    assert np.array_equal(low, [[2, 2], [np.inf, np.inf], [1, -4]])
    assert np.array_equal(high, [[2, 2], [-np.inf, -np.inf], [3, 5]])


def test_the_largest_of_a_group_without_values_is_0():
    assert np.array_equal(largest_of_each(np.array([2, 0, 2]), np.array([1.0, 4.0, 3.0]), 3), [4.0, 0.0, 3.0])
