# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of polygons that the shape alone decides, as ``ordering`` has it of their order.

A quadrilateral comes divided from its first corner, which is another in another file, and in the mirror image of a
model its two triangles follow each other the other way round. Neither is to decide which parts a model has.
"""

from __future__ import annotations

import numpy as np

from ..arrays.indexing import bounds_of_each, stable_order, sums_by
from ..arrays.int64 import arange
from ..arrays.ties import ranks
from ..arrays.vectors import cross, lengths, row_products
from ..mesh.triangles import TriMesh


def divided_by_shape(mesh: TriMesh, polygon: np.ndarray) -> TriMesh:
    """Divide quadrilaterals by the diagonal that ends farthest out; of two that end as far out the one there is stays.

    Far out is far from the middle of the piece, which is the same on all sides of a symmetric one. Two triangles that
    are no halves of a quadrilateral stay as they are.

    mesh : TriMesh. polygon : (m,) int64, of each face. Returns the mesh, the faces of each polygon in its own rows.
    """
    two, _ = _rows_of(polygon)
    if not len(two):
        return mesh
    faces = mesh.faces.copy()
    faces[two] = _halves(mesh.vertices, faces[two], _distance_ranks(mesh))
    return TriMesh(mesh.vertices, faces)


def outer_first(mesh: TriMesh, polygon: np.ndarray) -> np.ndarray:
    """Sort the triangles of each polygon: that which reaches farthest out first; of equals, that of the first vertices.

    mesh : TriMesh, m faces, its vertices sorted. polygon : (m,) int64, of each face. Returns the (m,) int64 faces in
    their order, those of each polygon in its own rows.
    """
    two, more = _rows_of(polygon)
    order, rank = arange(mesh.n_faces), _distance_ranks(mesh)
    out, place = (of_corner[0] + of_corner[1] + of_corner[2] for of_corner in (rank[mesh.faces.T], mesh.faces.T))
    (a, b), (first, second) = out[two.T], place[two.T]
    turned = two[(a < b) | ((a == b) & (first > second))]
    order[turned] = turned[:, ::-1]
    order[more] = more[np.lexsort((place[more], -out[more], polygon[more]))]
    return order


def _rows_of(polygon: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows of the two triangles of each quadrilateral, (q, 2) int64, and of those of larger polygons, one by one."""
    size = np.bincount(polygon)[polygon]
    two, more = (rows[stable_order(polygon[rows])] for rows in map(np.flatnonzero, (size == 2, size > 2)))
    return two.reshape(-1, 2), more


def _distance_ranks(mesh: TriMesh) -> np.ndarray:
    """Rank of the distance of each vertex from the middle of the vertices of its piece, (n,) int64."""
    count, piece = mesh.vertex_components
    points = np.where(mesh.used[:, None], mesh.vertices, 0.0)  # one of no face can be anywhere
    middle = sums_by(piece, points, count) / np.bincount(piece)[:, None]
    distance = lengths(points - middle[piece])
    _, farthest = bounds_of_each(piece, distance[:, None], count)
    return ranks(distance / np.maximum(farthest[piece, 0], 1e-300), 1.0)


def _halves(vertices: np.ndarray, pairs: np.ndarray, rank: np.ndarray) -> np.ndarray:
    """Two triangles of each quadrilateral, (q, 2, 3), for the two that it has, (q, 2, 3).

    rank : (n,) int64, of the distance of the vertices.
    """
    one, other = np.ascontiguousarray(pairs.transpose(1, 2, 0))  # (3, q), ten times as fast as (q, 3)
    single = np.array([[(x != y[0]) & (x != y[1]) & (x != y[2]) for x in z] for z, y in ((one, other), (other, one))])
    # The corners in their order are a, b, d, and c: d lies across the side from b to c.
    (a, b, c), (d, *shared) = (_begun_at(found, corners)
                               for found, corners in zip(single.argmax(axis=1), (one, other), strict=True))
    halves = (single[0].sum(axis=0) == 1) & (shared[0] == c) & (shared[1] == b)
    start = np.take(vertices, a, axis=0)
    to_b, to_c, to_d = (np.take(vertices, corners, axis=0) - start for corners in (b, c, d))
    # Whether the triangles of each diagonal look the same way.
    here = row_products(cross(to_b, to_c), cross(to_c - to_d, to_b - to_d)) > 0
    there = row_products(cross(to_b, to_d), cross(to_d, to_c)) > 0
    turned = halves & np.where(there == here, _is_outer(rank, (a, d), (b, c)), there)
    return np.where(turned[:, None, None], np.array([[a, b, d], [a, d, c]]).transpose(2, 0, 1), pairs)


def _begun_at(first: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Corners of triangles, (3, q), beginning with the first, the second or the third of each; first : (q,) int64."""
    place = arange(corners.shape[1])
    return np.array([corners[(first + k) % 3, place] for k in range(3)])


def _is_outer(rank: np.ndarray, one: tuple[np.ndarray, np.ndarray], other: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Whether one of two diagonals ends farther out than the other, (q,) bool.

    rank : (n,) int64, of the distance of the vertices. one, other : the (q,) vertices at both ends of each.
    """
    (low, high), (low_there, high_there) = ((np.minimum(x, y), np.maximum(x, y))
                                            for x, y in ((rank[a], rank[b]) for a, b in (one, other)))
    return (high > high_there) | ((high == high_there) & (low > low_there))
