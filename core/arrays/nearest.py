# SPDX-License-Identifier: GPL-3.0-or-later
"""The search of many points for their nearest."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ..processors import n_processors
from .indexing import first_at_place, last_of_each
from .int64 import arange, full
from .ties import TIE, first_least

# Points in a leaf; SciPy takes 16. With 32, and boxes that are not fitted to their points, medial balls take a
# third less time and 36,000 vertices 6 % less in all; 24 to 64 make no difference.
LEAF = 32
# Number of points for which a thread of its own is worth its start, a twentieth of a millisecond.
PER_THREAD = 1_000
FEW = 64  # number of points up to which it is faster to compare each two than to build a tree


def search_tree(point: np.ndarray, balanced: bool = True) -> cKDTree:
    """Build a tree for many searches.

    Parameters
    ----------
    point : (n, d) float64
    balanced : bool
        Whether boxes are cut at the median of their points; it takes longer than in the middle, and pays where points
        are crowded.

    Returns
    -------
    tree : cKDTree
    """
    return cKDTree(point, leafsize=LEAF, compact_nodes=False, balanced_tree=balanced)


def nearest(
    tree: cKDTree, point: np.ndarray, k: int | list[int] = 1, slack: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Find the nearest points of a tree, of many points at once.

    Parameters
    ----------
    tree : cKDTree
        Of n points.
    point : (m, d) float64
    k : int or list of int
        How many, or which: [1, 2] for the nearest and the next.
    slack : float
        Share by which what is found may be farther off than the nearest; where thousands are equally far, it is found
        sooner.

    Returns
    -------
    distance : (m,) or (m, k) float64
        Infinite where the tree has fewer points.
    index : (m,) or (m, k) int64
        Which points; n where the tree has fewer.
    """
    workers = max(1, min(n_processors(), len(point) // PER_THREAD))
    try:
        return tree.query(point, k, slack, workers=workers)
    except RuntimeError:  # no thread is to be had, as while the interpreter ends
        return tree.query(point, k, slack)


def nearest_before(point: np.ndarray) -> np.ndarray:
    """Find for each point the nearest of those before it; of those equally near, but for rounding, the first.

    Parameters
    ----------
    point : (n, 3) float64

    Returns
    -------
    before : (n,) int64
        -1 for the first point.

    Notes
    -----
    O(n log^2 n): the second half is searched in a tree of the first, and so within each half.
    """
    before = first_at_place(point, arange(len(point)))
    # Of many in one place, each would be as near as the others to all that follow.
    own = np.flatnonzero(before == arange(len(point)))
    if len(own):
        place = _nearest_before(point[own])
        before[own[1:]] = own[place[1:]]
        before[own[0]] = -1
    return before


def nearest_larger(size: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Link each point but the largest with the nearest of the larger ones; of equally large ones the first is larger.

    Parameters
    ----------
    size : (n,) float64
    point : (n, 3) float64

    Returns
    -------
    links : (n - 1, 2) int64
        A point and the larger one, from the second largest point on.
    """
    order = np.argsort(-size, kind="stable")
    return np.stack([order, order[nearest_before(point[order])]], axis=1)[1:]


def nearest_to_middle(group: np.ndarray, point: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """Find the point of each group that is nearest to the middle of the group.

    group : (n,) int64, of each point. point : (n, 3) float64. middle : (k, 3) float64, of each of k groups.
    Returns (k,) int64; -1 for a group without points.
    """
    return last_of_each(group, -np.linalg.norm(point - middle[group], axis=1), count=len(middle))


def _nearest_before(point: np.ndarray) -> np.ndarray:
    """What ``nearest_before`` returns, of n points in different places, one or more."""
    before, distance = full(len(point), -1), np.full(len(point), np.inf)

    def keep_(some: slice, found: np.ndarray, far: np.ndarray) -> None:
        """What was found for some points, unless something before that is as near."""
        nearer = far < (1 - TIE) * distance[some]
        before[some][nearer], distance[some][nearer] = found[nearer], far[nearer]

    def search_(start: int, end: int) -> None:
        """Find those that are before each point of a range, and within it."""
        if end - start <= FEW:
            far = cdist(point[start:end], point[start:end])[1:]
            far[np.triu_indices_from(far, 1)] = np.inf
            found = first_least(far)
            keep_(slice(start + 1, end), start + found, far[arange(len(far)), found])
            return
        middle = (start + end) // 2
        search_(start, middle)
        keep_(slice(middle, end), *_first_nearest(point[start:middle], point[middle:end], start))
        search_(middle, end)

    search_(0, len(point))
    return before


def _first_nearest(among: np.ndarray, point: np.ndarray, start: int) -> tuple[np.ndarray, np.ndarray]:
    """The first of those nearest to each of some points, (m,), numbered from ``start``, and how far it is, (m,)."""
    tree = search_tree(among)
    distance, index = nearest(tree, point, [1, 2])
    found, far = index[:, 0], distance[:, 0]
    tied = np.flatnonzero(distance[:, 1] <= (1 + TIE) * far)
    if len(tied):
        found[tied] = [min(near) for near in tree.query_ball_point(point[tied], (1 + TIE) * far[tied])]
    return start + found, far
