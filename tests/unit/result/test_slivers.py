# SPDX-License-Identifier: GPL-3.0-or-later
"""What is too small to be a part joins its neighbor; what is not stays, and so do pieces and ties."""

import numpy as np
import pytest
import shapes

from core import TriMesh, decompose
from core.cuts.face_candidates import FaceCandidates
from core.cuts.hierarchy import Hierarchy
from core.mesh.face_graph import FaceGraph
from core.result.slivers import LONG, NARROW, SHARD, TINY, without_slivers


def strip(*lengths):
    """A strip of quads; each number is how many of them the next candidate has. Graph of the quads and their labels."""
    n = sum(lengths)
    graph = FaceGraph(n, np.stack([np.arange(n - 1), np.arange(1, n)], axis=1), np.ones(n - 1), np.ones(n))
    return graph, np.repeat(np.arange(len(lengths)), lengths)


def all_apart(count):
    """Every candidate is a part of its own at detail 0.5."""
    return Hierarchy.of(count, [(0, other) for other in range(1, count)], np.full(count - 1, 0.9))


def label_without(graph, label, hierarchy):
    """Candidate of each face after slivers joined their neighbors."""
    return without_slivers(FaceCandidates(graph, np.empty((0, 2), np.int64), label, hierarchy)).label


def test_a_tiny_part_joins_the_neighbor_with_the_longest_boundary():
    graph, label = strip(3000, 1, 1000)
    graph.length[2999] = 2.0
    assert np.bincount(label_without(graph, label, all_apart(3))).tolist() == [3001, 0, 1000]
    assert 1 / 4001 < TINY < 2.5 / 4003
    graph, label = strip(3000, 3, 1000)
    graph.length[2999] = 2.0
    assert label_without(graph, label, all_apart(3)).tolist() == label.tolist()


def test_a_tiny_part_between_two_equal_boundaries_stays():
    """It may lie on a plane of symmetry."""
    graph, label = strip(3000, 1, 3000)
    assert label_without(graph, label, all_apart(3)).tolist() == label.tolist()


@pytest.mark.parametrize(("shard", "joins"), [(19, True), (21, False)])
def test_what_is_left_over_of_a_part_joins_what_is_around_it(shard, joins):
    """Candidates 0 and 2 are one part, with 1 between them."""
    graph, label = strip(100, 50, shard, 50)
    graph.length[149] = 2.0
    hierarchy = Hierarchy.of(4, [(0, 2), (0, 1), (0, 3)], [0.1, 0.9, 0.9])
    found = label_without(graph, label, hierarchy)
    assert found.tolist() == (np.where(label == 2, 1, label) if joins else label).tolist()
    assert SHARD * 100 == 20


def test_a_small_piece_of_its_own_stays_and_is_no_left_over():
    graph, label = strip(5000, 1)
    apart = FaceGraph(graph.n_faces, graph.pairs[:-1], graph.length[:-1], graph.area)
    touching = FaceGraph(graph.n_faces, graph.pairs, np.append(graph.length[:-1], 0.0), graph.area)
    for together in (0.1, 0.9):
        hierarchy = Hierarchy.of(2, [(0, 1)], [together])
        for pieces in (apart, touching):
            assert label_without(pieces, label, hierarchy).tolist() == label.tolist()


def test_slivers_of_two_candidates_join_one():
    graph, label = strip(9000, 1, 1, 3000)
    graph.length[8999] = 2.0
    hierarchy = Hierarchy.of(4, [(1, 2), (0, 1), (0, 3)], [0.1, 0.9, 0.9])
    assert np.bincount(label_without(graph, label, hierarchy)).tolist() == [9002, 0, 0, 3000]


def grid(label):
    """The graph of unit squares side by side, and their labels; label : (rows, columns)."""
    number = np.arange(label.size).reshape(label.shape)
    pairs = np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in
                            ((number[:, :-1], number[:, 1:]), (number[:-1], number[1:]))])
    return FaceGraph(label.size, pairs, np.ones(len(pairs)), np.ones(label.size)), label.ravel()


@pytest.mark.parametrize(("shape", "joins"), [((1, 10), True), ((2, 5), False), ((1, 6), False)])
def test_a_small_part_that_is_nearly_all_outline_joins_what_is_around_it(shape, joins):
    """22 around 10 squares is 7.0 times the square root, 14 around as many 4.4, and 14 around 6 is 5.7."""
    label = np.zeros((30, 30), np.int64)
    label[12 : 12 + shape[0], 12 : 12 + shape[1]] = 1
    graph, label = grid(label)
    assert (label_without(graph, label, all_apart(2)) == (0 if joins else label)).all()
    assert 10 / 900 < NARROW < 20 / 900
    assert 14 / np.sqrt(6) < LONG < 22 / np.sqrt(10)


@pytest.mark.parametrize("apart", [False, True])
def test_a_part_with_two_equal_boundaries_joins_if_both_are_with_one_part(apart):
    label = np.zeros((61, 10), np.int64)
    label[30], label[31:] = 1, 2
    graph, label = grid(label)
    hierarchy = Hierarchy.of(3, [(0, 2), (0, 1)], [0.9 if apart else 0.1, 0.9])
    found = label_without(graph, label, hierarchy)
    assert np.bincount(found).tolist() == ([300, 10, 300] if apart else [300, 0, 310])


@pytest.mark.parametrize(("around", "inner", "length"), [(32, 0.5, 1.0), (48, 0.6, 1.0), (24, 0.7, 1.5)])
def test_a_pipe_is_one_part(around, inner, length):
    """Some of the faces of the hollow were parts."""
    vertices, faces = shapes.pipe(around, 2, inner)
    vertices[:, 2] *= length / np.ptp(vertices[:, 2])
    assert decompose(vertices, faces).parts().count == 1


@pytest.mark.parametrize("name", ["mirrored_figure", "tube_tree", "dumbbell"])
def test_no_part_of_a_model_is_a_sliver(name):
    shape = getattr(shapes, name)()
    mesh = TriMesh(*shape)
    share = np.bincount(decompose(*shape).parts().labels, mesh.face_area) / mesh.area
    assert len(share) > 1
    assert share.min() >= TINY
