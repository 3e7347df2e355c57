# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces across closed curves: where their points lie in a plane, and what they have of the points of the curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...arrays.indexing import sums_by
from ...arrays.int64 import arange, cumsum
from ...arrays.pairs import symmetric_matrix
from ...arrays.vectors import across, cross, lengths, row_products
from ...mesh.triangles import corner_sides

if TYPE_CHECKING:
    from scipy.sparse import csr_array

# Inner points are as far from the curve as such a share of the distance between them.
_AWAY = 0.8
# The smallest distance between inner points, as a share of the size of the curve.
_LEAST = 0.01


def common_order(points: np.ndarray) -> list[int]:
    """The points round a closed curve from the same one in the same direction, from whichever side of a cut they come.

    points : (k, 3) float64. Returns their indices.
    """
    n = len(points)
    first = min(range(n), key=lambda i: tuple(points[i]))
    turn = 1 if tuple(points[first - 1]) < tuple(points[(first + 1) % n]) else -1
    return [(first + turn * i) % n for i in range(n)]


def over_a_plane(curve: np.ndarray, others: np.ndarray | None = None) -> np.ndarray | None:
    """See a closed curve along the normal of the area that it encloses.

    Parameters
    ----------
    curve : (k, 3) float64
    others : (m, 3) float64, optional
        More points to be seen from there.

    Returns
    -------
    flat : (k + m, 2) float64 or None
        In units of the distance of its farthest point from the middle; it goes round to the left. None if it encloses
        nothing.
    """
    middle = curve.mean(axis=0)
    around = curve - middle
    normal = np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0)
    length = np.linalg.norm(normal)
    size = np.linalg.norm(around, axis=1).max()
    if not length > 1e-6 * size**2:
        return None
    normal /= length
    u = across(normal)
    every = around if others is None else np.concatenate([around, others - middle])
    return every @ np.stack([u, np.cross(normal, u)], axis=1) / size


def in_a_circle(curve: np.ndarray) -> np.ndarray | None:
    """Lay a closed curve round a circle, by its length: for curves that meet themselves from wherever they are seen.

    curve : (k, 3) float64. Returns (k, 2) float64 of radius 1, or None if the curve has no length.
    """
    length = np.linalg.norm(np.roll(curve, -1, axis=0) - curve, axis=1)
    if not length.min() > 0:
        return None
    angle = 2 * np.pi * (np.cumsum(length) - length) / length.sum()
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def away_from_curve(flat: np.ndarray, before: np.ndarray | None = None, density: float = 1.0) -> np.ndarray:
    """Choose points around a closed curve: near it as dense as its own, half as dense with each doubling of distance.

    Parameters
    ----------
    flat : (k, 2) float64
        In units of its size.
    before : (k, 2) float64, optional
        The point of the curve before each; without it the one in the row before.
    density : float
        So many points, for one of the curve, next to it.

    Returns
    -------
    inner : (m, 2) float64
        Some of them outside of the curve.
    """
    from scipy.spatial import cKDTree  # imported here, as below, for the reason that arrays.components gives

    before = np.roll(flat, 1, axis=0) if before is None else before
    step = max(float(np.median(np.linalg.norm(flat - before, axis=1))), _LEAST) / density
    tree = cKDTree(np.concatenate([flat, (flat + before) / 2]))
    low, high = flat.min(axis=0), flat.max(axis=0)
    levels = [np.empty((0, 2))]
    while step < 2.0:
        x, y = (np.arange(a, b + step, step * share, np.float64)
                for a, b, share in zip(low, high, (1.0, np.sqrt(0.75)), strict=True))
        grid = np.stack(np.meshgrid(x, y), axis=-1)
        grid[1::2, :, 0] += step / 2
        grid = grid.reshape(-1, 2)
        away = tree.query(grid, distance_upper_bound=2.001 * _AWAY * step)[0]
        levels.append(grid[(away > _AWAY * step) & (away <= 2 * _AWAY * step)])
        step *= 2
    return np.concatenate(levels)


def harmonic_weights(points: np.ndarray, triangles: np.ndarray) -> csr_array:
    """How much each point of a mesh counts for its neighbors: cotangents of the angles between [Pinkall1993].

    points : (n, 2) or (n, 3) float64. triangles : (t, 3) int64. Returns a symmetric (n, n) matrix.
    """
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    ends, u, v = corner_sides(points, triangles)
    least = 1e-12 * lengths(u) * lengths(v)
    cotangent = row_products(u, v) / np.maximum(lengths(cross(u, v)), np.maximum(least, 1e-300))
    return symmetric_matrix(ends, cotangent, len(points))


def spread(weights: csr_array, values: np.ndarray, fixed: np.ndarray | None = None) -> np.ndarray:
    """Give the points of a mesh values between those of some of them: as smooth as can be, never beyond them.

    Linear functions of the place of the points are kept.

    Parameters
    ----------
    weights : (n, n) csr_array
        See ``harmonic_weights``.
    values : (k, c) float64
        Of the points that have values.
    fixed : (n,) bool, optional
        Which these are; the first k without it.

    Returns
    -------
    found : (n, c) float64
        Of all points; of those without a value only, (n - k, c), if the first have one.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import splu

    n = weights.shape[0]
    known = arange(n) < len(values) if fixed is None else fixed
    free = np.flatnonzero(~known)
    every = np.empty((n, values.shape[1]))
    every[known] = values
    if len(free) and values.shape[1]:
        # By arrays: to take rows and columns out of a small sparse matrix takes several times as long as to solve it.
        m, place = len(free), cumsum(~known) - 1
        row, column = np.repeat(arange(n), np.diff(weights.indptr)), weights.indices
        here = ~known[row]
        row, column, weight = place[row[here]], column[here], weights.data[here]
        inner, own = ~known[column], arange(m)
        entries = np.concatenate([np.bincount(row, weight, m), -weight[inner]])
        ends = np.concatenate([own, row[inner]]), np.concatenate([own, place[column[inner]]])
        from_known = sums_by(row[~inner], weight[~inner, None] * every[column[~inner]], m)
        every[free] = splu(coo_array((entries, ends), shape=(m, m)).tocsc()).solve(from_known)
    return every[free] if fixed is None else every
