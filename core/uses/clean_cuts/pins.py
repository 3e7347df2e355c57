# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices that curves go through, because borders follow a crease there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.indexing import place_among
from ...arrays.int64 import full
from ...arrays.pairs import both_ways
from ...arrays.vectors import unit
from .band import Band
from .turning import turning

# Along a crease faces turn by such an angle or more, and the crease itself by less than the second from edge to edge. A
# border that follows it may leave it for less than twice so many edges.
CREASE, STRAIGHT, GAP = np.radians(30), np.radians(45), 2


@dataclass(frozen=True, eq=False)
class Pins:
    """Vertices that curves go through, because borders follow a crease there.

    Attributes
    ----------
    vertex : (k,) int64
    pair : (k, 2) int64
        The two labels that meet there, the lower first.
    """

    vertex: np.ndarray
    pair: np.ndarray

    @classmethod
    def none(cls) -> Pins:
        """No vertices."""
        return cls(np.empty(0, np.int64), np.empty((0, 2), np.int64))

    @classmethod
    def of(cls, band: Band) -> Pins:
        """The vertices of creases that borders follow, also where they leave one for a few edges."""
        low, high = band.edge_labels
        sharp = _sharp(band)
        both = np.flatnonzero(sharp & (low < high))
        point, angle = turning(band.table.vertices, band.table.edges[both])
        ends = band.table.edges[both].ravel()
        pair = full((2, len(band.vertices)), -1)
        other = pair.copy()
        for pairs, order in ((pair, slice(None)), (other, slice(None, None, -1))):
            pairs[:, ends[order]] = np.repeat(np.stack([low[both], high[both]]), 2, axis=1)[:, order]
        sure = np.zeros(len(band.vertices), bool)
        sure[point[angle < STRAIGHT]] = True
        sure &= (pair == other).all(axis=0)
        pair[:, ~sure] = -1
        member = sure.copy()
        a, b = both_ways(band.table.edges[sharp]).T
        for _ in range(GAP):
            reached = member[a] & ~member[b]
            pair[:, b[reached]] = pair[:, a[reached]]
            member[b[reached]] = True
        for _ in range(GAP):
            outside = np.zeros(len(member), bool)
            outside[a[~member[b]]] = True
            member &= sure | ~outside
        vertex = np.flatnonzero(member)
        return cls(vertex, pair[:, vertex].T)


def _sharp(band: Band) -> np.ndarray:
    """Whether the two faces at each edge turn by the angle of a crease, (e,) bool."""
    table = band.table
    normal = unit(band.face_vectors)
    pairs, edge = table.face_pairs()
    two = table.n_edge_faces[edge] == 2
    a, b = pairs[two].T
    sharp = np.zeros(len(band.edges), bool)
    sharp[edge[two]] = (normal[a] * normal[b]).sum(axis=1) < np.cos(CREASE)
    return sharp


def are_between(band: Band, pins: Pins, top: np.ndarray) -> np.ndarray:
    """Whether all neighbors of each pinned vertex are in one of its two parts, (k,) bool."""
    place = place_among(pins.vertex, len(band.vertices))
    start, end = both_ways(band.table.edges).T
    start, end = start[place[start] >= 0], end[place[start] >= 0]
    strange = (pins.pair[place[start]] != top[end][:, None]).all(axis=1)
    fine = np.ones(len(pins.vertex), bool)
    fine[place[start[strange]]] = False
    return fine
