# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarse copies: an independent set that covers, and fields that come back as they were."""

import numpy as np
import pytest
import shapes

from core.arrays.components import components
from core.field.geodesic import GeodesicSolver
from core.mesh.triangles import TriMesh
from core.surface.coarsening import MOST_RISE, SLIM, Coarsening, coarsen, prolong

SURFACES = {"sphere": lambda: shapes.icosphere(3), "genus 2": lambda: shapes.surface_of_genus(2),
            "tree": shapes.tube_tree, "border": lambda: shapes.flat_grid(20, 15),
            "fin": lambda: shapes.with_fin(shapes.icosphere(2)), "tetrahedron": shapes.tetrahedron}


def made(name):
    mesh = TriMesh(*SURFACES[name]())
    return mesh, coarsen(mesh, mesh.vertex_area)


def seeds(mesh, coarsening):
    """The fine vertex at each coarse one."""
    place = {tuple(p): i for i, p in enumerate(mesh.vertices.tolist())}
    return np.array([place[tuple(p)] for p in coarsening.mesh.vertices.tolist()])


def short_edges(mesh):
    """Ends of the edges along which cells grow: short ones, compared with the shortest at one of their ends."""
    shortest = np.full(mesh.n_vertices, np.inf)
    for end in mesh.edges.vertices.T:
        np.minimum.at(shortest, end, mesh.edge_length)
    return mesh.edges.vertices[mesh.edge_length <= SLIM * shortest[mesh.edges.vertices].max(axis=1)].T


@pytest.mark.parametrize("name", SURFACES)
def test_seeds_are_independent_and_every_vertex_has_one_beside_it(name):
    mesh, coarsening = made(name)
    seed = np.zeros(mesh.n_vertices, bool)
    seed[seeds(mesh, coarsening)] = True
    a, b = short_edges(mesh)
    assert not (seed[a] & seed[b]).any()
    covered = seed.copy()
    covered[a[seed[b]]] = covered[b[seed[a]]] = True
    assert covered.all()  # maximal


@pytest.mark.parametrize("name", SURFACES)
def test_each_vertex_belongs_to_its_nearest_seed_of_those_it_touches(name):
    mesh, coarsening = made(name)
    fine = seeds(mesh, coarsening)
    owner = fine[coarsening.owner]
    np.testing.assert_array_equal(owner[fine], fine)
    is_seed = np.isin(np.arange(mesh.n_vertices), fine)
    short = short_edges(mesh).T
    edges = np.concatenate([short, short[:, ::-1]])
    edges = edges[is_seed[edges[:, 1]]]
    nearest = np.full(mesh.n_vertices, np.inf)
    length = np.linalg.norm(mesh.vertices[edges[:, 0]] - mesh.vertices[edges[:, 1]], axis=1)
    np.minimum.at(nearest, edges[:, 0], length)
    own = np.linalg.norm(mesh.vertices - mesh.vertices[owner], axis=1)
    np.testing.assert_allclose(own[~is_seed], nearest[~is_seed], rtol=1e-12)


@pytest.mark.parametrize("name", SURFACES)
def test_area_is_kept_and_links_keep_the_surface_in_one_piece(name):
    mesh, coarsening = made(name)
    n = coarsening.mesh.n_vertices
    np.testing.assert_allclose(coarsening.area, np.bincount(coarsening.owner, mesh.vertex_area, n))
    assert coarsening.area.sum() == pytest.approx(mesh.area)
    assert components(n, *coarsening.links.T)[0] == 1
    touching = {tuple(sorted(e)) for e in coarsening.owner[mesh.edges.vertices].tolist() if e[0] != e[1]}
    assert touching == {tuple(e) for e in coarsening.links.tolist()}
    assert {tuple(e) for e in coarsening.mesh.edges.vertices.tolist()} <= touching


def test_needles_are_coarsened_across_only_until_they_are_even():
    # Ten rows of which each is 40 times as far from the next as its vertices are from each other.
    vertices, faces = shapes.flat_grid(200, 10)
    rows = vertices[:, 1].round()
    mesh = TriMesh(vertices * (1.0, 40.0, 1.0), faces)
    for left in (100, 50, 25):
        step = coarsen(mesh, mesh.vertex_area)
        kept = np.unique((step.mesh.vertices[:, 1] / 40).round(), return_counts=True)[1]
        assert len(kept) == len(np.unique(rows))  # no row is lost
        assert (kept <= left + 1).all()
        mesh = step.mesh


def test_about_one_vertex_in_four_is_left():
    for name in ("sphere", "genus 2", "tree", "border"):
        mesh, coarsening = made(name)
        assert 0.15 < coarsening.mesh.n_vertices / mesh.n_vertices < 0.4


@pytest.mark.parametrize("name", ["border", "sphere", "genus 2"])
def test_a_constant_comes_back_exactly_and_a_slope_nearly(name):
    mesh, coarsening = made(name)
    same = prolong(mesh, coarsening, np.full(coarsening.mesh.n_vertices, 2.5))
    np.testing.assert_allclose(same, 2.5, rtol=1e-12)
    slope = np.array([0.3, -0.8, 0.5])
    back = prolong(mesh, coarsening, coarsening.mesh.vertices @ slope)
    error = np.abs(back - mesh.vertices @ slope)
    step = mesh.edge_length.mean() * np.linalg.norm(slope)
    assert error.max() < 0.75 * step
    assert error.mean() < 0.12 * step


@pytest.mark.parametrize("name", ["genus 2", "tree"])
def test_coarse_distances_are_close_to_fine_ones(name):
    mesh, coarsening = made(name)
    fine = seeds(mesh, coarsening)
    coarse_solver = GeodesicSolver(coarsening.mesh, coarsening.links)
    solver = GeodesicSolver(mesh)
    for source in (0, len(fine) // 2, len(fine) - 1):
        true = solver.distances(fine[source])[fine]
        far = true > 6 * mesh.edge_length.mean()
        ratio = coarse_solver.distances(source)[far] / true[far]
        assert 0.9 < ratio.min()  # a chord may cut a corner of the surface
        assert ratio.max() < 1.12
        assert ratio.mean() == pytest.approx(1, abs=0.05)


@pytest.mark.parametrize("seed", range(3))
def test_the_choice_does_not_depend_on_the_order(seed):
    shape = shapes.tube_tree()
    other, vertex, _ = shapes.shuffled(shape, np.random.default_rng(seed))
    mesh, permuted = TriMesh(*shape), TriMesh(*other)
    one, two = coarsen(mesh, mesh.vertex_area), coarsen(permuted, permuted.vertex_area)
    assert {tuple(p) for p in one.mesh.vertices.tolist()} == {tuple(p) for p in two.mesh.vertices.tolist()}
    np.testing.assert_array_equal(one.mesh.vertices[one.owner][vertex], two.mesh.vertices[two.owner])


def test_twice_is_coarser_still():
    mesh = TriMesh(*shapes.genus_two(0.08))
    one = coarsen(mesh, mesh.vertex_area)
    two = coarsen(one.mesh, one.area, one.links)
    assert two.mesh.n_vertices < 0.5 * one.mesh.n_vertices
    assert two.area.sum() == pytest.approx(mesh.area)
    assert components(two.mesh.n_vertices, *two.links.T)[0] == 1


@pytest.mark.parametrize("seed", range(3))
def test_the_choice_does_not_depend_on_the_scale_of_a_file_of_eight_digits(seed):
    # Lengths that were equal differ in the eighth digit then: by rounding them, they are equal at some scales only.
    vertices, faces = shapes.cylinder(24, 24, 1.0, 2.0)
    points = (vertices @ shapes.rotation(np.random.default_rng(seed)).T).round(7)
    owners = []
    for scale in (1.0, 1.37, 25.4, 0.3048, 0.01, 39.37, 7.0, 3.3):
        mesh = TriMesh(scale * points, faces)
        owners.append(coarsen(mesh, mesh.vertex_area).owner)
    assert all(np.array_equal(owners[0], other) for other in owners[1:])


def test_pages_around_one_edge_are_few_cells():
    """Without neighbors of their own all pages would be chosen but for an end of their edge, time after time."""
    n = 500
    angle = 2 * np.pi * np.arange(n) / n
    rim = np.stack([np.cos(angle), np.sin(angle), np.full(n, 0.5)], axis=1)
    mesh = TriMesh(np.concatenate([[(0, 0, 0), (0, 0, 1)], rim]), [(0, 1, 2 + page) for page in range(n)])
    assert coarsen(mesh, mesh.vertex_area).mesh.n_vertices < 0.1 * n
    kept = np.arange(n + 2) > 2  # what is kept is no choice
    assert coarsen(mesh, mesh.vertex_area, kept=kept).mesh.n_vertices == n


def test_neighbors_nearly_on_a_line_do_not_tell_how_a_field_rises_across():
    """By the two neighbors the field would rise by 10 for each unit of length beside them."""
    ends = np.array([(-1.0, 0, 0), (0, 0, 0), (1, 0.03, 0)])
    coarse = TriMesh(ends, [[0, 1, 2]])
    fine = TriMesh(np.concatenate([ends, [(0, 2.0, 0)]]), [[0, 1, 2], [0, 1, 3]])
    alone = np.array([[0, 0], [1, 1], [2, 2], [3, 3]])  # no vertex has a neighbor to be averaged with
    found = prolong(fine, Coarsening(coarse, np.array([[0, 1], [1, 2]]), alone, np.array([0, 1, 2, 1]), np.ones(3)),
                    np.array([0.0, 0.0, 1.0]))
    assert found == pytest.approx([0.0, 0.0, 1.0, MOST_RISE])
