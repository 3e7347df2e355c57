# SPDX-License-Identifier: GPL-3.0-or-later
"""The Reeb graph: loops are the genus, and chains are contracted to arcs, nothing else."""

import numpy as np
import pytest
import shapes

from core.arrays.components import components
from core.graph.critical import MAXIMUM, MINIMUM, SADDLE, critical_points, total_order
from core.graph.level_sets import cut_at_levels, uniform_levels
from core.graph.reeb import ReebGraph, _node_means, _saddle_values, reeb_graph, reeb_topology
from core.mesh.triangles import TriMesh
from core.parameters import Parameters
from core.pipeline import decompose

UNIT = 1e-9


def graph_of(shape, values, levels):
    sets = cut_at_levels(TriMesh(*shape), np.asarray(values, float), np.asarray(levels, float))
    topology = reeb_topology(sets)
    return sets, topology, reeb_graph(sets, topology)


def along(shape, direction, n_slabs=60):
    values = shape.vertices @ np.asarray(direction, float)
    return graph_of(shape, (values - values.min()) / np.ptp(values), uniform_levels(n_slabs))


def test_three_valleys_and_two_hills_by_hand():
    # Heights 0 1 0 1 0 along a strip, one level: every piece is a node, every contour an arc.
    _, topology, graph = graph_of(shapes.flat_grid(4, 1), np.repeat([0, 1, 0, 1, 0], 2), [0.5])
    assert topology.n_nodes == 5
    assert sorted(graph.node_kind.tolist()) == [MINIMUM, MINIMUM, MINIMUM, MAXIMUM, MAXIMUM]
    assert graph.n_arcs == 4
    assert graph.n_loops == 0
    ends = {tuple(graph.node_position[a, :1].round(6)) + tuple(graph.node_position[b, :1].round(6))
            for a, b in graph.arcs}
    assert ends == {(0.0, 1.0), (2.0, 1.0), (2.0, 3.0), (4.0, 3.0)}
    assert graph.node_value[graph.node_kind == MINIMUM].tolist() == [0, 0, 0]
    np.testing.assert_allclose(np.sort(graph.point_position[:, 0]), [0.5, 1.5, 2.5, 3.5])


def test_square_in_strips_is_one_arc():
    _, topology, graph = graph_of(shapes.flat_grid(1, 1), [0, 0, 1, 1], [0.25, 0.5, 0.75])
    assert topology.n_nodes == 2
    assert graph.arcs.shape == (1, 2)
    assert graph.node_kind[graph.arcs[0]].tolist() == [MINIMUM, MAXIMUM]
    np.testing.assert_allclose(graph.point_position, [(x, 0.5, 0) for x in (0.25, 0.5, 0.75)])
    assert graph.point_value.tolist() == [0.25, 0.5, 0.75]
    assert graph.point_length.tolist() == pytest.approx([1, 1, 1])
    assert graph.arc_points.tolist() == [0, 3]


def test_standing_torus_by_hand():
    # Minimum - saddle = saddle - maximum, the two saddles joined by both arms of the ring.
    shape = shapes.torus()
    _, _, graph = along(shape, (1, 0.013, 0.007))
    order = np.argsort(graph.node_value)
    assert graph.node_kind[order].tolist() == [MINIMUM, SADDLE, SADDLE, MAXIMUM]
    place = np.argsort(order)
    assert sorted(map(tuple, place[graph.arcs].tolist())) == [(0, 1), (1, 2), (1, 2), (2, 3)]
    assert graph.n_loops == 1
    # The inner rim of the ring lies at x = -0.65 and 0.65 of -1.35..1.35.
    np.testing.assert_allclose(graph.node_value[order], [0, 0.7 / 2.7, 2 / 2.7, 1], atol=0.01)
    # Half way up the contours are the two cross sections of the tube.
    middle = np.abs(graph.point_value - 0.5) < 0.02
    np.testing.assert_allclose(graph.point_radius[middle], 0.35, rtol=0.05)
    np.testing.assert_allclose(np.abs(graph.point_position[middle, 1]), 1, rtol=0.05)


@pytest.mark.parametrize("n_slabs", [7, 12, 60])
def test_nodes_have_the_values_of_the_critical_points(n_slabs):
    # However coarse the levels: not the middle of a slab, but where the saddle is.
    sets, _, graph = along(shapes.torus(), (1, 0.013, 0.007), n_slabs)
    points = critical_points(sets.mesh, total_order(sets.values))
    assert np.sort(graph.node_value).tolist() == sets.values[points.vertex].tolist()


@pytest.mark.parametrize("genus", range(4))
def test_loops_are_the_genus(genus):
    _, _, graph = along(shapes.surface_of_genus(genus), (1, 0.1, 0.03))
    assert graph.n_loops == genus
    assert graph.n_components == 1


@pytest.mark.parametrize("n_branches", [2, 3, 4])
def test_a_tree_of_tubes_has_a_leaf_for_each_branch(n_branches):
    shape = shapes.tube_tree(n_branches)
    distance = np.linalg.norm(shape.vertices, axis=1)
    sets = cut_at_levels(TriMesh(*shape), distance, np.linspace(0.55, distance.max(), 40)[:-1])
    graph = reeb_graph(sets, reeb_topology(sets))
    assert graph.n_loops == 0
    tips = graph.node_position[graph.node_kind == MAXIMUM]
    assert len(tips) == n_branches
    for tip in shapes.TREE_TIPS[:n_branches]:
        assert np.linalg.norm(tips - tip, axis=1).min() < 0.35


CASES = {
    "random": lambda rng: (shapes.surface_of_genus(2, 0.25), None),
    "border": lambda rng: (shapes.flat_grid(14, 9), None),
    "two": lambda rng: (shapes.two_spheres(), None),
    "tied": lambda rng: (shapes.icosphere(2), 4),
    "fin": lambda rng: (shapes.with_fin(shapes.icosphere(2)), None),
}


@pytest.fixture(params=[(name, seed) for name in CASES for seed in range(2)], ids=str)
def made(request):
    name, seed = request.param
    rng = np.random.default_rng(seed)
    shape, steps = CASES[name](rng)
    values = rng.random(len(shape.vertices))
    return graph_of(shape, values if steps is None else np.round(values * steps) / steps, uniform_levels(9))


def test_arcs_are_maximal_chains(made):
    sets, topology, _ = made
    lower, upper = sets.contour_pieces.T
    below = np.bincount(upper, minlength=sets.n_pieces)
    above = np.bincount(lower, minlength=sets.n_pieces)
    np.testing.assert_array_equal(topology.piece_node < 0, (below == 1) & (above == 1))
    np.testing.assert_array_equal(topology.piece_node < 0, topology.piece_arc >= 0)
    assert (topology.contour_arc >= 0).all()
    # Each contour's pieces belong to its arc, or are the arc's ends.
    for side, piece in enumerate((lower, upper)):
        node, arc = topology.piece_node[piece], topology.piece_arc[piece]
        inside = node < 0
        np.testing.assert_array_equal(arc[inside], topology.contour_arc[inside])
        np.testing.assert_array_equal(node[~inside], topology.arcs[topology.contour_arc[~inside], side])
    # One contour of each level at most: an arc is a path that rises.
    keys = topology.contour_arc * (len(sets.levels) + 1) + sets.contour_level
    assert len(np.unique(keys)) == len(keys)


def test_graph_has_the_loops_and_components_of_the_surface(made):
    sets, _, graph = made
    assert graph.n_loops == sets.n_loops
    assert graph.n_components == components(sets.n_pieces, *sets.contour_pieces.T)[0]
    assert len(graph.point_value) == sets.n_contours


def test_nodes_are_what_their_arcs_make_them(made):
    _, _, graph = made
    below = np.bincount(graph.arcs[:, 1], minlength=graph.n_nodes)
    above = np.bincount(graph.arcs[:, 0], minlength=graph.n_nodes)
    np.testing.assert_array_equal(graph.node_kind == MINIMUM, below == 0)
    np.testing.assert_array_equal(graph.node_kind == MAXIMUM, (above == 0) & (below > 0))
    saddle = graph.node_kind == SADDLE
    assert (below[saddle] + above[saddle] >= 3).all()


def test_arcs_rise_and_so_do_their_center_lines(made):
    _, _, graph = made
    low, high = graph.node_value[graph.arcs].T
    assert (low <= high).all()
    for arc in range(graph.n_arcs):
        points = graph.point_value[graph.arc_points[arc]: graph.arc_points[arc + 1]]
        assert len(points) > 0
        assert (np.diff(points) > 0).all()
        assert low[arc] <= points[0] + UNIT
        assert points[-1] <= high[arc] + UNIT
    np.testing.assert_array_equal(np.repeat(np.arange(graph.n_arcs), np.diff(graph.arc_points)), graph.point_arc)


def test_tips_lie_on_the_surface(made):
    sets, _, graph = made
    for node in np.flatnonzero(graph.node_kind != SADDLE):
        at = np.flatnonzero((sets.mesh.vertices == graph.node_position[node]).all(axis=1))
        assert graph.node_value[node] in sets.values[at]


@pytest.mark.parametrize("seed", range(3))
def test_permuted_moved_and_scaled(seed):
    rng = np.random.default_rng(seed)
    shape = shapes.surface_of_genus(2, 0.2)
    values = rng.random(len(shape.vertices))
    other, vertex, _ = shapes.shuffled(shape, rng)
    turn, offset = shapes.rotation(rng), rng.normal(size=3)
    _, _, one = graph_of(shape, values, uniform_levels(12))
    _, _, two = graph_of(shapes.Shape(2 * other.vertices @ turn.T + offset, other.faces), values[vertex],
                         uniform_levels(12))
    assert (one.n_nodes, one.n_arcs, one.n_loops) == (two.n_nodes, two.n_arcs, two.n_loops)
    np.testing.assert_allclose(np.sort(one.node_value), np.sort(two.node_value))
    np.testing.assert_allclose(np.sort(2 * one.point_length), np.sort(two.point_length), atol=1e-9)
    order = [np.lexsort(p.round(6).T) for p in (2 * one.node_position @ turn.T + offset, two.node_position)]
    np.testing.assert_allclose((2 * one.node_position @ turn.T + offset)[order[0]],
                               two.node_position[order[1]], atol=1e-5)


def test_joined_graphs_stay_what_they_were():
    _, _, one = along(shapes.torus(), (1, 0.01, 0.02))
    _, _, two = along(shapes.icosphere(2), (0.1, 0.2, 1))
    joined = ReebGraph.join([one, two])
    assert joined.n_components == 2
    assert joined.n_loops == 1
    assert joined.n_nodes == one.n_nodes + two.n_nodes
    np.testing.assert_array_equal(joined.arcs[one.n_arcs:], two.arcs + one.n_nodes)
    np.testing.assert_array_equal(joined.point_arc[len(one.point_value):], two.point_arc + one.n_arcs)
    np.testing.assert_array_equal(joined.node_position[one.n_nodes:], two.node_position)


def test_a_flat_field_is_one_node():
    _, topology, graph = graph_of(shapes.icosphere(1), np.zeros(42), [])
    assert topology.n_nodes == graph.n_nodes == 1
    assert graph.n_arcs == graph.n_loops == 0
    assert graph.arc_points.tolist() == [0]


@pytest.mark.parametrize("seed", [0, 1, 3])
def test_arcs_run_upwards(seed):
    """Noise makes leaves that are cancelled; their saddles once gave nodes a value beyond those of their neighbors."""
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.genus_two() if seed % 2 else shapes.tube_tree()
    noisy = vertices + rng.normal(0, 0.01 * np.ptp(vertices), vertices.shape)
    for n_slabs in (8, 20, 100):
        graph = decompose(noisy, faces, Parameters(n_slabs=n_slabs, method="berretti")).graph
        low, high = graph.node_value[graph.arcs].T
        assert (low <= high).all()
        assert (low <= graph.point_value[graph.arc_points[:-1]]).all()
        assert (high >= graph.point_value[graph.arc_points[1:] - 1]).all()
        same_arc = np.diff(graph.point_arc) == 0
        assert (np.diff(graph.point_value)[same_arc] >= 0).all()


@pytest.mark.parametrize("seed", range(5))
def test_the_saddle_of_a_node_is_its_sharpest_and_then_its_nearest(seed):
    mesh = TriMesh(*shapes.icosphere(3))
    values = mesh.vertices[:, 2] + 0.25 * np.random.default_rng(seed).random(mesh.n_vertices)
    sets = cut_at_levels(mesh, (values - values.min()) / np.ptp(values), uniform_levels(6))
    topology = reeb_topology(sets)
    middle, _ = _node_means(sets, topology)
    points = critical_points(mesh, total_order(sets.values))
    at_node, value = topology.piece_node[sets.vertex_piece[points.vertex]], sets.values[points.vertex]
    found = _saddle_values(sets, topology, middle)
    most = 0
    for node, level in enumerate(middle):
        own = np.flatnonzero((points.kind == SADDLE) & (at_node == node))
        order = np.lexsort((np.abs(value[own] - level), -points.multiplicity[own]))
        assert found[node] == (value[own[order[0]]] if len(own) else level)
        most = max(most, len(own))
    assert most > 1


@pytest.mark.parametrize(("levels", "middles"), [((0.25, 0.5, 0.75), (0.125, 0.875)), ((0.9, 0.95), (0.45, 0.975))])
def test_the_mean_level_of_a_node_is_the_middle_of_its_slab(levels, middles):
    height = shapes.icosphere(3).vertices[:, 2]
    sets, topology, _ = graph_of(shapes.icosphere(3), (height - height.min()) / np.ptp(height), levels)
    np.testing.assert_allclose(np.sort(_node_means(sets, topology)[0]), middles)


def test_of_equal_tips_the_first_is_lowest_and_the_last_highest():
    """As in the total order. A strip whose vertices come in pairs of one height."""
    _, _, graph = graph_of(shapes.flat_grid(2, 1), np.repeat([0, 1, 0], 2), [0.5])
    place = shapes.flat_grid(2, 1).vertices
    lowest = graph.node_position[graph.node_kind == MINIMUM]
    assert sorted(map(tuple, lowest)) == sorted(map(tuple, place[[0, 4]]))
    assert graph.node_position[graph.node_kind == MAXIMUM].tolist() == [place[3].tolist()]
