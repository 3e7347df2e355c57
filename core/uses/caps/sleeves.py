# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces beside a closed curve on a surface: what a cap follows where it cannot go straight across."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.indexing import renumbered
from ...arrays.pairs import edge_keys, pair_keys
from ...mesh.triangles import vertex_components
from .rims import walk_round


@dataclass(frozen=True, eq=False)
class Sleeve:
    """Triangles on one side of a closed curve: a ring around it, or all there is on that side.

    Attributes
    ----------
    triangles : (t, 3) int64
        Vertices of the surface; n, n+1, ... are in the middle of edges that join two points of the curve.
    split : (s, 2) int64
        These edges.
    end : (j,) int64
        The closed curve where the ring ends, in the direction of its triangles; empty if there is a disc.
    """

    triangles: np.ndarray
    split: np.ndarray
    end: np.ndarray


def sleeve(n: int, triangles: np.ndarray, labels: np.ndarray, curve: np.ndarray, side: int,
           rings: int) -> Sleeve | None:
    """Find the triangles of one part that are less than so many triangles away from a closed curve.

    Parameters
    ----------
    n : int
        Vertices of the surface.
    triangles : (t, 3) int64
    labels : (t,) int64
        Part of each triangle.
    curve : (k,) int64
        Vertices, each joined with the next one by an edge.
    side : int
        The part.
    rings : int
        How many triangles; all that are reached if they are that few.

    Returns
    -------
    found : Sleeve or None
        None where the triangles are neither a ring, with the curve as one of its two borders, nor a disc.
    """
    own = triangles[labels == side]
    inside = _reached(own, curve, rings)
    chosen = own[inside]
    if not len(chosen):
        return None
    start, stop = chosen.ravel(), np.roll(chosen, -1, axis=1).ravel()
    key, index, count = np.unique(edge_keys(start, stop, count=n), return_index=True, return_counts=True)
    alone = count == 1
    is_rim = np.isin(key, edge_keys(curve, np.roll(curve, -1), count=n))
    if (count > 2).any() or (is_rim & alone).sum() != len(curve):
        return None
    other = index[alone & ~is_rim]
    end = _closed(start[other], stop[other])
    used, place = renumbered(chosen)
    pieces, _ = vertex_components(place, len(used))
    euler = len(used) - len(key) + len(chosen)
    if end is None or pieces > 1 or euler != (0 if len(end) else 1) or np.isin(end, curve).any():
        return None
    inner = key[~is_rim]
    ends = np.stack(np.divmod(inner, n), axis=1)
    split = ends[np.isin(ends, curve).all(axis=1)]
    return Sleeve(_halved(chosen, split, n), split, end)


def _halved(triangles: np.ndarray, edges: np.ndarray, n: int) -> np.ndarray:
    """Triangles divided where some edges, (s, 2), get a point in their middle: n, n+1, ...; (u, 3) int64."""
    key = pair_keys(edges, n)
    left, point = np.sort(key), n + np.argsort(key)
    while len(left):
        start, stop = triangles, np.roll(triangles, -1, axis=1)
        key = edge_keys(start, stop, count=n)
        key = np.where(np.isin(key, left) & (start < n) & (stop < n), key, -1)
        first = np.where(key >= 0, key, np.iinfo(np.int64).max).min(axis=1)
        # An edge is halved if it is the first one of both its triangles.
        place = np.searchsorted(left, key).clip(max=len(left) - 1)
        later = (key >= 0) & (key != first[:, None])
        now = np.setdiff1d(left, key[later])
        at = np.argwhere(np.isin(key, now) & (key >= 0))
        row, corner = at.T
        a, b, c = (triangles[row, (corner + i) % 3] for i in range(3))
        middle = point[place[row, corner]]
        whole = np.ones(len(triangles), bool)
        whole[row] = False
        triangles = np.concatenate([triangles[whole], np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
        stay = ~np.isin(left, now)
        left, point = left[stay], point[stay]
    return triangles


def _reached(triangles: np.ndarray, curve: np.ndarray, rings: int) -> np.ndarray:
    """Triangles less than so many away from a curve, (t,) bool."""
    near = np.zeros(int(triangles.max(initial=0)) + 1, bool)
    near[curve[curve < len(near)]] = True
    inside = np.zeros(len(triangles), bool)
    for _ in range(rings):
        now = near[triangles].any(axis=1)
        if (now == inside).all():
            break
        inside = now
        near[triangles[inside]] = True
    return inside


def _closed(start: np.ndarray, stop: np.ndarray) -> np.ndarray | None:
    """The one closed curve of some directed edges, (j,) int64; None if they are anything else."""
    if not len(start):
        return start
    begins = np.sort(start)
    if (begins[1:] == begins[:-1]).any() or not np.array_equal(begins, np.sort(stop)):
        return None
    walk = walk_round(start, stop)
    return walk if len(walk) == len(start) else None
