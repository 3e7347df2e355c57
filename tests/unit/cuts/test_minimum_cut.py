# SPDX-License-Identifier: GPL-3.0-or-later
"""Minimum cuts in a band."""

from itertools import combinations

import numpy as np
import pytest
import shapes

from core.cuts.hierarchy import Hierarchy
from core.cuts.minimum_cut import MovableCuts, _cuts_by_length, _minimum_cut, minimum_cuts, move_cuts
from core.mesh.triangles import TriMesh


def border_length(mesh, part):
    apart = part[mesh.edges.pairs[:, 0]] != part[mesh.edges.pairs[:, 1]]
    return mesh.edge_length[mesh.edges.pair_edge[apart]].sum()


def ragged_grid(n=24):
    """A flat square, halves with a saw-toothed border."""
    mesh = TriMesh(*shapes.flat_grid(n, n))
    x, y = mesh.face_centroids[:, 0], mesh.face_centroids[:, 1]
    return mesh, (x > n / 2 + np.where(np.floor(y) % 2 > 0, 1.0, -1.0)).astype(np.int64)


def flat(mesh, band_ratio=0.5, **bounds):
    """Cuts on a surface without creases."""
    return MovableCuts(mesh, np.zeros(len(mesh.edges.pairs)), band_ratio, **bounds)


def test_saw_teeth_become_a_straight_line():
    mesh, part = ragged_grid()
    moved = minimum_cuts(flat(mesh), part)
    assert border_length(mesh, moved) < 0.6 * border_length(mesh, part)
    assert border_length(mesh, moved) == pytest.approx(24, rel=0.1)


def test_nothing_moves_without_reach():
    mesh, part = ragged_grid()
    assert (minimum_cuts(flat(mesh, 0.0), part) == part).all()


@pytest.mark.filterwarnings("error")
def test_a_cut_without_a_length_stays():
    """Four triangles in a strip; the middle edge has both ends at one place."""
    vertices = np.array([(0.0, 0, 0), (0, 0, 0), (1, 0, 0), (-1, 0, 0), (1, 1, 0), (-1, 1, 0)])
    mesh = TriMesh(vertices, np.array([(0, 1, 2), (1, 0, 3), (2, 1, 4), (3, 0, 5)]))
    part = np.array([0, 1, 0, 1])
    assert (minimum_cuts(flat(mesh), part) == part).all()


def test_a_cut_falls_into_the_crease_beside_it():
    """A line one cell away costs a twentieth: the border goes there."""
    n = 48
    mesh = TriMesh(*shapes.flat_grid(n, n))
    x = mesh.face_centroids[:, 0]
    part = (x > n / 2).astype(np.int64)
    a, b = mesh.edges.pairs.T
    crease = (x[a] > n / 2 + 1) != (x[b] > n / 2 + 1)
    moved = minimum_cuts(MovableCuts(mesh, np.where(crease, -30.0, 0.0)), part)
    assert (moved == (x > n / 2 + 1)).all()


def test_cuts_between_coarser_parts_stay():
    mesh, part = ragged_grid()
    y = mesh.face_centroids[:, 1]
    finer = part + 2 * (y > 10 + np.where(np.floor(mesh.face_centroids[:, 0]) % 2 > 0, 1, 0))
    moved = minimum_cuts(flat(mesh), finer, part)
    assert (moved % 2 == part).all()
    assert border_length(mesh, moved) < border_length(mesh, finer)


def test_no_face_moves_that_is_held_or_out_of_reach():
    mesh, part = ragged_grid()
    fixed = mesh.face_centroids[:, 1] < 12
    moved = minimum_cuts(flat(mesh, fixed=fixed), part)
    assert (moved == part)[fixed].all()
    assert not (moved == part).all()
    near = minimum_cuts(flat(mesh, widest=0.6), part)
    beside = np.abs(mesh.face_centroids[:, 0] - 12) < 1 + 0.6 + 1  # the teeth, the reach, a face's width
    assert (near == part)[~beside].all()


def test_the_cheapest_of_all_cuts_is_found():
    """On random graphs of eight nodes, against every one of the 64 ways to divide the six that are free."""
    rng = np.random.default_rng(0)
    for _ in range(50):
        pairs = np.array(list(combinations(range(8), 2)))
        a, b = pairs[rng.random(len(pairs)) < 0.5].T
        cost = rng.integers(1, 100, len(a)).astype(float)
        held = rng.choice(8, 2, replace=False)
        side = _minimum_cut(a, b, cost, held, np.array([True, False]), 8)
        assert side[held].tolist() == [True, False]
        sides = (np.arange(256)[:, None] >> np.arange(8) & 1).astype(bool)
        sides = sides[sides[:, held[0]] & ~sides[:, held[1]]]
        costs = ((sides[:, a] != sides[:, b]) * cost).sum(axis=1)
        assert cost[side[a] != side[b]].sum() == costs.min()


@pytest.mark.parametrize("side", [1, -1])
def test_of_two_equal_creases_the_nearer_wins(side):
    n = 48
    mesh = TriMesh(*shapes.flat_grid(n, n))
    x = side * (mesh.face_centroids[:, 0] - n / 2)
    a, b = mesh.edges.pairs.T
    crease = ((x[a] > 1) != (x[b] > 1)) | ((x[a] > -3) != (x[b] > -3))
    movable = MovableCuts(mesh, np.where(crease, -12.0, 0.0), widest=6.0)
    moved = minimum_cuts(movable, (x > 0).astype(np.int64))
    assert (moved == (x > 1)).all()


def test_beyond_a_depth_creases_are_equally_cheap():
    """So that the nearer one wins, however deep the other is."""
    n = 48
    mesh = TriMesh(*shapes.flat_grid(n, n))
    x = mesh.face_centroids[:, 0] - n / 2
    a, b = mesh.edges.pairs.T
    curvature = np.where((x[a] > 1) != (x[b] > 1), -60.0, np.where((x[a] > -3) != (x[b] > -3), -1000.0, 0.0))
    moved = minimum_cuts(MovableCuts(mesh, curvature, widest=6.0), (x > 0).astype(np.int64))
    assert (moved == (x > 1)).all()


def test_the_longest_cut_moves_first():
    cuts = _cuts_by_length(np.arange(3), np.array([0, 1]), np.array([1, 2]), np.array([1.0, 10.0]))
    assert cuts.tolist() == [[1, 2], [0, 1]]


def quarters(n):
    """A flat square in four candidates: two halves of two each."""
    mesh = TriMesh(*shapes.flat_grid(n, n))
    x, y = mesh.face_centroids[:, :2].T
    label = 2 * (x > n / 2) + (y > n / 2)
    return mesh, x, label, Hierarchy.of(4, [(0, 1), (2, 3), (0, 2)], [0.3, 0.3, 0.9])


def test_a_cut_that_moved_at_one_level_stays_at_the_next():
    """Into the crease beside it, and not on into a deeper one beside that, which was out of reach before."""
    mesh, x, label, hierarchy = quarters(48)
    a, b = mesh.edges.pairs.T
    curvature = np.where((x[a] > 25) != (x[b] > 25), -12.0, np.where((x[a] > 26) != (x[b] > 26), -60.0, 0.0))
    movable = MovableCuts(mesh, curvature, widest=2.0)
    moved = move_cuts(movable, label, hierarchy)
    assert (moved // 2 == (x > 25)).all()
    again = minimum_cuts(movable, moved // 2)
    assert (again == (x > 26)).all()


def test_candidates_follow_the_cut_of_their_parts():
    """Each face that changed part takes the candidate beside it there."""
    mesh, x, label, hierarchy = quarters(24)
    a, b = mesh.edges.pairs.T
    crease = (x[a] > 13) != (x[b] > 13)
    movable = MovableCuts(mesh, np.where(crease, -60.0, 0.0), widest=2.0)
    moved = move_cuts(movable, label, hierarchy, (0.5,))
    assert (moved // 2 == (x > 13)).all()
    far = np.abs(mesh.face_centroids[:, 1] - 12) > 2
    assert (moved % 2 == label % 2)[far].all()


def test_without_a_band_no_candidate_changes():
    mesh, _, label, hierarchy = quarters(12)
    assert (move_cuts(flat(mesh, 0.0), label, hierarchy) == label).all()


def test_the_cost_of_an_edge_by_hand():
    """Its length, times exp(curvature / 12) within 0.05 and 3."""
    mesh = TriMesh(*shapes.flat_grid(2, 1))
    found = MovableCuts(mesh, np.array([-120.0, -12.0, 6.0])).cost / mesh.pair_length
    np.testing.assert_allclose(found, [0.05, np.exp(-1), np.exp(0.5)])
    np.testing.assert_allclose(MovableCuts(mesh, np.array([-35.9, 0.0, 13.3])).cost / mesh.pair_length,
                               [np.exp(-35.9 / 12), 1.0, 3.0])


@pytest.mark.parametrize(("factor", "moves"), [(0.70, True), (0.76, False)])
def test_toward_the_rim_of_the_band_costs_rise_with_the_square_of_the_distance(factor, moves):
    """A strip of squares in two parts. Behind the next square, 0.608 of the band away, a cut costs 1.370 times as much
    as beside it."""
    mesh = TriMesh(*shapes.flat_grid(12, 1))
    x = mesh.face_centroids[:, 0]
    ends = mesh.vertices[mesh.edges.vertices[mesh.edges.pair_edge], 0]
    level = np.where(ends[:, 0] == ends[:, 1], ends[:, 0], -1.0)  # -1 for diagonals
    share = np.select([level == 7, level == 6], [factor, 1.0], 3.0)
    movable = MovableCuts(mesh, 12 * np.log(share), band_ratio=100.0, widest=2.0)
    part = minimum_cuts(movable, (x > 6).astype(np.int64))
    np.testing.assert_array_equal(part, x > (7 if moves else 6))
