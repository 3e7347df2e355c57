# SPDX-License-Identifier: GPL-3.0-or-later
"""What hangs together by the places of corners, and what of one such piece is nearest to another one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import bounds_of_each, place_among, sums_by
from ..arrays.int64 import arange
from ..arrays.vectors import inner_products, lengths, middles_of_each, row_products, second_moments, unit
from .polygons import PolygonMesh
from .triangles import TriMesh, vertex_components

# What the direction of normals counts where the nearest polygon is sought, in diameters of the piece that has it.
TURN = 0.03
MOST_POINTS = 100_000  # scattered on all of them, at most
FULL = 0.75  # share of what is around a solid above which it fills it


@dataclass(frozen=True, eq=False)
class Pieces:
    """Pieces of a mesh; corners at one place are one, whether they are one vertex or several.

    Attributes
    ----------
    of_polygon : (p,) int64
        Piece of each polygon, 0..count-1.
    place : (n,) int64
        Place of each vertex, 0..q-1.
    first : (q,) int64
        First vertex at each place, of those that a polygon has if there are any.
    of_place : (q,) int64
        Piece of each place; one of its own for a vertex of no polygon.
    area, volume : (count,) float64
        As ``measured`` has them.
    middle, low, high : (count, 3) float64
        Middle of the surface, and corners of the box around it.
    """

    of_polygon: np.ndarray
    place: np.ndarray
    first: np.ndarray
    of_place: np.ndarray
    area: np.ndarray
    volume: np.ndarray
    middle: np.ndarray
    low: np.ndarray
    high: np.ndarray

    @classmethod
    def of(cls, given: PolygonMesh, number: np.ndarray) -> Pieces:
        """The pieces of a mesh; number : (n,) of int, equal for vertices at one place."""
        mesh = given.triangles
        _, first, place = np.unique(number, return_index=True, return_inverse=True)
        place, used = place.reshape(-1), np.flatnonzero(mesh.used)[::-1]
        first[place[used]] = used  # NumPy keeps the last: the first
        count, of_place = vertex_components(place[mesh.faces], len(first))
        piece = of_place[place[mesh.faces[:, 0]]]
        of_polygon = np.empty(given.n_polygons, np.int64)
        of_polygon[given.polygon] = piece
        area, middle, volume = measured(mesh, piece, count)
        low, high = bounds_of_each(np.repeat(piece, 3), mesh.corners.reshape(-1, 3), count)
        return cls(of_polygon, place, first, of_place, area, volume, middle, low, high)

    @property
    def count(self) -> int:
        """Number of pieces."""
        return len(self.area)

    @property
    def diameter(self) -> np.ndarray:
        """Diagonal of the box around each piece, (count,) float64; 0 of one without polygons."""
        return lengths(np.where(np.isfinite(self.low), self.high, 0.0) - np.where(np.isfinite(self.low), self.low, 0.0))


def pieces_by_place(mesh: TriMesh, place: np.ndarray) -> tuple[int, np.ndarray]:
    """How many pieces there are, and the piece of each triangle, (m,) int64; corners at one place are one.

    place : (n,) of int, equal for vertices at one place.
    """
    _, number = np.unique(place, return_inverse=True)
    corner = number.reshape(-1)[mesh.faces]
    count, piece = vertex_components(corner, int(number.max()) + 1)
    return count, piece[corner[:, 0]]


def measured(mesh: TriMesh, piece: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Measure pieces; piece : (m,) int64, of each triangle.

    Returns the area of each, (count,), its middle, (count, 3), and its volume as seen from there, (count,): below 0
    where it is inside out.
    """
    area, middle = middles_of_each(piece, mesh.face_centroids, mesh.face_area, count)
    volume = np.bincount(piece, row_products(mesh.area_normals, mesh.face_centroids - middle[piece]), count)
    return area, middle, volume


def fills_its_box(points: np.ndarray, volume: float) -> bool:
    """Whether a piece of some volume fills the box along its principal axes, as a board; points : (k, 3), of it."""
    _, axes = np.linalg.eigh(second_moments(points - points.mean(axis=0), np.ones(len(points))))
    return bool(volume > FULL * np.ptp(inner_products(points, axes.T), axis=0).prod())


def measured_polygons(given: PolygonMesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Area of each polygon, (p,), its middle, (p, 3), and its unit normal, (p, 3)."""
    mesh, polygon, count = given.triangles, given.polygon, given.n_polygons
    area, middle = middles_of_each(polygon, mesh.face_centroids, mesh.face_area, count)
    return area, middle, unit(sums_by(polygon, mesh.area_normals, count))


def solid_polygons(given: PolygonMesh) -> np.ndarray:
    """Which polygons have an area, but for rounding, (p,) bool: the others have the part of a neighbor."""
    is_solid = np.zeros(given.n_polygons, bool)
    is_solid[given.polygon[given.triangles.has_area]] = True
    return is_solid


@dataclass(frozen=True, eq=False)
class _Frames:
    """Coordinates in which bases lie one beside the other, each with the pieces that have it.

    Attributes
    ----------
    is_base, has_base : (count,) bool
    number : (count,) int64
        Of each such piece, that of its base, 0..k-1.
    middle, diameter : (k, 3), (k,) float64
        Of each base.
    """

    is_base: np.ndarray
    has_base: np.ndarray
    number: np.ndarray
    middle: np.ndarray
    diameter: np.ndarray

    @classmethod
    def of(cls, pieces: Pieces, base: np.ndarray) -> _Frames:
        """base : (count,) int64, of each piece; -1 for none."""
        is_base = np.zeros(pieces.count, bool)
        is_base[base[base >= 0]] = True
        bases = np.flatnonzero(is_base)
        number = place_among(bases, pieces.count)[np.where(base >= 0, base, arange(pieces.count))]
        return cls(is_base, base >= 0, number, pieces.middle[bases], pieces.diameter[bases])

    def point(self, position: np.ndarray, piece: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """Coordinates of points, (k, 3), of some pieces, (k,) int64, with unit normals, (k, 3): (k, 6) float64."""
        k = self.number[piece]
        place = (position - self.middle[k]) / self.diameter[k][:, None] + 9.0 * k[:, None]
        return np.concatenate([place, TURN * normal], axis=1)


def nearest_polygons(given: PolygonMesh, pieces: Pieces, base: np.ndarray, n_points: int) -> np.ndarray:
    """Find the nearest polygons on other pieces, which look the other way and have an area.

    Parameters
    ----------
    given : PolygonMesh
        p polygons.
    pieces : Pieces
    base : (count,) int64
        The piece on which those of each are sought; -1 for none.
    n_points : int
        How many points are scattered on each such piece to find its polygons by, beside their middles: none where it
        has as many and as small ones as what is near it.

    Returns
    -------
    polygon : (p,) int64
        For each polygon of a piece with a base, one of the base; of all others, their own.
    """
    mesh, piece, frames = given.triangles, pieces.of_polygon, _Frames.of(pieces, base)
    _, middle, normal = measured_polygons(given)
    own = np.flatnonzero(frames.is_base[piece] & solid_polygons(given))
    face = np.flatnonzero(frames.is_base[piece[given.polygon]])
    weight = mesh.face_area[face] / pieces.area[piece[given.polygon[face]]]
    face, position = scattered(mesh, face, weight, min(n_points * len(frames.diameter), MOST_POINTS))
    its = np.concatenate([own, given.polygon[face]])
    there = frames.point(np.concatenate([middle[own], position]), piece[its],
                         np.concatenate([normal[own], unit(mesh.area_normals[face])]))
    wanted = np.flatnonzero(frames.has_base[piece])
    found = arange(given.n_polygons)
    found[wanted] = its[_nearest(there, frames.point(middle[wanted], piece[wanted], -normal[wanted]))]
    return found


def nearest_vertices(given: PolygonMesh, pieces: Pieces, base: np.ndarray) -> np.ndarray:
    """For each vertex of a piece with a base the nearest one of that, and of all others their own, (n,) int64.

    base : (count,) int64, as for ``nearest_polygons``.
    """
    vertices, piece, frames = given.triangles.vertices, pieces.of_place[pieces.place], _Frames.of(pieces, base)
    its, wanted = pieces.first[frames.is_base[pieces.of_place]], np.flatnonzero(frames.has_base[piece])
    there, here = (frames.point(vertices[some], piece[some], np.zeros((len(some), 3))) for some in (its, wanted))
    found = arange(len(vertices))
    found[wanted] = its[_nearest(there, here)]
    return found


def scattered(mesh: TriMesh, face: np.ndarray, weight: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points at equal steps of weight on some faces; face : (k,) int64. weight : (k,) float64.

    Returns the face of each point, (count,) int64, and its position, (count, 3).
    """
    total, step = np.cumsum(weight), arange(count) + 0.5
    face = face[np.searchsorted(total, step / count * total[-1]).clip(max=len(face) - 1)]
    # Within their triangles they are spread by multiples of the two numbers that fill a square most evenly.
    a, b = (step * 0.7548776662466927) % 1, (step * 0.5698402909980532) % 1
    a, b = np.where(a + b > 1, (1 - a, 1 - b), (a, b))[:, :, None]
    corner = mesh.corners[face]
    return face, corner[:, 0] + a * (corner[:, 1] - corner[:, 0]) + b * (corner[:, 2] - corner[:, 0])


def _nearest(point: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Index of the nearest point of each, (k,) int64; point : (m, d). wanted : (k, d)."""
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    return nearest(search_tree(point), wanted)[1]
