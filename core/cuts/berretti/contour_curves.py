# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours as curves: the crossings of many contours with edges, in their order along each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import depth_first_order

from ...arrays.components import components
from ...arrays.indexing import ranges, renumbered, run_starts, stable_order, taken
from ...arrays.int64 import arange, cumsum
from ...graph.level_sets import LevelSets

AT_ONCE = 256  # contours that are followed in one search: a call of SciPy takes as long as a way of hundreds of edges


@dataclass(frozen=True, eq=False)
class ContourCurves:
    """Some contours as curves, one after the other: k contours that cross c edges.

    Attributes
    ----------
    start : (k + 1,) int64
        Where each curve begins among the crossings, and c.
    edge : (c,) int64
        Edges of the mesh that the contours cross, in order along each.
    share : (c,) float64
        Where on each of these edges, 0..1 from its first vertex.
    closed : (k,) bool
        Whether each is a closed curve; False if it ends at borders of the surface.
    """

    start: np.ndarray
    edge: np.ndarray
    share: np.ndarray
    closed: np.ndarray

    def at_crossings(self, sets: LevelSets, values: np.ndarray) -> np.ndarray:
        """Values at the crossings, (c,) or (c, d), from those at the vertices, (n,) or (n, d)."""
        low, high = (values[end] for end in sets.mesh.edges.vertices[self.edge].T)
        return low + (self.share * (high - low).T).T


def contour_curves(sets: LevelSets, contours: np.ndarray) -> Iterator[ContourCurves]:
    """Follow contours from edge to edge.

    Parameters
    ----------
    sets : LevelSets
    contours : (k,) int64
        Indices of contours in ``sets``.

    Yields
    ------
    curves : ContourCurves
        Of at most AT_ONCE of the contours, in their order. Where bridges join pieces, a contour has a curve on each of
        them: the longest stands for it.
    """
    order = stable_order(sets.segment_contour)
    count = np.bincount(sets.segment_contour, minlength=sets.n_contours)
    first = cumsum(count) - count
    for begin in range(0, len(contours), AT_ONCE):
        chosen = contours[begin: begin + AT_ONCE]
        segments = order[ranges(first[chosen], count[chosen])]
        yield _followed(sets, chosen, np.repeat(arange(len(chosen)), count[chosen]), segments)


def _followed(sets: LevelSets, contours: np.ndarray, row: np.ndarray, segments: np.ndarray) -> ContourCurves:
    """The curves of some contours; ``row``, (s,) int64, is the place of each segment's contour among them."""
    n_edges = len(sets.mesh.edges.vertices)
    crossing, ends = renumbered(row[:, None] * n_edges + taken(sets.segment_edges, segments))
    row, edge = np.divmod(crossing, n_edges)
    degree = np.bincount(ends.ravel())
    start = _starts(row, degree, ends)
    order = _followed_from(start, ends, len(edge))
    edge, row = edge[order], row[order]
    length = np.bincount(row, minlength=len(contours))
    return ContourCurves(np.append(0, cumsum(length)), edge,
                         sets.crossing(edge, sets.contour_level[contours[row]]), degree[start] >= 2)


def _starts(row: np.ndarray, degree: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """A crossing of the longest curve of each contour, from which it is followed: (k,) int64.

    row, degree : (c,) int64, place of the contour of each crossing, and the number of segments that end there.
    """
    count, curve = components(len(row), *ends.T)
    size, row_of_curve = np.bincount(curve), np.empty(count, np.int64)
    row_of_curve[curve] = row
    order = np.lexsort((-size, row_of_curve))
    longest = order[run_starts(row_of_curve[order])]
    main = np.flatnonzero(curve == longest[row])
    # A closed one from anywhere, an open one from an end, which has degree 1.
    return main[np.lexsort((degree[main], row[main]))[run_starts(row[main])]]


def _followed_from(start: np.ndarray, ends: np.ndarray, n_crossings: int) -> np.ndarray:
    """Crossings in order along the curves from each start, one curve after the other: (c,) int64.

    Depth-first search follows a curve. So that one search follows all, a chain of elements beside the crossings is
    added to the graph, each of which leads to the start of a curve and then to the next element.
    """
    n = n_crossings + len(start)
    chain = arange(n_crossings, n)
    links = np.concatenate([ends, np.stack([chain, start], axis=1), np.stack([chain[:-1], chain[1:]], axis=1)])
    graph = coo_array((np.ones(len(links), np.int8), tuple(links.T)), shape=(n, n)).tocsr()
    order = depth_first_order(graph, n_crossings, directed=False, return_predecessors=False)
    return order[order < n_crossings].astype(np.int64)
