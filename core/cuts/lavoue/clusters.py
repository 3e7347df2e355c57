# SPDX-License-Identifier: GPL-3.0-or-later
"""Classes of like curvature: k-means without chance, the number of clusters chosen from the data unless given."""

from __future__ import annotations

import numpy as np

from ...arrays.indexing import renumbered, sums_by
from ...arrays.pairs import distinct_pairs
from ...arrays.ties import first_least, rounded
from ...arrays.vectors import middles_of_each, weighted_sum

MOST_CLUSTERS = 12  # upper bound of the number of clusters that is chosen from the data
EXPLAINED = 0.9  # share of the variance that enough clusters explain
# Variance, in squared units of 1 / square root of the area, below which curvatures differ by error only. A ball has a
# curvature of 3.5.
LEAST_VARIANCE = 0.25
BIN = 0.25  # points this near to each other, in units of 1 / square root of the area, are moved as one
ROUNDS = 50  # upper bound of the number of rounds in which points change cluster


def cluster(points: np.ndarray, weight: np.ndarray, count: int = 0) -> np.ndarray:
    """Sort points of the plane into clusters by k-means.

    Clusters are split one by one, that of the largest sum of squares first, at its mean and across its longest axis;
    after each split Lloyd's rounds move the points. Nothing is left to chance or to the order of the points.

    Parameters
    ----------
    points : (n, 2) float64
        In units of 1 / square root of the area.
    weight : (n,) float64
        Weight of each point, more than 0.
    count : int
        Number of clusters; there are fewer if there are fewer distinct points. 0 takes the fewest that explain
        EXPLAINED of the variance, at most MOST_CLUSTERS, and one if the variance is below LEAST_VARIANCE.

    Returns
    -------
    label : (n,) int64
        Cluster of each point, 0..k-1.

    Notes
    -----
    The rounds run on the means of occupied bins, whose number does not grow with that of the points.
    """
    place = np.rint(points / BIN).astype(np.int64)  # flat regions, of curvature 0 but for rounding, are in one bin
    bins, of_bin = distinct_pairs(*(place - place.min(axis=0)).T)
    total, means = middles_of_each(of_bin, points, weight, len(bins))
    label, variance = _moved(means, total, np.zeros(len(bins), np.int64))
    whole = variance
    while label.max() + 1 < (count or MOST_CLUSTERS):
        if count == 0 and variance <= max((1 - EXPLAINED) * whole, LEAST_VARIANCE if label.max() == 0 else 0.0):
            break
        split = _split(means, total, label)
        if split is None:
            break
        label, variance = _moved(means, total, split)
    return label[of_bin]


def _split(points: np.ndarray, weight: np.ndarray, label: np.ndarray) -> np.ndarray | None:
    """Split the cluster of the largest sum of squares at its mean, across its longest axis.

    Returns the cluster of each point, (n,) int64; None if all points of that cluster lie on one side.
    """
    count = int(label.max()) + 1
    offset = points - _centers(points, weight, label)[label]
    squares = np.bincount(label, weight * (offset**2).sum(axis=1), count)
    inside = label == squares.argmax()
    x, y = offset[inside].T
    xx, xy, yy = (weighted_sum(weight[inside], p) for p in (x * x, x * y, y * y))
    axis = np.linalg.eigh(np.array([[xx, xy], [xy, yy]]))[1][:, -1]
    far = inside & (rounded(offset[:, 0] * axis[0] + offset[:, 1] * axis[1]) > 0)
    return np.where(far, count, label) if far.any() and (inside & ~far).any() else None


def _moved(points: np.ndarray, weight: np.ndarray, label: np.ndarray) -> tuple[np.ndarray, float]:
    """Lloyd's algorithm: centers move to the means of their points, points to the nearest center, until none changes.

    Returns the cluster of each point, (n,) int64, and the weighted mean of the squared distances from the centers.
    """
    for _ in range(ROUNDS):
        square = ((points[:, None] - _centers(points, weight, label)) ** 2).sum(axis=2)
        before, label = label, first_least(square)
        if np.array_equal(before, label):
            break
    label = renumbered(label)[1]
    square = ((points - _centers(points, weight, label)[label]) ** 2).sum(axis=1)
    return label, float(weighted_sum(weight, square) / weight.sum())


def _centers(points: np.ndarray, weight: np.ndarray, label: np.ndarray) -> np.ndarray:
    """Weighted mean of each cluster, (k, 2); infinite for a cluster that has lost its points."""
    count = int(label.max()) + 1
    total = np.bincount(label, weight, count)[:, None]
    sums = sums_by(label, weight[:, None] * points, count)
    return np.divide(sums, total, out=np.full((count, 2), np.inf), where=total > 0)
