# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints: what an artist has said of the faces of a mesh already, for cuts to follow; see core.cuts.hinted."""

from __future__ import annotations

import bpy
import numpy as np

from ..core.surface.components import components
from . import mesh_arrays
from .outputs import materials, seams

NONE, MATERIALS, SEAMS, SHARP = "NONE", "MATERIALS", "SEAMS", "SHARP"
KINDS = (NONE, MATERIALS, SEAMS, SHARP)


def read(mesh: bpy.types.Mesh, kind: str) -> np.ndarray:
    """The hint of each face: its material, or the region between seams or sharp edges that it lies in.

    What Reeb Parts itself has put on the mesh does not count. Not in Edit Mode. Returns (p,) int64, (0,) for NONE.
    """
    if kind == NONE:
        return np.empty(0, np.int64)
    if kind == MATERIALS:
        return materials.own_slots(mesh).astype(np.int64)
    marked = seams.own(mesh) if kind == SEAMS else mesh_arrays.element_values(mesh, "edges", "use_edge_sharp")
    table = mesh_arrays.corner_table(mesh)
    pairs, edge = table.face_pairs()
    return components(table.n_faces, *pairs[~marked[edge]].T)[1].astype(np.int64)
