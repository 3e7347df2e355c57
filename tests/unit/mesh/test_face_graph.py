# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels on the graph of faces: filled in, every label connected, boundaries without saw teeth."""

import numpy as np
import pytest
import shapes
from face_graphs import boundary_length, graph_of, n_connected, patches, path

from core.mesh.face_graph import FaceGraph, connect, fill_unlabeled, straighten
from core.mesh.triangles import TriMesh


def test_boundaries_by_hand():
    graph = path(5, lengths=[1, 2, 4, 8])
    pairs, length = graph.boundaries(np.array([0, 2, 1, 2, 2]))
    assert pairs.tolist() == [[0, 2], [1, 2]]
    assert length.tolist() == [1, 6]


def test_fill_from_the_labelled_outwards():
    label = fill_unlabeled(path(7), np.array([-1, -1, 3, -1, -1, -1, 5]))
    assert label[:4].tolist() == [3, 3, 3, 3]
    assert label[5:].tolist() == [5, 5]
    assert label[4] in (3, 5)
    assert fill_unlabeled(path(3), np.full(3, -1)).tolist() == [0, 0, 0]


def test_what_no_label_reaches_joins_a_label_that_there_is():
    """A label that only such faces have would hang together with nothing."""
    alone = FaceGraph(4, np.array([[0, 1]]), np.ones(1), np.ones(4))
    assert fill_unlabeled(alone, np.array([-1, 7, -1, 5])).tolist() == [7, 7, 5, 5]


def test_connect_keeps_the_largest_and_gives_the_rest_to_the_longest_boundary():
    graph = path(7, lengths=[1, 1, 1, 5, 1, 1], areas=[1, 1, 1, 1, 1, 3, 1])
    # Label 0 at both ends of its row of two and at face 4; face 4 touches 1 over 5, 2 over 1.
    assert connect(graph, np.array([0, 0, 1, 1, 0, 2, 2])).tolist() == [0, 0, 1, 1, 1, 2, 2]
    # The larger area keeps the name, not the larger number of faces.
    assert connect(graph, np.array([2, 2, 1, 1, 1, 2, 0])).tolist() == [1, 1, 1, 1, 1, 2, 0]


@pytest.mark.parametrize(("label", "connected"), [([7, 4, 7, 4], [7, 4, 7, 7]), ([7, 4, 4, 7], [7, 4, 4, 4])])
def test_of_two_strays_of_one_size_that_touch_nothing_else_the_first_keeps_its_label(label, connected):
    graph = FaceGraph(4, np.array([[2, 3]]), np.ones(1), np.array([5.0, 5, 1, 1]))
    assert connect(graph, np.array(label)).tolist() == connected


@pytest.mark.parametrize("seed", range(5))
def test_connected_whatever_the_labels(seed):
    rng = np.random.default_rng(seed)
    graph = graph_of(shapes.two_spheres())
    label = connect(graph, rng.integers(0, 9, graph.n_faces))
    # Two loose parts: no name may be on both of them.
    assert n_connected(graph, label) == len(np.unique(label))
    already = patches(graph_of(shapes.icosphere(2)), rng, 8)
    np.testing.assert_array_equal(connect(graph_of(shapes.icosphere(2)), already), already)


@pytest.mark.parametrize("seed", range(4))
def test_every_round_of_straightening_shortens_the_boundaries(seed):
    graph = graph_of(shapes.icosphere(3))
    start = patches(graph, np.random.default_rng(seed), 6)
    lengths = [boundary_length(graph, straighten(graph, start, rounds)) for rounds in range(8)]
    for before, after in zip(lengths, lengths[1:], strict=False):
        assert after < before or after == lengths[-1]
    assert lengths[-1] < 0.95 * lengths[0]
    np.testing.assert_array_equal(straighten(graph, start, 0), start)


def test_straightening_takes_saw_teeth():
    # A grid cut along x = 5, with four squares on the wrong side.
    graph = graph_of(shapes.flat_grid(10, 10))
    center = TriMesh(*shapes.flat_grid(10, 10)).face_centroids
    straight = (center[:, 0] > 5).astype(int)
    row = np.floor(center[:, 1])
    teeth = np.where((np.floor(center[:, 0]) == 5) & np.isin(row, (1, 3, 5, 7)), 0, straight)
    assert boundary_length(graph, teeth) == 18  # ten down, and one across at both sides of four teeth
    np.testing.assert_array_equal(straighten(graph, teeth, 20), straight)
    np.testing.assert_array_equal(straighten(graph, straight, 20), straight)


def test_straightening_gains_nothing_by_rounding():
    graph = path(5, lengths=[1, 0.3, 0.1 + 0.2, 1])
    label = np.array([0, 0, 0, 1, 1])
    assert graph.length[2] > graph.length[1]
    assert (straighten(graph, label, 3) == label).all()


def test_of_equal_gains_not_all_change():
    """In a ring of two labels by turns every face gains as much as its neighbors; were all to change, nothing would."""
    ring = FaceGraph(6, np.array([(k, (k + 1) % 6) for k in range(6)]), np.ones(6), np.ones(6))
    turns = np.arange(6) % 2
    assert boundary_length(ring, turns) == 6
    assert boundary_length(ring, straighten(ring, turns, 1)) < 6
