# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams that let each part be unfolded into the plane: parts are opened until they are discs."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components, dijkstra, minimum_spanning_tree

from ..surface.corners import CornerTable

# A disc is opened too, like the sleeve of a shirt, if it is deeper than this share of its border is long;
# a hemisphere is as deep as a quarter.
_DEEP = 0.5


def opening_seams(table: CornerTable, cut: np.ndarray) -> np.ndarray:
    """Edges to cut beside given ones so that every chart is a disc, and no deep one.

    Tubes are cut along, closed charts from one end to the other, handles open. The new seams are short:
    after [Erickson2005], a tree of shortest paths to the cuts, and a tree of faces that crosses the
    edges farthest from them; each edge that is in neither closes a seam.

    Parameters
    ----------
    table : CornerTable
        With e edges.
    cut : (e,) bool
        Where charts end already. Edges that do not have two faces count as cut.

    Returns
    -------
    seams : (e,) bool
        The new ones.
    """
    vertices, edges, corner_edge, corner_face = table.vertices, table.edges, table.corner_edge, table.corner_face
    faces_at = np.bincount(corner_edge, minlength=len(edges))
    inner = np.flatnonzero((faces_at == 2) & ~cut)
    border = np.flatnonzero((faces_at > 0) & ((faces_at != 2) | cut))
    length = table.edge_length(np.arange(len(edges)))
    pairs, edge = table.face_pairs()
    pairs = pairs[np.searchsorted(edge, inner)]
    n_faces = table.n_faces
    of_face, of_vertex = _charts(len(vertices), n_faces, pairs, edges[corner_edge], corner_face)
    roots = _roots(of_vertex, edges[border].ravel())
    distance, before, tree = _shortest_paths(len(vertices), edges, length, inner, roots)
    crossed = _in_cotree(pairs, distance[edges[inner]].sum(axis=1) + length[inner], tree[inner], n_faces)
    rest = np.flatnonzero(~crossed & ~tree[inner])
    seams = np.zeros(len(edges), bool)
    seams[inner[rest]] = True
    outer = np.isin(corner_edge, border)
    around = np.bincount(of_face[corner_face[outer]], length[corner_edge[outer]], n_faces).astype(float)
    around[of_face[pairs[rest, 0]]] = np.inf  # opened already
    ends = np.concatenate([edges[inner[rest]].ravel(), _deep_ends(of_vertex, distance, around)])
    _follow(seams, ends, before, edges)
    return seams


def _charts(n, n_faces, pairs, corner_ends, corner_face):
    """The chart of each face; and of each vertex, for one that lies on a cut any that meets it."""
    graph = coo_matrix((np.ones(len(pairs)), pairs.T), (n_faces, n_faces))
    _, of_face = connected_components(graph, directed=False)
    of_vertex = np.zeros(n, np.int64)
    of_vertex[corner_ends.ravel()] = np.repeat(of_face[corner_face], 2)
    return of_face, of_vertex


def _roots(chart, on_border):
    """Vertices on cuts, and one of every closed chart."""
    closed = np.ones(int(chart.max(initial=0)) + 1, bool)
    closed[chart[on_border]] = False
    _, first = np.unique(chart, return_index=True)
    return np.union1d(on_border, first[closed[chart[first]]])


def _shortest_paths(n, edges, length, inner, roots):
    """Distance of each vertex to the roots, the edge that leads there (-1: none), and which edges do."""
    key = np.sort(edges[inner], axis=1) @ (n, 1)
    order = np.argsort(key)
    weight = length[inner] + 1e-9 * length.max(initial=1.0)  # a path of no length would be no path
    graph = coo_matrix((weight, edges[inner].T), (n, n)).tocsr()
    distance, previous, _ = dijkstra(
        graph, directed=False, indices=roots, return_predecessors=True, min_only=True
    )
    before = np.full(n, -1)
    reached = np.flatnonzero(previous >= 0)
    step = np.sort(np.stack([reached, previous[reached]], axis=1), axis=1) @ (n, 1)
    before[reached] = inner[order[np.searchsorted(key[order], step)]]
    tree = np.zeros(len(edges), bool)
    tree[before[reached]] = True
    return distance, before, tree


def _in_cotree(pairs, weight, tree, n_faces):
    """Whether the tree of faces crosses each inner edge; it prefers edges of great weight. (i,) bool."""
    free = np.flatnonzero(~tree)
    graph = coo_matrix((2 * weight.max(initial=1.0) - weight[free], pairs[free].T), (n_faces, n_faces)).tocsr()
    kept = minimum_spanning_tree(graph).tocoo()
    key = np.sort(pairs[free], axis=1) @ (n_faces, 1)
    crossed = np.zeros(len(pairs), bool)
    # Of two edges between the same faces, the tree crosses one.
    _, first = np.unique(key, return_index=True)
    taken = np.isin(key[first], np.sort(np.stack([kept.row, kept.col], axis=1), axis=1) @ (n_faces, 1))
    crossed[free[first[taken]]] = True
    return crossed


def _deep_ends(chart, distance, around):
    """The farthest vertex of each chart that is deep for the length of its border."""
    distance = np.where(np.isfinite(distance), distance, -1.0)
    order = np.lexsort((distance, chart))
    last = order[np.append(np.flatnonzero(np.diff(chart[order])), len(order) - 1)] if len(order) else order
    return last[distance[last] > _DEEP * around[chart[last]]]


def _follow(seams, ends, before, edges):
    """Mark the paths from some vertices to the cuts."""
    for vertex in np.unique(ends).tolist():
        while before[vertex] >= 0:
            edge = before[vertex]
            seams[edge] = True
            a, b = edges[edge].tolist()
            vertex = b if a == vertex else a
