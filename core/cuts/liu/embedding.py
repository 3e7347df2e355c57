# SPDX-License-Identifier: GPL-3.0-or-later
"""Planar spectral embeddings of patches: one of their structure, one of their concavities."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import diags_array

from ...arrays.pairs import symmetric_matrix
from .patch_graph import PatchGraph

# A border counts exp(-crease / SHARP) in the geometric operator, where creases are in units of 1 / square root of the
# area.
SHARP = 3.0


def structural(graph: PatchGraph) -> np.ndarray:
    """Embed patches by the graph Laplacian: borders count by their length over the way across them.

    graph : PatchGraph, connected, k patches, 3 or more. Returns (k, 2) float64, see ``embed``.
    """
    return embed(graph, graph.length / graph.way)


def geometric(graph: PatchGraph) -> np.ndarray:
    """Embed patches by an operator in which a border counts the less the deeper its crease is.

    graph : PatchGraph, connected, k patches, 3 or more. Returns (k, 2) float64, see ``embed``.
    """
    return embed(graph, graph.length / graph.way * np.exp(-graph.crease / SHARP))


def embed(graph: PatchGraph, conductance: np.ndarray) -> np.ndarray:
    """Embed patches in the plane by the second and third eigenvectors of a Laplacian.

    Parameters
    ----------
    graph : PatchGraph
        Connected, k patches, 3 or more.
    conductance : (b,) float64
        How strongly each border ties its two patches.

    Returns
    -------
    position : (k, 2) float64
        Each coordinate has the mean 0 and the mean square 1 over the area; its largest entry in size is positive.
    """
    k = len(graph.area)
    ties = symmetric_matrix(graph.pairs, np.maximum(conductance, 1e-9), k)
    root = 1.0 / np.sqrt(graph.area)
    laplacian = diags_array(root) @ (diags_array(ties.sum(axis=1)) - ties) @ diags_array(root)
    # A dense matrix: where creases are deep, hundreds of the lowest eigenvalues lie within a millionth of each other,
    # and ARPACK took a thousand times as long as LAPACK to tell them apart.
    vectors = eigh(laplacian.toarray(), subset_by_index=[0, 2])[1]
    position = vectors[:, 1:3] * root[:, None] * np.sqrt(graph.area.sum())
    largest = np.abs(position).argmax(axis=0)
    return position * np.sign(position[largest, [0, 1]])
