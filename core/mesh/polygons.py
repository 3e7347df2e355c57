# SPDX-License-Identifier: GPL-3.0-or-later
"""The caller's mesh with its polygons cut into triangles, and the checks of the arrays that ``decompose`` gets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays.hashes import rehashed
from ..arrays.indexing import frozen, place_among
from ..arrays.int64 import arange
from ..errors import EmptyMeshError, MeshError
from ..sentence import Sentence
from .arguments import corners, positions, whole_numbers
from .ears import fans, without_folds
from .labels import majority
from .triangles import TriMesh, check_corners

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

MIN_FACES = 4  # number of faces of a tetrahedron, the smallest closed surface
# Powers of two between which coordinates can be: areas in squared units of the caller must be numbers, too. These are
# some 1e-152 and 1e152.
LEAST_EXPONENT, LARGEST_EXPONENT = -505, 505
# Meshes whose largest coordinate is between 2**-20 and 2**20 are taken as they are.
USUAL_EXPONENT = 20


@dataclass(frozen=True, eq=False)
class PolygonMesh:
    """The caller's polygons, cut into triangles.

    Attributes
    ----------
    triangles : TriMesh
        All of the caller's vertices, divided by 2**exponent, and the m triangles of the polygons.
    polygon : (m,) int64
        Polygon of each triangle, 0..n_polygons-1.
    n_polygons : int
        Number of polygons: the caller's faces.
    exponent : int
        Lengths in the caller's unit are 2**exponent times those here: a power of two, so that no digit changes. 0
        unless the mesh is very large or very small; its largest coordinate here is then between 1/2 and 1, so that no
        product of lengths overflows or vanishes.
    vertex_rank : (n,) int64, optional
        Place of each vertex in the caller's order, if this is another.
    """

    triangles: TriMesh
    polygon: np.ndarray
    n_polygons: int
    exponent: int = 0
    vertex_rank: np.ndarray | None = None

    @classmethod
    def of(
        cls, vertices: ArrayLike, faces: ArrayLike | Sequence[Sequence[int]], polygon: ArrayLike | None = None
    ) -> PolygonMesh:
        """Read triangles, quads or polygons.

        Parameters
        ----------
        vertices : (n, 3) array_like of float
            Positions, in any unit of length.
        faces : (p, k) array_like of int, or a sequence of p index sequences
            Vertices of each polygon. A polygon is cut into the triangles that its first corner forms with its sides, or
            by ``without_folds`` where these would lie on each other.
        polygon : (m,) array_like of int, optional
            For a caller who has cut polygons into triangles already: ``faces`` are then (m, 3) triangles, and this
            is the polygon of each.

        Returns
        -------
        mesh : PolygonMesh

        Raises
        ------
        MeshError
            A shape, an index, a polygon's number or a coordinate is wrong, or the mesh is too large for its area to be
            a number.
        EmptyMeshError
            There are fewer than MIN_FACES polygons, or the surface has no area.
        """
        sizes = None
        if polygon is None:
            faces, polygon, sizes = _fan(faces)
            n_polygons = len(sizes)
        else:
            faces, polygon, n_polygons = _numbered(faces, polygon)
        if n_polygons == 0:
            raise EmptyMeshError(
                Sentence("The mesh has no faces. Add some, or choose another object."))
        vertices = positions(vertices)
        if vertices.shape[1:] == (3,):  # or TriMesh says what they are
            check_corners(faces, len(vertices), polygon)
        triangles, exponent = normalized(TriMesh(vertices, faces))
        if sizes is not None and (cut := without_folds(triangles.vertices, faces, sizes)) is not faces:
            triangles = TriMesh(triangles.vertices, cut)
        mesh = cls(triangles, frozen(polygon, np.int64), n_polygons, exponent)
        mesh._check_size()
        return mesh

    def vertex_labels(self, label: np.ndarray) -> np.ndarray:
        """Label of each vertex, (n,) int64: that of most of the area of its polygons; -1 for a vertex of none.

        label : (p,) int64, 0 or more.
        """
        mesh = self.triangles
        return majority(mesh.faces.ravel(), np.repeat(label[self.polygon], 3), np.repeat(mesh.face_weight, 3),
                        mesh.n_vertices)

    def submesh(self, polygon: np.ndarray, vertex: np.ndarray, home: np.ndarray) -> PolygonMesh:
        """Some of the polygons, on some of the vertices.

        polygon : (k,) int64, rising. vertex : (m,) int64. home : (n,) int64, for each vertex that these polygons have,
        the place in ``vertex`` of the one that they get.
        """
        number = place_among(polygon, self.n_polygons)
        kept = number[self.polygon] >= 0
        triangles = TriMesh(self.triangles.vertices[vertex], home[self.triangles.faces[kept]])
        return replace(self, triangles=triangles, polygon=frozen(number[self.polygon[kept]], np.int64),
                       n_polygons=len(polygon))

    def _check_size(self) -> None:
        """Raise EmptyMeshError if the mesh is too small to have parts."""
        if self.n_polygons < MIN_FACES:
            raise EmptyMeshError(
                Sentence(
                    "The mesh has only {n} of the {least} faces that the smallest solid has. "
                    "Choose a larger mesh.",
                    n=self.n_polygons, least=MIN_FACES),
                faces=arange(self.n_polygons),
            )
        if self.exponent > LARGEST_EXPONENT:
            raise MeshError(Sentence("The mesh is too large to be measured. Check the scale of the object."))
        used = self.triangles.used
        extent = np.ptp(self.triangles.vertices[used], axis=0).max()
        # An area below the rounding error of the coordinates is noise.
        if self.exponent < LEAST_EXPONENT or not self.triangles.area > 1e-14 * extent**2:
            raise EmptyMeshError(Sentence(
                "All {n} faces have zero area. Check the scale of the object.", n=self.n_polygons))


def normalized(mesh: TriMesh) -> tuple[TriMesh, int]:
    """Divide a mesh by a power of two where lengths are very large or very small.

    mesh : TriMesh. Returns the TriMesh, in which vertices without a face may lie elsewhere, and the exponent.
    """
    exponent = int(np.frexp(np.abs(mesh.vertices[mesh.used]).max(initial=0.0))[1])
    if abs(exponent) <= USUAL_EXPONENT:
        return mesh, 0
    # A vertex without a face can be anywhere, and is of no account.
    return TriMesh(np.ldexp(np.where(mesh.used[:, None], mesh.vertices, 0.0), -exponent), mesh.faces), exponent


def hashed_polygons(mesh: PolygonMesh, corner: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number polygons by their outlines.

    Parameters
    ----------
    mesh : PolygonMesh
    corner : (n,) uint64
        A number for each vertex.

    Returns
    -------
    number : (p,) uint64
        Equal for polygons whose corners have the same numbers, in the same order or the opposite one, and hardly ever
        for others; 0 for some without area.
    backwards : (p,) bool
        Which of the two ways round the outline each polygon runs.

    Notes
    -----
    Each side of a triangle counts with a sign for its direction, so that sides within a polygon cancel out, however it
    is cut into triangles.
    """
    other = rehashed(corner)
    corners = mesh.triangles.faces.T
    total = np.zeros(mesh.triangles.n_faces, np.uint64)
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        total += corner[a] * other[b] - corner[b] * other[a]
    if mesh.n_polygons < mesh.triangles.n_faces:
        of_triangle, total = total, np.zeros(mesh.n_polygons, np.uint64)
        np.add.at(total, mesh.polygon, of_triangle)
    other_way = np.uint64(0) - total
    return np.minimum(total, other_way), total > other_way


def _numbered(faces: ArrayLike, polygon: ArrayLike) -> tuple[np.ndarray, np.ndarray, int]:
    """Triangles as they are given, the polygon of each, (m,), and the number of polygons."""
    flat, sizes = corners(faces)
    number = whole_numbers(polygon)
    # A polygon has a triangle or more, so that no number is beyond the last triangle's.
    if number is None or number.shape != (len(sizes),) or not ((number >= 0) & (number < len(sizes))).all():
        raise MeshError(Sentence(
            "Polygon numbers must be {n} whole numbers from 0, one per triangle.",
            n=len(sizes)))
    if (sizes != 3).any():
        raise MeshError(Sentence("Triangles must have shape (m, 3), not {shape}.",
                                 shape=(len(sizes), int(sizes[sizes != 3][0]))))
    return flat.reshape(-1, 3), number, int(number.max(initial=-1)) + 1


def _fan(faces: ArrayLike | Sequence[Sequence[int]]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles of polygons, (m, 3), the polygon of each, (m,), and how many corners each polygon has, (p,)."""
    flat, sizes = corners(faces)
    if (sizes < 3).any():
        bad = np.flatnonzero(sizes < 3)
        raise MeshError(
            Sentence("{n} {n:face has|faces have} fewer than three corners.", n=len(bad)), faces=bad)
    return *fans(flat, sizes), sizes
