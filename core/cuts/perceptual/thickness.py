# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness of the solid under each face, and clearance of the space above it.

Each is the radius of the medial ball, which touches the surface at the face from one side: a large ball shrinks until
no other point of the surface lies in it [Ma2012].
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...surface.mesh import TriMesh

LARGEST = 0.2  # radius at which balls begin to shrink, in units of the square root of the area
N_SURFACE = 12_000  # upper bound of the number of points that represent the surface
N_PROBES = 2_500  # upper bound of the number of faces measured; a face gets the mean of the three nearest of them
STEPS = 12  # upper bound of the number of times that a ball shrinks
# Cosine of the smallest angle between the two points that a ball touches, seen from its center. A ball stops shrinking
# before the angle falls below this one: it would only fit into the roughness of the surface.
SEPARATION = np.cos(np.deg2rad(50.0))


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
        In units of the square root of the area, above 0 and at most LARGEST.
    """
    unit = np.sqrt(mesh.area)
    center, normal = mesh.face_centroids / unit, mesh.face_normals
    surface = center[_spread(mesh.face_area, order, N_SURFACE)]
    probe = _spread(mesh.face_area, order, N_PROBES)
    tree = cKDTree(surface)
    # The nearest probe is searched by position and normal, so that it is on the same side of a thin wall.
    place = np.hstack([center, 0.05 * normal])
    _, near = cKDTree(place[probe]).query(place, k=min(3, len(probe)))
    near = near.reshape(len(place), -1)
    return tuple(
        np.exp(np.log(_ball_radius(tree, center[probe], side * normal[probe]))[near].mean(axis=1))
        for side in (-1.0, 1.0))


def _spread(area: np.ndarray, order: np.ndarray, count: int) -> np.ndarray:
    """Faces at equal steps of area when sorted by ``order``, (count,) int64 or fewer."""
    along = np.argsort(order, kind="stable")
    total = np.cumsum(area[along])
    steps = (np.arange(count) + 0.5) / count * total[-1]
    return along[np.unique(np.searchsorted(total, steps).clip(max=len(area) - 1))]


def _ball_radius(tree: cKDTree, point: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Radius of the ball, (k,), that touches each point, with its center in the given direction and no point within."""
    radius = np.full(len(point), LARGEST)
    active = np.arange(len(point))
    for _ in range(STEPS):
        p, d = point[active], direction[active]
        center = p + radius[active, None] * d
        distance, nearest = tree.query(center)
        offset = tree.data[nearest] - p
        height = (offset * d).sum(axis=1)
        smaller = (offset**2).sum(axis=1) / np.maximum(2 * height, 1e-12)
        shrinks = (distance < radius[active] * (1 - 1e-3)) & (height > 1e-9)
        shrinks &= (smaller < radius[active]) & (_cosine(p, offset, smaller[:, None] * d) < SEPARATION)
        active = active[shrinks]
        if not len(active):
            break
        radius[active] = smaller[shrinks]
    return np.maximum(radius, 1e-3 * LARGEST)


def _cosine(point: np.ndarray, offset: np.ndarray, to_center: np.ndarray) -> np.ndarray:
    """Cosine of the angle, (k,), between two points that a ball touches, seen from its center.

    offset, to_center : (k, 3), from the first point to the second and to the center.
    """
    a, b = -to_center, offset - to_center
    length = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return (a * b).sum(axis=1) / np.maximum(length, 1e-300)
