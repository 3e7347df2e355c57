# SPDX-License-Identifier: GPL-3.0-or-later
"""How thick the solid is under each face, and how wide the space is above it.

Both are radii of balls that touch the surface from one side: the medial ball, found by
shrinking a large one until no other point of the surface is left inside [Ma2012].
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...surface.mesh import TriMesh

LARGEST = 0.2  # of the square root of the area: a wider ball tells nothing about a part
N_SURFACE = 12_000  # points that stand for the surface
N_PROBES = 2_500  # faces that are measured; the others take their neighbors' mean
STEPS = 12
# A ball that touches two points closer than this angle, seen from its center, rests on a bump.
SEPARATION = np.cos(np.deg2rad(50.0))


def thickness(mesh: TriMesh, order: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Radius of the largest ball that touches each face from inside and from outside.

    Parameters
    ----------
    mesh : TriMesh
        m faces, normals outwards.
    order : (m,) float64
        A value per face that does not depend on the order of the faces, such as the AGD: probes
        are spread evenly over the area along it.

    Returns
    -------
    inside, outside : (m,) float64
        In units of the square root of the area, at most ``LARGEST``.
    """
    unit = np.sqrt(mesh.area)
    center, normal = mesh.face_centroids / unit, mesh.face_normals
    surface = center[_spread(mesh.face_area, order, N_SURFACE)]
    probe = _spread(mesh.face_area, order, N_PROBES)
    tree = cKDTree(surface)
    # Normals tell the two sides of a thin wall apart.
    place = np.hstack([center, 0.05 * normal])
    _, near = cKDTree(place[probe]).query(place, k=min(3, len(probe)))
    near = near.reshape(len(place), -1)
    return tuple(
        np.exp(np.log(_ball_radius(tree, center[probe], side * normal[probe]))[near].mean(axis=1))
        for side in (-1.0, 1.0))


def _spread(area: np.ndarray, order: np.ndarray, count: int) -> np.ndarray:
    """Faces at equal steps of area along an order."""
    along = np.argsort(order, kind="stable")
    total = np.cumsum(area[along])
    steps = (np.arange(count) + 0.5) / count * total[-1]
    return along[np.unique(np.searchsorted(total, steps).clip(max=len(area) - 1))]


def _ball_radius(tree: cKDTree, point: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Radius of the empty ball that touches each point, its center in the given direction."""
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


def _cosine(point, offset, to_center) -> np.ndarray:
    """Cosine of the angle between a point and another, seen from the center of a ball."""
    a, b = -to_center, offset - to_center
    length = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return (a * b).sum(axis=1) / np.maximum(length, 1e-300)
