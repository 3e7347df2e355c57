# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines over chains of unfolded triangles: distances over needles, and that lines stay on the surface."""

import numpy as np
import pytest
import shapes

from core.field.agd import protrusion_field
from core.field.geodesic import GeodesicSolver
from core.field.sight import lines_in_sight
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.surface.coarsening import Pyramid
from core.surface.ordering import sorted_by_place
from core.surface.preparation import bodies, repair

WORST = 1 / np.cos(np.deg2rad(37.5))  # directions of paths are 75 degrees apart at most


def stretched(n_x, n_y, by):
    vertices, faces = shapes.flat_grid(n_x, n_y)
    return TriMesh(vertices * (1.0, by, 1.0), faces)


@pytest.mark.parametrize("by", [1.0, 4.0, 10.0, 15.0])
def test_over_needles_distances_are_as_good_as_directions_allow(by):
    mesh = stretched(90, 6, by)
    source = 45 * 7 + 3
    straight = np.linalg.norm(mesh.vertices - mesh.vertices[source], axis=1)
    ratio = GeodesicSolver(mesh).distances(source)[straight > 0] / straight[straight > 0]
    assert ratio.min() > 1 - 1e-12
    assert ratio.max() <= WORST + 1e-9


def test_a_line_is_as_long_as_the_plane_says():
    mesh = stretched(30, 2, 10.0)
    source, target, length = lines_in_sight(mesh)
    assert len(length) > 100
    np.testing.assert_allclose(length, np.linalg.norm(mesh.vertices[source] - mesh.vertices[target], axis=1))


def test_folding_changes_no_distance():
    flat = stretched(30, 2, 10.0)
    x, y, _ = flat.vertices.T
    turn = np.deg2rad(70) * (np.arange(31) % 2)  # an accordion: each strip rises or falls
    rise = np.append(0.0, np.cumsum(np.sin(turn[1:])))[x.round().astype(int)]
    run = np.append(0.0, np.cumsum(np.cos(turn[1:])))[x.round().astype(int)]
    folded = TriMesh(np.stack([run, y, rise], axis=1), flat.faces)
    for source in (0, 46, 92):
        np.testing.assert_allclose(*(GeodesicSolver(mesh).distances(source) for mesh in (folded, flat)))


def beyond_two_edges(degrees):
    """A triangle that is so wide at vertex 0, two more behind it, and the corner of the last amid what 0 sees."""
    angle = np.deg2rad(degrees)
    right, left = np.array([1.0, 0.0]), 6 * np.array([np.cos(angle), np.sin(angle)])
    out = np.array([left[1], 1 - left[0]]) / np.linalg.norm(left - right)
    beside = right + 3 * (left - right) + 0.5 * out  # to the left of what 0 sees, just beyond the edge
    middle = 20 * np.array([np.cos(angle / 2), np.sin(angle / 2)])
    vertices = np.column_stack([[(0, 0), right, left, beside, middle], np.zeros(5)])
    return vertices, np.array([(0, 1, 2), (2, 1, 3), (1, 4, 3)])


@pytest.mark.parametrize(("degrees", "sees"), [(59, False), (60, False), (61, True), (75, True)])
@pytest.mark.parametrize("seed", range(4))
def test_windows_are_followed_while_they_are_wider_than_sixty_degrees(degrees, sees, seed):
    vertices, faces = beyond_two_edges(degrees)
    turned = vertices @ shapes.rotation(np.random.default_rng(seed)).T
    source, target, length = lines_in_sight(TriMesh(turned, faces))
    found = source == 0
    assert target[found].tolist() == [4] * sees
    assert length[found] == pytest.approx([20.0] * sees)


def test_lines_cross_at_most_twelve_triangles():
    """A road that the vertex at its end sees along for ever: between far rails, with a sleeper at every step."""
    n = 20
    rail = 0.1 + 0.1 * np.arange(n)
    vertices = np.concatenate([[(0.0, 0.0, 0.0)], *([(10.0, y, 0.0), (-10.0, y, 0.0)] for y in rail)])
    right, left = 1 + 2 * np.arange(n), 2 + 2 * np.arange(n)
    faces = np.concatenate([[(0, 1, 2)], np.stack([left[:-1], right[:-1], right[1:]], axis=1),
                            np.stack([left[:-1], right[1:], left[1:]], axis=1)])
    source, target, length = lines_in_sight(TriMesh(vertices, faces))
    found = source == 0
    # The corner of the first triangle behind is across one edge; of twelve triangles eleven more come into sight.
    assert np.sort(target[found]).tolist() == list(range(4, 15))
    np.testing.assert_allclose(length[found], np.linalg.norm(vertices[target[found]], axis=1))


def test_even_triangles_need_no_more_lines():
    vertices, faces = shapes.flat_grid(8, 8)
    x, y, z = vertices.T
    assert not len(lines_in_sight(TriMesh(np.stack([x - y / 2, np.sqrt(3) / 2 * y, z], axis=1), faces))[0])
    assert not len(lines_in_sight(TriMesh(*shapes.octahedron()))[0])


def test_no_line_leaves_the_surface():
    # A strip of needles with a slit across half of it: from one side to the other the way is around its end.
    mesh = stretched(40, 4, 8.0)
    x, y, _ = mesh.vertices[mesh.faces].mean(axis=1).T
    slit = TriMesh(mesh.vertices, mesh.faces[~((x > 20) & (x < 21) & (y < 24))])
    before, behind = np.flatnonzero((slit.vertices[:, :2] == (19, 0)).all(axis=1)), (22, 0)
    distance = GeodesicSolver(slit).distances(int(before[0]))
    behind = np.flatnonzero((slit.vertices[:, :2] == behind).all(axis=1))[0]
    shortest = np.hypot(1, 24) + 1 + np.hypot(1, 24)
    assert shortest - 1e-9 <= distance[behind] <= WORST * shortest
    around = distance >= np.linalg.norm(slit.vertices - slit.vertices[before], axis=1) - 1e-9
    assert around[slit.used].all()


def test_no_line_runs_over_an_edge_of_three_faces():
    mesh = stretched(20, 1, 10.0)
    edge = np.flatnonzero(np.isin(mesh.vertices[:, 0], (10.0,)))
    fin = np.append(mesh.vertices, [(10.0, 5.0, 5.0)], axis=0)
    with_fin = TriMesh(fin, np.append(mesh.faces, [[*edge, len(fin) - 1]], axis=0))
    source, target, _ = lines_in_sight(with_fin)
    sides = np.sign(fin[:, 0] - 10.0)
    assert (sides[source] * sides[target] >= 0).all()
    assert (np.sign(fin[lines_in_sight(mesh)[0], 0] - 10) * np.sign(fin[lines_in_sight(mesh)[1], 0] - 10) < 0).any()


def test_a_triangle_without_height_opens_no_window():
    # Its height came of a difference of squares: rounding made it one, and its vertex saw all that lies behind.
    places = [(0, 0, 0), (1, 0, 0), (0.37, 0, 0), (0.5, 0.3, 0), (0.5, -0.3, 0), (0.1, 0.9, 0), (0.9, 0.9, 0)]
    vertices = np.array(places)
    faces = np.array([(0, 1, 3), (1, 0, 2), (0, 4, 2), (2, 4, 1), (0, 3, 5), (3, 1, 6), (3, 6, 5)])
    rng = np.random.default_rng(0)
    for _ in range(40):
        moved = vertices @ shapes.rotation(rng).T * rng.uniform(0.01, 30)
        assert not len(lines_in_sight(TriMesh(moved, faces))[0])


def test_corners_at_one_place_but_for_rounding_open_no_window():
    """Of a side without length rounding chose the direction, and of what lies behind it another part was seen."""
    grid = stretched(24, 3, 6.0)
    (a, b, c), more, found = grid.faces[len(grid.faces) // 3], len(grid.vertices), set()
    others = grid.faces[(grid.faces != (a, b, c)).any(axis=1)]
    faces = np.concatenate([others, [(more, b, c), (a, more, c), (a, b, more)]])
    for seed in range(8):
        beside = grid.vertices[a] + np.random.default_rng(seed).normal(size=3) * 1e-15
        lines = lines_in_sight(TriMesh(np.concatenate([grid.vertices, [beside]]), faces))
        found.add(tuple(sorted(zip(*(ends.tolist() for ends in lines[:2]), strict=True))))
    assert len(found) == 1


@pytest.mark.parametrize("scale", [0.0254, 1.37, 25.4])
def test_lines_along_vertices_do_not_depend_on_the_unit(scale):
    mesh = stretched(24, 3, 6.0)
    found, again = (set(zip(*(ends.tolist() for ends in lines_in_sight(TriMesh(s * mesh.vertices, mesh.faces))[:2]),
                            strict=True)) for s in (1.0, scale))
    assert found == again


@pytest.mark.parametrize("sides", [16, 48, 96, 200])
def test_the_field_of_a_cylinder_does_not_depend_on_its_sides(sides):
    angle = np.arange(sides) / sides * 2 * np.pi
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    low, high = np.insert(ring, 2, -2.0, axis=1), np.insert(ring, 2, 2.0, axis=1)
    k, after = np.arange(sides), (np.arange(sides) + 1) % sides
    wall = np.concatenate([np.stack([k, after, after + sides], axis=1),
                           np.stack([k, after + sides, k + sides], axis=1)])
    caps = np.concatenate([np.stack([after, k, np.full(sides, 2 * sides)], axis=1),
                           np.stack([k + sides, after + sides, np.full(sides, 2 * sides + 1)], axis=1)])
    vertices = np.concatenate([low, high, [(0, 0, -2.0), (0, 0, 2.0)]])
    given = sorted_by_place(PolygonMesh.of(vertices, np.concatenate([wall, caps])))[0]
    (body,) = bodies(repair(given), True, 0.01).decomposed
    field = protrusion_field(Pyramid(body.mesh), 0.005, True).normalized
    x, y, z = (body.mesh.vertices - (body.mesh.vertices.max(axis=0) + body.mesh.vertices.min(axis=0)) / 2).T
    high, out = np.abs(z) / np.abs(z).max(), np.hypot(x, y) / np.hypot(x, y).max()
    assert field[(high < 0.05) & (out > 0.99)].max() < 0.05
    assert field[(high > 0.999) & (out < 0.1)].min() > 0.9
