# SPDX-License-Identifier: GPL-3.0-or-later
"""What every stage does with whole arrays: components, sums and pairs, numbered the same way everywhere."""

from __future__ import annotations

import numpy as np


def frozen(array, dtype) -> np.ndarray:
    """A read-only copy in C order."""
    copy = np.array(array, dtype=dtype, order="C")
    copy.flags.writeable = False
    return copy


def first_largest(values: np.ndarray) -> int:
    """Index of the largest value; the first of those that differ from it by rounding only.

    On a symmetric shape two sides are equally far from its middle. Their last bit depends on
    the processor and on where the shape stands, the order of the vertices does not.
    """
    return int((values >= (1 - 1e-9) * values.max()).argmax())


def components(n: int, a: np.ndarray, b: np.ndarray) -> tuple[int, np.ndarray]:
    """Connected components of n elements joined by the pairs (a, b).

    Returns
    -------
    count : int
    label : (n,) int64
        0..count-1, numbered by each component's lowest element, so that the numbering does
        not depend on the library.
    """
    # Not above: Blender's panel reads stored parts also where SciPy is missing, to say that it is.
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(a), np.int8), (a, b)), shape=(n, n))
    count, label = connected_components(graph, directed=False)
    first = np.full(count, n, np.int64)
    np.minimum.at(first, label, np.arange(n))
    rank = np.empty(count, np.int64)
    rank[np.argsort(first, kind="stable")] = np.arange(count)
    return count, rank[label]


def sums_by(index: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Sum the rows of an array by group.

    Parameters
    ----------
    index : (n,) int64
        The group of each row, 0..count-1.
    values : (n,) or (n, k) float64
    count : int
        Of groups.

    Returns
    -------
    sums : (count,) or (count, k) float64
    """
    if values.ndim == 1:
        return np.bincount(index, values, count)
    # One column at a time is several times faster than np.add.at, and adds in the order of the rows.
    return np.stack([np.bincount(index, column, count) for column in values.T], axis=1)


def both_ways(pairs: np.ndarray) -> np.ndarray:
    """Each pair, then each pair the other way round: (e, 2) to (2e, 2)."""
    return np.concatenate([pairs, pairs[:, ::-1]])


def symmetric_matrix(pairs: np.ndarray, values: np.ndarray, n: int):
    """Sparse symmetric matrix with a value for each pair, given once.

    Parameters
    ----------
    pairs : (e, 2) int64
    values : (e,) float64
        Those of a pair that is named twice add up.
    n : int

    Returns
    -------
    matrix : (n, n) scipy.sparse.csr_array
    """
    from scipy.sparse import coo_array  # not above, for the reason that ``components`` gives

    a, b = both_ways(pairs).T
    return coo_array((np.concatenate([values, values]), (a, b)), shape=(n, n)).tocsr()


def renumbered(labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number the distinct values of an array from 0.

    Returns
    -------
    names : (c,)
        The distinct values, rising.
    index : shape of ``labels``, int64
        The place of each value in ``names``.
    """
    names, index = np.unique(labels, return_inverse=True)
    return names, index.reshape(np.shape(labels))  # NumPy 2.0 alone returns it in this shape


def distinct_pairs(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number the distinct pairs of two arrays of labels from 0.

    Parameters
    ----------
    first, second : (n,) int64
        0 or more.

    Returns
    -------
    pairs : (c, 2) int64
        In lexicographic order.
    index : (n,) int64
        The place of each pair in ``pairs``.
    """
    # A pair as one integer sorts far faster than as a row.
    width = int(second.max(initial=0)) + 1
    keys, index = renumbered(np.asarray(first, np.int64) * width + second)
    return np.stack(np.divmod(keys, width), axis=1), index


def last_of_each(group: np.ndarray, *keys: np.ndarray, count: int) -> np.ndarray:
    """The element of each group that comes last by some keys, of which the first given counts most.

    Parameters
    ----------
    group : (n,) int64
        0..count-1.
    keys : (n,) arrays
    count : int

    Returns
    -------
    last : (count,) int64
        -1 for a group without elements; of equals the one with the highest index.
    """
    order = np.lexsort((*reversed(keys), group))
    last = np.full(count, -1, np.int64)
    last[group[order]] = order  # NumPy keeps the last of the values written to one place
    return last
