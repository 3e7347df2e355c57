# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of polygons that a fan would fold have one decomposition, whichever corner or vertex comes first."""

import numpy as np
import pytest
from folding import LETTER_H, bumps, extruded

from core import decompose
from core.metrics import rand_index_error


def test_solids_of_concave_polygons_have_their_area_and_one_decomposition():
    flat = np.array(LETTER_H, float)
    x, y = flat.T
    area = x @ np.roll(y, -1) - y @ np.roll(x, -1) + np.linalg.norm(np.roll(flat, -1, axis=0) - flat, axis=1).sum()
    found = [decompose(*extruded(LETTER_H, first)).parts() for first in range(0, 12, 3)]
    for parts in found:
        assert parts.area.sum() == pytest.approx(area)
        assert rand_index_error(parts.labels, found[0].labels) == 0


def test_models_of_folded_quads_have_one_decomposition_however_vertices_are_numbered():
    vertices, quads = bumps()
    number = np.random.default_rng(1).permutation(len(vertices))
    one, two = decompose(vertices, quads), decompose(vertices[number], np.argsort(number)[quads])
    np.testing.assert_array_equal(one.candidates, two.candidates)
    np.testing.assert_array_equal(one.hierarchy.salience, two.hierarchy.salience)
