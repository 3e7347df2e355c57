# SPDX-License-Identifier: GPL-3.0-or-later
"""Where parts are: the middle of each, and the box around it, in the coordinates of the mesh."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays.vectors import middles_of_each
from ...core.result.numbering import NumberedParts
from ..reading import mesh_arrays, placing, seen_points

_middles: list[tuple[tuple, np.ndarray]] = []  # the last ones, with what they are of


def forget() -> None:
    """Free what is kept in memory."""
    _middles.clear()


def middles(mesh: bpy.types.Mesh, numbered: NumberedParts) -> np.ndarray:
    """The middle of the surface of each part, (count, 3) float64; Object Mode."""
    candidate, part = _candidate_middles(mesh, numbered.candidates), numbered.parts.candidate_part
    weight = numbered.parts.decomposition.candidate_area + 1e-300
    return middles_of_each(part, candidate, weight, numbered.parts.count)[1]


def _candidate_middles(mesh: bpy.types.Mesh, candidates: np.ndarray) -> np.ndarray:
    """The middle of the surface of each candidate, (c, 3) float64; kept for the next step of a drag."""
    key = mesh.session_uid, mesh.reeb_parts.fingerprint, id(candidates)
    if not _middles or _middles[0][0] != key:
        center, area = mesh_arrays.face_middles(mesh)
        _, found = middles_of_each(candidates, center, area + 1e-300, int(candidates.max()) + 1)
        _middles[:] = [(key, found)]
    return _middles[0][1]


def box(obj: bpy.types.Object, mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The corners, least and largest, of the box around some faces of an object as it is seen, in the world.

    mask : (p,) bool, at least one.
    """
    points = seen_points.corners(bpy.context, obj)[mask[mesh_arrays.face_corners(obj.data)[1]]]
    points = placing.transformed(points, placing.world_matrix(obj))
    return points.min(axis=0), points.max(axis=0)
