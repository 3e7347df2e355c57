# SPDX-License-Identifier: GPL-3.0-or-later
"""Fusion of regions: the small ones, and those that do not stick out."""

import numpy as np
import pytest
import shapes
from heights import HEIGHTS, counted

from core.arrays.components import components
from core.cuts.berretti.fusion import FusionGraph, fuse_small, fuse_weakest
from core.cuts.berretti.regions import fuse_equal_adjacency, regions_between_events
from core.graph.level_sets import cut_at_levels
from core.graph.reeb import reeb_topology
from core.graph.simplify import simplify
from core.mesh.triangles import TriMesh
from core.parameters import Parameters
from core.pipeline import decompose

LEAST = 1e-9  # a threshold at which no region is small


@pytest.fixture(params=HEIGHTS)
def made(request):
    sets = HEIGHTS[request.param]()
    topology = simplify(sets, reeb_topology(sets), 0.0025, 1, counted(sets))
    return sets, *fuse_equal_adjacency(sets, *regions_between_events(sets, topology))


def test_small_regions_go_smallest_first(made):
    sets, count, region = made
    merges, ratio = fuse_small(sets, count, region)
    assert merges.shape == (count - 1, 2)
    area, part = np.bincount(region, sets.piece_area, count), np.arange(count)
    for (keep, gone), share in zip(merges, ratio, strict=True):
        alive, total = np.unique(part, return_inverse=True)
        now = np.bincount(total.reshape(-1), area)
        assert share == pytest.approx(now.min() / now.max())
        assert now[np.flatnonzero(alive == part[gone])[0]] == pytest.approx(now.min())
        # The neighbor along the longest boundary.
        lower, upper = part[region[sets.contour_pieces]].T
        mine = (lower == part[gone]) != (upper == part[gone])
        other = np.where(lower == part[gone], upper, lower)[mine]
        length = np.bincount(other, sets.contour_length[mine], count)
        assert length[part[keep]] == pytest.approx(length.max())
        part[part == part[gone]] = part[keep]
    assert len(np.unique(part)) == 1


def test_region_graph_by_hand():
    # A strip of heights 0 1 0 1 0 cut at one half: areas 1/2, 1, 1, 1, 1/2 in a row.
    sets = cut_at_levels(TriMesh(*shapes.flat_grid(4, 1)), np.repeat([0.0, 1, 0, 1, 0], 2), np.array([0.5]))
    left_to_right = sets.vertex_piece[::2]
    region = np.empty(5, np.int64)
    region[left_to_right] = np.arange(5)
    graph = FusionGraph(sets, 5, region)
    assert graph.area == pytest.approx([0.5, 1, 1, 1, 0.5])
    assert graph.neighbors[2] == pytest.approx({1: 1.0, 3: 1.0})
    graph.merge_(1, 2)
    assert graph.neighbors[1] == pytest.approx({0: 1.0, 3: 1.0})
    graph.merge_(3, 0)  # not a neighbor of 3: only the bookkeeping is asked for
    assert graph.neighbors[1] == pytest.approx({3: 2.0})
    assert graph.alive == {1, 3, 4}
    assert sum(graph.area[r] for r in graph.alive) == pytest.approx(4)
    assert graph.longest_boundary(3) == 1


def parted(graph, a, b):
    """Whether a and b are parted where the contours between them are cut, and the area on the side of a: by trying."""
    pairs = np.array([(r, other) for r in graph.alive for other in graph.neighbors[r] if {r, other} != {a, b}])
    _, side = components(len(graph.area), *pairs.reshape(-1, 2).astype(np.int64).T)
    return side[a] != side[b], sum(graph.area[r] for r in graph.alive if side[r] == side[a])


def by_trying(graph):
    """What ``FusionGraph.bridges`` finds."""
    total, found = sum(graph.area[r] for r in graph.alive), {}
    for a in graph.alive:
        for b, (number, _) in graph.contours[a].items():
            bridge, area = parted(graph, a, b)
            if a < b and bridge and number == 1:
                found[a, b] = min(area, total - area)
    return found


@pytest.mark.parametrize("order", [(0, 1, 2, 3, 4), (4, 3, 2, 1, 0), (2, 0, 4, 1, 3)])
def test_of_equal_boundaries_and_areas_the_smaller_number_counts_first(order):
    """The strip of ``test_region_graph_by_hand``, whose regions may be numbered the other way round, or anyhow."""
    sets = cut_at_levels(TriMesh(*shapes.flat_grid(4, 1)), np.repeat([0.0, 1, 0, 1, 0], 2), np.array([0.5]))
    region = np.empty(5, np.int64)
    region[sets.vertex_piece[::2]] = order
    graph = FusionGraph(sets, 5, region)
    assert graph.longest_boundary(order[2]) == min(order[1], order[3])
    merges, salience = fuse_weakest(sets, 5, region, 0.05)
    assert components(5, *merges.T)[0] == 1 == len(merges) - 3
    assert ((salience > 0) & (salience < 1)).all()
    # Both ends are as small as each other: that of the smaller number goes first.
    assert merges[0].tolist() == ([order[1], order[0]] if order[0] < order[4] else [order[3], order[4]])


def test_two_halves_are_one_part_in_the_end():
    sets = cut_at_levels(TriMesh(*shapes.flat_grid(1, 1)), np.array([0.0, 0, 1, 1]), np.array([0.5]))
    merges, salience = fuse_weakest(sets, 2, np.arange(2), 0.05)
    assert sorted(merges[0].tolist()) == [0, 1]
    # Either has an area of 1/2, and a disc whose border is of length 1 has 1 / (4 pi).
    assert salience == pytest.approx([0.5 / (0.5 + 1 / (4 * np.pi))])


def test_bridges_are_the_contours_that_part_the_surface(made):
    graph = FusionGraph(*made)
    while len(graph.alive) > 1:
        assert graph.bridges() == pytest.approx(by_trying(graph))
        first = min(graph.alive)
        graph.merge_(first, min(graph.neighbors[first]))


def test_a_ring_has_no_bridges():
    # Four arcs of a ring: one below, one above and two between. Then two, with two contours between them.
    ring = shapes.torus()
    for levels, count in (((-0.5, 0.5), 4), ((0.0,), 2)):
        sets = cut_at_levels(TriMesh(*ring), ring.vertices[:, 0], np.array(levels))
        assert sets.n_pieces == count
        graph = FusionGraph(sets, count, np.arange(count))
        assert graph.bridges() == {}
        assert {number for around in graph.contours for number, _ in around.values()} == {4 // count}


def test_the_weakest_goes_first(made):
    # What is kept from step to step is what is found anew for each.
    sets, count, region = made
    graph = FusionGraph(sets, count, region)
    for (keep, gone), salience in zip(*fuse_weakest(sets, count, region, 0.05), strict=True):
        area, bridges = graph.area, by_trying(graph)
        small = min(area[r] for r in graph.alive) / (0.05 * max(area[r] for r in graph.alive))
        worth = {(a, b): bridges.get((min(a, b), max(a, b)), min(area[a], area[b])) * 4 * np.pi / longest**2
                 for a in graph.alive for b, (_, longest) in graph.contours[a].items()}
        least = min(small, *worth.values())
        assert salience == pytest.approx(least / (least + 1))
        if least < 0.999 * small:
            assert worth[keep, gone] == pytest.approx(least)
            assert area[gone] <= area[keep]
        else:
            assert area[gone] == pytest.approx(min(area[r] for r in graph.alive))
            assert keep == graph.longest_boundary(gone)
        graph.merge_(int(keep), int(gone))
    assert len(graph.alive) == 1


def rod(*levels):
    """A rod of radius 1 from z = 0 to 8, cut at some heights: its pieces in order, numbered from below."""
    shape = shapes.cylinder(80, 240, length=8.0)
    sets = cut_at_levels(TriMesh(*shape), shape.vertices[:, 2], np.array(levels))
    return sets, len(levels) + 1, sets.piece_slab


@pytest.mark.parametrize("height", [0.05, 0.5, 3.0])
def test_the_end_of_a_rod_sticks_out_by_its_height(height):
    merges, salience = fuse_weakest(*rod(8 - height), LEAST)
    assert merges.tolist() == [[0, 1]]
    area = np.pi + 2 * np.pi * height
    assert salience == pytest.approx(area / (area + np.pi), rel=1e-3)
    assert salience[0] > 0.5


@pytest.mark.parametrize("slope", [0.0, 0.3])
def test_what_lies_in_a_plane_does_not_stick_out(slope):
    # A square in the middle of a sheet has less area than the disc, that on a low pyramid a little more.
    shape = shapes.flat_grid(20, 20, 0.1)
    x, y = (shape.vertices[:, :2] - 1).T
    distance = np.maximum(abs(x), abs(y))
    vertices = np.column_stack([x, y, -slope * distance])
    sets = cut_at_levels(TriMesh(vertices, shape.faces), 1 - distance, np.array([0.45]))
    assert sets.n_pieces == 2
    merges, salience = fuse_weakest(sets, 2, np.arange(2), LEAST)
    assert merges.shape == (1, 2)
    square, border = sets.piece_area[sets.piece_slab == 1], sets.contour_length
    assert square / border**2 == pytest.approx(np.hypot(1, slope) / 16, rel=0.03)
    assert salience == pytest.approx(square / (square + border**2 / (4 * np.pi)), rel=1e-6)
    assert salience[0] < 0.5


def test_all_that_lies_beyond_a_contour_counts():
    # A slice of a rod is flat, but what it carries is not: its two contours part whole ends.
    merges, salience = fuse_weakest(*rod(5, 5.1), LEAST)
    assert merges.tolist() == [[2, 1], [0, 2]]  # the slice joins the shorter end: its contour is the weaker one
    assert salience / (1 - salience) == pytest.approx([1 + 2 * 2.9, 1 + 2 * 3.0], rel=1e-3)


def test_each_foot_of_a_handle_counts_on_its_own():
    # A ring cut in two: each half has two contours, and is as large as it is for either of them.
    shape = shapes.torus(96, 48, ring=1.0, tube=0.25)
    sets = cut_at_levels(TriMesh(*shape), shape.vertices[:, 0], np.array([0.0]))
    merges, salience = fuse_weakest(sets, 2, np.arange(2), LEAST)
    assert merges.shape == (1, 2)
    half, foot = 2 * np.pi**2 * 0.25, np.pi * 0.25**2
    assert salience == pytest.approx(half / (half + foot), rel=0.01)


@pytest.mark.parametrize("step", [0.07, 0.09])
def test_the_handles_of_an_amphora_are_parts(step):
    vertices, faces = shapes.genus_two(step)
    labels = decompose(vertices, faces, Parameters.preset("Berretti 2009")).parts().labels
    center = vertices[faces].mean(axis=1)
    handles, belly = ([labels[np.linalg.norm(center - p, axis=1).argmin()] for p in places]
                      for places in (((0.99, 0, 1.1), (-0.99, 0, 1.1)), ((0, 0.8, 0), (0, -0.8, 0))))
    assert len({*handles, *belly}) == 3


@pytest.mark.parametrize(("shape", "count"), [
    (shapes.box(), 1), (shapes.box((1, 1, 6)), 2), (shapes.octahedron(), 1), (shapes.icosphere(3), 1),
    (shapes.tube_tree(), 6), (shapes.dumbbell(), 2)])
def test_corners_are_no_parts_and_limbs_are(shape, count):
    # Each corner of a cube is a tip of the field. A long box and a dumbbell are cut where the field begins, and each
    # half sticks out.
    assert decompose(*shape, Parameters.preset("Berretti 2009")).parts().count == count


@pytest.mark.parametrize("factor", [1e-4, 1.0, 1e5])
def test_size_is_of_no_account(factor):
    sets, count, region = rod(3, 4.5, 7.7)
    larger = cut_at_levels(TriMesh(sets.mesh.vertices * factor, sets.mesh.faces), sets.values, sets.levels)
    merges, salience = fuse_weakest(sets, count, region, 0.05)
    again, same = fuse_weakest(larger, count, region, 0.05)
    np.testing.assert_array_equal(again, merges)
    assert same == pytest.approx(salience)
