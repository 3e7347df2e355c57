# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups of points that were moved as rigid bodies: their motions are found, and carry other points along."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from core.uses.moving.motion import rigid_motions


@pytest.mark.parametrize("flat", [False, True])
def test_rigid_motions_are_found_exactly(flat):
    rng = np.random.default_rng(3)
    label = rng.permutation(np.repeat(np.arange(5), 40))
    before = rng.normal(size=(200, 3)) + 10 * label[:, None]
    if flat:
        before[:, 2] = 0.0
    turn, shift = Rotation.random(5, random_state=1).as_matrix(), rng.normal(size=(5, 3))
    after = np.einsum("mij,mj->mi", turn[label], before) + shift[label]
    motions = rigid_motions(before, after, rng.random(200), label, 6)
    assert motions.rotation[:5] == pytest.approx(turn, abs=1e-7)
    others, theirs = rng.normal(size=(30, 3)), rng.integers(0, 5, 30)
    expected = np.einsum("mij,mj->mi", turn[theirs], others) + shift[theirs]
    assert motions.moved(others, theirs) == pytest.approx(expected, abs=1e-6)
    # A group of no points stays.
    assert motions.moved(others, np.full(30, 5)) == pytest.approx(others)


def test_what_rests_stays_and_what_is_too_little_to_turn_is_shifted():
    points, label = np.eye(3)[:, :] * 2.0, np.array([0, 1, 1])
    rest = rigid_motions(points, points, np.zeros(3), label, 2)
    assert rest.moved(points, label) == pytest.approx(points, abs=1e-12)
    shifted = rigid_motions(points, points + (0, 0, 3), np.ones(3), label, 2)
    assert shifted.moved(points, label) == pytest.approx(points + (0, 0, 3), abs=1e-9)
    assert np.linalg.det(rigid_motions(points, -points, np.ones(3), label, 2).rotation) == pytest.approx([1, 1])
