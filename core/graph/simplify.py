# SPDX-License-Identifier: GPL-3.0-or-later
"""Cancel the ripples of a Reeb graph: leaves that are too small or too flat to be protrusions.

Loops are never cancelled, so that simplification leaves the first Betti number unchanged.
"""

from __future__ import annotations

import heapq

import numpy as np

from ..arrays.components import roots
from ..arrays.indexing import place_among
from ..arrays.int64 import arange, full
from ..field.agd import ScalarField
from .level_sets import LevelSets
from .reeb import ReebTopology

# A leaf is a ripple below either: its area as a share of the component's, and the change of the AGD over it as a share
# of the largest AGD; so little is an error of the distances. Neither is sharp: of 15 bodies the graphs have 19 nodes on
# average, with half or twice the area 21 or 18, with half or twice the height 19 or 18; without both they have 52.
MIN_LEAF_AREA, MIN_LEAF_HEIGHT = 0.0025, 0.005
LOWER, UPPER = 0, 1  # the two sides of a node: arcs below, arcs above


def without_ripples(sets: LevelSets, topology: ReebTopology, field: ScalarField) -> ReebTopology:
    """Cancel the leaves that are ripples of the surface or errors of the distances.

    A leaf is cancelled by ``simplify`` if it is below MIN_LEAF_AREA or MIN_LEAF_HEIGHT.

    Parameters
    ----------
    sets : LevelSets
        Level sets of ``field.values``.
    topology : ReebTopology
        Reeb graph of these level sets, as ``reeb_topology`` makes it.
    field : ScalarField

    Returns
    -------
    topology : ReebTopology
    """
    return simplify(sets, topology, MIN_LEAF_AREA, MIN_LEAF_HEIGHT, level_height(field, sets.levels))


def level_height(field: ScalarField, levels: np.ndarray) -> np.ndarray:
    """Measure how much of the AGD each level stands for.

    The height of a level is half the difference of the AGD between the level above and the level below; where there is
    no such level, the end of the field's range takes its place.

    Parameters
    ----------
    field : ScalarField
    levels : (K,) float64
        Values of ``field.values``, 0..1, strictly rising.

    Returns
    -------
    height : (K,) float64
        In units of the largest AGD.
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
    min_height: float,
    level_height: np.ndarray,
) -> ReebTopology:
    """Cancel leaves that are small or flat, the one of least area first.

    A leaf is cancelled only if the saddle at its inner end has a second arc on the side of the leaf: the extremum and
    the saddle then cancel each other. If the saddle is left with one arc below and one above, these three become one
    arc.

    Parameters
    ----------
    sets : LevelSets
        K levels.
    topology : ReebTopology
        Reeb graph of ``sets``, as ``reeb_topology`` makes it.
    min_area : float
        Leaves of less area are cancelled; share of the area of the surface, 0..1.
    min_height : float
        Leaves of less height, the sum over the levels that they cross, are cancelled; in the unit of ``level_height``.
    level_height : (K,) float64
        Height that each level adds to a leaf that crosses it. Where the field hardly changes, levels of an equalized
        field lie close together, and a leaf of many levels may be flat.

    Returns
    -------
    topology : ReebTopology
        The slab pieces of a cancelled leaf belong to the node or arc to which it was attached, its contours to no arc.

    Notes
    -----
    O(arcs log arcs) in Python, the rest whole arrays.
    """
    work = _WorkGraph(sets, topology, level_height, (min_area * sets.mesh.area, min_height))
    work.cancel_leaves()
    return work.result()


class _WorkGraph:
    """The Reeb graph while leaves are cancelled.

    Lists that hold nodes and arcs (area, parent, piece_owner) have node i at place i and arc i at place n_nodes + i. A
    cancelled arc is None in ``arcs``.
    """

    def __init__(
        self, sets: LevelSets, topology: ReebTopology, level_height: np.ndarray, least: tuple[float, float]
    ) -> None:
        """least : area and height below which a leaf is cancelled."""
        self.topology = topology
        self.min_area, self.min_height = least
        n, q = topology.n_nodes, len(topology.arcs)
        owner = np.where(topology.piece_node >= 0, topology.piece_node, n + topology.piece_arc)
        self.piece_owner = owner
        self.area = np.bincount(owner, sets.piece_area, n + q).tolist()
        # An arc has a contour at each level that it crosses.
        self.height = np.bincount(topology.contour_arc, level_height[sets.contour_level], q).tolist()
        self.arcs = topology.arcs.tolist()
        self.at_node = [(set(), set()) for _ in range(n)]  # for each node the arcs below and the arcs above
        for arc, (lower, upper) in enumerate(self.arcs):
            self.at_node[upper][LOWER].add(arc)
            self.at_node[lower][UPPER].add(arc)
        self.arc_alias = list(range(q))  # the arc of which each arc is a part now; itself if of none
        self.contours_dropped = np.zeros(q, bool)
        self.parent = list(range(n + q))  # the node or arc into which each was absorbed; itself if it still exists
        self.heap = []  # (area, arc) of leaves to be cancelled, also of some that have changed since

    def cancel_leaves(self) -> None:
        """Cancel leaves, the one of least area first, until none is below the limits."""
        for arc in range(len(self.arcs)):
            self._push_if_leaf(arc)
        heapq.heapify(self.heap)
        while self.heap:
            area, arc = heapq.heappop(self.heap)
            leaf, node, side = self._leaf_of(arc)
            if leaf < 0 or len(self.at_node[node][side]) < 2 or area != self._leaf_area(arc, leaf):
                continue  # the arc no longer exists, is no leaf, has grown, or is the last on its side of the saddle
            self._cancel(arc, leaf, node, side)

    def _leaf_of(self, arc: int) -> tuple[int, int, int]:
        """Extremum of a leaf, its other node, and the side of that node on which it is; -1, -1, 0 if it is no leaf."""
        if self.arcs[arc] is None:
            return -1, -1, 0
        lower, upper = self.arcs[arc]
        for leaf, node, side in ((lower, upper, LOWER), (upper, lower, UPPER)):
            if sum(map(len, self.at_node[leaf])) == 1:
                return leaf, node, side
        return -1, -1, 0

    def _leaf_area(self, arc: int, leaf: int) -> float:
        """Area of a leaf: of the arc and of the extremum in which it ends."""
        return self.area[leaf] + self.area[len(self.at_node) + arc]

    def _push_if_leaf(self, arc: int) -> None:
        """Put an arc on the heap if it is a leaf below the limits."""
        leaf, _, _ = self._leaf_of(arc)
        if leaf < 0:
            return
        area = self._leaf_area(arc, leaf)
        if area < self.min_area or self.height[arc] < self.min_height:
            heapq.heappush(self.heap, (area, arc))

    def _cancel(self, arc: int, leaf: int, node: int, side: int) -> None:
        """Absorb a leaf and its extremum into its other node."""
        n = len(self.at_node)
        self.area[node] += self._leaf_area(arc, leaf)
        self.parent[leaf] = self.parent[n + arc] = node
        self.arcs[arc] = None
        self.contours_dropped[arc] = True
        self.at_node[node][side].discard(arc)
        below, above = self.at_node[node]
        if len(below) == len(above) == 1:
            self._dissolve(node)
        elif len(below) + len(above) == 1:
            # The node is an extremum now. At one that keeps more arcs no leaf has come or changed: of a node with
            # thousands of leaves all that is left would be looked at for each of them.
            self._push_if_leaf(next(iter(below or above)))

    def _dissolve(self, node: int) -> None:
        """Make one arc of a node with one arc below and one above, and of these two arcs."""
        n = len(self.at_node)
        (below,), (above,) = self.at_node[node]
        lower, upper = self.arcs[below][0], self.arcs[above][1]
        self.area[n + below] += self.area[node] + self.area[n + above]
        self.height[below] += self.height[above]
        self.parent[node] = self.parent[n + above] = n + below
        self.arc_alias[above] = below
        self.arcs[below], self.arcs[above] = [lower, upper], None
        self.at_node[node] = (set(), set())
        self.at_node[upper][LOWER].discard(above)
        self.at_node[upper][LOWER].add(below)
        self._push_if_leaf(below)

    def result(self) -> ReebTopology:
        """Topology of the nodes and arcs that are left, numbered anew in their old order."""
        n = len(self.at_node)
        root = roots(np.array(self.parent, np.int64))
        owner = root[self.piece_owner]
        keeps = root == arange(len(root))
        node_id = place_among(np.flatnonzero(keeps[:n]), n)
        kept_arcs = np.array([arc is not None for arc in self.arcs], bool)
        arc_id = place_among(np.flatnonzero(kept_arcs), len(kept_arcs))
        at_node = owner < n
        arcs = [arc for arc in self.arcs if arc is not None]
        contour_arc = self.topology.contour_arc
        of_alias = arc_id[roots(np.array(self.arc_alias, np.int64))]
        contour_arc = np.where(self.contours_dropped[contour_arc], -1, of_alias[contour_arc])
        return ReebTopology(
            piece_node=np.where(at_node, node_id[np.minimum(owner, n - 1)], -1),
            piece_arc=np.where(at_node, -1, arc_id[np.maximum(owner - n, 0)]) if len(arc_id)
            else full(len(owner), -1),
            contour_arc=contour_arc,
            arcs=node_id[np.array(arcs, np.int64).reshape(-1, 2)],
            n_nodes=int(keeps[:n].sum()))
