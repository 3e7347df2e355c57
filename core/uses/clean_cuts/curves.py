# SPDX-License-Identifier: GPL-3.0-or-later
"""The curves between parts as lines to draw: where faces are divided, and the edges of faces where they are not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.indexing import renumbered
from ...arrays.int64 import arange
from ...mesh.corners import CornerTable
from .division import portions
from .method import CleanCuts


@dataclass(frozen=True, eq=False)
class Curves:
    """The borders between parts after some cuts, as segments whose points go along with the vertices.

    Attributes
    ----------
    ends : (q, 2) int64
        Vertices between which a point lies; one vertex twice for a point that is a vertex.
    share : (q,) float64
        Where, from the first of them, 0, to the second, 1.
    inner : (m, 3) int64
        Points, of those above, in the middle of which a point inside a face lies.
    segments : (s, 2) int64
        Points, 0..q-1 those above, from q on those inside faces.
    pair : (s, 2) int64
        Parts on both sides, the lower first. Where more than two parts meet at an edge, it has several segments.
    """

    ends: np.ndarray
    share: np.ndarray
    inner: np.ndarray
    segments: np.ndarray
    pair: np.ndarray

    def points(self, vertices: np.ndarray) -> np.ndarray:
        """Where the points are for vertices, (n, 3), anywhere: (q + m, 3) float64."""
        start, end = vertices[self.ends].transpose(1, 0, 2)
        points = start + self.share[:, None] * (end - start)
        return np.concatenate([points, points[self.inner].mean(axis=1)])

    def around(self, labels: list[int] | np.ndarray) -> np.ndarray:
        """Whether each segment is between one of some parts and another part, (s,) bool."""
        own = np.isin(self.pair, labels)
        return own[:, 0] != own[:, 1]


def curves_of(table: CornerTable, labels: np.ndarray, cuts: CleanCuts) -> Curves:
    """Find the borders between parts once faces are divided.

    Parameters
    ----------
    table : CornerTable
        n vertices, e edges, p faces.
    labels : (p,) int64
        Part of each face before, 0 or more.
    cuts : CleanCuts
        Found for these.

    Returns
    -------
    curves : Curves
        Its points are vertices of the fragments that the cuts leave, and its segments their edges.
    """
    n, fragments = len(table.vertices), np.bincount(cuts.face, minlength=table.n_faces)
    divided = fragments > 1
    after = labels.copy()
    after[cuts.face] = cuts.label
    share = np.full(len(table.edges), np.nan)
    share[cuts.edge] = cuts.share
    key, label = _sides(table, cuts, after, divided, ~np.isnan(share))
    apart = np.flatnonzero((key[1:] == key[:-1]) & (label[1:] != label[:-1]))
    edge, half = np.divmod(key[apart], 2)
    crossed = ~np.isnan(share[edge])
    along = table.edges[edge].astype(np.int64)
    along[crossed, 1 - half[crossed]] = n + edge[crossed]
    two, three = (np.flatnonzero(fragments[cuts.face] == count).reshape(-1, count) for count in (2, 3))
    center = n + len(table.edges) + np.repeat(arange(len(three)), 3)
    segments = np.concatenate([along, cuts.start[two], np.stack([center, cuts.start[three].ravel()], axis=1)])
    before = np.roll(cuts.label[three], 1, axis=1).ravel()
    pair = np.concatenate([np.stack([label[apart], label[apart + 1]], axis=1), cuts.label[two],
                           np.stack([before, cuts.label[three].ravel()], axis=1)])
    used, segments = renumbered(segments)
    simple = used[: np.searchsorted(used, n + len(table.edges))]
    at_edge = simple >= n
    ends = np.stack([simple, simple], axis=1)
    ends[at_edge] = table.edges[simple[at_edge] - n]
    at = np.zeros(len(simple))
    at[at_edge] = share[simple[at_edge] - n]
    return Curves(ends, at, np.searchsorted(simple, cuts.start[three]), segments, np.sort(pair, axis=1))


def _sides(table: CornerTable, cuts: CleanCuts, after: np.ndarray, divided: np.ndarray,
           crossed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Which parts are at each edge where a border can be: number of the side and part, sorted, (s,) int64 each.

    A side is twice the number of the edge, and one more for the second half of one that is crossed.

    after : (p,) part of each face that is not divided. divided : (p,) bool. crossed : (e,) bool.
    """
    low, high = table.edge_labels(after)
    wanted = crossed | (low < high)
    wanted[table.corner_edge[divided[table.corner_face]]] = True
    corner, _, point, key = portions(table, np.flatnonzero(wanted[table.corner_edge]), crossed)
    face = table.corner_face[corner].astype(np.int64)
    label = np.where(divided[face], _fragment_labels(cuts, face, point, divided, len(table.vertices) + len(crossed)),
                     after[face])
    order = np.lexsort((label, key))
    return key[order], label[order]


def _fragment_labels(cuts: CleanCuts, face: np.ndarray, point: np.ndarray, divided: np.ndarray,
                     n_points: int) -> np.ndarray:
    """The part of each stretch of the outlines of faces, (o,) int64; of faces that are not divided anything.

    face, point : (o,) int64, face of each stretch, rising, and where it begins.
    """
    rows = np.flatnonzero(divided[cuts.face])
    if not len(rows):
        return np.zeros(len(face), np.int64)
    begin = cuts.face[rows].astype(np.int64) * n_points + cuts.start[rows]
    order = np.argsort(begin)
    key = face * n_points + point
    place = order[np.minimum(np.searchsorted(begin, key, sorter=order), len(rows) - 1)]
    begins = begin[place] == key
    latest = np.maximum.accumulate(np.where(begins, arange(len(face)), -1))
    row = np.where(latest >= 0, rows[place[latest]], -1)
    last = np.searchsorted(cuts.face, face, side="right") - 1  # what comes before the first begins with the last
    return cuts.label[np.where((row >= 0) & (cuts.face[row] == face), row, last)]
