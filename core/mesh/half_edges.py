# SPDX-License-Identifier: GPL-3.0-or-later
"""The sides of polygons as half-edges: which follows which round a polygon, and which lies across the edge."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import inverse, place_among
from ..arrays.int64 import arange
from .triangles import TriMesh, next_side


@dataclass(frozen=True, eq=False)
class HalfEdges:
    """Sides of polygons, each from a vertex to the next one round its polygon; h of them, of n vertices.

    Attributes
    ----------
    start, end : (h,) int64
        Vertices.
    polygon : (h,) int64
        In which each lies.
    following, before : (h,) int64
        The next side of the polygon, and the one before.
    opposite : (h,) int64
        The side of another polygon along the same edge, the other way; -1 at borders, at edges of three polygons and
        more, and between polygons that are turned differently.
    length : (h,) float64
    """

    start: np.ndarray
    end: np.ndarray
    polygon: np.ndarray
    following: np.ndarray
    before: np.ndarray
    opposite: np.ndarray
    length: np.ndarray

    @classmethod
    def of(cls, mesh: TriMesh, polygon: np.ndarray) -> HalfEdges:
        """Make the half-edges of polygons from their triangles; polygon : (m,) int64, that of each triangle."""
        side = arange(3 * mesh.n_faces)
        following = next_side(side)
        opposite = mesh.edges.opposite_sides((mesh.edges.n_faces[mesh.edges.pair_edge] == 2) & ~mesh.same_way)
        of_side = np.repeat(polygon, 3)
        inside = (opposite >= 0) & (of_side[opposite] == of_side)
        # Round the end of a side, across the diagonals that meet there, to the next side of the polygon. The way begins
        # at a side that is no diagonal, and ends at one.
        while len(turns := np.flatnonzero(inside[following] & ~inside)):
            following[turns] = next_side(opposite[following[turns]])
        kept = np.flatnonzero(~inside)
        number = place_among(kept, len(side) + 1)  # the last one stands for none
        following = number[following[kept]]
        start = mesh.faces.ravel()[kept]
        return cls(start, start[following], of_side[kept], following, inverse(following), number[opposite[kept]],
                   mesh.edge_length[mesh.edges.face_edges.ravel()[kept]])

    @property
    def count(self) -> int:
        """Number of half-edges, h."""
        return len(self.start)

    @cached_property
    def corners(self) -> np.ndarray:
        """(h,) int64, number of corners of the polygon in which each lies."""
        return np.bincount(self.polygon)[self.polygon]

    @cached_property
    def valence(self) -> tuple[np.ndarray, np.ndarray]:
        """(h,) int64 twice, number of half-edges that begin where each starts, and where it ends."""
        valence = np.bincount(self.start)
        return valence[self.start], valence[self.end]

    @cached_property
    def piece(self) -> np.ndarray:
        """(h,) int64, connected piece of the mesh in which each lies, all numbers in use."""
        joined = np.flatnonzero(self.opposite >= 0)
        here, there = arange(self.count), self.following
        return components(self.count, np.concatenate([here, joined]),
                          np.concatenate([there, self.opposite[joined]]))[1]
