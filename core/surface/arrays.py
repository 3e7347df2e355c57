# SPDX-License-Identifier: GPL-3.0-or-later
"""Operations on whole arrays that every stage uses: connected components, sums by group, pairs, numbering."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, DTypeLike
    from scipy.sparse import csr_array

MANY_ELEMENTS = 5_000  # number of elements from which on it is faster to divide the search for components into rounds
FEW_ELEMENTS = 600  # number of elements and pairs up to which a search in Python takes less time than a call of SciPy


def frozen(array: ArrayLike, dtype: DTypeLike) -> np.ndarray:
    """Copy an array and make the copy read-only.

    array : array_like of any shape. Returns its values as ``dtype``, in C order.
    """
    copy = np.array(array, dtype=dtype, order="C")
    copy.flags.writeable = False
    return copy


# Numbers whose difference is less, in units of the larger, are equal but for rounding: models come in single precision,
# or with six digits, and a model that is moved or scaled comes with others. They are compared with the largest, or the
# least, and not rounded one by one: two lengths that differ in the last digit would be equal at one scale and not at
# another.
TIE = 2.0**-17
DENSE = 30_000  # number of values from which on it takes too long to find out which are equal


def first_largest(values: np.ndarray) -> int:
    """Find the largest value; of values that differ from it by rounding only, the first.

    On a symmetric shape two points are equally far from its middle. The last bit of the two distances depends on
    the processor and on the position of the shape, but the order of the vertices does not.

    Parameters
    ----------
    values : (n,) float64
        At least one, none negative.

    Returns
    -------
    index : int
    """
    return int((values >= (1 - TIE) * values.max()).argmax())


def first_least(rows: np.ndarray) -> np.ndarray:
    """The column of the least value of each row, (n,) int64; of those that differ by rounding only, the first.

    rows : (n, k) float64, none negative.
    """
    return (rows <= (1 + TIE) * rows.min(axis=1)[:, None]).argmax(axis=1)


def rounded(values: np.ndarray, digits: int = 18) -> np.ndarray:
    """Numbers without their last digits, so that rounding errors do not decide which of two equal ones is larger.

    values : array of float64. digits : int, binary ones that stay; 18 are TIE. Returns float64.
    """
    mantissa, exponent = np.frexp(values)
    return np.ldexp(np.rint(mantissa * 2.0**digits), exponent - digits)


def ranks(values: np.ndarray, unit: float) -> np.ndarray:
    """Number values in their order, those that differ by rounding only alike.

    Parameters
    ----------
    values : (n,) float64
    unit : float
        Values are equal if none between them is farther from the next than TIE of this. A long row of such, as a dense
        mesh has them, is divided evenly.

    Returns
    -------
    rank : (n,) int64
    """
    same = TIE * max(unit, 1e-300)
    if len(values) > DENSE:
        return np.rint(values / same).astype(np.int64)
    order = np.argsort(values, kind="stable")
    ranked = values[order]
    begins = np.append(True, np.diff(ranked) > same)[: len(values)]
    row = np.cumsum(begins) - 1
    part = ((ranked - ranked[begins][row]) / (8 * same)).astype(np.int64)
    begins[1:] |= part[1:] != part[:-1]
    rank = np.empty(len(values), np.int64)
    rank[order] = np.cumsum(begins) - 1
    return rank


def rounded_order(values: np.ndarray) -> np.ndarray:
    """Sort numbers, (n,) float64, that are equal where they differ by rounding only; equal ones as they are.

    Returns (n,) int64.
    """
    return stable_order(ranks(values, float(np.abs(values).max(initial=0.0))))


def on_grid(values: np.ndarray) -> np.ndarray:
    """Numbers of about 1 in whole steps of 2**-40: logarithms and such, whose last digits differ between versions."""
    return np.rint(values * 2.0**40) / 2.0**40


def in_steps(values: np.ndarray) -> np.ndarray:
    """Features in whole steps of 2**-14: what is 0 or 1, or equal, but for rounding, is exactly that."""
    return np.rint(values * 2.0**14) / 2.0**14


def square_roots(values: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Square roots of differences that would not be negative but for rounding.

    values : array of float64. scale : array of float64, size of what they are differences of. What is below 1e-12 of
    it is 0: the root would be a thousand times as large as the rounding error that it comes from.
    """
    return np.sqrt(np.where(values > 1e-12 * scale, values, 0.0))


def whole_steps(length: np.ndarray, step: float = 2.0**-22) -> np.ndarray:
    """Lengths of ways in whole steps, one or more: their sums are exact.

    Of two ways that are equally long, rounding must not choose; of those through elements that lie in one place, that
    through the fewest is the shortest.
    length : array of float64, in units of about the size of the surface.
    """
    return np.maximum(np.rint(length / step), 1.0)


def components(n: int, a: np.ndarray, b: np.ndarray) -> tuple[int, np.ndarray]:
    """Find the connected components of elements that are joined in pairs.

    Parameters
    ----------
    n : int
        Number of elements.
    a, b : (e,) int64
        Element a[i] is joined with element b[i].

    Returns
    -------
    count : int
        Number of components.
    label : (n,) int64
        Component of each element, 0..count-1. Components are numbered in the order of their lowest elements,
        so that the numbering does not depend on the library.
    """
    if n + len(a) <= FEW_ELEMENTS:
        return _joined_in_turn(n, a, b)
    if n < MANY_ELEMENTS:
        return _few_components(n, a, b)
    # Each element goes to a lower one that it is joined with, and on to where that one goes, as far down as it comes.
    goal = np.arange(n)
    goal[np.maximum(a, b)] = np.minimum(a, b)
    while ((lower := goal[goal]) != goal).any():
        goal = lower
    lowest = np.flatnonzero(goal == np.arange(n))
    place = np.empty(n, np.int64)
    place[lowest] = np.arange(len(lowest))
    place = place[goal]
    a, b = place[a], place[b]
    apart = np.flatnonzero(a != b)
    # Of a mesh, whose faces are sorted by place, one in sixteen is left.
    further = components if len(lowest) < n // 2 else _few_components
    count, label = further(len(lowest), a[apart], b[apart])
    return count, label[place]


def _joined_in_turn(n: int, a: np.ndarray, b: np.ndarray) -> tuple[int, np.ndarray]:
    """What ``components`` returns, pair by pair: each element knows a lower one of its component, the lowest itself."""
    lower = list(range(n))
    for first, second in zip(a.tolist(), b.tolist(), strict=True):
        while lower[first] != first:
            lower[first] = first = lower[lower[first]]
        while lower[second] != second:
            lower[second] = second = lower[lower[second]]
        lower[max(first, second)] = min(first, second)
    count, label = 0, []
    for element, goal in enumerate(lower):
        if goal == element:
            label.append(count)
            count += 1
        else:
            label.append(label[goal])
    return count, np.array(label, np.int64)


def _few_components(n: int, a: np.ndarray, b: np.ndarray) -> tuple[int, np.ndarray]:
    """What ``components`` returns, found by SciPy in one search."""
    # Imported here, because Blender's panel reads stored parts also where SciPy is missing, to say that it is.
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    if n == 0:
        return 0, np.empty(0, np.int64)
    graph = coo_array((np.ones(len(a)), (a, b)), shape=(n, n))
    count, label = connected_components(graph, directed=False)
    first = np.empty(count, np.int64)
    first[label[::-1]] = np.arange(n - 1, -1, -1)  # NumPy keeps the last of the values written to one place
    return count, inverse(np.argsort(first, kind="stable"))[label]


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
    place, packed into one integer, which NumPy does up to ten times faster than it finds their order.
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
    return _packed_order(keys - least, (most - least).bit_length())


def _counted_order(keys: np.ndarray, count: int) -> np.ndarray | None:
    """What ``stable_order`` returns for keys 0..count-1, found by counting; None without SciPy."""
    try:
        from scipy.sparse import csr_array  # imported here for the reason that ``components`` gives
    except ImportError:
        return None
    rows = np.arange(len(keys) + 1)
    matrix = csr_array((np.ones(len(keys), np.int8), keys, rows), shape=(len(keys), count))
    return matrix.tocsc().indices.astype(np.int64)


def _packed_order(keys: np.ndarray, width: int) -> np.ndarray:
    """What ``stable_order`` returns for keys of so many bits, each sorted with its place; by its last bits first."""
    for_place = (len(keys) - 1).bit_length()
    room = 63 - for_place
    place = np.arange(len(keys))
    order = place
    for shift in range(0, width, room):
        digits = ((keys if shift == 0 else keys[order]) >> shift) & ((1 << room) - 1)
        step = np.sort(digits << for_place | place) & ((1 << for_place) - 1)
        order = step if shift == 0 else order[step]
    return order


def inverse(order: np.ndarray) -> np.ndarray:
    """Place of each element in an order, (n,) int64. order : (n,) int64, the element at each place."""
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
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
        return np.bincount(index, values, count)
    # One column at a time is several times faster than np.add.at, and adds in the order of the rows.
    return np.stack([np.bincount(index, column, count) for column in values.T], axis=1)


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross products of vectors, (n, 3) each: those of ``np.cross``, several times as fast."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)


def lengths(vectors: np.ndarray) -> np.ndarray:
    """Lengths of vectors, (n, 2 or 3): those of ``np.linalg.norm``, several times as fast. Returns (n,) float64."""
    return np.sqrt(row_products(vectors, vectors))


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors, (n, 3), divided by their lengths: (n, 3) float64 of length 1, or of 0 where the length is 0."""
    return vectors / np.maximum(lengths(vectors), 1e-300)[:, None]


def weighted_sum(weights: np.ndarray, values: np.ndarray) -> np.ndarray | float:
    """Sum values, each times its weight, in an order that is the same everywhere.

    A product of matrices adds in an order that depends on the processor, on the number of threads, and on where in
    memory the arrays happen to lie; what two machines decide by the result may then differ.

    Parameters
    ----------
    weights : (n,) float64
    values : (n,) or (n, k) float64

    Returns
    -------
    sum : float64 or (k,) float64
    """
    return (weights * values.T).T.sum(axis=0)


def inner_products(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Inner products of points, (n, 3), with one vector, (3,), or with several, (k, 3).

    Returns (n,) or (n, k) float64, the same everywhere, see ``weighted_sum``.
    """
    total = np.multiply.outer(a[:, 0], b[..., 0])
    for i in (1, 2):
        total += np.multiply.outer(a[:, i], b[..., i])
    return total


def row_products(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Inner product of each vector and that of the same row, (n, 2 or 3) each: (n,) float64, the same everywhere."""
    first, *others = (p * q for p, q in zip(a.T, b.T, strict=True))
    return sum(others, first)


def second_moments(points: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Sum of the outer product of each point, (n, 3), with itself, times its weight, (n,): (3, 3) float64."""
    x, y, z = points.T
    xx, yy, zz, yz, zx, xy = (weighted_sum(weights, p) for p in (x * x, y * y, z * z, y * z, z * x, x * y))
    return np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])


def second_moments_of_each(index: np.ndarray, points: np.ndarray, weights: np.ndarray, count: int) -> np.ndarray:
    """Sum the weighted products of the coordinates of points, (n, 3), by ``index``, (n,): (count, 3, 3) float64."""
    products = weights[:, None] * (points[:, :, None] * points[:, None, :]).reshape(-1, 9)
    return sums_by(index, products, count).reshape(-1, 3, 3)


def both_ways(pairs: np.ndarray) -> np.ndarray:
    """List each pair, then each pair the other way round.

    pairs : (e, 2) array. Returns (2e, 2), of the dtype given.
    """
    return np.concatenate([pairs, pairs[:, ::-1]])


def symmetric_matrix(pairs: np.ndarray, values: np.ndarray, n: int) -> csr_array:
    """Make a sparse symmetric matrix from pairs, each of which is named in one direction only.

    Parameters
    ----------
    pairs : (e, 2) int64
        Row and column, 0..n-1.
    values : (e,) float64
        Entry of each pair. The values of a pair that is named twice are added.
    n : int
        Number of rows and of columns.

    Returns
    -------
    matrix : (n, n) scipy.sparse.csr_array
    """
    from scipy.sparse import coo_array  # imported here for the reason that ``components`` gives

    # SciPy's searches take indices of 32 bits and would convert others each time.
    a, b = both_ways(pairs.astype(np.int32)).T
    return coo_array((np.concatenate([values, values]), (a, b)), shape=(n, n)).tocsr()


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
    return np.repeat(np.arange(len(first)), count), ranges(first, count)


def ranges(first: np.ndarray, count: np.ndarray) -> np.ndarray:
    """What ``expanded`` returns without the range of each number: (count.sum(),) int64."""
    before = np.cumsum(count, dtype=np.int64)
    total = int(before[-1]) if len(before) else 0
    before -= count
    return np.arange(total) + np.repeat(first - before, count)


def spread_evenly(area: np.ndarray, order: np.ndarray, count: int) -> np.ndarray:
    """Choose faces at equal steps of area.

    Parameters
    ----------
    area : (m,) float64
        Of each face.
    order : (m,) float64
        By which the faces are sorted; values that do not depend on the order of the faces, such as the AGD, make the
        choice independent of it.
    count : int
        Number of steps.

    Returns
    -------
    faces : (count,) int64 or fewer
        In their order; a face as large as several steps once.
    """
    along = rounded_order(order)
    return along[even_steps(area[along], count)]


def even_steps(area: np.ndarray, count: int) -> np.ndarray:
    """Places at equal steps of area, (count,) int64 or fewer, among faces in some order. area : (m,) float64."""
    total = np.cumsum(area)
    # Where a face ends at a step, as many do on a regular grid, the step is in this face.
    steps = (np.arange(count) + 0.5) / count * total[-1] * (1 - TIE)
    return np.unique(np.searchsorted(total, steps).clip(max=len(area) - 1))


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
    first = np.arange(len(points))
    # Adding 0.0 turns -0.0 into 0.0: both are one place.
    _, place, inverse = np.unique(points[chosen] + 0.0, axis=0, return_index=True, return_inverse=True)
    first[chosen] = chosen[place[inverse.reshape(-1)]]
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
    new = np.append(True, values[1:] != values[:-1])[: len(values)]
    index = np.empty(len(flat), np.int64)
    index[order] = np.cumsum(new) - 1
    return values[new], index.reshape(np.shape(labels))


def _few_names(flat: np.ndarray, least: int, count: int, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """What ``renumbered`` returns for values of least..least+count-1, found without sorting them."""
    value = flat.astype(np.int64) - least
    there = np.zeros(count, bool)
    there[value] = True
    return (np.flatnonzero(there) + least).astype(flat.dtype), (np.cumsum(there) - 1)[value].reshape(shape)


def pair_keys(pairs: np.ndarray, count: int) -> np.ndarray:
    """One whole number for each pair, by which pairs are compared and sorted faster than row by row.

    pairs : (n, 2) of int, each 0..count-1. Returns (n,) int64, in the lexicographic order of the pairs.
    """
    return pairs @ np.array([count, 1], np.int64)


def are_among(pairs: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Whether each pair is one of some others, (n,) bool. pairs, others : (n, 2) and (k, 2) int64, 0 or more."""
    count = int(max(pairs.max(initial=0), others.max(initial=0))) + 1
    return np.isin(pair_keys(pairs, count), pair_keys(others, count))


def distinct_pairs(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number the distinct pairs of two arrays of labels from 0.

    Parameters
    ----------
    first, second : (n,) int64
        Pair i is (first[i], second[i]); both are 0 or more.

    Returns
    -------
    pairs : (c, 2) int64
        The distinct pairs in lexicographic order.
    index : (n,) int64
        Place of each pair in ``pairs``, 0..c-1.
    """
    # NumPy sorts pairs that are packed into one integer far faster than rows.
    width = int(second.max(initial=0)) + 1
    keys, index = renumbered(np.asarray(first, np.int64) * width + second)
    return np.stack(np.divmod(keys, width), axis=1), index


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
    keys = keys[order]
    return order[np.append(True, keys[1:] != keys[:-1])[: len(keys)]]


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
    rows = np.arange(len(group))
    for key in keys:
        values, of = key[rows], group[rows]
        if not len(rows):
            break
        largest = np.full(count, values.min(), values.dtype)
        np.maximum.at(largest, of, values)
        if key.dtype == np.float64:
            largest -= TIE * np.abs(largest)
        rows = rows[values >= largest[of]]
    last = np.full(count, -1, np.int64)
    last[group[rows]] = rows  # NumPy keeps the last of the values written to one place
    return last


def is_last_of_each(group: np.ndarray, *keys: np.ndarray, count: int) -> np.ndarray:
    """Which elements ``last_of_each`` finds, (n,) bool; nothing for a group without elements."""
    last = last_of_each(group, *keys, count=count)
    chosen = np.zeros(len(group), bool)
    chosen[last[last >= 0]] = True
    return chosen
