# SPDX-License-Identifier: GPL-3.0-or-later
"""What counts as a ground, bound by bound; what becomes of those that do is in tests/unit/whole/test_grounds.py."""

import numpy as np
import pytest
import shapes
from floors import collider, column, has_ground, hills, sheet, tree

from core.mesh.grounds import grounds_among
from core.mesh.polygons import PolygonMesh

BOX = shapes.box((1, 1, 1))


def of_size(shape, area):
    """A shape at the origin, of an area."""
    own = PolygonMesh.of(*shape).triangles.area
    return shapes.Shape(np.sqrt(area / own) * shape.vertices, shape.faces)


@pytest.mark.parametrize(("share", "found"), [(0.205, True), (0.195, False)])
def test_a_ground_has_a_fifth_of_the_area(share, found):
    """A floor of 36 under a column 1 wide, whose area is 2 and 4 times its height."""
    assert has_ground(sheet(6), column((36 / share - 38) / 4, 0)) == found


@pytest.mark.parametrize(("share", "found"), [(1.1e-6, True), (0.9e-6, False)])
def test_what_stands_there_has_a_millionth_of_it(share, found):
    assert has_ground(sheet(np.sqrt(6 / share)), shapes.subdivide(BOX)) == found


@pytest.mark.parametrize(("width", "found"), [(1.75, True), (1.71, False)])
def test_a_ground_is_three_times_as_large(width, found):
    """Squares of 3.06 and 2.92 under a square of 1."""
    assert has_ground(sheet(width), BOX) == found


def band(half_turn):
    """A wall around the z-axis, 5 from it and 12 high: so many degrees to either side of the x-axis."""
    vertices, faces = shapes.cylinder(3, 360, 5.0, 12.0)
    x, y, z = vertices[faces].mean(axis=1).T
    return shapes.Shape(vertices, faces[(np.abs(np.degrees(np.arctan2(y, x))) < half_turn) & (z > 0) & (z < 12)])


INSIDE = shapes.moved(BOX, (3.0, -0.5, 6.0))


@pytest.mark.parametrize(("more", "found"), [(0, True), (-1, False)])
def test_a_ground_of_any_shape_has_a_twentieth_of_the_faces(more, found):
    """A wall that goes round most of what is in it, which no direction shows whole."""
    wall = band(140)
    vertices, faces = INSIDE
    for _ in range(6):
        vertices, faces = shapes.subdivide(shapes.Shape(vertices, faces))
    thing = shapes.Shape(vertices, faces[:19 * len(wall.faces) + more])
    assert len(thing.faces) == 19 * len(wall.faces) + more
    assert has_ground(wall, thing) == found


@pytest.mark.parametrize(("half_turn", "found"), [(94, True), (95, False)])
def test_two_hundredths_of_a_relief_may_be_turned_away(half_turn, found):
    """By more than a cosine of 0.05, which is three degrees: 1 of 94, and 2 of 95 degrees."""
    assert has_ground(band(half_turn), INSIDE) == found


@pytest.mark.parametrize(("share", "found"), [(0.0021, True), (0.0019, False)])
def test_what_stands_on_a_relief_has_two_thousandths_of_its_area(share, found):
    floor = hills(15)
    assert has_ground(floor, of_size(BOX, share * PolygonMesh.of(*floor).triangles.area)) == found


@pytest.mark.parametrize(("depth", "found"), [(3.5, True), (3.75, False)])
def test_a_slab_is_four_tenths_as_deep_as_wide(depth, found):
    """Under a column that is higher than the slab is wide; of 12 triangles, whose corners do not weigh alike."""
    assert has_ground(sheet(10, depth=depth), column(33, 0)) == found


@pytest.mark.parametrize(("depth", "found"), [(0.29, True), (0.32, False)])
def test_a_slab_of_many_faces_is_a_sheet(depth, found):
    """Under what has a 64th of its faces: it has to be flatter by far."""
    slab = sheet(10, depth=depth)
    for _ in range(3):
        slab = shapes.subdivide(slab)
    assert has_ground(slab, shapes.box((1, 1, 33))) == found


@pytest.mark.parametrize(("height", "found"), [(0.11, True), (0.09, False)])
def test_what_stands_there_is_a_tenth_as_high_as_wide(height, found):
    floor = shapes.Shape(sheet(6, 12).vertices * (1.0, 1.5, 1.0), sheet(6, 12).faces)  # a square has no axes of its own
    assert has_ground(floor, shapes.box((1, 1, height))) == found


@pytest.mark.parametrize(("side", "found"), [(0.22, True), (0.24, False)])
def test_a_twentieth_of_it_may_be_below(side, found):
    """A box of side 1 above and a smaller one below, of 0.046 and 0.054 of the area of both."""
    below = shapes.moved(shapes.box((side, side, side)), (0.3, 0.3, -0.5))
    assert has_ground(sheet(6), shapes.moved(BOX, (-0.5, -0.5, 0.1)), below) == found


@pytest.mark.parametrize(("beyond", "found"), [(0.0008, True), (0.0012, False)])
def test_what_is_in_a_shell_reaches_out_of_it_by_rounding_only(beyond, found):
    """Out of the bottom of a box around the tree that is little larger than the tree."""
    vertices = collider().vertices
    low, high = vertices.min(axis=0) - 0.05, vertices.max(axis=0) + 0.05
    low[2] = beyond * np.linalg.norm(high - low)
    assert has_ground(shapes.moved(shapes.box(high - low), low), tree()) == found


def dented(size, depth):
    """A box along the axes, the middle of its top pressed in."""
    vertices, faces = shapes.box((size, size, size))
    top = (vertices[faces][..., 2] == size).all(axis=1)
    rim = [int(np.flatnonzero((vertices == corner).all(axis=1))[0]) for corner in size * np.array(
        [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])]
    fan = [(a, b, len(vertices)) for a, b in zip(rim, [*rim[1:], rim[0]], strict=True)]
    return shapes.Shape(np.vstack([vertices, [(size / 2, size / 2, size - depth)]]), np.vstack([faces[~top], fan]))


PLATES = [shapes.box((1, 1, 0.02)), shapes.moved(shapes.box((1, 1, 0.02)), (3, 3, 0))]  # 0.01 deeper than their tops


@pytest.mark.parametrize(("pressed", "found"), [(2.4, True), (2.6, False)])
def test_the_area_of_a_shell_is_that_of_its_hull_but_for_two_hundredths(pressed, found):
    """A top of 100 of 600 is pressed in: it has 20 times the root of 25 and the square of that, 11 or 13 more."""
    plates = [shapes.moved(plate, (2, 2, 4)) for plate in PLATES]
    assert has_ground(dented(10, pressed), *plates) == found


@pytest.mark.parametrize(("depth", "found"), [(0.17, True), (0.155, False)])
def test_what_is_in_a_shell_is_a_hundredth_of_its_diameter_deep(depth, found):
    """0.18 or 0.165, where it has to be 0.173: a hundredth of the diagonal of a cube of 10."""
    plates = [shapes.moved(plate, (3, 3, 10 - 0.02 - depth)) for plate in PLATES]
    assert has_ground(shapes.box((10, 10, 10)), *plates) == found


@pytest.mark.parametrize(("pressed", "found"), [(0.07, True), (0.05, False)])
def test_what_is_in_a_shell_has_less_than_98_hundredths_of_its_own_hull(pressed, found):
    """A cube of which a third of what it is pressed in is missing: else the shell is the outer wall of a box."""
    assert has_ground(shapes.box((10, 10, 10)), shapes.moved(dented(1, pressed), (4, 4, 4))) == found


@pytest.mark.parametrize(("divided", "found"), [(1, False), (2, True)])
def test_a_shell_has_no_more_faces_than_what_is_in_it(divided, found):
    """A ball of 320 faces around plates of 96 or 384."""
    plates = shapes.moved(shapes.together(*PLATES), (-2, -2, 0))
    for _ in range(divided):
        plates = shapes.subdivide(plates)
    assert has_ground(shapes.icosphere(2, 4.0), plates) == found


@pytest.mark.parametrize(("more", "found"), [(0, False), (1, True)])
def test_four_faces_stand_on_a_ground_at_least(more, found):
    assert has_ground(sheet(6), shapes.Shape(BOX.vertices, BOX.faces[[*range(3 + more)]])) == found


@pytest.mark.parametrize(("is_ground", "grounds"), [
    ([1, 1, 0, 0, 0], [True, False, False]), ([1, 1, 0, 0, 1], [True, False, True]),
    ([1, 1, 1, 0, 1], [True, False, True]), ([1, 0, 0, 0, 0], [False] * 3), ([1] * 5, [False] * 3)])
def test_grounds_are_parts_of_nothing_else_and_not_all_there_are(is_ground, grounds):
    assert grounds_among(np.array([0, 0, 1, 1, 2]), np.array(is_ground, bool)).tolist() == grounds
