# SPDX-License-Identifier: GPL-3.0-or-later
"""Which nodes and arcs of a Reeb graph are worth showing beside some parts: the branches within a part are folded.

And whether their marks would cover the model.
"""

from __future__ import annotations

import heapq
from collections import Counter

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import sums_by
from ..graph.critical import SADDLE
from ..graph.reeb import ReebGraph

# A graph covers its model if more than this share of its marks would lie under others, in a picture of the model that
# is so many marks wide. Of 31 labeled models, at the usual detail, these are four clothed men with hair and belts of
# their own; with all nodes shown, as before, it would be fifteen.
_CROWDED, _MARKS_WIDE = 0.35, 45


def arc_lengths(graph: ReebGraph) -> np.ndarray:
    """Length of each arc from node to node through its center points, (q,) float64, in units of the vertices."""
    first, last = graph.node_position[graph.arcs].transpose(1, 0, 2)
    step = np.linalg.norm(np.diff(graph.point_position, axis=0), axis=1)
    same = graph.point_arc[1:] == graph.point_arc[:-1]
    length = sums_by(graph.point_arc[1:][same], step[same], graph.n_arcs)
    length += np.linalg.norm(graph.point_position[graph.arc_points[:-1]] - first, axis=1)
    return length + np.linalg.norm(graph.point_position[graph.arc_points[1:] - 1] - last, axis=1)


def unfolded(graph: ReebGraph, node_part: np.ndarray, point_part: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Choose the nodes and arcs that some parts need.

    Of the ends of branches in one part, the one at the end of the longest branch stays; the others go, the shortest
    branch first, with their arcs, unless these reach another part. Loops and arcs between parts stay, and of every part
    that has nodes at least one. Saddles that no longer part branches stay only where a part has no other node.

    Parameters
    ----------
    graph : ReebGraph
        With k nodes, q arcs and r center points.
    node_part, point_part : (k,) and (r,) int64
        The part that each node and each center point lies in.

    Returns
    -------
    nodes, arcs : (k,) and (q,) bool
        Those that are worth showing.

    Notes
    -----
    O((k + q) log k).
    """
    inside = node_part[graph.arcs[:, 0]] == node_part[graph.arcs[:, 1]]
    np.logical_and.at(inside, graph.point_arc, point_part == node_part[graph.arcs[graph.point_arc, 0]])
    folding = _Folding(graph, node_part.tolist(), inside.tolist())
    folding.fold_all()
    return _without_passages(graph, node_part, folding.nodes, folding.around), folding.arcs


def arc_segments(graph: ReebGraph, arcs: np.ndarray) -> np.ndarray:
    """Points of some arcs that follow each other, (s, 2) int64; nodes come first, then the center points of the arcs.

    arcs : (q,) bool.
    """
    following = np.flatnonzero((graph.point_arc[1:] == graph.point_arc[:-1]) & arcs[graph.point_arc[1:]])
    shown = np.flatnonzero(arcs)
    lower, upper = graph.arcs[shown].T
    return np.concatenate([
        graph.n_nodes + np.stack([following, following + 1], axis=1),
        np.stack([lower, graph.n_nodes + graph.arc_points[shown]], axis=1),
        np.stack([graph.n_nodes + graph.arc_points[shown + 1] - 1, upper], axis=1)])


def without_scraps(segments: np.ndarray, part: np.ndarray, seen: np.ndarray, n_nodes: int) -> np.ndarray:
    """Leave out what is seen of an arc amid hidden parts, and reaches no node, if its part has lines that do.

    Parameters
    ----------
    segments : (s, 2) int64
        See ``arc_segments``.
    part : (m,) int64
        The part that each point lies in.
    seen : (m,) bool
        Points of parts that are not hidden.
    n_nodes : int
        How many of the points are nodes, the first ones.

    Returns
    -------
    seen : (m,) bool
        All nodes as they were.
    """
    ends = segments[seen[segments].all(axis=1)]
    _, line = components(len(part), *ends.T)
    reaches = np.isin(line, line[ends[ends < n_nodes]])
    others = np.isin(part, part[seen & reaches])
    stays = reaches | np.isin(line, line[seen & ~others])
    stays[:n_nodes] = True
    return seen & stays


def is_crowded(graph: ReebGraph, shown: np.ndarray) -> bool:
    """Whether the marks of a graph would cover each other rather than show anything.

    Parameters
    ----------
    graph : ReebGraph
        With k nodes.
    shown : (k,) bool
        Nodes that have marks.

    Returns
    -------
    crowded : bool
        Whether on average over three pictures, along the axes, too large a share of the marks lies under others.
    """
    places = graph.node_position[shown]
    if len(places) < 2:
        return False
    size = float(np.ptp(np.concatenate([graph.node_position, graph.point_position]), axis=0).max()) / _MARKS_WIDE
    covered = []
    for axis in range(3):
        seen = np.delete(places, axis, axis=1)
        apart = np.linalg.norm(seen[:, None] - seen[None], axis=2)
        covered.append((np.tril(apart < size, -1)).any(axis=1).mean())
    return float(np.mean(covered)) > _CROWDED


class _Folding:
    """A graph of which the ends of branches are folded, those of the shortest branches first.

    graph : ReebGraph. part : of each node. inside : of each arc, whether all of it is in one part.
    """

    def __init__(self, graph: ReebGraph, part: list[int], inside: list[bool]) -> None:
        self.nodes, self.arcs = np.ones(graph.n_nodes, bool), np.ones(graph.n_arcs, bool)  # those that stay
        self.around: list[set[int]] = [set() for _ in part]  # arcs of each node
        self._ends, self._part, self._inside = graph.arcs.tolist(), part, inside
        for arc, ends in enumerate(self._ends):
            for node in ends:
                self.around[node].add(arc)
        self._length, self._branch = arc_lengths(graph).tolist(), [0.0] * len(part)
        self._ends_in = Counter(part[node] for node in range(len(part)) if len(self.around[node]) < 2)
        self._waiting: list[tuple[float, int]] = []

    def fold_all(self) -> None:
        """Fold ends until each part has one at the most, or those that reach other parts."""
        for node in range(len(self._part)):
            self._wait(node)
        while self._waiting:
            reach, node = heapq.heappop(self._waiting)
            if self._ends_in[self._part[node]] > 1:
                self._fold(node, reach)

    def _wait(self, node: int) -> None:
        """Look at a node in its turn if it is the end of a branch, unless its arc reaches another part."""
        arcs = self.around[node]
        if len(arcs) < 2 and all(self._inside[arc] for arc in arcs):
            heapq.heappush(self._waiting, (self._branch[node] + sum(self._length[arc] for arc in arcs), node))

    def _fold(self, node: int, reach: float) -> None:
        """Leave out the end of a branch with its arc. reach : how long the branch is."""
        self.nodes[node] = False
        self._ends_in[self._part[node]] -= 1
        for arc in self.around[node]:
            self.arcs[arc] = False
            other = sum(self._ends[arc]) - node
            self.around[other].discard(arc)
            self._branch[other] = reach  # the longest branch so far: they come in the order of their lengths
            if len(self.around[other]) == 1:  # it was in between, and is the end of a branch now
                self._ends_in[self._part[other]] += 1
            self._wait(other)
        self.around[node] = set()


def _without_passages(graph: ReebGraph, part: np.ndarray, nodes: np.ndarray, around: list[set[int]]) -> np.ndarray:
    """Nodes that stay, (k,) bool: without saddles that two arcs pass, where their part has another node."""
    degree = np.array([len(arcs) for arcs in around], np.int64)
    passage = nodes & (graph.node_kind == SADDLE) & (degree == 2)
    others = np.isin(part, part[nodes & ~passage])
    # Of a part that has nothing but passages, the first stays.
    first = np.zeros(len(nodes), bool)
    candidates = np.flatnonzero(passage & ~others)
    first[candidates[np.unique(part[candidates], return_index=True)[1]]] = True
    return nodes & (~passage | first)
