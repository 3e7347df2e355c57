# SPDX-License-Identifier: GPL-3.0-or-later
"""Caps in a UV map: their sizes and places."""

import numpy as np
import pytest

from core.uses.caps.maps import cap_map


def flat_areas(flat, face):
    """Area of each face, by its corners, with sign."""
    corners = [flat[face == one].T for one in np.unique(face)]
    return np.array([0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() for x, y in corners])


@pytest.fixture
def caps():
    """A rectangle of 4 by 2, one of 1 by 3 that stands on it, and a square of two triangles elsewhere."""
    points = np.array([[0, 0, 0], [4, 0, 0], [4, 2, 0], [0, 2, 0], [0, 0, 3], [0, 2, 3],
                       [9, 0, 0], [10, 0, 0], [10, 1, 0], [9, 1, 0.0]])
    faces = [[0, 1, 2, 3], [0, 3, 5, 4], [6, 7, 8], [6, 8, 9]]
    vertex = np.concatenate(faces)
    face = np.repeat([3, 5, 8, 9], [len(f) for f in faces])
    return points, vertex, face


@pytest.mark.parametrize("density", [0.05, 0.5])
def test_faces_have_their_size_and_do_not_overlap(caps, density):
    points, vertex, face = caps
    flat = cap_map(points, vertex, face, density)
    assert flat.min() >= 0
    assert flat_areas(flat, face) == pytest.approx(density**2 * np.array([8, 6, 0.5, 0.5]))
    boxes = [(flat[own].min(axis=0), flat[own].max(axis=0)) for own in (face == 3, face == 5, face > 5)]
    for i, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:i]:
            assert (low > other_high).any() or (other_low > high).any()
    assert flat[:, 0].max() <= max(1.0, 4 * density) + 1e-12
    # The square is one island: its diagonal is one line.
    assert flat[face == 8][[0, 2]] == pytest.approx(flat[face == 9][[0, 1]])


def test_shapes_are_those_of_any_pose(caps):
    points, vertex, face = caps
    turn, _ = np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))
    turn *= np.linalg.det(turn)
    once, again = cap_map(points, vertex, face, 0.1), cap_map(2 * points @ turn.T + 7, vertex, face, 0.05)
    for one in (3, 5):
        lengths = [np.linalg.norm(np.diff(flat[face == one], axis=0), axis=1) for flat in (once, again)]
        assert lengths[0] == pytest.approx(lengths[1])


def test_without_caps_nothing():
    assert cap_map(np.zeros((3, 3)), np.empty(0, np.int64), np.empty(0, np.int64), 1.0).shape == (0, 2)
