# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls of parts, as games and simulations collide with them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull

from ..surface.arrays import renumbered
from ..surface.corners import CornerTable

#: How many corners a hull has at most; game engines take 255, and are faster with fewer.
MOST = 64
# A part that is flatter than this share of its size gets a hull that is so thick.
_THIN = 0.01


@dataclass(frozen=True, eq=False)
class Hull:
    """A closed convex surface.

    Attributes
    ----------
    vertices : (k, 3) float64
        In units of the mesh.
    triangles : (m, 3) int64
        Counterclockwise seen from outside.
    """

    vertices: np.ndarray
    triangles: np.ndarray


def part_hulls(table: CornerTable, labels: np.ndarray, most: int = MOST) -> list[Hull]:
    """Make the convex hull of each part.

    Parameters
    ----------
    table : CornerTable
        p faces.
    labels : (p,) int64
        Part of each face, 0..count-1, all in use.
    most : int
        A hull with more corners is replaced by that of the corners that lie farthest in so many directions, spread
        evenly; it lies inside.

    Returns
    -------
    hulls : list of Hull
        One for each part. A part that lies in a plane, on a line or in a point has a thin one.
    """
    size = float(np.linalg.norm(np.ptp(table.vertices[table.corner_vertex], axis=0))) or 1.0
    part = labels[table.corner_face]
    order = np.argsort(part, kind="stable")
    pieces = np.split(table.corner_vertex[order], np.flatnonzero(np.diff(part[order])) + 1)
    return [_hull(_solid(table.vertices[np.unique(piece)], _THIN * size), most) for piece in pieces]


def _hull(points: np.ndarray, most: int) -> Hull:
    """The hull of points that do not lie in a plane."""
    middle = points.mean(axis=0)
    scale = np.abs(points - middle).max()
    found = ConvexHull((points - middle) / scale)
    if len(found.vertices) > most:
        corners = points[found.vertices]
        kept = np.unique((_directions(most) @ (corners - middle).T).argmax(axis=1))
        return _hull(corners[kept], most)
    used, triangles = renumbered(found.simplices)
    a, b, c = points[found.simplices].transpose(1, 0, 2)
    inward = (np.cross(b - a, c - a) * found.equations[:, :3]).sum(axis=1) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return Hull(points[used], triangles.astype(np.int64))


def _solid(points: np.ndarray, thickness: float) -> np.ndarray:
    """Points that do not lie in a plane: those given, or moved to both sides where they are thinner than that."""
    middle = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - middle, full_matrices=len(points) < 3)
    for axis in axes:
        if np.ptp((points - middle) @ axis) < thickness:
            points = np.concatenate([points + 0.5 * thickness * axis, points - 0.5 * thickness * axis])
    return points


def _directions(count: int) -> np.ndarray:
    """Directions that are spread evenly over the sphere, (count, 3), on a spiral."""
    place = np.arange(count) + 0.5
    height, angle = 1 - 2 * place / count, np.pi * (1 + np.sqrt(5)) * place
    radius = np.sqrt(1 - height**2)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1)
