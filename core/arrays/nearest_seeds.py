# SPDX-License-Identifier: GPL-3.0-or-later
"""The nearest of several seeds along the ways of a graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse.csgraph import dijkstra

if TYPE_CHECKING:
    from scipy.sparse import csr_array


def nearest_seeds(graph: csr_array, seeds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find how far each node is from the nearest seed, and which that is.

    Parameters
    ----------
    graph : (n, n) scipy.sparse.csr_array
        Symmetric; lengths of ways between neighbors whose sums are exact, see ``ties.whole_steps``.
    seeds : (k,) int64
        Nodes.

    Returns
    -------
    distance : (n,) float64
        Infinite where no seed can be reached.
    seed : (n,) int64
        Of equally near seeds the one of lowest index; -1 where none can be reached.

    Notes
    -----
    O(n log n), and O(n) for each step along the longest chain of nodes that are as near to another seed: which of
    these SciPy's search names differs from version to version.
    """
    distance, _, seed = dijkstra(graph, directed=True, indices=seeds, min_only=True, return_predecessors=True)
    seed = np.maximum(seed.astype(np.int64), -1)  # SciPy's own number for none is -9999
    ways = graph.tocoo()
    a, b, length = ways.row, ways.col, ways.data
    # Shortest ways end with one of these steps; a node is as near to the seeds of all nodes before it.
    last = np.isfinite(distance[a]) & (distance[a] + length == distance[b])
    a, b = a[last], b[last]
    while True:
        lower = seed[a] < seed[b]
        if not lower.any():
            return distance, seed
        np.minimum.at(seed, b[lower], seed[a[lower]])
