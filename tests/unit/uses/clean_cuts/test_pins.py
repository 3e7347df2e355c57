# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices that curves go through: those of creases that borders follow, on a roof whose ridge is one."""

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.uses.clean_cuts.band import Band
from core.uses.clean_cuts.pins import GAP, Pins, are_between

RIDGE, LENGTH, LEFT = 4, 24, 10  # x of the ridge, its edges, and where a border leaves it


def roof(steepness):
    """Two slopes of 4 x 24 squares, which meet at x = 4."""
    vertices, faces = shapes.flat_grid(2 * RIDGE, LENGTH)
    return CornerTable.of(vertices - [0, 0, steepness] * np.abs(vertices[:, :1] - RIDGE), faces)


def slopes(table, n_beside=0):
    """A part for each slope, but for so many squares beside the ridge that belong to the other slope."""
    x, y, _ = table.face_means(table.vertices).T
    beside = (x > RIDGE) & (x < RIDGE + 1) & (y > LEFT) & (y < LEFT + n_beside)
    return ((x > RIDGE) & ~beside).astype(np.int64)


def pinned(table, labels):
    """Places along the ridge of the vertices that are pinned, and the pins."""
    band = Band.of(table, labels, 12)
    pins = Pins.of(band)
    places = band.table.vertices[pins.vertex]
    assert (places[:, 0] == RIDGE).all()
    return sorted(places[:, 1].tolist()), pins, band


def test_a_border_along_a_crease_is_pinned_from_end_to_end():
    table = roof(1.0)  # the faces turn by 90 degrees
    places, pins, _ = pinned(table, slopes(table))
    assert places == list(range(LENGTH + 1))
    assert (pins.pair == [0, 1]).all()


@pytest.mark.parametrize("steepness", [0.0, np.tan(np.radians(14.9))])
def test_where_faces_turn_less_nothing_is_pinned(steepness):
    table = roof(steepness)
    assert pinned(table, slopes(table))[0] == []


def test_a_border_beside_a_crease_is_not_pinned():
    table = roof(1.0)
    labels = (table.face_means(table.vertices)[:, 0] > RIDGE + 1).astype(np.int64)
    assert pinned(table, labels)[0] == []


@pytest.mark.parametrize("n_beside", range(1, 8))
def test_where_a_border_leaves_a_crease_it_is_pinned_only_if_it_comes_back_soon(n_beside):
    table = roof(1.0)
    away = [] if n_beside < 2 * GAP else range(LEFT, LEFT + n_beside + 1)
    assert pinned(table, slopes(table, n_beside))[0] == [y for y in range(LENGTH + 1) if y not in away]


def test_pins_are_of_no_use_beside_a_third_part():
    table = roof(1.0)
    _, pins, band = pinned(table, slopes(table))
    top = (band.table.vertices[:, 0] > RIDGE).astype(np.int64)
    assert are_between(band, pins, top).all()
    top[(band.table.vertices[:, :2] == [RIDGE + 1, 6]).all(axis=1)] = 2
    # (4, 5) and (4, 6) are its neighbors, each square being cut along its rising diagonal.
    alone = ~are_between(band, pins, top)
    assert band.table.vertices[pins.vertex[alone], 1].tolist() == [5, 6]
