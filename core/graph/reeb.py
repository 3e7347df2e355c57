# SPDX-License-Identifier: GPL-3.0-or-later
"""The Reeb graph of a field: every contour contracted to a point.

Chains of slab pieces with one contour below and one contour above become arcs of the graph. The others, in which
contours appear, join, split or vanish, become nodes. The graph is exact up to its levels: a loop that lies within one
slab is not found, and a level at every critical value would find all.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import last_of_each, place_among
from ..arrays.int64 import arange, cumsum, full
from ..arrays.vectors import middles_of_each
from .critical import MAXIMUM, MINIMUM, SADDLE, critical_points, total_order
from .level_sets import LevelSets


@dataclass(frozen=True, eq=False)
class ReebGraph:
    """Nodes and arcs of the Reeb graph, with center lines to draw them by.

    With k nodes, q arcs and r center points:

    Attributes
    ----------
    node_kind : (k,) int8
        MINIMUM, SADDLE or MAXIMUM; ``graph.critical.KINDS`` has their names.
    node_value : (k,) float64
        Value of the field at each node, 0..1: of the field whose level sets were taken, and in a ``Decomposition`` of
        the normalized field.
    node_position : (k, 3) float64
        Position of each node, in units of the vertices: on the surface for a minimum or maximum, for a saddle
        the middle, by area, of the slab pieces that it stands for.
    arcs : (q, 2) int64
        Lower and upper node of each arc. Two nodes may share several arcs, which form loops.
    arc_points : (q + 1,) int64
        Arc i owns the center points arc_points[i]:arc_points[i + 1], from low to high.
    point_position : (r, 3) float64
        Centroid of the contour that each center point stands for, in units of the vertices.
    point_radius : (r,) float64
        Mean distance of this contour from its centroid, in units of the vertices.
    point_length : (r,) float64
        Length of this contour, in units of the vertices.
    point_value : (r,) float64
        Value of the field at this contour, as ``node_value``.
    n_components : int
        Number of connected components of the graph.
    """

    node_kind: np.ndarray
    node_value: np.ndarray
    node_position: np.ndarray
    arcs: np.ndarray
    arc_points: np.ndarray
    point_position: np.ndarray
    point_radius: np.ndarray
    point_length: np.ndarray
    point_value: np.ndarray
    n_components: int

    def __repr__(self) -> str:
        return f"<ReebGraph: {self.n_nodes} nodes, {self.n_arcs} arcs, {self.n_loops} loops>"

    @property
    def n_nodes(self) -> int:
        """Number of nodes, k."""
        return len(self.node_kind)

    @property
    def n_arcs(self) -> int:
        """Number of arcs, q."""
        return len(self.arcs)

    @property
    def n_loops(self) -> int:
        """Number of independent loops (first Betti number).

        Of a closed orientable surface its genus, but for loops thinner than a slab, and for surfaces that are so even
        that the graph is one node: a thin ring has none.
        """
        return self.n_arcs - self.n_nodes + self.n_components

    @cached_property
    def point_arc(self) -> np.ndarray:
        """(r,) int64, arc of each center point."""
        return np.repeat(arange(self.n_arcs), np.diff(self.arc_points))

    @classmethod
    def empty(cls) -> ReebGraph:
        """Make the graph of no component: returns a ReebGraph without nodes and arcs."""
        number, place, index = np.empty(0), np.empty((0, 3)), np.zeros(1, np.int64)
        return cls(np.empty(0, np.int8), number, place, np.empty((0, 2), np.int64), index, place,
                   number, number, number, 0)

    @classmethod
    def join(cls, graphs: list[ReebGraph]) -> ReebGraph:
        """Put the graphs of several components into one graph.

        graphs : list of ReebGraph; may be empty. Returns a ReebGraph in which nodes, arcs and center points follow
        the order of the list.
        """
        graphs = [cls.empty(), *graphs]
        nodes = cumsum([0] + [g.n_nodes for g in graphs])
        points = cumsum([0] + [len(g.point_value) for g in graphs])
        arrays = {
            name: np.concatenate([getattr(g, name) for g in graphs])
            for name in ("node_kind", "node_value", "node_position", "point_position",
                         "point_radius", "point_length", "point_value")
        }
        arcs = np.concatenate([g.arcs + n for g, n in zip(graphs, nodes, strict=False)])
        offsets = [g.arc_points[:-1] + p for g, p in zip(graphs, points, strict=False)]
        return cls(arcs=arcs, arc_points=np.concatenate([*offsets, points[-1:]]),
                   n_components=sum(g.n_components for g in graphs), **arrays)


@dataclass(frozen=True, eq=False)
class ReebTopology:
    """The nodes and arcs of a Reeb graph, and the slab pieces and contours of the surface that belong to them.

    With P slab pieces, C contours, k nodes and q arcs:

    Attributes
    ----------
    piece_node : (P,) int64
        Node to which each slab piece belongs; -1 for one of an arc.
    piece_arc : (P,) int64
        Arc to which each slab piece belongs; -1 for one of a node.
    contour_arc : (C,) int64
        Arc to which each contour belongs; -1 for a contour of a cancelled leaf.
    arcs : (q, 2) int64
        Lower and upper node of each arc.
    n_nodes : int
        k.
    """

    piece_node: np.ndarray
    piece_arc: np.ndarray
    contour_arc: np.ndarray
    arcs: np.ndarray
    n_nodes: int

    def arc_contours(self, sets: LevelSets) -> tuple[np.ndarray, np.ndarray]:
        """List the contours of every arc from low to high, one arc after the other.

        Parameters
        ----------
        sets : LevelSets
            The level sets from which the topology was made.

        Returns
        -------
        contours : (r,) int64
            Contours of ``sets``.
        start : (q + 1,) int64
            Arc i owns contours[start[i]:start[i + 1]].
        """
        kept = np.flatnonzero(self.contour_arc >= 0)
        order = np.lexsort((sets.contour_level[kept], self.contour_arc[kept]))
        contours = kept[order]
        return contours, np.searchsorted(self.contour_arc[contours], arange(len(self.arcs) + 1))


def reeb_topology(sets: LevelSets) -> ReebTopology:
    """Make the Reeb graph: contract chains of slab pieces with one contour below and one above to arcs.

    Parameters
    ----------
    sets : LevelSets
        P slab pieces, C contours.

    Returns
    -------
    topology : ReebTopology

    Notes
    -----
    O(P + C), whole arrays.
    """
    lower, upper = sets.contour_pieces.T
    n_below = np.bincount(upper, minlength=sets.n_pieces)
    n_above = np.bincount(lower, minlength=sets.n_pieces)
    regular = (n_below == 1) & (n_above == 1)
    below = np.zeros(sets.n_pieces, np.int64)
    above = np.zeros(sets.n_pieces, np.int64)
    below[upper] = arange(sets.n_contours)
    above[lower] = arange(sets.n_contours)
    n_arcs, contour_arc = components(sets.n_contours, below[regular], above[regular])

    piece_node = place_among(np.flatnonzero(~regular), sets.n_pieces)
    piece_arc = full(sets.n_pieces, -1)
    piece_arc[regular] = contour_arc[below[regular]]
    arcs = np.empty((n_arcs, 2), np.int64)
    bottom, top = piece_node[lower] >= 0, piece_node[upper] >= 0
    arcs[contour_arc[bottom], 0] = piece_node[lower[bottom]]
    arcs[contour_arc[top], 1] = piece_node[upper[top]]
    return ReebTopology(piece_node, piece_arc, contour_arc, arcs, int((~regular).sum()))


def reeb_graph(sets: LevelSets, topology: ReebTopology) -> ReebGraph:
    """Give the nodes of a Reeb graph their kinds, values and positions, and its arcs their center lines.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component.
    topology : ReebTopology
        Nodes and arcs of these level sets, simplified or not.

    Returns
    -------
    graph : ReebGraph
    """
    n_below = np.bincount(topology.arcs[:, 1], minlength=topology.n_nodes)
    n_above = np.bincount(topology.arcs[:, 0], minlength=topology.n_nodes)
    kind = np.where(n_below == 0, MINIMUM, np.where(n_above == 0, MAXIMUM, SADDLE)).astype(np.int8)
    tip = _tip_vertices(sets, topology, kind)
    middle, position = _node_means(sets, topology)
    value = _saddle_values(sets, topology, middle)
    has_tip = tip >= 0
    value[has_tip] = sets.values[tip[has_tip]]
    position[has_tip] = sets.mesh.vertices[tip[has_tip]]

    contour, arc_points = topology.arc_contours(sets)
    level = sets.levels[sets.contour_level[contour]]
    value = _between_arcs(value, topology.arcs, level[arc_points[:-1]], level[arc_points[1:] - 1])
    return ReebGraph(
        node_kind=kind, node_value=value, node_position=position, arcs=topology.arcs,
        arc_points=arc_points,
        point_position=sets.contour_center[contour], point_radius=sets.contour_radius[contour],
        point_length=sets.contour_length[contour],
        point_value=level,
        n_components=components(topology.n_nodes, *topology.arcs.T)[0])


def _between_arcs(value: np.ndarray, arcs: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Values of nodes, (k,), above the last level of every arc below the node and below the first of every arc above.

    A node that has taken in a cancelled leaf has critical vertices out there, too. first, last : (q,) float64.
    """
    lowest, highest = np.full(len(value), -np.inf), np.full(len(value), np.inf)
    np.maximum.at(lowest, arcs[:, 1], last)
    np.minimum.at(highest, arcs[:, 0], first)
    return np.clip(value, lowest, highest)


def _tip_vertices(sets: LevelSets, topology: ReebTopology, kind: np.ndarray) -> np.ndarray:
    """Vertex of lowest value of each minimum and of highest value of each maximum, (k,) int64; -1 for a saddle."""
    node = topology.piece_node[sets.vertex_piece]
    inside = np.flatnonzero(node >= 0)
    value = sets.values[inside]
    highest = last_of_each(node[inside], value, inside, count=len(kind))
    lowest = last_of_each(node[inside], -value, -inside, count=len(kind))
    tip = np.append(inside, -1)[np.where(kind == MINIMUM, lowest, highest)]
    return np.where(kind == SADDLE, -1, tip)


def _saddle_values(sets: LevelSets, topology: ReebTopology, middle: np.ndarray) -> np.ndarray:
    """Value of the field at the saddle vertex of each node, (k,) float64.

    Of several saddle vertices of a node, the one of the highest multiplicity counts, then the one whose value is
    nearest to the node's mean level. A node without a saddle vertex (a loop within one slab, a border) has its mean
    level. middle : (k,) float64, mean level of each node.
    """
    critical = critical_points(sets.mesh, total_order(sets.values))
    node = topology.piece_node[sets.vertex_piece[critical.vertex]]
    saddle = (critical.kind == SADDLE) & (node >= 0)
    node, vertex = node[saddle], critical.vertex[saddle]
    off = np.abs(sets.values[vertex] - middle[node])
    best = last_of_each(node, critical.multiplicity[saddle], -off, vertex, count=len(middle))
    return np.where(best >= 0, np.append(sets.values[vertex], 0.0)[best], middle)


def _node_means(sets: LevelSets, topology: ReebTopology) -> tuple[np.ndarray, np.ndarray]:
    """Mean level, (k,), and mean position, (k, 3), of each node's slab pieces, weighted by area."""
    node = topology.piece_node[sets.element_piece]
    inside = node >= 0
    bounds = np.concatenate([[0.0], sets.levels, [1.0]])
    middles = ((bounds[:-1] + bounds[1:]) / 2)[sets.element_slab[inside]]
    centers = sets.mesh.face_centroids[sets.element_face[inside]]
    _, means = middles_of_each(
        node[inside], np.column_stack([middles, centers]), sets.element_weight[inside], topology.n_nodes)
    return means[:, 0], means[:, 1:]
