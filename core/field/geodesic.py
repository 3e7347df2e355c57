# SPDX-License-Identifier: GPL-3.0-or-later
"""Geodesic distances over the surface: a solver is set up once per mesh and then asked for many sources."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from ..arrays.indexing import run_starts, stable_order, taken
from ..arrays.pairs import edge_keys, symmetric_matrix
from ..arrays.vectors import distances_between, lengths, row_products
from ..errors import DisconnectedMeshError
from ..mesh.triangles import ON_A_LINE, TriMesh
from ..sentence import Sentence
from .sight import lines_in_sight


class GeodesicSolver:
    """Shortest paths along edges and across pairs of triangles.

    Eqs. (4)-(6) of docs/method.md, with one addition to paths along edges: a path may also cross an edge, along the
    straight line between the far corners of the edge's two triangles when these are unfolded into a plane, and more
    edges where directions would be far apart otherwise (``sight``). Path lengths are then much closer to true geodesic
    distances, above all on coarse meshes and needles.

    Parameters
    ----------
    mesh : TriMesh
        n vertices.
    links : (l, 2) int64, optional
        Pairs of vertices that paths may also join by a straight line.
    """

    def __init__(self, mesh: TriMesh, links: np.ndarray | None = None) -> None:
        self.mesh = mesh
        self.graph = _path_graph(mesh, np.empty((0, 2), np.int64) if links is None else links)

    def distances(self, source: int) -> np.ndarray:
        """Measure the distance of every vertex from one vertex.

        Parameters
        ----------
        source : int
            Index of that vertex.

        Returns
        -------
        distance : (n,) float64
            In the unit of the vertices. Without links never shorter than the true geodesic distance, but for
            rounding errors.

        Raises
        ------
        DisconnectedMeshError
            Some vertex cannot be reached; ``error.vertices`` lists them.

        Notes
        -----
        O(n log n) time.
        """
        # The graph has both directions of each edge; directed=True keeps SciPy from transposing it.
        distance = dijkstra(self.graph, directed=True, indices=int(source))
        lost = np.flatnonzero(np.isinf(distance))
        if len(lost):
            raise DisconnectedMeshError(
                Sentence("{n} {n:vertex|vertices} cannot be reached from vertex {source}.",
                         n=len(lost), source=source), vertices=lost)
        return distance


def _path_graph(mesh: TriMesh, links: np.ndarray) -> csr_array:
    """Symmetric (n, n) matrix of the lengths of edges, links and lines across unfolded triangles."""
    c, d, across = _unfolded_lines(mesh)
    source, target, seen = lines_in_sight(mesh)
    rows = np.concatenate([mesh.edges.vertices[:, 0], c, source, links[:, 0]])
    columns = np.concatenate([mesh.edges.vertices[:, 1], d, target, links[:, 1]])
    straight = distances_between(mesh.vertices, *links.T)
    length = np.concatenate([mesh.edge_length, across, seen, straight])
    return _shortest_of(rows, columns, length, mesh.n_vertices)


def _shortest_of(rows: np.ndarray, columns: np.ndarray, length: np.ndarray, n: int) -> csr_array:
    """Symmetric (n, n) matrix with the shortest of the lengths that are given for each pair, in either direction."""
    key = edge_keys(rows, columns, count=n)
    order = stable_order(key)
    key = key[order]
    first = run_starts(key)
    low, high = np.divmod(key[first], n)
    return symmetric_matrix(np.stack([low, high], axis=1), np.minimum.reduceat(length[order], first), n)


def _unfolded_lines(mesh: TriMesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Far corners of each two triangles whose straight line crosses the shared edge, and its length; (k,) each."""
    pairs, edge = mesh.edges.pairs, mesh.edges.pair_edge
    a, b = taken(mesh.edges.vertices, edge).T
    far = taken(mesh.faces.sum(axis=1), pairs) - (a + b)[:, None]  # the corner that is not on the shared edge
    origin, length = taken(mesh.vertices, a), mesh.edge_length[edge]
    safe = np.where(length > 0, length, 1.0)
    along = (taken(mesh.vertices, b) - origin) / safe[:, None]
    x, y = [], []
    for corner in far.T:
        offset = taken(mesh.vertices, corner) - origin
        x.append(row_products(offset, along))
        y.append(lengths(offset - x[-1][:, None] * along))
    height = y[0] + y[1]
    crossing = x[0] + (x[1] - x[0]) * np.divide(y[0], height, out=np.zeros_like(height),
                                                where=height > 0)
    # Where both triangles lie on the line of their edge, but for rounding, nothing can be said of the crossing.
    inside = (crossing > 0) & (crossing < length) & (height > ON_A_LINE * length)
    line = np.hypot(x[1] - x[0], height)
    return far[inside, 0], far[inside, 1], line[inside]
