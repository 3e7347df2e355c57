# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons cut into triangles: by fans, or ear by ear where they are folded when all cuts begin at the first corner."""

from __future__ import annotations

import numpy as np

from ..arrays.indexing import expanded, sums_by
from ..arrays.int64 import arange, cumsum, full
from ..arrays.ties import TIE, rounded
from ..arrays.vectors import across_each, cross, cross_in_plane, lengths, row_products, unit

#: Share of a polygon's area; what is folded by less is convex but for the rounding of its corners.
FOLD = 1e-6
#: Times the square of a polygon's extent: a corner whose ear has less area is straight.
STRAIGHT = 1e-12
#: Corners of the largest polygon that is cut ear by ear, which takes time as their square: a quarter of a second.
MOST_CORNERS = 1_000


def fans(corner: np.ndarray, sizes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cut polygons into the triangles that the first corner forms with the sides.

    Parameters
    ----------
    corner : (c,) int64
        Vertices of all polygons, one polygon after the other.
    sizes : (p,) int64
        Number of corners of each polygon, 3 or more.

    Returns
    -------
    triangles : (m, 3) int64
    polygon : (m,) int64
        Of each triangle, 0..p-1, rising.
    """
    start = cumsum(sizes) - sizes
    polygon, at = expanded(start, sizes - 2)
    return corner[np.stack([start[polygon], at + 1, at + 2], axis=1)], polygon


def triangulated(
    vertices: np.ndarray, corner: np.ndarray, sizes: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Cut polygons into triangles that do not lie on each other.

    vertices : (n, 3) float64. corner, sizes and what is returned: as of ``fans``.
    """
    triangles, polygon = fans(corner, sizes)
    return without_folds(vertices, triangles, sizes), polygon


def without_folds(vertices: np.ndarray, triangles: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Cut again, along other diagonals, polygons that are folded where they were cut into fans.

    A fan from one corner covers a convex polygon once; of a concave one, triangles of it may lie outside, on top of
    others, with their normals the other way. Such polygons are cut by clipping ears, the one of the shortest diagonal
    first; so are concave ones of five corners and more whose fan is not folded: from the first corner that another file
    has it may be.

    Parameters
    ----------
    vertices : (n, 3) float64
    triangles : (m, 3) int64
        The fans of the polygons, one after the other.
    sizes : (p,) int64
        Number of corners of each polygon, 3 or more.

    Returns
    -------
    triangles : (m, 3) int64
        As many of each polygon, in the same rows. Convex polygons, those that cross themselves so that there is no
        ear, and those of more than MOST_CORNERS keep their fans.
    """
    start = cumsum(sizes - 2) - (sizes - 2)  # first triangle of each polygon
    folded = np.union1d(_folded(vertices, triangles, sizes), _concave(vertices, triangles, sizes, start))
    folded = folded[sizes[folded] <= MOST_CORNERS]
    if not len(folded):
        return triangles
    triangles = triangles.copy()
    for size in np.unique(sizes[folded]).tolist():
        rows, corners = _outlines(triangles, start[folded[sizes[folded] == size]], size)
        # Rounding, too, is to be the same whichever corner a file begins with.
        rank = _ranks(vertices, triangles, corners)
        turn = (rank.argmin(axis=1)[:, None] + arange(size)) % size
        corners, rank = (np.take_along_axis(values, turn, axis=1) for values in (corners, rank))
        place, there = _in_plane(vertices[corners])
        rows, corners = rows[there], corners[there]
        order, whole = _ears(place[there], rank[there])
        triangles[rows[whole]] = corners[arange(len(corners))[:, None, None], order][whole]
    return triangles


def _folded(vertices: np.ndarray, triangles: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """Polygons whose fans have a triangle that looks the other way than the polygon, (k,) int64."""
    several = np.flatnonzero(sizes > 3)
    if not len(several):
        return several
    polygon = np.repeat(arange(len(several)), sizes[several] - 2)
    if len(several) < len(sizes):
        triangles = triangles[np.repeat(sizes > 3, sizes - 2)]
    p, q, r = (vertices[column] for column in triangles.T)
    with np.errstate(invalid="ignore"):  # a polygon with a corner at no finite place stays as it is
        normal = cross(q - p, r - p)
        whole = sums_by(polygon, normal, len(several))  # Newell's normal, as long as twice the area
        against = row_products(normal, whole[polygon]) < -FOLD * row_products(whole, whole)[polygon]
    return several[np.unique(polygon[against])]


def _concave(vertices: np.ndarray, triangles: np.ndarray, sizes: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Polygons of five corners and more that turn both ways, (k,) int64: from another corner they may be folded.

    start : (p,) int64, first triangle of each polygon.
    """
    large, found = np.flatnonzero(sizes > 4), [np.empty(0, np.int64)]
    for size in np.unique(sizes[large]).tolist():
        chosen = large[sizes[large] == size]
        corner = vertices[_outlines(triangles, start[chosen], size)[1]]
        with np.errstate(invalid="ignore", over="ignore"):  # a corner at no finite place
            side = (np.roll(corner, -1, axis=1) - corner).reshape(-1, 3)
            turn = cross(np.roll(side.reshape(corner.shape), 1, axis=1).reshape(-1, 3), side).reshape(corner.shape)
            whole = np.cross(corner[:, 1:-1] - corner[:, :1], corner[:, 2:] - corner[:, :1]).sum(axis=1)
            inwards = (turn * whole[:, None]).sum(axis=2) < -FOLD * (whole * whole).sum(axis=1)[:, None]
        found.append(chosen[inwards.any(axis=1)])
    return np.concatenate(found)


def _outlines(triangles: np.ndarray, start: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the triangles of some fans, (f, size - 2) int64, and the corners of each polygon, (f, size) int64.

    start : (f,) int64, the first row of each. size : how many corners each polygon has.
    """
    rows = start[:, None] + arange(size - 2)
    return rows, np.concatenate([triangles[rows[:, 0], :2], triangles[rows, 2]], axis=1)


def _ranks(vertices: np.ndarray, triangles: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """In which order to clip those corners of each polygon, (f, k), that are equally good: (f, k) int64, from 0.

    The nearest to the middle of all vertices first: how these are numbered decides only where they are symmetric.
    """
    used = np.zeros(len(vertices), bool)
    used[triangles] = True  # a mean over triangles would be another with other first corners
    with np.errstate(invalid="ignore", over="ignore"):  # of other polygons, which may have corners at no finite place
        middle = vertices[used].mean(axis=0)
        distance = rounded(((vertices[corners] - middle) ** 2).sum(axis=2))
    return np.lexsort((corners, distance)).argsort(axis=1)


def _in_plane(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners of polygons in the plane of each, counterclockwise, and whether it has one.

    corners : (f, k, 3) float64. Returns (f, k, 2) float64, in units of the extent of each, and (f,) bool: where as much
    looks one way as the other there is no plane.
    """
    place = corners - corners[:, :1]
    place = place / np.abs(place).max(axis=(1, 2))[:, None, None]
    normal = cross(place[:, 1:-1].reshape(-1, 3), place[:, 2:].reshape(-1, 3)).reshape(len(place), -1, 3).sum(axis=1)
    across = across_each(normal)
    axes = np.stack([across, cross(unit(normal), across)], axis=1)
    return place @ axes.transpose(0, 2, 1), lengths(normal) > STRAIGHT


def _ears(place: np.ndarray, rank: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Clip ears until three corners are left.

    place : (f, k, 2) float64, corners counterclockwise. rank : (f, k) int64; of equally good ears that of the lowest is
    clipped. Returns the corners of all triangles, (f, k - 2, 3) int64, and whether each polygon could be cut so, (f,)
    bool.
    """
    n_faces, size, _ = place.shape
    face = arange(n_faces)
    before, after = (np.tile(np.roll(arange(size), step), (n_faces, 1)) for step in (1, -1))
    left = np.ones((n_faces, size), bool)
    cost = np.stack([_ear_cost(place, left, before[:, k], full(n_faces, k), after[:, k]) for k in range(size)], 1)
    order, whole = np.empty((n_faces, size - 2, 3), np.int64), np.ones(n_faces, bool)
    for step in range(size - 2):
        # The frame in the plane follows the pose: lengths that are equal differ by rounding there.
        ear = np.where(cost <= (1 + TIE) * cost.min(axis=1, keepdims=True), rank, size).argmin(axis=1)
        whole &= np.isfinite(cost[face, ear])
        first, last = before[face, ear], after[face, ear]
        order[:, step] = np.stack([first, ear, last], axis=1)
        left[face, ear], cost[face, ear] = False, np.inf
        after[face, first], before[face, last] = last, first
        for corner in (first, last):  # the others are ears as before
            cost[face, corner] = _ear_cost(place, left, before[face, corner], corner, after[face, corner])
    return order, whole


def _ear_cost(place: np.ndarray, left: np.ndarray, first: np.ndarray, ear: np.ndarray, last: np.ndarray) -> np.ndarray:
    """How late to clip a corner of each polygon, (f,): by the length of the cut; straight ones last; inf for never.

    left : (f, k) bool, corners that are there still. first, ear, last : (f,) int64, the corner between its neighbors.
    """
    a, b, c = (place[arange(len(place)), corner][:, None] for corner in (first, ear, last))
    area = _turn(a, b, c)[:, 0]
    inside = left & np.all([_turn(p, q, place) >= -STRAIGHT for p, q in ((a, b), (b, c), (c, a))], axis=0)
    for end in (a, b, c):  # a corner at the same place, as where a hole is tied to the outside, is none inside
        inside &= (place != end).any(axis=2)
    length = ((c - a)[:, 0] ** 2).sum(axis=1)
    cost = np.where((area > STRAIGHT) & ~inside.any(axis=1), length, np.inf)
    return np.where(np.abs(area) <= STRAIGHT, 100.0 + length, cost)


def _turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Twice the area of triangles in the plane, positive where they are counterclockwise."""
    return cross_in_plane(b - a, c - a)
