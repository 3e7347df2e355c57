# SPDX-License-Identifier: GPL-3.0-or-later
"""Minimum cuts in a band."""

from itertools import combinations

import numpy as np
import pytest
import shapes

from core.cuts.minimum_cut import _minimum_cut, minimum_cuts
from core.surface.mesh import TriMesh


def border_length(mesh, part):
    apart = part[mesh.edges.pairs[:, 0]] != part[mesh.edges.pairs[:, 1]]
    return mesh.edge_length[mesh.edges.pair_edge[apart]].sum()


def ragged_grid(n=24):
    """A flat square, halves with a saw-toothed border."""
    mesh = TriMesh(*shapes.flat_grid(n, n))
    x, y = mesh.face_centroids[:, 0], mesh.face_centroids[:, 1]
    return mesh, (x > n / 2 + np.where(np.floor(y) % 2 > 0, 1.0, -1.0)).astype(np.int64)


def test_saw_teeth_become_a_straight_line():
    mesh, part = ragged_grid()
    moved = minimum_cuts(mesh, np.zeros(len(mesh.edges.pairs)), part, 0.5)
    assert border_length(mesh, moved) < 0.6 * border_length(mesh, part)
    assert border_length(mesh, moved) == pytest.approx(24, rel=0.1)


def test_nothing_moves_without_reach():
    mesh, part = ragged_grid()
    assert (minimum_cuts(mesh, np.zeros(len(mesh.edges.pairs)), part, 0.0) == part).all()


@pytest.mark.filterwarnings("error")
def test_a_cut_without_a_length_stays():
    """Four triangles in a strip; the middle edge has both ends at one place."""
    vertices = np.array([(0.0, 0, 0), (0, 0, 0), (1, 0, 0), (-1, 0, 0), (1, 1, 0), (-1, 1, 0)])
    mesh = TriMesh(vertices, np.array([(0, 1, 2), (1, 0, 3), (2, 1, 4), (3, 0, 5)]))
    part = np.array([0, 1, 0, 1])
    assert (minimum_cuts(mesh, np.zeros(len(mesh.edges.pairs)), part, 0.5) == part).all()


def test_a_cut_falls_into_the_crease_beside_it():
    """A line one cell away costs a twentieth: the border goes there."""
    n = 48
    mesh = TriMesh(*shapes.flat_grid(n, n))
    x = mesh.face_centroids[:, 0]
    part = (x > n / 2).astype(np.int64)
    a, b = mesh.edges.pairs.T
    crease = (x[a] > n / 2 + 1) != (x[b] > n / 2 + 1)
    moved = minimum_cuts(mesh, np.where(crease, -30.0, 0.0), part, 0.5)
    assert (moved == (x > n / 2 + 1)).all()


def test_cuts_between_coarser_parts_stay():
    mesh, part = ragged_grid()
    y = mesh.face_centroids[:, 1]
    finer = part + 2 * (y > 10 + np.where(np.floor(mesh.face_centroids[:, 0]) % 2 > 0, 1, 0))
    moved = minimum_cuts(mesh, np.zeros(len(mesh.edges.pairs)), finer, 0.5, part)
    assert (moved % 2 == part).all()
    assert border_length(mesh, moved) < border_length(mesh, finer)


def test_no_face_moves_that_is_held_or_out_of_reach():
    mesh, part = ragged_grid()
    flat = np.zeros(len(mesh.edges.pairs))
    fixed = mesh.face_centroids[:, 1] < 12
    moved = minimum_cuts(mesh, flat, part, 0.5, fixed=fixed)
    assert (moved == part)[fixed].all()
    assert not (moved == part).all()
    near = minimum_cuts(mesh, flat, part, 0.5, widest=0.6)
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
