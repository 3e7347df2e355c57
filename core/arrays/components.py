# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected components of elements that are joined in pairs."""

from __future__ import annotations

import numpy as np

from .indexing import inverse, place_among
from .int64 import arange

MANY_ELEMENTS = 5_000  # number of elements from which on it is faster to divide the search for components into rounds
FEW_ELEMENTS = 600  # number of elements and pairs up to which a search in Python takes less time than a call of SciPy


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
    goal = arange(n)
    goal[np.maximum(a, b)] = np.minimum(a, b)
    goal = roots(goal)
    lowest = np.flatnonzero(goal == arange(n))
    place = place_among(lowest, n)[goal]
    a, b = place[a], place[b]
    apart = np.flatnonzero(a != b)
    # Of the faces of a mesh, which are sorted by place, one in sixteen is such a lowest one.
    further = components if len(lowest) < n // 2 else _few_components
    count, label = further(len(lowest), a[apart], b[apart])
    return count, label[place]


def roots(parent: np.ndarray) -> np.ndarray:
    """Find where each element ends that goes on to its parent until one is its own.

    parent : (n,) int64, without a circle. Returns (n,) int64, elements that are their own parents.
    """
    while ((further := parent[parent]) != parent).any():
        parent = further
    return parent


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
    first[label[::-1]] = arange(n - 1, -1, -1)  # NumPy keeps the last of the values written to one place
    return count, inverse(np.argsort(first, kind="stable"))[label]
