# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels voted for, their boundaries, and how far two labelings disagree."""

import numpy as np
import pytest

from core.mesh.labels import borders, disagreement, follow, label_boundaries, longest_neighbor, majority


def test_disagreement_by_counting_pairs():
    """{0, 1, 2}, {3, 4} and {0, 1}, {2, 3}, {4}: the pairs 02, 12, 34 and 23 are joined by one of them alone."""
    first, second = np.array([[0, 0, 0, 1, 1], [0, 0, 1, 1, 2]])
    weight = np.array([1.0, 1.0, 2.0, 3.0, 3.0])
    assert disagreement(first, second, np.ones(5)) == pytest.approx(2 * 4 / 5**2)
    assert disagreement(first, second, weight) == pytest.approx(2 * (2 + 2 + 9 + 6) / 10**2)
    assert disagreement(second, first, weight) == disagreement(first, second, weight)
    assert disagreement(first, 1 - first, weight) == 0


def test_majority_by_hand():
    owner = np.array([0, 0, 0, 2, 2, 3, 3])
    label = np.array([5, 1, 5, 4, 7, 6, 2])
    weight = np.array([1, 1.5, 1, 0.1, 3, 1, 1])
    # 0: five has 2 against 1.5; 1 has no row; 2: seven; 3: a tie, the smaller label.
    assert majority(owner, label, weight, 5).tolist() == [5, -1, 7, 2, -1]
    none = np.empty(0, np.int64)
    assert majority(none, none, np.empty(0), 2).tolist() == [-1, -1]


def test_boundaries_by_hand():
    """Five faces, the last of no label: labels 0 and 2 touch twice, the others once, and 0 touches itself."""
    pairs = np.array([[0, 1], [2, 1], [3, 2], [1, 4], [0, 2], [0, 3]])
    length = np.array([1.0, 2.0, 4.0, 8.0, 16.0, 32.0])
    between, touching, border = borders(np.array([2, 0, 0, 1, -1]), pairs)
    assert between.tolist() == [0, 2, 4, 5]
    assert touching.tolist() == [[0, 1], [0, 2], [1, 2]]
    assert border.tolist() == [1, 0, 1, 2]
    same, total = label_boundaries(np.array([2, 0, 0, 1, -1]), pairs, length)
    assert same.tolist() == touching.tolist()
    assert total.tolist() == [4.0, 17.0, 32.0]


def test_a_face_without_a_label_touches_nothing():
    touching, length = label_boundaries(np.array([0, -1, 1]), np.array([[0, 1], [1, 2]]), np.ones(2))
    assert touching.shape == (0, 2)
    assert not len(length)


def test_of_equally_long_boundaries_that_with_the_lowest_label_counts():
    touching = np.array([[0, 2], [1, 2], [2, 3]])
    assert longest_neighbor(touching, np.array([2.0, 2.0, 2.0]), 5).tolist() == [2, 2, 0, 2, -1]
    assert longest_neighbor(touching, np.array([1.0, 2.0, 2.0]), 5).tolist() == [2, 2, 1, 2, -1]


def test_labels_follow_what_moves_to_another_part():
    """Eight in a row and one alone; labels 0 and 1 are one part, 2 another, which 3 and 4 move to, and 8 with them."""
    label = np.array([0, 0, 1, 1, 1, 2, 2, 2, 1])
    part = np.array([0, 0, 0, 0, 0, 1, 1, 1, 0])
    moved = np.array([0, 0, 0, 1, 1, 1, 1, 1, 1])
    row = np.stack([np.arange(7), np.arange(1, 8)], axis=1)
    assert follow(label, part, moved, row).tolist() == [0, 0, 1, 2, 2, 2, 2, 2, 1]
    assert follow(label, part, part, row).tolist() == label.tolist()
