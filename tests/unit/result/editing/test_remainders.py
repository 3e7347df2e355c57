# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes along with a change by hand, on rows of faces by hand and on random parts."""

import numpy as np
import pytest
import shapes
from face_graphs import graph_of, n_connected, patches, path

from core.mesh.face_graph import FaceGraph
from core.result.editing.mirrored import Sides
from core.result.editing.remainders import halved_between_images, with_small_pieces


@pytest.mark.parametrize("unit", [1.0, 1e-3, 1e3])
@pytest.mark.parametrize(("before", "after", "expected"), [
    # Two faces are cut off from seven: they go along.
    ([1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2], [1, 2, 2, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2],
     [1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2]),
    # More than a third of what is left stays,
    ([1, 2, 2, 2, 2, 2, 2, 2, 2, 2], [1, 2, 2, 1, 1, 1, 2, 2, 2, 2], [1, 2, 2, 1, 1, 1, 2, 2, 2, 2]),
    # and so does more than what was taken.
    ([1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2], [1, 2, 2, 1, 2, 2, 2, 2, 2, 2, 2, 2], [1, 2, 2, 1, 2, 2, 2, 2, 2, 2, 2, 2]),
    # Equal pieces of a part of which next to nothing is left: both stay, and a smaller one goes.
    ([2] * 2 + [2] * 9 + [2] * 2 + [2] * 9 + [2], [2] * 2 + [1] * 9 + [2] * 2 + [3] * 9 + [2],
     [2] * 2 + [1] * 9 + [2] * 2 + [3] * 10),
    # What was apart before is another part in this.
    ([2, 1, 2, 2, 2, 2, 2, 2], [2, 1, 1, 1, 2, 2, 2, 2], [2, 1, 1, 1, 2, 2, 2, 2]),
    # What nothing was taken from stays in its pieces.
    ([2, 1, 2, 2, 2, 2, 1, 1], [2, 1, 2, 2, 2, 2, 1, 3], [2, 1, 2, 2, 2, 2, 1, 3]),
])
def test_small_pieces_go_along(before, after, expected, unit):
    before, after = np.array(before), np.array(after)
    graph = path(len(before), areas=np.full(len(before), unit))
    assert with_small_pieces(graph, before, after).tolist() == expected


@pytest.mark.parametrize(("area", "goes"), [(1.9, 1), (2.1, 2)])
def test_less_than_a_tenth_of_what_the_part_was_goes_along(area, goes):
    """A piece beside one of 3, of a part of 20: more than a third of the largest that is left."""
    graph = path(4, areas=[3.0, 10.0, area, 7.0 - area])
    found = with_small_pieces(graph, np.full(4, 2), np.array([2, 1, 2, 1]))
    assert found.tolist() == [2, 1, goes, 1]


def test_only_what_was_taken_from_its_own_part_takes_a_piece_along():
    """Face 0 of part 5 has a short side at a face that 1 took from 5, and a long one at what 2 took from 6."""
    pairs = np.array([[0, 1], [0, 2], [1, 3], [2, 4]])
    graph = FaceGraph(5, pairs, np.array([1.0, 3.0, 1.0, 1.0]), np.array([1.0, 2.0, 2.0, 9.0, 9.0]))
    before, after = np.array([[5, 5, 6, 5, 6], [5, 1, 2, 5, 6]])
    assert with_small_pieces(graph, before, after).tolist() == [1, 1, 2, 5, 6]


def test_small_beside_what_was_taken():
    before = np.array([1] + [2] * 40)
    after = np.where((before == 1) | (np.arange(41) > 1) & (np.arange(41) < 12), 1, 2)
    assert (with_small_pieces(path(41), before, after, 0.05) == after).all()
    assert (with_small_pieces(path(41), before, after, 0.2)[:12] == 1).all()


def test_a_piece_goes_to_the_part_that_took_most_around_it():
    """One face of part 5 between faces that three parts took; its longest side is at part 2."""
    pairs = np.array([[0, 1], [0, 2], [0, 3], [1, 4], [2, 4], [3, 4]])
    graph = FaceGraph(5, pairs, np.array([1.0, 3.0, 2.0, 1.0, 1.0, 1.0]), np.array([1.0, 1.0, 1.0, 1.0, 9.0]))
    assert with_small_pieces(graph, np.full(5, 5), np.array([5, 1, 2, 3, 5])).tolist() == [2, 1, 2, 3, 5]


@pytest.mark.parametrize("seed", range(6))
def test_only_pieces_that_were_cut_off_change(seed):
    rng = np.random.default_rng(seed)
    graph = graph_of(shapes.icosphere(3))
    before = patches(graph, rng, 5)
    after = np.where(rng.random(graph.n_faces) < 0.3, patches(graph, rng, 3), before)
    result = with_small_pieces(graph, before, after)
    moved = after != before
    assert (result[moved] == after[moved]).all()
    assert n_connected(graph, result) <= n_connected(graph, after)
    # Of what was left of a part in one piece, some is left.
    whole = graph.regions(before)[1]
    assert set(whole[~moved].tolist()) == set(whole[result == before].tolist())


def test_images_are_treated_alike():
    """A row in which each face is the image of the one as far from the other end."""
    rng = np.random.default_rng(0)
    for _ in range(50):
        half, took = np.sort(rng.integers(0, 3, 30)), rng.random(30) < 0.4
        area = rng.random(30)
        graph = path(60, areas=np.concatenate([area, area[::-1]]))
        before = np.concatenate([half, 4 - half[::-1]])
        after = np.where(np.concatenate([took, took[::-1]]), np.where(np.arange(60) < 30, 5, 6), before)
        result = with_small_pieces(graph, before, after)
        image = np.array([4, 3, 2, 1, 0, 6, 5])
        either = image[result[::-1]]
        # What lies across the middle has one neighbor on either side.
        assert ((result == either) | ((result > 4) & (before == 2))).all()


@pytest.mark.parametrize(("without", "after", "expected"), [
    # Two faces between parts 1 and 2 that both went to part 1: one each.
    ([1, 1, 1, 3, 3, 2, 2, 2], [1, 1, 1, 1, 1, 2, 2, 2], [1, 1, 1, 1, 2, 2, 2, 2]),
    # One across the plane stays where it is.
    ([1, 1, 1, 3, 2, 2, 2], [1, 1, 1, 1, 2, 2, 2], [1, 1, 1, 1, 2, 2, 2]),
    # Only what is on the side of part 2 went along with part 1; its image was given to that by hand.
    ([1, 1, 1, 1, 3, 2, 2, 2], [1, 1, 1, 1, 1, 2, 2, 2], [1, 1, 1, 1, 1, 2, 2, 2]),
    # Each went along with the part of the other side: none of the two has both.
    ([1, 1, 1, 3, 3, 2, 2, 2], [1, 1, 1, 2, 1, 2, 2, 2], [1, 1, 1, 2, 1, 2, 2, 2]),
    # Part 2 does not touch what is on its side.
    ([1, 1, 1, 3, 3, 4, 2, 2], [1, 1, 1, 1, 1, 4, 2, 2], [1, 1, 1, 1, 1, 4, 2, 2]),
])
def test_what_lies_between_images_is_divided(without, after, expected):
    count = len(without)
    twin = np.arange(count)[::-1]
    side = np.sign(np.arange(count) - (count - 1) / 2).astype(int)
    image = np.array([0, 2, 1, 3, 4])
    row, without, after = np.arange(count), np.array(without), np.array(after)
    for order in (row, row[::-1]):  # in either order of the faces, of which twins are as far from the end
        sides = Sides(twin, side[order], np.array([0, -1, 1, 0, 0]))
        result = halved_between_images(path(count), without[order], after[order], sides, image)
        assert result[order].tolist() == expected


def test_what_has_no_twin_is_not_between_images():
    """Faces 2 and 5 went to part 1, and 5 lies on the side of part 2: but neither is the image of the other."""
    graph = FaceGraph(6, np.array([[0, 1], [1, 2], [2, 5], [5, 3], [3, 4]]), np.ones(5), np.ones(6))
    without, after = np.array([[1, 1, 3, 2, 2, 3], [1, 1, 1, 2, 2, 1]])
    image, own_side = np.array([0, 2, 1, 3]), np.array([0, -1, 1, 0])
    side = np.array([-1, -1, -1, 1, 1, 1])
    for twins, last in (([4, 3, 5, 1, 0, 2], 2), ([4, 3, -1, 1, 0, -1], 1)):
        found = halved_between_images(graph, without, after, Sides(np.array(twins), side, own_side), image)
        assert found.tolist() == [1, 1, 1, 2, 2, last]
