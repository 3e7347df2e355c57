# SPDX-License-Identifier: GPL-3.0-or-later
"""Shares of parts at vertices: by area, kept together by each step, and equal on borders on average."""

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.steps import finished
from core.uses.clean_cuts.band import Band
from core.uses.clean_cuts.pins import Pins
from core.uses.clean_cuts.shares import Diffusion, Shares, diffusing


def ragged(n_parts):
    """A ball, and slices of it with ragged borders."""
    table = CornerTable.of(*shapes.icosphere(3))
    x, y, z = table.face_means(table.vertices).T
    turn = (np.arctan2(y, x) + 0.4 * np.sin(4 * z)) % (2 * np.pi)
    return Band.of(table, (turn * n_parts / (2 * np.pi)).astype(np.int64), 12)


def test_before_diffusion_shares_are_those_of_the_area_around():
    table = CornerTable.of(*shapes.flat_grid(2, 1))  # four triangles of one area
    band = Band.of(table, np.array([0, 0, 1, 2]), 3)
    around = [table.corner_face[table.corner_vertex == vertex] for vertex in range(6)]
    expected = [[np.mean([band.labels[face] == label for face in faces]) for label in range(3)] for faces in around]
    assert Diffusion.of(band).shares.toarray() == pytest.approx(np.array(expected))


def test_a_step_gives_nothing_away():
    diffusion = Diffusion.of(ragged(3))
    walk = diffusion.walk.toarray()
    assert (walk >= 0).all()
    assert walk.sum(axis=1) == pytest.approx(1.0)
    assert diffusion.shares.sum(axis=1) == pytest.approx(1.0)


@pytest.mark.parametrize("steps", [1, 4, 10])
def test_on_the_border_of_two_parts_shares_are_equal_on_average(steps):
    """So neither part grows at the cost of the other."""
    band = ragged(2)
    shares = finished(diffusing(band, Diffusion.of(band), Pins.none(), steps))
    low, high = band.edge_labels
    cut = np.flatnonzero(low < high)
    gaps = [shares.of(end, low[cut]) - shares.of(end, high[cut]) for end in band.table.edges[cut].T]
    length = band.table.edge_length(cut)
    assert np.abs(gaps).max() > 0.01
    assert (length * np.mean(gaps, axis=0)).sum() / length.sum() == pytest.approx(0.0, abs=1e-12)


def test_the_largest_share_and_where_two_are_equal():
    # Of three parts vertex 0 has 0.7, 0.3 and none, vertex 1 has 0.2, 0.6 and 0.2, vertex 2 as much of 0 as of 2.
    shares = Shares(3, np.array([0, 1, 3, 4, 5, 6, 8]), np.array([0.7, 0.3, 0.2, 0.6, 0.2, 0.5, 0.5]))
    assert shares.top.tolist() == [0, 1, 0]
    assert shares.of(np.array([0, 0, 1]), np.array([1, 2, 2])).tolist() == [0.3, 0.0, 0.2]
    # 0.7 - 0.3 falls to 0.2 - 0.6: both are equal in the middle; from 1 to 2, 0.6 - 0.2 falls to 0 - 0.5.
    assert shares.crossing(np.array([(0, 1), (1, 2)])) == pytest.approx([0.5, 0.4 / 0.9])
