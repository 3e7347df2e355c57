# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates that exist on the caller's faces, and a hierarchy that merges what touches."""

import numpy as np
import pytest
import shapes
from face_graphs import graph_of, n_connected, patches, path

from core.cuts.face_candidates import FaceCandidates
from core.cuts.hierarchy import Hierarchy
from core.cuts.settling import settle
from core.mesh.face_graph import FaceGraph, connect


def settled(graph, label, hierarchy):
    """Labels and hierarchy of what settled on faces without contacts."""
    found = settle(FaceCandidates(graph, np.empty((0, 2), np.int64), label, hierarchy))
    return found.label, found.hierarchy


@pytest.mark.parametrize("seed", range(4))
def test_settle_merges_only_what_touches(seed):
    rng = np.random.default_rng(seed)
    graph = graph_of(shapes.icosphere(2))
    count = 20
    label = patches(graph, rng, count)
    label[label == 3] = 4  # a candidate that got no face
    label = connect(graph, label)
    merges = [(a, a + 1) for a in rng.permutation(count - 1)]  # in any order, touching or not
    given = Hierarchy.of(count, merges, np.sort(rng.random(count - 1)))
    new_label, hierarchy = settled(graph, label, given)
    assert np.unique(new_label).tolist() == list(range(hierarchy.n_candidates))
    assert hierarchy.n_candidates == len(np.unique(label))
    assert len(np.unique(new_label * 1000 + label)) == hierarchy.n_candidates  # renamed only
    assert hierarchy.n_loose == 1
    for n in range(1, hierarchy.n_candidates + 1):
        assert n_connected(graph, hierarchy.parts(n)[new_label]) == n


def test_settle_keeps_the_order_of_merges_where_they_touch():
    given = Hierarchy.of(4, [(1, 2), (0, 1), (2, 3)], [0.1, 0.2, 0.3])
    _, hierarchy = settled(path(4), np.arange(4), given)
    assert [set(m) for m in hierarchy.merges.tolist()] == [{1, 2}, {0, 1}, {2, 3}]
    assert hierarchy.salience.tolist() == [0.1, 0.2, 0.3]
    # Candidates 0 and 2 do not touch: their merge waits for 1.
    _, hierarchy = settled(path(3), np.arange(3), Hierarchy.of(3, [(0, 2), (1, 2)], [0.1, 0.2]))
    assert len(hierarchy.merges) == 2
    assert hierarchy.salience.tolist() == [0.2, 0.2]


def test_settle_leaves_loose_parts_apart():
    graph = FaceGraph(4, np.array([(0, 1), (2, 3)]), np.ones(2), np.ones(4))
    given = Hierarchy.join([Hierarchy.of(2, [(0, 1)], [0.5]), Hierarchy.of(2, [(0, 1)], [0.2])])
    _, hierarchy = settled(graph, np.arange(4), given)
    assert hierarchy.n_loose == 2
    assert hierarchy.salience.tolist() == [0.2, 0.5]


def test_what_never_merges_stays_apart_even_where_it_touches():
    _, hierarchy = settled(path(2), np.arange(2), Hierarchy.of(2, [], []))
    assert len(hierarchy.merges) == 0
    assert hierarchy.n_loose == 2
