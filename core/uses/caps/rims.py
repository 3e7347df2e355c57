# SPDX-License-Identifier: GPL-3.0-or-later
"""Rims that lie within each other, as those of a wall that is cut across: one cap lies between them."""

from __future__ import annotations

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import renumbered
from ...arrays.vectors import box_diagonal, cross_in_plane
from .surfaces import over_a_plane

# A rim within another one may be so far off its plane, or off what is nearest of it where that is bent, too, as a share
# of its size.
_OFF = 0.25


def nested_rims(points: np.ndarray, ends: np.ndarray, pairs: np.ndarray) -> list[list[np.ndarray]]:
    """Find closed rims between the same two parts that lie within each other.

    Parameters
    ----------
    points : (n, 3) float64
    ends : (k, 2) int64
        Edges between two parts, in the direction of the faces of the first.
    pairs : (k, 2) int64
        These parts.

    Returns
    -------
    nested : list of lists of (j,) int64
        Vertices round a rim, then those round each rim within it, which go round the other way when they are seen along
        the normal of the first, and lie near its plane or are bent as it is. Only rims that meet no other.
    """
    used, place = renumbered(ends)
    count, rim = components(len(used), *place.T)
    closed = np.ones(count, bool)
    for column in place.T:
        closed[rim[np.bincount(column, minlength=len(used)) != 1]] = False
    of_edge = rim[place[:, 0]]
    _, first = np.unique(of_edge, return_index=True)
    parts = pairs[first]
    found = []
    for part in np.unique(parts[closed], axis=0):
        own = np.flatnonzero(closed & (parts == part).all(axis=1))
        if len(own) > 1:
            found += _nested(points, [walk_round(*ends[of_edge == one].T) for one in own.tolist()])
    return found


def walk_round(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """List the vertices round a closed curve, from the least one.

    start, end : (k,) int64, the ends of directed edges, one to each vertex and one from it. Returns (j,) int64; of
    several curves only the first, with j less than k.
    """
    order = np.argsort(start)
    start = start[order]
    after = np.searchsorted(start, end[order])
    walk = [0]
    while (step := int(after[walk[-1]])) != 0:
        walk.append(step)
    return start[walk]


def _nested(points: np.ndarray, rims: list[np.ndarray]) -> list[list[np.ndarray]]:
    """Rims with those that lie within them."""
    size = [box_diagonal(points[rim]) for rim in rims]
    within: dict[int, list[int]] = {}
    for inner in range(len(rims)):
        around = [outer for outer in range(len(rims)) if size[outer] > size[inner]
                  and _is_within(points[rims[outer]], points[rims[inner]])]
        if around:
            within.setdefault(min(around, key=lambda outer: size[outer]), []).append(inner)
    inner_ones = {inner for inners in within.values() for inner in inners}
    return [[rims[outer], *(rims[inner] for inner in inners)]
            for outer, inners in within.items() if outer not in inner_ones]


def _is_within(outer: np.ndarray, inner: np.ndarray) -> bool:
    """Whether a closed curve lies within another one, near its plane or bent as it is, and goes round the other way."""
    from scipy.spatial import cKDTree

    flat = over_a_plane(outer, inner)
    if flat is None:
        return False
    around, own = flat[: len(outer)], flat[len(outer) :]
    middle = outer.mean(axis=0)
    normal = np.cross(outer - middle, np.roll(outer, -1, axis=0) - middle).sum(axis=0)
    height = (np.concatenate([outer, inner]) - middle) @ (normal / np.linalg.norm(normal))
    inside = height[len(outer) :]
    apart = inside - height[cKDTree(around).query(own)[1]]
    if min(np.abs(inside).max(), np.abs(apart).max()) > _OFF * np.linalg.norm(outer - middle, axis=1).max():
        return False
    turn = cross_in_plane(own, np.roll(own, -1, axis=0)).sum()
    return bool(turn < 0 and is_inside(own, np.stack([around, np.roll(around, -1, axis=0)], axis=1)).all())


def is_inside(places: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Whether places, (n, 2), lie within closed curves of some edges, (e, 2, 2): a ray meets an odd number; (n,)."""
    (x, y), start, end = places.T[:, :, None], edges[:, 0].T, edges[:, 1].T
    spans = (start[1] > y) != (end[1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = start[0] + (y - start[1]) / (end[1] - start[1]) * (end[0] - start[0])
    return (spans & (at > x)).sum(axis=1) % 2 == 1
