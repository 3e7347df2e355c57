# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams along which each part can be unfolded into the plane: parts are opened until they are discs that lie flat."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra, minimum_spanning_tree

from ...arrays.components import components
from ...arrays.indexing import largest_of_each, last_of_each
from ...arrays.int64 import arange, full
from ...arrays.pairs import edge_keys
from ...mesh.corners import CornerTable
from .conformal import ConformalFactor

# Areas shall lie in the plane at 0.3 to 3 times their size: a conformal map whose scale of lengths is exp(u) does that
# where u is between -0.6 and 0.55. Blender's methods, which give up some of the angles for areas, stay well within.
_UNEVEN = 0.6
# Each round cuts each uneven chart from its most uneven place, and from all others that are at least so much as uneven:
# the fingers of a hand all at once. Of 41 models none took more than 14 rounds, most of them 3 to 6.
_ROUNDS, _AS_UNEVEN = 40, 0.7
# A seam costs its length, and half as much again where everyone sees it: on the outside of a limb. It costs half as
# much on the inside, and half as much along a crease of 60 degrees or more.
_SEEN, _CREASED, _SHARP = 0.5, 0.5, np.pi / 3


def unfolding_seams(table: CornerTable, cut: np.ndarray) -> np.ndarray:
    """Find edges that, cut in addition to given ones, let every chart lie flat with areas near their size.

    A chart is a connected set of faces between cuts. Charts are opened to discs, see ``opening_seams``. For each disc,
    the map that keeps all angles and whose border keeps its length tells where areas would shrink or grow most, see
    ``ConformalFactor``; from there a seam goes to the nearest cut, as in [Gu2002], until none would shrink or grow
    to less than a third or more than three times.

    Parameters
    ----------
    table : CornerTable
        e edges.
    cut : (e,) bool
        Edges that are cut already. Edges that do not have exactly two faces count as cut.

    Returns
    -------
    seams : (e,) bool
        Edges to be cut in addition. They run along creases and on the inner sides of limbs rather than where the
        model shows them.
    """
    cost = seam_cost(table)
    seams = opening_seams(table, cut, cost)
    charts = _Charts.of(table, cut | seams)
    factor = ConformalFactor.of(table)
    fixed = np.zeros(len(table.vertices), bool)
    fixed[np.union1d(charts.roots, table.edges[charts.border].ravel())] = True
    uneven = np.ones(charts.count, bool)
    for _ in range(_ROUNDS):
        inner = charts.inner[uneven[charts.of_face[charts.pairs[:, 0]]] & ~seams[charts.inner]]
        used = np.zeros(len(table.vertices), bool)  # 20 times as fast as to sort them
        used[table.edges[inner]] = True
        scale = np.abs(factor.solve(np.flatnonzero(used & ~fixed)))
        worst = _most_uneven(charts, scale, table.edges[inner])
        if not len(worst):
            break
        uneven = np.isin(arange(charts.count), charts.of_vertex[worst])
        _, before, _ = _shortest_paths(len(table.vertices), table.edges, cost, inner, np.flatnonzero(used & fixed))
        _follow(seams, worst, before, table.edges)
        fixed[table.edges[seams].ravel()] = True
    return seams


def _most_uneven(charts: _Charts, scale: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Vertices to cut from: the most uneven one of each connected uneven place, unless its chart has much worse ones.

    scale : (n,), how uneven each vertex is, 0 or more. edges : (i, 2), inside of charts. Returns (k,) int64.
    """
    high = scale > _UNEVEN
    count, place = components(len(scale), *edges[high[edges].all(axis=1)].T)
    worst = last_of_each(place, np.where(high, scale, 0.0), charts.from_middle, count=count)
    worst = worst[high[worst]]
    chart = charts.of_vertex[worst]
    return worst[scale[worst] >= _AS_UNEVEN * largest_of_each(chart, scale[worst], charts.count)[chart]]


def opening_seams(table: CornerTable, cut: np.ndarray, cost: np.ndarray | None = None) -> np.ndarray:
    """Find edges that, cut in addition to given ones, open every chart to a disc.

    Tubes are cut lengthwise, closed charts from one end to the other, and handles are opened. The new seams are
    cheap, after [Erickson2005]: one tree consists of the cheapest paths from all vertices to the cuts, and a second
    tree joins faces across edges as far as possible from the cuts. Each edge that is in neither tree is a seam,
    together with the cheapest paths from its two ends to the cuts.

    Parameters
    ----------
    table : CornerTable
        e edges.
    cut : (e,) bool
        Edges that are cut already. Edges that do not have exactly two faces count as cut.
    cost : (e,) float64, optional
        What a seam along each edge costs; by default its length.

    Returns
    -------
    seams : (e,) bool
        Edges to be cut in addition.
    """
    edges = table.edges
    cost = table.edge_length(arange(len(edges))) if cost is None else cost
    charts = _Charts.of(table, cut)
    distance, before, tree = _shortest_paths(len(table.vertices), edges, cost, charts.inner, charts.roots)
    inner, pairs = charts.inner, charts.pairs
    crossed = _in_cotree(pairs, distance[edges[inner]].sum(axis=1) + cost[inner], tree[inner], table.n_faces)
    rest = np.flatnonzero(~crossed & ~tree[inner])
    seams = np.zeros(len(edges), bool)
    seams[inner[rest]] = True
    whole = charts.closed.copy()
    whole[charts.of_face[pairs[rest, 0]]] = False
    reached = np.where(np.isfinite(distance), distance, -1.0)
    far = last_of_each(charts.of_vertex, reached, charts.from_middle, count=charts.count)
    _follow(seams, np.concatenate([edges[inner[rest]].ravel(), far[whole]]), before, edges)
    return seams


def seam_cost(table: CornerTable) -> np.ndarray:
    """Cost of a seam along each edge: its length, less in creases and where the model hides it.

    A face is hidden as far as it looks toward the middle of the surface, as the inner sides of arms and legs do.

    Parameters
    ----------
    table : CornerTable
        e edges.

    Returns
    -------
    cost : (e,) float64
        In the unit of the vertices; more than 0 for an edge that has a length.
    """
    vector = table.face_vectors()
    area = np.linalg.norm(vector, axis=1)
    normal = vector / np.maximum(area, np.finfo(float).tiny)[:, None]
    center = table.face_means(table.vertices)
    to_middle = (area[:, None] * center).sum(axis=0) / max(area.sum(), np.finfo(float).tiny) - center
    distance = np.linalg.norm(to_middle, axis=1)
    hidden = (normal * to_middle).sum(axis=1) / np.maximum(distance, np.finfo(float).tiny)
    pairs, edge = table.face_pairs()
    angle = np.zeros(len(table.edges))
    angle[edge] = np.arccos((normal[pairs[:, 0]] * normal[pairs[:, 1]]).sum(axis=1).clip(-1.0, 1.0))
    faces_at = table.n_edge_faces
    seen = -np.bincount(table.corner_edge, hidden[table.corner_face], len(table.edges)) / np.maximum(faces_at, 1)
    return table.edge_length(arange(len(table.edges))) * (
        (1 - _CREASED * np.minimum(angle / _SHARP, 1.0)) * (1 + _SEEN * seen))


@dataclass(frozen=True, eq=False)
class _Charts:
    """The charts that cuts leave: ``inner``, (i,), edges that are not cut; ``pairs``, (i, 2), their faces; ``border``
    (b,), all others that have faces; chart ``of_face``, (p,), and ``of_vertex``, (n,), for a vertex on a cut one of
    those that meet there; ``closed``, (count,), without a border; ``roots``, (r,), rising: vertices on cuts, and of
    each closed chart the one that is farthest ``from_middle``, (n,).
    """

    inner: np.ndarray
    pairs: np.ndarray
    border: np.ndarray
    of_face: np.ndarray
    of_vertex: np.ndarray
    closed: np.ndarray
    from_middle: np.ndarray
    roots: np.ndarray

    @property
    def count(self) -> int:
        """Number of charts."""
        return len(self.closed)

    @classmethod
    def of(cls, table: CornerTable, cut: np.ndarray) -> _Charts:
        """cut : (e,) bool; edges that do not have exactly two faces count as cut."""
        faces_at = table.n_edge_faces
        inner = np.flatnonzero((faces_at == 2) & ~cut)
        border = np.flatnonzero((faces_at > 0) & ((faces_at != 2) | cut))
        pairs, edge = table.face_pairs()
        pairs = pairs[np.searchsorted(edge, inner)]
        count, of_face = components(table.n_faces, *pairs.T)
        of_vertex = np.zeros(len(table.vertices), np.int64)
        of_vertex[table.corner_vertex] = of_face[table.corner_face]
        used = np.unique(table.corner_vertex)
        middle = table.vertices[used].mean(axis=0) if len(used) else np.zeros(3)
        from_middle = np.zeros(len(table.vertices))
        from_middle[used] = np.linalg.norm(table.vertices[used] - middle, axis=1)
        closed = np.ones(count, bool)
        closed[of_face[table.corner_face[np.isin(table.corner_edge, border)]]] = False
        farthest = last_of_each(of_vertex[used], from_middle[used], count=count)
        roots = np.union1d(table.edges[border].ravel(), used[farthest[closed & (farthest >= 0)]])
        return cls(inner, pairs, border, of_face, of_vertex, closed, from_middle, roots)


def _shortest_paths(
    n: int, edges: np.ndarray, length: np.ndarray, inner: np.ndarray, roots: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Shortest paths along inner edges from every vertex to the nearest root.

    Returns the distance of each vertex, (n,), the first edge of its path, (n,), -1 for none, and whether each edge
    belongs to a path, (e,) bool.
    """
    key = edge_keys(*edges[inner].T, count=n)
    order = np.argsort(key)
    weight = length[inner] + 1e-9 * length.max(initial=1.0)  # of paths of one length that of fewest edges
    graph = coo_matrix((weight, edges[inner].T), (n, n)).tocsr()
    distance, previous, _ = dijkstra(
        graph, directed=False, indices=roots, return_predecessors=True, min_only=True
    )
    before = full(n, -1)
    reached = np.flatnonzero(previous >= 0)
    step = edge_keys(reached, previous[reached], count=n)
    before[reached] = inner[order[np.searchsorted(key[order], step)]]
    tree = np.zeros(len(edges), bool)
    tree[before[reached]] = True
    return distance, before, tree


def _in_cotree(pairs: np.ndarray, weight: np.ndarray, tree: np.ndarray, n_faces: int) -> np.ndarray:
    """Whether the tree of faces crosses each inner edge, (i,) bool; it prefers edges of great weight.

    pairs : (i, 2), faces at each inner edge. tree : (i,) bool, edges of shortest paths, which it must not cross.
    """
    free = np.flatnonzero(~tree)
    graph = coo_matrix((2 * weight.max(initial=1.0) - weight[free], pairs[free].T), (n_faces, n_faces)).tocsr()
    kept = minimum_spanning_tree(graph).tocoo()
    key = edge_keys(*pairs[free].T, count=n_faces)
    crossed = np.zeros(len(pairs), bool)
    # Where two faces share several edges, the tree crosses the first of them only.
    _, first = np.unique(key, return_index=True)
    taken = np.isin(key[first], edge_keys(kept.row, kept.col, count=n_faces))
    crossed[free[first[taken]]] = True
    return crossed


def _follow(seams: np.ndarray, ends: np.ndarray, before: np.ndarray, edges: np.ndarray) -> None:
    """Mark, in ``seams``, the edges of the shortest paths from some vertices to the cuts."""
    for vertex in np.unique(ends).tolist():
        while before[vertex] >= 0:
            edge = before[vertex]
            seams[edge] = True
            a, b = edges[edge].tolist()
            vertex = b if a == vertex else a
