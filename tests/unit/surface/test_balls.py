# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial balls: radii known by construction."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from core.surface.balls import ball_radius


def test_between_two_walls_the_radius_is_half_their_distance():
    x = np.linspace(-5, 5, 201)
    low, high = np.stack([x, 0 * x, 0 * x], 1), np.stack([x, 0 * x + 2, 0 * x], 1)
    up = np.tile((0.0, 1.0, 0.0), (201, 1))
    radius = ball_radius(cKDTree(np.concatenate([low, high])), low, up, 10.0)
    # Balls are held by points, 0.05 apart, not by lines.
    np.testing.assert_allclose(radius[50:-50], 1.0, atol=1e-3)


def test_where_nothing_is_in_the_way_the_ball_keeps_its_size():
    x = np.linspace(-1, 1, 21)
    line = np.stack([x, 0 * x, 0 * x], 1)
    assert (ball_radius(cKDTree(line), line, np.tile((0.0, 0.0, 1.0), (21, 1)), 0.6) == 0.6).all()


@pytest.mark.parametrize("radius", [0.1, 3.0])
def test_in_a_circle_every_ball_is_the_circle(radius):
    angle = 2 * np.pi * np.arange(100) / 100
    out = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    found = ball_radius(cKDTree(radius * out), radius * out, -out, 10 * radius)
    np.testing.assert_allclose(found, radius, rtol=1e-2)


@pytest.mark.parametrize("scale", [0.1, 5.0])
def test_roughness_does_not_hold_a_ball(scale):
    """A bump beside the point would, at an angle of 19 degrees from the center; the wall across holds it."""
    point, up = scale * np.zeros((1, 3)), np.array([[0.0, 0.0, 1.0]])
    bump, wall = scale * np.array([[0.3, 0.0, 0.05]]), scale * np.array([[0.0, 0.0, 3.0]])
    found = ball_radius(cKDTree(np.concatenate([point, bump, wall])), point, up, 10.0 * scale)
    np.testing.assert_allclose(found, 1.5 * scale, rtol=1e-12)
