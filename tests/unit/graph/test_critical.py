# SPDX-License-Identifier: GPL-3.0-or-later
"""Critical points: minima - saddles + maxima is the Euler characteristic, whatever the field."""

import numpy as np
import pytest
import shapes

from core.graph.critical import KINDS, MAXIMUM, MINIMUM, SADDLE, critical_points, total_order
from core.mesh.triangles import TriMesh

CLOSED = {
    "tetrahedron": shapes.tetrahedron, "octahedron": shapes.octahedron, "box": shapes.box,
    "sphere": lambda: shapes.icosphere(2), "torus": shapes.torus, "two spheres": shapes.two_spheres,
    "dumbbell": shapes.dumbbell,
    **{f"genus {g}": (lambda g=g: shapes.surface_of_genus(g, 0.2)) for g in range(4)},
}


def points_of(mesh, values):
    return critical_points(mesh, total_order(np.asarray(values)))


def balance(points):
    return points.count(MINIMUM) - points.count(SADDLE) + points.count(MAXIMUM)


def test_total_order_breaks_ties_by_index():
    assert total_order(np.array([3.0, 1, 2, 1, 3, 1])).tolist() == [4, 0, 3, 1, 5, 2]


@pytest.mark.parametrize("name", CLOSED)
@pytest.mark.parametrize("seed", range(4))
def test_euler_characteristic_of_random_and_of_tied_fields(name, seed):
    mesh = TriMesh(*CLOSED[name]())
    rng = np.random.default_rng(seed)
    fields = (rng.random(mesh.n_vertices), rng.integers(0, 3, mesh.n_vertices).astype(float),
              np.zeros(mesh.n_vertices), mesh.vertices @ rng.normal(size=3), mesh.vertices[:, 2].round(1))
    for values in fields:
        assert balance(points_of(mesh, values)) == mesh.euler_characteristic


def test_octahedron_by_hand():
    mesh = TriMesh(*shapes.octahedron())
    points = points_of(mesh, mesh.vertices[:, 2])
    assert points.vertex.tolist() == [5, 4]
    assert [KINDS[k] for k in points.kind] == ["minimum", "maximum"]


def test_a_constant_field_has_one_minimum_and_one_maximum_on_a_sphere():
    # Indices alone decide, and subdivision numbers vertices so that ripples are possible: on
    # the octahedron 0-1 and 2-3 are opposite, so 1 touches 2, 3, 4, 5 and not 0.
    mesh = TriMesh(*shapes.octahedron())
    points = points_of(mesh, np.zeros(6))
    # 0 is lowest. 1 has no lower neighbor: a second minimum. 2 and 3 touch 0 and 1, which do
    # not touch: saddles. 4 and 5 are opposite and above all others: maxima.
    assert points.vertex.tolist() == [0, 1, 2, 3, 4, 5]
    assert points.kind.tolist() == [MINIMUM, MINIMUM, SADDLE, SADDLE, MAXIMUM, MAXIMUM]


def test_standing_torus_has_two_saddles():
    vertices, faces = shapes.torus()
    mesh = TriMesh(vertices, faces)
    points = points_of(mesh, vertices @ (1.0, 0.013, 0.007))
    assert points.kind.tolist() == [MINIMUM, SADDLE, SADDLE, MAXIMUM]
    assert points.multiplicity.tolist() == [1, 1, 1, 1]
    x = vertices[points.vertex, 0]
    np.testing.assert_allclose(x, [-1.35, -0.65, 0.65, 1.35], atol=0.02)


def test_monkey_saddle_counts_twice():
    mesh = TriMesh(*shapes.monkey_saddle())
    points = points_of(mesh, mesh.vertices[:, 2])
    inside = points.vertex == 0
    assert points.kind[inside].tolist() == [SADDLE]
    assert points.multiplicity[inside].tolist() == [2]


@pytest.mark.parametrize("genus", range(4))
def test_a_surface_of_genus_g_has_at_least_two_g_saddles(genus):
    mesh = TriMesh(*shapes.surface_of_genus(genus))
    points = points_of(mesh, mesh.vertices @ (1.0, 0.1, 0.03))
    assert points.count(SADDLE) >= 2 * genus
    assert (np.diff(total_order(mesh.vertices @ (1.0, 0.1, 0.03))[points.vertex]) > 0).all()


@pytest.mark.parametrize("seed", range(3))
def test_kinds_do_not_depend_on_the_order_of_vertices_and_faces(seed):
    shape = shapes.surface_of_genus(1, 0.2)
    rng = np.random.default_rng(seed)
    values = rng.random(len(shape.vertices))
    other, vertex, _ = shapes.shuffled(shape, rng)
    one, two = points_of(TriMesh(*shape), values), points_of(TriMesh(*other), values[vertex])
    np.testing.assert_array_equal(one.vertex, vertex[two.vertex])
    np.testing.assert_array_equal(one.kind, two.kind)
    np.testing.assert_array_equal(one.multiplicity, two.multiplicity)


def test_upside_down_swaps_minima_and_maxima():
    mesh = TriMesh(*shapes.surface_of_genus(2, 0.2))
    values = np.random.default_rng(0).random(mesh.n_vertices)
    up, down = points_of(mesh, values), points_of(mesh, -values)
    np.testing.assert_array_equal(up.vertex, down.vertex[::-1])
    np.testing.assert_array_equal(MAXIMUM - up.kind, down.kind[::-1])
    np.testing.assert_array_equal(up.multiplicity, down.multiplicity[::-1])


def test_unused_vertices_are_not_critical():
    shape = shapes.with_unused_vertices(shapes.icosphere(1))
    mesh = TriMesh(*shape)
    points = points_of(mesh, np.arange(float(mesh.n_vertices)))
    assert np.isin(points.vertex, shape.faces).all()


def test_the_highest_vertex_of_two_fans_is_a_maximum():
    """Two triangles that share a vertex have two edges below it, as a saddle has."""
    mesh = TriMesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, -1, 0)], [(0, 1, 2), (0, 3, 4)])
    points = points_of(mesh, [9.0, 1, 2, 3, 4])
    assert points.vertex.tolist() == [1, 3, 0]
    assert points.kind.tolist() == [MINIMUM, MINIMUM, MAXIMUM]
    assert points.multiplicity.tolist() == [1, 1, 1]
