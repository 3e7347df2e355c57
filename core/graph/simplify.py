# SPDX-License-Identifier: GPL-3.0-or-later
"""Cancel the short arcs of a Reeb graph: leaves that are ripples, not protrusions.

Loops are never cancelled, so the first Betti number stays what it was.
"""

from __future__ import annotations

import heapq

import numpy as np

from ..field.agd import ScalarField
from .level_sets import LevelSets
from .reeb import ReebTopology

# Leaves that cover less than this share of a component, or cross fewer levels than this, are ripples.
MIN_LEAF_AREA = 0.0025
MIN_LEAF_LEVELS = 1
# Leaves over which the AGD changes by less than this share of its maximum are errors of the distances.
MIN_LEAF_HEIGHT = 0.005
LOWER, UPPER = 0, 1


def without_ripples(sets: LevelSets, topology: ReebTopology, field: ScalarField) -> ReebTopology:
    """Cancel the leaves that are ripples of the surface or errors of the distances.

    Parameters
    ----------
    sets : LevelSets
        Of the field.
    topology : ReebTopology
        As ``reeb_topology`` made it.
    field : ScalarField

    Returns
    -------
    topology : ReebTopology
        See ``simplify``.
    """
    return simplify(sets, topology, MIN_LEAF_AREA, MIN_LEAF_LEVELS, level_height(field, sets.levels), MIN_LEAF_HEIGHT)


def level_height(field: ScalarField, levels: np.ndarray) -> np.ndarray:
    """How much of the AGD each level stands for: half the way from the level below to the one above.

    levels : (K,) float64, of ``field.values``. Returns (K,) float64, as shares of the largest AGD.
    """
    if len(levels) == 0:
        return np.empty(0)
    order = np.argsort(field.values, kind="stable")
    at = np.interp(np.append(levels, [0.0, 1.0]), field.values[order], field.agd[order])
    *inner, low, high = at
    ends = np.concatenate([[low], inner, [high]])
    return (ends[2:] - ends[:-2]) / 2 / high


def simplify(
    sets: LevelSets,
    topology: ReebTopology,
    min_area: float,
    min_levels: int,
    level_height: np.ndarray | None = None,
    min_height: float = 0.0,
) -> ReebTopology:
    """Cancel leaf arcs that are small, short or flat, smallest first.

    A leaf can go where its saddle keeps another arc on the same side: the pair (extremum,
    saddle) cancels, and a saddle left with one arc below and one above dissolves into an arc.

    Parameters
    ----------
    sets : LevelSets
    topology : ReebTopology
        As ``reeb_topology`` made it.
    min_area : float
        Leaves of less area go; share of the surface, 0..1.
    min_levels : int
        Leaves that span fewer levels go.
    level_height : (K,) float64, optional
        What each level adds to the height of a leaf that crosses it. Equalized levels lie close
        where the field hardly changes: a leaf of many levels may be flat all the same.
    min_height : float
        Leaves of less height go.

    Returns
    -------
    topology : ReebTopology
        Pieces of cancelled leaves belong to what they were attached to; their contours to
        no arc.

    Notes
    -----
    O(arcs log arcs) in Python, the rest whole arrays.
    """
    if level_height is None:
        level_height = np.ones(len(sets.levels))
    work = _WorkGraph(sets, topology, level_height)
    work.min_area, work.min_levels, work.min_height = min_area * sets.mesh.area, min_levels, min_height
    work.cancel_leaves()
    return work.result()


class _WorkGraph:
    """Nodes and arcs that can be removed; ids beyond the nodes' are arcs'."""

    min_area = min_height = 0.0
    min_levels = 0

    def __init__(self, sets, topology, level_height):
        self.topology = topology
        n, q = topology.n_nodes, len(topology.arcs)
        owner = np.where(topology.piece_node >= 0, topology.piece_node, n + topology.piece_arc)
        self.piece_owner = owner
        self.area = np.bincount(owner, sets.piece_area, n + q).tolist()
        # An arc with one contour joins two slabs directly: it spans no whole slab.
        self.span = np.bincount(topology.contour_arc, minlength=q).tolist()
        height = level_height[sets.contour_level]
        self.height = np.bincount(topology.contour_arc, height, q).tolist()
        self.arcs = topology.arcs.tolist()
        self.at_node = [(set(), set()) for _ in range(n)]  # arcs below, arcs above
        for arc, (lower, upper) in enumerate(self.arcs):
            self.at_node[upper][LOWER].add(arc)
            self.at_node[lower][UPPER].add(arc)
        self.arc_alias = np.arange(q)  # arc whose contours now belong to which arc
        self.contours_dropped = np.zeros(q, bool)
        self.parent = list(range(n + q))  # what each node or arc was absorbed by
        self.heap = []

    def cancel_leaves(self):
        for arc in range(len(self.arcs)):
            self._push_if_leaf(arc)
        heapq.heapify(self.heap)
        while self.heap:
            area, arc = heapq.heappop(self.heap)
            leaf, node, side = self._leaf_of(arc)
            if leaf < 0 or len(self.at_node[node][side]) < 2 or area != self._leaf_area(arc, leaf):
                continue  # gone, changed, or the last arc on its side of the saddle
            self._cancel(arc, leaf, node, side)

    def _leaf_of(self, arc):
        """The arc's leaf node, its other node, and the side of that node it is on."""
        if self.arcs[arc] is None:
            return -1, -1, 0
        lower, upper = self.arcs[arc]
        for leaf, node, side in ((lower, upper, LOWER), (upper, lower, UPPER)):
            if sum(map(len, self.at_node[leaf])) == 1:
                return leaf, node, side
        return -1, -1, 0

    def _leaf_area(self, arc, leaf):
        return self.area[leaf] + self.area[len(self.at_node) + arc]

    def _push_if_leaf(self, arc):
        leaf, _, _ = self._leaf_of(arc)
        if leaf < 0:
            return
        area = self._leaf_area(arc, leaf)
        short = self.span[arc] < self.min_levels or self.height[arc] < self.min_height
        if area < self.min_area or short:
            heapq.heappush(self.heap, (area, arc))

    def _cancel(self, arc, leaf, node, side):
        n = len(self.at_node)
        self.area[node] += self._leaf_area(arc, leaf)
        self.parent[leaf] = self.parent[n + arc] = node
        self.arcs[arc] = None
        self.contours_dropped[arc] = True
        self.at_node[node][side].discard(arc)
        if [len(s) for s in self.at_node[node]] == [1, 1]:
            self._dissolve(node)
        else:
            for neighbor in self.at_node[node][LOWER] | self.at_node[node][UPPER]:
                self._push_if_leaf(neighbor)

    def _dissolve(self, node):
        """Turn a two-sided node into the middle of an arc."""
        n = len(self.at_node)
        (below,), (above,) = self.at_node[node]
        lower, upper = self.arcs[below][0], self.arcs[above][1]
        self.area[n + below] += self.area[node] + self.area[n + above]
        self.span[below] += self.span[above]
        self.height[below] += self.height[above]
        self.parent[node] = self.parent[n + above] = n + below
        self.arc_alias[self.arc_alias == above] = below
        self.arcs[below], self.arcs[above] = [lower, upper], None
        self.at_node[node] = (set(), set())
        self.at_node[upper][LOWER].discard(above)
        self.at_node[upper][LOWER].add(below)
        self._push_if_leaf(below)

    def result(self) -> ReebTopology:
        n = len(self.at_node)
        root = np.array(self.parent)
        while (root[root] != root).any():
            root = root[root]
        owner = root[self.piece_owner]
        keeps = root == np.arange(len(root))
        node_id = np.where(keeps[:n], np.cumsum(keeps[:n]) - 1, -1)
        kept_arcs = np.array([arc is not None for arc in self.arcs], bool)
        arc_id = np.where(kept_arcs, np.cumsum(kept_arcs) - 1, -1)
        at_node = owner < n
        arcs = [arc for arc in self.arcs if arc is not None]
        contour_arc = self.topology.contour_arc
        contour_arc = np.where(self.contours_dropped[contour_arc], -1,
                               arc_id[self.arc_alias[contour_arc]])
        return ReebTopology(
            piece_node=np.where(at_node, node_id[np.minimum(owner, n - 1)], -1),
            piece_arc=np.where(at_node, -1, arc_id[np.maximum(owner - n, 0)]) if len(arc_id)
            else np.full(len(owner), -1),
            contour_arc=contour_arc,
            arcs=node_id[np.array(arcs, np.int64).reshape(-1, 2)],
            n_nodes=int(keeps[:n].sum()))
