# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's regions: intervals, equal adjacency."""

import numpy as np
import pytest
import shapes
from heights import HEIGHTS, along, counted

from core.arrays.components import components
from core.cuts.berretti.fusion import fuse_small
from core.cuts.berretti.regions import berretti_regions, fuse_equal_adjacency, regions_between_events
from core.graph.level_sets import cut_at_levels
from core.graph.reeb import reeb_topology
from core.graph.simplify import simplify
from core.mesh.triangles import TriMesh


def y_shape():
    """A flat Y of unit squares: stem x 0..3, a bar three wide x 3..4, arms to x = 7 and x = 6.

    Cut half way through every square: slab k is x from k - 1/2 to k + 1/2.
    """
    cells = [(0, 1), (1, 1), (2, 1), (3, 0), (3, 1), (3, 2), (4, 0), (5, 0), (6, 0), (4, 2), (5, 2)]
    shape = shapes.flat_cells(cells)
    return cut_at_levels(TriMesh(*shape), shape.vertices[:, 0], np.arange(7) + 0.5)


def described(sets, count, region):
    """Slabs and area of each region, as a sorted list."""
    return sorted((np.unique(sets.piece_slab[region == r]).tolist(), round(sets.piece_area[region == r].sum(), 9))
                  for r in range(count))


def test_a_y_by_hand():
    sets = y_shape()
    # The bar ends at 4, inside slab 4, which is one piece; the arms are free from 4.5 on. The short arm ends at 6,
    # which does not concern the long one.
    count, region = regions_between_events(sets, reeb_topology(sets))
    stem, short, long = ([0, 1, 2, 3, 4], 7.0), ([5, 6], 1.5), ([5, 6, 7], 2.5)
    assert described(sets, count, region) == [stem, short, long]
    # Neighbors: stem 2, arms 1 each. Nothing is fused.
    assert described(sets, *fuse_equal_adjacency(sets, count, region)) == [stem, short, long]
    # The short arm goes first, at 1.5 of 7, then the long arm at 2.5 of 8.5.
    _, ratio = fuse_small(sets, count, region)
    assert ratio == pytest.approx([1.5 / 7, 2.5 / 8.5])
    regions = berretti_regions(sets, reeb_topology(sets), 0.25)
    assert regions.hierarchy.n_parts(0.5) == 2  # the threshold 0.25 lies between


def test_a_body_with_limbs_along_it_is_one_region():
    # A comb: a back of eleven squares, and a tooth of three on every second one, from the third on.
    cells = [(x, 0) for x in range(11)] + [(x, y) for x in (2, 4, 6, 8) for y in (1, 2, 3)]
    shape = shapes.flat_cells(cells)
    # Higher along the back, and higher still up each tooth.
    values = shape.vertices[:, 0] + 0.9 * np.maximum(shape.vertices[:, 1] - 1, 0)
    sets = cut_at_levels(TriMesh(*shape), values, np.arange(0.25, values.max(), 0.5))
    topology = reeb_topology(sets)
    assert regions_between_events(sets, topology)[0] > 6  # the back falls apart where each tooth begins
    count, region = fuse_equal_adjacency(sets, *regions_between_events(sets, topology))
    # Behind the first tooth: the beginning of the back, at one end of the chain, has one neighbor less.
    back = region[sets.vertex_piece[(shape.vertices[:, 1] == 0) & (np.abs(shape.vertices[:, 0] - 5.5) < 2)]]
    tips = region[sets.vertex_piece[shape.vertices[:, 1] == 4]]
    assert len(set(back.tolist())) == 1
    assert not set(back.tolist()) & set(tips.tolist())
    assert len(set(tips.tolist())) == 4
    assert count <= 7


def test_a_region_ends_where_its_own_level_set_joins_or_splits():
    for shape, direction in ((shapes.surface_of_genus(2), (1, 0.1, 0)), (shapes.tube_tree(), (0.3, 1, 0.2))):
        sets = along(shape, direction)
        topology = reeb_topology(sets)
        count, region = regions_between_events(sets, topology)
        lower, upper = sets.contour_pieces.T
        ends = region[lower] != region[upper]
        assert 0 < ends.sum() < sets.n_contours
        # No region ends along an arc of the graph, away from its nodes.
        inside = (topology.piece_node[lower] < 0) & (topology.piece_node[upper] < 0)
        assert not (ends & inside).any()
        # Within a region no two contours of one level lie side by side, other than around a node.
        for r in range(count):
            levels = sets.contour_level[~ends & (region[lower] == r)]
            assert len(levels) - len(np.unique(levels)) <= (topology.piece_node[region == r] >= 0).sum()


@pytest.fixture(params=HEIGHTS)
def made(request):
    sets = HEIGHTS[request.param]()
    return sets, simplify(sets, reeb_topology(sets), 0.0025, 1, counted(sets))


def region_pairs(sets, region):
    pairs = np.sort(region[sets.contour_pieces], axis=1)
    return np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0)


def assert_connected(sets, count, region):
    assert np.unique(region).tolist() == list(range(count))
    same = region[sets.contour_pieces[:, 0]] == region[sets.contour_pieces[:, 1]]
    assert components(sets.n_pieces, *sets.contour_pieces[same].T)[0] == count


def test_regions_are_connected(made):
    sets, topology = made
    count, region = regions_between_events(sets, topology)
    assert_connected(sets, count, region)
    assert_connected(sets, *fuse_equal_adjacency(sets, count, region))


def test_no_two_regions_of_equal_adjacency_touch(made):
    sets, topology = made
    count, region = fuse_equal_adjacency(sets, *regions_between_events(sets, topology))
    pairs = region_pairs(sets, region)
    degree = np.bincount(pairs.ravel(), minlength=count)
    assert count == 2 or (degree[pairs[:, 0]] != degree[pairs[:, 1]]).all()  # of two, each touches one


def test_the_decision_is_the_papers_threshold():
    # Salience 0.5 where the ratio is the threshold: what is left has no region below it.
    for threshold in (0.02, 0.05, 0.2):
        sets = along(shapes.tube_tree(), (0.3, 1, 0.2))
        topology = simplify(sets, reeb_topology(sets), 0.0025, 1, counted(sets))
        regions = berretti_regions(sets, topology, threshold)
        kept = regions.hierarchy.parts_at(0.5)[regions.piece_region]
        area = np.bincount(kept, sets.piece_area)
        assert area.min() >= threshold * area.max() or len(area) == 1


def test_flat_field_is_one_region():
    sets = cut_at_levels(TriMesh(*shapes.icosphere(1)), np.zeros(42), np.empty(0))
    regions = berretti_regions(sets, reeb_topology(sets), 0.05)
    assert regions.hierarchy.n_candidates == 1
    assert regions.hierarchy.n_candidates == 1


def test_a_round_that_would_leave_no_cut_fuses_the_smallest_pair():
    """A ring on its edge: below, two sides, above. Each has two neighbors, until two are left."""
    sets = along(shapes.torus(), (1, 0.01, 0), n_slabs=3)
    assert sets.n_pieces == 4
    count, region = fuse_equal_adjacency(sets, 4, np.arange(4))
    assert count == len(np.unique(region)) == 2
