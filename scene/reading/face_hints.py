# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints: what an artist has said of the faces of a mesh already, for cuts to follow; see core.cuts.hinted."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np

from ...core.arrays.components import components
from ..outputs import former_slots, seams
from . import mesh_arrays

NONE = "NONE"


def read(mesh: bpy.types.Mesh, kind: str) -> np.ndarray:
    """The hint of each face: its material, or the region between seams or sharp edges that it lies in.

    What Reeb Parts itself has put on the mesh does not count. Not in Edit Mode. kind : of KINDS. Returns (p,) int64,
    (0,) for NONE.
    """
    return KINDS[kind][2](mesh).astype(np.int64)


def _between(mesh: bpy.types.Mesh, marked: np.ndarray) -> np.ndarray:
    """The region between marked edges, (e,) bool, in which each face lies."""
    table = mesh_arrays.corner_table(mesh)
    pairs, edge = table.face_pairs()
    return components(table.n_faces, *pairs[~marked[edge]].T)[1]


#: What can be read, by the identifier of the setting: its label, its tooltip, and what reads it.
KINDS: dict[str, tuple[str, str, Callable[[bpy.types.Mesh], np.ndarray]]] = {
    NONE: ("None", "The shape alone decides", lambda mesh: np.empty(0)),
    "MATERIALS": ("Materials", "Where the material changes", former_slots.of_faces),
    "SEAMS": ("Seams", "Along UV seams", lambda mesh: _between(mesh, seams.own(mesh))),
    "SHARP": ("Sharp Edges", "Along edges that are marked sharp",
              lambda mesh: _between(mesh, mesh_arrays.element_values(mesh, "edges", "use_edge_sharp"))),
}
