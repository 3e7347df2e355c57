# SPDX-License-Identifier: GPL-3.0-or-later
"""Straight lines over chains of triangles that are unfolded into a plane: what a vertex sees of the surface.

Where triangles are needles, as on the wall of a cylinder with many sides, edges and lines across two triangles leave a
vertex in few directions: a path between these was up to 1.4 times too long, and 7 times on a coarse copy. What a
vertex sees through an edge is a window [Mitchell1987]; windows are followed here as long as they are wide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import taken
from ..arrays.ties import TIE
from ..arrays.vectors import cross_in_plane, lengths, row_products
from ..mesh.triangles import ON_A_LINE, TriMesh

WIDE = 0.5  # cosine of 60 degrees: the angle up to which directions of paths are near enough to each other
NEEDLE = 4.0  # ratio of a triangle's longest side to its height above that from which on it is one
CHAIN = 12  # upper bound of the number of triangles in a chain


@dataclass(frozen=True, eq=False)
class _Windows:
    """What vertices see through edges, in planes into which the triangles between are unfolded, the vertex at 0.

    Attributes
    ----------
    source : (w,) int64
        The vertex that looks.
    side : (w,) int64
        Side of the triangle behind the edge: 3 times the face, plus the corner where the side begins;
        -1 where there is none.
    ends : (w, 2) int64
        Vertices at the right and the left end of the edge.
    right, left : (w, 2) float64
        Places of these ends.
    from_, to : (w, 2) float64
        Places through which the right and the left limit of the window run.
    """

    source: np.ndarray
    side: np.ndarray
    ends: np.ndarray
    right: np.ndarray
    left: np.ndarray
    from_: np.ndarray
    to: np.ndarray

    def chosen(self, which: np.ndarray) -> _Windows:
        """Those of a mask."""
        return _Windows(*(getattr(self, name)[which] for name in self.__dataclass_fields__))

    def joined(self, other: _Windows) -> _Windows:
        """These and others."""
        return _Windows(*(np.concatenate([getattr(self, name), getattr(other, name)])
                          for name in self.__dataclass_fields__))


def lines_in_sight(mesh: TriMesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Straight lines across more than one edge, in directions that would be far from those of other paths.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, m faces.

    Returns
    -------
    source, target : (k,) int64
        Vertices, not next to each other.
    length : (k,) float64
        Of the line between them, in the unit of the vertices.

    Notes
    -----
    Windows of a vertex do not overlap, and all are wide: O(m) of them in each of at most CHAIN steps.
    """
    across = mesh.edges.opposite_sides(mesh.edges.n_faces[mesh.edges.pair_edge] == 2)
    windows = _first_windows(mesh, across)
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0))]
    for step in range(CHAIN):
        if not len(windows.source):
            break
        corner, place = _behind(mesh, windows)
        # Lines along a limit count, despite rounding: what lies there is on one with the vertex that limits the window.
        least = -TIE * lengths(place)
        inside = ((cross_in_plane(windows.from_, place) >= least * lengths(windows.from_))
                  & (cross_in_plane(place, windows.to) >= least * lengths(windows.to)))
        if step:  # the first lines cross one edge
            found.append((windows.source[inside], corner[inside], lengths(place[inside])))
        windows = _next_windows(mesh, across, windows, corner, place)
    source, target, length = (np.concatenate(column) for column in zip(*found, strict=True))
    return source, target, length


def _first_windows(mesh: TriMesh, across: np.ndarray) -> _Windows:
    """What each vertex sees through the opposite sides of its needles.

    across : (3 m,) int64, the side of the other face at each side of a face; -1 where an edge has not two faces.
    """
    source, begin, end = (np.roll(mesh.faces, -k, axis=1).ravel() for k in range(3))
    origin = taken(mesh.vertices, source)
    right, left = (taken(mesh.vertices, to) - origin for to in (begin, end))
    far, near = lengths(left), lengths(right)
    safe = np.where(near > 0, near, 1.0)
    along = row_products(left, right) / safe
    height = lengths(left - (along / safe)[:, None] * right)  # of squares, a difference of 1e-16 would leave 1e-8
    right, left = np.stack([near, np.zeros_like(near)], axis=1), np.stack([along, height], axis=1)
    longest = np.repeat(mesh.edge_length[mesh.edges.face_edges].max(axis=1), 3)
    needle = (height > ON_A_LINE * far) & (longest * longest >= (1 - TIE) * NEEDLE * near * height)
    side = np.where(needle, across.reshape(-1, 3)[:, [1, 2, 0]].ravel(), -1)
    return _open(_Windows(source, side, np.stack([begin, end], axis=1), right, left, right, left))


def _open(windows: _Windows, among: np.ndarray | bool = True) -> _Windows:
    """Those of a mask that are wide and have a triangle behind them."""
    near, far = np.sort([lengths(windows.from_), lengths(windows.to)], axis=0)
    wide = row_products(windows.from_, windows.to) < (WIDE - TIE) * near * far
    # A limit through a corner at the place of the vertex itself has, but for rounding, no direction.
    return windows.chosen(wide & (near > ON_A_LINE * far) & (windows.side >= 0) & among)


def _behind(mesh: TriMesh, windows: _Windows) -> tuple[np.ndarray, np.ndarray]:
    """The far corner of the triangle behind each edge, (w,) int64, and its place, (w, 2)."""
    face, first = np.divmod(windows.side, 3)
    corner = mesh.faces[face, (first + 2) % 3]
    start, end = (taken(mesh.vertices, place) for place in windows.ends.T)
    edge = end - start
    length = lengths(edge)
    safe = np.where(length > 0, length, 1.0)[:, None]
    offset = taken(mesh.vertices, corner) - start
    along = row_products(offset, edge / safe)[:, None]
    away = lengths(offset - along * edge / safe)[:, None]
    x, y = ((windows.left - windows.right) / safe).T
    return corner, windows.right + along * np.stack([x, y], axis=1) + away * np.stack([y, -x], axis=1)


def _next_windows(
    mesh: TriMesh, across: np.ndarray, windows: _Windows, corner: np.ndarray, place: np.ndarray
) -> _Windows:
    """What is seen through the two other sides of the triangles behind; corner and place are their far corners."""
    face, first = np.divmod(windows.side, 3)
    ahead = mesh.faces[face, first] == windows.ends[:, 0]  # whether the side begins at its right end
    to_right, to_left = (across[3 * face + (first + np.where(ahead, a, b)) % 3] for a, b in ((2, 1), (1, 2)))
    # Where the far corner is.
    right_of, left_of = cross_in_plane(windows.from_, place) <= 0, cross_in_plane(place, windows.to) <= 0
    by_right = _Windows(windows.source, to_right, np.stack([windows.ends[:, 0], corner], axis=1), windows.right, place,
                        windows.from_, np.where(left_of[:, None], windows.to, place))
    by_left = _Windows(windows.source, to_left, np.stack([corner, windows.ends[:, 1]], axis=1), place, windows.left,
                       np.where(right_of[:, None], windows.from_, place), windows.to)
    return _open(by_right, ~right_of).joined(_open(by_left, ~left_of))
