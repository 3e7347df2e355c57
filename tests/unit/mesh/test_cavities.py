# SPDX-License-Identifier: GPL-3.0-or-later
"""Cavities: the inner walls of hollow bodies have the parts of the outer ones."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.copies import find_copies
from core.mesh.polygons import PolygonMesh

BALL = shapes.icosphere(3)
DIAMETER = 2 * 3**0.5  # of the box around the ball


def dumbbell(scale=1.0, top=2.0):
    """A body of revolution with two balls: its radius so many times as large; up to a height."""
    height = np.linspace(-2.0, 2.0, 60)
    radius = 0.25 + 0.75 * np.clip(1 - ((np.abs(height) - 1.2) / 0.8) ** 2, 0, 1) ** 0.5
    radius[[0, -1]] = 0.0
    some = height <= top
    radius[np.flatnonzero(some)[-1]] = 0.0
    return shapes.lathe(scale * radius[some], height[some] * (1 - 0.05 * (1 - scale)), 24)


def hollowed(*walls, outer=BALL):
    """How many faces of bodies with some inner walls, which have other faces than these, are those of cavities."""
    copies = find_copies(PolygonMesh.of(*shapes.together(outer, *map(shapes.inside_out, walls))))
    return 0 if copies is None else copies.n_copies


@pytest.mark.parametrize("inner", [dumbbell(0.9), shapes.subdivide(dumbbell(0.9))], ids=["like", "finer"])
def test_a_hollow_body_has_the_parts_of_the_body(inner):
    """Prints with walls of a fiftieth of their diameter lost up to half of their parts."""
    outer = dumbbell()
    alone = decompose(*outer)
    result = decompose(*shapes.together(outer, shapes.inside_out(inner)))
    labels, expected = result.parts(n_parts=3).labels, alone.parts(n_parts=3).labels
    assert len(np.unique(np.stack([expected, labels[:len(outer.faces)]]), axis=1).T) == 3 == labels.max() + 1
    # The walls of a ball are one part, up to the first row of faces beside a cut.
    end = np.abs(inner.vertices[inner.faces][:, :, 2].mean(axis=1)) > 1.0
    upper = inner.vertices[inner.faces][:, :, 2].mean(axis=1) > 0
    for side in (upper, ~upper):
        assert len(np.unique(labels[len(outer.faces):][end & side])) == 1
    assert len(np.unique(labels[len(outer.faces):][end])) == 2


def test_what_is_small_in_a_hollow_body_is_part_of_the_cavity():
    bubble = shapes.inside_out(shapes.moved(shapes.icosphere(0, 0.03), (0.0, 0.0, 0.97)))
    ball, inner = shapes.icosphere(3), shapes.inside_out(shapes.icosphere(2, 0.93))
    copies = find_copies(PolygonMesh.of(*shapes.together(ball, inner, bubble)))
    assert copies.n_copies == len(inner.faces) + len(bubble.faces)
    assert find_copies(PolygonMesh.of(*shapes.together(ball, bubble))) is None
    # A screw looks outwards, and a bubble in a body that is not hollow is in no cavity.
    screw, other = shapes.icosphere(0, 0.05), shapes.moved(BALL, (9.0, 0.0, 0.0))
    its_bubble = shapes.moved(bubble, (9.0, 0.0, 0.0))
    copies = find_copies(PolygonMesh.of(*shapes.together(ball, inner, screw, other, its_bubble)))
    assert copies.n_copies == len(inner.faces)


def test_a_large_hollow_beside_a_cavity_is_none():
    """In one half of a dumbbell a wall, in the other one a hollow of half the diameter."""
    wall, deep = dumbbell(0.9, -0.2), shapes.moved(shapes.icosphere(2, 0.4), (0.0, 0.0, 1.2))
    assert hollowed(wall, deep, outer=dumbbell()) == len(wall.faces)


def test_no_cavity_is_what_looks_outwards_is_open_or_lies_deep_within():
    ball, inner = shapes.icosphere(3), shapes.icosphere(2, 0.93)
    inside_out = shapes.inside_out(inner)
    for other in (inner, shapes.Shape(inside_out.vertices, inside_out.faces[1:]),
                  shapes.inside_out(shapes.icosphere(2, 0.5)), shapes.moved(inside_out, (0.5, 0.0, 0.0))):
        assert find_copies(PolygonMesh.of(*shapes.together(ball, other))) is None


@pytest.mark.parametrize(("share", "found"), [(0.012, True), (0.0095, False)])
def test_a_wall_of_a_hundredth_of_the_area_is_a_cavity(share, found):
    """Beside a large ball. Walls of a thirtieth of a diameter, so that the outer one has more than a hundredth."""
    wall = shapes.icosphere(2, 0.93)
    areas = [PolygonMesh.of(*shape).triangles.area for shape in (wall, BALL)]
    radius = np.sqrt((areas[0] / share - sum(areas)) / areas[1])
    beside = shapes.moved(shapes.icosphere(3, radius), (radius + 2.0, 0.0, 0.0))
    assert hollowed(wall, outer=shapes.together(BALL, beside)) == found * len(wall.faces)


def test_beside_larger_cavities_a_wall_of_less_is_none():
    """It has 0.8 hundredths of the area, and the body around it 1.1; the other body is hollow, too."""
    wall, large = shapes.icosphere(2, 0.86), shapes.icosphere(2, 0.9)
    size = np.sqrt(48.0)
    other, its_wall = (shapes.moved(shapes.Shape(size * shape.vertices, shape.faces), (10.0, 0.0, 0.0))
                       for shape in (BALL, large))
    assert hollowed(wall, its_wall, outer=shapes.together(BALL, other)) == len(its_wall.faces)


@pytest.mark.parametrize(("height", "found"), [(0.25, True), (-0.05, False)])
def test_seven_tenths_of_a_wall_run_along(height, found):
    """A wall that is cut off by a plane, the disc in which lies deep within: it runs along by 0.73, or by 0.66."""
    around = np.linspace(0, np.arccos(-height), 30)
    radius = np.append(np.sin(around), np.linspace(np.sin(around[-1]), 0, 12)[1:])
    wall = shapes.lathe(0.9 * radius, 0.9 * np.append(-np.cos(around), np.full(11, height)), 40)
    assert hollowed(wall) == found * len(wall.faces)


@pytest.mark.parametrize(("radius", "found"), [(1 - 0.045 * DIAMETER, True), (1 - 0.055 * DIAMETER, False)])
def test_walls_are_a_twentieth_of_the_diameter_thick_at_most(radius, found):
    wall = shapes.icosphere(2, radius)
    assert hollowed(wall) == found * len(wall.faces)


@pytest.mark.parametrize(("angle", "found"), [(55, True), (65, False)])
def test_walls_look_the_other_way_but_for_sixty_degrees(angle, found):
    """A wall in folds, whose sides are turned by so much from the ball around it."""
    around = np.linspace(0, np.pi, 41)
    radius = 0.9 * (1 + np.tan(np.radians(angle)) * around[1] * (np.arange(41) % 2 - 0.5))
    wall = shapes.lathe(radius * np.sin(around), -radius * np.cos(around), 24)
    assert hollowed(wall) == found * len(wall.faces)


@pytest.mark.parametrize(("beyond", "found"), [(0.0008, True), (0.0012, False)])
def test_a_wall_reaches_out_of_the_body_by_rounding_only(beyond, found):
    wall = shapes.moved(shapes.icosphere(2, 0.99), (0.01 + beyond * DIAMETER, 0.0, 0.0))
    assert hollowed(wall) == found * len(wall.faces)


def test_what_is_open_or_a_cavity_itself_has_none():
    wall, within = shapes.icosphere(2, 0.95), shapes.icosphere(2, 0.92)
    assert hollowed(wall, outer=shapes.Shape(BALL.vertices, BALL.faces[1:])) == 0
    # Both run along the ball: the inner one not along the other, which looks the same way.
    assert hollowed(wall, within) == len(wall.faces) + len(within.faces)
    assert hollowed(BALL, outer=wall) == 0


def test_of_bodies_within_each_other_a_wall_is_that_of_the_smallest_around():
    inner = shapes.icosphere(3, 0.6)
    wall = shapes.icosphere(2, 0.56)
    copies = find_copies(PolygonMesh.of(*shapes.together(BALL, inner, shapes.inside_out(wall))))
    assert copies.n_copies == len(wall.faces)
    below = copies.polygon[copies.original[copies.is_copy]]
    assert ((below >= len(BALL.faces)) & (below < len(BALL.faces) + len(inner.faces))).all()


def test_each_polygon_of_a_wall_has_the_part_of_the_large_one_before_it():
    """In a bar of 12 triangles; near its ends the middle of the end is nearer than that of the side."""
    outer = shapes.box((4.0, 1.0, 1.0))
    wall = shapes.moved(shapes.subdivide(shapes.subdivide(shapes.subdivide(shapes.box((3.9, 0.9, 0.9))))), [0.05] * 3)
    ball = shapes.Shape(7 * BALL.vertices + (20, 0, 0), BALL.faces)  # has thirty times the area
    its_wall = shapes.moved(shapes.icosphere(2, 6.6), (20, 0, 0))
    given = PolygonMesh.of(*shapes.together(outer, ball, *map(shapes.inside_out, (wall, its_wall))))
    copies, normal, n_walls = find_copies(given), given.triangles.face_normals, len(wall.faces)
    kept = 12 + len(BALL.faces)
    assert copies.polygon.tolist() == list(range(kept))
    below = copies.original[kept:kept + n_walls]
    np.testing.assert_allclose(normal[kept:kept + n_walls], -normal[below], atol=1e-9)


def test_a_rod_through_a_hollow_body_is_not_what_its_wall_lies_in():
    """The box around it is the smallest that holds the wall; it has 0.3 hundredths of the area."""
    wall = shapes.icosphere(2, 0.93)
    along = np.array([[1, 1, 1], [1, -1, 0], [1, 1, -2]]) / np.sqrt([[3], [2], [6]])
    rod = shapes.moved(shapes.box((1.94 * 3**0.5, 0.005, 0.005)), (-0.97 * 3**0.5, 0, 0))
    assert hollowed(wall, outer=shapes.together(BALL, shapes.Shape(rod.vertices @ along, rod.faces))) == len(wall.faces)


def test_a_wall_of_which_four_faces_meet_at_an_edge_is_not_closed():
    wall = shapes.icosphere(2, 0.93)
    a, b, c = wall.faces[0]
    n, middle = len(wall.vertices), 0.98 * wall.vertices[[a, b, c]].mean(axis=0)
    added = [(a, b, n), (b, a, n + 1), (a, n, n + 1), (n, b, n + 1)]
    points = np.vstack([wall.vertices, [middle, 0.99 * middle]])
    assert hollowed(shapes.Shape(points, np.vstack([wall.faces, added]))) == 0
