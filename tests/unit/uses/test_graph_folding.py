"""Folded graphs: worked out by hand, and what holds for the graph of any mesh at any level of detail."""

from dataclasses import replace

import numpy as np
import pytest
import shapes

from core import decompose
from core.graph.critical import MAXIMUM, MINIMUM, SADDLE
from core.graph.reeb import ReebGraph
from core.uses.graph_folding import arc_lengths, arc_segments, is_crowded, unfolded, without_scraps


def graph_of(kinds, positions, arcs):
    """A graph of straight arcs, each with one center point, in its middle."""
    positions, arcs, none = np.array(positions, float), np.array(arcs, np.int64), np.zeros(len(arcs))
    return replace(
        ReebGraph.empty(), node_kind=np.array(kinds, np.int8), node_value=np.linspace(0, 1, len(kinds)),
        node_position=positions, arcs=arcs, arc_points=np.arange(len(arcs) + 1),
        point_position=positions[arcs].mean(axis=1), point_radius=none, point_length=none, point_value=none,
        n_components=1)


def folded(graph, part):
    """What is unfolded if each center point lies in the part of the node below it."""
    return unfolded(graph, part, part[graph.arcs[:, 0]])


# A body with its middle (0) and two saddles (1, 2); from 1 a leg (3) and a bump of the body (4), from 2 a head (5)
# with two ears (6, 7).
ANIMAL = graph_of(
    [MINIMUM, SADDLE, SADDLE, MAXIMUM, MAXIMUM, SADDLE, MAXIMUM, MAXIMUM],
    [(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, -3, 0), (1, 1, 0), (3, 0, 0), (3, 2, 0), (3, 0, 1)],
    [(0, 1), (1, 2), (1, 3), (1, 4), (2, 5), (5, 6), (5, 7)])


def test_lengths_by_hand():
    np.testing.assert_allclose(arc_lengths(ANIMAL), [1, 1, 3, 1, 1, 2, 1])


def test_points_of_an_arc_follow_each_other():
    """An arc from node 0 to 1 by the points 3, 4 and 5, which is bent, and one from 1 to 2 by 6; nodes come first."""
    bent = replace(
        graph_of([MINIMUM, SADDLE, MAXIMUM], [(0, 0, 0), (4, 0, 0), (6, 0, 0)], [(0, 1), (1, 2)]),
        arc_points=np.array([0, 3, 4]), point_position=np.array([(0, 1, 0), (2, 1, 0), (4, 1, 0), (5, 0, 0)], float),
        point_value=np.zeros(4))
    np.testing.assert_allclose(arc_lengths(bent), [6, 2])
    both = {tuple(segment) for segment in arc_segments(bent, np.array([True, True])).tolist()}
    assert both == {(0, 3), (3, 4), (4, 5), (5, 1), (1, 6), (6, 2)}
    assert arc_segments(bent, np.array([False, True])).tolist() == [[1, 6], [6, 2]]
    assert arc_segments(bent, np.array([False, False])).shape == (0, 2)


def test_one_part_needs_one_node():
    nodes, arcs = folded(ANIMAL, np.zeros(8, np.int64))
    assert nodes.sum() == 1
    assert not arcs.any()


def test_body_leg_and_head_by_hand():
    # The ear that reaches less far goes, and one of the body's two ends, which reach equally far.
    nodes, arcs = folded(ANIMAL, np.array([0, 0, 0, 1, 0, 2, 2, 2]))
    assert np.flatnonzero(~arcs).tolist() in ([0, 6], [3, 6])
    assert nodes[[1, 3, 6]].all()  # the saddle at the leg, the ends of leg and ear
    assert not nodes[[2, 5, 7]].any()  # nothing branches off there any more


def test_every_ear_of_its_own_is_shown():
    nodes, arcs = folded(ANIMAL, np.array([0, 0, 0, 1, 0, 2, 3, 4]))
    assert nodes[[3, 5, 6, 7]].all()
    assert arcs[[2, 4, 5, 6]].all()


def test_a_loop_within_one_part_stays():
    ring = graph_of([MINIMUM, SADDLE, SADDLE, MAXIMUM], [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)],
                    [(0, 1), (1, 2), (1, 2), (2, 3)])
    nodes, arcs = folded(ring, np.zeros(4, np.int64))
    assert arcs[[1, 2]].all()
    assert nodes[[1, 2]].any()


@pytest.fixture(scope="module", params=["tree", "two"])
def result(request):
    shape = shapes.tube_tree() if request.param == "tree" else shapes.genus_two()
    return decompose(*shape)


@pytest.mark.parametrize("n_parts", [1, 2, 5, 9, 30])
def test_at_any_level(result, n_parts):
    parts = result.parts(n_parts=n_parts)
    graph = result.graph
    nodes, arcs = unfolded(graph, parts.node_part, parts.point_part)
    assert set(parts.node_part[nodes]) == set(parts.node_part)  # a node of every part that has one
    between = parts.node_part[graph.arcs[:, 0]] != parts.node_part[graph.arcs[:, 1]]
    assert arcs[between].all()
    # What is left hangs together as before, with the same loops: only branches were cut off.
    ends = np.unique(graph.arcs[arcs])
    if len(ends):
        gone = graph.n_nodes - len(ends)
        assert graph.n_arcs - arcs.sum() == gone
    # Nodes are few: in each part one end of a branch at most that reaches no other part.
    degree = np.bincount(graph.arcs[arcs].ravel(), minlength=graph.n_nodes)
    inside = nodes & (degree < 2)
    reaches = np.isin(np.arange(graph.n_arcs), graph.point_arc[parts.point_part != parts.node_part[
        graph.arcs[graph.point_arc, 0]]]) | between  # arcs that another part has something of
    for part in range(parts.count):
        lone = [node for node in np.flatnonzero(inside & (parts.node_part == part))
                if not reaches[arcs & (graph.arcs == node).any(axis=1)].any()]
        assert len(lone) <= 1


def test_a_branch_is_as_long_as_its_stages_together():
    """From 0, a branch of length 3 to 1, and one of 2 and 2 to 2 and 3; at 2 a bump of 0.5. First the bump is folded,
    then the far half of the long branch, which is 2 long until then and 4 with its other half; so 1 comes before 2."""
    star = graph_of([SADDLE, MAXIMUM, SADDLE, MAXIMUM, MAXIMUM],
                    [(0, 0, 0), (-3, 0, 0), (2, 0, 0), (4, 0, 0), (2, 0.5, 0)], [(0, 1), (0, 2), (2, 3), (2, 4)])
    nodes, arcs = folded(star, np.zeros(5, np.int64))
    assert np.flatnonzero(nodes).tolist() == [0]
    assert not arcs.any()


def test_a_part_of_passages_keeps_the_first():
    """In a row: an end, one saddle that is all of its part, two that are another part, an end."""
    row = graph_of([MINIMUM, SADDLE, SADDLE, SADDLE, MAXIMUM], [(x, 0, 0) for x in range(5)],
                   [(0, 1), (1, 2), (2, 3), (3, 4)])
    nodes, arcs = folded(row, np.array([0, 1, 2, 2, 3]))
    assert np.flatnonzero(nodes).tolist() == [0, 1, 2, 4]
    assert arcs.all()


@pytest.mark.parametrize(("first", "scrap"), [(1, False), (3, True)])
def test_a_stretch_without_nodes_is_seen_only_if_its_part_has_no_other_line(first, scrap):
    """It floated beside a part that was isolated. An arc from node 0 by points 2 to 6 to node 1; part 2 is hidden."""
    chain = np.array([0, 2, 3, 4, 5, 6, 1])
    part = np.array([first, 2, first, 2, 1, 1, 2])
    seen = without_scraps(np.stack([chain[:-1], chain[1:]], axis=1), part, part != 2, 2)
    assert seen.tolist() == [True, False, True, False, scrap, scrap, False]


@pytest.mark.parametrize("hidden", [[], [0], [0, 1, 2]])
def test_nodes_and_what_hangs_on_them_are_seen(hidden):
    part = np.array([0, 1, 2])
    seen = without_scraps(np.array([(0, 1), (1, 2)]), part, ~np.isin(part, hidden), 3)
    assert np.array_equal(seen, ~np.isin(part, hidden))


# On the diagonal, so that the three pictures are one; 45 from end to end, so that marks are 1 wide.
SPREAD = (0, 9, 18, 27, 36, 45)


@pytest.mark.parametrize(("near", "crowded"), [((9.5, 18.5, 27.5), False), ((9.5, 18.5, 27.5, 36.5), True),
                                               ((9.8, 18.8, 27.8, 36.8), False)])
def test_marks_of_which_more_than_a_third_lie_under_others_are_crowded(near, crowded):
    """3 of 9 and 4 of 10; 0.8 along the diagonal are more than a mark in a picture, whose axes are two of the three."""
    place = np.array((*SPREAD, *near), float)
    graph = graph_of([MINIMUM] * len(place), np.stack([place] * 3, axis=1), [(0, 5)])
    assert is_crowded(graph, np.ones(len(place), bool)) == crowded
    assert not is_crowded(graph, np.arange(len(place)) < len(SPREAD))  # what is folded has no mark


def test_marks_are_as_small_as_all_of_the_graph_is_large():
    graph = graph_of([MINIMUM] * 6, np.stack([SPREAD] * 3, axis=1), [(0, 5)])
    far = replace(graph, point_position=np.full((1, 3), 1000.0))
    assert is_crowded(far, np.ones(6, bool))
    assert not is_crowded(far, np.arange(6) < 1)
