# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces near the borders between parts, with numbers of their own."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays.indexing import ranges, renumbered
from ...arrays.int64 import cumsum
from ...arrays.vectors import cross
from ...mesh.corners import CornerTable


@dataclass(frozen=True, eq=False)
class Band:
    """The faces near the borders between parts, with numbers of their own.

    Attributes
    ----------
    n_vertices : int
        Of the whole mesh.
    vertices, edges, faces : (v,), (e,), (f,) int64
        Those of the mesh that are in the band.
    table : CornerTable
        Of them, in numbers of their own.
    labels : (f,) int64
        0..n_labels-1.
    names : (n_labels,) int64
        The label in the mesh.
    """

    n_vertices: int
    vertices: np.ndarray
    edges: np.ndarray
    faces: np.ndarray
    table: CornerTable
    labels: np.ndarray
    names: np.ndarray

    @classmethod
    def of(cls, table: CornerTable, labels: np.ndarray, rings: int) -> Band | None:
        """The faces less than so many faces away from a border between parts; None without a border."""
        low, high = table.edge_labels(labels)
        cut = low < high
        if not cut.any():
            return None
        corner = np.flatnonzero(_around(table, table.edges[cut], rings)[table.corner_face])
        vertices, corner_vertex = renumbered(table.corner_vertex[corner])
        edges, corner_edge = renumbered(table.corner_edge[corner])
        faces, corner_face = renumbered(table.corner_face[corner])
        names, own = renumbered(labels[faces])
        ends = np.searchsorted(vertices, table.edges[edges])
        near = CornerTable(table.vertices[vertices], ends, corner_vertex, corner_edge, corner_face, len(faces))
        return cls(len(table.vertices), vertices, edges, faces, near, own, names)

    @cached_property
    def n_corners(self) -> np.ndarray:
        """(f,) int64, of each face."""
        return np.bincount(self.table.corner_face, minlength=len(self.faces))

    @cached_property
    def edge_labels(self) -> tuple[np.ndarray, np.ndarray]:
        """Smallest and largest label at each edge, (e,) int64 each."""
        return self.table.edge_labels(self.labels)

    @cached_property
    def face_vectors(self) -> np.ndarray:
        """(f, 3) float64, vector area of each face, see ``CornerTable.face_vectors``."""
        return self.table.face_vectors()

    @cached_property
    def convex(self) -> np.ndarray:
        """Whether each face has no corner that is turned in, (f,) bool."""
        if (self.n_corners == 3).all():
            return np.ones(len(self.faces), bool)
        following, points = self.table.next_corner, self.table.vertices[self.table.corner_vertex]
        ahead = points[following] - points
        behind = np.empty_like(ahead)
        behind[following] = ahead
        turn = (cross(behind, ahead) * self.face_vectors[self.table.corner_face]).sum(axis=1)
        inward = np.zeros(len(self.faces), bool)
        inward[self.table.corner_face[turn <= 0]] = True
        return ~inward


def _around(table: CornerTable, vertices: np.ndarray, rings: int) -> np.ndarray:
    """The faces less than so many faces away from some vertices, (p,) bool."""
    from scipy.sparse import csr_array  # imported here for the reason that arrays.components gives

    n_corners = len(table.corner_vertex)
    count = np.bincount(table.corner_face, minlength=table.n_faces)
    end = cumsum(count)
    first = end - count
    of_faces = csr_array((np.ones(n_corners, np.int8), table.corner_vertex, np.append(0, end)),
                         shape=(table.n_faces, len(table.vertices)))
    at = of_faces.tocsc()  # the faces at each vertex
    near, inside = np.zeros(len(table.vertices), bool), np.zeros(table.n_faces, bool)
    reached = np.unique(vertices)
    near[reached] = True
    for _ in range(rings):
        faces = np.unique(at.indices[ranges(at.indptr[reached], np.diff(at.indptr)[reached])])
        faces = faces[~inside[faces]]
        inside[faces] = True
        reached = np.unique(table.corner_vertex[ranges(first[faces], count[faces])])
        reached = reached[~near[reached]]
        near[reached] = True
    return inside
