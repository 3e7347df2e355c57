# SPDX-License-Identifier: GPL-3.0-or-later
"""Operations on whole arrays, most of them by indices: orders, sums by group, ranges, numbering."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, ParamSpec, TypeVar

import numpy as np

from .int64 import arange, cumsum, full
from .ties import TIE, ranks

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, DTypeLike

_Given = ParamSpec("_Given")
_Result = TypeVar("_Result")


def underflow_is_zero(function: Callable[_Given, _Result]) -> Callable[_Given, _Result]:
    """Decorator of what scripts call: what is too small to be a number is 0, also where they have NumPy raise there.

    Weights that fall with a distance become 0. What else NumPy can raise at does not happen.
    """

    @wraps(function)
    def quiet(*args: _Given.args, **kwargs: _Given.kwargs) -> _Result:
        with np.errstate(under="ignore"):
            return function(*args, **kwargs)

    return quiet


def frozen(array: ArrayLike, dtype: DTypeLike) -> np.ndarray:
    """Copy an array and make the copy read-only.

    array : array_like of any shape. Returns its values as ``dtype``, in C order.
    """
    copy = np.array(array, dtype=dtype, order="C")
    copy.flags.writeable = False
    return copy


def sealed(array: np.ndarray) -> np.ndarray:
    """Make an array that was just made, and that nobody else has, read-only: ``frozen`` without a copy."""
    array.flags.writeable = False
    return array


def rounded_order(values: np.ndarray) -> np.ndarray:
    """Sort numbers, (n,) float64, that are equal where they differ by rounding only; equal ones as they are.

    Returns (n,) int64.
    """
    return stable_order(ranks(values, float(np.abs(values).max(initial=0.0))))


def stable_order(keys: np.ndarray) -> np.ndarray:
    """Sort whole numbers, equal ones in the order in which they are.

    Parameters
    ----------
    keys : (n,) of int

    Returns
    -------
    order : (n,) int64
        What ``np.argsort(keys, kind="stable")`` returns.

    Notes
    -----
    Each way is the fastest for the keys that it is for. Where no other is, each number is sorted together with its
    place, packed into one integer, which NumPy does up to ten times faster than it finds their order. Keys of too many
    bits are sorted by their first ones, and those alike in these once more.
    """
    if len(keys) < 2_000:
        return np.argsort(keys, kind="stable")
    keys = np.asarray(keys, np.int64)
    least, most = int(keys.min()), int(keys.max())
    if most - least >= 2**63:
        return np.argsort(keys, kind="stable")
    if most - least < 2**16:  # NumPy counts numbers of 16 bits
        return np.argsort((keys - least).astype(np.uint16), kind="stable")
    if most - least < len(keys) and (order := _counted_order(keys - least, most - least + 1)) is not None:
        return order
    keys, width = keys - least, (most - least).bit_length()
    further = width + (len(keys) - 1).bit_length() - 63
    if further <= 0:
        return _packed_order(keys, width)
    first = keys >> further
    order = _packed_order(first, width - further)
    tied = places_of_ties(first[order])
    some = order[tied]
    order[tied] = some[_packed_order(keys[some], width)]
    return order


def _counted_order(keys: np.ndarray, count: int) -> np.ndarray | None:
    """What ``stable_order`` returns for keys 0..count-1, found by counting; None without SciPy."""
    try:
        from scipy.sparse import csr_array  # imported here for the reason that arrays.components gives
    except ImportError:
        return None
    rows = arange(len(keys) + 1)
    matrix = csr_array((np.ones(len(keys), np.int8), keys, rows), shape=(len(keys), count))
    return matrix.tocsc().indices.astype(np.int64)


def _packed_order(keys: np.ndarray, width: int) -> np.ndarray:
    """What ``stable_order`` returns for keys of so many bits, each sorted with its place; by its last bits first."""
    for_place = (len(keys) - 1).bit_length()
    room = 63 - for_place
    place = arange(len(keys))
    order = place
    for shift in range(0, width, room):
        digits = ((keys if shift == 0 else keys[order]) >> shift) & ((1 << room) - 1)
        step = np.sort(digits << for_place | place) & ((1 << for_place) - 1)
        order = step if shift == 0 else order[step]
    return order


def begins_run(values: np.ndarray) -> np.ndarray:
    """Whether each of some values, (n,), is another than the one before, (n,) bool; true for the first."""
    begins = np.ones(len(values), bool)
    np.not_equal(values[1:], values[:-1], out=begins[1:])
    return begins


def ends_run(values: np.ndarray) -> np.ndarray:
    """Whether each of some values, (n,), is another than the one after, (n,) bool; true for the last."""
    ends = np.ones(len(values), bool)
    np.not_equal(values[1:], values[:-1], out=ends[:-1])
    return ends


def places_of_ties(values: np.ndarray) -> np.ndarray:
    """Where values, (n,), are equal to the one before or the one after: (k,) int64, rising."""
    return np.flatnonzero(~(begins_run(values) & ends_run(values)))


def run_starts(values: np.ndarray) -> np.ndarray:
    """Where runs of equal values, (n,), begin: (r,) int64, rising, from 0."""
    return np.flatnonzero(begins_run(values))


def inverse(order: np.ndarray) -> np.ndarray:
    """Place of each element in an order, (n,) int64. order : (n,) int64, the element at each place."""
    place = np.empty(len(order), np.int64)
    place[order] = arange(len(order))
    return place


def place_among(chosen: np.ndarray, count: int) -> np.ndarray:
    """Place among some chosen elements, (k,) int64, of each element 0..count-1: (count,) int64; -1 for all others."""
    place = full(count, -1)
    place[chosen] = arange(len(chosen))
    return place


def sums_by(index: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Sum the rows of an array by group.

    Parameters
    ----------
    index : (n,) int64
        Group of each row, 0..count-1.
    values : (n,) or (n, k) float64
    count : int
        Number of groups.

    Returns
    -------
    sums : (count,) or (count, k) float64
        0 for a group without rows.
    """
    if values.ndim == 1:
        # Of no rows, NumPy has whole numbers.
        return np.bincount(index, values, count).astype(np.float64, copy=False)
    # One column at a time is several times faster than np.add.at, and adds in the order of the rows.
    return np.stack([sums_by(index, column, count) for column in values.T], axis=1)


def bounds_of_each(index: np.ndarray, values: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Find the least and the largest value of each group.

    index : (n,) int64, group of each value, 0..count-1. values : (n,) or (n, k) float64. Returns (count,) or (count, k)
    float64 twice; inf and -inf for a group without values.
    """
    shape = (count, *values.shape[1:])
    low, high = np.full(shape, np.inf), np.full(shape, -np.inf)
    # Column by column NumPy is some ten times as fast.
    for least, most, value in zip(low.reshape(count, -1).T, high.reshape(count, -1).T,
                                  values.reshape(len(values), -1).T, strict=True):
        np.minimum.at(least, index, value)
        np.maximum.at(most, index, value)
    return low, high


def largest_of_each(index: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Find the largest value of each group, where none is negative.

    index : (n,) int64, group of each value, 0..count-1. values : (n,) float64, 0 or more. Returns (count,) float64; 0
    for a group without values.
    """
    largest = np.zeros(count)
    np.maximum.at(largest, index, values)
    return largest


def taken(values: np.ndarray, index: np.ndarray) -> np.ndarray:
    """Rows of an array, (n, k), as ``values[index]`` would copy them, three to five times as fast.

    Of one dimension, (n,), as fast as that. index : int64 of any shape, or (n,) bool.
    """
    return values.compress(index, axis=0) if index.dtype == bool else values.take(index, axis=0)


def expanded(first: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """List the numbers of many ranges, one range after the other.

    Parameters
    ----------
    first, count : (n,) int64
        Range i is first[i], first[i] + 1, ...: count[i] numbers, 0 or more.

    Returns
    -------
    row, number : (count.sum(),) int64
        Range of each number, and the numbers.
    """
    return np.repeat(arange(len(first)), count), ranges(first, count)


def ranges(first: np.ndarray, count: np.ndarray) -> np.ndarray:
    """What ``expanded`` returns without the range of each number: (count.sum(),) int64."""
    before = cumsum(count)
    total = int(before[-1]) if len(before) else 0
    before -= count
    return arange(total) + np.repeat(first - before, count)


def spread_evenly(weight: np.ndarray, order: np.ndarray, count: int) -> np.ndarray:
    """Choose elements at equal steps of weight, such as faces at equal steps of area.

    Parameters
    ----------
    weight : (m,) float64
        Of each element.
    order : (m,) float64
        By which elements are sorted; values that do not depend on the order of the elements, such as the AGD of faces,
        make the choice independent of it.
    count : int
        Number of steps.

    Returns
    -------
    chosen : (count,) int64 or fewer
        In their order; an element as heavy as several steps once.
    """
    along = rounded_order(order)
    return along[even_steps(weight[along], count)]


def even_steps(weight: np.ndarray, count: int) -> np.ndarray:
    """Places at equal steps of weight, (count,) int64 or fewer, among elements in some order. weight : (m,) float64."""
    total = np.cumsum(weight)
    # Where an element ends at a step, as many faces do on a regular grid, the step is in this element.
    steps = (arange(count) + 0.5) / count * total[-1] * (1 - TIE)
    return np.unique(np.searchsorted(total, steps).clip(max=len(weight) - 1))


def first_at_place(points: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Find the first of some points that lie at one place.

    Parameters
    ----------
    points : (n, 3) float64
    chosen : (k,) int64
        Those of them that are compared, rising.

    Returns
    -------
    first : (n,) int64
        The first chosen point at the place of each chosen point; all others themselves.
    """
    first = arange(len(points))
    # Adding 0.0 turns -0.0 into 0.0: both are one place.
    _, at, place = np.unique(points[chosen] + 0.0, axis=0, return_index=True, return_inverse=True)
    first[chosen] = chosen[at[place.reshape(-1)]]
    return first


def renumbered(labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number the distinct values of an array from 0.

    Parameters
    ----------
    labels : array of int, of any shape

    Returns
    -------
    names : (c,), of the dtype of ``labels``
        The distinct values, rising.
    index : shape of ``labels``, int64
        Place of each value in ``names``, 0..c-1.
    """
    flat = np.ravel(labels)
    least, most = (int(flat.min()), int(flat.max())) if len(flat) else (0, 0)
    if most - least <= 2 * len(flat):
        return _few_names(flat, least, most - least + 1, np.shape(labels))
    order = stable_order(flat)
    values = flat[order]
    new = begins_run(values)
    index = np.empty(len(flat), np.int64)
    index[order] = cumsum(new) - 1
    return values[new], index.reshape(np.shape(labels))


def _few_names(flat: np.ndarray, least: int, count: int, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """What ``renumbered`` returns for values of least..least+count-1, found without sorting them."""
    value = flat.astype(np.int64) - least
    there = np.zeros(count, bool)
    there[value] = True
    return (np.flatnonzero(there) + least).astype(flat.dtype), (cumsum(there) - 1)[value].reshape(shape)


def first_of_rows(rows: np.ndarray, width: int) -> np.ndarray:
    """Find the distinct rows of an array.

    Parameters
    ----------
    rows : (n, k) int64
        0..width-1.
    width : int

    Returns
    -------
    first : (c,) int64
        Index of the first of equal rows, in the lexicographic order of the rows.
    """
    keys, size = rows[:, 0], width
    for column in rows.T[1:]:
        if size * width >= 2**62:
            names, keys = renumbered(keys)
            size = len(names)
        keys = keys * width + column
        size *= width
    order = stable_order(keys)
    return order[begins_run(keys[order])]


def last_of_each(group: np.ndarray, *keys: np.ndarray, count: int) -> np.ndarray:
    """Find the element of each group that comes last when the elements are sorted by some keys.

    Parameters
    ----------
    group : (n,) int64
        Group of each element, 0..count-1.
    *keys : (n,) arrays
        Elements are sorted by the first key, equal ones by the second, and so on. Numbers that differ from the
        largest by rounding only are equal to it.
    count : int
        Number of groups.

    Returns
    -------
    last : (count,) int64
        Index of that element; of elements equal in all keys the highest index. -1 for a group without elements.
    """
    # Those that come last by the first key, of them those that do by the second: several times faster than sorting.
    rows = arange(len(group))
    for key in keys:
        values, of = key[rows], group[rows]
        if not len(rows):
            break
        largest = np.full(count, values.min(), values.dtype)
        np.maximum.at(largest, of, values)
        if key.dtype == np.float64:
            largest -= TIE * np.abs(largest)
        rows = rows[values >= largest[of]]
    last = full(count, -1)
    last[group[rows]] = rows  # NumPy keeps the last of the values written to one place
    return last


def is_last_of_each(group: np.ndarray, *keys: np.ndarray, count: int) -> np.ndarray:
    """Which elements ``last_of_each`` finds, (n,) bool; nothing for a group without elements."""
    last = last_of_each(group, *keys, count=count)
    chosen = np.zeros(len(group), bool)
    chosen[last[last >= 0]] = True
    return chosen
