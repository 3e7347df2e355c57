# SPDX-License-Identifier: GPL-3.0-or-later
"""Base vertices cover the surface; the AGD is low on the body and high at the tips."""

import numpy as np
import pytest
import shapes

from core.field.agd import (
    FIELD_VERTICES,
    BaseVertices,
    agd_field,
    average_geodesic_distance,
    coarse_agd,
    equalize,
    normalize,
    protrusion_field,
    spread_base_vertices,
)
from core.field.geodesic import GeodesicSolver
from core.mesh.triangles import TriMesh
from core.surface.coarsening import Pyramid


def base_of(mesh, spacing=0.005, progress=None):
    radius = np.sqrt(spacing * mesh.area)
    return spread_base_vertices(mesh, GeodesicSolver(mesh), mesh.vertex_area, radius, progress), radius


@pytest.mark.parametrize("make", [shapes.tube_tree, shapes.torus, lambda: shapes.flat_grid(30, 20)])
def test_base_vertices_cover_apart_and_share_the_area(make):
    mesh = TriMesh(*make())
    base, radius = base_of(mesh)
    assert base.distances.shape == (len(base.indices), mesh.n_vertices)
    assert (base.distances.min(axis=0) <= radius).all()
    apart = base.distances[:, base.indices] + 1e9 * np.eye(len(base.indices))
    assert (apart.min(axis=1) > radius * (1 - 1e-6)).all()
    assert base.areas.sum() == pytest.approx(mesh.area)
    assert (base.areas > 0).all()
    for index, row in list(zip(base.indices, base.distances, strict=True))[:3]:
        np.testing.assert_allclose(row, GeodesicSolver(mesh).distances(index), rtol=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_rounding_does_not_choose_among_base_vertices_that_are_equally_near(seed):
    """On a grid, many vertices are equally far from two; turned and moved, the last digits of the ways differ."""
    vertices, faces = shapes.flat_grid(24, 24)
    turned = vertices @ shapes.rotation(np.random.default_rng(seed)).T + 100.0 * seed
    base, again = (base_of(TriMesh(points, faces), 0.02)[0] for points in (vertices, turned))
    np.testing.assert_array_equal(base.indices, again.indices)
    np.testing.assert_allclose(base.areas, again.areas, rtol=1e-9)


def test_number_of_base_vertices_is_that_of_the_trials():
    # The paper's spacing gave 123-158 base vertices on real models.
    for make in (shapes.tube_tree, lambda: shapes.genus_two(0.08), lambda: shapes.icosphere(4)):
        assert 110 <= len(base_of(TriMesh(*make()))[0].indices) <= 170


def test_progress_of_spreading_rises_to_one():
    shares = []
    base_of(TriMesh(*shapes.icosphere(3)), progress=shares.append)
    assert shares == sorted(shares)
    assert 0 < shares[0]
    assert shares[-1] <= 1


def test_mean_distance_by_hand():
    base = BaseVertices(np.array([0, 2]), np.array([1.0, 3.0]), np.array([(0, 1, 2), (2, 1, 0)], np.float32))
    assert average_geodesic_distance(base).tolist() == [1.5, 1.0, 0.5]


@pytest.mark.parametrize("subdivisions", [2, 3, 4])
def test_sphere_is_even(subdivisions):
    # The mean distance on the unit sphere is pi / 2 from anywhere.
    mesh = TriMesh(*shapes.icosphere(subdivisions))
    agd = average_geodesic_distance(base_of(mesh)[0])
    assert agd.mean() == pytest.approx(np.pi / 2, rel=0.035)
    assert np.ptp(agd) < 0.03 * agd.max()


def test_long_strip_is_a_parabola():
    # On a segment of length L the mean distance at x is (x**2 + (L - x)**2) / (2 L).
    mesh = TriMesh(*shapes.flat_grid(200, 2, 0.05))
    agd = average_geodesic_distance(base_of(mesh, 0.0005)[0])
    x, length = mesh.vertices[:, 0], 10.0
    np.testing.assert_allclose(agd, (x**2 + (length - x) ** 2) / (2 * length), atol=0.03)


def test_high_at_tips_and_low_on_the_body():
    mesh = TriMesh(*shapes.tube_tree())
    agd = average_geodesic_distance(base_of(mesh)[0])
    at = [np.linalg.norm(mesh.vertices - tip, axis=1).argmin() for tip in shapes.TREE_TIPS]
    body = np.linalg.norm(mesh.vertices, axis=1) < 0.5
    assert agd[at].min() > agd[body].max()
    assert body[agd.argmin()]


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_agd_scales_with_the_mesh(scale):
    vertices, faces = shapes.tube_tree(3, step=0.2)
    mesh, scaled = TriMesh(vertices, faces), TriMesh(scale * vertices, faces)
    agd, other = (average_geodesic_distance(base_of(m)[0]) for m in (mesh, scaled))
    np.testing.assert_allclose(other, scale * agd, rtol=1e-5)


def test_normalize():
    assert normalize(np.array([2.0, 4.0, 3.0])).tolist() == [0, 1, 0.5]
    assert normalize(np.array([5.0, 5.0, 5.0 + 1e-9])).tolist() == [0, 0, 0]
    assert normalize(np.zeros(3)).tolist() == [0, 0, 0]


@pytest.mark.parametrize("seed", range(3))
def test_equalize_is_monotone_with_ends_zero_and_one(seed):
    rng = np.random.default_rng(seed)
    values = normalize(rng.beta(0.4, 3, size=500))
    weights = rng.random(500)
    result = equalize(values, weights)
    order = values.argsort()
    assert (np.diff(result[order])[np.diff(values[order]) > 0] > 0).all()
    assert result.min() == 0
    assert result.max() == pytest.approx(1, abs=1e-12)
    # At the border of a bin, the share of the weight below it.
    for border in (0.01, 0.05, 0.2, 0.5):
        expected = weights[values < border].sum() / weights.sum()
        assert np.interp(border, values[order], result[order]) == pytest.approx(expected, abs=0.01)


def test_equalize_of_even_values_changes_nothing():
    values = np.linspace(0, 1, 10_001)
    np.testing.assert_allclose(equalize(values, np.ones(10_001)), values, atol=2e-4)


def test_equalize_counts_area_not_vertices():
    # All weight low: the equalized field rises there and is nearly flat above.
    values = np.linspace(0, 1, 1001)
    result = equalize(values, np.where(values < 0.1, 1.0, 1e-9))
    assert result[100] == pytest.approx(1, abs=1e-3)
    assert equalize(np.zeros(5), np.ones(5)).tolist() == [0] * 5


def test_field_keeps_what_it_is_made_of():
    mesh = TriMesh(*shapes.tube_tree(3, step=0.2))
    agd = average_geodesic_distance(base_of(mesh)[0])
    plain, even = agd_field(mesh, agd, False), agd_field(mesh, agd, True)
    np.testing.assert_array_equal(plain.values, plain.normalized)
    np.testing.assert_array_equal(even.normalized, plain.normalized)
    np.testing.assert_array_equal(np.argsort(even.values, kind="stable"), np.argsort(agd, kind="stable"))
    for share in (0.1, 0.5, 0.9):
        assert mesh.vertex_area[even.values <= share].sum() / mesh.area == pytest.approx(share, abs=0.02)
    assert not plain.values.flags.writeable


def test_field_of_a_dense_mesh_is_that_of_the_mesh_itself():
    mesh = TriMesh(*shapes.tube_tree(4, step=0.027))
    assert mesh.n_vertices > FIELD_VERTICES
    radius = np.sqrt(0.02 * mesh.area)
    fast = coarse_agd(Pyramid(mesh), radius)
    base = spread_base_vertices(mesh, GeodesicSolver(mesh), mesh.vertex_area, radius)
    exact = average_geodesic_distance(base)
    error = normalize(fast) - normalize(exact)
    assert np.abs(error).max() < 0.04
    assert np.sqrt((error**2).mean()) < 0.01


def test_the_first_base_vertex_is_chosen_by_area_not_by_how_dense_the_mesh_is():
    """A strip that is dense at its left: of its ends, equally far from the middle of the area, the first is taken."""
    vertices, faces = shapes.flat_grid(20, 4)
    dense = TriMesh(np.column_stack([20 * (vertices[:, 0] / 20) ** 3, vertices[:, 1:]]), faces)
    base = spread_base_vertices(dense, GeodesicSolver(dense), dense.vertex_area, 100.0)
    assert dense.vertices[base.indices[0], 0] == 0


def test_there_are_no_more_base_vertices_than_twice_what_the_area_asks_for():
    """Of a narrow ribbon, along which as many would fit as it is radii long."""
    ribbon = shapes.flat_grid(400, 1)
    base, radius = base_of(TriMesh(ribbon.vertices * (1, 0.01, 1), ribbon.faces))
    assert len(base.indices) == np.ceil(2 * 400 * 0.01 / (1.5 * radius**2))


@pytest.mark.parametrize(("stretch", "protrudes"), [(1.0, False), (1.3, True)])
def test_where_nothing_protrudes_the_field_is_flat(stretch, protrudes):
    ball = shapes.icosphere(3)
    field = protrusion_field(Pyramid(TriMesh(ball.vertices * (1, 1, stretch), ball.faces)), 0.005, True)
    assert field.values.any() == field.normalized.any() == protrudes
    assert field.agd.min() > 0


def test_the_field_is_flat_where_its_range_is_below_three_percent_of_the_largest_distance():
    ball, protrudes = shapes.icosphere(2), {}
    for stretch in np.linspace(1.0, 1.06, 21):
        field = protrusion_field(Pyramid(TriMesh(ball.vertices * (1, 1, stretch), ball.faces)), 0.02, True)
        protrudes[np.ptp(field.agd) / field.agd.max()] = field.values.any()
    assert all(found == (share >= 0.03) for share, found in protrudes.items())
    assert max(share for share in protrudes if share < 0.03) > 0.028
    assert min(share for share in protrudes if share >= 0.03) < 0.036


def test_paths_are_searched_on_the_mesh_itself_up_to_the_largest_number_of_vertices():
    grid = shapes.flat_grid(49, 99)
    mesh = TriMesh(*grid)
    assert mesh.n_vertices == FIELD_VERTICES
    base = spread_base_vertices(mesh, GeodesicSolver(mesh), mesh.vertex_area, 20.0)
    np.testing.assert_array_equal(coarse_agd(Pyramid(mesh), 20.0), average_geodesic_distance(base))


def test_values_that_differ_by_a_millionth_are_equal_but_for_rounding():
    assert normalize(np.array([1 - 0.9e-6, 1.0])).tolist() == [0, 0]
    assert normalize(np.array([1 - 1.1e-6, 1.0])).tolist() == [0, 1]


@pytest.mark.parametrize("unit", [1e-12, 1e12])
def test_equalizing_does_not_depend_on_the_unit_of_areas(unit):
    values, weights = np.linspace(0, 1, 50) ** 3, np.linspace(1, 2, 50)
    np.testing.assert_allclose(equalize(values, unit * weights), equalize(values, weights), rtol=1e-9)


def test_equalized_values_keep_their_order_where_no_area_lies_between():
    equalized = equalize(np.array([0.0, 0.3, 0.4, 0.5, 1.0]), np.array([1.0, 0, 0, 0, 1]))
    assert (np.diff(equalized) > 0).all()
    assert equalized[1] == pytest.approx(equalized[3], abs=1e-3)
