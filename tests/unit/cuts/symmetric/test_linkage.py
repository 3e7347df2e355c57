# SPDX-License-Identifier: GPL-3.0-or-later
"""Merges of four cells in a row, mirrored in its middle, worked out by hand."""

import numpy as np
import pytest
from face_graphs import path
from scipy.sparse import csr_array

from core.cuts.hierarchy import LAST
from core.cuts.symmetric.cells import Cells
from core.cuts.symmetric.linkage import symmetric_linkage
from core.symmetry.group import SymmetryGroup

TWIN = np.array([3, 2, 1, 0])


def row_of_four(areas):
    """Cells 0, 1 | 2, 3, each a face and a candidate of its own; the first two lead."""
    here = np.arange(4)
    image = np.stack([here, TWIN], axis=1)
    leads = np.array([(True, False)] * 2 + [(False, True)] * 2)
    one = np.eye(4)
    return Cells(here, image, (csr_array(one), csr_array(one[TWIN])), leads, image, np.array(areas, float),
                 SymmetryGroup.of_planes(TWIN[None]))


def salience(**pairs):
    """Of what parts two candidates: _01=0.2 and so on."""
    table = np.zeros((4, 4))
    for name, value in pairs.items():
        a, b = map(int, name[1:])
        table[a, b] = table[b, a] = value
    return table


def merged(areas, table):
    hierarchy = symmetric_linkage(row_of_four(areas), path(4), table)
    return [sorted(merge) for merge in hierarchy.merges.tolist()], hierarchy.salience


def test_a_side_merges_together_with_its_image_as_the_leading_side_says():
    """What was found of 2 and 3 does not count; across the plane both sides are averaged, and cells by area."""
    table = salience(_01=0.2, _23=0.6, _12=0.5, _02=0.7, _13=0.8, _03=0.9)
    merges, found = merged((1, 2, 2, 1), table)
    assert merges == [[0, 1], [2, 3], [0, 2]]
    # Pairs 0 2 and 1 3 with the mean 0.75 and the weight 2 each, 0 3 with 1, 1 2 with 4.
    assert found == pytest.approx([0.2, 0.2, (2 * 0.75 + 2 * 0.75 + 0.9 + 4 * 0.5) / 9])


def test_what_lies_across_the_plane_takes_in_both_sides_at_once():
    """1 and 2 are their own image, of area 2. To take in 0 they take in 3, too: 4 pairs with the two, and 0 with 3."""
    table = salience(_01=0.4, _23=0.4, _12=0.1, _02=0.7, _13=0.8, _03=0.9)
    merges, found = merged((1, 1, 1, 1), table)
    assert merges == [[1, 2], [0, 1], [0, 3]]
    together = (4 * (0.4 + 0.75) / 2 + 0.9) / 5
    assert found == pytest.approx([0.1, together, together])


def test_what_nothing_brought_near_each_other_is_not_averaged_with_its_image():
    """0 and 2 are as far apart as can be, whatever is known of 3 and 1; these get the mean."""
    table = salience(_01=0.2, _23=0.2, _12=0.5, _02=LAST, _13=0.1, _03=0.9)
    merges, found = merged((1, 1, 1, 1), table)
    assert merges == [[0, 1], [2, 3], [0, 2]]
    assert found == pytest.approx([0.2, 0.2, (LAST + (LAST + 0.1) / 2 + 0.9 + 0.5) / 4])


def test_cells_without_images_merge_like_others():
    """The group is the identity alone, and the middle pair is parted least."""
    here = np.arange(4)
    cells = Cells(here, here[:, None], (csr_array(np.eye(4)),), np.ones((4, 1), bool), here[:, None], np.ones(4),
                  SymmetryGroup.of_planes(np.empty((0, 4), np.int64)))
    table = salience(_01=0.4, _23=0.8, _12=0.1, _02=0.6, _13=0.6, _03=0.9)
    hierarchy = symmetric_linkage(cells, path(4), table)
    assert [sorted(merge) for merge in hierarchy.merges.tolist()] == [[1, 2], [0, 1], [0, 3]]
    assert hierarchy.salience == pytest.approx([0.1, (0.4 + 0.6) / 2, (0.8 + 0.6 + 0.9) / 3])
