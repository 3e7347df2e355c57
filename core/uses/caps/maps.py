# SPDX-License-Identifier: GPL-3.0-or-later
"""Caps in a UV map: flat, as large in the map as the faces around them, beside each other."""

from __future__ import annotations

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import bounds_of_each, renumbered, run_starts, stable_order, sums_by
from ...arrays.pairs import edge_keys
from ...arrays.vectors import cross, middles_of_each, second_moments_of_each, unit
from ...mesh.corners import next_of_owner

# Faces of a cap that turn by more than this lie apart in the map, as where three parts meet.
_TURN = np.radians(60)
# The gap between caps, as a share of the width of a row.
_GAP = 0.01


def cap_map(points: np.ndarray, corner_vertex: np.ndarray, corner_face: np.ndarray, density: float) -> np.ndarray:
    """Lay caps into a plane, each seen along the normal of its area, in rows of width 1 or of the widest of them.

    Parameters
    ----------
    points : (n, 3) float64
    corner_vertex, corner_face : (c,) int64
        Corners of the faces of caps, face by face.
    density : float
        Length in the map for a length of 1.

    Returns
    -------
    flat : (c, 2) float64
        For each corner, 0 or more; the same shapes and sizes for any pose.
    """
    if not len(corner_face):
        return np.empty((0, 2))
    faces, face = renumbered(corner_face)
    ahead = next_of_owner(face)
    here, there = points[corner_vertex], points[corner_vertex[ahead]]
    first = run_starts(face)
    origin = here[first][face]
    area = sums_by(face, 0.5 * cross(here - origin, there - origin), len(faces))
    island = _islands(corner_vertex, corner_vertex[ahead], face, area)[face]
    count = int(island.max(initial=-1)) + 1
    normal = unit(sums_by(island[first], area, count))
    every = np.ones(len(here))
    _, center = middles_of_each(island, here, every, count)
    offset = here - center[island]
    # The longer side of each along the rows.
    across = offset - (offset * normal[island]).sum(axis=1)[:, None] * normal[island]
    u = np.linalg.eigh(second_moments_of_each(island, across, every, count))[1][:, :, 2]
    u = unit(u - (u * normal).sum(axis=1)[:, None] * normal)
    v = cross(normal, u)
    flat = density * np.stack([(offset * axis[island]).sum(axis=1) for axis in (u, v)], axis=1)
    low, high = bounds_of_each(island, flat, count)
    return flat - low[island] + _in_rows(high - low)[island]


def _islands(start: np.ndarray, stop: np.ndarray, face: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Faces that are joined by edges where they turn little: number of each, (f,) int64."""
    n = int(max(start.max(initial=0), stop.max(initial=0))) + 1
    key = edge_keys(start, stop, count=n)
    order = stable_order(key)
    same = key[order[1:]] == key[order[:-1]]
    a, b = face[order[1:]][same], face[order[:-1]][same]
    normal = unit(area)
    smooth = (normal[a] * normal[b]).sum(axis=1) > np.cos(_TURN)
    return components(len(area), a[smooth], b[smooth])[1]


def _in_rows(size: np.ndarray) -> np.ndarray:
    """Where rectangles, (k, 2), begin if they lie in rows, the highest ones first; (k, 2) float64."""
    width = max(1.0, float(size[:, 0].max(initial=0.0)))
    place, x, y, row = np.zeros_like(size), 0.0, 0.0, 0.0
    for index in np.lexsort((-size[:, 0], -size[:, 1])).tolist():
        if x and x + size[index, 0] > width:
            x, y, row = 0.0, y + row + _GAP * width, 0.0
        place[index] = x, y
        x += size[index, 0] + _GAP * width
        row = max(row, size[index, 1])
    return place
