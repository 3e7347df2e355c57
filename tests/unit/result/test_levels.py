"""Levels of detail: which numbers of parts stand out, and at which detail there are so many parts."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.result.levels import RATIO, detail_between, strong_levels
from core.result.numbering import Numbering


def test_by_hand():
    # From 1 part on: falls of 0 (the first cut), 0.1, 0.6, 0.05, 0.05 and 0.1 behind the last cut.
    salience = np.array([0.9, 0.8, 0.2, 0.15, 0.1])
    np.testing.assert_array_equal(strong_levels(salience, 1), [1, 2, 3, 6])
    np.testing.assert_array_equal(strong_levels(salience, 11), [11, 13, 16])


def test_the_first_cut_hides_no_number_beside_it():
    np.testing.assert_array_equal(strong_levels(np.array([0.3, 0.1]), 11), [11, 12, 13])


@pytest.mark.parametrize("falls", [(0.3, 0.2), (0.2, 0.3)])
def test_a_number_just_a_ratio_away_is_not_beside(falls):
    """From 20 to 27 is RATIO: both stand out."""
    fall = np.full(41, 0.001)
    fall[[0, 10, 17]] = 0.0, *falls
    levels = strong_levels(1.0 - np.cumsum(fall)[:40], 10)
    assert {20, 27} <= set(levels.tolist())


def test_nothing_to_step_through():
    np.testing.assert_array_equal(strong_levels(np.empty(0), 3), [3])


@pytest.mark.parametrize("seed", range(5))
def test_no_number_nearby_has_a_larger_fall(seed):
    salience = np.sort(np.random.default_rng(seed).random(80))[::-1]
    levels = strong_levels(salience, 2)
    fall = np.append(0.0, salience[:-1] - salience[1:])
    fall = dict(zip(range(2, 82), fall, strict=True)) | {82: salience[-1]}
    assert levels[0] == 2
    assert levels[-1] == 82
    assert (np.diff(levels) > 0).all()
    for level in levels[1:-1].tolist():
        near = [number for number in fall if level / RATIO < number < level * RATIO]
        assert fall[level] == max(fall[number] for number in near)
    # Between two steps, nothing that stands out is left out.
    for number in set(fall) - set(levels.tolist()):
        near = [other for other in fall if number / RATIO < other < number * RATIO]
        assert fall[number] <= max(fall[other] for other in near)


def test_the_detail_of_a_number_of_parts_gives_so_many(decomposed):
    numbering = decomposed
    fewest, most = numbering.n_range
    salience = numbering.salience
    for count in range(fewest, most + 1):
        done = count - fewest
        tied = 0 < done < len(salience) and salience[done - 1] == salience[done]
        if not tied:
            assert numbering.parts(numbering.detail_of(count)).parts.count == count


def test_halfway():
    assert detail_between(np.array([0.8, 0.4]), 1) == pytest.approx(1 - 0.6)
    assert detail_between(np.array([0.8, 0.4]), 0) == pytest.approx(1 - 0.9)
    assert detail_between(np.array([0.8, 0.4]), 2) == pytest.approx(1 - 0.2)


@pytest.fixture
def decomposed():
    result = decompose(*shapes.tube_tree())
    none = np.zeros(result.n_candidates, np.int64)
    return Numbering.of(result, none, none)
