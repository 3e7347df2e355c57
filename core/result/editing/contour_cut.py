# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours of the field on the caller's own faces, to cut a part along one of them.

The Reeb graph contracts each contour to a point of an arc. This module finds the contour that belongs to a point of an
arc or of the surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import place_among, renumbered
from ...arrays.vectors import middles_of_each
from ...mesh.corners import CornerTable
from ...mesh.face_graph import FaceGraph, connect, straighten
from ...parameters import Parameters

STRAIGHTEN = Parameters.smoothing  # rounds of ``straighten``, as many as cuts get by default


@dataclass(frozen=True, eq=False)
class Contours:
    """The contours of one level on some faces, as s segments.

    A face that the level crosses has one segment, a polygon that it crosses twice has two.

    Attributes
    ----------
    count : int
        Number of contours.
    segments : (s, 2, 3) float64
        Ends of each segment, in the unit of the vertices.
    face : (s,) int64
        Face in which each segment lies.
    label : (s,) int64
        Contour of each segment, 0..count-1.
    edge : (s, 2, 2) int64
        The two vertices of the edge on which each end lies.
    share : (s, 2) float64
        Share of that edge's length at which it lies, from the first vertex, 0..1.
    """

    count: int
    segments: np.ndarray
    face: np.ndarray
    label: np.ndarray
    edge: np.ndarray
    share: np.ndarray

    def moved(self, vertices: np.ndarray) -> np.ndarray:
        """The segments, (s, 2, 3) float64, where the vertices of the mesh are elsewhere, (n, 3) float64."""
        return _between(vertices, self.edge, self.share)

    @property
    def length(self) -> np.ndarray:
        """(s,) float64, length of each segment, above 0 so that it can weigh, in the unit of the vertices."""
        return np.linalg.norm(self.segments[:, 0] - self.segments[:, 1], axis=1) + 1e-300

    def around(self, point: np.ndarray) -> int:
        """Find the contour whose centroid is nearest to a point.

        point : (3,) float64. Returns the contour's label; -1 if there is no contour.
        """
        if not self.count:
            return -1
        _, centroid = middles_of_each(self.label, self.segments.mean(axis=1), self.length, self.count)
        return int(np.linalg.norm(centroid - point, axis=1).argmin())

    def through(self, face: int) -> int:
        """Find the contour that crosses a face.

        face : int. Returns the contour's label, that of the first segment of the face; -1 if no contour crosses it.
        """
        found = self.label[self.face == face]
        return int(found[0]) if len(found) else -1


def contours(field: np.ndarray, level: float, table: CornerTable) -> Contours:
    """Find the connected components of a level set.

    Parameters
    ----------
    field : (n,) float64
        Value at each vertex; nan for a vertex without a face.
    level : float
        Value of the level set, in the unit of ``field``. A vertex whose value is exactly the level counts as above it.
    table : CornerTable
        The faces that are searched.

    Returns
    -------
    contours : Contours

    Notes
    -----
    O(corners of the table).
    """
    low, high = field[table.edges].T
    crossed = (low >= level) != (high >= level)
    on = np.flatnonzero(crossed[table.corner_edge])
    edge, face = table.corner_edge[on], table.corner_face[on]
    share = (level - low[edge]) / (high[edge] - low[edge])
    ends, share = table.edges[edge].reshape(-1, 2, 2), share.reshape(-1, 2)
    # Along the border of a face the field crosses the level an even number of times.
    edge, face = edge.reshape(-1, 2), face.reshape(-1, 2)[:, 0]
    edges_crossed, index = renumbered(edge)
    faces_crossed, of_face = renumbered(face)
    of_face = of_face + len(edges_crossed)
    count, label = components(
        len(edges_crossed) + len(faces_crossed), np.concatenate([index[:, 0], index[:, 1]]), np.tile(of_face, 2))
    return Contours(count, _between(table.vertices, ends, share), face, label[of_face], ends, share)


def _between(vertices: np.ndarray, edge: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Points on edges, (s, 2, 3); edge : (s, 2, 2), their vertices; share : (s, 2), from the first vertex."""
    start, end = vertices[edge[..., 0]], vertices[edge[..., 1]]
    return start + share[..., None] * (end - start)


def contour_sides(
    graph: FaceGraph,
    inside: np.ndarray,
    above: np.ndarray,
    crossed: np.ndarray,
) -> np.ndarray | None:
    """Cut a part in two along one contour.

    Of a part of several pieces, which share no edge, the contour cuts the one that it lies on: the others are on no
    upper side.

    Around a handle, one contour does not separate the part into two sides. The part is then cut along every contour of
    the level, and its upper side is the connected faces above the level that touch the given contour.

    Parameters
    ----------
    graph : FaceGraph
        p faces.
    inside : (p,) bool
        Faces of the part.
    above : (p,) bool
        Faces whose mean value lies above the contour's level.
    crossed : (p,) bool
        Faces that the contour crosses.

    Returns
    -------
    side : (p,) bool or None
        Faces of the part on the upper side of the cut, which is straightened unless one side would vanish; None if one
        side has no face.
    """
    piece = graph.regions(inside)[1]
    inside = inside & np.isin(piece, piece[inside & crossed])
    ids = np.flatnonzero(inside)
    place = place_among(ids, graph.n_faces)
    within = inside[graph.pairs].all(axis=1)
    part = FaceGraph(len(ids), place[graph.pairs[within]], graph.length[within], graph.area[ids])
    above, crossed = above[ids], crossed[ids]
    between = above[part.pairs[:, 0]] != above[part.pairs[:, 1]]
    cut = between & crossed[part.pairs].any(axis=1)
    if not cut.any():
        return None
    side = _sides(part, above, cut, cut)
    if side is None:
        side = _sides(part, above, cut, between)
        assert side is not None  # no face above the level is joined with one below it
    for label in (straighten(part, side.astype(np.int64), STRAIGHTEN), side.astype(np.int64)):
        label = connect(part, label)
        if label.any() and not label.all():
            break
    else:
        return None
    result = np.zeros(graph.n_faces, bool)
    result[ids] = label == 1
    return result


def _sides(part: FaceGraph, above: np.ndarray, cut: np.ndarray, closed: np.ndarray) -> np.ndarray | None:
    """Faces on the upper side of a cut, (p,) bool, or None if both sides of the cut are still connected.

    cut, closed : (e,) bool, pairs of faces across the cut, and pairs across which faces do not count as connected.
    """
    count, piece = components(part.n_faces, *part.pairs[~closed].T)
    ends = part.pairs[cut]
    upper = np.zeros(count, bool)
    lower = np.zeros(count, bool)
    upper[piece[ends[above[ends]]]] = True
    lower[piece[ends[~above[ends]]]] = True
    return None if (upper & lower).any() else upper[piece]
