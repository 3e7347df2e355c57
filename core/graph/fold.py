# SPDX-License-Identifier: GPL-3.0-or-later
"""Which nodes and arcs of a Reeb graph are worth showing beside some parts: the branches within a part are folded."""

from __future__ import annotations

import heapq
from collections import Counter

import numpy as np

from .critical import SADDLE
from .reeb import ReebGraph


def arc_lengths(graph: ReebGraph) -> np.ndarray:
    """Length of each arc from node to node through its center points, (q,) float64, in units of the vertices."""
    first, last = graph.node_position[graph.arcs].transpose(1, 0, 2)
    length = np.zeros(graph.n_arcs)
    step = np.linalg.norm(np.diff(graph.point_position, axis=0), axis=1)
    same = graph.point_arc[1:] == graph.point_arc[:-1]
    np.add.at(length, graph.point_arc[1:][same], step[same])
    start, end = graph.arc_points[:-1], graph.arc_points[1:]
    full = np.flatnonzero(end > start)
    length[full] += np.linalg.norm(graph.point_position[start[full]] - first[full], axis=1)
    length[full] += np.linalg.norm(graph.point_position[end[full] - 1] - last[full], axis=1)
    bare = end == start
    length[bare] = np.linalg.norm(first - last, axis=1)[bare]
    return length


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
    part = node_part.tolist()
    inside = node_part[graph.arcs[:, 0]] == node_part[graph.arcs[:, 1]]
    np.logical_and.at(inside, graph.point_arc, point_part == node_part[graph.arcs[graph.point_arc, 0]])
    around: list[set[int]] = [set() for _ in part]
    for arc, ends in enumerate(graph.arcs.tolist()):
        for node in ends:
            around[node].add(arc)
    nodes, arcs = np.ones(graph.n_nodes, bool), np.ones(graph.n_arcs, bool)
    lengths, branch = arc_lengths(graph).tolist(), [0.0] * len(part)
    ends_in = Counter(part[node] for node in range(len(part)) if len(around[node]) < 2)
    waiting: list[tuple[float, int]] = []

    def wait(node: int) -> None:
        """Look at the end of a branch, unless its arc reaches another part."""
        if all(inside[arc] for arc in around[node]):
            heapq.heappush(waiting, (branch[node] + sum(lengths[arc] for arc in around[node]), node))

    for node in range(len(part)):
        if len(around[node]) < 2:
            wait(node)
    while waiting:
        reach, node = heapq.heappop(waiting)
        if ends_in[part[node]] < 2:
            continue
        nodes[node] = False
        ends_in[part[node]] -= 1
        for arc in around[node]:
            arcs[arc] = False
            other = int(graph.arcs[arc].sum()) - node
            around[other].discard(arc)
            branch[other] = reach  # the longest branch so far: they come in the order of their lengths
            if len(around[other]) == 1:  # it was in between, and is the end of a branch now
                ends_in[part[other]] += 1
            if len(around[other]) < 2:
                wait(other)
        around[node] = set()
    return _without_passages(graph, node_part, nodes, around), arcs


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
