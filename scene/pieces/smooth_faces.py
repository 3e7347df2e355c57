# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces divided where smooth cuts run, with all that they carry.

Blender's own functions split edges and faces: they interpolate what vertices and corners carry, also shape keys and
weights, and hand on what faces and edges do. Only the faces around the cuts are given to them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np
from bmesh.types import BMesh, BMFace, BMVert

from ...core.arrays.indexing import run_starts
from ...core.arrays.int64 import arange
from ...core.steps import Steps, stretched
from ..reading import element_layers, mesh_groups
from ..reading.elements import FACE, Elements, Layer, Selection
from ..reading.matrix_layers import as_bmesh
from ..temporary import removed

if TYPE_CHECKING:
    from ...core.uses.clean_cuts.method import CleanCuts

#: Face attribute, while faces are divided: number of the part.
NUMBER = "reeb_parts_face_number"


def divide_faces(whole: Elements, like: bpy.types.Mesh, face_numbers: np.ndarray, stretch: np.ndarray,
                 along: np.ndarray, planar: bool) -> Steps[tuple[Elements, np.ndarray, CleanCuts]]:
    """Divide the faces of a mesh where smooth cuts between its parts run, in steps.

    Parameters
    ----------
    whole : Elements
    like : bpy.types.Mesh
        Where they come from.
    face_numbers : (p,) int64
        Number of each face's part.
    stretch : (3, 3) float64
        What the object does to the mesh, see bridge.world_stretch.
    along : (k, 2) int64
        Numbers of parts, the lower first, between which the cut is to run along the edges of faces.
    planar : bool
        Cuts lie in planes wherever they can.

    Returns
    -------
    divided : Elements
        New faces are at the end, as are new edges and vertices.
    face_numbers : (q,) int64
        Number of each face's part, of the faces that there are now.
    cuts : CleanCuts
    """
    cuts = yield from stretched(finding_cuts(whole, face_numbers, stretch, along, planar), 0.0, 0.4)
    while len(cuts.odd):  # with triangles in place of some faces, others may become odd
        whole, face_numbers = _changed(whole, like, face_numbers, cuts.odd,
                                       lambda bm, _, odd: triangulate(bm, odd))
        cuts = yield from stretched(finding_cuts(whole, face_numbers, stretch, along, planar), 0.4, 0.7)
    yield 0.7
    if not len(cuts.face):
        return whole, face_numbers, cuts
    crossed = np.zeros(len(whole.ends), bool)
    crossed[cuts.edge] = True
    faces = np.unique(np.concatenate([cuts.face, whole.corner_face[crossed[whole.corner_edge]]]))
    whole, face_numbers = _changed(whole, like, face_numbers, faces,
                                   lambda bm, here, _: divide(bm, _numbered(cuts, len(whole.points), here)))
    return whole, face_numbers, cuts


def finding_cuts(whole: Elements, face_numbers: np.ndarray, stretch: np.ndarray, along: np.ndarray,
                 planar: bool) -> Steps[CleanCuts]:
    """Find where smooth cuts run, in steps; arguments as of ``divide_faces``."""
    from ...core.uses.clean_cuts import method  # imports SciPy

    table = whole.corner_table()
    table = replace(table, vertices=table.vertices @ stretch.T)
    kept = None
    if len(along):
        sides = np.stack(table.edge_labels(face_numbers), axis=1)
        kept = (sides[:, None] == along[None]).all(axis=2).any(axis=1)
    return (yield from method.finding_cuts(table, face_numbers, kept, planar))


def _changed(whole: Elements, like: bpy.types.Mesh, face_numbers: np.ndarray, faces: np.ndarray,
             work: Callable[[BMesh, Selection, np.ndarray], None]) -> tuple[Elements, np.ndarray]:
    """The elements and the numbers of the faces after some work on some of the faces as a BMesh.

    faces : (k,) int64. work gets the faces around these, what they are of the whole, and the places of the k faces.
    """
    on = np.zeros(len(whole.points), bool)
    on[whole.corner_vertex[whole.selection(faces).corners]] = True
    here = whole.selection(whole.around(on))
    numbers = Layer("INT", FACE, face_numbers[here.faces].astype(np.int32))
    some = element_layers.made(whole.taken(here).with_layer(NUMBER, numbers), like)
    with removed(bpy.data.meshes, some):
        with as_bmesh(some) as bm:
            work(bm, here, np.searchsorted(here.faces, faces))
            _select_made(bm)
            mesh_groups.write(bm, some)
        now = element_layers.read(some)
    numbers = now.layers[NUMBER].values.astype(np.int64)
    n, n_here, n_now = len(whole.count), len(here.faces), len(now.count)
    whole = whole.grafted(now.without_layer(NUMBER), here.vertices, here.edges, 0)
    # The faces that there were keep their places.
    order = arange(n)
    order[here.faces] = n + arange(n_here)
    order = np.concatenate([order[order < n + n_now], arange(n + n_here, n + n_now)])
    return whole.taken(whole.selection(order)), np.concatenate([face_numbers, numbers])[order]


def _numbered(cuts: CleanCuts, n_vertices: int, here: Selection) -> CleanCuts:
    """The cuts in the numbers that vertices, edges and faces have among those that were selected."""
    at_edge = cuts.start >= n_vertices
    start = np.where(at_edge, len(here.vertices) + np.searchsorted(here.edges, cuts.start - n_vertices),
                     np.searchsorted(here.vertices, cuts.start))
    return replace(cuts, edge=np.searchsorted(here.edges, cuts.edge), start=start,
                   face=np.searchsorted(here.faces, cuts.face))


def _select_made(bm: BMesh) -> None:
    """Have what was made of selected faces selected."""
    for face in bm.faces:
        if face.select:
            face.select = True  # selects its vertices and edges, too
    for item in (*bm.edges, *bm.faces):
        if not item.select and all(vertex.select for vertex in item.verts):
            item.select = True


def triangulate(bm: BMesh, faces: np.ndarray) -> None:
    """Divide some faces, (k,) int64, into triangles."""
    bm.faces.ensure_lookup_table()
    bm.normal_update()
    bmesh.ops.triangulate(bm, faces=[bm.faces[i] for i in faces.tolist()])


def divide(bm: BMesh, cuts: CleanCuts) -> None:
    """Split the edges, then the faces; write the number of its part to each face."""
    if not len(cuts.face):
        return
    layer = bm.faces.layers.int[NUMBER]
    for items in (bm.verts, bm.edges, bm.faces):
        items.ensure_lookup_table()
    n = len(bm.verts)
    points = {}
    first = run_starts(cuts.face)
    # All are looked up first: to split edges may change the tables.
    faces = [bm.faces[i] for i in cuts.face[first].tolist()]
    edges = [bm.edges[i] for i in cuts.edge.tolist()]
    verts = bm.verts[:]
    for index, edge, share in zip(cuts.edge.tolist(), edges, cuts.share.tolist(), strict=True):
        points[n + index] = bmesh.utils.edge_split(edge, edge.verts[0], share)[1]
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
