# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours of the field on the caller's own faces: a ring to cut a part along.

The Reeb graph contracts each contour to a point of an arc; here a point of an arc, or of the surface, is
taken back to its contour.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..surface.arrays import components, renumbered, sums_by
from ..surface.corners import CornerTable
from ..surface.labels import FaceGraph, connect, straighten

STRAIGHTEN = 10  # rounds, as many as after a decomposition


@dataclass(frozen=True, eq=False)
class Contours:
    """The contours of one level within some faces; they cross s faces.

    Attributes
    ----------
    count : int
    segments : (s, 2, 3) float64
        Where each crossed face is crossed; a face that is crossed twice has two.
    face : (s,) int64
        The face of each segment.
    label : (s,) int64
        The contour of each segment, 0..count-1.
    """

    count: int
    segments: np.ndarray
    face: np.ndarray
    label: np.ndarray

    @property
    def length(self) -> np.ndarray:
        """(s,) float64, of each segment; above 0."""
        return np.linalg.norm(self.segments[:, 0] - self.segments[:, 1], axis=1) + 1e-300

    def around(self, point: np.ndarray) -> int:
        """The contour whose centroid is nearest to a (3,) point; -1 if there is none."""
        if not self.count:
            return -1
        length = self.length
        middle = self.segments.mean(axis=1)
        total = np.bincount(self.label, length, self.count)
        centroid = sums_by(self.label, length[:, None] * middle, self.count) / total[:, None]
        return int(np.linalg.norm(centroid - point, axis=1).argmin())

    def through(self, face: int) -> int:
        """The contour that crosses a face; -1 if none does."""
        found = self.label[self.face == face]
        return int(found[0]) if len(found) else -1


def contours(field: np.ndarray, level: float, table: CornerTable) -> Contours:
    """Connected components of a level set.

    Parameters
    ----------
    field : (n,) float64
        Of each vertex; nan for a vertex of no face.
    level : float
    table : CornerTable
        The faces to look at.

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
    start, end = table.vertices[table.edges[edge]].transpose(1, 0, 2)
    point = start + share[:, None] * (end - start)
    # Around a face the field changes sides an even number of times.
    edge, face = edge.reshape(-1, 2), face.reshape(-1, 2)[:, 0]
    edges_crossed, index = renumbered(edge)
    faces_crossed, of_face = renumbered(face)
    of_face = of_face + len(edges_crossed)
    count, label = components(
        len(edges_crossed) + len(faces_crossed), np.concatenate([index[:, 0], index[:, 1]]), np.tile(of_face, 2))
    return Contours(count, point.reshape(-1, 2, 3), face, label[of_face])


def contour_sides(
    graph: FaceGraph,
    inside: np.ndarray,
    above: np.ndarray,
    crossed: np.ndarray,
) -> np.ndarray | None:
    """The two sides of a part that is cut along one contour.

    Where one contour does not part it - around a handle - the part is cut along all contours between what
    lies above and below this one.

    Parameters
    ----------
    graph : FaceGraph
        Of p faces.
    inside : (p,) bool
        Faces of the part.
    above : (p,) bool
        Faces above the contour's level, by their middle.
    crossed : (p,) bool
        Faces that the contour crosses.

    Returns
    -------
    side : (p,) bool or None
        The part's faces above; None if one side has none. The line between the sides is straightened.
    """
    ids = np.flatnonzero(inside)
    place = np.full(graph.n_faces, -1)
    place[ids] = np.arange(len(ids))
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
        assert side is not None  # nothing above touches anything below any more
    label = connect(part, straighten(part, side.astype(np.int64), STRAIGHTEN))
    if label.all() or not label.any():
        return None
    result = np.zeros(graph.n_faces, bool)
    result[ids] = label == 1
    return result


def _sides(part, above, cut, closed) -> np.ndarray | None:
    """Faces on the upper side of a cut when some pairs no longer touch; None if both sides still do."""
    count, piece = components(part.n_faces, *part.pairs[~closed].T)
    ends = part.pairs[cut]
    upper = np.zeros(count, bool)
    lower = np.zeros(count, bool)
    upper[piece[ends[above[ends]]]] = True
    lower[piece[ends[~above[ends]]]] = True
    return None if (upper & lower).any() else upper[piece]
