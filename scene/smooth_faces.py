# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces divided where smooth cuts run, with all that they carry.

Blender's own functions split edges and faces: they interpolate what vertices and corners carry, also shape keys and
weights, and hand on what faces and edges do.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np
from bmesh.types import BMesh, BMFace, BMVert

from . import mesh_arrays
from .temporary import freed

if TYPE_CHECKING:
    from ..core.uses.clean_cuts.method import CleanCuts

_NUMBER = "reeb_parts_face_number"


def divide_faces(mesh: bpy.types.Mesh, face_numbers: np.ndarray, stretch: np.ndarray,
                 along: np.ndarray) -> tuple[np.ndarray, CleanCuts]:
    """Divide the faces of a mesh where smooth cuts between its parts run; Object Mode.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        Is changed.
    face_numbers : (p,) int64
        Number of each face's part.
    stretch : (3, 3) float64
        What the object does to the mesh, see bridge.world_stretch.
    along : (k, 2) int64
        Numbers of parts, the lower first, between which the cut is to run along the edges of faces.

    Returns
    -------
    face_numbers : (q,) int64
        Number of each face's part, of the faces that there are now.
    cuts : CleanCuts
    """
    cuts = _cuts(mesh, face_numbers, stretch, along)
    if not (len(cuts.face) or len(cuts.odd)):
        return face_numbers, cuts
    mesh.attributes.new(_NUMBER, "INT", "FACE").data.foreach_set("value", face_numbers.astype(np.int32))
    if len(cuts.odd):
        _with_bmesh(mesh, lambda bm: _triangulate(bm, cuts.odd))
        cuts = _cuts(mesh, _numbers(mesh), stretch, along)
        assert not len(cuts.odd)
    _with_bmesh(mesh, lambda bm: _divide(bm, cuts))
    numbers = _numbers(mesh)
    mesh.attributes.remove(mesh.attributes[_NUMBER])
    return numbers, cuts


def _cuts(mesh: bpy.types.Mesh, face_numbers: np.ndarray, stretch: np.ndarray, along: np.ndarray) -> CleanCuts:
    from ..core.uses.clean_cuts.method import clean_cuts  # imports SciPy

    table = mesh_arrays.corner_table(mesh, mesh_arrays.basis_points(mesh).astype(np.float64) @ stretch.T)
    sides = np.stack(table.edge_labels(face_numbers), axis=1)
    whole = (sides[:, None] == along[None]).all(axis=2).any(axis=1) if len(along) else None
    return clean_cuts(table, face_numbers, whole)


def _numbers(mesh: bpy.types.Mesh) -> np.ndarray:
    return mesh_arrays.read(mesh.attributes[_NUMBER].data, "value", np.int32).astype(np.int64)


def _with_bmesh(mesh: bpy.types.Mesh, work: Callable[[BMesh], None]) -> None:
    """Do some work on a mesh as a BMesh."""
    with freed(bmesh.new()) as bm:
        bm.from_mesh(mesh, face_normals=False, vertex_normals=False)
        work(bm)
        bm.to_mesh(mesh)


def _triangulate(bm: BMesh, faces: np.ndarray) -> None:
    bm.faces.ensure_lookup_table()
    bm.normal_update()
    bmesh.ops.triangulate(bm, faces=[bm.faces[i] for i in faces.tolist()])


def _divide(bm: BMesh, cuts: CleanCuts) -> None:
    """Split the edges, then the faces; write the number of its part to each face."""
    layer = bm.faces.layers.int[_NUMBER]
    for items in (bm.verts, bm.edges, bm.faces):
        items.ensure_lookup_table()
    n = len(bm.verts)
    points = {}
    # The edges that are split get new halves at the end of the table, the others keep their places.
    edges = [bm.edges[i] for i in cuts.edge.tolist()]
    for index, edge, share in zip(cuts.edge.tolist(), edges, cuts.share.tolist(), strict=True):
        points[n + index] = bmesh.utils.edge_split(edge, edge.verts[0], share)[1]
    verts = bm.verts[:n]
    first = np.flatnonzero(np.append(True, cuts.face[1:] != cuts.face[:-1])) if len(cuts.face) else np.empty(0, int)
    faces = [bm.faces[i] for i in cuts.face[first].tolist()]
    starts = [verts[i] if i < n else points[i] for i in cuts.start.tolist()]
    labels = cuts.label.tolist()
    for face, begin, end in zip(faces, first.tolist(), [*first[1:].tolist(), len(labels)], strict=True):
        _divide_face(bm, face, starts[begin:end], labels[begin:end], layer)


def _divide_face(bm: BMesh, face: BMFace, marks: list[BMVert], labels: list[int],
                 layer: bmesh.types.BMLayerItem) -> None:
    """Divide a face into the pieces that begin at some points of its outline."""
    if len(marks) == 1:
        face[layer] = labels[0]
        return
    if len(marks) == 2:
        other, _ = bmesh.utils.face_split(face, *marks)
        for piece in (face, other):
            loop = next(loop for loop in piece.loops if loop.vert == marks[0])
            # The piece that begins at the second mark comes from there to the first, and goes back by the chord.
            piece[layer] = labels[loop.link_loop_next.vert == marks[1]]
        return
    middle = _meeting(bm, face, marks)
    for loop in middle.link_loops:
        loop.face[layer] = labels[marks.index(loop.link_loop_next.vert)]


def _meeting(bm: BMesh, face: BMFace, marks: list[BMVert]) -> BMVert:
    """Divide a face in three by a new point inside; the point."""
    a, b, c = marks
    place = (a.co + b.co + c.co) / 3
    other, _ = bmesh.utils.face_split(face, a, b, coords=[place])
    middle = next(v for v in other.verts if v in face.verts and v not in (a, b))
    middle.co = place
    for shape in bm.verts.layers.shape.values():
        middle[shape] = (a[shape] + b[shape] + c[shape]) / 3
    rest = face if c in face.verts else other
    bmesh.utils.face_split(rest, middle, c)
    return middle
