# SPDX-License-Identifier: GPL-3.0-or-later
"""Cavities: closed pieces that are inside out and run along another one from within, as in a hollow print.

The inner wall of a hollow body holds the parts of the outer one together. So it is left out before anything is
measured, and has the parts of what it lies below.
"""

from __future__ import annotations

import numpy as np

from ..arrays.int64 import full
from ..arrays.vectors import row_products, unit
from .pieces import Pieces, scattered
from .polygons import PolygonMesh

# Share of the area of the mesh below which a piece is no cavity, unless there is another one in the same piece.
LEAST = 0.01
# Walls are as thick as this, at most, in diameters of the outer piece, for so much of the area of the inner one; there
# the cosine of the angle between the normals of both is below the third. What lies in a thing otherwise, such as a
# battery, has 0.3 of its area near, at most.
FAR, MOST, FACING = 0.05, 0.7, -0.5
POINTS = 1000  # scattered on a piece to measure that
OUTSIDE = 1e-3  # diameters by which the box around a cavity may be beyond that of what it is in


def find_cavities(given: PolygonMesh, pieces: Pieces) -> np.ndarray | None:
    """Find closed pieces that are inside out, and run along another closed piece around them.

    Parameters
    ----------
    given : PolygonMesh
    pieces : Pieces

    Returns
    -------
    base : (count,) int64, or None
        Of each piece that is a cavity, the piece in which it is one; -1 for all others. None if there are no cavities.
    """
    large = pieces.area >= LEAST * pieces.area.sum()
    if not ((large & (pieces.volume < 0)).any() and (large & (pieces.volume > 0)).any()):
        return None
    piece = pieces.of_polygon[given.polygon]
    closed = _are_closed(pieces.place[given.triangles.faces], piece, pieces.count)
    around = _smallest_around(pieces, closed & large & (pieces.volume > 0))
    around[~closed | (pieces.volume >= 0)] = -1
    hollow = [k for k in np.flatnonzero(large & (around >= 0)).tolist()
              if _runs_along(given, piece == k, piece == around[k], pieces.diameter[around[k]])]
    is_cavity = ~large & np.isin(around, around[hollow])
    is_cavity[hollow] = True
    return np.where(is_cavity, around, -1) if hollow else None


def _are_closed(corner: np.ndarray, piece: np.ndarray, count: int) -> np.ndarray:
    """Which pieces have two faces at each edge, (count,) bool; corner : (m, 3) int64, places. piece : (m,) int64.

    Where triangles of a polygon lie in several pieces, they are of one of them, and another may be left without any.
    """
    sides = np.sort(np.stack([corner, np.roll(corner, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    keys = sides[:, 0] * (int(sides.max()) + 1) + sides[:, 1]
    _, first, n_faces = np.unique(keys, return_index=True, return_counts=True)
    n_open = np.bincount(np.repeat(piece, 3)[first], n_faces != 2, count)
    return (n_open == 0) & (np.bincount(piece, minlength=count) > 0)


def _smallest_around(pieces: Pieces, chosen: np.ndarray) -> np.ndarray:
    """For each piece the smallest of the chosen ones, (count,) bool, in whose box it is, be it its own; -1 for none."""
    found = full(pieces.count, -1)
    for k in np.flatnonzero(chosen)[np.argsort(-pieces.diameter[chosen], kind="stable")].tolist():
        slack = OUTSIDE * pieces.diameter[k]
        inside = (pieces.low >= pieces.low[k] - slack).all(axis=1) & (pieces.high <= pieces.high[k] + slack).all(axis=1)
        found[inside] = k
    return found


def _runs_along(given: PolygonMesh, inner: np.ndarray, outer: np.ndarray, diameter: float) -> bool:
    """Whether most of a piece lies near the surface of another one, which there looks the other way.

    inner, outer : (m,) bool. diameter : float, of the outer one.
    """
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    mesh = given.triangles
    faces, points, spacing = [], [], []
    for mine in (inner, outer):
        face, position = scattered(mesh, np.flatnonzero(mine), mesh.face_area[mine], POINTS)
        faces.append(unit(mesh.area_normals[face]))
        points.append(position)
        spacing.append(np.sqrt(mesh.face_area[mine].sum() / POINTS))
    distance, found = nearest(search_tree(points[1]), points[0])
    normal = faces[1][found]
    height = np.abs(row_products(points[0] - points[1][found], normal))
    near = (height <= FAR * diameter) & (distance <= FAR * diameter + 2 * max(spacing))
    return bool((near & (row_products(faces[0], normal) < FACING)).mean() >= MOST)
