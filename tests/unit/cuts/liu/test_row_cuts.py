# SPDX-License-Identifier: GPL-3.0-or-later
"""Bisection of a graph of patches: rows, cuts and embeddings against their definitions."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
import shapes

from core.arrays.components import components
from core.cuts.liu.embedding import SHARP, geometric, structural
from core.cuts.liu.method import COST_AT_HALF, DEAREST, LEAST_AREA, bisect, liu_candidates
from core.cuts.liu.patch_graph import PatchGraph
from core.cuts.liu.row_cuts import CHEAPEST, SOFT, best_cut, distances, rows
from core.mesh.triangles import TriMesh


def chain(n, crease=()):
    """Patches of one size in a row; creases after some of them."""
    pairs = np.stack([np.arange(n - 1), np.arange(1, n)], axis=1)
    depth = np.zeros(n - 1)
    depth[list(crease)] = 20.0
    return PatchGraph(np.full(n, 1 / n), pairs, np.full(n - 1, 0.2), np.full(n - 1, 1 / n), depth)


def grid(nx, ny):
    """Patches in a rectangle, with random areas and creases."""
    rng = np.random.default_rng(0)
    number = np.arange(nx * ny).reshape(nx, ny)
    pairs = np.concatenate([np.stack([number[:-1].ravel(), number[1:].ravel()], 1),
                            np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], 1)])
    area = rng.random(nx * ny) + 0.5
    return PatchGraph(area / area.sum(), pairs, rng.random(len(pairs)) + 0.1, rng.random(len(pairs)) + 0.1,
                      10 * rng.random(len(pairs)))


@pytest.mark.parametrize("n", [5, 300])
def test_a_chain_is_embedded_as_two_cosines(n):
    # The eigenvectors of the Laplacian of a path: cos(pi j (i + 1/2) / n).
    at = np.pi * (np.arange(n) + 0.5) / n
    expected = np.sqrt(2) * np.cos(np.arange(1, 3) * at[:, None])
    found = structural(chain(n))
    np.testing.assert_allclose(np.abs(found), np.abs(expected), atol=1e-6)
    assert (found[np.abs(found).argmax(axis=0), [0, 1]] > 0).all()


@pytest.mark.parametrize("shape", [(6, 5), (25, 20)])
@pytest.mark.parametrize("operator", [structural, geometric])
def test_embeddings_are_the_lowest_orthogonal_solutions(shape, operator):
    graph = grid(*shape)
    tie = graph.length / graph.way * (np.exp(-graph.crease / SHARP) if operator is geometric else 1)
    laplacian = np.zeros((len(graph.area),) * 2)
    for (a, b), t in zip(graph.pairs, tie, strict=True):
        laplacian[[a, b, a, b], [a, b, b, a]] += t, t, -t, -t
    values = np.linalg.eigvalsh(laplacian / np.sqrt(np.outer(graph.area, graph.area)))
    x = operator(graph)
    np.testing.assert_allclose(x.T @ (graph.area[:, None] * x), np.eye(2), atol=1e-8)
    np.testing.assert_allclose(graph.area @ x, 0, atol=1e-8)
    np.testing.assert_allclose(np.diag(x.T @ laplacian @ x), values[1:3], rtol=1e-8)


def test_a_row_leads_from_one_sample_to_the_other():
    graph = chain(7)
    rank = rows(distances(graph, np.array([6, 0, 3])))
    assert rank.shape == (3, 7)
    np.testing.assert_array_equal(rank[0], np.arange(7)[::-1])  # from 6 to 0
    assert (np.sort(rank, axis=1) == np.arange(7)).all()


def test_the_best_cut_by_trying_all():
    graph = grid(5, 4)
    rank = rows(distances(graph, np.array([0, 7, 19])))
    worth = graph.length * np.maximum(np.exp(-graph.crease / SOFT), CHEAPEST)
    tried = {}
    for of_row, place in itertools.product(rank, range(19)):
        side = of_row > place
        smaller = min(graph.area[side].sum(), graph.area[~side].sum())
        if smaller >= 0.2:
            tried[tuple(side)] = worth[side[graph.pairs[:, 0]] != side[graph.pairs[:, 1]]].sum() / np.sqrt(smaller)
    side, cost = best_cut(graph, rank, 0.2)
    assert cost == pytest.approx(min(tried.values()), rel=1e-12)
    assert tried[tuple(side)] == pytest.approx(cost, rel=1e-12)
    assert best_cut(graph, rank, 0.6)[1] == np.inf
    assert best_cut(graph, rank[:0], 0.1)[1] == np.inf


def test_a_chain_is_cut_at_its_crease():
    found = bisect(chain(12, crease=[3]), np.arange(12), 0.5)
    assert sorted([found.kept.tolist(), found.parted.tolist()]) == [list(range(4)), list(range(4, 12))]
    within = bisect(chain(12, crease=[3]), np.arange(2, 12), 0.5)  # of a part
    assert sorted([within.kept.tolist(), within.parted.tolist()]) == [[2, 3], list(range(4, 12))]


def test_too_few_too_small_or_too_dear_is_not_cut():
    whole = chain(12)
    assert bisect(whole, np.arange(3), 0.5) is None
    assert bisect(replace(whole, area=np.full(12, LEAST_AREA / 10)), np.arange(12), 0.5) is None
    assert bisect(replace(whole, length=np.full(11, 10 * DEAREST)), np.arange(12), 0.5) is None


def test_the_outline_counts_as_far_as_asked():
    graph = grid(6, 5)
    costs = [bisect(graph, np.arange(30), weight).cost for weight in (0.0, 0.5, 1.0)]
    assert costs[0] > costs[1] > costs[2] > 0
    assert costs[1] == pytest.approx((costs[0] + costs[2]) / 2)


def test_patches_cover_the_surface_and_know_their_borders():
    mesh = TriMesh(*shapes.dumbbell())
    graph, patch = PatchGraph.of(mesh)
    assert graph.area.sum() == pytest.approx(1)
    np.testing.assert_allclose(graph.area, np.bincount(patch, mesh.face_area) / mesh.area, rtol=1e-6)
    a, b = patch[mesh.edges.pairs].T
    assert graph.length.sum() == pytest.approx(mesh.pair_length[a != b].sum() / np.sqrt(mesh.area))
    chosen = graph.area > np.median(graph.area)
    connected = graph.components_of(chosen)
    np.testing.assert_array_equal(np.sort(np.concatenate(connected)), np.flatnonzero(chosen))
    shares = [graph.area[patches].sum() for patches in connected]
    assert shares == sorted(shares, reverse=True)
    for patches in connected:
        part = graph.within(patches)
        assert components(len(patches), *part.pairs.T)[0] == 1


def test_dumbbell_and_ball():
    mesh = TriMesh(*shapes.dumbbell())
    label, hierarchy = liu_candidates(mesh, 0.5)
    z = mesh.face_centroids[:, 2]
    halves = hierarchy.parts(2)[label]
    assert z[halves == halves[z.argmax()]].min() > -0.3
    assert hierarchy.salience[-1] > 0.5
    ball = liu_candidates(TriMesh(*shapes.icosphere(3)), 0.5)[1]
    assert ball.n_parts(0.5) == 1
    # The cheapest cut of a ball costs sqrt(2 pi), less what its outline takes off.
    assert ball.salience.max(initial=0) < 1.2 * COST_AT_HALF / (COST_AT_HALF + np.sqrt(2 * np.pi))


def test_saliences_never_fall_towards_what_was_cut_first():
    _, hierarchy = liu_candidates(TriMesh(*shapes.tube_tree()), 0.5)
    assert len(hierarchy.salience) > 4
    assert (hierarchy.salience >= COST_AT_HALF / (COST_AT_HALF + DEAREST)).all()


def test_each_piece_is_cut_on_its_own():
    one, two = shapes.dumbbell(), shapes.moved(shapes.dumbbell(), (9, 0, 0))
    mesh = TriMesh(*shapes.together(one, two))
    label, hierarchy = liu_candidates(mesh, 0.5)
    assert hierarchy.n_loose == 2
    half = len(one.faces)
    assert not set(label[:half].tolist()) & set(label[half:].tolist())
