# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines of embedded graphs: convexity of known figures, bent bars unbend."""

import numpy as np
import pytest

from core.cuts.liu.outline import LANDMARKS, Outline, convexity, inner_distances, straightened


def figure(inside, step=0.05):
    """Grid points in -1..1 squared that are inside, and the neighbors among them."""
    axis = np.arange(-1, 1 + step / 2, step)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    chosen = inside(x, y)
    number = np.full(chosen.shape, -1)
    number[chosen] = np.arange(chosen.sum())
    pairs = np.concatenate([np.stack([number[:-1].ravel(), number[1:].ravel()], 1),
                            np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], 1)])
    return np.stack([x[chosen], y[chosen]], axis=1), pairs[(pairs >= 0).all(axis=1)]


def disc(x, y):
    return x**2 + y**2 <= 1


def cross(x, y):
    return np.minimum(np.abs(x), np.abs(y)) <= 0.15


@pytest.mark.parametrize("inside", [disc, lambda x, y: np.abs(x) <= 1, lambda x, y: np.abs(y) < 0.3])
def test_convex_figures(inside):
    assert convexity(*figure(inside)) > 0.9


def test_a_cross_by_its_area():
    # Arms 0.3 wide and 2 long: 2 x 0.6 - 0.09 of 4 - 2 x 0.85 squared, the hull cut off at the corners; a grid of
    # pixels makes narrow arms a little wider.
    area = (1.2 - 0.09) / (4 - 2 * 0.85**2)
    assert convexity(*figure(cross)) == pytest.approx(area, abs=0.1)


def test_a_slit_by_the_perimeter():
    # A slit 0.2 wide and 1.8 deep takes 0.36 of the area of 4, and adds 3.6 to the perimeter of 8.
    assert convexity(*figure(lambda x, y: (np.abs(x) >= 0.1) | (y < -0.8))) == pytest.approx(8 / 11.6, abs=0.05)


def test_turned_and_scaled_is_as_convex():
    position, pairs = figure(cross)
    for angle in (0.3, 1.0):
        turn = np.array([(np.cos(angle), -np.sin(angle)), (np.sin(angle), np.cos(angle))])
        assert convexity(7 * position @ turn, pairs) == pytest.approx(convexity(position, pairs), abs=0.05)


def test_points_on_a_line_are_convex():
    position = np.stack([np.arange(5.0), np.zeros(5)], axis=1)
    pairs = np.stack([np.arange(4), np.arange(1, 5)], axis=1)
    assert convexity(position, pairs) == 1.0
    assert convexity(np.zeros((5, 2)), pairs) == 1.0


def test_landmarks_are_far_apart_and_distances_are_those_within_the_shape():
    position, pairs = figure(cross)
    landmarks, inner = inner_distances(position, pairs)
    assert len(landmarks) == LANDMARKS
    assert len(set(landmarks.tolist())) == LANDMARKS
    # The first four are one at the end of each arm.
    ends = position[landmarks[:4]]
    assert (np.abs(ends).max(axis=1) > 0.95).all()
    assert len({(int(np.abs(e).argmax()), float(np.sign(e[np.abs(e).argmax()]))) for e in ends}) == 4
    straight = np.linalg.norm(position[landmarks][:, None] - position, axis=2)
    assert (inner >= straight - 1e-9).all()
    np.testing.assert_allclose(inner[:, landmarks], inner[:, landmarks].T, atol=1e-9)


def test_a_bent_bar_unbends():
    position, pairs = figure(lambda x, y: np.abs(y) < 0.1)
    angle = 1.5 * position[:, 0]
    bent = np.stack([(1 + position[:, 1]) * np.sin(angle), (1 + position[:, 1]) * np.cos(angle)], axis=1)
    unbent = straightened(*inner_distances(bent, pairs))
    extent = np.sort(np.ptp(unbent @ np.linalg.svd(unbent - unbent.mean(axis=0), full_matrices=False)[2].T, axis=0))
    assert extent[1] == pytest.approx(3.0, rel=0.1)
    assert extent[0] < 0.75  # ways along a grid are longer than straight ones
    assert convexity(bent, pairs) < 0.7
    assert Outline.of(bent, pairs).segmentability < 0.2
    assert Outline.of(*figure(cross)).segmentability > 0.3
