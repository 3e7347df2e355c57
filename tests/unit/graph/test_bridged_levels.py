# SPDX-License-Identifier: GPL-3.0-or-later
"""Level sets across bridges: one run of slabs joins two loose parts, and no loop comes of it."""

import numpy as np
import pytest
import shapes

from core.arrays.components import components
from core.graph import bridged_levels
from core.graph.bridged_levels import joined_runs
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.mesh.triangles import TriMesh

# Two chains of five pieces, 0..4 and 5..9, one piece in every slab; contour i lies between pieces i and i + 1.
CHAINS = np.array([(0, 1), (1, 2), (2, 3), (3, 4), (5, 6), (6, 7), (7, 8), (8, 9)])
CHAIN = np.repeat([0, 1], 5)


def across(*slabs):
    return np.array([(slab, slab + 5) for slab in slabs])


def test_a_run_of_slabs_is_joined_with_the_contours_between():
    pieces, contours = joined_runs(across(1, 2, 3), CHAINS, CHAIN)
    assert pieces.tolist() == [[1, 6], [2, 7], [3, 8]]
    assert contours.tolist() == [[1, 5], [2, 6]]


def test_of_two_runs_the_one_with_more_bridges_joins():
    pieces, contours = joined_runs(across(0, 2, 3, 3), CHAINS, CHAIN)
    assert (pieces.tolist(), contours.tolist()) == ([[2, 7], [3, 8]], [[2, 6]])
    pieces, contours = joined_runs(across(0, 0, 0, 0, 2, 3, 3), CHAINS, CHAIN)
    assert (pieces.tolist(), contours.tolist()) == ([[0, 5]], [])


def test_of_two_runs_with_as_many_bridges_the_lower_one_joins():
    assert joined_runs(across(1, 3), CHAINS, CHAIN)[0].tolist() == [[1, 6]]


def test_of_three_loose_parts_in_a_ring_two_pairs_join_those_with_most_bridges():
    bridges = np.array([(0, 1), (0, 1), (1, 2), (0, 2), (0, 2), (0, 2)])
    pieces, contours = joined_runs(bridges, np.empty((0, 2), np.int64), np.arange(3))
    assert (pieces.tolist(), contours.tolist()) == ([[0, 1], [0, 2]], [])


def test_a_branch_joins_a_branch():
    # Both loose parts fork from slab 0 to slab 1: 0 to 1 and 2, 3 to 4 and 5.
    forks = np.array([(0, 1), (0, 2), (3, 4), (3, 5)])
    pieces, contours = joined_runs(np.array([(0, 3), (1, 4), (2, 5)]), forks, np.array([0, 0, 0, 1, 1, 1]))
    assert pieces.tolist() == [[0, 3], [1, 4], [2, 5]]
    assert contours.tolist() == [[0, 2], [1, 3]]


@pytest.mark.parametrize("seed", range(12))
def test_bridges_anywhere_make_no_loops(seed):
    rng = np.random.default_rng(seed)
    surfaces = [shapes.icosphere(2), shapes.torus(24, 8), shapes.tube_tree(3, 0.3), shapes.flat_grid(8, 8)]
    mesh = TriMesh(*shapes.together(*(surfaces[k] for k in rng.integers(0, 4, 5))))
    values = mesh.vertices @ rng.normal(size=3)
    values = (values - values.min()) / np.ptp(values)
    count, part = mesh.face_components
    assert count == 5
    bridges = rng.integers(0, mesh.n_faces, (60, 2))
    bridges = bridges[part[bridges[:, 0]] != part[bridges[:, 1]]]
    levels = uniform_levels(20)
    apart, sets = cut_at_levels(mesh, values, levels), cut_at_levels(mesh, values, levels, bridges)
    # Faces of a bridge that share no slab join nothing.
    slab = apart.vertex_slab[mesh.faces[bridges]]
    shared = slab.min(axis=2).max(axis=1) <= slab.max(axis=2).min(axis=1)
    n_bodies = components(5, *part[bridges[shared]].T)[0]
    assert components(sets.n_pieces, *sets.contour_pieces.T)[0] == n_bodies < 5
    assert sets.n_loops <= apart.n_loops
    # Pieces stay in one slab, contours at one level, and contours lie between the slabs beside their level.
    assert (sets.piece_slab[sets.element_piece] == sets.element_slab).all()
    assert (sets.contour_level[sets.segment_contour] == sets.segment_level).all()
    assert (sets.piece_slab[sets.contour_pieces] == sets.contour_level[:, None] + [0, 1]).all()


def test_bridged_trees_are_a_tree_and_a_bridged_torus_keeps_its_loop():
    for surface, n_loops in ((shapes.icosphere(3), 0), (shapes.torus(), 1)):
        mesh = TriMesh(*shapes.together(surface, shapes.moved(shapes.icosphere(3), (0.2, 0.1, 2.0))))
        values = (mesh.vertices[:, 0] - mesh.vertices[:, 0].min()) / np.ptp(mesh.vertices[:, 0])
        part = mesh.face_components[1]
        order = np.argsort(mesh.face_centroids[:, 0], kind="stable")
        one, other = (order[part[order] == k] for k in (0, 1))
        middle = slice(len(other) // 3, len(other) // 2)
        nearest = np.abs(mesh.face_centroids[one, 0][:, None] - mesh.face_centroids[other[middle], 0]).argmin(axis=0)
        bridges = np.stack([one[nearest], other[middle]], axis=1)
        sets = cut_at_levels(mesh, values, uniform_levels(16), bridges)
        assert components(sets.n_pieces, *sets.contour_pieces.T)[0] == 1
        assert sets.n_loops == n_loops


def test_it_does_not_matter_which_face_of_a_bridge_is_first():
    """Two strips beside each other with a bridge in each of eight slabs, all of them one run."""
    mesh = TriMesh(*shapes.together(shapes.flat_grid(8, 1), shapes.moved(shapes.flat_grid(8, 1), (0, 2, 0))))
    values = mesh.vertices[:, 0] / 8
    x, part = np.floor(mesh.face_centroids[:, 0]), mesh.face_components[1]
    bridges = np.array([[np.flatnonzero((x == k) & (part == side))[0] for side in (0, 1)] for k in range(8)])
    levels = np.arange(1, 8) / 8
    sets = cut_at_levels(mesh, values, levels, bridges)
    assert (sets.n_pieces, sets.n_contours) == (8, 7)
    for backwards in (np.arange(8) % 2 > 0, np.ones(8, bool), np.arange(8) < 3):
        other = cut_at_levels(mesh, values, levels, np.where(backwards[:, None], bridges[:, ::-1], bridges))
        np.testing.assert_array_equal(other.element_piece, sets.element_piece)
        np.testing.assert_array_equal(other.segment_contour, sets.segment_contour)


@pytest.mark.parametrize("most", [1, 50, 1000])
def test_in_blocks_the_same_is_joined_as_all_at_once(most, monkeypatch):
    """Triangles that cross: most pairs of loose parts have bridges, of many numbers, and some have several runs."""
    rng = np.random.default_rng(most)
    mesh = TriMesh(*shapes.together(shapes.tube_tree(3, 0.3), *(
        shapes.Shape(rng.normal(size=(3, 3)), np.array([[0, 1, 2]])) for _ in range(40))))
    values = mesh.vertices @ rng.normal(size=3)
    values = (values - values.min()) / np.ptp(values)
    part = mesh.face_components[1]
    bridges = rng.integers(0, mesh.n_faces, (4000, 2))
    bridges = bridges[part[bridges[:, 0]] != part[bridges[:, 1]]]
    whole = cut_at_levels(mesh, values, uniform_levels(30), bridges)
    monkeypatch.setattr(bridged_levels, "MAX_LINKS", most)
    sets = cut_at_levels(mesh, values, uniform_levels(30), bridges)
    for name in ("element_piece", "segment_contour", "contour_pieces"):
        np.testing.assert_array_equal(getattr(sets, name), getattr(whole, name))


@pytest.mark.parametrize("seed", range(30))
def test_the_heaviest_forest_is_found_whatever_the_pairs_may_weigh_at_the_most(seed, monkeypatch):
    """Of six parts with few different weights, so that often the order of the pairs decides, looked at two by two."""
    monkeypatch.setattr(bridged_levels, "MAX_LINKS", 2)
    rng = np.random.default_rng(seed)
    cells = np.stack(np.triu_indices(6, 1), axis=1)
    weight = rng.integers(1, 4, len(cells)).astype(float)
    found = bridged_levels._heaviest_forest(cells, weight + rng.integers(0, 3, len(cells)), lambda rows: weight[rows])
    assert found.tolist() == np.flatnonzero(bridged_levels._forest(cells, weight)).tolist()


def test_two_that_others_have_joined_are_not_looked_at(monkeypatch):
    """A hundred triangles, all the same: each two have the same bridges, and 99 pairs join them."""
    mesh = TriMesh(*shapes.together(*(shapes.moved(shapes.Shape(np.eye(3), np.array([[0, 1, 2]])), (0, 0, 1e-3 * k))
                                      for k in range(100))))
    looked_at, side_by_side = [], bridged_levels._side_by_side
    monkeypatch.setattr(bridged_levels, "MAX_LINKS", 1000)
    monkeypatch.setattr(bridged_levels, "_side_by_side", lambda pairs, contours: (
        looked_at.append(len(pairs)), side_by_side(pairs, contours))[1])
    bridges = np.stack(np.triu_indices(100, 1), axis=1)
    sets = cut_at_levels(mesh, mesh.vertices[:, 0], uniform_levels(10), bridges)
    assert (sets.n_pieces, sets.n_contours) == (10, 9)
    assert sum(looked_at) < 0.1 * 10 * len(bridges)
