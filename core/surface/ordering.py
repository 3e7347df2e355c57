# SPDX-License-Identifier: GPL-3.0-or-later
"""An order of faces and vertices that the shape alone decides.

Of two cuts, seeds or neighbors that are equally good, the first is chosen, and symmetric or regular meshes are full of
such pairs. The caller's order must not be what decides: the same model, exported again, is to have the same parts. So
every run begins by sorting faces and vertices by their place along the principal axes of the surface, and ends by
bringing the result back to the caller's order. What lies near each other then also lies near in memory.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays.hashes import hashed_rows
from ..arrays.indexing import (
    bounds_of_each,
    frozen,
    inverse,
    places_of_ties,
    renumbered,
    stable_order,
    sums_by,
    taken,
)
from ..arrays.int64 import arange, full
from ..arrays.ties import DENSE, TIE, ranks
from ..arrays.vectors import box_diagonal, inner_products, middles_of_each, second_moments, weighted_sum
from ..mesh.polygons import PolygonMesh
from ..mesh.triangles import TriMesh, of_corners
from .diagonals import divided_by_shape, outer_first

# The largest coordinate is so many cells, and the middle, where symmetric shapes have vertices, so far within its cell:
# rounding is not to decide in which cell a point lies. Points of one cell are compared one by one. Of a dense mesh, on
# whose irregular vertices nothing depends, cells are so small that few points share one.
CELLS, SMALL_CELLS, OFF = 2**9, 2**19, 0.45
FINE = 2**40  # steps of the largest coordinate by which points are compared that are alike in all else
# Shifts and masks that put two zeros before each of 21 binary digits.
_SPREAD = ((32, 0x1F00000000FFFF), (16, 0x1F0000FF0000FF), (8, 0x100F00F00F00F00F), (4, 0x10C30C30C30C30C3),
           (2, 0x1249249249249249))
EQUAL = 4 * TIE  # relative difference below which two moments are equal
LEAST_PIECE = 0.05  # share of the faces from which a piece is sorted in a frame of its own
NEAR = 0.02  # share of the diagonal; pieces farther from each other are hardly one body


@dataclass(frozen=True, eq=False)
class Ordering:
    """Where the vertices and polygons of a sorted mesh are in that which was given.

    The order does not depend on that of the given faces, nor on pose and scale; on that of the given vertices only
    where a symmetry of the shape leaves several orders.

    Attributes
    ----------
    vertex : (n,) int64
        The given vertex at each place.
    polygon : (p,) int64
        The given polygon at each place.
    """

    vertex: np.ndarray
    polygon: np.ndarray

    @classmethod
    def of(
        cls, mesh: TriMesh, polygon: np.ndarray, n_polygons: int, vertex_rank: np.ndarray | None = None
    ) -> Ordering:
        """Find the order of a mesh of m triangles and n vertices.

        polygon : (m,) int64, of each triangle, 0..n_polygons-1. vertex_rank : (n,) int64, the order of the vertices
        that decides where the shape is symmetric; that in which they are without it.
        """
        corner, axes = _in_own_frame(mesh, polygon, vertex_rank)
        center = of_corners(corner, mesh.faces, lambda p, q, r: (p + q + r) / 3)

        def normal() -> np.ndarray:
            """Normal of each face, (m, 3), along the axes."""
            return inner_products(mesh.face_normals, axes)

        def beside() -> np.ndarray:
            """What lies around each vertex, (n, 3): seams have two vertices at one place."""
            around = sums_by(mesh.faces.ravel(), np.repeat((center + normal()) / 2, 3, axis=0), mesh.n_vertices)
            return around / np.maximum(np.bincount(mesh.faces.ravel(), minlength=mesh.n_vertices), 1)[:, None]

        def mean(of_triangle: np.ndarray) -> np.ndarray:
            """Mean over the area of each polygon, (p, 3), which is the same however it is divided."""
            if n_polygons == mesh.n_faces and (polygon == arange(n_polygons)).all():
                return of_triangle
            weight = np.where(np.bincount(polygon, mesh.face_area, n_polygons)[polygon] > 0, mesh.face_area, 1.0)
            total = np.bincount(polygon, weight, n_polygons)
            total[total == 0] = 1.0  # a polygon of no triangle
            return sums_by(polygon, weight[:, None] * of_triangle, n_polygons) / total[:, None]

        by_place = _order(mean(center), lambda: mean(normal()))
        return cls(_order(corner, beside), by_place)

    def with_piece(self, piece: Ordering, vertex: np.ndarray, polygon: np.ndarray) -> Ordering:
        """The order with the vertices and polygons of a piece, in their places, in the order of the piece.

        vertex, polygon : those of the mesh that are the vertices and polygons of the piece.
        """
        changed = {}
        for name, inside in (("vertex", vertex), ("polygon", polygon)):
            order = getattr(self, name).copy()
            within = np.zeros(len(order), bool)
            within[inside] = True
            order[within[order]] = inside[getattr(piece, name)]
            changed[name] = order
        return replace(self, **changed)

    def sorted(self, mesh: TriMesh, polygon: np.ndarray) -> tuple[TriMesh, np.ndarray]:
        """Sort the mesh that was given; each triangle begins with its first vertex.

        polygon : (m,) int64, of each triangle given. Returns the mesh, and the given triangle at each place, (m,).
        """
        vertices, number = taken(mesh.vertices, self.vertex), inverse(self.vertex)
        triangle = stable_order(inverse(self.polygon)[polygon])
        faces = number[taken(mesh.faces, triangle)]
        if len(self.polygon) < mesh.n_faces:
            outer = outer_first(TriMesh(vertices, faces), polygon[triangle])
            triangle, faces = triangle[outer], faces[outer]
        turn = (faces.argmin(axis=1)[:, None] + arange(3)) % 3
        return TriMesh(vertices, np.take_along_axis(faces, turn, axis=1)), triangle


def sorted_by_place(given: PolygonMesh, together: bool = True) -> tuple[PolygonMesh, Ordering]:
    """Sort faces and vertices by where they are.

    Large pieces are sorted in frames of their own, so that they are what they would be without the others. Where a
    symmetry leaves several frames, that of the whole decides if pieces that touch are one body, and this one may touch
    another; else the order of the given vertices, as it would without the others.

    given : PolygonMesh. together : bool. Returns the same surface, its polygons ``Divided``, and where its elements are
    in the one given.
    """
    divided = None
    if given.n_polygons < given.triangles.n_faces:
        divided = divided_by_shape(given.triangles, given.polygon)
        given = replace(given, triangles=divided.mesh)
    place = _places(given.triangles)
    ordering = _by_place(_at_places(given.triangles, place), given.polygon, given.n_polygons, together)
    if len(ordering.vertex) < len(place):
        ordering = _with_split_vertices(ordering, place, given)
    if divided is not None:
        given = replace(given, triangles=divided.by_order(inverse(ordering.vertex)))
    triangles, triangle = ordering.sorted(given.triangles, given.polygon)
    number = inverse(ordering.polygon)[given.polygon[triangle]]
    return replace(given, triangles=triangles, polygon=frozen(number, np.int64),
                   vertex_rank=frozen(ordering.vertex, np.int64)), ordering


def _places(mesh: TriMesh) -> np.ndarray:
    """Number the places at which vertices lie, in the order of their first vertices; (n,) int64.

    Files split vertices where textures or normals have seams, some at every corner. Those that differ by rounding only
    are at one place: moved, they may not differ. Of a dense mesh only those that do not differ at all are.
    """
    points = mesh.vertices
    if len(points) <= DENSE:
        size = float(np.ptp(points[mesh.used], axis=0).max(initial=0.0))  # others can be anywhere
        x, y, z = (ranks(column, size).astype(np.uint64) for column in points.T)
        number = x << np.uint64(40) | y << np.uint64(20) | z
    else:
        number = hashed_rows(points)
    in_order = np.sort(number)
    if not (in_order[1:] == in_order[:-1]).any():
        return arange(len(points))
    first, place = np.unique(number, return_index=True, return_inverse=True)[1:]
    return inverse(np.argsort(first))[place.reshape(-1)]


def _at_places(mesh: TriMesh, place: np.ndarray) -> TriMesh:
    """The mesh with one vertex at each place, midway between those that differ by rounding; place : (n,) int64."""
    count = int(place.max(initial=-1)) + 1
    if count == mesh.n_vertices:
        return mesh
    low, high = bounds_of_each(place, mesh.vertices, count)
    return TriMesh(low / 2 + high / 2, place[mesh.faces])  # vertices of no face may be at the largest number


def _with_split_vertices(ordering: Ordering, place: np.ndarray, given: PolygonMesh) -> Ordering:
    """The order of places, (n,), as one of vertices: those at one place follow each other as their faces do."""
    rank = inverse(ordering.polygon)[given.polygon]
    first_face = full(len(place), given.n_polygons)
    backwards = stable_order(rank)[::-1]
    first_face[given.triangles.faces[backwards]] = rank[backwards, None]  # NumPy keeps the last value of each place
    return replace(ordering, vertex=np.lexsort((first_face, inverse(ordering.vertex)[place])))


def _by_place(mesh: TriMesh, of_triangle: np.ndarray, n_polygons: int, together: bool) -> Ordering:
    """What ``sorted_by_place`` finds, of a mesh with one vertex at each place; of_triangle : (m,), the polygons."""
    ordering = Ordering.of(mesh, of_triangle, n_polygons)
    count, piece = mesh.vertex_components
    of_face = piece[mesh.faces[:, 0]]
    size = np.bincount(of_face)
    in_whole, in_given = inverse(ordering.vertex), arange(mesh.n_vertices)
    large = np.flatnonzero((size >= LEAST_PIECE * mesh.n_faces) & (size < mesh.n_faces))
    used = np.flatnonzero(mesh.used)  # what has no face is no piece
    beside = (_beside_another(mesh.vertices[used], piece[used], count, large) if together
              else np.zeros(len(large), bool))
    for chosen, by_whole in zip(large.tolist(), beside.tolist(), strict=True):
        faces = np.flatnonzero(of_face == chosen)
        part, index = mesh.submesh(faces)
        names, polygon = renumbered(of_triangle[faces])
        rank = (in_whole if by_whole else in_given)[index]
        ordering = ordering.with_piece(Ordering.of(part, polygon, len(names), rank), index, names)
    return ordering


def _beside_another(points: np.ndarray, piece: np.ndarray, count: int, chosen: np.ndarray) -> np.ndarray:
    """Whether the bounding box of each of some pieces, (k,) bool, is no farther than NEAR from that of another.

    piece : (n,) int64, of each point. chosen : (k,) int64.
    """
    if not len(chosen):
        return np.zeros(0, bool)
    low, high = bounds_of_each(piece, points, count)
    near = NEAR * box_diagonal(points)
    return np.array([((low <= high[one] + near) & (high >= low[one] - near)).all(axis=1).sum() > 1 for one in chosen],
                    bool)


def principal_axes(moments: np.ndarray, toward: np.ndarray) -> np.ndarray:
    """Find the principal axes of second moments.

    All directions across the axis of a solid of revolution, and all of a ball, are principal axes: rounding must not
    choose between them.

    Parameters
    ----------
    moments : (3, 3) float64
    toward : (k, 3) float64
        Directions that span the space. Where any axis would do, it points to the first of them that is not much shorter
        than the others, as seen along the axes there are.

    Returns
    -------
    axes : (3, 3) float64
        Unit vectors of either sign, a row each, that of the largest moment first.
    """
    values, vectors = np.linalg.eigh(moments)
    equal = np.diff(values) <= EQUAL * values[-1]
    if not equal.any():
        return vectors.T[::-1]
    axis = _across(toward, np.empty((0, 3))) if equal.all() else vectors[:, 2 if equal[0] else 0]
    beside = _across(toward, axis[None])
    pair = [beside, np.cross(axis, beside)]
    return np.array([axis, *pair] if equal[0] else [*pair, axis])


def _across(toward: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Unit vector, (3,), to the first of some directions, (k, 3), that is at least half as long across the axes."""
    for axis in axes:
        toward = toward - inner_products(toward, axis)[:, None] * axis
    length = np.linalg.norm(toward, axis=1)
    first = (length >= 0.5 * length.max()).argmax()
    return toward[first] / max(length[first], 1e-300)


def rank_by_place(points: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Sort points by their place in their own frame.

    Parameters
    ----------
    points : (n, 3) float64
    weight : (n,) float64
        Such as the area that each stands for.

    Returns
    -------
    rank : (n,) int64
        Place of each in the order, which depends on order, pose and scale as ``Ordering`` does.
    """
    position = points - weighted_sum(weight, points) / weight.sum()
    place = inner_products(position, _own_axes(position, weight, position, [lambda: weight]))
    return inverse(_order(place / max(np.abs(place).max(), 1e-300), lambda: np.zeros_like(place)))


def _in_own_frame(
    mesh: TriMesh, polygon: np.ndarray, vertex_rank: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray]:
    """Place of each vertex along the axes of the surface itself, (n, 3), and these axes, (3, 3).

    Places are from its middle, in units of the largest coordinate of a vertex with a face.
    """
    weight = mesh.face_area if mesh.area > 0 else np.ones(mesh.n_faces)  # a piece may have none
    center, has_polygons = mesh.face_centroids, len(polygon) > polygon.max(initial=-1) + 1
    if has_polygons:  # however they are divided
        weight, center = middles_of_each(polygon, center, weight, int(polygon.max()) + 1)
    middle = weighted_sum(weight, center) / weight.sum()
    used = np.flatnonzero(mesh.used)
    if vertex_rank is not None:
        used = used[stable_order(vertex_rank[used])]
    corner = np.zeros((mesh.n_vertices, 3))
    corner[used] = mesh.vertices[used] - middle

    def meeting(ends: np.ndarray) -> np.ndarray:
        """Squared number of faces or edges, of which these are the vertices, at each vertex in use."""
        number = np.bincount(ends.ravel(), minlength=mesh.n_vertices)[used]
        return number * number

    def outlines() -> np.ndarray:
        """Vertices, (e, 2), of the edges that are none within a polygon."""
        within = mesh.edges.pair_edge[polygon[mesh.edges.pairs[:, 0]] == polygon[mesh.edges.pairs[:, 1]]]
        return np.delete(mesh.edges.vertices, within, axis=0)

    counts = [lambda: meeting(mesh.faces)]
    if has_polygons:  # how they are divided counts only where they do not tell
        counts.insert(0, lambda: meeting(outlines()))
    axes = _own_axes(center - middle, weight, corner[used], counts)
    corner = inner_products(corner, axes)
    return corner / max(np.abs(corner).max(), 1e-300), axes


def _own_axes(
    position: np.ndarray, weight: np.ndarray, points: np.ndarray, point_weights: Sequence[Callable[[], np.ndarray]]
) -> np.ndarray:
    """Axes of a surface, (3, 3), a row each: the principal axes of positions, (m, 3), from their middle.

    Each points to where the farther positions are, or away from there; where both sides of the shape are alike, to
    where the points, (k, 3), have more of the first of other weights, (k,), that tells: the faces of symmetric shapes
    often differ. Where all these are alike, too, the first point that is clearly on one side decides.
    """
    axes = principal_axes(second_moments(position, weight), points)
    for axis in axes:
        lean = _lean(inner_products(position, axis), weight)
        if abs(lean) < TIE:
            height = inner_products(points, axis)
            leans = (_lean(height, point_weight()) for point_weight in point_weights)
            first = height[(np.abs(height) >= 0.5 * np.abs(height).max()).argmax()]
            lean = next((lean for lean in leans if abs(lean) >= TIE), first)
        axis *= -1.0 if lean < 0 else 1.0
    axes[[0, 2]] *= -1.0  # which end comes first is a convention
    return axes


def _lean(height: np.ndarray, weight: np.ndarray) -> float:
    """Third moment of heights, (k,), by weight, (k,), from -1, all below the middle, to 1."""
    cubes = height * height * height  # powers of NumPy take twenty times as long
    return float((weight * cubes).sum() / max((weight * np.abs(cubes)).sum(), 1e-300))


def _order(place: np.ndarray, beside: Callable[[], np.ndarray]) -> np.ndarray:
    """Sort points by their place, and points at one place by what is beside them; (n,) int64.

    place, and what ``beside`` returns : (n, 3), between -1 and 1.
    """
    cells = CELLS if len(place) <= DENSE else SMALL_CELLS
    cell = _cell(place, cells)
    order = stable_order(cell)
    tied = places_of_ties(cell[order])
    if len(tied):
        some = order[tied]
        x, y, z = (ranks(values, 1.0)[some] for values in place.T)
        fine = np.rint(place[some] * FINE).astype(np.int64)
        order[tied] = some[np.lexsort((*fine.T, _cell(beside()[some], cells), z, y, x, cell[some]))]
    return order


def _cell(place: np.ndarray, cells: int) -> np.ndarray:
    """Number of the cell of space in which each point lies, (n,) int64, along the curve of [Morton1966].

    The curve stays long in one region of space before it goes on to the next. Sorted along an axis, the first of equals
    would lie on one side of the shape always, and neighbors far apart in memory.
    """
    number = np.zeros(len(place), np.int64)
    for axis, column in enumerate(np.floor(place * cells + OFF).astype(np.int64).T + cells):
        for shift, mask in _SPREAD:
            column = (column | column << shift) & mask
        number |= column << axis
    return number
