# SPDX-License-Identifier: GPL-3.0-or-later
"""Products and lengths of many vectors, and sums of such products, the same on every machine."""

from __future__ import annotations

import numpy as np

from .indexing import sums_by

BLOCK = 8192  # vectors whose products stay in the processor's cache


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross products of vectors, (n, 3) each: those of ``np.cross``, several times as fast."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)


def cross_in_plane(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross products of vectors of a plane, (..., 2) each: above 0 where b is to the left of a. Returns (...)."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def lengths(vectors: np.ndarray) -> np.ndarray:
    """Lengths of vectors, (n, 2 or 3): those of ``np.linalg.norm``, several times as fast. Returns (n,) float64."""
    return np.sqrt(row_products(vectors, vectors))


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors, (n, 3), divided by their lengths: (n, 3) float64 of length 1, or of 0 where the length is 0."""
    return vectors / np.maximum(lengths(vectors), 1e-300)[:, None]


def box_diagonal(points: np.ndarray) -> float:
    """Diagonal of the box around points, (n, 2 or 3), at least one of them: their size, in their unit."""
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def across(direction: np.ndarray) -> np.ndarray:
    """A unit vector, (3,) float64, at a right angle to a direction, (3,) float64, which is not 0."""
    found = np.cross(direction, np.eye(3)[np.abs(direction).argmin()])
    return found / np.linalg.norm(found)


def across_each(directions: np.ndarray) -> np.ndarray:
    """A unit vector at a right angle to each direction, (n, 3) float64; 0 for a direction of 0.

    It is across the axis along which the direction reaches least, too. directions : (n, 3) float64.
    """
    return unit(cross(directions, np.eye(3)[np.abs(directions).argmin(axis=1)]))


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
    total = np.empty(len(a))
    for start in range(0, len(a), BLOCK):
        some = slice(start, start + BLOCK)
        first, *others = (a[some] * b[some]).T
        total[some] = sum(others, first)
    return total


def distances_between(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distance between the points of each pair, (k,) float64; points : (n, 2 or 3). a, b : (k,) int64."""
    distance = np.empty(len(a))
    for start in range(0, len(a), BLOCK):
        some = slice(start, start + BLOCK)
        distance[some] = lengths(points.take(a[some], axis=0) - points.take(b[some], axis=0))
    return distance


def second_moments(points: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Sum of the outer product of each point, (n, 3), with itself, times its weight, (n,): (3, 3) float64."""
    x, y, z = points.T
    xx, yy, zz, yz, zx, xy = (weighted_sum(weights, p) for p in (x * x, y * y, z * z, y * z, z * x, x * y))
    return np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])


def middles_of_each(
    index: np.ndarray, points: np.ndarray, weights: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Sum the weights, (n,), of points, (n, k), by ``index``, (n,), and take the weighted mean of the points.

    Returns (count,) and (count, k) float64; the mean of no weight is 0.
    """
    total = np.bincount(index, weights, count)
    return total, sums_by(index, weights[:, None] * points, count) / np.where(total > 0, total, 1.0)[:, None]


def second_moments_of_each(index: np.ndarray, points: np.ndarray, weights: np.ndarray, count: int) -> np.ndarray:
    """Sum the weighted products of the coordinates of points, (n, 3), by ``index``, (n,): (count, 3, 3) float64."""
    products = weights[:, None] * (points[:, :, None] * points[:, None, :]).reshape(-1, 9)
    return sums_by(index, products, count).reshape(-1, 3, 3)
