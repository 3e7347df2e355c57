# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints: parts end where what the mesh brings along changes."""

import numpy as np
import pytest
import shapes
from results import same_partition

from core import MeshError, Parameters, decompose
from core.cuts import hinted
from core.cuts.face_candidates import FaceCandidates
from core.cuts.hierarchy import LAST, Hierarchy
from core.cuts.hinted import hinted_candidates
from core.mesh.face_graph import FaceGraph
from core.parameters import METHODS


@pytest.fixture(scope="module")
def tree():
    return shapes.tube_tree()


def centers(shape):
    return shape.vertices[shape.faces].mean(axis=1)


def with_hint(graph, label, hierarchy, hint):
    """Labels and hierarchy of candidates on faces without contacts, after a hint."""
    found = hinted_candidates(FaceCandidates(graph, np.empty((0, 2), np.int64), label, hierarchy), hint)
    return found.label, found.hierarchy


def test_where_the_shape_says_nothing_the_hint_decides():
    ball = shapes.icosphere(3)
    upper = (centers(ball)[:, 2] > 0).astype(int)
    found = decompose(*ball, hints=7 * upper)
    assert found.parts(0.0).count == 1
    assert same_partition(found.parts(n_parts=2).labels, upper)
    assert same_partition(found.parts(0.5).labels, upper)


@pytest.mark.parametrize("method", METHODS)
def test_where_a_method_finds_nothing_the_hint_decides(method):
    """Most methods have one candidate of a ball."""
    ball = shapes.icosphere(3)
    upper = (centers(ball)[:, 2] > 0).astype(int)
    found = decompose(*ball, Parameters(method=method), hints=upper)
    assert same_partition(found.parts(n_parts=2).labels, upper)


def test_hints_may_be_below_zero(tree):
    hints = (3 * centers(tree)[:, 0]).astype(int)
    expected = decompose(*tree, hints=hints)
    for other in (hints - hints.max() - 1, -hints, 10**15 * hints - 2**60):
        found = decompose(*tree, hints=other)
        assert same_partition(found.candidates, expected.candidates)


def test_two_groups_are_judged_by_the_mean_over_the_smaller_of_each_two_places():
    """A, B and C touch each other; A and B are of one candidate, B and C of one hint. B and C join first."""
    graph = FaceGraph(3, np.array([[0, 1], [0, 2], [1, 2]]), np.ones(3), np.array([1.0, 0.5, 1.0]))
    label, hierarchy = with_hint(
        graph, np.array([0, 0, 1]), Hierarchy.of(2, [(0, 1)], [0.6]), np.array([0, 1, 1]))
    assert label.tolist() == [0, 1, 2]
    # Of A and B, A and C.
    score = np.array([np.log(1 / hinted.LEAST_SALIENCE - 1), np.log(1 / 0.6 - 1)]) - hinted.OTHER_HINT
    joined = np.average(score, weights=np.sqrt([0.5, 1.0]))
    assert hierarchy.salience[-1] == pytest.approx(1 / (1 + np.exp(joined)), abs=1e-6)
    assert hierarchy.merges[0].tolist() == [1, 2]


def test_one_hint_for_all_is_none(tree):
    plain, hinted = decompose(*tree), decompose(*tree, hints=np.full(len(tree.faces), -3))
    assert (hinted.candidates == plain.candidates).all()
    assert (hinted.hierarchy.merges == plain.hierarchy.merges).all()
    assert (hinted.hierarchy.salience == plain.hierarchy.salience).all()


def test_every_candidate_has_one_hint(tree):
    hints = (centers(tree)[:, 0] > 0.3).astype(int)
    found = decompose(*tree, hints=hints)
    corner = tree.vertices[tree.faces]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    of = np.zeros((found.n_candidates, hints.max() - hints.min() + 1))
    np.add.at(of, (found.candidates, hints - hints.min()), area)
    assert of.max(axis=1).sum() == pytest.approx(of.sum())
    for n in (1, 2, found.n_candidates):
        assert found.parts(n_parts=n).count == n


def test_a_speck_of_another_material_is_no_part():
    ball = shapes.icosphere(4)
    speck = np.zeros(len(ball.faces), int)
    speck[100] = 1
    assert decompose(*ball, hints=speck).parts(1.0).labels[100] in np.delete(decompose(*ball).parts(1.0).labels, 100)
    assert same_partition(decompose(*ball, hints=speck).candidates, decompose(*ball).candidates)


def test_the_order_of_faces_does_not_matter(tree):
    hints = (centers(tree)[:, 0] > 0.1).astype(int)
    expected = decompose(*tree, hints=hints)
    shuffled, _, face = shapes.shuffled(tree, np.random.default_rng(1))
    found = decompose(*shuffled, hints=hints[face])
    for detail in (0.3, 0.5, 0.9):
        assert same_partition(found.parts(detail).labels, expected.parts(detail).labels[face])


@pytest.mark.parametrize("last", [1, 2], ids=["all in use", "one without faces"])
def test_what_little_a_hint_cuts_off_joins_what_has_the_hint(last):
    graph = FaceGraph(3, np.array([[0, 2], [1, 2]]), np.ones(2), np.array([1.0, 1.0, 1e-9]))
    merges = [(0, candidate) for candidate in range(1, last + 1)]
    label, hierarchy = with_hint(
        graph, np.array([0, last, last]), Hierarchy.of(last + 1, merges, [0.5] * last), np.array([1, 0, 1]))
    assert label.tolist() == [0, 1, 0]
    assert hierarchy.n_candidates == 2


def test_half_models_take_them_along():
    half = shapes.half_of(shapes.mirrored_figure())
    hints = (centers(half)[:, 2] > np.median(centers(half)[:, 2])).astype(int)
    plane = np.array([1.0, 0, 0, 0])
    found = decompose(*half, mirror=plane, hints=hints)
    assert (found.candidates != decompose(*half, mirror=plane).candidates).any()
    assert found.n_faces == len(half.faces)


@pytest.mark.parametrize("hints", [[0, 1], 3, [0.5] * 320, ["a"] * 320, np.zeros((320, 1))], ids=str)
def test_what_is_no_hint_is_refused(hints):
    with pytest.raises(MeshError, match="Hints must be one whole number for each of the 320 faces"):
        decompose(*shapes.icosphere(2), hints=hints)


def test_no_cut_of_a_hint_is_more_certain_than_the_last():
    """Two materials on two candidates that never merge early: salience ends at LAST, so that all parts can be one."""
    graph = FaceGraph(2, np.array([(0, 1)]), np.ones(1), np.ones(2))
    _, hierarchy = with_hint(graph, np.arange(2), Hierarchy.of(2, [(0, 1)], [1.0]), np.arange(2))
    assert hierarchy.salience.tolist() == [LAST]


def test_pieces_that_share_no_edge_merge_by_their_contacts():
    """Three loose pieces in a row, of two hints, with a contact between each two: all of them merge in the end."""
    graph = FaceGraph(6, np.array([[0, 1], [2, 3], [4, 5]]), np.ones(3), np.ones(6))
    candidates = FaceCandidates(graph, np.array([[1, 2], [3, 4]]), np.array([0, 0, 1, 1, 2, 2]),
                                Hierarchy.of(3, [(0, 1), (0, 2)], [0.4, 0.6]))
    found = hinted_candidates(candidates, np.array([0, 0, 1, 1, 0, 0]))
    assert same_partition(found.label, np.array([0, 0, 1, 1, 2, 2]))
    assert len(found.hierarchy.merges) == 2


def test_of_many_cuts_that_only_hints_know_rounding_does_not_choose_the_first():
    """At three times the size their saliences differ in the last bit."""
    ball, rng = shapes.icosphere(2), np.random.default_rng(0)
    vertices = ball.vertices * (1.0 + 0.3 * rng.random((len(ball.vertices), 1)))
    hint = rng.integers(0, 3, len(ball.faces))
    one, other = (decompose(k * vertices, ball.faces, hints=hint) for k in (1.0, 3.0))
    assert one.n_candidates > 50
    np.testing.assert_array_equal(one.candidates, other.candidates)
    np.testing.assert_array_equal(one.hierarchy.merges, other.hierarchy.merges)


@pytest.mark.parametrize(("share", "n_cells"), [(0.0021, 2), (0.0019, 1)])
def test_what_a_hint_cuts_out_is_a_cell_from_a_five_hundredth_of_the_area_on(share, n_cells):
    """A row of two faces of one candidate. The hint has nothing else, or, apart from there, half of all."""
    row = FaceGraph(2, np.array([(0, 1)]), np.ones(1), np.array([1 - share, share]))
    label, _ = with_hint(row, np.zeros(2, np.int64), Hierarchy.of(1, [], []), np.array([0, 1]))
    assert len(np.unique(label)) == n_cells
    row = FaceGraph(4, np.array([(0, 1), (1, 2), (2, 3)]), np.ones(3), np.array([0.3, share, 0.2 - share, 0.5]))
    label, _ = with_hint(row, np.array([0, 0, 1, 1]), Hierarchy.of(2, [(0, 1)], [0.9]), np.array([0, 1, 1, 1]))
    assert len(np.unique(label)) == n_cells + 1


def test_where_the_method_sees_no_cut_a_hint_counts_as_much_as_it_says():
    """One candidate of two hints: the least salience there, 0.2, is log 4 as log-odds that both are one, less 1.5."""
    row = FaceGraph(2, np.array([(0, 1)]), np.ones(1), np.ones(2))
    _, hierarchy = with_hint(row, np.zeros(2, np.int64), Hierarchy.of(1, [], []), np.array([0, 1]))
    assert hierarchy.salience == pytest.approx([1 / (1 + 4 * np.exp(-1.5))], abs=1e-4)
