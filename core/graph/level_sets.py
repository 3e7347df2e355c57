# SPDX-License-Identifier: GPL-3.0-or-later
"""Piecewise linear level sets: the surface cut into slabs; their pieces, the slab pieces, and contours.

An element is the part of one triangle in one slab. Elements stay connected also in a slab that is narrower than the
edges of the mesh, where the vertices of a slab would not (docs/method.md, section 3). One pass of connected components
labels the slab pieces of all slabs at once, another pass the contours of all levels.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import begins_run, ends_run, expanded, sums_by
from ..arrays.int64 import arange, cumsum
from ..arrays.vectors import lengths
from ..mesh.triangles import TriMesh, vote_weights
from .bridged_levels import FaceBridges, joined_by_faces


@dataclass(frozen=True, eq=False)
class LevelSets:
    """A surface cut at K levels of a field into K + 1 slabs.

    Slab s lies between level s - 1 and level s. A vertex exactly on a level counts as above this level, so that no case
    is degenerate. An element is the part of one face in one slab, a slab piece a connected component of a slab, a
    segment the line along which a level crosses a face, a contour a connected component of a level set. With E
    elements, P slab pieces, S segments and C contours:

    Attributes
    ----------
    mesh : TriMesh
        n vertices, m faces.
    values : (n,) float64
        The field at each vertex.
    levels : (K,) float64
        Values of the field at which the surface is cut, strictly rising.
    vertex_slab : (n,) int64
        Slab of each vertex, 0..K.
    element_face, element_slab, element_piece : (E,) int64
        Face, slab and slab piece of each element; faces in order, the slabs of each face rising.
    piece_slab : (P,) int64
        Slab of each slab piece.
    segment_face, segment_level, segment_contour : (S,) int64
        Face, level and contour of each segment; faces in order, the levels of each face rising.
    contour_level : (C,) int64
        Level of each contour, 0..K-1.
    contour_pieces : (C, 2) int64
        Slab piece below and above each contour.
    """

    mesh: TriMesh
    values: np.ndarray
    levels: np.ndarray
    vertex_slab: np.ndarray
    element_face: np.ndarray
    element_slab: np.ndarray
    element_piece: np.ndarray
    piece_slab: np.ndarray
    segment_face: np.ndarray
    segment_level: np.ndarray
    segment_contour: np.ndarray
    contour_level: np.ndarray
    contour_pieces: np.ndarray

    @property
    def n_pieces(self) -> int:
        """Number of slab pieces, P."""
        return len(self.piece_slab)

    @property
    def n_contours(self) -> int:
        """Number of contours, C."""
        return len(self.contour_level)

    @cached_property
    def n_loops(self) -> int:
        """Number of independent loops of the graph whose nodes are the slab pieces and whose arcs are the contours."""
        count, _ = components(self.n_pieces, *self.contour_pieces.T)
        return self.n_contours - self.n_pieces + count

    @cached_property
    def face_first_slab(self) -> np.ndarray:
        """(m,) int64, lowest slab of each face's elements."""
        return self.vertex_slab[self.mesh.faces].min(axis=1)

    @cached_property
    def face_first_element(self) -> np.ndarray:
        """(m,) int64, first element of each face."""
        return np.searchsorted(self.element_face, arange(self.mesh.n_faces))

    @cached_property
    def vertex_piece(self) -> np.ndarray:
        """(n,) int64, slab piece in which each vertex lies."""
        corner_slab = self.vertex_slab[self.mesh.faces]
        element = (self.face_first_element - self.face_first_slab)[:, None] + corner_slab
        piece = np.empty(self.mesh.n_vertices, np.int64)
        piece[self.mesh.faces] = self.element_piece[element]
        return piece

    @cached_property
    def element_area(self) -> np.ndarray:
        """(E,) float64, exact area of each element, in squared units of the vertices."""
        below = np.zeros(len(self.element_face))  # share of the face below the element's top
        top = np.append(self.levels, np.inf)[self.element_slab]
        last = ends_run(self.element_face)
        below[last] = 1.0
        inner = ~last
        corners = np.sort(self.values[self.mesh.faces], axis=1).T
        low, middle, high = (corner.take(self.element_face[inner]) for corner in corners)
        below[inner] = _share_below(low, middle, high, top[inner])
        share = below - np.where(begins_run(self.element_face), 0.0, np.append(0.0, below[:-1]))
        return np.maximum(share, 0.0) * self.mesh.face_area[self.element_face]

    @property
    def element_weight(self) -> np.ndarray:
        """(E,) float64, weight of the vote of each element: its area; elements without one vote after all others."""
        return vote_weights(self.element_area, self.mesh.area)

    @cached_property
    def piece_area(self) -> np.ndarray:
        """(P,) float64, area of each slab piece, in squared units of the vertices."""
        return np.bincount(self.element_piece, self.element_area, self.n_pieces)

    @cached_property
    def segment_edges(self) -> np.ndarray:
        """(S, 2) int64, the two edges of the mesh on which each segment ends."""
        first, second, third = (slab.take(self.segment_face) > self.segment_level
                                for slab in self.vertex_slab[self.mesh.faces].T)
        alone = np.where(first == second, 2, first == third)  # the corner on a side of its own
        # One column at a time, here and below: of thousands of faces through all levels there are millions of segments.
        after = 3 * self.segment_face + alone
        before = after - np.where(alone == 0, -2, 1)
        return np.stack([self.mesh.edges.face_edges.ravel().take(edge) for edge in (after, before)]).T

    def crossing(self, edge: np.ndarray, level: np.ndarray) -> np.ndarray:
        """Find where levels cross edges.

        Parameters
        ----------
        edge : array of int64, any shape
            Edges of ``mesh.edges``.
        level : array of int64, broadcastable to ``edge``
            Index of the level that crosses each edge.

        Returns
        -------
        share : float64, shape of ``edge``
            Position of the crossing, 0..1 from the first vertex of the edge to the second.
        """
        low, high = (self.values.take(end.take(edge)) for end in self.mesh.edges.vertices.T)
        return (self.levels.take(level) - low) / (high - low)

    @cached_property
    def segment_points(self) -> np.ndarray:
        """(S, 2, 3) float64, ends of each segment on its ``segment_edges``, in units of the vertices."""
        points = np.empty((2, 3, len(self.segment_face)))
        for edge, at in zip(self.segment_edges.T, points, strict=True):
            share = self.crossing(edge, self.segment_level)
            start, end = (vertex.take(edge) for vertex in self.mesh.edges.vertices.T)
            for axis, coordinate in zip(self.mesh.vertices.T, at, strict=True):
                low = axis.take(start)
                coordinate[:] = (axis.take(end) - low) * share + low
        return points.transpose(2, 0, 1)

    @cached_property
    def segment_length(self) -> np.ndarray:
        """(S,) float64, length of each segment, in units of the vertices."""
        return lengths(self.segment_points[:, 1] - self.segment_points[:, 0])

    @cached_property
    def segment_middle(self) -> np.ndarray:
        """(S, 3) float64, middle of each segment, in units of the vertices."""
        return (self.segment_points[:, 0] + self.segment_points[:, 1]) / 2

    @cached_property
    def contour_length(self) -> np.ndarray:
        """(C,) float64, length of each contour, in units of the vertices."""
        return sums_by(self.segment_contour, self.segment_length, self.n_contours)

    @cached_property
    def contour_center(self) -> np.ndarray:
        """(C, 3) float64, centroid of each contour, in units of the vertices."""
        return self._contour_mean(self.segment_middle)

    @cached_property
    def contour_radius(self) -> np.ndarray:
        """(C,) float64, mean distance of each contour from its centroid, in units of the vertices."""
        center = self.contour_center.T.take(self.segment_contour, axis=1).T
        return self._contour_mean(lengths(self.segment_middle - center))

    def _contour_mean(self, of_segments: np.ndarray) -> np.ndarray:
        """Mean over each contour, (C,) or (C, k), of a value per segment, (S,) or (S, k), weighted by length."""
        # All segments of a contour through one vertex have length 0; with the addition they have equal weights.
        weight = self.segment_length + 1e-9 * np.sqrt(self.mesh.area)
        total = np.bincount(self.segment_contour, weight, self.n_contours)
        # The transpose lets one line serve (S,) and (S, k).
        return (sums_by(self.segment_contour, (weight * of_segments.T).T, self.n_contours).T / total).T


def uniform_levels(n_slabs: int) -> np.ndarray:
    """Divide 0..1 into equally high slabs.

    n_slabs : int, 1 or more. Returns the levels between the slabs, (n_slabs - 1,) float64, rising.
    """
    return arange(1, n_slabs) / n_slabs


def cut_at_levels(
    mesh: TriMesh, values: np.ndarray, levels: np.ndarray, bridges: np.ndarray | None = None
) -> LevelSets:
    """Cut a surface at levels of a field that is linear on every triangle.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, m faces.
    values : (n,) float64
        The field at each vertex.
    levels : (K,) float64
        Values of the field at which the surface is cut, strictly rising.
    bridges : (l, 2) int64, optional
        Faces of different loose parts across which level sets run on.

    Returns
    -------
    sets : LevelSets

    Notes
    -----
    Time and memory grow with faces + crossings of faces and levels.
    """
    slab = np.searchsorted(levels, values, side="right")
    a, b, c = (slab.take(corner) for corner in mesh.faces.T)
    lowest, highest = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    n_levels = highest - lowest  # of each face, which has one element more
    element_face, element_slab = expanded(lowest, n_levels + 1)
    segment_face, segment_level = expanded(lowest, n_levels)
    # What to add to a slab to get the element of a face there, and to a level to get its segment.
    segment_base = cumsum(n_levels) - n_levels - lowest
    element_base = segment_base + arange(mesh.n_faces)
    ends = [slab.take(end.take(mesh.edges.pair_edge)) for end in mesh.edges.vertices.T]
    low, across = np.minimum(*ends), np.abs(ends[0] - ends[1])
    n_pieces, element_piece = _joined(mesh.edges.pairs, low, across + 1, element_base, len(element_face))
    n_contours, segment_contour = _joined(mesh.edges.pairs, low, across, segment_base, len(segment_face))
    lower = element_base[segment_face] + segment_level
    contour_pieces = np.empty((n_contours, 2), np.int64)
    contour_pieces[segment_contour, 0] = element_piece[lower]
    contour_pieces[segment_contour, 1] = element_piece[lower + 1]
    if bridges is not None and len(bridges):
        loose_part = mesh.face_components[1]
        links = _links_of(bridges, loose_part, lowest, highest, element_base)
        of_piece = np.empty(n_pieces, np.int64)
        of_piece[element_piece] = loose_part[element_face]
        piece, contour, contour_pieces = _linked(links, element_piece, of_piece, contour_pieces)
        element_piece, segment_contour = piece[element_piece], contour[segment_contour]
    piece_slab = np.empty(int(element_piece.max()) + 1, np.int64)
    piece_slab[element_piece] = element_slab
    contour_level = np.empty(len(contour_pieces), np.int64)
    contour_level[segment_contour] = segment_level
    return LevelSets(mesh, values, levels, slab, element_face, element_slab, element_piece,
                     piece_slab, segment_face, segment_level, segment_contour, contour_level,
                     contour_pieces)


def _joined(
    pairs: np.ndarray, low: np.ndarray, count: np.ndarray, base: np.ndarray, total: int
) -> tuple[int, np.ndarray]:
    """How many connected sets of elements, or of segments, there are, and that of each, (total,) int64.

    pairs : (p, 2), faces that share an edge. low, count : (p,), the lowest slab, or level, that meets this edge, and
    how many do. base : (m,), of each face, what is to be added to a slab or level to get its element or segment there.
    """
    pair, at = expanded(low, count)
    return components(total, base[pairs[pair, 0]] + at, base[pairs[pair, 1]] + at)


def _links_of(
    bridges: np.ndarray, loose_part: np.ndarray, lowest: np.ndarray, highest: np.ndarray, element_base: np.ndarray
) -> FaceBridges:
    """The elements that bridges between faces, (l, 2), link.

    loose_part, lowest, highest, element_base : (m,), of each face, its lowest and highest slab, and what is to be added
    to a slab to get its element there.
    """
    swap = loose_part[bridges[:, 0]] > loose_part[bridges[:, 1]]
    bridges = np.where(swap[:, None], bridges[:, ::-1], bridges)
    low, high = lowest[bridges].max(axis=1), highest[bridges].min(axis=1)
    meet = low <= high
    return FaceBridges(element_base[bridges[meet]] + low[meet, None], (high - low + 1)[meet])


def _linked(
    links: FaceBridges, element_piece: np.ndarray, loose_part: np.ndarray, contour_pieces: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """New number of each slab piece, (P,), and of each contour, (C,), where links join them; the table of the latter.

    element_piece : (E,). loose_part : (P,). contour_pieces : (C, 2), slab piece below and above each contour, in which
    form the last array is returned with the new numbers.
    """
    pieces, contours = joined_by_faces(links, element_piece, contour_pieces, loose_part)
    piece = components(len(loose_part), *pieces.T)[1]
    n_contours, contour = components(len(contour_pieces), *contours.T)
    joined = np.empty((n_contours, 2), np.int64)
    joined[contour] = piece[contour_pieces]
    return piece, contour, joined


def _share_below(low: np.ndarray, middle: np.ndarray, high: np.ndarray, level: np.ndarray) -> np.ndarray:
    """Share of each triangle's area, (r,), on which the linear field is below a level.

    low, middle, high : (r,), the field at the corners. level : (r,), of each triangle: above its lowest corner, and not
    above its highest.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        rising = (level - low) ** 2 / ((middle - low) * (high - low))
        falling = 1.0 - (high - level) ** 2 / ((high - low) * (high - middle))
    return np.where(level <= middle, rising, falling)
