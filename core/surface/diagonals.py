# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of polygons that the shape alone decides, as ``ordering`` has it of their order.

A quadrilateral comes divided from its first corner, which is another in another file, and in the mirror image of a
model its two triangles follow each other the other way round. Neither is to decide which parts a model has.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import bounds_of_each, inverse, renumbered, stable_order, sums_by
from ..arrays.int64 import arange, cumsum
from ..arrays.pairs import distinct_pairs
from ..arrays.ties import ranks
from ..arrays.vectors import across_each, cross, lengths, row_products, unit
from ..mesh.triangles import TriMesh

STRAIGHT = 1e-6  # in units of the area: a corner that turns less is straight


@dataclass(frozen=True, eq=False)
class Divided:
    """A mesh whose quadrilaterals are divided by its shape.

    Attributes
    ----------
    mesh : TriMesh
        n vertices; the faces of each polygon are in its own rows.
    rank : (n,) int64
        Of the distance of each vertex from the middle of its piece.
    tied : (k, 2) int64
        Faces of the quadrilaterals whose diagonals end equally far out: the one that was there has stayed.
    more : (r,) int64
        Faces of larger polygons, those of each in its own rows: they are as they were.
    polygon : (r,) int64
        Polygon of each of these, rising.
    """

    mesh: TriMesh
    rank: np.ndarray
    tied: np.ndarray
    more: np.ndarray
    polygon: np.ndarray

    def by_order(self, number: np.ndarray) -> TriMesh:
        """The mesh with those divided, too, from the first of the corners farthest out, and larger ones, if convex.

        number : (n,) int64, place of each vertex in an order that the shape decides.
        """
        if not (len(self.tied) or len(self.more)):
            return self.mesh
        faces, rank = self.mesh.faces.copy(), inverse(np.lexsort((-number, self.rank)))
        faces[self.tied] = _halves(self.mesh.vertices, faces[self.tied], rank)[0]
        if len(self.more):
            faces[self.more] = _fans(self.mesh.vertices, faces[self.more], self.polygon, rank)
        return TriMesh(self.mesh.vertices, faces)


def divided_by_shape(mesh: TriMesh, polygon: np.ndarray) -> Divided:
    """Divide quadrilaterals by the diagonal that ends farthest out.

    Far out is far from the middle of the piece, which is the same on all sides of a symmetric one. Two triangles that
    are no halves of a quadrilateral stay as they are.

    mesh : TriMesh. polygon : (m,) int64, of each face.
    """
    two, more = _rows_of(polygon)
    rank, faces = _distance_ranks(mesh), mesh.faces.copy()
    faces[two], tied = _halves(mesh.vertices, faces[two], rank)
    return Divided(TriMesh(mesh.vertices, faces) if len(two) else mesh, rank, two[tied], more, polygon[more])


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


def _halves(vertices: np.ndarray, pairs: np.ndarray, rank: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two triangles of each quadrilateral, (q, 2, 3), for the two that it has, (q, 2, 3).

    And whether both diagonals end equally far out, (q,) bool. rank : (n,) int64, of the distance of the vertices.
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
    outer, inner = _is_outer(rank, (a, d), (b, c)), _is_outer(rank, (b, c), (a, d))
    turned = halves & np.where(there == here, outer, there)
    return (np.where(turned[:, None, None], np.array([[a, b, d], [a, d, c]]).transpose(2, 0, 1), pairs),
            halves & (there == here) & ~outer & ~inner)


def _fans(vertices: np.ndarray, faces: np.ndarray, polygon: np.ndarray, rank: np.ndarray) -> np.ndarray:
    """Triangles of convex polygons, each a fan from the corner of the highest rank, and those given of all others.

    faces : (r, 3) int64. polygon : (r,) int64, of each, rising. rank : (n,) int64. Returns (r, 3) int64.
    """
    names, number = renumbered(polygon)
    size = np.bincount(number) + 2  # corners of a polygon that was cut along diagonals
    corner, first, convex = _rounds(vertices, faces, number)
    convex &= np.diff(first) == size
    begin, owner = np.zeros(len(names), np.int64), np.repeat(arange(len(names)), np.diff(first))
    rising = np.lexsort((rank[corner], owner))
    begin[owner[rising]] = rising - first[owner[rising]]  # NumPy keeps the last value of each place
    step = arange(len(number)) - (cumsum(size - 2) - (size - 2))[number]
    chosen = np.flatnonzero(convex[number])
    its = number[chosen]
    at = (begin[its] + np.stack([0 * step[chosen], step[chosen] + 1, step[chosen] + 2])) % size[its]
    result = faces.copy()
    result[chosen] = corner[first[its] + at].T
    return result


def _rounds(vertices: np.ndarray, faces: np.ndarray, number: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The corners of polygons in the order in which they go round, if convex.

    faces : (r, 3) int64, triangles. number : (r,) int64, polygon of each, 0..q-1. Returns the corners, (c,) int64;
    where those of each polygon begin and end, (q + 1,); and which polygons are convex without a straight corner, (q,).
    """
    owner, corner = distinct_pairs(np.repeat(number, 3), faces.ravel())[0].T
    n_corners = np.bincount(owner)
    first = np.append(0, cumsum(n_corners))
    start, middle, end = (vertices[column] for column in faces.T)
    normal = sums_by(number, cross(middle - start, end - start), len(n_corners))
    away = vertices[corner] - (sums_by(owner, vertices[corner], len(n_corners)) / n_corners[:, None])[owner]
    across = across_each(normal)
    up = cross(unit(normal), across)
    order = np.lexsort((np.arctan2(row_products(away, up[owner]), row_products(away, across[owner])), owner))
    corner, away = corner[order], away[order]
    place = arange(len(owner)) - first[owner]
    before, after = (first[owner] + (place + step) % n_corners[owner] for step in (-1, 1))
    bend = row_products(cross(away - away[before], away[after] - away), normal[owner])
    area, around = row_products(normal, normal), sums_by(owner, cross(away[before], away), len(n_corners))
    same = np.abs(row_products(around, normal) - area) <= STRAIGHT * area  # of a star it is another
    return corner, first, same & (np.bincount(owner, bend <= STRAIGHT * area[owner]) == 0)


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
