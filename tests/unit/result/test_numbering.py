# SPDX-License-Identifier: GPL-3.0-or-later
"""Part numbers that follow the parts: answers worked out by hand, and identities."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapes
from decompositions import decomposition_of

from core import Parameters, decompose
from core.arrays.components import components
from core.mesh.labels import majority
from core.result.numbering import NumberedParts, Numbering, follow, inherited
from core.uses.colors import number_colors, number_places

ROUNDING = pytest.mark.parametrize("rounding", [-1e-15, 0.0, 1e-15])  # of one of two areas


def test_follow_takes_the_largest_overlap_first():
    part = np.array([0, 0, 0, 1, 1, 2])
    former = np.array([5, 5, 2, 2, 5, 0])
    # Part 0 covers two of number 5; part 1 one each of 2 and 5; part 2 is new.
    assert follow(part, former, np.ones(6)).tolist() == [5, 2, 1]


def test_follow_weighs_elements():
    part = np.array([0, 0, 1])
    former = np.array([1, 2, 2])
    assert follow(part, former, np.array([1.0, 3.0, 2.0])).tolist() == [2, 3]


@pytest.mark.parametrize(("weight", "wanted"), [(3.0, [5, 1]), (4.0, [5, 2]), (5.0, [5, 2])])
def test_follow_gives_a_part_no_number_of_which_it_has_little_beside_another(weight, wanted):
    """The inner side of a model with Solidify, which is mostly body, was called as a leg."""
    part, former = np.array([0, 1, 1]), np.array([5, 5, 2])
    assert follow(part, former, np.array([9.0, 8.0, weight])).tolist() == wanted


@ROUNDING
def test_follow_takes_overlaps_that_are_equal_but_for_rounding_in_their_order(rounding):
    assert follow(np.array([0, 1]), np.array([3, 3]), np.array([1.0, 1.0 + rounding])).tolist() == [3, 1]
    small = 1e-9 * np.array([1.0, 1.1])  # beside large ones, too
    assert follow(np.array([0, 1, 2]), np.array([3, 3, 4]), np.append(small, 1.0)).tolist() == [1, 3, 4]


def test_follow_gives_new_parts_numbers_nobody_had():
    part = np.array([0, 1, 2, 2])
    former = np.array([1, 1, 1, 3])
    assert follow(part, former, np.array([3.0, 1.0, 1.0, 1.0])).tolist() == [1, 2, 3]


def test_follow_has_a_number_for_a_part_that_holds_a_little_of_many():
    """The largest number in it went to another part, and so few were looked at that none was free."""
    part, former = np.array([0, 1, *[1] * 8]), np.array([1, 1, *range(2, 10)])
    assert follow(part, former, np.array([10.0, 5.0, *[1.0] * 8])).tolist() == [1, 10]


@pytest.mark.parametrize("seed", range(5))
def test_follow_of_the_same_parts_is_the_identity(seed):
    rng = np.random.default_rng(seed)
    part = np.unique(rng.integers(0, 8, 50), return_inverse=True)[1]
    numbers = rng.permutation(20)[: part.max() + 1] + 1
    assert (follow(part, numbers[part], rng.random(50) + 0.1) == numbers).all()


def test_transfer_is_a_majority_and_allows_zero():
    part = np.array([0, 0, 0, 1, 1, 1])
    former = np.array([4, 4, 1, 0, 0, 1])
    assert majority(part, former, np.ones(6), 2).tolist() == [4, 0]


@pytest.fixture(params=["plain", "loose"], scope="module")
def result(request):
    """Many small parts, and the same beside other loose parts."""
    vertices, faces = shapes.tube_tree()
    method = "perceptual"
    if request.param == "loose":
        method = "berretti"
        count = len(vertices)
        vertices = np.concatenate([vertices, vertices + 40.0, 0.5 * vertices - 40.0])
        faces = np.concatenate([faces, faces + count, faces + 2 * count])
    return decompose(vertices, faces, Parameters(method=method))


def none(result):
    return np.zeros(result.n_candidates, np.int64)


def settled(result, detail=0.5, n_parts=0):
    """Numbers as a first run gives them."""
    return inherited(result, detail, n_parts, none(result), none(result))


def levels(numbering):
    """Parts at every number of parts there is."""
    fewest = numbering.splits.n_roots
    return [numbering.parts(0.0, count) for count in range(fewest, fewest + len(numbering.splits.intervals) + 1)]


def test_first_numbers_are_the_labels(result):
    numbers = settled(result)
    assert (numbers[result.candidates] == result.parts(0.5).labels + 1).all()
    numbered = Numbering.of(result, numbers, none(result)).parts(0.5)
    assert (numbered.face_numbers == result.parts(0.5).labels + 1).all()
    assert numbered.names == result.parts(0.5).names


def test_mirror_images_are_named_by_the_lower_number_of_the_two_and_their_side():
    """Parts 2 and 7 are images of each other, 4 is its own, 9 has none."""
    parts = SimpleNamespace(twin=np.array([2, 1, 0, -1]), side=np.array([-1, 0, 1, 0]))
    names = NumberedParts(parts, np.array([2, 4, 7, 9]), None).names
    assert names == ("Part 02.R", "Part 04", "Part 02.L", "Part 09")


def test_every_level_is_the_hierarchy_s(result):
    numbering = Numbering.of(result, settled(result), none(result))
    assert len(levels(numbering)) > 10
    for numbered in levels(numbering):
        wanted = result.parts(n_parts=numbered.parts.count)
        assert (np.unique(np.stack([wanted.labels, numbered.face_numbers]), axis=1).shape[1]
                == wanted.count == numbered.parts.count)
    for detail in np.linspace(0, 1, 11):
        assert numbering.parts(detail).parts.count == result.parts(detail).count


@pytest.mark.parametrize("seed", range(3))
def test_a_split_gives_one_new_number_and_changes_no_other(result, seed):
    rng = np.random.default_rng(seed)
    first = settled(result, n_parts=int(rng.integers(3, result.n_candidates)))
    fixed = none(result)
    if seed:  # some parts of another level are tied, and have numbers of their own
        level = Numbering.of(result, first, none(result)).parts(0.0, int(rng.integers(3, result.n_candidates)))
        fixed = np.where(np.isin(level.candidate_numbers, level.numbers[:2]), level.candidate_numbers, 0)
    finer = levels(Numbering.of(result, first, fixed))
    for coarse, fine in zip(finer, finer[1:], strict=False):
        assert len(fine.numbers) == len(coarse.numbers) + 1
        changed = coarse.candidate_numbers != fine.candidate_numbers
        born = np.setdiff1d(fine.numbers, coarse.numbers)
        assert set(coarse.numbers) <= set(fine.numbers)
        assert len(born) == 1
        assert set(fine.candidate_numbers[changed]) == set(born)
        # What it was split from keeps its number, and the colors are those of the numbers.
        assert len(set(coarse.candidate_numbers[changed])) == 1
        stayed = np.isin(fine.numbers, coarse.numbers)
        assert (number_colors(fine)[stayed] == number_colors(coarse)).all()


def test_coarser_parts_take_a_number_from_inside_and_the_level_comes_back(result):
    former = settled(result, n_parts=result.n_candidates)
    numbering = Numbering.of(result, former, none(result))
    for numbered in levels(numbering):
        own = numbered.candidate_numbers == former
        assert set(numbered.candidate_numbers[own]) == set(numbered.numbers)
    assert (levels(numbering)[-1].candidate_numbers == former).all()


def test_numbers_come_back_at_the_level_at_which_they_were_given(result):
    for count in range(result.hierarchy.n_loose, result.n_candidates + 1, 3):
        former = settled(result, n_parts=count)
        numbering = Numbering.of(result, former, none(result))
        assert (numbering.parts(0.0, count).candidate_numbers == former).all()


@pytest.mark.parametrize("seed", range(4))
def test_a_part_with_a_number_that_was_there_has_no_new_one(result, seed):
    """Numbers there were are born before all others, also those of which no part has most."""
    former = np.random.default_rng(seed).integers(0, 2 + result.n_candidates // 4, result.n_candidates)
    numbering = Numbering.of(result, former, none(result))
    kept = np.isin(numbering.candidate_number, former[former > 0])
    assert np.isin(former[former > 0], numbering.candidate_number).all()
    for numbered in levels(numbering):
        has_kept = np.bincount(numbered.parts.candidate_part, kept) > 0
        assert np.isin(numbered.numbers[has_kept], former).all()


def test_finer_parts_are_numbered_as_they_come(result):
    former = settled(result, n_parts=5)
    numbering = Numbering.of(result, former, none(result))
    for count in range(5, result.n_candidates + 1):
        assert numbering.parts(0.0, count).numbers.tolist() == list(range(1, count + 1))


def finer_level(result, count=5, further=6):
    """A detail beyond the one at which numbers are given, its parts, and the numbers given."""
    given = settled(result, n_parts=count)
    detail = 1.0 - result.hierarchy.salience[-(count + further - result.hierarchy.n_loose)]
    return detail, Numbering.of(result, given, none(result)).parts(detail), given


def tied(given, numbers, changed):
    """What is known after parts were changed by hand: ``former`` and ``fixed``."""
    return given, np.where(np.isin(numbers, changed), numbers, 0)


def colors_stay(before, after):
    """Parts keep their colors, but for one of each two of a color that touch now, at some level, and did not before."""
    former, later = dict(number_places(before)), dict(number_places(after))
    pairs = [pair for pair in after.graph.numbers[after.graph.pairs].tolist() if set(pair) <= set(before.numbers)]
    alike = [pair for pair in pairs if former[pair[0]] == former[pair[1]]]
    changed = [number for number in np.intersect1d(before.numbers, after.numbers) if former[number] != later[number]]
    assert set(changed) <= {number for pair in alike for number in pair}
    assert len(changed) <= len(alike)


def test_merging_by_hand_moves_no_other_number(result):
    detail, shown, given = finer_level(result)
    assert len(shown.parts.cuts) >= 4
    for a, b in shown.numbers[shown.parts.cuts].tolist():
        merged = np.where(shown.candidate_numbers == b, a, shown.candidate_numbers)
        after = Numbering.of(result, *tied(given, merged, [a])).parts(detail)
        assert (after.candidate_numbers == merged).all()
        colors_stay(shown, after)


def test_splitting_by_hand_moves_no_other_number(result):
    detail, shown, given = finer_level(result)
    new = int(shown.numbers.max()) + 1
    for number in shown.numbers.tolist():
        inside = np.flatnonzero(shown.candidate_numbers == number)
        split = shown.candidate_numbers.copy()
        split[inside[: len(inside) // 2]] = new
        after = Numbering.of(result, *tied(given, split, [number, new]))
        others = shown.candidate_numbers != number
        assert (after.parts(detail).candidate_numbers[others] == split[others]).all()
        parts = after.parts(detail)
        colors_stay(shown, parts)
        # Finer parts that come later make room for the new number.
        finest = after.parts(1.0)
        assert (finest.candidate_numbers[split == new] == new).all()
        assert finest.numbers.max() <= result.n_candidates + 1


def test_fixing_a_part_moves_no_number(result):
    detail, shown, given = finer_level(result)
    for number in shown.numbers.tolist():
        after = Numbering.of(result, *tied(given, shown.candidate_numbers, [number]))
        assert (after.parts(detail).candidate_numbers == shown.candidate_numbers).all()
        colors_stay(shown, after.parts(detail))


def test_whatever_is_fixed_no_two_alike_touch(result):
    rng = np.random.default_rng(0)
    given = settled(result)
    for _ in range(5):
        # Candidates anywhere, each tied to a number that may be another's.
        fixed = np.where(rng.random(result.n_candidates) < 0.3, rng.permutation(result.n_candidates) + 1, 0)
        numbering = Numbering.of(result, given, fixed)
        for numbered in levels(numbering)[::9]:
            assert (numbered.candidate_numbers[fixed > 0] == fixed[fixed > 0]).all()
            assert (numbered.candidate_numbers > 0).all()
            a, b = numbered.parts.cuts.T
            assert (number_colors(numbered)[a] != number_colors(numbered)[b]).any(axis=1).all()


def test_a_number_of_no_level_has_a_color_and_changes_no_other(result):
    numbering = Numbering.of(result, settled(result), none(result))
    shown = numbering.parts(0.5)
    strange = np.where(shown.candidate_numbers == 1, 1000, shown.candidate_numbers)
    other = numbering.numbered(strange)
    assert other.numbers[-1] == 1000
    assert (number_colors(other)[:-1] == number_colors(shown)[1:]).all()


def test_no_level_shows_one_color_on_both_sides_of_a_cut(result):
    for numbered in levels(Numbering.of(result, settled(result), none(result))):
        a, b = numbered.parts.cuts.T
        assert (number_colors(numbered)[a] != number_colors(numbered)[b]).any(axis=1).all()
        if numbered.numbers.max() <= 16:
            assert len(np.unique(number_colors(numbered), axis=0)) == numbered.parts.count


def test_numbers_touch_in_the_graph_where_they_do_at_some_level(result):
    numbering = Numbering.of(result, settled(result), none(result))
    touching = {tuple(numbered.numbers[cut]) for numbered in levels(numbering) for cut in numbered.parts.cuts}
    assert {tuple(pair) for pair in numbering.graph.numbers[numbering.graph.pairs]} == touching


def test_another_decomposition_takes_over_numbers_by_overlap(result):
    numbers = settled(result, n_parts=8)
    # Numbers of the old parts, with one in a hundred faces astray.
    astray = np.random.default_rng(0).random(result.n_faces) < 0.01
    faces = np.where(astray, 3, numbers[result.candidates] + 20)
    former = majority(result.candidates, faces, np.ones(result.n_faces), result.n_candidates)
    assert (inherited(result, 0.5, 8, former, none(result)) == numbers + 20).all()


def test_fixed_parts_stay_at_every_detail(result):
    fine = settled(result, n_parts=result.n_candidates)
    fixed = np.where(np.isin(fine, [1, 2]), 7, 0)
    numbering = Numbering.of(result, fine, fixed)
    finer = levels(numbering)
    for numbered in finer:
        assert ((numbered.candidate_numbers == 7) == (fixed == 7)).all()
    # All that is not fixed comes apart.
    assert len(finer[-1].numbers) == (fixed == 0).sum() + 1
    assert (numbering.parts(1.0).candidate_numbers == finer[-1].candidate_numbers).all()


def test_what_is_not_fixed_is_parted_as_the_hierarchy_has_it_in_connected_pieces(result):
    fine = settled(result, n_parts=result.n_candidates)
    fixed = np.where(np.arange(result.n_candidates) % 7 == 0, fine, 0)
    numbering = Numbering.of(result, fine, fixed)
    for count in range(result.hierarchy.n_loose, result.n_candidates + 1, 5):
        detail = 1.0 - result.hierarchy.salience[result.n_candidates - count - 1] if count < result.n_candidates else 1
        level = result.hierarchy.parts_at(detail)
        a, b = result.candidate_pairs.T
        joined = (level[a] == level[b]) & (fixed[a] == 0) & (fixed[b] == 0)
        wanted = components(result.n_candidates, a[joined], b[joined])[1]
        got = numbering.parts(detail).candidate_numbers
        assert len(np.unique(np.stack([wanted, got]), axis=1).T) == len(np.unique(wanted)) == len(np.unique(got))


def test_order_of_labels_is_order_of_numbers(result):
    former = np.arange(result.n_candidates)[::-1] + 1
    numbered = Numbering.of(result, former, none(result)).parts(1.0)
    assert (numbered.candidate_numbers == former).all()
    parts = numbered.parts
    assert parts.area == pytest.approx(np.bincount(parts.candidate_part, result.candidate_area))
    assert (parts.cuts[:, 0] < parts.cuts[:, 1]).all()


def test_who_had_the_number_of_a_fixed_part_elsewhere_gets_another(result):
    """The smallest and the largest candidate had one number, and the smallest is fixed as that."""
    least, most = result.candidate_area.argmin(), result.candidate_area.argmax()
    former = np.arange(result.n_candidates) + 1
    former[most] = former[least]
    pinned = np.where(np.arange(len(former)) == least, former, 0)
    numbers = inherited(result, 0.0, result.n_candidates, former, pinned)
    assert (numbers == former).sum() == len(former) - 1
    assert numbers[most] not in former


def candidates_of(area, merges, salience, pairs):
    """A result of one face for each candidate."""
    count = len(area)
    return decomposition_of(np.arange(count), area, pairs, np.ones(len(pairs)), merges, salience, count,
                            vertex_candidates=np.arange(count))


@ROUNDING
def test_half_of_the_area_of_a_number_is_not_most_of_it(rounding):
    """Of the area of 7, half is in one loose part with another candidate, half is a loose part. Neither has most: the
    number is handed on to whoever of the two is numbered first, and the candidate alone is, when its part is."""
    result = candidates_of([1.0, 1.0 + rounding, 1.0], [(0, 1)], [0.5], [(0, 1)])
    numbering = Numbering.of(result, np.array([0, 7, 7]), none(result))
    assert numbering.candidate_number[2] == 7
    assert 7 not in numbering.candidate_number[:2]


@ROUNDING
def test_of_two_equal_halves_the_first_keeps_the_number(rounding):
    result = candidates_of([1.0, 1.0 + rounding], [(0, 1)], [0.5], [(0, 1)])
    for former in (0, 4):
        number = Numbering.of(result, np.full(2, former), none(result)).candidate_number
        assert number.tolist() == [former or 1, 2]


def test_candidates_as_small_as_numbers_can_be_vote_by_their_area():
    result = candidates_of([3e-310, 1e-310, 1e-310], [(0, 1), (0, 2)], [0.5, 0.6], [(0, 1), (0, 2)])
    assert inherited(result, 0.0, 1, np.array([5, 2, 2]), none(result)).tolist() == [5, 5, 5]
