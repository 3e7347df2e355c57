# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of like curvature: grown by hand, and merged as a slow search for the nearest pair would."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.arrays.components import components
from core.cuts.lavoue.method import curvature_features, lavoue_candidates
from core.cuts.lavoue.regions import SLIVER_AREA, SLIVER_WEIGHT, CurvatureGraph, grow_regions, merge_regions
from core.mesh.triangles import TriMesh


def connected(mesh, region):
    a, b = mesh.edges.pairs[region[mesh.edges.pairs[:, 0]] == region[mesh.edges.pairs[:, 1]]].T
    return components(mesh.n_faces, a, b)[0] == region.max() + 1


def test_faces_between_two_classes_join_the_nearest_seed():
    # Six squares in a row, cut in two triangles each; the vertices left of x = 2.5 are of one class.
    mesh = TriMesh(*shapes.flat_grid(6, 1))
    width = mesh.vertices[:, 0].max() / 6
    region = grow_regions(mesh, (mesh.vertices[:, 0] > 2.5 * width).astype(int))
    left = mesh.face_centroids[:, 0] < 2.5 * width
    assert region.max() == 1
    assert len(set(region[left].tolist())) == len(set(region[~left].tolist())) == 1


def test_one_class_in_two_places_is_two_regions():
    mesh = TriMesh(*shapes.flat_grid(9, 3))
    x = mesh.vertices[:, 0] / mesh.vertices[:, 0].max()
    region = grow_regions(mesh, ((x > 0.35) & (x < 0.65)).astype(int))
    assert region.max() == 2
    assert connected(mesh, region)


def test_no_face_of_one_class_is_one_region_for_each_piece():
    shape = shapes.together(shapes.tetrahedron(), shapes.moved(shapes.tetrahedron(), (9, 0, 0)))
    region = grow_regions(TriMesh(*shape), np.arange(8))
    np.testing.assert_array_equal(region, np.repeat([0, 1], 4))


def test_a_piece_without_a_seed_beside_one_with_seeds_is_a_region_of_its_own():
    shape = shapes.together(shapes.tetrahedron(), shapes.moved(shapes.tetrahedron(), (9, 0, 0)))
    for without in (0, 4):
        label = np.zeros(8, int)
        label[without:without + 4] = np.arange(4)
        region = grow_regions(TriMesh(*shape), label)
        np.testing.assert_array_equal(region, np.repeat([0, 1], 4))


def test_distance_of_two_regions_by_hand():
    # Two squares side by side, curvature (0, 0) at the left end, (2, 0) on the border, (4, 0) at the right end.
    mesh = TriMesh([(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (2, 0, 0), (2, 1, 0)],
                   [(0, 2, 1), (1, 2, 3), (2, 4, 3), (3, 4, 5)])
    curvature = np.array([(0.0, 0), (0, 0), (2, 0), (2, 0), (4, 0), (4, 0)])
    graph = CurvatureGraph(mesh, curvature, np.array([0, 0, 1, 1]))
    # Means of the faces: 2/3 and 4/3, mean 1, on the left; 3 on the right; 2 between. Nothing but the border has a
    # length, so that each is as wide as its border.
    assert graph.distance(0, 1) == pytest.approx(1 + 1)
    graph.perimeter[:] = 3.0, 5.0
    assert graph.distance(0, 1) == pytest.approx(2 * 3)
    graph.area[0] *= 0.9 * SLIVER_AREA
    graph.sums[0] *= 0.9 * SLIVER_AREA
    assert graph.distance(0, 1) == pytest.approx(2 * 3 * SLIVER_WEIGHT)


def test_the_nearest_pair_merges_first():
    mesh = TriMesh(*shapes.surface_of_genus(1))
    rng = np.random.default_rng(0)
    region = grow_regions(mesh, rng.integers(0, 2, mesh.n_vertices))
    curvature = curvature_features(mesh)
    merges, distance = merge_regions(CurvatureGraph(mesh, curvature, region))
    assert len(merges) == region.max() > 5
    slow = CurvatureGraph(mesh, curvature, region)
    for (a, b), found in zip(merges.tolist(), distance.tolist(), strict=True):
        pairs = [(one, other) for one, around in enumerate(slow.neighbors) for other in around if one < other]
        assert found == pytest.approx(min(slow.distance(*pair) for pair in pairs), rel=1e-12)
        slow.merge_(a, b)
    # What is left is the whole surface.
    assert slow.area[merges[-1, 0]] == pytest.approx(mesh.area)
    assert slow.perimeter[merges[-1, 0]] == pytest.approx(0, abs=1e-9 * np.sqrt(mesh.area))


def test_a_can_is_a_wall_and_two_lids():
    shape = shapes.cylinder(12, 32, radius=0.5)
    parts = decompose(*shape, Parameters.preset("Lavoue 2005", n_parts=3)).parts().labels
    mesh = TriMesh(*shape)
    z = mesh.face_centroids[:, 2]
    lid = np.abs(mesh.face_normals[:, 2]) > 0.5
    for faces in (~lid & (z > z.min() + 0.6) & (z < z.max() - 0.6), lid & (z > 2), lid & (z < 2)):
        assert len(np.unique(parts[faces])) == 1
    assert len({int(parts[z.argmax()]), int(parts[z.argmin()]), int(parts[np.abs(z - 2).argmin()])}) == 3


def test_a_ball_is_one_region():
    label, hierarchy = lavoue_candidates(TriMesh(*shapes.icosphere(3)))
    assert hierarchy.n_candidates == 1
    assert (label == 0).all()
