# SPDX-License-Identifier: GPL-3.0-or-later
"""How much maps change areas and angles, worked out by hand."""

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.uses.maps.distortion import distortion


def grid():
    return CornerTable.of(*shapes.flat_grid(4, 3))


def at_corners(table, flat):
    return flat[table.corner_vertex]


def test_a_map_that_only_moves_turns_and_scales_changes_nothing():
    table = grid()
    flat = 0.1 * table.vertices[:, :2] @ np.array([[0.6, 0.8], [-0.8, 0.6]]) + 5
    found = distortion(table, at_corners(table, flat))
    assert found.scale == pytest.approx(1)
    assert found.even == 1
    assert found.range == pytest.approx((1, 1))
    assert found.angle == pytest.approx(0, abs=1e-6)


def test_a_square_stretched_to_twice_its_width():
    """Its two triangles have the angles 90, 63.4 and 26.6 degrees then: changes of 0, 18.4 and 18.4."""
    table = CornerTable.of(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.array([[0, 1, 2], [0, 2, 3]]))
    found = distortion(table, at_corners(table, table.vertices[:, :2] * (2, 1)))
    assert found.scale == pytest.approx(1)
    assert np.degrees(found.angle) == pytest.approx(2 / 3 * (np.degrees(np.arctan(2)) - 45))


def test_faces_that_grow_and_that_are_turned_over():
    """Two squares of area 1: one four times as large in the map, one turned over in it."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 9], [1, 0, 9], [1, 1, 9], [0, 1, 9.0]])
    table = CornerTable.of(vertices, np.array([[0, 1, 2, 3], [4, 5, 6, 7]]))
    flat = np.concatenate([2 * vertices[:4, :2], vertices[4:, :2] * (-1, 1)])
    found = distortion(table, flat)
    assert found.scale == pytest.approx([4 / 2.5, -1 / 2.5])
    assert found.even == 0.5
    assert found.range == pytest.approx((0.4 + 0.01 * 1.2, 1.6 - 0.01 * 1.2))
    assert found.turned == 1


@pytest.mark.parametrize("direction", [(0.0, 0.0), (1.0, 0.0), (0.3, 0.7)])
@pytest.mark.parametrize("place", [0.0, 0.3])
@pytest.mark.filterwarnings("error")
def test_nothing_is_even_in_a_map_into_a_point_or_a_line(direction, place):
    table = grid()
    along = table.vertices @ (1.0, 0.1, 0.0)
    found = distortion(table, at_corners(table, place + along[:, None] * direction))
    assert found.scale == pytest.approx(0, abs=1e-9)
    assert (found.even, found.range) == (0, pytest.approx((0, 0), abs=1e-9))


def test_a_face_without_an_area_counts_for_nothing():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0.5, 0, 0]])
    table = CornerTable.of(vertices, np.array([[0, 1, 2], [0, 3, 1]]))
    found = distortion(table, at_corners(table, vertices[:, :2] * (1, 1) + 3))
    assert np.isnan(found.scale).tolist() == [False, True]
    assert (found.even, found.angle) == (1, pytest.approx(0, abs=1e-6))
