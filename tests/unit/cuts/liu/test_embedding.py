# SPDX-License-Identifier: GPL-3.0-or-later
"""Embeddings of patches whose eigenvectors are not found by the sparse way."""

import numpy as np
import pytest
import shapes
from scipy.sparse.linalg import ArpackNoConvergence

from core.cuts.liu import embedding
from core.cuts.liu.patch_graph import PatchGraph
from core.surface.mesh import TriMesh


def test_what_the_sparse_way_does_not_find_the_dense_one_does(monkeypatch):
    """Of pages around one edge, whose ties are nothing beside their areas, it finds none; that was a traceback."""
    graph, _ = PatchGraph.of(TriMesh(*shapes.tube_tree(step=0.2)))
    assert len(graph.area) > embedding.FEW_PATCHES
    found = embedding.structural(graph)

    def fails(*_, **__):
        raise ArpackNoConvergence("none of %d", np.empty(0), np.empty((len(graph.area), 0)))

    monkeypatch.setattr(embedding, "eigsh", fails)
    assert embedding.structural(graph) == pytest.approx(found, abs=1e-6)
