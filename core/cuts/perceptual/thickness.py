# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness of the solid under each face, and clearance of the space above it.

Each is the radius of the medial ball, which touches the surface at the face from one side.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...arrays.indexing import spread_evenly
from ...arrays.nearest import nearest, search_tree
from ...arrays.ties import TIE
from ...mesh.triangles import TriMesh
from ...surface.balls import ball_radius

LARGEST_BALL = 0.2  # radius at which balls begin to shrink, in units of the square root of the area
N_SURFACE = 12_000  # upper bound of the number of points that represent the surface
N_PROBES = 2_500  # upper bound of the number of faces measured; a face gets the mean of the three nearest of them
AMONG = 6  # upper bound of their number, as several may be equally near
# How much a turned normal counts where the nearest probe is searched, in units of the square root of the area: the two
# sides of a wall that is thinner than that have probes of their own.
TURNED = 0.05
SMALLEST = 1e-3  # lower bound of a radius, in units of LARGEST_BALL, as its logarithm is taken


def thickness(mesh: TriMesh, order: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Measure the radius of the largest ball that touches each face from inside and from outside.

    Parameters
    ----------
    mesh : TriMesh
        m faces, turned outwards.
    order : (m,) float64
        Value of each face by which the faces are sorted to choose some of them evenly over the area. Values that do not
        depend on the order of the faces, such as the AGD, make the result independent of it.

    Returns
    -------
    inside, outside : (m,) float64
        In units of the square root of the area, above 0 and at most LARGEST_BALL.
    """
    unit = np.sqrt(mesh.area)
    center, normal = mesh.face_centroids / unit, mesh.face_normals
    surface = center[spread_evenly(mesh.face_area, order, N_SURFACE)]
    probe = spread_evenly(mesh.face_area, order, N_PROBES)
    tree = search_tree(surface)
    # The nearest probe is searched by position and normal, so that it is on the same side of a thin wall.
    place = np.hstack([center, TURNED * normal])
    near, counts = _nearest(search_tree(place[probe]), place)
    share = counts / counts.sum(axis=1, keepdims=True)
    return tuple(
        np.exp((share * np.log(_radius(tree, center[probe], side * normal[probe]))[near]).sum(axis=1))
        for side in (-1.0, 1.0))


def _nearest(tree: cKDTree, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nearest points of a tree, (k, AMONG) or fewer, and which of them count, (k, AMONG) bool.

    The first three count, and others as near as the third: on a regular grid, rounding must not choose.
    """
    distance, near = nearest(tree, place, list(range(1, min(AMONG, tree.n) + 1)))
    return near, distance <= (1 + TIE) * distance[:, min(2, tree.n - 1), None] + TIE


def _radius(tree: cKDTree, point: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Radius of the ball, (k,), that touches each point, with its center in the given direction and no point within."""
    return np.maximum(ball_radius(tree, point, direction, LARGEST_BALL), SMALLEST * LARGEST_BALL)
