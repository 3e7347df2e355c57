# SPDX-License-Identifier: GPL-3.0-or-later
"""The caller's polygons, corner by corner, for work after a decomposition that needs no triangles."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays.indexing import begins_run, ends_run, renumbered, stable_order, sums_by
from ..arrays.int64 import arange, cumsum
from ..arrays.pairs import distinct_pairs
from ..arrays.vectors import box_diagonal, cross, lengths
from .borders import joined_borders


@dataclass(frozen=True, eq=False)
class CornerTable:
    """A polygon mesh as the list of its corners: the vertices of the first face in order, then of the second ...

    With n vertices, e edges, p faces and c corners:

    Attributes
    ----------
    vertices : (n, 3) float64
        Positions.
    edges : (e, 2) int64
        The two vertices of each edge.
    corner_vertex : (c,) int64
        Vertex at each corner.
    corner_edge : (c,) int64
        Edge from each corner to the next corner of its face.
    corner_face : (c,) int64
        Face of each corner, rising.
    n_faces : int
        p.
    """

    vertices: np.ndarray
    edges: np.ndarray
    corner_vertex: np.ndarray
    corner_edge: np.ndarray
    corner_face: np.ndarray
    n_faces: int

    @classmethod
    def of(cls, vertices: np.ndarray, faces: np.ndarray) -> CornerTable:
        """Make the table of a mesh whose faces all have k corners.

        vertices : (n, 3) array of float. faces : (p, k) int64. Returns a CornerTable.
        """
        start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
        edges, corner_edge = distinct_pairs(np.minimum(start, end), np.maximum(start, end))
        face = np.repeat(arange(len(faces)), faces.shape[1])
        return cls(np.asarray(vertices, np.float64), edges, start, corner_edge, face, len(faces))

    def within(self, mask: np.ndarray) -> CornerTable:
        """Make the table of some faces only.

        mask : (p,) bool, the faces to keep. Returns a CornerTable of all vertices, the edges of these faces and
        their corners; vertices and faces keep their numbers, edges do not.
        """
        kept = mask[self.corner_face]
        used, corner_edge = renumbered(self.corner_edge[kept])
        return CornerTable(self.vertices, self.edges[used], self.corner_vertex[kept], corner_edge,
                           self.corner_face[kept], self.n_faces)

    def joined(self) -> tuple[CornerTable, np.ndarray]:
        """Join the border vertices that are one, see ``joined_borders``.

        Returns
        -------
        table : CornerTable
            Of the same vertices and faces; corners and edges have the vertices that theirs are joined to, edges other
            numbers. The table itself where none are joined.
        first : (n,) int64
            The vertex that each vertex is joined to, itself for most.
        """
        n_edge_faces = self.n_edge_faces
        if not (n_edge_faces == 1).any():
            return self, arange(len(self.vertices))
        first = joined_borders(self.vertices, self.edges, n_edge_faces, self.corner_vertex, self.corner_face)
        if (first == arange(len(first))).all():
            return self, first
        edges, number = distinct_pairs(*np.sort(first[self.edges], axis=1).T)
        return replace(self, edges=edges, corner_vertex=first[self.corner_vertex],
                       corner_edge=number[self.corner_edge]), first

    def vertices_of(self, mask: np.ndarray) -> np.ndarray:
        """Which vertices are corners of some faces, (n,) bool. mask : (p,) bool, the faces."""
        found = np.zeros(len(self.vertices), bool)
        found[self.corner_vertex[mask[self.corner_face]]] = True
        return found

    def faces_at(self, mask: np.ndarray) -> np.ndarray:
        """Which faces have a corner at some vertices, (p,) bool. mask : (n,) bool, the vertices."""
        found = np.zeros(self.n_faces, bool)
        found[self.corner_face[mask[self.corner_vertex]]] = True
        return found

    def face_pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """List the faces that share an edge.

        Returns
        -------
        pairs : (r, 2) int64
            Faces that share an edge; k - 1 rows chain k faces that meet at one edge.
        edge : (r,) int64
            The shared edge, rising.
        """
        order = stable_order(self.corner_edge)
        edge = self.corner_edge[order]
        together = np.flatnonzero(edge[1:] == edge[:-1])
        first, second = order[together], order[together + 1]
        return np.stack([self.corner_face[first], self.corner_face[second]], axis=1), edge[together]

    def contrary_edges(self) -> np.ndarray:
        """Find the edges of two faces that run along them the same way: one looks out there, and the other in.

        Returns (e,) bool.
        """
        forward = self.edges[self.corner_edge, 0] == self.corner_vertex
        return (self.n_edge_faces == 2) & (np.bincount(self.corner_edge[forward], minlength=len(self.edges)) != 1)

    def edge_length(self, edge: np.ndarray) -> np.ndarray:
        """Measure some edges.

        edge : (k,) int64. Returns their lengths, (k,) float64, in the unit of the vertices.
        """
        start, end = self.vertices[self.edges[edge]].transpose(1, 0, 2)
        return lengths(end - start)

    def fans(self) -> tuple[np.ndarray, np.ndarray]:
        """Divide each face into triangles that share its first corner.

        Returns
        -------
        triangles : (t, 3) int64
            Vertices; a face of k corners gives k - 2.
        face : (t,) int64
            Face of each triangle, rising.
        """
        new = begins_run(self.corner_face)
        start = np.flatnonzero(new)[cumsum(new) - 1]
        middle = np.flatnonzero(~new & ~ends_run(self.corner_face))
        corners = np.stack([start[middle], middle, middle + 1], axis=1)
        return self.corner_vertex[corners], self.corner_face[middle]

    @property
    def n_edge_faces(self) -> np.ndarray:
        """Number of faces at each edge, (e,) int64."""
        return np.bincount(self.corner_edge, minlength=len(self.edges))

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box of all faces, in the unit of the vertices: one of no face can be anywhere."""
        return box_diagonal(self.vertices[self.corner_vertex])

    @property
    def next_corner(self) -> np.ndarray:
        """Corner that follows each corner in its face, (c,) int64."""
        return next_of_owner(self.corner_face)

    def face_vectors(self) -> np.ndarray:
        """Vector area of each face, (p, 3) float64: along its normal, as long as its area, 0 without corners."""
        triangles, face = self.fans()
        a, b, c = self.vertices[triangles].transpose(1, 0, 2)
        return sums_by(face, 0.5 * cross(b - a, c - a), self.n_faces)

    def face_means(self, values: np.ndarray) -> np.ndarray:
        """Average values of vertices over the corners of each face.

        values : (n,) or (n, k) float64. Returns (p,) or (p, k) float64; nan, with NumPy's warning, for a face
        without corners, as ``within`` leaves them.
        """
        total = np.bincount(self.corner_face, minlength=self.n_faces)
        return (sums_by(self.corner_face, values[self.corner_vertex], self.n_faces).T / total).T

    def edge_labels(self, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Find the smallest and the largest label of the faces at each edge.

        labels : (p,) int64, 0 or more. Returns two (e,) int64 arrays. They are equal inside a part and differ on a
        cut; for an edge without faces the smallest is the largest int64 and the largest is -1.
        """
        return edge_labels(self.corner_edge, self.corner_face, labels, len(self.edges))


def next_of_owner(owner: np.ndarray) -> np.ndarray:
    """Index of the next element of the same owner, in a circle, (c,) int64; the elements of an owner are in a row."""
    following = arange(1, len(owner) + 1)
    following[ends_run(owner)] = np.flatnonzero(begins_run(owner))
    return following


def edge_labels(
    corner_edge: np.ndarray, corner_face: np.ndarray, labels: np.ndarray, n_edges: int
) -> tuple[np.ndarray, np.ndarray]:
    """Find the smallest and the largest label of the faces at each edge, without a ``CornerTable``.

    Parameters
    ----------
    corner_edge, corner_face : (c,) int64
        Edge and face of each corner, as in ``CornerTable``.
    labels : (p,) int64
        Label of each face, 0 or more.
    n_edges : int
        Number of edges, e.

    Returns
    -------
    low, high : (e,) int64
        Equal inside a part, different on a cut; for an edge without faces the largest int64 and -1.
    """
    own = labels.astype(np.int32)[corner_face]
    first, last = np.empty(n_edges, np.int32), np.empty(n_edges, np.int32)
    # Of what is assigned to one element, the last stays; that is all there is at edges of one or two faces, and much
    # faster in old versions of NumPy than minimum.at, which the others need.
    first[corner_edge[::-1]] = own[::-1]
    last[corner_edge] = own
    count = np.bincount(corner_edge, minlength=n_edges)
    low, high = np.minimum(first, last).astype(np.int64), np.maximum(first, last).astype(np.int64)
    low[count == 0], high[count == 0] = np.iinfo(np.int64).max, -1
    if (count > 2).any():
        several = (count > 2)[corner_edge]
        np.minimum.at(low, corner_edge[several], own[several])
        np.maximum.at(high, corner_edge[several], own[several])
    return low, high
