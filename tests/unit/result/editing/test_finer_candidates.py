# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates cut along given faces: no level of detail changes, and vertices and graph know the halves."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapes
from decompositions import decomposition_of
from face_graphs import graph_of

from core import Parameters, decompose
from core.graph.critical import MAXIMUM
from core.mesh.corners import CornerTable
from core.mesh.face_graph import FaceGraph
from core.result.editing.finer_candidates import (
    ranked_pieces,
    scraps_joined,
    split_around,
    split_candidates,
)


@pytest.fixture(scope="module")
def result():
    return decompose(*shapes.tube_tree(), Parameters(method="berretti"))


@pytest.fixture(scope="module")
def tree():
    """Faces that touch and corners of the mesh of ``result``."""
    shape = shapes.tube_tree()
    return graph_of(shape), CornerTable.of(*shape)


@pytest.mark.parametrize("seed", range(3))
def test_finer_candidates_change_no_parts(result, tree, seed):
    graph, table = tree
    chosen = np.random.default_rng(seed).random(graph.n_faces) < 0.5
    # Every candidate is cut, however small.
    chosen[np.unique(result.candidates, return_index=True)[1]] = True
    chosen[graph.n_faces - 1 - np.unique(result.candidates[::-1], return_index=True)[1]] = False
    finer = split_candidates(result, chosen, graph, table)
    assert finer.n_candidates == 2 * result.n_candidates
    for detail in (0.0, 0.4, 0.6, 0.99):
        fine, coarse = finer.parts(detail), result.parts(detail)
        for name in ("labels", "vertex_labels", "node_part", "point_part", "arc_part", "cuts"):
            np.testing.assert_array_equal(getattr(fine, name), getattr(coarse, name))
    # Candidates lie wholly inside or outside of the chosen faces.
    inside = np.bincount(finer.candidates, chosen)
    assert ((inside == 0) | (inside == np.bincount(finer.candidates))).all()
    assert finer.candidate_area == pytest.approx(np.bincount(finer.candidates, graph.area))
    # Of the two halves of its candidate, every vertex is of the one with more area around it.
    area = np.zeros((len(table.vertices), finer.n_candidates))
    np.add.at(area, (table.corner_vertex, finer.candidates[table.corner_face]), graph.area[table.corner_face])
    rows, half = np.arange(len(area)), result.n_candidates + result.vertex_candidates  # all candidates are cut
    both = np.stack([area[rows, result.vertex_candidates], area[rows, half]], axis=1)
    np.testing.assert_allclose(area[rows, finer.vertex_candidates], both.max(axis=1), rtol=1e-9)


def test_the_graph_follows_a_branch_that_is_cut_half_way(result, tree):
    """Once they stayed with the old candidate: the graph's colors, picking and the JSON named the wrong part."""
    graph, table = tree
    tips = np.flatnonzero(result.graph.node_kind == MAXIMUM)
    points = np.bincount(result.point_candidate, minlength=result.n_candidates)
    tip = int(tips[points[result.node_candidate[tips]].argmax()])  # of a branch long enough to be halved
    branch = result.node_candidate[tip]
    mine = np.flatnonzero(result.point_candidate == branch)
    level = np.median(result.graph.point_value[mine])
    beyond = (result.candidates == branch) & (table.face_means(result.field) > level)
    finer = split_candidates(result, beyond, graph, table)
    new = result.n_candidates
    assert finer.node_candidate[tip] == new
    # A contour goes where most of it lies: only at the cut itself, where faces lie on both sides, can that be open.
    clear = mine[np.abs(result.graph.point_value[mine] - level) > 0.02]
    assert len(clear) > 5
    np.testing.assert_array_equal(finer.point_candidate[clear] == new, result.graph.point_value[clear] > level)
    others = np.setdiff1d(np.arange(len(result.point_candidate)), mine)
    np.testing.assert_array_equal(finer.point_candidate[others], result.point_candidate[others])
    # Vertices with nothing but the new candidate around them, or nothing of it, are known by that.
    low, high = (np.full(len(table.vertices), start) for start in (new, 0))
    np.minimum.at(low, table.corner_vertex, finer.candidates[table.corner_face])
    np.maximum.at(high, table.corner_vertex, finer.candidates[table.corner_face])
    mine = result.vertex_candidates == branch
    assert (finer.vertex_candidates[mine & (low == new)] == new).all()
    assert (finer.vertex_candidates[~mine | (high < new)] == result.vertex_candidates[~mine | (high < new)]).all()


def test_pieces_cut_off_by_hand():
    """A row of faces 0 1 2 3 4 5 6 of one candidate, 7 and 8 of another that is in two places; 2 and 5 move, and 7."""
    pairs = np.array([[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7]])
    graph = FaceGraph(9, pairs, np.ones(7), np.array([3.0, 1, 1, 1, 1, 2, 5, 1, 1]))
    found = SimpleNamespace(candidates=np.array([0, 0, 0, 0, 0, 0, 0, 1, 1]), n_candidates=2,
                            contacts=np.empty((0, 2), np.int64))
    number = np.array([0, 0, 1, 0, 0, 1, 0, 2, 0])
    assert ranked_pieces(found, number, graph).tolist() == [1, 1, 1, 2, 2, 0, 0, 0, 0]
    assert not ranked_pieces(found, np.zeros(9, np.int64), graph).any()
    found.contacts = np.array([[1, 3], [2, 5]])  # across a gap
    assert ranked_pieces(found, number, graph).tolist() == [0, 0, 0, 0, 0, 0, 1, 0, 0]


@pytest.mark.parametrize("seed", range(3))
def test_any_numbers_of_faces_can_be_parts_and_change_no_level_otherwise(result, tree, seed):
    """Of five numbers at random, each candidate has one, and all of its faces hang together."""
    graph, table = tree
    number = np.random.default_rng(seed).integers(0, 6, graph.n_faces)
    finer = split_around(result, number, graph, table)
    of_candidate = np.zeros(finer.n_candidates, np.int64)
    of_candidate[finer.candidates] = number
    np.testing.assert_array_equal(of_candidate[finer.candidates], number)
    assert graph.regions(finer.candidates)[0] == finer.n_candidates
    for n_parts in (1, 4, result.n_candidates):
        np.testing.assert_array_equal(finer.parts(n_parts=n_parts).labels, result.parts(n_parts=n_parts).labels)


def test_no_numbers_need_no_splitting(result, tree):
    assert split_around(result, np.zeros(result.n_faces, np.int64), *tree) is result


def test_whole_candidates_need_no_splitting(result, tree):
    assert split_candidates(result, result.candidates == 1, *tree) is result


def test_areas_stay_in_the_unit_of_the_result(result, tree):
    graph, table = tree
    larger = FaceGraph(graph.n_faces, graph.pairs, graph.length, 7 * graph.area)
    chosen = np.arange(graph.n_faces) % 2 == 0
    finer, same = (split_candidates(result, chosen, some, table) for some in (larger, graph))
    assert finer.candidate_area.sum() == pytest.approx(result.candidate_area.sum())
    assert finer.candidate_area == pytest.approx(same.candidate_area)


def test_a_candidate_that_is_split_still_touches_what_it_only_lies_on():
    """Two balls that touch in one place, on the side of the given half of the first."""
    shape = shapes.two_spheres()
    result, graph, table = decompose(*shape), graph_of(shape), CornerTable.of(*shape)
    (one, other), = result.contacts.tolist()
    first, second = result.candidates[[one, other]].tolist()
    assert [min(first, second), max(first, second)] in result.candidate_pairs.tolist()
    given = result.candidates == first
    for half, candidate in ((given & (np.arange(graph.n_faces) != one), first),
                            (np.arange(graph.n_faces) == one, result.n_candidates)):
        finer = split_candidates(result, half, graph, table)
        assert finer.candidates[one] == candidate
        assert sorted((candidate, second)) in finer.candidate_pairs.tolist()


def test_around_a_vertex_of_needles_their_number_decides():
    """Three needles and a triangle; the first vertex is at the tips of the needles alone, two of which are cut off."""
    vertices = np.array([(0.0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0), (1, 1, 0)])
    shape = vertices, np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (2, 1, 5)])
    area = np.array([0, 0, 0, 0.5])
    graph = FaceGraph(4, np.array([(0, 1), (1, 2), (0, 3)]), np.array([2.0, 3, 1]), area)
    result = decomposition_of([0, 0, 0, 0], [0.5], n_vertices=6)
    finer = split_candidates(result, np.array([False, True, True, False]), graph, CornerTable.of(*shape))
    assert finer.vertex_candidates.tolist() == [1, 0, 0, 1, 1, 0]


def joined(area, pairs, length, merges, number, before):
    """What ``scraps_joined`` makes of candidates of a face each: the merges, and their saliences."""
    salience = np.linspace(0.2, 0.8, len(merges))
    finer = decomposition_of(np.arange(len(area)), area, pairs, length, merges, salience)
    found = scraps_joined(finer, np.array(number), np.array(before))
    return found.hierarchy.merges.tolist(), found.hierarchy.salience.round(3).tolist(), found is finer


@pytest.mark.parametrize(("area", "is_scrap"), [(3.0, True), (3.2, False)])
def test_a_scrap_merges_first_with_what_it_was_one_part_with(area, is_scrap):
    """Beside candidate 0 of 100, less than three hundredths of both; it would go to pinned part 7 before all else."""
    found = joined([100.0, area, 50.0], [(0, 1), (1, 2)], [1.0, 1.0], [(1, 2), (0, 1)], [0, 0, 7], [1, 1, 7])
    if is_scrap:
        assert found == ([[0, 1], [0, 2]], [0.0, 0.8], False)
    else:
        assert found == ([[1, 2], [0, 1]], [0.2, 0.8], True)


@pytest.mark.parametrize(("merges", "number", "before"), [
    ([(1, 2), (0, 1)], [0, 0, 0], [1, 1, 2]),  # nothing is pinned
    ([(1, 2), (0, 1)], [7, 0, 0], [7, 1, 2]),  # it goes to what is not pinned,
    ([(0, 1), (1, 2)], [0, 0, 7], [1, 1, 7]),  # as this, which is of its part
    ([(1, 2), (0, 1)], [0, 7, 7], [1, 7, 7]),  # it is pinned
    ([(1, 2), (0, 1)], [0, 0, 7], [2, 1, 7]),  # nothing that it touches was in its part,
    ([(1, 2), (0, 1)], [7, 0, 7], [1, 1, 7]),  # or that is pinned
])
def test_what_is_no_scrap_merges_as_ever(merges, number, before):
    _, _, same = joined([100.0, 1.0, 50.0], [(0, 1), (1, 2)], [1.0, 1.0], merges, number, before)
    assert same


def test_what_touches_nothing_that_was_in_its_part_stays():
    """Most of part 1 lies behind pinned part 7, and what is beside the scrap was in part 2."""
    _, _, same = joined([100.0, 1.0, 50.0, 100.0], [(0, 1), (1, 2), (2, 3)], [1.0] * 3, [(1, 2), (0, 1), (2, 3)],
                        [0, 0, 7, 0], [2, 1, 7, 1])
    assert same


def test_scraps_go_by_their_longest_borders_and_through_each_other():
    """Scraps 2 and 3 at pinned 4: 2 has a longer border at 1 than at 0; 3 touches nothing of their part but 2.

    2 merges with 3 and 4 at once: which of these has the lower number does not count.
    """
    pairs, length = [(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4)], [1.0, 1.0, 2.0, 9.0, 1.0, 1.0]
    merges = [(3, 4), (2, 3), (0, 1), (1, 2)]
    for order in (np.arange(5), np.array([1, 0, 3, 2, 4]), np.arange(5)[::-1]):
        back = np.argsort(order)
        found, salience, _ = joined(
            np.array([100.0, 100, 1, 1, 50])[back], np.sort(order[np.array(pairs)], axis=1), length,
            order[np.array(merges)], np.array([0, 0, 0, 0, 7])[back], np.array([1, 1, 1, 1, 7])[back])
        first = {frozenset(np.flatnonzero(order == one)[0] for one in pair) for pair in found[:2]}
        assert first == {frozenset({1, 2}), frozenset({1, 3})}
        assert salience[:2] == [0.0, 0.0]
        assert salience[2:] == [0.6, 0.8]
