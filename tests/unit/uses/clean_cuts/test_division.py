# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces divided where curves run: quads are, those with a corner turned in only as triangles, the others not at all."""

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable
from core.uses.clean_cuts.band import Band
from core.uses.clean_cuts.division import divide
from core.uses.clean_cuts.method import clean_cuts
from core.uses.clean_cuts.sides import Sides

N_X, N_Y = 12, 8


def quads():
    """A sheet of 12 x 8 squares."""
    index = np.arange((N_X + 1) * (N_Y + 1)).reshape(N_X + 1, N_Y + 1)
    faces = np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1).reshape(-1, 4)
    return shapes.flat_grid(N_X, N_Y).vertices.copy(), faces


def ragged(table):
    """Two parts with a border up and down, by the middles of the faces, from side to side."""
    x, y, _ = table.face_means(table.vertices).T
    return (y > 4.2 + 0.25 * (x - 6) + 0.3 * np.sin(2.1 * x)).astype(np.int64)


def turned_in(vertices, x, y):
    """Move a corner of a square beyond the diagonal that faces it."""
    vertices[x * (N_Y + 1) + y] += (0.6, 0.6, 0.0)
    return x * N_Y + y


def test_squares_are_divided_as_they_are():
    table = CornerTable.of(*quads())
    labels = ragged(table)
    cuts = clean_cuts(table, labels)
    divided = np.flatnonzero(np.bincount(cuts.face, minlength=table.n_faces) > 1)
    assert len(divided) > N_X / 2
    assert not len(cuts.odd)


def test_of_squares_with_a_corner_turned_in_only_those_at_a_curve_have_to_be_triangles():
    vertices, faces = quads()
    labels = ragged(CornerTable.of(vertices, faces))
    plain = clean_cuts(CornerTable.of(vertices, faces), labels)
    crossed = np.flatnonzero(np.bincount(plain.face, minlength=len(faces)) > 1)
    at_curve = int(crossed[len(crossed) // 2])
    turned_in(vertices, *divmod(at_curve, N_Y))
    beyond = turned_in(vertices, 2, 6)
    table = CornerTable.of(vertices, faces)
    assert set(np.flatnonzero(~Band.of(table, labels, 12).convex)) >= {at_curve, beyond}
    cuts = clean_cuts(table, labels)
    assert cuts.odd.tolist() == [at_curve]
    assert np.count_nonzero(cuts.face == at_curve) <= 1


@pytest.mark.parametrize("share", [0.25, 0.5])
def test_a_square_that_a_curve_crosses_is_in_two_fragments(share):
    """Two squares side by side, cut straight through both."""
    vertices = np.array([(x, y, 0) for x in range(3) for y in range(2)], float)
    table = CornerTable.of(vertices, np.array([(0, 2, 3, 1), (2, 4, 5, 3)]))
    band = Band.of(table, np.array([0, 1]), 3)
    top = vertices[:, 1].astype(np.int64)
    upright = vertices[table.edges[:, 0], 0] == vertices[table.edges[:, 1], 0]
    division = divide(band, Sides(top, top, np.where(upright, share, np.nan), np.full(6, -1)))
    assert division.n_fragments.tolist() == [2, 2]
    assert not division.odd.any()
    n = len(vertices)
    left, middle, right = (n + int(np.flatnonzero((table.edges == (2 * x, 2 * x + 1)).all(axis=1))[0])
                           for x in range(3))
    # From its right side the upper half of a square goes round to its left side, the lower half back.
    starts = [(int(face), int(point), int(label)) for face, point, label in
              zip(division.face[division.begins], division.point[division.begins], division.label[division.begins],
                  strict=True)]
    assert starts == [(0, middle, 1), (0, left, 0), (1, right, 1), (1, middle, 0)]


@pytest.mark.parametrize("corner", [(0.0, 0.0, 0.0), (0.6, 0.6, 0.0)])  # the second beyond the diagonal before it
def test_a_square_whose_corners_a_curve_only_passes_stays_whole_with_a_corner_turned_in_or_not(corner):
    """A curve through two corners next to each other runs along the edge between them."""
    vertices = np.array([(x, y, 0) for x in range(3) for y in range(2)], float)
    vertices[0] = corner
    band = Band.of(CornerTable.of(vertices, np.array([(0, 2, 3, 1), (2, 4, 5, 3)])), np.array([0, 1]), 3)
    assert band.convex.tolist() == [not any(corner), True]
    low, high = np.array([0, 0, 0, 0, 1, 1]), np.array([0, 0, 1, 1, 1, 1])
    division = divide(band, Sides(low, high, np.full(len(band.table.edges), np.nan), np.full(6, -1)))
    assert division.n_fragments.tolist() == [1, 1]
    assert not division.odd.any()
    assert not division.concerned(band.labels).any()


def test_a_face_with_a_corner_on_the_other_side_is_not_divided_without_points_on_its_edges():
    """A fragment of one edge would have no area."""
    vertices = np.array([(x, y, 0) for x in range(3) for y in range(2)], float)
    band = Band.of(CornerTable.of(vertices, np.array([(0, 2, 1), (2, 3, 1), (2, 4, 3), (4, 5, 3)])),
                   np.array([0, 0, 1, 1]), 3)
    side = np.array([0, 0, 0, 0, 1, 1])
    division = divide(band, Sides(side, side, np.full(len(band.table.edges), np.nan), np.full(6, -1)))
    assert division.n_fragments.tolist() == [1, 1, 1, 1]
