# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes on both sides of a plane, on rows of faces by hand: 1 1 2 3 3 2' ... with part 3 in the middle."""

from itertools import count

import numpy as np
import pytest

from core.mesh.face_graph import FaceGraph
from core.result.editing.mirrored import MirroredChange, cleaned, gathered, on_both_sides, without_crumbs

BEFORE = [1, 1, 1, 3, 3, 3, 3, 2, 2, 2]
TWIN = list(range(9, -1, -1))
NUMBERS = {1: 2, 2: 1, 3: 3}
NO_TWIN = np.full(10, -1)


@pytest.mark.parametrize(("after", "expected"), [
    # A part grows, its image too.
    ([1, 1, 1, 1, 3, 3, 3, 2, 2, 2], [1, 1, 1, 1, 3, 3, 2, 2, 2, 2]),
    # A part merges into the middle.
    ([3, 3, 3, 3, 3, 3, 3, 2, 2, 2], [3, 3, 3, 3, 3, 3, 3, 3, 3, 3]),
    # A part is split: a new part on either side.
    ([4, 1, 1, 3, 3, 3, 3, 2, 2, 2], [4, 1, 1, 3, 3, 3, 3, 2, 2, 5]),
    # A new part across the plane is one.
    ([1, 1, 1, 3, 4, 4, 3, 2, 2, 2], [1, 1, 1, 3, 4, 4, 3, 2, 2, 2]),
    # The middle is cut in its middle: both halves are there already.
    ([1, 1, 1, 4, 4, 3, 3, 2, 2, 2], [1, 1, 1, 4, 4, 3, 3, 2, 2, 2]),
    # What was changed on both sides stays.
    ([1, 1, 1, 1, 3, 3, 4, 2, 2, 2], [1, 1, 1, 1, 3, 3, 4, 2, 2, 2]),
])
def test_changes(after, expected):
    new = count(5)
    result = on_both_sides(np.array(BEFORE), np.array(after), np.array(TWIN), NUMBERS, lambda: next(new))
    assert result.tolist() == expected


def test_what_has_no_image_changes_alone():
    new = count(5)
    twin = np.array([-1, *TWIN[1:-1], -1])
    after = np.array([4, *BEFORE[1:]])
    assert on_both_sides(np.array(BEFORE), after, twin, NUMBERS, lambda: next(new)).tolist() == after.tolist()
    after = np.array([*BEFORE[:3], 1, *BEFORE[4:]])
    assert on_both_sides(
        np.array(BEFORE), after, np.array(TWIN), {3: 3}, lambda: next(new)).tolist() == after.tolist()


def test_an_image_that_was_of_another_part_keeps_it():
    """The face of part 1 that goes to part 2 has its image in part 3, which is not that of part 1."""
    before = np.array([1, 1, 3, 3, 3, 2])
    twin = np.array([4, 5, 3, 2, 0, 1])
    after = np.array([2, 1, 3, 3, 3, 2])
    assert on_both_sides(before, after, twin, NUMBERS, lambda: 9).tolist() == after.tolist()


@pytest.mark.parametrize(("asked", "both", "expected"), [
    # The last face has no image, and is cut off where its twin is part of what was cut.
    ([4, 4, 1, 1, 3, 3, 2, 2, 2, 2], [4, 4, 1, 1, 3, 3, 2, 2, 5, 2], [4, 4, 1, 1, 3, 3, 2, 2, 5, 5]),
    # What the change itself cuts off is wanted.
    ([1, 1, 1, 1, 3, 3, 2, 2, 5, 2], [1, 4, 1, 1, 3, 3, 2, 2, 5, 2], [1, 4, 1, 1, 3, 3, 2, 2, 5, 2]),
    # A few faces that were given to a part far from it, and their image, are parts apart.
    ([2, 1, 1, 1, 3, 3, 2, 2, 2, 2], [2, 1, 1, 1, 3, 3, 2, 2, 2, 1], [2, 1, 1, 1, 3, 3, 2, 2, 2, 1]),
    # Without an image nothing changes.
    ([4, 1, 1, 1, 3, 3, 2, 2, 5, 2], [4, 1, 1, 1, 3, 3, 2, 2, 5, 2], [4, 1, 1, 1, 3, 3, 2, 2, 5, 2])])
def test_crumbs_that_an_image_leaves_join_the_part_around_them(asked, both, expected):
    area = np.ones(10)
    area[9] = 0.01
    row = np.arange(9)
    graph = FaceGraph(10, np.stack([row, row + 1], axis=1), np.ones(9), area)
    before = np.array([1, 1, 1, 1, 3, 3, 2, 2, 2, 2])
    change = MirroredChange(graph, graph, NO_TWIN, before, np.array(asked), np.array(both))
    assert without_crumbs(change).tolist() == expected


def test_a_large_piece_that_an_image_leaves_is_a_part():
    row = np.arange(9)
    graph = FaceGraph(10, np.stack([row, row + 1], axis=1), np.ones(9), np.ones(10))
    both = np.array([4, 4, 1, 1, 3, 3, 2, 2, 5, 2])
    before, asked = np.array([[1, 1, 1, 1, 3, 3, 2, 2, 2, 2], [4, 4, 1, 1, 3, 3, 2, 2, 2, 2]])
    assert without_crumbs(MirroredChange(graph, graph, NO_TWIN, before, asked, both)).tolist() == both.tolist()


def test_two_faces_with_one_image_both_change_with_it():
    """Faces 2 and 3 have face 0 as their image, which has but one of them."""
    before, after = np.array([[1, 1, 2, 2, 2], [5, 1, 2, 2, 2]])
    found = on_both_sides(before, after, np.array([2, 4, 0, 0, 1]), {1: 2, 2: 1}, lambda: 6)
    assert found.tolist() == [5, 1, 6, 6, 2]


ROW = np.array([1] * 8 + [2] * 8)  # two rows of faces, which are no neighbors; the second one is the image of the first
CUT = np.array([4] * 4 + [1] * 4 + [2] * 8)


def gathered_row(image, twin):
    row = np.arange(16)
    pairs = np.stack([row[:-1], row[1:]], axis=1)
    graph = FaceGraph(16, np.delete(pairs, 7, axis=0), np.ones(14), np.ones(16))
    both = np.array([*CUT[:8], *image])
    return gathered(MirroredChange(graph, graph, np.append(row[8:], twin), ROW, CUT, both)).tolist()


@pytest.mark.parametrize(("twin", "expected"), [
    ([0, 1, 2, 3, 4, 5, 6, 7], [5, 5, 5, 5, 2, 2, 2, 2]),
    ([0, 1, 2, 5, 4, 3, 6, 7], [5, 5, 5, 2, 2, 2, 2, 2]),  # a crumb apart
    ([0, 5, 1, 2, 3, 6, 6, 7], [5, 5, 5, 5, 5, 2, 2, 2]),  # and one that is left
    ([4, 0, 5, 1, 6, 2, 7, 3], [2, 2, 2, 2, 2, 2, 2, 2])])  # scattered: none
def test_an_image_is_in_as_many_regions_as_the_change(twin, expected):
    image = [5 if face < 4 else 2 for face in twin]
    assert gathered_row(image, twin) == [*CUT[:8], *expected]


@pytest.mark.parametrize(("contacts", "last"), [([[7, 9]], 2), ([], 6)])
def test_what_touches_its_part_is_no_crumb(contacts, last):
    """The last face lies beside part 6, and belonged to part 2 before, which it touches: no image moved it."""
    area, row = np.ones(10), np.arange(9)
    area[9] = 0.01
    graph = FaceGraph(10, np.stack([row, row + 1], axis=1), np.ones(9), area)
    before = np.array([1, 1, 1, 1, 3, 3, 2, 2, 6, 2])
    asked, both = before.copy(), before.copy()
    asked[0] = both[0] = 4
    both[6] = 5
    twin = np.array([6, 7, -1, -1, -1, -1, 0, 1, -1, -1])
    contacts = np.array(contacts, np.int64).reshape(-1, 2)
    found = cleaned(MirroredChange(graph, graph.with_contacts(contacts), twin, before, asked, both))
    assert found.tolist() == [4, 1, 1, 1, 3, 3, 5, 2, 6, last]
