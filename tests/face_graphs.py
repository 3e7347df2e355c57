# SPDX-License-Identifier: GPL-3.0-or-later
"""Small face graphs for tests, and labels on them."""

import numpy as np

from core.arrays.components import components
from core.mesh.face_graph import FaceGraph, fill_unlabeled
from core.mesh.triangles import TriMesh


def path(n, lengths=None, areas=None):
    """n faces in a row."""
    pairs = np.stack([np.arange(n - 1), np.arange(1, n)], axis=1)
    return FaceGraph(n, pairs, np.ones(n - 1) if lengths is None else np.asarray(lengths, float),
                     np.ones(n) if areas is None else np.asarray(areas, float))


def graph_of(shape):
    """The faces of a shape."""
    return FaceGraph.of(TriMesh(*shape))


def boundary_length(graph, label):
    """Length of all boundaries between labels."""
    return graph.length[label[graph.pairs[:, 0]] != label[graph.pairs[:, 1]]].sum()


def n_connected(graph, label):
    """How many connected sets of faces with one label there are."""
    same = label[graph.pairs[:, 0]] == label[graph.pairs[:, 1]]
    return components(graph.n_faces, *graph.pairs[same].T)[0]


def patches(graph, rng, count):
    """Random connected labels grown from seeds."""
    label = np.full(graph.n_faces, -1)
    label[rng.choice(graph.n_faces, count, replace=False)] = np.arange(count)
    return fill_unlabeled(graph, label)
