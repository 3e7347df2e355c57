# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of whole numbers: both ways, numbered, sought among others, as lists, and as a sparse matrix."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .indexing import renumbered

if TYPE_CHECKING:
    from scipy.sparse import csr_array


def both_ways(pairs: np.ndarray) -> np.ndarray:
    """List each pair, then each pair the other way round.

    pairs : (e, 2) array. Returns (2e, 2), of the dtype given.
    """
    return np.concatenate([pairs, pairs[:, ::-1]])


def partners_of(pairs: np.ndarray, count: int) -> list[list[int]]:
    """With which others each element is paired, in the order of the pairs; pairs : (e, 2) of int, each 0..count-1."""
    partners: list[list[int]] = [[] for _ in range(count)]
    for a, b in pairs.tolist():
        partners[a].append(b)
        partners[b].append(a)
    return partners


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
    from scipy.sparse import coo_array  # imported here for the reason that arrays.components gives

    # SciPy's searches take indices of 32 bits and would convert others each time.
    a, b = both_ways(pairs.astype(np.int32)).T
    return coo_array((np.concatenate([values, values]), (a, b)), shape=(n, n)).tocsr()


def pair_keys(pairs: np.ndarray, count: int) -> np.ndarray:
    """One whole number for each pair, by which pairs are compared and sorted faster than row by row.

    pairs : (n, 2) of int, each 0..count-1. Returns (n,) int64, in the lexicographic order of the pairs.
    """
    return pairs @ np.array([count, 1], np.int64)


def edge_keys(start: np.ndarray, end: np.ndarray, *, count: int) -> np.ndarray:
    """One whole number for each edge, whichever of its ends comes first: what ``pair_keys`` gives with the lower first.

    start, end : of int, of one shape, 0..count-1. Returns int64 of this shape.
    """
    return np.minimum(start, end).astype(np.int64, copy=False) * count + np.maximum(start, end)


def repeated_in(group: np.ndarray, member: np.ndarray, *, count: int) -> np.ndarray:
    """Members that a group has more than once, (r,) int64, one for each time too many.

    group, member : (n,) of int, 0 or more, what belongs to which. count : members are 0..count-1.
    """
    key = np.sort(group.astype(np.int64) * count + member)
    return key[1:][key[1:] == key[:-1]] % count


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
