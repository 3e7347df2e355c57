# SPDX-License-Identifier: GPL-3.0-or-later
"""Where groups of parts that no cuts connect, such as the loose pieces of a model, touch each other."""

from __future__ import annotations

import numpy as np
from scipy.cluster.hierarchy import DisjointSet
from scipy.spatial import cKDTree

from ...arrays.int64 import arange
from ...mesh.corners import CornerTable

# Parts that no cuts connect touch if they come nearer than this share of the diagonal; they hold together where they
# are at most this much farther from each other.
_NEAR, _SLACK = 0.03, 0.01
# Of a part with more corners so many are looked at.
_MOST = 2_000


def off_ground(table: CornerTable, labels: np.ndarray, ground: np.ndarray) -> CornerTable:
    """The table of all that is no ground, which holds nothing, also as one surface with what stands there.

    table, labels, ground : as of ``touching_groups``.
    """
    return table.within(~ground[labels]) if ground.any() else table


def touching_groups(table: CornerTable, labels: np.ndarray, pairs: np.ndarray,
                    ground: np.ndarray) -> list[tuple[tuple[int, int], np.ndarray]]:
    """Connect groups of parts at the places where they touch, the nearest ones first, until none touch.

    What stands on a ground does not hold together with it, nor by way of it.

    Parameters
    ----------
    table : CornerTable
        p faces.
    labels : (p,) int64
        Part of each face, 0..count-1.
    pairs : (k, 2) int64
        Parts that cuts connect.
    ground : (count,) bool
        The parts that are grounds, not all of them.

    Returns
    -------
    contacts : list of ((int, int), (r, 3) float64)
        Two parts, the lower one first, and the places where they touch, in units of the vertices: as many as make one
        group of all that touch.
    """
    count = int(labels.max()) + 1
    group = DisjointSet(range(count))
    for a, b in pairs.tolist():
        group.merge(a, b)
    if group.n_subsets == 1:
        return []
    size, part = off_ground(table, labels, ground).diagonal, np.flatnonzero(~ground).tolist()
    near, slack = _NEAR * size, _SLACK * size
    points = [_points(table, labels == one, near) for one in part]
    trees = [cKDTree(some) for some in points]
    found = []
    for a, b in beside(points, near).tolist():
        if group.connected(part[a], part[b]):
            continue
        distance, place = trees[b].query(points[a], distance_upper_bound=near + slack)
        if distance.min() <= near:
            close = distance <= distance.min() + slack
            places = 0.5 * (points[a][close] + points[b][place[close]])
            found.append((distance.min(), (part[a], part[b]), places))
    return [(pair, places) for _, pair, places in sorted(found, key=lambda contact: contact[:2]) if group.merge(*pair)]


def beside(points: list[np.ndarray], near: float) -> np.ndarray:
    """Find what may touch: pairs of sets of points whose bounding boxes come near to each other.

    points : list of (r, 3) float64, at least one each. near : float, in their unit; 0 for boxes that touch or overlap.
    Returns (k, 2) int64, the lower number first, rising.
    """
    low, high = (np.array([bound(some, axis=0) for some in points]) for bound in (np.min, np.max))
    gap = np.maximum(low[:, None] - high[None], low[None] - high[:, None]).max(axis=2)
    return np.argwhere(np.triu(gap <= near, 1))


def _points(table: CornerTable, faces: np.ndarray, spacing: float) -> np.ndarray:
    """Corners of some faces, the middles of their edges, and points between so near to each other; not too many."""
    some = table.within(faces)
    corners = table.vertices[some.fans()[0]]
    points = np.concatenate([table.vertices[np.unique(some.corner_vertex)], table.vertices[some.edges].mean(axis=1),
                             _lattice(corners, spacing)])
    return points[:: -(-len(points) // _MOST)]


def _lattice(corners: np.ndarray, spacing: float) -> np.ndarray:
    """Points of triangles whose sides are longer than the spacing, (t, 3, 3), in rows along the sides, (k, 3)."""
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    steps = np.ceil(longest / spacing).astype(np.int64)  # at most 1 / _NEAR: nothing is longer than the diagonal
    found = [np.empty((0, 3))]
    for n in np.unique(steps[steps > 1]).tolist():
        i, j = np.divmod(arange((n + 1) ** 2), n + 1)
        weight = np.stack([i, j, n - i - j], axis=1)[i + j <= n] / n
        found.append((weight @ corners[steps == n]).reshape(-1, 3))
    return np.concatenate(found)
