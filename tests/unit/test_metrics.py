# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of how far labellings are apart, counted by hand and by what must hold for all."""

import itertools

import numpy as np
import pytest
import shapes

from core import ParameterError, TriMesh
from core.metrics import (
    agreement,
    consistency_error,
    cut_discrepancy,
    hamming_distance,
    mean_intersection_over_union,
    rand_index_error,
)

# Five elements: {0, 1, 2}, {3, 4} by one labelling, {0, 1}, {2, 3}, {4} by the other.
A = np.array([0, 0, 0, 1, 1])
B = np.array([0, 0, 1, 1, 2])
AREA = np.array([1.0, 1.0, 2.0, 3.0, 3.0])
SYMMETRIC = [rand_index_error, consistency_error]
ALL = [rand_index_error, hamming_distance, consistency_error, agreement, mean_intersection_over_union]
WEIGHTED = [hamming_distance, consistency_error, mean_intersection_over_union]


def test_rand_index_error_by_counting_pairs():
    # Ten pairs. Joined by A: 01 02 12 34. Joined by B: 01 23. Differently: 02 12 34 23.
    differently = sum((A[i] == A[j]) != (B[i] == B[j]) for i, j in itertools.combinations(range(5), 2))
    assert differently == 4
    assert rand_index_error(A, B) == 0.4


def test_hamming_distance_by_hand():
    # Best of A for {0, 1}: two elements; for {2, 3}: one; for {4}: one. Best of B for {0, 1, 2}: two, for {3, 4}: one.
    assert hamming_distance(A, B) == pytest.approx((1 / 5, 2 / 5))
    # By area, of 10: 2 + 3 + 3 and 2 + 3.
    assert hamming_distance(A, B, AREA) == pytest.approx((2 / 10, 5 / 10))


def test_consistency_error_by_hand():
    # Outside B of each element's region of A: 1/3 1/3 2/3 1/2 1/2; outside A of its region of B: 0 0 1/2 1/2 0.
    assert consistency_error(A, B) == pytest.approx((1 / 5, 1 / 5))
    # By area: 2/4 2/4 2/4 3/6 3/6, and 0 0 3/5 2/5 0: the local error takes 1/2 and 2/5.
    assert consistency_error(A, B, AREA) == pytest.approx((1.0 / 5, 0.9 / 5))


def test_agreement_by_hand():
    # {0, 1, 2} with {0, 1}: 2/3. {3, 4} with {2, 3}: 1/2, with {4}: 1/2. The other way 2/3, 1/2 and 1/2.
    assert agreement(A, B) == pytest.approx((2 / 3 + 1 / 2) / 2)
    assert agreement(B, A) == pytest.approx((2 / 3 + 1 / 2 + 1 / 2) / 3)


def test_mean_intersection_over_union_by_hand():
    # {0, 1}: 2 of 3. {2, 3}: with {3, 4} 1 of 3, with {0, 1, 2} 1 of 4. {4}: 1 of 2.
    assert mean_intersection_over_union(A, B) == pytest.approx((2 / 3 + 1 / 3 + 1 / 2) / 3)
    # By area: 2 of 4; 3 of 8 or 2 of 7; 3 of 6.
    assert mean_intersection_over_union(A, B, AREA) == pytest.approx((2 / 4 + 3 / 8 + 3 / 6) / 3)


def strip(n):
    """A strip of n unit squares from x = 0 to n, each of two triangles."""
    x = np.arange(n + 1.0)
    vertices = np.concatenate([np.stack([x, 0 * x + y, 0 * x], axis=1) for y in (0, 1)])
    low, high = np.arange(n), np.arange(n) + n + 1
    faces = np.concatenate([np.stack([low, low + 1, high + 1], 1), np.stack([low, high + 1, high], 1)])
    return TriMesh(vertices, faces), np.tile(low, 2)  # the square of each triangle


def test_cut_discrepancy_by_hand():
    mesh, square = strip(6)
    # One is cut at x = 2, the other at x = 3 and 5; each cut has two ends. From x = 2 to the nearest cut of the other
    # it is 1, from x = 3 it is 1, from x = 5 it is 3: the mean is 10 / 6.
    one, other = np.digitize(square, [2]), np.digitize(square, [3, 5])
    share = mesh.face_area / mesh.area
    radius = share @ np.linalg.norm(mesh.face_centroids - [3, 0.5, 0], axis=1)
    assert cut_discrepancy(mesh, one, other) == pytest.approx(10 / 6 / radius)
    assert cut_discrepancy(mesh, other, one) == pytest.approx(10 / 6 / radius)


def test_cut_discrepancy_is_not_a_number_without_a_cut():
    mesh, square = strip(4)
    assert np.isnan(cut_discrepancy(mesh, np.zeros_like(square), square))


@pytest.mark.parametrize("scale", [1e-170, 1e160, 0.0])
def test_cut_discrepancy_has_no_unit(scale):
    """The area of the smallest and the largest meshes was 0 or infinite, and a warning came with the nan."""
    mesh = TriMesh(*shapes.icosphere(1))
    above, beside = (mesh.face_centroids[:, [2, 0]] > 0).T.astype(int)
    expected = cut_discrepancy(mesh, above, beside) if scale else np.nan
    far = np.append(scale * mesh.vertices, [(1e200, 0, 0)], axis=0)  # a vertex of no face
    found = cut_discrepancy(TriMesh(far, mesh.faces), above, beside)
    assert found == pytest.approx(expected, nan_ok=True)


def test_cut_discrepancy_leaves_out_what_cannot_be_reached():
    mesh, square = strip(4)
    far = TriMesh(np.concatenate([mesh.vertices, mesh.vertices + [0, 9, 0]]),
                  np.concatenate([mesh.faces, mesh.faces + mesh.n_vertices]))
    here, there = np.append(square, 0 * square), np.append(0 * square, square)
    assert np.isnan(cut_discrepancy(far, here, there))
    both = np.append(square, square)
    # The three cuts here are the same ones; those there have nothing to be compared with.
    assert cut_discrepancy(far, here, both) == 0.0


@pytest.fixture(params=range(5))
def labellings(request):
    """Two random labellings of 200 elements, and weights of which some are zero."""
    rng = np.random.default_rng(request.param)
    weight = np.where(rng.random(200) < 0.1, 0.0, rng.random(200))
    return rng.integers(0, 7, 200), rng.integers(0, 12, 200), weight


@pytest.mark.parametrize("measure", ALL)
def test_equal_labellings_are_as_close_as_can_be(measure, labellings):
    label, _, weight = labellings
    best = 1.0 if measure in (agreement, mean_intersection_over_union) else 0.0
    assert measure(label, label) == pytest.approx(best if measure not in WEIGHTED[:2] else (best, best))
    if measure in WEIGHTED:
        assert measure(label, label, weight) == pytest.approx(measure(label, label), abs=1e-12)


@pytest.mark.parametrize("measure", ALL)
def test_names_do_not_matter(measure, labellings):
    one, other, _ = labellings
    names = np.random.default_rng(0).permutation(1000)[:20] - 500
    assert measure(names[one], names[other]) == pytest.approx(measure(one, other))


@pytest.mark.parametrize("measure", ALL)
def test_the_order_of_the_elements_does_not_matter(measure, labellings):
    one, other, _ = labellings
    order = np.random.default_rng(1).permutation(len(one))
    assert measure(one[order], other[order]) == pytest.approx(measure(one, other))


@pytest.mark.parametrize("measure", SYMMETRIC)
def test_symmetric(measure, labellings):
    one, other, _ = labellings
    assert measure(one, other) == pytest.approx(measure(other, one))


def test_the_two_halves_of_the_hamming_distance_change_places(labellings):
    one, other, weight = labellings
    assert hamming_distance(one, other, weight) == pytest.approx(hamming_distance(other, one, weight)[::-1])


@pytest.mark.parametrize("measure", [hamming_distance, mean_intersection_over_union])
def test_whole_weights_are_repeated_elements(measure):
    one, other, times = np.array([0, 0, 1, 1]), np.array([0, 1, 1, 2]), np.array([1, 2, 3, 1])
    assert measure(one, other, times) == pytest.approx(measure(np.repeat(one, times), np.repeat(other, times)))


def test_a_refinement_is_consistent_and_misses_but_raises_no_false_alarm(labellings):
    coarse, other, _ = labellings
    fine = coarse * 12 + other
    assert consistency_error(fine, coarse) == pytest.approx((0, 0))
    missing, false_alarm = hamming_distance(fine, coarse)
    assert missing > 0
    assert false_alarm == pytest.approx(0)


def test_a_single_element_has_no_pairs():
    assert rand_index_error([3], [8]) == 0.0


@pytest.mark.parametrize("labels", [[], [0.5, 1.0], [[0, 1]], np.zeros(3, bool), [[0], [0, 1]], ["a", "b"],
                                    np.ma.masked_equal([0, 1, 1], 1)])
@pytest.mark.parametrize("measure", ALL)
def test_labels_are_a_row_of_whole_numbers(measure, labels):
    with pytest.raises(ParameterError, match="Labels must be a row of whole numbers"):
        measure(labels, labels)


@pytest.mark.parametrize("measure", ALL)
def test_labels_may_be_such_as_numpy_reads_from_a_text(measure):
    assert measure(np.asarray(A, float), B) == measure(A, B)


@pytest.mark.parametrize("measure", ALL)
def test_as_many_labels_of_each(measure):
    with pytest.raises(ParameterError, match="There are 4 values for 5 elements"):
        measure(A, B[:4])


@pytest.mark.parametrize("measure", WEIGHTED)
def test_weights_are_checked(measure):
    with pytest.raises(ParameterError, match="There are 4 values for 5 elements"):
        measure(A, B, AREA[:4])
    for wrong in (-AREA, 0 * AREA, AREA * np.nan, np.append(AREA[:-1], np.inf), ["a"] * len(AREA), [[1], [2, 3]]):
        with pytest.raises(ParameterError, match="Weights must be 0 or more"):
            measure(A, B, wrong)


def test_cut_discrepancy_takes_one_label_for_each_face():
    mesh = TriMesh(*shapes.tetrahedron())
    right = np.arange(mesh.n_faces)
    for labels in ((right[1:], right), (right, right[1:])):
        with pytest.raises(ParameterError, match=f"There are {mesh.n_faces - 1} values for {mesh.n_faces} elements"):
            cut_discrepancy(mesh, *labels)
