# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes of symmetry, whatever their direction, and the mirror twins of faces."""

import numpy as np
import pytest
import shapes

from core.surface.mesh import TriMesh
from core.surface.symmetry import face_twins, mirror_plane


def twins_of(mesh, plane):
    return face_twins(mesh, np.arange(mesh.n_faces), mesh.n_faces, plane)


@pytest.mark.parametrize("seed", range(4))
def test_a_turned_figure_has_the_turned_plane_and_exact_twins(seed):
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.mirrored_figure()
    turn, offset, scale = shapes.rotation(rng), rng.normal(size=3) * 100, 10.0 ** rng.uniform(-3, 3)
    (moved, faces), _, _ = shapes.shuffled(shapes.Shape(scale * (vertices @ turn.T + offset), faces), rng)
    mesh = TriMesh(moved, faces)
    plane = mirror_plane(mesh)
    assert abs(plane.normal @ turn[:, 0]) == pytest.approx(1.0, abs=1e-9)
    assert plane.offset == pytest.approx(scale * offset @ plane.normal, abs=1e-6 * scale)
    assert plane.share == pytest.approx(1.0)
    twin = twins_of(mesh, plane)
    assert np.array_equal(twin[twin], np.arange(mesh.n_faces))
    apart = plane.mirrored(mesh.face_centroids) - mesh.face_centroids[twin]
    assert np.linalg.norm(apart, axis=1).max() < 1e-6 * scale


def test_an_arm_that_only_one_side_has_has_no_twin():
    vertices, faces = shapes.mirrored_figure()
    mesh = TriMesh(vertices, faces)
    kept = mesh.face_centroids[:, 0] > -0.7  # one arm ends at the elbow
    plane = mirror_plane(mesh.submesh(np.flatnonzero(kept))[0])
    half = mesh.submesh(np.flatnonzero(kept))[0]
    assert abs(plane.normal[0]) > 0.999
    lone = half.face_centroids[:, 0] > 1.05
    assert (twins_of(half, plane)[lone] == -1).all()
    assert (twins_of(half, plane)[half.face_centroids[:, 0] < 0.6] >= 0).all()


def test_another_tessellation_of_one_side_has_twins_within_a_face():
    vertices, faces = shapes.mirrored_figure()
    fine = shapes.subdivide(shapes.Shape(vertices, faces))
    mesh, finer = TriMesh(vertices, faces), TriMesh(*fine)
    left, right = mesh.face_centroids[:, 0] < 0, finer.face_centroids[:, 0] > 0
    halves = shapes.Shape(vertices, faces[left]), shapes.Shape(fine.vertices, fine.faces[right])
    both = TriMesh(*shapes.together(*halves))
    plane = mirror_plane(both)
    assert plane.normal[0] == pytest.approx(1.0, abs=1e-3)
    twin = twins_of(both, plane)
    assert (twin >= 0).mean() > 0.99
    apart = plane.mirrored(both.face_centroids) - both.face_centroids[np.maximum(twin, 0)]
    assert np.linalg.norm(apart[twin >= 0], axis=1).max() < both.edge_length.max()


def test_a_twisted_tree_has_no_plane():
    assert mirror_plane(TriMesh(*shapes.tube_tree())) is None


def test_the_two_sides_of_a_thin_plate_are_not_confused():
    mesh = TriMesh(*shapes.subdivide(shapes.subdivide(shapes.subdivide(shapes.box((4.0, 1.0, 0.02))))))
    plane = mirror_plane(mesh)
    twin = twins_of(mesh, plane)
    assert np.allclose(plane.turned(mesh.face_normals), mesh.face_normals[twin], atol=1e-4)
