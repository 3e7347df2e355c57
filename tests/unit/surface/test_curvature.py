# SPDX-License-Identifier: GPL-3.0-or-later
"""k_min: 1 / r on a ball, nothing along a cylinder, negative in concavities."""

import numpy as np
import pytest
import shapes

from core.mesh.triangles import TriMesh
from core.surface.curvature import angle_defect, curvature_across, k_min


@pytest.mark.parametrize("radius", [1e-6, 0.5, 3.0, 1e6])
def test_sphere(radius):
    curvature = k_min(TriMesh(*shapes.icosphere(4, radius)))
    assert curvature.mean() == pytest.approx(1 / radius, rel=0.03)
    np.testing.assert_allclose(curvature, 1 / radius, rtol=0.15)


def test_hollow_sphere_is_as_negative_as_it_is_positive():
    mesh = TriMesh(*shapes.inside_out(shapes.icosphere(3, 2.0)))
    np.testing.assert_allclose(k_min(mesh), -0.5, rtol=0.15)


def test_cylinder_is_straight_along_its_axis():
    mesh = TriMesh(*shapes.cylinder(40, 32, radius=0.5, capped=False))
    middle = np.abs(mesh.vertices[:, 2] - 2) < 1.5
    np.testing.assert_allclose(k_min(mesh)[middle], 0, atol=0.03 * 2)


def test_hollow_cylinder_is_negative_across():
    # Inside a tube of radius r the curvatures are 0 and -1 / r.
    mesh = TriMesh(*shapes.inside_out(shapes.cylinder(40, 32, radius=0.5, capped=False)))
    middle = np.abs(mesh.vertices[:, 2] - 2) < 1.5
    np.testing.assert_allclose(k_min(mesh)[middle], -2, rtol=0.05)


def test_plane_is_flat():
    np.testing.assert_allclose(k_min(TriMesh(*shapes.flat_grid(8, 8))), 0, atol=1e-12)


@pytest.mark.parametrize("upside_down", [False, True])
def test_saddle_is_negative_from_both_sides(upside_down):
    vertices, faces = shapes.flat_grid(40, 40, 0.02)
    x, y = vertices[:, 0] - 0.4, vertices[:, 1] - 0.4
    mesh = TriMesh(np.stack([x, y, (x**2 - y**2) / 2], axis=1), faces[:, ::-1] if upside_down else faces)
    center = np.hypot(x, y) < 0.1
    np.testing.assert_allclose(k_min(mesh)[center], -1, rtol=0.1)


def test_torus():
    # Outside min(1 / tube, 1 / (ring + tube)), inside -1 / (ring - tube).
    mesh = TriMesh(*shapes.torus(96, 32, 1.0, 0.35))
    far = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 1])
    curvature = k_min(mesh)
    np.testing.assert_allclose(curvature[far > 1.349], 1 / 1.35, rtol=0.1)
    np.testing.assert_allclose(curvature[far < 0.651], -1 / 0.65, rtol=0.1)


@pytest.mark.parametrize(("make", "euler"), [
    (shapes.icosphere, 2), (shapes.torus, 0), (lambda: shapes.flat_grid(5, 3), 1),
    (lambda: shapes.cylinder(12, 5, 1.0, 3.0, False), 0)])
def test_angle_defects_are_those_of_gauss_and_bonnet(make, euler):
    """At borders half a turn is missing; on a flat grid, the defect is in the corners alone."""
    mesh = TriMesh(*make())
    defect = angle_defect(mesh)
    assert defect.sum() == pytest.approx(2 * np.pi * euler, abs=1e-9)
    assert mesh.euler_characteristic == euler
    if euler == 1:
        corners = np.isin(mesh.faces, np.flatnonzero(np.abs(mesh.vertices).prod(axis=1) == 0)).any(axis=1)
        assert np.abs(defect[~corners]).max(initial=0) < 1e-12


def test_lowest_in_the_neck():
    mesh = TriMesh(*shapes.dumbbell())
    curvature = k_min(mesh)
    assert np.abs(mesh.vertices[curvature.argmin(), 2]) < 0.15
    assert curvature[np.abs(np.abs(mesh.vertices[:, 2]) - 1.5) < 0.3].min() > 0


def test_moved_scaled_and_permuted():
    shape = shapes.surface_of_genus(1)
    rng = np.random.default_rng(5)
    other, vertex, _ = shapes.shuffled(shape, rng)
    moved = TriMesh(4 * other.vertices @ shapes.rotation(rng).T + 10, other.faces)
    np.testing.assert_allclose(k_min(moved), k_min(TriMesh(*shape))[vertex] / 4, atol=1e-9)


def test_flat_faces_and_borders_give_finite_values():
    for shape in (shapes.with_flat_faces(shapes.icosphere(2)), shapes.with_fin(shapes.box()),
                  shapes.unjoined(shapes.box()), shapes.with_unused_vertices(shapes.box())):
        assert np.isfinite(k_min(TriMesh(*shape))).all()


def test_across_edges_it_is_positive_on_ridges_and_negative_in_grooves():
    """A cross of blocks: its outer edges are ridges, the four where its bars meet are grooves."""
    vertices, quads = shapes.cross_of_blocks(4, 4)
    mesh = TriMesh(vertices, shapes.split_quads(quads))
    turn = mesh.dihedral
    for across in curvature_across(mesh, (1e-3, 0.02)):
        sharp = np.abs(turn) > 1.0
        assert sharp.sum() > 50
        assert (turn[sharp] < 0).sum() >= 8
        assert (np.sign(across[sharp]) == np.sign(turn[sharp])).all()
