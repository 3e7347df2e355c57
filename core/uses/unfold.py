# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams along which each part can be unfolded into the plane: parts are opened until they are discs."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components, dijkstra, minimum_spanning_tree

from ..surface.corners import CornerTable

# A disc is opened too if the distance of its farthest vertex from its border is more than this share of the length of
# the border. For a hemisphere the ratio is 0.25.
_DEEP = 0.5


def opening_seams(table: CornerTable, cut: np.ndarray) -> np.ndarray:
    """Find edges that, cut in addition to given ones, open every chart to a disc that is not deep.

    A chart is a connected set of faces between cuts. Tubes are cut lengthwise, closed charts from one end to the other,
    and handles are opened. The new seams are short, after [Erickson2005]: one tree consists of the shortest paths from
    all vertices to the cuts, and a second tree joins faces across edges as far as possible from the cuts. Each edge
    that is in neither tree is a seam, together with the shortest paths from its two ends to the cuts.

    Parameters
    ----------
    table : CornerTable
        e edges.
    cut : (e,) bool
        Edges that are cut already. Edges that do not have exactly two faces count as cut.

    Returns
    -------
    seams : (e,) bool
        Edges to be cut in addition.
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
    around[of_face[pairs[rest, 0]]] = np.inf  # these charts are opened by their seams
    ends = np.concatenate([edges[inner[rest]].ravel(), _deep_ends(of_vertex, distance, around)])
    _follow(seams, ends, before, edges)
    return seams


def _charts(
    n: int, n_faces: int, pairs: np.ndarray, corner_ends: np.ndarray, corner_face: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Chart of each face, (p,), and of each vertex, (n,); a vertex on a cut gets one of the charts that meet there.

    pairs : (i, 2), faces that share an inner edge. corner_ends : (c, 2), vertices of the edge of each corner.
    """
    graph = coo_matrix((np.ones(len(pairs)), pairs.T), (n_faces, n_faces))
    _, of_face = connected_components(graph, directed=False)
    of_vertex = np.zeros(n, np.int64)
    of_vertex[corner_ends.ravel()] = np.repeat(of_face[corner_face], 2)
    return of_face, of_vertex


def _roots(chart: np.ndarray, on_border: np.ndarray) -> np.ndarray:
    """Vertices on cuts, and one vertex of every closed chart: (r,), rising."""
    closed = np.ones(int(chart.max(initial=0)) + 1, bool)
    closed[chart[on_border]] = False
    _, first = np.unique(chart, return_index=True)
    return np.union1d(on_border, first[closed[chart[first]]])


def _shortest_paths(
    n: int, edges: np.ndarray, length: np.ndarray, inner: np.ndarray, roots: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Shortest paths along inner edges from every vertex to the nearest root.

    Returns the distance of each vertex, (n,), the first edge of its path, (n,), -1 for none, and whether each edge
    belongs to a path, (e,) bool.
    """
    key = np.sort(edges[inner], axis=1) @ (n, 1)
    order = np.argsort(key)
    weight = length[inner] + 1e-9 * length.max(initial=1.0)  # SciPy takes a length of 0 for "no edge"
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


def _in_cotree(pairs: np.ndarray, weight: np.ndarray, tree: np.ndarray, n_faces: int) -> np.ndarray:
    """Whether the tree of faces crosses each inner edge, (i,) bool; it prefers edges of great weight.

    pairs : (i, 2), faces at each inner edge. tree : (i,) bool, edges of shortest paths, which it must not cross.
    """
    free = np.flatnonzero(~tree)
    graph = coo_matrix((2 * weight.max(initial=1.0) - weight[free], pairs[free].T), (n_faces, n_faces)).tocsr()
    kept = minimum_spanning_tree(graph).tocoo()
    key = np.sort(pairs[free], axis=1) @ (n_faces, 1)
    crossed = np.zeros(len(pairs), bool)
    # Where two faces share several edges, the tree crosses the first of them only.
    _, first = np.unique(key, return_index=True)
    taken = np.isin(key[first], np.sort(np.stack([kept.row, kept.col], axis=1), axis=1) @ (n_faces, 1))
    crossed[free[first[taken]]] = True
    return crossed


def _deep_ends(chart: np.ndarray, distance: np.ndarray, around: np.ndarray) -> np.ndarray:
    """Vertex farthest from the cuts of each deep chart, (d,). around : length of the border of each chart."""
    distance = np.where(np.isfinite(distance), distance, -1.0)
    order = np.lexsort((distance, chart))
    last = order[np.append(np.flatnonzero(np.diff(chart[order])), len(order) - 1)] if len(order) else order
    return last[distance[last] > _DEEP * around[chart[last]]]


def _follow(seams: np.ndarray, ends: np.ndarray, before: np.ndarray, edges: np.ndarray) -> None:
    """Mark, in ``seams``, the edges of the shortest paths from some vertices to the cuts."""
    for vertex in np.unique(ends).tolist():
        while before[vertex] >= 0:
            edge = before[vertex]
            seams[edge] = True
            a, b = edges[edge].tolist()
            vertex = b if a == vertex else a
