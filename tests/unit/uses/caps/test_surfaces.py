# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces across closed curves: what they have of the points of the curve, and where their points lie."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from core.uses.caps.surfaces import away_from_curve, harmonic_weights, in_a_circle, over_a_plane, spread


def ring(count, height=0.0, turns=2):
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angle), np.sin(angle), height * np.cos(turns * angle)], axis=1)


@pytest.fixture
def disc():
    """Points of a flat disc, those of the rim first, and the weights of its triangles."""
    flat = ring(40)[:, :2]
    inner = away_from_curve(flat)
    points = np.concatenate([flat, inner[np.linalg.norm(inner, axis=1) < 1]])
    return points, harmonic_weights(points, Delaunay(points).simplices)


def test_linear_functions_stay_linear_and_others_between_their_bounds(disc):
    points, weights = disc
    values = points @ [[2.0, 1.0], [-3.0, 0.5]] + 7.0
    assert spread(weights, values[:40]) == pytest.approx(values[40:], abs=1e-12)
    rough = np.random.default_rng(0).random((40, 1))
    found = spread(weights, rough)
    assert rough.min() < found.min()
    assert found.max() < rough.max()


def test_what_is_held_stays(disc):
    points, weights = disc
    fixed = np.arange(len(points)) % 3 == 0
    values = np.random.default_rng(1).random((len(points), 2))
    found = spread(weights, values[fixed], fixed)
    assert np.array_equal(found[fixed], values[fixed])
    assert found.min() >= values[fixed].min()


def test_a_saddle_is_seen_along_its_normal_at_any_pose_and_scale():
    turn, _ = np.linalg.qr(np.random.default_rng(2).standard_normal((3, 3)))
    curve = ring(60, height=0.4)
    flat = over_a_plane(5 * curve @ turn.T + 3)
    lengths = np.linalg.norm(flat - flat.mean(axis=0), axis=1)
    assert lengths * np.sqrt(1 + 0.4**2) == pytest.approx(np.ones(60))
    x, y = flat.T
    assert (x * np.roll(y, -1) - y * np.roll(x, -1) > 0).all()


def test_a_curve_that_encloses_nothing_is_not_seen_from_anywhere():
    assert over_a_plane(np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 0, 0.0]])) is None


def test_round_a_circle_lengths_are_kept():
    curve = ring(30, height=1.0, turns=5)
    flat = in_a_circle(curve)
    assert np.linalg.norm(flat, axis=1) == pytest.approx(np.ones(30))
    length = np.linalg.norm(np.roll(curve, -1, axis=0) - curve, axis=1)
    angle = np.diff(np.unwrap(np.arctan2(*flat.T[::-1])))
    assert angle == pytest.approx(2 * np.pi * length[:-1] / length.sum())
    assert in_a_circle(curve[[0, 0, 1]]) is None


def test_points_grow_sparse_away_from_the_curve():
    """Far fewer than a grid as dense as the curve would have, none close to the curve, none far from all others."""
    flat = ring(400)[:, :2]
    step = 2 * np.pi / 400
    inner = away_from_curve(flat)
    inside = inner[np.linalg.norm(inner, axis=1) < 1]
    assert len(inside) < 3 * 400 < 0.2 * np.pi / step**2
    assert (1 - np.linalg.norm(inside, axis=1)).min() > 0.5 * step
    every = np.concatenate([flat, inside])
    a, b, c = every[Delaunay(every).simplices].transpose(1, 0, 2)
    sides = np.stack([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))])
    area = np.abs(np.cross(np.c_[b - a, 0 * a[:, 0]], np.c_[c - a, 0 * a[:, 0]])[:, 2]) / 2
    quality = 4 * np.sqrt(3) * area / (sides**2).sum(axis=0)  # 1 for an equilateral triangle
    assert np.median(quality) > 0.8
    assert (quality > 0.3).mean() > 0.98
