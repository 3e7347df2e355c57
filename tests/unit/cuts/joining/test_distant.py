# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of parts at any distance: what parts them on the way, by hand; which parts are compared at all."""

import numpy as np
import pytest

from core.cuts.joining.distant import FAR, FEATURES, LOWEST, MOST_COMPARED, NEVER, NOT_NEAR, STEPS, distant_pairs
from core.cuts.joining.pairs import PartPairs
from core.cuts.joining.part_shapes import PartShapes


def parts_of(near, area, center, agd, piece=None):
    """Near pairs of parts of which only what ``distant_pairs`` looks at is known."""
    count = len(area)
    area, piece = np.asarray(area, float), np.arange(count) if piece is None else np.asarray(piece)
    extents = np.sqrt(area)[:, None] * (3.0, 2.0, 1.0)
    shapes = PartShapes(
        piece, area, np.bincount(piece, area)[piece], np.asarray(center, float), extents,
        np.tile(np.eye(3), (count, 1, 1)), np.tile(np.arange(3), (count, 1)), np.asarray(agd, float), np.zeros(count))
    near, nothing, faces = np.reshape(near, (-1, 2)), np.zeros(len(near)), np.zeros((len(near), 2), int)
    return PartPairs(near, np.empty((len(near), 0)), nothing > 0, nothing, nothing, faces, shapes)


def parted_by(salience):
    """Every two parts of a piece by the same."""
    return lambda a, b: np.full(len(a), salience)


def chain():
    """Four parts in a row, of the pieces 0, 1, 2, 2, and a fifth that is near none."""
    near = parts_of([(0, 1), (1, 2), (2, 3)], [0.1, 0.4, 0.2, 0.25, 0.05],
                    [(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 2, 0), (9, 0, 0)], [0.8, 0.1, 0.3, 0.9, 0.5], [0, 1, 2, 2, 3])
    salience = parted_by(0.25)
    odds = np.array([3.0, -1.0, 2.0])
    merges, score = np.array([(0, 1), (2, 3), (0, 2)]), np.array([3.0, 2.0, -0.5])
    return near, salience, odds, merges, score


def columns(pairs, names, first, second):
    row = pairs.parts.tolist().index([first, second])
    return [pytest.approx(pairs.features[row, FEATURES.index(name)], abs=1e-5) for name in names]


def test_a_chain_by_hand():
    pairs = distant_pairs(*chain())
    assert pairs.parts.tolist() == [[a, b] for a in range(5) for b in range(a + 1, 5)]
    names = ("odds", "weakest", "joined", "steps", "way", "distance", "pass", "same_piece", "salience")
    assert [3, 3, 3, 1, 1, 1, 0.1, 0, 1] == columns(pairs, names, 0, 1)
    assert [NOT_NEAR, -1, -0.5, 3, 4, 8**0.5, 0.1, 0, 1] == columns(pairs, names, 0, 3)
    assert [2, 2, 2, 1, 2, 2, 0.3, 1, 0.25] == columns(pairs, names, 2, 3)
    assert [NOT_NEAR, NEVER, NEVER, STEPS, FAR, 9, LOWEST, 0, 1] == columns(pairs, names, 0, 4)
    # The smaller first: part 2 has 0.2, part 3 has 0.25; both lie above the pass between them, in a piece of 0.45.
    names = ("small_log_area", "large_log_area", "small_climb", "large_climb", "small_log_piece_area")
    assert [np.log(0.2), np.log(0.25), 0.0, 0.6, np.log(0.45)] == columns(pairs, names, 2, 3)
    assert [np.log(0.1), np.log(0.4), 0.7, 0.0, np.log(0.1)] == columns(pairs, names, 0, 1)


def test_what_joins_after_something_less_sure_is_no_surer():
    """Part 2 joins at a score of -0.5, and after it part 3 at 2: parts 0 and 3 are together where -0.5 is enough."""
    near, salience, odds, _, _ = chain()
    pairs = distant_pairs(near, salience, odds, np.array([(0, 1), (0, 2), (0, 3)]), np.array([3.0, -0.5, 2.0]))
    for first, second, score in ((0, 1, 3.0), (0, 2, -0.5), (0, 3, -0.5), (2, 3, -0.5)):
        assert columns(pairs, ["joined"], first, second) == [score]


def test_of_one_shape():
    near = parts_of([(0, 1)], [0.3, 0.3, 0.4], np.zeros((3, 3)), np.zeros(3))
    pairs = distant_pairs(near, parted_by(1.0), np.zeros(1), np.empty((0, 2), int), np.empty(0))
    alike = pairs.features[:, FEATURES.index("alike")]
    assert alike[0] == 0
    assert (alike[1:] > 0).all()


@pytest.mark.parametrize("seed", range(4))
def test_the_order_of_parts_and_of_pairs_changes_nothing(seed):
    rng = np.random.default_rng(seed)
    near, salience, odds, merges, score = chain()
    place, order = rng.permutation(5), rng.permutation(3)
    shapes = near.shapes
    back = np.argsort(place)
    moved = parts_of(np.sort(place[near.parts], axis=1)[order], shapes.area[back], shapes.center[back],
                     shapes.agd[back], shapes.piece[back])
    one, two = distant_pairs(near, salience, odds, merges, score), distant_pairs(
        moved, salience, odds[order], place[merges], score)
    row = {frozenset(pair): k for k, pair in enumerate(two.parts.tolist())}
    same = [row[frozenset(pair)] for pair in place[one.parts].tolist()]
    np.testing.assert_array_equal(one.features, two.features[same])


def test_of_many_parts_the_largest_are_compared():
    count = MOST_COMPARED + 5
    area = np.linspace(1, 2, count)[::-1]
    near = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    arguments = parted_by(1.0), np.zeros(count - 1), np.empty((0, 2), int), np.empty(0)

    def compared(area):
        return np.unique(distant_pairs(parts_of(near, area, np.zeros((count, 3)), np.zeros(count)), *arguments).parts)

    np.testing.assert_array_equal(compared(area), np.arange(MOST_COMPARED))
    # Of parts of one size that do not all fit in none is: which of them come first is chance.
    area[MOST_COMPARED - 10:] = area[-1]
    np.testing.assert_array_equal(compared(area), np.arange(MOST_COMPARED - 10))
    assert len(compared(np.ones(count))) == 0


def test_nothing_near():
    near = parts_of(np.empty((0, 2), int), [0.5, 0.5], np.eye(3)[:2], [0.1, 0.2])
    pairs = distant_pairs(near, parted_by(1.0), np.empty(0), np.empty((0, 2), int), np.empty(0))
    assert columns(pairs, ("odds", "weakest", "steps"), 0, 1) == [NOT_NEAR, NEVER, STEPS]


def test_of_two_parts_whose_areas_differ_by_rounding_the_first_is_the_smaller():
    more = np.nextafter(0.3, 1)
    of_equal, of_unequal = (
        distant_pairs(parts_of([(0, 1)], [area, 0.3], [(0, 0, 0), (1, 0, 0)], [0.2, 0.7]), parted_by(1.0), np.zeros(1),
                      np.empty((0, 2), int), np.empty(0)).features for area in (0.3, more))
    assert of_unequal == pytest.approx(of_equal, abs=1e-9)
