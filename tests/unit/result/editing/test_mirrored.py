# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes on both sides of a plane, on rows of faces by hand: 1 1 2 3 3 2' ... with part 3 in the middle."""

from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest
from face_graphs import path

from core.mesh.face_graph import FaceGraph
from core.result.editing.mirrored import (
    MirroredChange,
    Sides,
    cleaned,
    gathered,
    on_both_sides,
    own_halves,
    twin_numbers,
    without_crumbs,
)

BEFORE = [1, 1, 1, 3, 3, 3, 3, 2, 2, 2]
TWIN = list(range(9, -1, -1))
NUMBERS = {1: 2, 2: 1, 3: 3}
NO_TWIN = np.full(10, -1)


def test_images_by_number():
    """Of four parts two are images of each other, one is its own, and one has none."""
    numbered = SimpleNamespace(numbers=np.array([7, 9, 4, 6]), parts=SimpleNamespace(twin=np.array([1, 0, -1, 3])))
    assert twin_numbers(numbered) == {7: 9, 9: 7, 6: 6}


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
    # One that is half its own image has another one for the other half.
    ([1, 4, 4, 3, 4, 4, 3, 2, 2, 2], [1, 4, 4, 3, 4, 4, 3, 5, 5, 2]),
    # Two changes at a time, each with its own image.
    ([4, 1, 3, 3, 3, 3, 3, 2, 2, 2], [4, 1, 3, 3, 3, 3, 3, 3, 2, 5]),
    # New parts of both sides are no images of each other.
    ([4, 4, 4, 3, 3, 3, 3, 2, 7, 7], [4, 4, 4, 3, 3, 3, 3, 5, 7, 7]),
    # What was changed on both sides stays.
    ([1, 1, 1, 1, 3, 3, 4, 2, 2, 2], [1, 1, 1, 1, 3, 3, 4, 2, 2, 2]),
])
def test_changes(after, expected):
    for order in (slice(None), slice(None, None, -1)):  # twins are as far from the end
        new = count(5)
        given, wanted = np.array(BEFORE)[order], np.array(after)[order]
        result = on_both_sides(given, wanted, np.array(TWIN), NUMBERS, lambda new=new: next(new))
        assert result[order].tolist() == expected


SIDE = np.array([1] * 5 + [-1] * 5)


@pytest.mark.parametrize(("asked", "halves", "expected"), [
    ([1, 1, 1, 1, 1, 1, 2, 2, 2, 2], [1, 1, 1, 1, 1, 3, 2, 2, 2, 2], [1, 1, 1, 1, 1, 2, 2, 2, 2, 2]),
    ([1, 1, 1, 1, 2, 2, 2, 2, 2, 2], [1, 1, 1, 1, 3, 2, 2, 2, 2, 2], [1, 1, 1, 1, 1, 2, 2, 2, 2, 2]),
    ([1, 1, 1, 1, 3, 1, 2, 2, 2, 2], [1, 1, 1, 1, 3, 1, 2, 2, 2, 2], [1, 1, 1, 1, 3, 1, 2, 2, 2, 2]),
    ([1, 1, 1, 1, 4, 4, 2, 2, 2, 2], [1, 1, 1, 1, 4, 4, 2, 2, 2, 2], [1, 1, 1, 1, 4, 4, 2, 2, 2, 2])])
def test_of_faces_and_their_images_each_side_has_its_own(asked, halves, expected):
    """The part across the plane ends where the user has given all of it away."""
    before, asked, twin = np.array(BEFORE), np.array(asked), np.array(TWIN)
    found = own_halves(before, asked, Sides(twin, SIDE, np.array([0, 1, -1, 0])))
    assert found.tolist() == halves
    both = on_both_sides(before, found, twin, NUMBERS, lambda: 9, np.setdiff1d(before, asked).tolist())
    assert both.tolist() == expected


def test_what_has_no_image_changes_alone():
    new = count(5)
    twin = np.array([-1, *TWIN[1:-1], -1])
    after = np.array([4, *BEFORE[1:]])
    assert on_both_sides(np.array(BEFORE), after, twin, NUMBERS, lambda: next(new)).tolist() == after.tolist()
    after = np.array([*BEFORE[:3], 1, *BEFORE[4:]])
    for images in ({3: 3}, {1: 2, 2: 1}):
        assert on_both_sides(
            np.array(BEFORE), after, np.array(TWIN), images, lambda: next(new)).tolist() == after.tolist()
    assert next(new) == 5  # no number was taken for an image


def test_a_new_part_where_no_part_has_an_image():
    """It was a traceback."""
    before, after = np.array([1, 1]), np.array([1, 2])
    assert on_both_sides(before, after, np.array([0, 1]), {}, lambda: 9).tolist() == [1, 2]


def test_faces_without_twins_do_not_tell_whether_a_part_is_its_own_image():
    """Of the new part, the first two have none; of the other three, two are images of each other."""
    twin = np.array([-1, -1, *TWIN[2:8], -1, -1])
    after = np.array([4, 4, 4, 3, 4, 4, 3, 2, 2, 2])
    found = on_both_sides(np.array(BEFORE), after, twin, NUMBERS, lambda: 9)
    assert found.tolist() == [4, 4, 4, 3, 4, 4, 3, 4, 2, 2]


def test_an_image_that_was_of_another_part_keeps_it():
    """The face of part 1 that goes to part 2 has its image in part 3, which is not that of part 1."""
    before = np.array([1, 1, 3, 3, 3, 2])
    twin = np.array([4, 5, 3, 2, 0, 1])
    after = np.array([2, 1, 3, 3, 3, 2])
    assert on_both_sides(before, after, twin, NUMBERS, lambda: 9).tolist() == after.tolist()


@pytest.mark.parametrize("unit", [1.0, 1000.0, 1e-6])
@pytest.mark.parametrize(("asked", "both", "expected"), [
    # The last face has no image, and is cut off where its twin is part of what was cut.
    ([4, 4, 1, 1, 3, 3, 2, 2, 2, 2], [4, 4, 1, 1, 3, 3, 2, 2, 5, 2], [4, 4, 1, 1, 3, 3, 2, 2, 5, 5]),
    # What the change itself cuts off is wanted.
    ([1, 1, 1, 1, 3, 3, 2, 2, 5, 2], [1, 4, 1, 1, 3, 3, 2, 2, 5, 2], [1, 4, 1, 1, 3, 3, 2, 2, 5, 2]),
    # A few faces that were given to a part far from it, and their image, are parts apart.
    ([2, 1, 1, 1, 3, 3, 2, 2, 2, 2], [2, 1, 1, 1, 3, 3, 2, 2, 2, 1], [2, 1, 1, 1, 3, 3, 2, 2, 2, 1]),
    # Without an image nothing changes.
    ([4, 1, 1, 1, 3, 3, 2, 2, 5, 2], [4, 1, 1, 1, 3, 3, 2, 2, 5, 2], [4, 1, 1, 1, 3, 3, 2, 2, 5, 2])])
def test_crumbs_that_an_image_leaves_join_the_part_around_them(asked, both, expected, unit):
    graph = path(10, areas=unit * np.array([*[1.0] * 9, 0.01]))
    before = np.array([1, 1, 1, 1, 3, 3, 2, 2, 2, 2])
    change = MirroredChange(graph, graph, NO_TWIN, before, np.array(asked), np.array(both))
    assert without_crumbs(change).tolist() == expected


@pytest.mark.parametrize(("area", "last"), [(1.0, 2), (0.042, 2), (0.040, 5)])
def test_a_piece_of_a_fiftieth_that_an_image_leaves_is_a_part(area, last):
    """Beside two faces of its part: 0.042 of 2.042 are more than a fiftieth, 0.040 of 2.040 are less."""
    graph = path(10, areas=[*[1.0] * 9, area])
    both = np.array([4, 4, 1, 1, 3, 3, 2, 2, 5, 2])
    before, asked = np.array([[1, 1, 1, 1, 3, 3, 2, 2, 2, 2], [4, 4, 1, 1, 3, 3, 2, 2, 2, 2]])
    found = without_crumbs(MirroredChange(graph, graph, NO_TWIN, before, asked, both))
    assert found.tolist() == [*both[:9], last]


def test_two_faces_with_one_image_both_change_with_it():
    """Faces 2 and 3 have face 0 as their image, which has but one of them."""
    before, after = np.array([[1, 1, 2, 2, 2], [5, 1, 2, 2, 2]])
    found = on_both_sides(before, after, np.array([2, 4, 0, 0, 1]), {1: 2, 2: 1}, lambda: 6)
    assert found.tolist() == [5, 1, 6, 6, 2]


ROW = np.array([1] * 8 + [2] * 8)  # two rows of faces, which are no neighbors; the second one is the image of the first
CUT = np.array([4] * 4 + [1] * 4 + [2] * 8)


def gathered_row(image, twin, before=ROW, asked=CUT, area=None):
    """What ``gathered`` gives, in whichever order the faces are numbered. twin, image : of the second row."""
    row, twin = np.arange(16), np.append(np.arange(8, 16), twin)
    pairs = np.delete(np.stack([row[:-1], row[1:]], axis=1), 7, axis=0)
    area, both = np.ones(16) if area is None else np.array(area), np.array([*asked[:8], *image])
    found = []
    for order in (row, row[::-1]):
        graph = FaceGraph(16, order[pairs], np.ones(14), area[order])
        twins = np.where(twin >= 0, order[twin], -1)[order]
        change = MirroredChange(graph, graph, twins, before[order], asked[order], both[order])
        found.append(gathered(change)[order].tolist())
    assert found[0] == found[1]
    return found[0]


@pytest.mark.parametrize(("twin", "expected"), [
    ([0, 1, 2, 3, 4, 5, 6, 7], [5, 5, 5, 5, 2, 2, 2, 2]),
    ([0, 1, 2, 5, 4, 3, 6, 7], [5, 5, 5, 2, 2, 2, 2, 2]),  # a crumb apart
    ([0, 5, 1, 2, 3, 6, 6, 7], [5, 5, 5, 5, 5, 2, 2, 2]),  # and one that is left
    ([0, 1, 4, 2, 5, 3, 6, 7], [5, 5, 2, 2, 2, 2, 2, 2]),  # half of it in one: that is enough
    ([4, 0, 5, 1, 6, 2, 7, 3], [2, 2, 2, 2, 2, 2, 2, 2])])  # scattered: none
def test_an_image_is_in_as_many_regions_as_the_change(twin, expected):
    image = [5 if face < 4 else 2 for face in twin]
    assert gathered_row(image, twin) == [*CUT[:8], *expected]


def test_what_is_left_over_and_goes_along_is_no_loss_of_the_image():
    """All 4 faces of the image stay: that the 2.5 between them come to it is no reason to leave it."""
    area = [1.0] * 9 + [2.5] + [1.0] * 3 + [2.0] * 3
    assert gathered_row([5, 2, 5, 5, 5, 2, 2, 2], [0, 5, 1, 2, 3, 6, 6, 7], area=area) == [*CUT[:8], *[5] * 5, 2, 2, 2]


def test_the_largest_image_stays():
    """Two faces, of which one is the image of the first face, against one of 1.5."""
    area = [1.0] * 11 + [1.5] + [1.0] * 4
    assert gathered_row([5, 5, 2, 5, 2, 2, 2, 2], [0, 1, 4, 2, 5, 5, 6, 7], area=area) == [*CUT[:8], 5, 5, *[2] * 6]


def test_the_largest_that_is_left_stays_also_if_it_is_no_image():
    """Three faces before the image have no twins; the two behind it are what is left of the image of the part."""
    assert gathered_row([2, 2, 2, 5, 5, 5, 2, 2], [-1, -1, -1, 0, 1, 2, 6, 7]) == [*CUT[:8], 2, 2, 2, 5, 5, 5, 2, 2]


def test_an_image_of_faces_of_two_parts_is_one_region():
    """The new part is of parts 1 and 3, its image of 2 and 6; a face of this that lies apart goes back to 6."""
    before = np.array([1, 1, 1, 1, 3, 3, 3, 3, 2, 2, 2, 2, 6, 6, 6, 6])
    asked = np.array([1, 4, 4, 4, 4, 3, 3, 3, *before[8:]])
    found = gathered_row([2, 5, 5, 5, 5, 6, 5, 6], [0, 1, 2, 3, 4, 5, 4, 7], before, asked)
    assert found == [*asked[:8], 2, 5, 5, 5, 5, 6, 6, 6]


def test_the_largest_that_an_image_leaves_stays_where_others_touch_each_other():
    """Of three arms of 3, 2 and 2 faces around the image, the two touch: together they are more, but neither is."""
    middle, rest = np.arange(4), np.arange(4, 11)  # of part 1, and of its image, 11 further on
    row = [(a, a + 1) for a in range(10)]
    arms = [(0, 1), (1, 2), (2, 3), (0, 4), (4, 5), (5, 6), (1, 7), (7, 8), (3, 9), (9, 10)]
    graph = FaceGraph(
        22, np.array([*row, *(np.array(arms) + 11).tolist()]), np.ones(20), np.ones(22))
    before, asked = np.repeat([1, 2], 11), np.repeat([1, 2], 11)
    asked[middle] = 4
    both = asked.copy()
    both[middle + 11] = 5
    twin = np.append(np.arange(11, 22), np.arange(11))
    touching = graph.with_contacts(np.array([[8, 10]]) + 11)
    found = gathered(MirroredChange(graph, touching, twin, before, asked, both))
    assert found[11:].tolist() == [5, 5, 5, 5, 2, 2, 2, 5, 5, 5, 5]
    assert found[rest].tolist() == [1] * 7


@pytest.mark.parametrize(("contacts", "last"), [([[7, 9]], 2), ([], 6)])
def test_what_touches_its_part_is_no_crumb(contacts, last):
    """The last face lies beside part 6, and belonged to part 2 before, which it touches: no image moved it."""
    graph = path(10, areas=[*[1.0] * 9, 0.01])
    before = np.array([1, 1, 1, 1, 3, 3, 2, 2, 6, 2])
    asked, both = before.copy(), before.copy()
    asked[0] = both[0] = 4
    both[6] = 5
    twin = np.array([6, 7, -1, -1, -1, -1, 0, 1, -1, -1])
    contacts = np.array(contacts, np.int64).reshape(-1, 2)
    found = cleaned(MirroredChange(graph, graph.with_contacts(contacts), twin, before, asked, both))
    assert found.tolist() == [4, 1, 1, 1, 3, 3, 5, 2, 6, last]
