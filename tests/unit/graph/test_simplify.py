# SPDX-License-Identifier: GPL-3.0-or-later
"""Simplification takes ripples and leaves loops."""

import numpy as np
import pytest
import shapes
from heights import counted

from core.arrays.components import components
from core.field.agd import ScalarField
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.graph.reeb import reeb_graph, reeb_topology
from core.graph.simplify import _WorkGraph, level_height, simplify, without_ripples
from core.mesh.triangles import TriMesh


def noisy(genus, seed, noise=0.3):
    """A rising field with noise on a surface of a genus, cut into 30 slabs."""
    mesh = TriMesh(*shapes.surface_of_genus(genus, 0.2))
    values = mesh.vertices @ (1.0, 0.1, 0.03)
    values = (values - values.min()) / np.ptp(values)
    values = values + noise * np.random.default_rng(seed).random(mesh.n_vertices)
    return cut_at_levels(mesh, values / values.max(), uniform_levels(30))


def leaves(topology):
    degree = np.bincount(topology.arcs.ravel(), minlength=topology.n_nodes)
    return np.flatnonzero((degree[topology.arcs] == 1).any(axis=1))


def arc_area(sets, topology, arc):
    """Area of an arc and of its leaf nodes."""
    degree = np.bincount(topology.arcs.ravel(), minlength=topology.n_nodes)
    ends = topology.arcs[arc][degree[topology.arcs[arc]] == 1]
    inside = (topology.piece_arc == arc) | np.isin(topology.piece_node, ends)
    return sets.piece_area[inside].sum()


def strip(heights):
    """A strip with a height every unit of length, cut at one half."""
    return cut_at_levels(TriMesh(*shapes.flat_grid(len(heights) - 1, 1)),
                         np.repeat(np.asarray(heights, float), 2), np.array([0.5]))


def test_by_hand():
    # 0 1 0 1 0: areas of the pieces 1/2, 1, 1, 1, 1/2. The valleys at the ends are leaves of
    # hills with another valley beside: the smaller ones go, and a strip with one valley is left.
    sets = strip([0, 1, 0, 1, 0])
    done = simplify(sets, reeb_topology(sets), 0.2, 0, counted(sets))  # a leaf below 0.8 of 4 goes
    assert len(done.arcs) == 2
    assert done.n_nodes == 3
    graph = reeb_graph(sets, done)
    assert sorted(graph.node_position[:, 0]) == pytest.approx([1, 2, 3])
    # Above the area of everything else, the last hill and the last valley stay all the same.
    last = simplify(sets, reeb_topology(sets), 1.0, 0, counted(sets))
    assert (last.n_nodes, len(last.arcs)) == (2, 1)


def test_an_arc_put_together_from_two_is_as_long_as_both():
    # Two legs and a body. The left leg, from x = 0 to the hip at 7, has a twig at x = 3: three
    # levels below it, four above, two along the twig itself.
    left = [(x, 0) for x in range(7)] + [(3, 1), (3, 2), (2, 2), (1, 2)]
    right = [(x, -4) for x in range(-5, 7)]
    shape = shapes.flat_cells([*left, *right, *((7, y) for y in range(-4, 1)), (8, -2), (9, -2)])
    sets = cut_at_levels(TriMesh(*shape), shape.vertices[:, 0], np.arange(-5, 10) + 0.5)
    topology = reeb_topology(sets)
    assert sorted(np.bincount(topology.contour_arc).tolist()) == [2, 3, 3, 4, 12]
    # With leaves of fewer than five levels gone, the twig is no more and the leg of seven stays.
    done = simplify(sets, topology, 0.0, 5, counted(sets))
    assert sorted(np.bincount(done.contour_arc[done.contour_arc >= 0]).tolist()) == [3, 7, 12]
    assert done.n_nodes == 4
    # The same where each level is half as high: the leg is as high as its two arcs together.
    by_height = simplify(sets, topology, 0.0, 2.5, np.full(len(sets.levels), 0.5))
    assert by_height.contour_arc.tolist() == done.contour_arc.tolist()


def test_nothing_below_the_limits_nothing_changes():
    sets = noisy(1, 0)
    topology = reeb_topology(sets)
    same = simplify(sets, topology, 0.0, 0, counted(sets))
    for name in ("piece_node", "piece_arc", "contour_arc", "arcs"):
        np.testing.assert_array_equal(getattr(same, name), getattr(topology, name))


CASES = [(genus, seed) for genus in range(4) for seed in range(3)]


@pytest.fixture(params=CASES, ids=str)
def made(request):
    genus, seed = request.param
    sets = noisy(genus, seed)
    before = reeb_topology(sets)
    return genus, sets, before, simplify(sets, before, 0.01, 2, counted(sets))


def test_there_was_something_to_do(made):
    _, _, before, after = made
    assert len(after.arcs) < 0.5 * len(before.arcs)


def test_loops_and_components_stay(made):
    genus, _, before, after = made
    for topology in (before, after):
        count, _ = components(topology.n_nodes, *topology.arcs.T)
        assert count == 1
        assert len(topology.arcs) - topology.n_nodes + count == genus


def test_every_piece_is_on_one_node_or_one_arc(made):
    _, _, _, after = made
    np.testing.assert_array_equal(after.piece_node < 0, after.piece_arc >= 0)
    assert after.piece_node.max() == after.n_nodes - 1
    assert np.isin(np.arange(after.n_nodes), after.piece_node).all()
    assert after.arcs.min() >= 0
    assert after.arcs.max() < after.n_nodes


def test_what_is_left_of_small_leaves_has_to_stay(made):
    # A leaf may stay small only where its other end has nothing else on that side.
    _, sets, _, after = made
    n_below = np.bincount(after.arcs[:, 1], minlength=after.n_nodes)
    n_above = np.bincount(after.arcs[:, 0], minlength=after.n_nodes)
    for arc in leaves(after):
        span = (after.contour_arc == arc).sum()
        small = arc_area(sets, after, arc) < 0.01 * sets.mesh.area * (1 - 1e-9) or span < 2
        lower, upper = after.arcs[arc]
        lonely = []
        if n_below[lower] + n_above[lower] == 1:  # a minimum on an arc below its saddle
            lonely.append(n_below[upper] == 1)
        if n_below[upper] + n_above[upper] == 1:
            lonely.append(n_above[lower] == 1)
        assert not small or any(lonely)


def test_no_two_sided_nodes(made):
    _, _, _, after = made
    n_below = np.bincount(after.arcs[:, 1], minlength=after.n_nodes)
    n_above = np.bincount(after.arcs[:, 0], minlength=after.n_nodes)
    assert not ((n_below == 1) & (n_above == 1)).any()


def test_contours_of_an_arc_rise_one_to_a_level(made):
    _, sets, _, after = made
    kept = after.contour_arc >= 0
    key = after.contour_arc[kept] * 100 + sets.contour_level[kept]
    assert len(np.unique(key)) == len(key)
    assert np.isin(np.arange(len(after.arcs)), after.contour_arc).all()
    graph = reeb_graph(sets, after)
    low, high = graph.node_value[graph.arcs].T
    assert (low <= high).all()


def test_contours_end_where_their_arc_says(made):
    _, sets, _, after = made
    for side, end in ((0, "first"), (1, "last")):
        for arc in range(len(after.arcs)):
            contours = np.flatnonzero(after.contour_arc == arc)
            order = contours[np.argsort(sets.contour_level[contours])]
            piece = sets.contour_pieces[order[0 if end == "first" else -1], side]
            node = after.piece_node[piece]
            assert node in (after.arcs[arc, side], -1)
            if node == -1:
                assert after.piece_arc[piece] == arc


def test_more_simplified_is_a_coarser_graph():
    sets = noisy(2, 1)
    topology = reeb_topology(sets)
    sizes = [len(simplify(sets, topology, area, 1, counted(sets)).arcs) for area in (0.0, 0.001, 0.01, 0.05, 0.3)]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[0] > sizes[-1]


def test_a_graph_of_one_node_stays():
    sets = cut_at_levels(TriMesh(*shapes.icosphere(1)), np.zeros(42), np.empty(0))
    done = simplify(sets, reeb_topology(sets), 0.1, 1, counted(sets))
    assert done.n_nodes == 1
    assert len(done.arcs) == 0
    assert done.piece_node.tolist() == [0]
    assert done.piece_arc.tolist() == [-1]


def test_the_height_of_a_level_is_in_units_of_the_largest_agd():
    """AGD of 10 to 20 and three levels: each stands for a quarter of the range, over 20."""
    values = np.linspace(0, 1, 101)
    field = ScalarField(values, values, 10 + 10 * values)
    np.testing.assert_allclose(level_height(field, np.array([0.25, 0.5, 0.75])), 0.125)


def test_the_areas_of_what_is_left_add_up_to_the_surface(made):
    _, sets, before, _ = made
    work = _WorkGraph(sets, before, counted(sets), (0.01 * sets.mesh.area, 2.0))
    work.cancel_leaves()
    assert None in work.arcs
    left = [area for place, area in enumerate(work.area) if work.parent[place] == place]
    assert sum(left) == pytest.approx(sets.mesh.area)


def test_a_leaf_just_as_large_as_the_limit_stays():
    sets = strip([0, 1, 0, 1, 0])  # of 4, its ends have an area of 1/2 each
    topology = reeb_topology(sets)
    assert len(simplify(sets, topology, 0.125, 0, counted(sets)).arcs) == len(topology.arcs)
    assert len(simplify(sets, topology, 0.126, 0, counted(sets)).arcs) < len(topology.arcs)


@pytest.mark.parametrize("upside_down", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_node_that_took_in_a_leaf_stays_between_its_arcs(seed, upside_down):
    """The leaf may reach above the arc that goes on from the node, and the node's value be that of its saddle there."""
    sets = noisy(1, seed, noise=0.6)
    sets = cut_at_levels(sets.mesh, 1 - sets.values, sets.levels) if upside_down else sets
    graph = reeb_graph(sets, simplify(sets, reeb_topology(sets), 0.02 * sets.mesh.area, 0.05, counted(sets)))
    lower, upper = graph.node_value[graph.arcs].T
    first, last = graph.point_value[graph.arc_points[:-1]], graph.point_value[graph.arc_points[1:] - 1]
    assert (lower <= first).all()
    assert (last <= upper).all()


@pytest.mark.parametrize(("share", "flatness", "n_nodes"), [
    (0.0026, 0.0052, 3), (0.0024, 0.0052, 2), (0.0026, 0.0048, 2), (0.5, 0.0048, 2)])
def test_a_ripple_is_smaller_than_a_quarter_of_a_percent_or_flatter_than_half_a_percent(share, flatness, n_nodes):
    """A strip that rises to a hill and falls on its other side. What lies below its one level has half of each side."""
    places = np.array([0, 2 * share, 1])
    mesh = TriMesh(np.column_stack([np.repeat(places, 2), [0, 1] * 3, np.zeros(6)]), shapes.flat_grid(2, 1).faces)
    values = np.repeat([0.0, 1.0, 0.0], 2)
    field = ScalarField(values, values, 1 - 2 * flatness * (1 - values))
    sets = cut_at_levels(mesh, values, np.array([0.5]))
    assert without_ripples(sets, reeb_topology(sets), field).n_nodes == n_nodes


def test_a_leaf_just_as_high_as_the_limit_stays():
    sets = strip([0, 1, 0, 1, 0])
    topology = reeb_topology(sets)
    assert simplify(sets, topology, 0, 1.0, counted(sets)).n_nodes == topology.n_nodes
