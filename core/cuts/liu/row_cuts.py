# SPDX-License-Identifier: GPL-3.0-or-later
"""The best cut of a part in two: patches are put in a row from one sample to the other, and the row is cut."""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ...arrays.int64 import arange
from ...arrays.pairs import symmetric_matrix
from .patch_graph import PatchGraph

CREASE_WAY = 0.02  # what a crease of curvature 1 adds to the way across it
# What a border costs to cut is its length times max(exp(-crease / SOFT), CHEAPEST).
SOFT, CHEAPEST = 6.0, 0.05


def distances(graph: PatchGraph, samples: np.ndarray) -> np.ndarray:
    """Measure ways on the surface from some patches, longer across creases.

    graph : PatchGraph, k patches. samples : (s,) int64. Returns (s, k) float64, in the unit of ``graph``.
    """
    way = graph.way + CREASE_WAY * graph.crease
    return dijkstra(symmetric_matrix(graph.pairs, way, len(graph.area)), indices=samples)


def rows(distance: np.ndarray) -> np.ndarray:
    """Order patches from one sample to another by the second eigenvector of their affinities, by Nystroem's method.

    Of two samples alike, the eigenvectors of the affinities exp(-distance) are (1, 1) and (1, -1). Extended to all
    patches and normalized, the second is the hyperbolic tangent of half the difference of the two distances.

    Parameters
    ----------
    distance : (s, k) float64
        Of all patches from each sample.

    Returns
    -------
    rank : (s (s - 1) / 2, k) int64
        Place of each patch in the row of every two samples, the earlier sample first.
    """
    second, first = np.tril_indices(len(distance), -1)
    order = np.lexsort((distance[first], distance[first] - distance[second]), axis=1)
    rank = np.empty_like(order)
    np.put_along_axis(rank, order, arange(order.shape[1])[None], axis=1)
    return rank


def best_cut(graph: PatchGraph, rank: np.ndarray, least_area: float) -> tuple[np.ndarray, float]:
    """Cut one of several rows where the cost over the square root of the smaller area is least.

    Parameters
    ----------
    graph : PatchGraph
        k patches.
    rank : (r, k) int64
        Place of each patch in each row.
    least_area : float
        Area that either side must have.

    Returns
    -------
    side : (k,) bool
        Whether each patch is behind the cut.
    cost : float
        Cost of this cut over the square root of the smaller area, without unit; infinite if both sides cannot be so
        large.
    """
    r, k = rank.shape
    if r == 0:
        return np.zeros(k, bool), np.inf
    low, high = np.sort(rank[:, graph.pairs], axis=2).transpose(2, 0, 1) + k * arange(r)[:, None]
    worth = np.tile(graph.length * np.maximum(np.exp(-graph.crease / SOFT), CHEAPEST), r)
    # A border is cut by the cuts behind the places low, low + 1, ..., high - 1 of the row.
    change = np.bincount(low.ravel(), worth, r * k) - np.bincount(high.ravel(), worth, r * k)
    area = np.empty((r, k))
    np.put_along_axis(area, rank, np.broadcast_to(graph.area, (r, k)), axis=1)
    cost, area = (np.cumsum(x.reshape(r, k), axis=1)[:, :-1] for x in (change, area))
    smaller = np.minimum(area, graph.area.sum() - area)
    ratio = np.where(smaller >= least_area, cost / np.sqrt(np.maximum(smaller, 1e-300)), np.inf)
    best, place = np.unravel_index(ratio.argmin(), ratio.shape)
    return rank[best] > place, float(ratio[best, place])
