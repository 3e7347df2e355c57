# SPDX-License-Identifier: GPL-3.0-or-later
"""The marks of nodes as triangles; that they are drawn, tests/window shows."""

import sys

import numpy as np
import pytest


@pytest.fixture
def markers(package):
    return sys.modules[f"{package}.operators.markers"]


def test_marks_lie_in_the_view_plane_around_their_node(markers):
    places = np.array([(0.0, 0.0, 0.0), (5.0, 1.0, 2.0), (-3.0, 0.0, 1.0)])
    kinds = ["minimum", "saddle", "maximum"]
    colors = np.array([(1, 1, 0, 1), (0, 0, 0.2, 1), (0.2, 0.6, 0.9, 1)], float)
    right, up = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    points, shades = markers.marks(places, kinds, colors, right, up, np.array([1.0, 2.0, 3.0]))
    assert points.dtype == shades.dtype == np.float32
    assert points.flags.c_contiguous
    assert shades.flags.c_contiguous
    assert len(points) == len(shades) == 2 * 3 * (20 + 4 + 3)
    start = 0
    for place, color, radius, sides in zip(places, colors, (1.0, 2.0, 3.0), (20, 4, 3), strict=True):
        own = slice(start, start + 6 * sides)
        start += 6 * sides
        offset = points[own] - place
        assert np.abs(offset[:, 0]).max() < 1e-5  # towards the viewer
        size = np.linalg.norm(offset, axis=1)
        assert size.max() <= 1.4 * markers.RIM * radius * 1.001
        assert size.max() >= radius
        # The rim first, the mark over it.
        assert (shades[own][-3 * sides:] == color.astype(np.float32)).all()
        bright = color[:3] @ (0.2126, 0.7152, 0.0722) > 0.3
        assert (shades[own][: 3 * sides, 0] < 0.5).all() == bright


def test_kinds_look_different(markers):
    assert set(markers.SHAPES) == {"minimum", "saddle", "maximum"}
    assert len({len(outline) for outline in markers.SHAPES.values()}) == 3
