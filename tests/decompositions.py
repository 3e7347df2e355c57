# SPDX-License-Identifier: GPL-3.0-or-later
"""Decompositions by hand: candidates that touch and merge, and nothing else that is not given."""

import numpy as np

from core.cuts.hierarchy import Hierarchy
from core.graph.reeb import ReebGraph
from core.parameters import Parameters
from core.result.decomposition import Decomposition


def decomposition_of(candidates, area, pairs=(), length=(), merges=(), salience=(), n_vertices=0, **more):
    """A decomposition of faces in candidates of some areas. more : attributes of Decomposition that are not empty."""
    none = np.empty(0, np.int64)
    return Decomposition(**{
        "candidates": np.array(candidates, np.int64), "vertex_candidates": np.zeros(n_vertices, np.int64),
        "candidate_area": np.array(area, float), "candidate_pairs": np.array(pairs, np.int64).reshape(-1, 2),
        "candidate_pair_length": np.array(length, float), "hierarchy": Hierarchy.of(len(area), merges, salience),
        "field": np.zeros(n_vertices), "graph": ReebGraph.empty(), "node_candidate": none, "point_candidate": none,
        "contacts": np.empty((0, 2), np.int64), "mirror": np.empty(0), "face_twin": none,
        "face_side": np.empty(0, np.int8), "parameters": Parameters(), "notes": (), "seconds": {}, **more})
