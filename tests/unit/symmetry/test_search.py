# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes of symmetry, whatever their direction, and the mirror twins of faces."""

from dataclasses import replace

import numpy as np
import pytest
import shapes

from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.surface.preparation import bodies, repair
from core.symmetry import small_faces as small
from core.symmetry.images import Images
from core.symmetry.search import EXACT, mirror_plane
from core.symmetry.small_faces import SmallFaces


def small_faces(vertices, faces):
    """Those of a mesh of one piece, its long edges split."""
    (body,) = bodies(repair(PolygonMesh.of(vertices, faces)), True, 0.01).decomposed
    return SmallFaces(body.mesh, body.polygon, len(faces))


def plane_of(mesh):
    return mirror_plane(SmallFaces.of(mesh))


def twins_of(mesh, plane):
    return Images(SmallFaces.of(mesh), plane).twins


@pytest.mark.parametrize("seed", range(4))
def test_a_turned_figure_has_the_turned_plane_and_exact_twins(seed):
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.mirrored_figure()
    turn, offset, scale = shapes.rotation(rng), rng.normal(size=3) * 100, 10.0 ** rng.uniform(-3, 3)
    (moved, faces), _, _ = shapes.shuffled(shapes.Shape(scale * (vertices @ turn.T + offset), faces), rng)
    mesh = TriMesh(moved, faces)
    plane = plane_of(mesh)
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
    plane = plane_of(mesh.submesh(np.flatnonzero(kept))[0])
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
    plane = plane_of(both)
    assert plane.normal[0] == pytest.approx(1.0, abs=1e-3)
    twin = twins_of(both, plane)
    assert (twin >= 0).mean() > 0.99
    apart = plane.mirrored(both.face_centroids) - both.face_centroids[np.maximum(twin, 0)]
    assert np.linalg.norm(apart[twin >= 0], axis=1).max() < both.edge_length.max()


@pytest.mark.parametrize(("shape", "count"), [
    (shapes.table_of_blocks(), 2), (shapes.cross_of_blocks(8, 6), 3), (shapes.cross_of_blocks(7, 7), 3),
    (shapes.prism_of_rays(3), 2), (shapes.prism_of_rays(4), 3), (shapes.prism_of_rays(5), 2),
    (shapes.mirrored_figure(), 1)])
def test_planes_across_each_other(shape, count):
    for seed in range(3):
        rng = np.random.default_rng(seed)
        vertices, turn = shape[0], shapes.rotation(rng)
        found = small_faces(vertices @ turn.T + rng.normal(size=3), shape[1])
        planes = [(images.plane, images.exact_twins) for images in Images(found, mirror_plane(found)).exact]
        assert len(planes) == count
        normals = np.array([plane.normal for plane, _ in planes])
        assert np.allclose(normals @ normals.T, np.eye(count), atol=1e-6)
        centers = np.array([vertices[face].mean(axis=0) for face in shape[1]]) @ turn.T
        for plane, twin in planes:
            apart = centers[twin] - centers
            assert np.allclose(apart, (apart @ plane.normal)[:, None] * plane.normal, atol=1e-6)
            assert all(np.array_equal(twin[other], other[twin]) for _, other in planes)


@pytest.mark.parametrize("rays", [3, 4, 5, 8, 12])
def test_two_planes_of_a_star_are_next_to_each_other(rays):
    vertices, faces = shapes.prism_of_rays(rays)
    found = small_faces(vertices @ shapes.rotation(np.random.default_rng(rays)).T + 3, faces)
    one, other = Images(found, mirror_plane(found)).meeting
    assert abs(one.plane.normal @ other.plane.normal) == pytest.approx(np.cos(np.pi / rays), abs=1e-6)


@pytest.mark.parametrize("shape", [shapes.table_of_blocks(), shapes.mirrored_figure(), shapes.icosphere(2)])
def test_nothing_else_has_planes_that_meet_at_other_angles(shape):
    found = small_faces(*shape)
    assert Images(found, mirror_plane(found)).meeting == []


def test_an_exact_plane_comes_before_one_that_is_nearly_as_good():
    # Front and back of a flat figure are more alike than its sides are to a few points, but only the sides exactly.
    vertices, faces = shapes.mirrored_figure()
    bump = np.exp(-((vertices - (0.0, vertices[:, 1].max(), 0.0)) ** 2).sum(axis=1) / 0.02)
    vertices = vertices * (1.0, 0.3, 1.0) + 0.02 * bump[:, None] * (0.0, 1.0, 0.0)
    for turn in (np.eye(3), np.eye(3)[[1, 2, 0]], np.eye(3)[[2, 0, 1]]):
        plane = plane_of(TriMesh(vertices @ turn.T, faces))
        assert abs(plane.normal @ turn[:, 0]) == pytest.approx(1.0, abs=1e-6)


def test_a_dent_on_one_side_leaves_no_exact_plane():
    vertices, faces = shapes.mirrored_figure()
    vertices = vertices.copy()
    vertices[vertices[:, 0].argmax()] *= 0.95
    mesh = TriMesh(vertices, faces)
    plane = plane_of(mesh)
    assert plane is not None
    assert Images(SmallFaces.of(mesh), plane).exact == []


def test_planes_across_one_are_asked_for_where_it_mirrors_nearly_all_and_taken_where_they_do():
    box, wedge = shapes.box((3, 2, 1)), shapes.box((3, 2, 1)).vertices.copy()
    wedge[wedge[:, 2] > wedge[:, 2].mean(), 0] /= 2  # its sides in y alone are mirror images
    for shape, count in ((box, 3), ((wedge, box.faces), 1)):
        found = SmallFaces.of(TriMesh(*shape))
        plane = mirror_plane(found)
        assert len(Images(found, plane).within) == count
        assert len(Images(found, replace(plane, share=1 - 1.1 * EXACT)).within) == 1


def test_a_twisted_tree_has_no_plane():
    assert plane_of(TriMesh(*shapes.tube_tree())) is None


def test_the_two_sides_of_a_thin_plate_are_not_confused():
    mesh = TriMesh(*shapes.subdivide(shapes.subdivide(shapes.subdivide(shapes.box((4.0, 1.0, 0.02))))))
    plane = plane_of(mesh)
    twin = twins_of(mesh, plane)
    assert np.allclose(plane.turned(mesh.face_normals), mesh.face_normals[twin], atol=1e-4)


def test_the_surface_that_is_searched_says_what_is_compared(monkeypatch):
    elements = SmallFaces.of(TriMesh(*shapes.icosphere(2))).elements
    several = small.Elements.joined([elements] * 2)
    every = np.arange(len(elements.area))
    for dense in (0, 1.5 * len(every), np.inf):  # both are dense; only what is searched for is; none is
        monkeypatch.setattr(small, "DENSE", dense)
        distance, nearest = small.Elements.joined([elements]).nearest(several)
        assert (nearest == np.concatenate([every, every])).all()
        assert (distance == 0).all()
