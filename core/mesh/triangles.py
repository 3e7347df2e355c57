# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangle mesh that every stage works on, and the checks where data enters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import begins_run, frozen, renumbered, sealed, stable_order, sums_by, taken
from ..arrays.int64 import cumsum, full
from ..arrays.vectors import BLOCK, box_diagonal, cross, distances_between, lengths, row_products
from ..errors import MeshError
from ..sentence import Sentence
from .arguments import check_is_mesh

ON_A_LINE = 1e-11  # sine of the least angle below which the corners of a face lie on a line, but for rounding
# What faces without an area weigh where faces vote for labels by their areas, as a share of the area of the mesh, and
# what is added to all the others. Lengths vote with this share of its root.
LEAST_WEIGHT = 1e-12
LEVEL = 1e-12  # in units of the root of the area: what rises less between two faces is neither convex nor concave


def check_corners(triangles: np.ndarray, n_vertices: int, polygon: np.ndarray | None = None) -> None:
    """Raise MeshError if a face names a vertex that does not exist; ``error.faces`` lists these faces.

    Parameters
    ----------
    triangles : (m, 3) of int
    n_vertices : int
    polygon : (m,) of int, optional
        The caller's face that each triangle is cut from, rising from 0. Without it each triangle is a face.
    """
    if triangles.min(initial=0) >= 0 and triangles.max(initial=-1) < n_vertices:
        return
    bad = np.flatnonzero(((triangles < 0) | (triangles >= n_vertices)).any(axis=1))
    total = len(triangles)
    if polygon is not None:
        bad, total = np.unique(polygon[bad]), int(polygon.max()) + 1
    raise MeshError(
        Sentence(
            "{n} of {total} faces {n:names|name} a vertex that does not exist (first: face {first}; "
            "there are {n_vertices} vertices).",
            n=len(bad), total=total, first=int(bad[0]), n_vertices=n_vertices),
        faces=bad,
    )


def vote_weights(area: np.ndarray, whole: float | None = None) -> np.ndarray:
    """Weights of votes by area, (n,) float64: what has none votes after all others.

    area : (n,) float64. whole : area of the mesh, in the same unit; the sum of the areas if not given.
    """
    return area + LEAST_WEIGHT * (area.sum() if whole is None else whole)


def of_corners(
    points: np.ndarray, faces: np.ndarray, function: Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
) -> np.ndarray:
    """What a function makes of the corners of faces: (m, 3) float64.

    points : (n, 3) float64. faces : (m, 3) int64. function : of k faces the first, second and third corners, (k, 3)
    each, into (k, 3); it is called for so few faces at a time that what it makes stays in the processor's cache.
    """
    result = np.empty((len(faces), 3))
    for start in range(0, len(faces), BLOCK):
        some = faces[start:start + BLOCK]
        result[start:start + BLOCK] = function(*(taken(points, corner) for corner in some.T))
    return result


def next_side(side: np.ndarray) -> np.ndarray:
    """The side that follows each one in its face; sides, and the corners where they begin, are 3 times the face + 0..2.

    side : int64 of any shape. Returns int64 of this shape.
    """
    return side - side % 3 + (side + 1) % 3


def corner_sides(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The two sides that meet at each corner of some triangles, and the ends of the side that faces it.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (t, 3) int64

    Returns
    -------
    ends : (3t, 2) int64
        Of the side that faces each corner: the next corner of the triangle, and the one before.
    to_next, to_last : (3t, 3) float64
        From each corner to these, in the unit of the points.
    """
    ends = np.stack([np.roll(triangles, -1, axis=1), np.roll(triangles, 1, axis=1)], axis=2).reshape(-1, 2)
    corner = taken(points, triangles.ravel())
    return ends, taken(points, ends[:, 0]) - corner, taken(points, ends[:, 1]) - corner


def vertex_components(faces: np.ndarray, n_vertices: int) -> tuple[int, np.ndarray]:
    """Find the connected components of vertices, those of a face being joined.

    faces : (m, 3) of int, 0..n_vertices-1. Returns their number and the component of each vertex, (n_vertices,) int64,
    from 0; a vertex of no face is one of its own.
    """
    a, b, c = faces.T
    return components(n_vertices, np.concatenate([a, b]), np.concatenate([b, c]))


@dataclass(frozen=True, eq=False)
class TriMesh:
    """A triangle mesh, checked when it is made and never changed; tables are computed when first asked for.

    Attributes
    ----------
    vertices : (n, 3) float64
        Positions, in the caller's unit of length.
    faces : (m, 3) int64
        Vertex indices. Any topology: borders, non-manifold edges, loose parts.

    Raises
    ------
    MeshError
        The arrays have other shapes, faces are not whole numbers, a face names a vertex that does not exist, or a
        coordinate is not finite; ``error.vertices`` or ``error.faces`` lists the last two.
    """

    vertices: np.ndarray
    faces: np.ndarray

    def __repr__(self) -> str:
        return f"<TriMesh: {self.n_vertices} vertices, {self.n_faces} faces>"

    def __post_init__(self) -> None:
        """Check the shapes and freeze copies of the arrays."""
        vertices = np.asarray(self.vertices)
        faces = np.asarray(self.faces)
        if vertices.ndim != 2 or vertices.shape[1] != 3:
            raise MeshError(
                Sentence("Vertices must have shape (n, 3), not {shape}.", shape=vertices.shape))
        if faces.size == 0:
            faces = np.empty((0, 3), np.int64)
        if faces.ndim != 2 or faces.shape[1] != 3:
            raise MeshError(
                Sentence("Triangles must have shape (m, 3), not {shape}.", shape=faces.shape))
        if not np.issubdtype(faces.dtype, np.integer):
            raise MeshError(
                Sentence("Face indices must be whole numbers, not {type}.", type=faces.dtype))
        object.__setattr__(self, "vertices", frozen(vertices, np.float64))
        object.__setattr__(self, "faces", frozen(faces, np.int64))
        self._check_values()

    def _check_values(self) -> None:
        """Raise MeshError if a coordinate is not finite or a face names a vertex that does not exist."""
        if not np.isfinite(self.vertices).all():
            bad = np.flatnonzero(~np.isfinite(self.vertices).all(axis=1))
            raise MeshError(
                Sentence(
                    "{n} of {total} vertices {n:has|have} a coordinate that is not a finite number (first: "
                    "vertex {first}). Delete or move them.",
                    n=len(bad), total=self.n_vertices, first=int(bad[0])),
                vertices=bad,
            )
        check_corners(self.faces, self.n_vertices)

    @classmethod
    def of(cls, mesh: Any) -> TriMesh:
        """What another library calls a mesh as a TriMesh.

        mesh : anything with ``vertices``, (n, 3), and ``faces``, (m, 3), such as a ``trimesh.Trimesh``; a TriMesh is
        returned as it is. Raises MeshError.
        """
        if isinstance(mesh, cls):
            return mesh
        check_is_mesh(mesh)
        return cls(mesh.vertices, mesh.faces)

    @property
    def n_vertices(self) -> int:
        """Number of vertices, n."""
        return len(self.vertices)

    @property
    def n_faces(self) -> int:
        """Number of faces, m."""
        return len(self.faces)

    @property
    def corners(self) -> np.ndarray:
        """(m, 3, 3) float64, position of each corner of each face; made anew, because a large mesh has many."""
        return taken(self.vertices, self.faces)

    @cached_property
    def used(self) -> np.ndarray:
        """(n,) bool, whether each vertex has a face."""
        used = np.zeros(self.n_vertices, bool)
        used[self.faces] = True
        return used

    @property
    def diagonal(self) -> float:
        """Diagonal of the box around all faces, in the unit of the vertices: a vertex of none can be anywhere."""
        return box_diagonal(self.vertices[self.used])

    @cached_property
    def area_normals(self) -> np.ndarray:
        """(m, 3) float64, normal of each face, as long as the face's area."""
        return of_corners(self.vertices, self.faces, lambda p, q, r: 0.5 * cross(q - p, r - p))

    @cached_property
    def face_area(self) -> np.ndarray:
        """(m,) float64, area of each face, in squared units of the vertices."""
        return lengths(self.area_normals)

    @property
    def face_weight(self) -> np.ndarray:
        """(m,) float64, weight of the vote of each face: its area; faces without one vote after all others."""
        return vote_weights(self.face_area, self.area)

    @cached_property
    def face_normals(self) -> np.ndarray:
        """(m, 3) float64, unit normal of each face; zero where the face has no area but for rounding."""
        area = self.face_area
        some = area > 0
        small = np.flatnonzero(area <= 0.01 * area.mean())  # the others are no lines, and take long
        p, q, r = taken(self.vertices, self.faces[small].T)
        _, second, longest = np.sort([lengths(q - p), lengths(r - q), lengths(p - r)], axis=0)
        some[small] &= area[small] > ON_A_LINE * second * longest
        return np.divide(self.area_normals, area[:, None], out=np.zeros((self.n_faces, 3)), where=some[:, None])

    @property
    def has_area(self) -> np.ndarray:
        """(m,) bool, whether each face has an area, but for rounding."""
        return lengths(self.face_normals) > 0

    @property
    def vertex_area_normals(self) -> np.ndarray:
        """(n, 3) float64, sum of the ``area_normals`` of the faces at each vertex."""
        return sums_by(self.faces.ravel(), np.repeat(self.area_normals, 3, axis=0), self.n_vertices)

    @cached_property
    def face_centroids(self) -> np.ndarray:
        """(m, 3) float64, mean of the corners of each face."""
        return of_corners(self.vertices, self.faces, lambda p, q, r: (p + q + r) / 3)

    @cached_property
    def area(self) -> float:
        """Area of the whole surface, in squared units of the vertices."""
        return float(self.face_area.sum())

    @cached_property
    def vertex_area(self) -> np.ndarray:
        """(n,) float64, a third of the area of the faces around each vertex; the sum is ``area``."""
        return np.bincount(self.faces.ravel(), np.repeat(self.face_area / 3, 3), self.n_vertices)

    @cached_property
    def edges(self) -> EdgeTable:
        """Every edge once, and the faces that meet there."""
        return EdgeTable.of(self.faces)

    @cached_property
    def edge_length(self) -> np.ndarray:
        """(e,) float64, length of each edge of ``edges.vertices``."""
        a, b = self.edges.vertices.T
        return distances_between(self.vertices, a, b)

    @cached_property
    def pair_length(self) -> np.ndarray:
        """(p,) float64, length of the edge between the faces of each pair of ``edges.pairs``."""
        return self.edge_length[self.edges.pair_edge]

    @property
    def pair_middle(self) -> np.ndarray:
        """(p, 3) float64, middle of the edge between the faces of each pair; made anew, as seldom used."""
        a, b = taken(self.edges.vertices, self.edges.pair_edge).T
        return (taken(self.vertices, a) + taken(self.vertices, b)) / 2

    @cached_property
    def pair_distance(self) -> np.ndarray:
        """(p,) float64, length of the way from centroid to centroid across the middle of the shared edge."""
        middle = self.pair_middle
        left, right = (taken(self.face_centroids, face) - middle for face in self.edges.pairs.T)
        return np.sqrt(np.einsum("ij,ij->i", left, left)) + np.sqrt(np.einsum("ij,ij->i", right, right))

    @cached_property
    def dihedral(self) -> np.ndarray:
        """(p,) float64, angle in radians between the normals of the faces of each pair of ``edges.pairs``.

        The angle is positive where the surface is convex, negative where it is concave, and 0 where a face has no
        area. It is positive, too, where neither can be said, as of faces that are folded onto each other.
        """
        left, right = self.edges.pairs.T
        normal_left, normal_right = (taken(self.face_normals, face) for face in (left, right))
        sine = cross(normal_left, normal_right)
        cosine = row_products(normal_left, normal_right)
        angle = np.arctan2(lengths(sine), cosine + 0.0)  # -0.0 would be half a turn
        across = taken(self.face_centroids, right) - taken(self.face_centroids, left)
        rises = row_products(normal_left - normal_right, across)
        convex = rises <= LEVEL * np.sqrt(self.area)
        return np.where(convex, angle, -angle)

    @cached_property
    def vertex_components(self) -> tuple[int, np.ndarray]:
        """Number of components of the vertices, and the component of each, (n,) int64; see the function."""
        return vertex_components(self.faces, self.n_vertices)

    @cached_property
    def face_components(self) -> tuple[int, np.ndarray]:
        """Number of components of the surface, and the component of each face, (m,) int64; faces touch by edges."""
        return components(self.n_faces, *self.edges.pairs.T)

    @property
    def euler_characteristic(self) -> int:
        """Number of vertices that have a face, minus the number of edges, plus the number of faces."""
        return int(self.used.sum()) - len(self.edges.vertices) + self.n_faces

    @cached_property
    def same_way(self) -> np.ndarray:
        """(p,) bool, whether the faces of each pair of ``edges.pairs`` run the same way along their edge.

        Faces that are turned the same way run along it in opposite ways.
        """
        first, second = self.faces.ravel()[self.edges.pair_sides.T]
        return first == second

    def submesh(self, face_mask: np.ndarray) -> tuple[TriMesh, np.ndarray]:
        """Copy some faces, with their vertices only.

        Parameters
        ----------
        face_mask : (m,) bool, or (m',) int64
            Faces to copy, or these in the order in which they are to be.

        Returns
        -------
        mesh : TriMesh
            m' faces and n' vertices, in the order of this mesh.
        vertex_index : (n',) int64
            Vertex of this mesh at each vertex of the copy.
        """
        vertex_index, faces = renumbered(taken(self.faces, face_mask))
        return TriMesh(taken(self.vertices, vertex_index), faces), vertex_index


@dataclass(frozen=True, eq=False)
class EdgeTable:
    """Edges of a triangle mesh, and the faces that meet there.

    Attributes
    ----------
    vertices : (e, 2) int64
        Ends of each edge, smaller index first, in lexicographic order.
    face_edges : (m, 3) int64
        Edge between corners 0-1, 1-2 and 2-0 of each face.
    n_faces : (e,) int64
        Number of faces that meet at each edge: 1 at a border, 2 inside, more if non-manifold.
    pairs : (p, 2) int64
        Faces that touch along an edge: one row at an inner edge; where k faces meet, k - 1 rows chain them. A face
        with a repeated vertex never makes a pair with itself.
    pair_edge : (p,) int64
        Edge of each pair.
    pair_sides : (p, 2) int64
        Side of each face of each pair along which they touch: 3 times the face, plus the corner where the side begins.
    """

    vertices: np.ndarray
    face_edges: np.ndarray
    n_faces: np.ndarray
    pairs: np.ndarray
    pair_edge: np.ndarray
    pair_sides: np.ndarray

    @classmethod
    def of(cls, faces: np.ndarray) -> EdgeTable:
        """Make the table of the edges of some faces.

        faces : (m, 3) int64, 0 or more. Returns an EdgeTable.
        """
        start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
        low, high = np.minimum(start, end), np.maximum(start, end)
        order = stable_order(high)
        order = order[stable_order(low[order])]
        low, high = low[order], high[order]
        begins = begins_run(low) | begins_run(high)
        first_of_edge, together = np.flatnonzero(begins), np.flatnonzero(~begins[1:])
        vertices = np.stack([low[first_of_edge], high[first_of_edge]], axis=1)
        del low, high  # of a million vertices, each array is 50 MB
        edge_sorted = cumsum(begins) - 1
        edge = np.empty(len(order), np.int64)
        edge[order] = edge_sorted
        sides, pair_edge = np.stack([order[together], order[together + 1]], axis=1), edge_sorted[together]
        del order, edge_sorted
        pairs = sides // 3
        distinct = pairs[:, 0] != pairs[:, 1]
        if not distinct.all():
            pairs, sides, pair_edge = pairs[distinct], sides[distinct], pair_edge[distinct]
        count = np.diff(np.append(first_of_edge, len(begins)))
        return cls(*map(sealed, (vertices, edge.reshape(-1, 3), count, pairs, pair_edge, sides)))

    def opposite_sides(self, chosen: np.ndarray) -> np.ndarray:
        """The side of the other face of a pair at each side of a face, (3 m,) int64; -1 at sides of no chosen pair.

        chosen : (p,) bool, pairs at edges of two faces.
        """
        opposite = full(self.face_edges.size, -1)
        first, second = self.pair_sides[chosen].T
        opposite[first], opposite[second] = second, first
        return opposite
