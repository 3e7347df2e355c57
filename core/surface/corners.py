# SPDX-License-Identifier: GPL-3.0-or-later
"""The caller's polygons, corner by corner: what is done on them after a decomposition needs no triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import renumbered, sums_by


@dataclass(frozen=True, eq=False)
class CornerTable:
    """A polygon mesh by the corners of its faces.

    With n vertices, e edges, p faces and c corners:

    Attributes
    ----------
    vertices : (n, 3) float64
    edges : (e, 2) int64
        The vertices of each edge.
    corner_vertex, corner_edge, corner_face : (c,) int64
        Of each corner the vertex, the edge from there to the next corner, and the face; the faces rise.
    n_faces : int
    """

    vertices: np.ndarray
    edges: np.ndarray
    corner_vertex: np.ndarray
    corner_edge: np.ndarray
    corner_face: np.ndarray
    n_faces: int

    @classmethod
    def of(cls, vertices: np.ndarray, faces: np.ndarray) -> CornerTable:
        """From faces of equally many corners, (p, k) int64."""
        sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
        edges, corner_edge = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
        face = np.repeat(np.arange(len(faces)), faces.shape[1])
        return cls(np.asarray(vertices, np.float64), edges, faces.ravel(), corner_edge.reshape(-1), face, len(faces))

    def within(self, mask: np.ndarray) -> CornerTable:
        """The corners of some faces, (p,) bool, and the edges of these alone; faces keep their numbers."""
        kept = mask[self.corner_face]
        used, corner_edge = renumbered(self.corner_edge[kept])
        return CornerTable(self.vertices, self.edges[used], self.corner_vertex[kept], corner_edge,
                           self.corner_face[kept], self.n_faces)

    def face_pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """Faces that share an edge, (k, 2) int64, and that edge, (k,) int64; k - 1 rows where k faces meet."""
        order = np.argsort(self.corner_edge, kind="stable")
        edge = self.corner_edge[order]
        together = np.flatnonzero(edge[1:] == edge[:-1])
        first, second = order[together], order[together + 1]
        return np.stack([self.corner_face[first], self.corner_face[second]], axis=1), edge[together]

    def edge_length(self, edge: np.ndarray) -> np.ndarray:
        """Length of some edges, (k,) int64 to (k,) float64."""
        start, end = self.vertices[self.edges[edge]].transpose(1, 0, 2)
        return np.linalg.norm(end - start, axis=1)

    def face_means(self, values: np.ndarray) -> np.ndarray:
        """Mean over the corners of each face of what its vertices have: (n,) to (p,), or (n, k) to (p, k)."""
        total = np.bincount(self.corner_face, minlength=self.n_faces)
        return (sums_by(self.corner_face, values[self.corner_vertex], self.n_faces).T / total).T

    def edge_labels(self, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The smallest and the largest label of the faces at each edge, two (e,) int64 arrays.

        labels : (p,) int64. An edge of no face has the smallest above the largest.
        """
        return edge_labels(self.corner_edge, self.corner_face, labels, len(self.edges))


def edge_labels(
    corner_edge: np.ndarray, corner_face: np.ndarray, labels: np.ndarray, n_edges: int
) -> tuple[np.ndarray, np.ndarray]:
    """``CornerTable.edge_labels`` where only the edge and the face of each corner are known, two (c,) int64 arrays."""
    low = np.full(n_edges, np.iinfo(np.int64).max)
    high = np.full(n_edges, -1, np.int64)
    np.minimum.at(low, corner_edge, labels[corner_face])
    np.maximum.at(high, corner_edge, labels[corner_face])
    return low, high
