# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundary search: concavity without unit, cuts that slide into necks."""

from dataclasses import replace

import numpy as np
import pytest
import shapes
from heights import along

from core.arrays.components import components
from core.cuts.berretti.boundary_search import _search_runs, concavities, search_boundaries
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.graph.reeb import reeb_topology
from core.mesh.triangles import TriMesh
from core.surface.curvature import k_min


def upright(shape, n_slabs=60):
    """Level sets of the height, 0..1."""
    z = shape.vertices[:, 2]
    return cut_at_levels(TriMesh(*shape), (z - z.min()) / np.ptp(z), uniform_levels(n_slabs))


def parted_at(sets, level):
    """Pieces below a level are region 0, above region 1."""
    return (sets.piece_slab > level).astype(np.int64)


def cut_heights(sets, region):
    """The level of each contour between two regions."""
    lower, upper = region[sets.contour_pieces].T
    return sets.levels[sets.contour_level[lower != upper]]


def moved(sets, region, alpha, sigma=0.1):
    return search_boundaries(sets, reeb_topology(sets), k_min(sets.mesh), region, alpha, sigma)


def test_concavity_has_no_unit_and_its_sign_is_that_of_k_min():
    # The waist of the dumbbell is a saddle of radius 0.25; its balls are convex.
    for scale in (1e-3, 1.0, 1e3):
        vertices, faces = shapes.dumbbell()
        sets = upright(shapes.Shape(scale * vertices, faces), 31)
        curvature = k_min(sets.mesh)
        z = sets.contour_center[:, 2] / scale
        energy = concavities(sets, curvature, np.arange(sets.n_contours), 0.1)
        order = np.argsort(z)
        if scale == 1e-3:
            expected = energy[order]
        np.testing.assert_allclose(energy[order], expected, rtol=1e-6, atol=1e-9)
        assert (energy[np.abs(z) < 0.2] < 0).all()
        assert (energy[np.abs(np.abs(z) - 1.5) < 0.5] > 0).all()
        assert np.abs(z[energy.argmin()]) < 0.4


def test_concavity_of_a_ball_is_that_of_its_circle():
    # k_min is 1 / R everywhere; times the radius of the circle at height h, worth 0.1 of it.
    sets = upright(shapes.icosphere(4), 10)
    curvature = k_min(sets.mesh)
    height = 2 * sets.levels[sets.contour_level] - 1
    energy = concavities(sets, curvature, np.arange(sets.n_contours), 0.1)
    assert energy == pytest.approx(0.1 * np.sqrt(1 - height**2), rel=0.1)


@pytest.mark.parametrize("level", [24, 26, 28, 29, 31, 33, 34])
def test_a_cut_slides_into_the_neck(level):
    # Level 29 of 60 slabs is the middle. A ball's contour counts about +0.045 and the waist's
    # -0.07: worth a way of 0.1 of the range, six levels. The last level may not pay.
    sets = upright(shapes.dumbbell())
    heights = cut_heights(sets, moved(sets, parted_at(sets, level), 0.5))
    assert heights == pytest.approx([0.5], abs=1.01 / 60)


@pytest.mark.parametrize("level", [14, 20, 38, 45])
def test_a_cut_too_far_from_the_neck_stays(level):
    sets = upright(shapes.dumbbell())
    region = parted_at(sets, level)
    np.testing.assert_array_equal(moved(sets, region, 0.5), region)


def test_alpha_zero_moves_nothing_and_alpha_one_moves_at_will():
    sets = upright(shapes.dumbbell())
    region = parted_at(sets, 12)
    np.testing.assert_array_equal(moved(sets, region, 0.0), region)
    heights = cut_heights(sets, moved(sets, region, 1.0))
    curvature = k_min(sets.mesh)
    energy = concavities(sets, curvature, np.arange(sets.n_contours), 0.1)
    assert heights == pytest.approx([sets.levels[sets.contour_level[int(np.argmin(energy))]]])


def test_a_cut_on_a_ball_stays_where_it_is():
    # On a sphere nothing is concave: sliding off to a smaller circle must not pay.
    sets = upright(shapes.icosphere(4), 40)
    region = parted_at(sets, 10)
    np.testing.assert_array_equal(moved(sets, region, 0.5), region)


def test_cuts_do_not_pass_each_other():
    # Two cuts on one side of the neck: the nearer takes it, the other stays on its own side.
    sets = upright(shapes.dumbbell())
    region = (sets.piece_slab > 15).astype(np.int64) + (sets.piece_slab > 22)
    heights = np.sort(cut_heights(sets, moved(sets, region, 1.0)))
    assert len(heights) == 2
    assert heights[0] < heights[1]
    assert np.unique(moved(sets, region, 1.0)).tolist() == [0, 1, 2]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("make", [shapes.tube_tree, lambda: shapes.surface_of_genus(2)])
def test_regions_stay_connected_and_none_is_lost(make, seed):
    # Any cuts of the arcs: afterwards the same regions, and the same ones touch.
    shape = make()
    rng = np.random.default_rng(seed)
    values = shape.vertices @ np.array([1.0, 0.7, 0.2])
    sets = cut_at_levels(TriMesh(*shape), (values - values.min()) / np.ptp(values), uniform_levels(40))
    topology = reeb_topology(sets)
    region = np.where(topology.piece_node >= 0, topology.piece_node, topology.n_nodes + topology.piece_arc)
    region = rng.permutation(topology.n_nodes + len(topology.arcs))[region]
    after = search_boundaries(sets, topology, k_min(sets.mesh), region, 0.7, 0.1)
    same = after[sets.contour_pieces[:, 0]] == after[sets.contour_pieces[:, 1]]
    count, _ = components(sets.n_pieces, *sets.contour_pieces[same].T)
    assert count == len(np.unique(after))
    assert {tuple(sorted(p)) for p in after[sets.contour_pieces].tolist() if p[0] != p[1]} <= {
        tuple(sorted(p)) for p in region[sets.contour_pieces].tolist() if p[0] != p[1]}


def test_upside_down_is_the_same_cut():
    vertices, faces = shapes.dumbbell()
    up = upright(shapes.Shape(vertices, faces))
    down = upright(shapes.Shape(vertices * (1, -1, -1), faces))
    one = cut_heights(up, moved(up, parted_at(up, 22), 0.5))
    two = cut_heights(down, moved(down, parted_at(down, 58 - 22), 0.5))
    assert one == pytest.approx(1 - two, abs=1.01 / 60)


def test_a_cut_may_move_up_to_the_middle_between_itself_and_the_next():
    sets = along(shapes.dumbbell(), (0, 0, 1))
    topology = reeb_topology(sets)
    arc = int(np.bincount(topology.contour_arc[topology.contour_arc >= 0]).argmax())
    contours = np.flatnonzero(topology.contour_arc == arc)
    contours = contours[np.argsort(sets.contour_level[contours])]
    places = np.array([3, 8, 9, 20])
    runs = dict(_search_runs(sets, topology, contours[places]))
    assert list(runs) == contours[places].tolist()
    assert [run.tolist() for run in runs.values()] == [
        contours[start:stop].tolist() for start, stop in ((0, 6), (6, 9), (9, 15), (15, len(contours)))]


def test_concavity_is_worth_at_most_three_tenths_of_the_range():
    sets = upright(shapes.icosphere(3), 2)
    assert concavities(sets, np.full(sets.mesh.n_vertices, -1e9), np.array([0]), 0.1).tolist() == [-0.3]


def test_around_a_closed_contour_it_does_not_matter_where_the_dip_is():
    """The Gaussian runs on from the end of the contour to its beginning, where a narrow dip would count twice."""
    sets = upright(shapes.icosphere(4), 2)
    angle = np.arctan2(*sets.mesh.vertices[:, :2].T)
    found = [concavities(sets, -np.exp(-((np.angle(np.exp(1j * (angle - at))) / 0.2) ** 2)), np.array([0]), 0.05)[0]
             for at in np.linspace(0, 2 * np.pi, 24, endpoint=False)]
    assert min(found) == pytest.approx(max(found), rel=0.05)


def test_a_contour_without_length_has_no_concavity():
    sets = upright(shapes.icosphere(1), 2)
    nowhere = replace(sets, mesh=TriMesh(0 * sets.mesh.vertices, sets.mesh.faces))
    assert concavities(nowhere, np.full(sets.mesh.n_vertices, -1.0), np.array([0]), 0.1).tolist() == [0]
