# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes of parts by hand: where a part splits, which candidate it takes or gives, whether it is connected.

All functions work on the c candidates of a decomposition; a mask is (c,) bool and says which of them belong to a part.
Where the candidates are not fine enough for a change, ``finer_candidates`` cuts some of them.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import dijkstra

from ...arrays.components import components
from ...arrays.indexing import inverse, renumbered
from ...arrays.int64 import arange, full
from ...arrays.pairs import both_ways, symmetric_matrix
from ...cuts.hierarchy import Dendrogram
from ...mesh.face_graph import FaceGraph
from ...mesh.labels import label_boundaries, spread
from ..decomposition import Decomposition


def components_of(decomposition: Decomposition, mask: np.ndarray) -> np.ndarray:
    """Find the connected components of some candidates.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates that count.

    Returns
    -------
    piece : (c,) int64
        Component of each candidate: 0 for the component of most area, 1 for the next ...; -1 outside the mask.
    """
    _, label = components(decomposition.n_candidates, *_inside(decomposition, mask).T)
    _, label = renumbered(label[mask])
    area = np.bincount(label, decomposition.candidate_area[mask])
    piece = full(len(mask), -1)
    piece[mask] = inverse(np.argsort(-area, kind="stable"))[label]
    return piece


def best_split(decomposition: Decomposition, mask: np.ndarray) -> np.ndarray | None:
    """Split a part along its best cut: that of the last merge when the part's candidates merge, weakest cut first.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of one connected part.

    Returns
    -------
    side : (c,) bool or None
        Candidates on the side of less area; None for a part of a single candidate.
    """
    if mask.sum() < 2:
        return None
    pairs, tree = _merging_inside(decomposition, mask)
    side = _side_without(pairs, tree.rows[:-1], tree.order[tree.joins[-1, 0]], mask)
    return smaller_side(side, mask, decomposition.candidate_area)


def node_split(decomposition: Decomposition, mask: np.ndarray, node: int) -> np.ndarray | None:
    """Split a part along the best cut between a node of the graph and what the arcs of this node reach.

    When the part's candidates merge, weakest cut first, the candidate of the node is joined with the candidates that
    the node's arcs reach inside the part, one after the other. The part is split at the last of these merges. If the
    arcs reach no other candidate of the part, all of its candidates count as reached.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of one connected part, including that of the node.
    node : int
        Index of the node in ``decomposition.graph``.

    Returns
    -------
    side : (c,) bool or None
        Candidates on the side of the node; None for a part of a single candidate.
    """
    start = decomposition.node_candidate[node]
    graph = decomposition.graph
    ours = (graph.arcs == node).any(axis=1)
    reached = np.zeros(len(mask), bool)
    reached[decomposition.point_candidate[ours[graph.point_arc]]] = True
    reached[decomposition.node_candidate[graph.arcs[ours].ravel()]] = True
    rest = mask & (arange(len(mask)) != start)
    return _strongest_cut(decomposition, mask, start, rest & reached if (rest & reached).any() else rest)


def _strongest_cut(
    decomposition: Decomposition, mask: np.ndarray, start: int, targets: np.ndarray
) -> np.ndarray | None:
    """Side of candidate ``start`` when a part is split at the last merge that joins this candidate with a target.

    targets : (c,) bool, candidates of the part. Returns (c,) bool; None if no merge joins ``start`` with a target.
    """
    pairs, tree = _merging_inside(decomposition, mask)
    targets = np.flatnonzero(targets)
    rows = tree.row_of(full(len(targets), start), targets)
    rows = rows[np.isin(rows, tree.rows)]
    if not len(rows):
        return None
    return _side_without(pairs, tree.rows[tree.rows != rows.max()], start, mask)


def _merging_inside(decomposition: Decomposition, mask: np.ndarray) -> tuple[np.ndarray, Dendrogram]:
    """Pairs of candidates that touch inside a part, (k, 2), weakest cut first, and the dendrogram of these pairs."""
    pairs = _inside(decomposition, mask)
    pairs = pairs[np.argsort(decomposition.hierarchy.merge_of(*pairs.T), kind="stable")]
    return pairs, Dendrogram.of(decomposition.n_candidates, pairs)


def _side_without(pairs: np.ndarray, joins: np.ndarray, start: int, mask: np.ndarray) -> np.ndarray:
    """Candidates that are connected with candidate ``start``, (c,) bool, when only some of the pairs are joined.

    joins : rows of ``pairs`` that are joined.
    """
    label = components(len(mask), *pairs[joins].T)[1]
    return label == label[start]


def smaller_side(side: np.ndarray, inside: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Of a side of a part and the rest of the part, the one of less area, (k,) bool; of equals the side.

    side, inside : (k,) bool, the side and the whole part. area : (k,) float64, of each face or candidate.
    """
    other = inside & ~side
    return side if area[side].sum() <= area[other].sum() else other


def growth(decomposition: Decomposition, mask: np.ndarray, allowed: np.ndarray) -> int | None:
    """Find the candidate that a part takes next when it grows: the one beyond the weakest stretch of its boundary.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of the part.
    allowed : (c,) bool
        Candidates that the part may take.

    Returns
    -------
    candidate : int or None
        None if no allowed candidate touches the part.
    """
    inner, outer = _border(decomposition, mask, allowed)
    if not len(outer):
        return None
    return int(outer[decomposition.hierarchy.merge_of(inner, outer).argmin()])


def shrinkage(
    decomposition: Decomposition, mask: np.ndarray, allowed: np.ndarray
) -> tuple[int, int] | None:
    """Find the candidate that a part gives away next when it shrinks, and the candidate across the boundary.

    The part gives the candidate behind the weakest stretch of its boundary that leaves the part connected and not
    empty.

    Parameters
    ----------
    decomposition : Decomposition
    mask : (c,) bool
        Candidates of the part.
    allowed : (c,) bool
        Candidates whose parts may receive a candidate.

    Returns
    -------
    given, receiver : int
        The candidate that is given, and the candidate whose part receives it. None instead of both if the part can
        give no candidate.
    """
    inner, outer = _border(decomposition, mask, allowed)
    time = decomposition.hierarchy.merge_of(inner, outer)
    for index in np.argsort(time, kind="stable").tolist():
        rest = mask.copy()
        rest[inner[index]] = False
        if rest.any() and components_of(decomposition, rest).max() == 0:
            return int(inner[index]), int(outer[index])
    return None


def boundary_distance(
    inside: np.ndarray, face_pairs: np.ndarray, pair_length: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Measure how far each face is from the boundary of some faces, and find the nearest face across the boundary.

    Parameters
    ----------
    inside : (p,) bool
        Faces whose boundary counts.
    face_pairs : (e, 2) int64
        Faces that share an edge.
    pair_length : (e,) float64
        Distance between the centers of the two faces, 0 or more, in any unit.

    Returns
    -------
    distance : (p,) float64
        Distance along the surface from the center of the nearest face across the boundary, in the unit of
        ``pair_length``: positive outside, negative inside, infinite for a face that no path joins with the boundary.
    across : (p,) int64
        The nearest face across the boundary; -1 where the distance is infinite.
    """
    count = len(inside)
    sides = inside[face_pairs]
    distance = np.full(count, np.inf)
    across = full(count, -1)
    # A path begins across the boundary and then stays on one side. It has a length, so that its sign says which.
    length = np.maximum(pair_length, 1e-12 * (pair_length.max(initial=0.0) or 1.0))
    for side in (False, True):
        usable = (sides == side).any(axis=1)
        border = np.unique(face_pairs[sides[:, 0] != sides[:, 1]])
        border = border[inside[border] != side]
        if not len(border):
            continue
        graph = symmetric_matrix(face_pairs[usable], length[usable], count)
        found, _, source = dijkstra(
            graph, directed=True, indices=border, min_only=True, return_predecessors=True)
        here = (inside == side) & np.isfinite(found)
        distance[here] = -found[here] if side else found[here]
        across[here] = source[here]
    return distance, across


def two_sides(graph: FaceGraph, contacts: np.ndarray, inside: np.ndarray, side: np.ndarray
              ) -> tuple[np.ndarray, np.ndarray]:
    """The two sides of a cut that meet along it, each with what hangs on it.

    A part may be of several pieces that only touch, and a cut goes through one of them: what hung on the rest by the
    side that is cut off goes with that side.

    Parameters
    ----------
    graph : FaceGraph
        Of p faces.
    contacts : (t, 2) int64
        Faces of different pieces that touch.
    inside : (p,) bool
        Faces of the part.
    side : (p,) bool
        Those on one side of the cut.

    Returns
    -------
    side, other : (p,) bool
        Both that side and the other one. Pieces of the part that hang on neither are in none.
    """
    pairs = np.concatenate([graph.pairs, contacts])
    pairs = pairs[inside[pairs].all(axis=1)]
    across = side[pairs[:, 0]] != side[pairs[:, 1]]
    count, region = components(graph.n_faces, *pairs[~across].T)
    within = inside[graph.pairs].all(axis=1)
    touching, length = label_boundaries(region, graph.pairs[within], graph.length[within])
    own = np.zeros(count, np.int64)
    own[region[side]] = 1
    known = full(count, -1)
    along = touching[length.argmax()]
    known[along] = own[along]
    # From one side to the other in turn: what touches one of the two is no piece of the other.
    found = np.where(inside, spread(known, *both_ways(region[pairs[across]]).T)[region], -1)
    return found == 1, found == 0


def _inside(decomposition: Decomposition, mask: np.ndarray) -> np.ndarray:
    """Pairs of touching candidates, (k, 2), of which both are in a mask."""
    pairs = decomposition.candidate_pairs
    return pairs[mask[pairs].all(axis=1)]


def _border(
    decomposition: Decomposition, mask: np.ndarray, allowed: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of touching candidates across the boundary of a mask: the inner ones, (k,), and the outer ones, (k,).

    allowed : (c,) bool, which the outer one may be.
    """
    pairs = decomposition.candidate_pairs
    across = pairs[mask[pairs].sum(axis=1) == 1]
    inner, outer = np.where(mask[across[:, :1]], across, across[:, ::-1]).T
    return inner[allowed[outer]], outer[allowed[outer]]
