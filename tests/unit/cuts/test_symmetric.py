# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates and hierarchies made symmetric: by hand, on a row of faces, and on a figure."""

import numpy as np
import pytest
import shapes

from core import Parameters, decompose
from core.cuts.hierarchy import Hierarchy
from core.cuts.symmetric import symmetric_candidates
from core.metrics import rand_index_error
from core.surface.labels import FaceGraph


def row(label, merges, salience):
    """Faces in a row, an even number, mirrored in its middle."""
    n = len(label)
    graph = FaceGraph(n, np.array([(i, i + 1) for i in range(n - 1)]), np.ones(n - 1), np.ones(n))
    return symmetric_candidates(
        graph, np.empty((0, 2), np.int64), np.array(label), Hierarchy.of(max(label) + 1, merges, salience),
        np.arange(n)[::-1], np.arange(n) - (n - 1) / 2)


def parts(result, detail):
    label, hierarchy = result
    return hierarchy.parts(hierarchy.n_parts(detail))[label].tolist()


def same(first, second):
    return rand_index_error(first, second) == 0


def test_a_symmetric_result_stays_as_it_is():
    label = [0, 0, 1, 2, 2, 3, 4, 4]
    result = row(label, [(1, 2), (2, 3), (0, 1), (3, 4)], [0.3, 0.3, 0.8, 0.8])
    assert same(result[0], label)
    assert result[1].salience.tolist() == pytest.approx([0.3, 0.3, 0.8, 0.8])
    assert same(parts(result, 0.5), [0, 0, 1, 1, 1, 1, 2, 2])


def test_a_cut_that_only_one_side_has_is_on_both_or_on_neither():
    # The left end is cut off, the right one is not.
    result = row([0] + 98 * [1] + [2], [(1, 2), (0, 1)], [0.2, 0.9])
    for detail in (0.05, 0.3, 0.5, 0.9):
        found = parts(result, detail)
        assert same(found, found[::-1])
    assert len(set(parts(result, 0.0))) == 1


def test_a_candidate_that_hangs_over_the_plane_is_cut_off_there():
    result = row(51 * [0] + 49 * [1], [(0, 1)], [0.9])
    assert same(parts(result, 0.5), 50 * [0] + 50 * [1])


def test_what_speaks_against_the_plane_is_left_as_it_is():
    label = 20 * [0] + 80 * [1]
    assert row(label, [(0, 1)], [0.9])[0].tolist() == label


def test_thousands_of_candidates_are_left_as_they_are():
    label = list(range(20_000))  # a table of all their pairs would take 3 GB
    result = row(label, [(i, i + 1) for i in range(len(label) - 1)], np.linspace(0, 1, len(label) - 1))
    assert result[0].tolist() == label
    assert result[1].n_candidates == len(label)


def test_parts_without_an_image_keep_their_own():
    graph = FaceGraph(5, np.array([(0, 1), (1, 2), (2, 3), (3, 4)]), np.ones(4), np.ones(5))
    label, hierarchy = symmetric_candidates(
        graph, np.empty((0, 2), np.int64), np.array([0, 1, 1, 1, 2]), Hierarchy.of(3, [(0, 1), (1, 2)], [0.4, 0.8]),
        np.array([-1, 3, 2, 1, -1]), np.array([-2.0, -1, 0, 1, 2]))
    assert same(label, [0, 1, 1, 1, 2])
    assert hierarchy.salience.tolist() == pytest.approx([0.4, 0.8])


@pytest.mark.parametrize(
    "method", [{}, {"method": "berretti", "follow_level_sets": True}], ids=["perceptual", "berretti"])
def test_parts_of_a_figure_are_exactly_symmetric_at_every_detail(method):
    shape = shapes.mirrored_figure()
    result = decompose(*shape, Parameters(**method))
    twin = result.face_twin
    assert np.array_equal(twin[twin], np.arange(result.n_faces))
    for detail in np.linspace(0, 1, 21):
        found = result.parts(detail=detail)
        assert same(found.labels, found.labels[twin])
        assert np.array_equal(found.twin[found.labels], found.labels[twin])
        assert np.array_equal(found.side[found.twin], -found.side)
    assert result.parts(detail=0.0).count == 1
    most = min(result.n_candidates, 11)
    assert most > 5
    assert [result.parts(n_parts=n).count for n in range(1, most + 1)] == list(range(1, most + 1))


def test_limbs_of_the_figure_are_pairs():
    shape = shapes.mirrored_figure()
    found = decompose(*shape).parts()
    paired = found.twin != np.arange(found.count)
    middle = np.array([shape.vertices[shape.faces[found.labels == part]].mean(axis=(0, 1))
                       for part in range(found.count)])
    assert (found.twin >= 0).all()
    assert paired.sum() >= 4
    assert np.allclose(middle[found.twin] * (-1, 1, 1), middle, atol=1e-6)
    assert np.array_equal(found.side[paired], np.sign(middle[paired, 0]))


def test_without_symmetry_nothing_is_looked_for():
    found = decompose(*shapes.mirrored_figure(), Parameters(symmetry=False))
    assert len(found.mirror) == len(found.face_twin) == 0
    assert (found.parts().twin == -1).all()
    assert (found.parts().side == 0).all()


def test_twins_are_stored():
    found = decompose(*shapes.mirrored_figure())
    again = type(found).from_bytes(found.to_bytes())
    assert np.array_equal(again.face_twin, found.face_twin)
    assert np.array_equal(again.mirror, found.mirror)
    assert np.array_equal(again.parts().side, found.parts().side)
