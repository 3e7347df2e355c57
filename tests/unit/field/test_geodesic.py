# SPDX-License-Identifier: GPL-3.0-or-later
"""Path lengths: a metric, never too short, and close to true geodesics."""

import numpy as np
import pytest
import shapes

from core.errors import DisconnectedMeshError
from core.field.geodesic import GeodesicSolver, _shortest_of
from core.mesh.triangles import TriMesh

SURFACES = {"tree": shapes.tube_tree, "genus 2": lambda: shapes.surface_of_genus(2),
            "torus": shapes.torus, "border": lambda: shapes.flat_grid(15, 10),
            "fin": lambda: shapes.with_fin(shapes.icosphere(2)),
            "flat faces": lambda: shapes.with_flat_faces(shapes.icosphere(2))}


def all_distances(mesh, links=None):
    solver = GeodesicSolver(mesh, links)
    return np.stack([solver.distances(v) for v in range(mesh.n_vertices)])


def test_across_two_triangles_by_hand():
    # A unit square with its diagonal: the other diagonal is the unfolded line.
    distance = all_distances(TriMesh(*shapes.flat_grid(1, 1)))
    root = np.sqrt(2)
    np.testing.assert_allclose(distance, [(0, 1, 1, root), (1, 0, root, 1), (1, root, 0, 1), (root, 1, 1, 0)])


def test_the_line_across_a_folded_pair_is_straight_when_unfolded():
    # Folding the square along its diagonal does not change distances on the surface.
    flat = TriMesh(*shapes.flat_grid(1, 1))
    fold = np.array([(0, 0, 0), (0, 1, 0), (0.5, 0.5, np.sqrt(0.5)), (1, 1, 0)])
    np.testing.assert_allclose(all_distances(TriMesh(fold, flat.faces)), all_distances(flat))


def test_no_line_where_it_would_leave_the_surface():
    # Two triangles that form an arrow head: the line between the far corners misses the edge.
    vertices = np.array([(0, 0, 0), (0, 1, 0), (1, -1, 0), (-1, -1, 0)], float)
    distance = all_distances(TriMesh(vertices, [(0, 2, 1), (0, 1, 3)]))
    assert distance[2, 3] == pytest.approx(2 * np.sqrt(2))  # through vertex 0


def test_plane_exactly():
    # Edges and lines across pairs run along (1,0), (2,1), (1,1), (1,2), (0,1) and (1,-1): the
    # length of a vector is the shortest way to put it together from two neighboring ones.
    n = 12
    mesh = TriMesh(*shapes.flat_grid(2 * n, 2 * n))
    distance = GeodesicSolver(mesh).distances(n * (2 * n + 1) + n)
    offset = mesh.vertices[:, :2] - n
    steps = np.array([(1, 0), (2, 1), (1, 1), (1, 2), (0, 1), (-1, 1), (-1, 0)], float)
    expected = np.full(mesh.n_vertices, np.inf)
    for a, b in zip(steps, steps[1:], strict=False):
        share = np.linalg.solve(np.stack([a, b], axis=1), np.where(offset[:, 1:] < 0, -offset, offset).T)
        length = np.linalg.norm(a) * share[0] + np.linalg.norm(b) * share[1]
        inside = (share > -1e-9).all(axis=0)
        expected[inside] = np.minimum(expected[inside], length[inside])
    np.testing.assert_allclose(distance, expected, atol=1e-9)
    straight = np.linalg.norm(offset, axis=1)
    # The widest gap is the 45 degrees between (1, 0) and (1, -1).
    assert (distance[straight > 0] / straight[straight > 0]).max() <= 1 / np.cos(np.pi / 8) + 1e-9


def test_sphere():
    mesh = TriMesh(*shapes.icosphere(4))
    directions = mesh.vertices / np.linalg.norm(mesh.vertices, axis=1)[:, None]
    for source in (0, 100, 1234):
        distance = GeodesicSolver(mesh).distances(source)
        true = np.arccos(np.clip(directions @ directions[source], -1, 1))
        far = true > 0.3
        ratio = distance[far] / true[far]
        assert ratio.max() < 1.07
        assert ratio.mean() < 1.04
        assert ratio.min() > 0.998  # the polyhedron is a little smaller than the sphere


@pytest.mark.parametrize("name", SURFACES)
def test_a_metric_not_shorter_than_straight(name):
    mesh = TriMesh(*SURFACES[name]())
    solver = GeodesicSolver(mesh)
    some = np.random.default_rng(1).choice(mesh.n_vertices, 25, replace=False)
    rows = np.stack([solver.distances(v) for v in some])
    between = rows[:, some]
    np.testing.assert_allclose(between, between.T, rtol=1e-12, atol=1e-12)
    assert (np.diag(between) == 0).all()
    # Every vertex v, sources a and b: d(a, v) <= d(a, b) + d(b, v).
    for a in range(len(some)):
        assert (rows[a] <= between[a][:, None] + rows + 1e-9).all()
    straight = np.linalg.norm(mesh.vertices[some][:, None] - mesh.vertices[None], axis=2)
    assert (rows >= straight - 1e-9).all()


@pytest.mark.parametrize("seed", range(3))
def test_permuted_moved_and_scaled(seed):
    rng = np.random.default_rng(seed)
    shape = shapes.tube_tree(3, step=0.2)
    other, vertex, _ = shapes.shuffled(shape, rng)
    mesh = TriMesh(*shape)
    moved = TriMesh(3.5 * other.vertices @ shapes.rotation(rng).T + rng.normal(size=3), other.faces)
    np.testing.assert_allclose(all_distances(moved), 3.5 * all_distances(mesh)[vertex][:, vertex], rtol=1e-9)


def test_links_shorten_paths():
    mesh = TriMesh(*shapes.flat_grid(10, 1))
    first, last = 0, 20
    assert GeodesicSolver(mesh).distances(first)[last] == pytest.approx(10)
    folded = TriMesh(mesh.vertices * (0.5, 1, 1), mesh.faces)
    linked = GeodesicSolver(folded, np.array([(first, last)]))
    assert linked.distances(first)[last] == pytest.approx(5)
    # Of several ways between two vertices the shortest counts: a link is never in the way.
    same = GeodesicSolver(mesh, np.array([(0, 2), (2, 0)]))
    np.testing.assert_allclose(same.distances(0), GeodesicSolver(mesh).distances(0))


def test_coincident_vertices_are_reached():
    mesh = TriMesh(*shapes.with_flat_faces(shapes.box()))
    flat = mesh.vertices.copy()
    flat[1] = flat[0]  # an edge of no length
    distance = GeodesicSolver(TriMesh(flat, mesh.faces)).distances(0)
    assert distance[1] == pytest.approx(0, abs=1e-12)


def test_unreachable_vertices_are_listed():
    mesh = TriMesh(*shapes.together(shapes.tetrahedron(), shapes.box()))
    with pytest.raises(DisconnectedMeshError, match="^8 vertices cannot be reached from vertex 0") as caught:
        GeodesicSolver(mesh).distances(0)
    assert caught.value.vertices.tolist() == list(range(4, 12))


def test_no_line_between_faces_that_are_lines():
    # Both faces at an edge lie on its line but for rounding: whether a way crosses the edge would be chance.
    rng = np.random.default_rng(0)
    known = []
    for _ in range(20):
        direction = rng.normal(size=3)
        line = np.array([0.0, 1.0, -0.7, 1.9])[:, None] * direction / np.linalg.norm(direction) + rng.normal(size=3)
        known.append(all_distances(TriMesh(line, [(0, 1, 2), (1, 0, 3)])))
    np.testing.assert_allclose(known, np.broadcast_to(known[0], np.shape(known)), atol=1e-9)


def test_a_line_across_an_edge_is_taken_just_where_it_crosses_it():
    """Random quadrilaterals of two triangles, convex or not, whose far corners lie at any heights."""
    rng = np.random.default_rng(0)
    for _ in range(200):
        (left, up), (right, down) = rng.random((2, 2)) * (3, 1) + (-1, 0.1)
        vertices = np.array([(0, 0, 0), (1, 0, 0), (left, up, 0), (right, -down, 0)])
        start, end = vertices[2:]
        crossing = left + (right - left) * up / (up + down)
        bent = min(np.linalg.norm(start - bend) + np.linalg.norm(bend - end) for bend in vertices[:2])
        expected = np.linalg.norm(start - end) if 0 < crossing < 1 else bent
        found = GeodesicSolver(TriMesh(vertices, [(0, 1, 2), (1, 0, 3)])).distances(2)[3]
        assert found == pytest.approx(expected, rel=1e-12)


def test_of_two_lengths_of_one_pair_the_shorter_counts():
    length = _shortest_of(np.array([0, 1]), np.array([1, 0]), np.array([2.0, 1.0]), 2)
    assert length.toarray().tolist() == [[0, 1], [1, 0]]


def test_vertices_at_one_place_are_no_distance_apart():
    vertices = np.array([(0, 0, 0), (0, 0, 0), (1, 0, 0), (0, 1, 0)], float)
    distance = GeodesicSolver(TriMesh(vertices, [(0, 1, 2), (1, 0, 3)])).distances(0)
    assert distance.tolist() == [0, 0, 1, 1]
