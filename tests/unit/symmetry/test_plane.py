# SPDX-License-Identifier: GPL-3.0-or-later
"""A plane of symmetry moved, and what it does to points."""

import numpy as np
import pytest

from core.symmetry.plane import MirrorPlane, positive_sign


@pytest.mark.parametrize("seed", range(3))
def test_a_plane_goes_along_with_its_points_however_they_are_stretched(seed):
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=3)
    plane = MirrorPlane(normal / np.linalg.norm(normal), 0.7, 0.9)
    points = rng.normal(size=(20, 3))
    on_plane = points - plane.heights(points)[:, None] * plane.normal
    matrix, shift = np.eye(3) + 0.3 * rng.normal(size=(3, 3)), rng.normal(size=3)
    moved = plane.moved(matrix, shift)
    assert moved.heights(on_plane @ matrix.T + shift) == pytest.approx(0, abs=1e-12)
    assert np.linalg.norm(moved.normal) == pytest.approx(1)
    assert np.array_equal(np.sign(moved.heights(points @ matrix.T + shift)), np.sign(plane.heights(points)))
    assert moved.share == 0.9


def test_mirrored_twice_points_are_where_they_were_and_directions_turn_without_the_offset():
    plane = MirrorPlane.of(np.array([0.0, 0.6, 0.8, 2.0]))
    points = np.random.default_rng(0).normal(size=(9, 3))
    assert plane.mirrored(plane.mirrored(points)) == pytest.approx(points)
    assert plane.heights(plane.mirrored(points)) == pytest.approx(-plane.heights(points))
    assert plane.turned(points) == pytest.approx(plane.mirrored(points) - plane.mirrored(np.zeros((1, 3))))


@pytest.mark.parametrize(("direction", "sign"), [
    ((1, 0, 0), 1), ((0.5, -2, 1), -1), ((-1, 1, 0), -1), ((-1, 1 + 1e-9, 0), -1), ((-1, 1.1, 0), 1)])
def test_of_components_as_large_but_for_rounding_the_first_is_positive(direction, sign):
    assert positive_sign(np.array(direction, float)) == sign
