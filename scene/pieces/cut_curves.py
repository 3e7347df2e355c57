# SPDX-License-Identifier: GPL-3.0-or-later
"""The curves that Separate would cut parts from each other along, to be drawn over the mesh."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import bmesh
import bpy
import numpy as np

from ...core.arrays.indexing import renumbered, run_starts
from ...core.arrays.int64 import arange, cumsum, full
from ...core.arrays.pairs import distinct_pairs
from ...core.mesh.corners import CornerTable
from ...core.steps import Steps, stretched
from .. import bridge
from ..reading import mesh_arrays
from ..temporary import freed
from . import smooth_faces

if TYPE_CHECKING:
    from ...core.uses.clean_cuts.curves import Curves


def read(obj: bpy.types.Object) -> tuple[CornerTable, np.ndarray]:
    """What ``finding_curves`` wants of an object: its faces as Separate sees them, and the points of its mesh."""
    points = mesh_arrays.basis_points(obj.data)
    return mesh_arrays.joined_table(obj.data, points.astype(np.float64) @ bridge.world_stretch(obj).T), points


def finding_curves(table: CornerTable, points: np.ndarray, face_numbers: np.ndarray,
                   planar: bool = False) -> Steps[Curves]:
    """Find the curves between the parts of a mesh, in steps; Blender's data is not touched.

    Parameters
    ----------
    table, points : CornerTable, (n, 3) float32
        As ``read`` gives them.
    face_numbers : (p,) int64
        Number of each face's part.
    planar : bool
        Curves lie in planes wherever they can.

    Returns
    -------
    curves : core.uses.clean_cuts.curves.Curves
        Of the vertices of the mesh. Only to close holes may Separate leave one of them, for the edges of faces, where
        what fills the holes would cross something.
    """
    from ...core.uses.clean_cuts.curves import curves_of  # imports SciPy
    from ...core.uses.clean_cuts.method import finding_cuts

    cuts = yield from stretched(finding_cuts(table, face_numbers, planar=planar), 0.0, 0.5)
    while len(cuts.odd):
        table, face_numbers = _with_triangles(table, points, face_numbers, cuts.odd)
        cuts = yield from stretched(finding_cuts(table, face_numbers, planar=planar), 0.5, 1.0)
    yield 1.0
    return curves_of(table, face_numbers, cuts)


def _with_triangles(table: CornerTable, points: np.ndarray, labels: np.ndarray,
                    faces: np.ndarray) -> tuple[CornerTable, np.ndarray]:
    """The table with some faces, (k,) int64, divided into triangles, as Separate does it, and the labels then.

    points : (n, 3) float32, in the coordinates of the mesh.
    """
    odd = np.zeros(table.n_faces, bool)
    odd[faces] = True
    corner = odd[table.corner_face]
    rings = np.split(table.corner_vertex[corner], run_starts(table.corner_face[corner])[1:])
    triangles, number = _triangles(rings, points, labels[odd])
    # Edges by their ends: those there were, then those that divide faces.
    sides = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    known = np.sort(table.edges[table.corner_edge[corner]], axis=1)
    every, row = distinct_pairs(*np.concatenate([known, sides]).T)
    edge = full(len(every), -1)
    edge[row[: len(known)]] = table.corner_edge[corner]
    new = edge < 0
    edge[new] = len(table.edges) + arange(new.sum())
    kept, face_kept = ~corner, cumsum(~odd) - 1
    divided = replace(
        table, edges=np.concatenate([table.edges, every[new]]),
        corner_vertex=np.concatenate([table.corner_vertex[kept], triangles.ravel()]),
        corner_edge=np.concatenate([table.corner_edge[kept], edge[row[len(known) :]]]),
        corner_face=np.concatenate([face_kept[table.corner_face[kept]],
                                    (~odd).sum() + np.repeat(arange(len(triangles)), 3)]),
        n_faces=int((~odd).sum()) + len(triangles))
    return divided, np.concatenate([labels[~odd], number])


def _triangles(rings: list[np.ndarray], points: np.ndarray, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The triangles of some faces, vertices of each given, and the label of each triangle: (t, 3) and (t,) int64.

    points : (n, 3) float32, of all vertices. labels : (k,) int64, of the faces.
    """
    used, vertex = renumbered(np.concatenate(rings))
    with freed(bmesh.new()) as bm:
        verts = [bm.verts.new(point) for point in points[used].tolist()]
        layer = bm.faces.layers.int.new(smooth_faces.NUMBER)
        first = cumsum([0, *map(len, rings)]).tolist()
        for start, end, label in zip(first, first[1:], labels.tolist(), strict=False):
            bm.faces.new([verts[i] for i in vertex[start:end].tolist()])[layer] = label
        bm.verts.index_update()
        smooth_faces.triangulate(bm, arange(len(rings)))
        triangles = used[[[vert.index for vert in face.verts] for face in bm.faces]]
        return triangles, np.array([face[layer] for face in bm.faces], np.int64)
