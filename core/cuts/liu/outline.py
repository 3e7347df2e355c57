# SPDX-License-Identifier: GPL-3.0-or-later
"""What the outline of a planar embedding says: whether the shape has parts, and points in different parts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_dilation, binary_fill_holes
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import ConvexHull, QhullError

from ...arrays.pairs import symmetric_matrix
from ...arrays.ties import first_largest
from ...arrays.vectors import distances_between

LANDMARKS = 10  # number of patches from which inner distances run; more than the tips that a shape has
PIXELS = 48  # number of pixels along the longer side of the outline


@dataclass(frozen=True, eq=False)
class Outline:
    """The outline of an embedding, straightened.

    Attributes
    ----------
    segmentability : float
        1 minus the smaller of two convexities of the outline, 0..1: 0 of a disc.
    landmarks : (l,) int64
        Patches far from each other along the shape, tips first.
    """

    segmentability: float
    landmarks: np.ndarray

    @classmethod
    def of(cls, position: np.ndarray, pairs: np.ndarray) -> Outline:
        """Analyze the outline of an embedded graph.

        Parameters
        ----------
        position : (k, 2) float64
            Place of each patch in the plane.
        pairs : (b, 2) int64
            Patches that touch; the graph is connected.

        Returns
        -------
        outline : Outline
        """
        landmarks, inner = inner_distances(position, pairs)
        straight = straightened(landmarks, inner)
        return cls(1.0 - convexity(straight, pairs), landmarks)


def inner_distances(position: np.ndarray, pairs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Choose landmarks, each as far as possible from the others, and measure ways within the embedded shape.

    position : (k, 2) float64. pairs : (b, 2) int64. Returns (l,) int64 and (l, k) float64, the distances from each.
    """
    way = distances_between(position, *pairs.T)
    way = np.maximum(way, 1e-9 * max(way.max(initial=0.0), 1e-12))
    ways = symmetric_matrix(pairs, way, len(position))
    landmarks = [first_largest((position**2).sum(axis=1))]
    distances = [dijkstra(ways, indices=landmarks[0])]
    nearest = distances[0]
    while len(landmarks) < min(LANDMARKS, len(position)):
        landmarks.append(first_largest(nearest))
        distances.append(dijkstra(ways, indices=landmarks[-1]))
        nearest = np.minimum(nearest, distances[-1])
    return np.array(landmarks), np.array(distances)


def straightened(landmarks: np.ndarray, inner: np.ndarray) -> np.ndarray:
    """Lay a shape into the plane anew, so that straight distances come near to the inner ones: bent limbs unbend.

    Multidimensional scaling of the landmarks, to which all others are added [deSilva2004].
    landmarks : (l,) int64. inner : (l, k) float64, distance of all patches from each. Returns (k, 2) float64.
    """
    square = inner**2
    among = square[:, landmarks]
    mean = among.mean(axis=0)
    values, vectors = np.linalg.eigh(-0.5 * (among - mean - mean[:, None] + among.mean()))
    # What has hardly a width would get one from the errors of the distances.
    values, vectors = np.maximum(values[-2:], max(1e-3 * values[-1], np.finfo(float).tiny)), vectors[:, -2:]
    return -0.5 * ((square - mean[:, None]).T @ vectors) / np.sqrt(values)


def convexity(position: np.ndarray, pairs: np.ndarray) -> float:
    """Measure how convex the outline of an embedded graph is: by area and by perimeter, the smaller of the two.

    position : (k, 2) float64. pairs : (b, 2) int64. Returns 0..1; 1 where the shape and its convex hull are one.
    """
    low, high = position.min(axis=0), position.max(axis=0)
    scale = (PIXELS - 1) / max(float((high - low).max()), 1e-12)
    points = (position - low) * scale + 2.0
    try:
        hull = ConvexHull(points)
    except QhullError:
        return 1.0  # on one line
    steps = np.linspace(0.0, 1.0, 2 * PIXELS)[:, None]
    drawn = points[pairs[:, 0], None] * (1 - steps) + points[pairs[:, 1], None] * steps
    shape = np.zeros((PIXELS + 4, PIXELS + 4), bool)
    shape[tuple(np.rint(drawn).astype(np.int64).reshape(-1, 2).T)] = True
    shape = binary_fill_holes(binary_dilation(shape))
    grid = np.indices(shape.shape, np.int64).reshape(2, -1).T
    # The hull is drawn as the shape was: wider by the half of a pixel and by the one of the dilation.
    inside = (grid @ hull.equations[:, :2].T + hull.equations[:, 2] <= 1.0).all(axis=1).reshape(shape.shape)
    whole = inside | shape
    return float(min(shape.sum() / whole.sum(), _perimeter(inside) / _perimeter(shape), 1.0))


def _perimeter(mask: np.ndarray) -> float:
    """Perimeter of a figure in pixels by Cauchy's and Crofton's formula over four directions."""
    mask = np.pad(mask, 1)
    straight = (mask[1:] != mask[:-1]).sum() + (mask[:, 1:] != mask[:, :-1]).sum()
    oblique = (mask[1:, 1:] != mask[:-1, :-1]).sum() + (mask[1:, :-1] != mask[:-1, 1:]).sum()
    return float(np.pi / 8 * (straight + oblique / np.sqrt(2)))
