# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates on faces: their parts at a level of detail, and what touches."""

import numpy as np
from face_graphs import path

from core.cuts.face_candidates import FaceCandidates
from core.cuts.hierarchy import Hierarchy


def test_parts_are_candidates_whose_cuts_are_weak():
    hierarchy = Hierarchy.of(3, [(0, 1), (1, 2)], [0.3, 0.8])
    candidates = FaceCandidates(path(5), np.empty((0, 2), np.int64), np.array([2, 2, 0, 1, 1]), hierarchy)
    assert candidates.parts(0.0).tolist() == [0, 0, 0, 0, 0]
    assert candidates.parts(0.5).tolist() == [1, 1, 0, 0, 0]
    assert candidates.parts(1.0).tolist() == [2, 2, 0, 1, 1]


def test_contacts_are_pairs_without_a_length():
    candidates = FaceCandidates(path(3), np.array([[0, 2]]), np.arange(3), Hierarchy.of(3, [], []))
    graph = candidates.touching_graph()
    assert graph.pairs.tolist() == [[0, 1], [1, 2], [0, 2]]
    assert graph.length.tolist() == [1.0, 1.0, 0.0]
    assert len(candidates.graph.pairs) == 2
