# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces of meshes that are sculpted with Multires: by BMesh, since nothing else hands on the displacement.

These meshes have few faces of their own, so that the time it takes does not matter.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import bmesh
import bpy
import numpy as np
from bmesh.types import BMesh

from ...core.steps import Steps
from .. import targets
from ..reading import element_layers, mesh_arrays, mesh_groups
from ..reading.matrix_layers import as_bmesh
from . import smooth_faces
from .closing.cut_holes import Holes


def is_sculpted(mesh: bpy.types.Mesh) -> bool:
    """Whether an object shows the mesh with Multires."""
    return any(modifier.type == "MULTIRES" for obj in targets.users(mesh) for modifier in obj.modifiers)


class SculptedMesh:
    """A copy of a mesh, of which pieces are made; ``free`` removes it. As part_meshes.PlainMesh."""

    def __init__(self, mesh: bpy.types.Mesh, planar: bool) -> None:
        self._mesh, self._planar = mesh.copy(), planar
        self.whole = element_layers.read(self._mesh)

    def divide(self, face_numbers: np.ndarray, stretch: np.ndarray, along: np.ndarray) -> Steps[tuple[np.ndarray, int]]:
        """Divide faces where smooth cuts run, see smooth_faces.divide_faces."""
        mesh, number = self._mesh, smooth_faces.NUMBER
        mesh.attributes.new(number, "INT", "FACE").data.foreach_set("value", face_numbers.astype(np.int32))
        cuts = yield from smooth_faces.finding_cuts(self.whole, face_numbers, stretch, along, self._planar)
        while len(cuts.odd):  # with triangles in place of some faces, others may become odd
            _with_bmesh(mesh, partial(smooth_faces.triangulate, faces=cuts.odd))
            whole = element_layers.read(mesh)
            numbers = whole.layers[number].values.astype(np.int64)
            cuts = yield from smooth_faces.finding_cuts(whole, numbers, stretch, along, self._planar)
        yield 0.7
        _with_bmesh(mesh, lambda bm: smooth_faces.divide(bm, cuts))
        face_numbers = mesh_arrays.attribute_values(mesh.attributes[number]).astype(np.int64)
        mesh.attributes.remove(mesh.attributes[number])
        self.whole = element_layers.read(mesh)
        return face_numbers, cuts.kept

    def piece(self, faces: np.ndarray, holes: Holes | None) -> tuple[bpy.types.Mesh, int]:
        """A mesh of some faces, (k,) int64, rising, with its holes filled, and how many edges were not."""
        piece = self._mesh.copy()
        chosen = self.whole.selection(faces)
        gone = np.ones(len(self.whole.count), bool)
        gone[faces] = False
        _with_bmesh(piece, lambda bm: _delete(bm, gone))
        if holes is None:
            return piece, 0
        left = holes.close(piece, chosen.vertices, chosen.edges)
        if self.whole.is_inside_out(mesh_arrays.corner_table(piece), faces):
            piece.flip_normals()
        return piece, left

    def free(self) -> None:
        """Remove the copy."""
        bpy.data.meshes.remove(self._mesh)


def _delete(bm: BMesh, gone: np.ndarray) -> None:
    """Delete faces, (f,) bool, and all edges and vertices of no other face; the rest keep their order."""
    bm.faces.ensure_lookup_table()
    bmesh.ops.delete(bm, geom=[bm.faces[i] for i in np.flatnonzero(gone).tolist()], context="FACES")
    bmesh.ops.delete(bm, geom=[edge for edge in bm.edges if edge.is_wire], context="EDGES")
    bmesh.ops.delete(bm, geom=[vertex for vertex in bm.verts if not vertex.link_faces], context="VERTS")


def _with_bmesh(mesh: bpy.types.Mesh, work: Callable[[BMesh], None]) -> None:
    with as_bmesh(mesh) as bm:
        work(bm)
        mesh_groups.write(bm, mesh)
