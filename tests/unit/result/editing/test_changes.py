# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts changed by hand, checked against what the hierarchy itself would do."""


import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.mesh.face_graph import FaceGraph
from core.result.editing.changes import (
    best_split,
    boundary_distance,
    components_of,
    growth,
    node_split,
    shrinkage,
    two_sides,
)


@pytest.fixture(scope="module")
def result():
    return decompose(*shapes.tube_tree(), Parameters(method="berretti"))


def test_a_split_is_the_next_cut_of_the_hierarchy(result):
    for count in range(1, result.n_candidates):
        coarse, fine = result.hierarchy.parts(count), result.hierarchy.parts(count + 1)
        (split,) = [p for p in range(count) if len(np.unique(fine[coarse == p])) == 2]
        side = best_split(result, coarse == split)
        expected = fine == fine[np.flatnonzero(side)[0]]
        assert (side == expected).all()
        rest = (coarse == split) & ~side
        assert result.candidate_area[side].sum() <= result.candidate_area[rest].sum()


def test_a_single_candidate_does_not_split(result):
    assert best_split(result, np.arange(result.n_candidates) == 0) is None


def test_a_node_is_split_from_what_its_arcs_reach(result):
    everything = np.ones(result.n_candidates, bool)
    graph = result.graph
    strongest = best_split(result, everything)
    sides = set()
    for node in range(graph.n_nodes):
        side = node_split(result, everything, node)
        start = result.node_candidate[node]
        assert side[start]
        assert components_of(result, side).max() == components_of(result, ~side).max() == 0
        ours = np.flatnonzero((graph.arcs == node).any(axis=1))
        reached = result.point_candidate[np.isin(graph.point_arc, ours)]
        beyond = np.append(reached, result.node_candidate[graph.arcs[ours].ravel()])
        if (beyond != start).any():
            assert not side[beyond].all()
        else:
            assert (side == strongest).all() or (side == ~strongest).all()
        sides.add(side.tobytes())
    # Nodes tell cuts apart: it is not always the part's best.
    assert len(sides) > 2


def test_a_node_of_a_single_candidate_does_not_split(result):
    mask = np.arange(result.n_candidates) == result.node_candidate[0]
    assert node_split(result, mask, 0) is None


def test_pieces_are_numbered_by_area(result):
    everything = np.ones(result.n_candidates, bool)
    assert (components_of(result, everything) == 0).all()
    # The body lies between the branches: without it they are apart.
    touched = np.bincount(result.candidate_pairs.ravel(), minlength=result.n_candidates)
    without = np.arange(result.n_candidates) != touched.argmax()
    found = components_of(result, without)
    assert found[~without] == -1
    area = [result.candidate_area[found == i].sum() for i in range(found.max() + 1)]
    assert len(area) > 1
    assert area == sorted(area, reverse=True)


def test_growing_takes_a_neighbor_until_nothing_is_left(result):
    mask = np.arange(result.n_candidates) == 0
    everything = np.ones(result.n_candidates, bool)
    while (taken := growth(result, mask, everything)) is not None:
        assert not mask[taken]
        mask[taken] = True
        assert components_of(result, mask).max() == 0
    assert mask.all()


def test_growing_respects_what_is_not_allowed(result):
    mask = np.arange(result.n_candidates) == 0
    assert growth(result, mask, np.zeros(result.n_candidates, bool)) is None


def test_shrinking_keeps_one_piece_and_never_everything(result):
    mask = result.hierarchy.parts(2) == 0
    everything = np.ones(result.n_candidates, bool)
    while (step := shrinkage(result, mask, everything)) is not None:
        given, receiver = step
        assert mask[given]
        assert not mask[receiver]
        mask[given] = False
        assert components_of(result, mask).max() == 0
    # What is left at the boundary holds the rest together.
    pairs = result.candidate_pairs[mask[result.candidate_pairs].sum(axis=1) == 1]
    for candidate in np.unique(pairs[mask[pairs]]):
        rest = mask & (np.arange(len(mask)) != candidate)
        assert not rest.any() or components_of(result, rest).max() > 0


def test_boundary_distance_on_a_strip_by_hand():
    # Faces 0 - 1 - 2 - 3 - 4 in a row, one apart; 3 and 4 inside. Face 5 is by itself.
    pairs = np.array([[0, 1], [1, 2], [2, 3], [3, 4]])
    inside = np.array([False, False, False, True, True, False])
    distance, across = boundary_distance(inside, pairs, np.array([1.0, 2.0, 1.0, 3.0]))
    assert distance.tolist() == [4.0, 3.0, 1.0, -1.0, -4.0, np.inf]
    assert across.tolist() == [3, 3, 3, 2, 2, -1]


def test_boundary_distance_has_the_sign_of_the_side(result):
    vertices, faces = shapes.tube_tree()
    pairs, _ = _neighbors(vertices, faces)
    center = vertices[faces].mean(axis=1)
    inside = result.candidates == 1
    length = np.linalg.norm(center[pairs[:, 0]] - center[pairs[:, 1]], axis=1)
    distance, across = boundary_distance(inside, pairs, length)
    assert ((distance < 0) == inside).all()
    assert (inside[across] != inside).all()
    # One step along the surface changes the distance by no more than its length.
    same = inside[pairs[:, 0]] == inside[pairs[:, 1]]
    assert (np.abs(np.diff(distance[pairs[same]], axis=1)[:, 0]) <= length[same] * (1 + 1e-9)).all()


def _neighbors(vertices, faces):
    """Pairs of triangles that share an edge, and its length, of a closed manifold."""
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort(edges.T)
    pairs = (order // 3).reshape(-1, 2)
    ends = vertices[edges[order[::2]]]
    return pairs, np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)


def test_faces_in_one_place_are_on_the_side_that_they_belong_to():
    """Two faces on each other, with the boundary between them: no distance, but a sign."""
    distance, across = boundary_distance(np.array([False, True]), np.array([[0, 1]]), np.zeros(1))
    assert distance[0] > 0 > distance[1]
    assert across.tolist() == [1, 0]


def test_what_hangs_on_a_side_of_a_cut_goes_with_it():
    """A row 0 1 2 3 cut between 1 and 2; 4 touches 0, 5 touches 4, 6 touches 3, 7 nothing, and 8 is of another part."""
    graph = FaceGraph(9, np.array([[0, 1], [1, 2], [2, 3]]), np.ones(3), np.ones(9))
    contacts = np.array([[0, 4], [4, 5], [3, 6], [7, 8]])
    inside = np.arange(9) < 8
    for cut_off in ([0, 1], [2, 3]):
        side, other = two_sides(graph, contacts, inside, np.isin(np.arange(9), cut_off))
        found = sorted([np.flatnonzero(side).tolist(), np.flatnonzero(other).tolist()])
        assert found == [[0, 1, 4, 5], [2, 3, 6]]
        assert side[cut_off].all()
