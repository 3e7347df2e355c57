# SPDX-License-Identifier: GPL-3.0-or-later
"""What a part looks like by itself, worked out by hand at a few points."""

import numpy as np
import pytest
import shapes

from core import TriMesh
from core.cuts.joining.part_shapes import FARTHEST, PART, SPREAD, PartShapes
from core.surface.contact import SurfacePoints


def crosses(*extents):
    """Parts, each a piece of one triangle, of six points each: two on every axis, as far out as ``extents`` say."""
    count = len(extents)
    triangle = shapes.Shape(np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)]), np.array([(0, 1, 2)]))
    mesh = TriMesh(*shapes.together(*[triangle] * count))
    position = np.concatenate([np.concatenate([np.diag(e), -np.diag(e)]) + (10 * k, 0, 0)
                               for k, e in enumerate(extents)])
    part = np.repeat(np.arange(count), 6)
    points = SurfacePoints(position, part, 3 * part + np.tile([0, 0, 0, 1, 1, 1], count), np.full(len(part), 0.5))
    return PartShapes.of(mesh, np.arange(count), points, np.tile([0.25, 0.75, 0.0], count))


def test_a_cross_by_hand():
    found = crosses((1.0, 3.0, 2.0))
    assert found.area == [pytest.approx(3)] == found.piece_area
    assert found.center == pytest.approx(np.zeros((1, 3)))
    assert found.extents == pytest.approx(np.array([(3, 2, 1)]) / np.sqrt(3))  # two points of six are that far out
    assert np.abs(found.axes[0]) == pytest.approx(np.eye(3)[:, [1, 2, 0]])
    assert found.space.tolist() == [[0, 1, 2]]
    assert (found.agd[0], found.agd_deviation[0]) == pytest.approx((0.5, 0.25))
    columns = found.columns(np.array([0.125]))
    assert sorted(columns) == sorted(PART)
    assert columns["extent_1"] == pytest.approx(1.0)
    assert columns["extent_2"] == pytest.approx(2 / 3)
    assert columns["extent_3"] == pytest.approx(1 / 3) == columns["flatness"]
    assert (columns["touched"], columns["parts_of_piece"], columns["repeats"]) == (0.125, 1, 0)


def test_equal_extents_are_of_one_space():
    assert crosses((2.0, 1.0, 1.0), (1.0, 1.0, 2.0), (1.0, 1.0, 1.0), (2.0, 2.0, 1.0)).space.tolist() == [
        [0, 1, 1], [0, 1, 1], [0, 0, 0], [0, 0, 1]]


def test_repeats_are_counted_however_they_are_turned():
    assert crosses((1.0, 2.0, 3.0), (3.0, 1.0, 2.0), (1.0, 2.0, 4.0), (3.0, 2.0, 1.0)).columns(np.zeros(4))[
        "repeats"].tolist() == [2, 2, 0, 2]


def test_outside_is_along_the_axis_where_it_is_most():
    found = crosses((3.0, 1.0, 1.0), (60.0, 1.0, 1.0))
    one, other = np.array([0, 1]), np.array([1, 0])
    assert found.outside(one, other) == pytest.approx([10 / (60 / np.sqrt(3) + SPREAD), FARTHEST])
    assert found.unlikeness(one, other) == pytest.approx(np.log(20), abs=0.01)
