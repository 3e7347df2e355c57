# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches, measures of regions and greedy merging, by identities."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapes

from core.arrays.components import components
from core.cuts.patches import absorb_small, concave_patches
from core.cuts.perceptual.features import FEATURES
from core.cuts.perceptual.measures import BORDER, REGION, surface_measures
from core.cuts.perceptual.merging import (
    MANY_REGIONS,
    RegionAdjacencyGraph,
    _next,
    _share_of_its_own,
    merge_all_,
)
from core.field.agd import agd_field, coarse_agd
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.mesh.triangles import TriMesh
from core.surface.coarsening import Pyramid


def measured(mesh):
    field = agd_field(mesh, coarse_agd(Pyramid(mesh), np.sqrt(0.02 * mesh.area)), True)
    return surface_measures(cut_at_levels(mesh, field.values, uniform_levels(30)), field)


@pytest.fixture(scope="module")
def tree():
    mesh = TriMesh(*shapes.tube_tree())
    return mesh, measured(mesh), concave_patches(mesh, 40)


def by_length(graph, borders):
    """A judge that needs no model: short borders are strong."""
    return 1.0 / (1.0 + 10 * graph.border[borders, BORDER.length])


def groups_after(merges, n, steps):
    group = np.arange(n)
    for a, b in merges[:steps]:
        group[group == group[b]] = group[a]
    return np.unique(group, return_inverse=True)[1].reshape(-1)


def is_connected(mesh, label):
    same = label[mesh.edges.pairs[:, 0]] == label[mesh.edges.pairs[:, 1]]
    return components(mesh.n_faces, *mesh.edges.pairs[same].T)[0] == len(np.unique(label))


@pytest.mark.parametrize("shape", [shapes.tube_tree(), shapes.torus(), shapes.dumbbell(), shapes.flat_grid(9, 7)])
@pytest.mark.parametrize("count", [1, 5, 60])
def test_patches_are_connected_and_cover_the_surface(shape, count):
    mesh = TriMesh(*shape)
    label = concave_patches(mesh, count)
    assert np.unique(label).tolist() == list(range(label.max() + 1))
    assert label.max() < count
    assert is_connected(mesh, label)


def test_patches_end_at_a_concave_crease():
    """Two balls that meet in a crease: what patches have on both sides is the rim of the neck."""
    mesh = TriMesh(*shapes.dumbbell(neck=0.05))
    label = concave_patches(mesh, 30)
    above = mesh.face_centroids[:, 2] > 0
    upper, both = np.bincount(label, mesh.face_area * above), np.bincount(label, mesh.face_area)
    assert np.minimum(upper, both - upper).sum() < 0.005 * mesh.area


def test_small_regions_join_the_longest_border():
    """Three cells in a row of a grid, the middle one small, touching the right one along more."""
    mesh = TriMesh(*shapes.flat_grid(6, 4))
    x, y = mesh.face_centroids[:, 0], mesh.face_centroids[:, 1]
    label = np.where(x < 3, 0, 1)
    label[(x > 3) & (x < 4) & (y < 1)] = 2  # one edge to the left, two to the right
    assert absorb_small(mesh, label, 2.0 / mesh.area).tolist() == np.where(x < 3, 0, 1).tolist()
    assert absorb_small(mesh, label, 0.5 / mesh.area).tolist() == label.tolist()


def test_sums_of_merged_regions_are_those_of_a_new_start(tree):
    """After any merges the graph equals one made from the merged labels."""
    mesh, measures, label = tree
    graph = RegionAdjacencyGraph(mesh, measures, label)
    n = len(graph.regions.alive)
    merges, _ = merge_all_(graph, by_length)
    for steps in (1, n // 2, n - 3):
        again = RegionAdjacencyGraph(mesh, measures, label)
        for a, b in merges[:steps]:
            again.merge_(again.neighbors[a][b])
            again.measure_()
        group = groups_after(merges, n, steps)
        fresh = RegionAdjacencyGraph(mesh, measures, group[label])
        alive = np.flatnonzero(again.regions.alive)
        to = group[alive]
        for name in ("sums", "around", "perimeter", "level_min", "level_max", "agd_max", "degree", "shape"):
            old, new = getattr(again.regions, name)[alive], getattr(fresh.regions, name)[to]
            np.testing.assert_allclose(old, new, rtol=1e-6, atol=1e-6, err_msg=name)
        borders = [(index, fresh.neighbors[group[a]][group[b]])
                   for a in alive for b, index in again.neighbors[a].items() if a < b]
        assert len(borders) == len(fresh.ends)
        old, new = np.transpose(borders)
        np.testing.assert_allclose(again.features_(old), fresh.features_(new), rtol=1e-5, atol=1e-5)


def test_merging_leaves_one_region_and_every_step_is_a_partition(tree):
    mesh, measures, label = tree
    graph = RegionAdjacencyGraph(mesh, measures, label)
    n = len(graph.regions.alive)
    merges, salience = merge_all_(graph, by_length)
    assert merges.shape == (n - 1, 2)
    assert salience.shape == (n - 1,)
    assert graph.regions.alive.sum() == 1
    for steps in range(0, n, 7):
        merged = groups_after(merges, n, steps)[label]
        assert merged.max() + 1 == n - steps
        assert is_connected(mesh, merged)


@pytest.mark.parametrize(("middle", "own"), [
    (lambda x, y: (x > 3) & (x < 4) & (y < 1), 0.2),  # a wedge beside the cut between two larger regions
    (lambda x, y: (x > 3) & (x < 4), 0.6),            # between two that do not touch
    (lambda x, y: (x > 2) & (x < 4) & (y < np.where(x > 3, 3, 2)), 0.28),  # 5 cells beside 10 and 9
    (lambda x, y: (x > 1) & (x < 5) & (y < 2), 0.6)],  # 8 beside 8 and 8
    ids=["wedge", "handle", "nearly half as large", "equal"])
def test_a_region_that_belongs_to_one_of_two_neighbors_is_hardly_a_part_of_its_own(middle, own):
    mesh = TriMesh(*shapes.flat_grid(6, 4))
    x, y = mesh.face_centroids[:, 0], mesh.face_centroids[:, 1]
    label = np.where(middle(x, y), 2, x > 3)
    graph = RegionAdjacencyGraph(mesh, measured(mesh), label)
    merges, share = merge_all_(graph, lambda graph, borders: np.where(graph.ends[borders].max(axis=1) == 2, 0.6, 0.9))
    assert merges[0].tolist() == [0, 2]
    assert share[0] == pytest.approx(own)


@pytest.mark.parametrize(("length", "own"), [(0.7, 0.0), (0.9, 0.0857), (1.1, 0.2571), (1.3, 0.4286), (1.6, 0.6)])
@pytest.mark.parametrize("scale", [0.01, 30.0])
def test_the_two_rims_of_a_ring_shorter_than_its_radius_are_one_cut(length, own, scale):
    """Between two larger parts, as an arm and a trunk: the same cut, found twice."""
    vertices, faces = shapes.cylinder(160, 60, length=8.0, capped=False)
    z = np.floor(20 * vertices[faces].mean(axis=1)[:, 2]) / 20 + 0.025 - 4  # of rows of faces
    label = np.where(abs(z) < length / 2, 1, np.where(z > 0, 2, 0))
    mesh = TriMesh(scale * vertices, faces)
    graph = RegionAdjacencyGraph(mesh, measured(mesh), label)
    merges, share = merge_all_(graph, lambda graph, borders: np.where((graph.ends[borders] == 1).any(axis=1), 0.6, 0.9))
    assert 1 in merges[0]
    assert share[0] == pytest.approx(own, abs=0.002)


def test_whole_surface_has_the_sums_of_the_whole(tree):
    mesh, measures, label = tree
    graph = RegionAdjacencyGraph(mesh, measures, label)
    merge_all_(graph, by_length)
    sums = graph.regions.sums[graph.regions.alive][0]
    assert sums[REGION.area] == pytest.approx(1)
    assert sums[REGION.angle_defect] == pytest.approx(2 * np.pi * mesh.euler_characteristic)
    np.testing.assert_allclose(sums[REGION.normal], 0, atol=1e-9)  # a closed surface
    a, b, c = mesh.corners.transpose(1, 0, 2)
    volume = (a * np.cross(b, c)).sum() / 6
    assert sums[REGION.support] / 3 == pytest.approx(volume / mesh.area**1.5)


@pytest.mark.parametrize("seed", [0, 1])
def test_features_do_not_depend_on_scale_pose_or_order(tree, seed):
    mesh, measures, label = tree
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    faces, vertices = rng.permutation(mesh.n_faces), rng.permutation(mesh.n_vertices)
    place = np.argsort(vertices)
    moved = TriMesh(7.0 * (mesh.vertices @ turn.T + 3.0)[vertices], place[mesh.faces[faces]])
    graph = RegionAdjacencyGraph(mesh, measures, label)
    other = RegionAdjacencyGraph(moved, measured(moved), label[faces])
    assert other.ends.tolist() == graph.ends.tolist()
    rows = [g.features_(np.arange(len(g.ends))) for g in (graph, other)]
    # Thickness is measured at probes, and which face is a probe depends on rounding.
    exact = [i for i, name in enumerate(FEATURES)
             if not any(word in name for word in ("thickness", "slenderness", "clearance", "hollowness", "siblings"))]
    np.testing.assert_allclose(rows[1][:, exact], rows[0][:, exact], rtol=2e-3, atol=2e-3)


def test_every_feature_is_finite_on_awkward_meshes():
    for shape in (shapes.tetrahedron(), shapes.flat_grid(3, 2), shapes.box(), shapes.cylinder(4, 8, capped=False)):
        mesh = TriMesh(*shape)
        graph = RegionAdjacencyGraph(mesh, measured(mesh), np.arange(mesh.n_faces))
        assert np.isfinite(graph.features_(np.arange(len(graph.ends)))).all()


def test_a_region_that_is_hardly_larger_takes_hardly_anything():
    """Three regions of areas 1, 1.5 and 3, each of which touches the others: the smallest is parted from both by 0.6.
    The first may own half of what it would if twice as large: so 1 - 0.5 * 0.4 - 0.4 = 0.4 is left of its own, and
    the share falls from 0.6 to that for the larger, half as far for the other."""
    sums = np.zeros((3, REGION.width))
    sums[:, REGION.area] = 1.0, 1.5, 3.0
    graph = SimpleNamespace(regions=SimpleNamespace(sums=sums), ends=np.array([(0, 1), (0, 2), (1, 2)]),
                            neighbors=[{1: 0, 2: 1}, {0: 0, 2: 2}, {0: 1, 1: 2}])
    strength = np.array([0.6, 0.6, 0.9])
    assert _share_of_its_own(graph, strength, 1) == pytest.approx(0.4)
    assert _share_of_its_own(graph, strength, 0) == pytest.approx(0.5)


def in_a_row(strength):
    """The borders between regions in a row, which of them merge next."""
    count = len(strength) + 1
    graph = SimpleNamespace(regions=SimpleNamespace(alive=np.ones(count, bool)),
                            ends=np.stack([np.arange(count - 1), np.arange(1, count)], axis=1))
    return _next(graph, np.array(strength), count)


def test_which_regions_merge_in_one_round():
    """Of few, those whose cut is weak; of many, those with the weakest fifth of all cuts; never one region twice."""
    assert in_a_row([0.05, 0.5, 0.11, 0.5]) == [0, 2]
    assert in_a_row([0.05, 0.5, 0.13, 0.5]) == [0]
    assert in_a_row([0.2, 0.5, 0.2, 0.5]) == [0]
    assert in_a_row([0.05, 0.05, 0.5]) == [0]
    strength = np.full(MANY_REGIONS, 0.9)
    strength[::2] = 0.2 + np.arange(MANY_REGIONS // 2) / 100
    assert in_a_row(strength) == list(range(0, 2 * (MANY_REGIONS // 5) + 1, 2))
