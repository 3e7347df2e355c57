# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges between two sets of parts."""

import numpy as np
import shapes

from core.mesh.corners import CornerTable
from core.mesh.cut_edges import CutEdges


def test_edges_between_some_parts_and_others():
    """As if all edges were looked at; those of three faces count, too."""
    vertices, faces = shapes.tube_tree()
    faces = np.concatenate([faces, [[*faces[0, :2], faces[-1, 0]]]])  # a flap on an edge
    table, rng = CornerTable.of(vertices, faces), np.random.default_rng(0)
    labels = rng.integers(0, 7, len(faces))
    cuts = CutEdges.of(table, labels)
    for inside in ([0], [1, 2, 6], range(7), []):
        chosen = np.isin(np.arange(7), list(inside))
        low, high = table.edge_labels(chosen[labels].astype(np.int64))
        assert cuts.around(chosen).tolist() == np.flatnonzero((low == 0) & (high == 1)).tolist()
