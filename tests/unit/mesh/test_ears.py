# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons that are not convex are covered once by their triangles, whichever corner comes first."""

import numpy as np
import pytest
import shapes
from folding import LETTER_H, bumps, extruded

from core.arrays.vectors import cross, lengths
from core.mesh.ears import fans, triangulated, without_folds
from core.mesh.polygons import PolygonMesh

ARROW = [(0, 0), (2, 3), (0, 1.2), (-2, 3)]
#: A square with a hole, tied to the outside along an edge that is there twice; two corners there are one point.
KEYHOLE = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]
#: An L with corners in the middle of its sides.
STRAIGHT = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 1)]
#: From its inner corner a fan covers it once, from others not.
LETTER_L = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 4), (0, 4)]
#: A gear of nine teeth.
GEAR = [(radius * np.cos(at), radius * np.sin(at)) for tooth in range(9)
        for radius, at in zip((1, 1.25, 1.25, 1), 2 * np.pi * (tooth + np.arange(4) / 4) / 9, strict=True)]


def test_fans_begin_at_the_first_corner():
    triangles, polygon = fans(np.array([7, 5, 3, 1, 9, 8, 6, 4]), np.array([5, 3]))
    assert triangles.tolist() == [[7, 5, 3], [7, 3, 1], [7, 1, 9], [8, 6, 4]]
    assert polygon.tolist() == [0, 0, 0, 1]
    nothing = fans(np.empty(0, np.int64), np.empty(0, np.int64))
    assert [array.shape for array in nothing] == [(0, 3), (0,)]


def outline(corners, first=0):
    return np.roll(np.array(corners, float), -first, axis=0)


def signed_areas(points, triangles):
    """Twice the area of triangles in the plane."""
    a, b, c = (points[column] for column in triangles.T)
    return np.cross(np.c_[b - a, np.zeros(len(a))], np.c_[c - a, np.zeros(len(a))])[:, 2]


def cut(points, turn=None):
    """Triangles of one polygon, which is turned in space; three more faces make a mesh of it."""
    n = len(points)
    space = np.c_[points, np.zeros(n)] @ (np.eye(3) if turn is None else turn)
    vertices = np.vstack([space, 9 * np.eye(3) + 20])
    mesh = PolygonMesh.of(vertices, [list(range(n)), *[[n, n + 1, n + 2]] * 3])
    return mesh.triangles.faces[mesh.polygon == 0]


@pytest.mark.parametrize("first", range(10))
@pytest.mark.parametrize("corners", [ARROW, LETTER_H, KEYHOLE, STRAIGHT])
def test_concave_polygons_are_covered_once(corners, first):
    points = outline(corners, first)
    triangles = cut(points, shapes.rotation(np.random.default_rng(first)))
    areas = signed_areas(points, triangles)
    x, y = points.T
    area = x @ np.roll(y, -1) - y @ np.roll(x, -1)
    assert len(triangles) == len(points) - 2
    assert (areas * np.sign(area) > -1e-9).all()
    assert areas.sum() == pytest.approx(area)


@pytest.mark.parametrize("seed", range(5))
def test_stars_are_covered_once(seed):
    rng = np.random.default_rng(seed)
    k = int(rng.integers(4, 60))
    angle, reach = 2 * np.pi * (np.arange(k) + 0.9 * rng.random(k)) / k, 0.1 + rng.random(k)
    points = np.stack([reach * np.cos(angle), reach * np.sin(angle)], axis=1)
    areas = signed_areas(points, cut(points, shapes.rotation(rng)))
    x, y = points.T
    assert areas.min() > -1e-9
    assert areas.sum() == pytest.approx(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_a_concave_quad_is_cut_along_the_other_diagonal():
    for first in range(4):
        corners = [(first + i) % 4 for i in range(4)]
        triangles = cut(outline(ARROW, first))
        # Both triangles have the notch, which is corner 2, and the tip, corner 0.
        assert all({0, 2} <= {corners[corner] for corner in triangle} for triangle in triangles.tolist())


@pytest.mark.parametrize("corners", [
    [(0, 0), (3, 3), (3, 0), (0, 1)],  # crosses itself, one half larger
    [(0, 0), (1, 1), (1, 0), (0, 1)],  # of no area
    [(0, 0), (2, 0), (2, 0), (2, 2), (2, 2), (0, 0)],  # corners there twice
    [(0, 0), (4, 0), (2, 0), (3, 0)],  # on a line
    [(np.cos(2.4 * i * np.pi / 3), np.sin(2.4 * i * np.pi / 3)) for i in range(5)],
    [(1, 1)] * 6,
])
def test_degenerate_polygons_have_as_many_triangles_as_a_fan(corners):
    assert cut(outline(corners)).shape == (len(corners) - 2, 3)


@pytest.mark.parametrize("seed", range(40))
def test_whatever_polygons_there_are_their_corners_stay(seed):
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(1, 30)), int(rng.integers(4, 13))
    vertices = rng.integers(0, 2 + seed % 4, (n * k, 3)).astype(float)  # many at one place, on a line, crossing
    vertices[:, 2] *= seed % 2
    vertices = vertices @ shapes.rotation(rng)
    fans = np.stack([np.zeros(k - 2, int), np.arange(1, k - 1), np.arange(2, k)], 1) + k * np.arange(n)[:, None, None]
    with np.errstate(all="raise", under="ignore"):
        triangles = without_folds(vertices, fans.reshape(-1, 3), np.full(n, k)).reshape(n, -1)
    for polygon, row in enumerate(triangles):
        assert set(row.tolist()) == set(range(k * polygon, k * polygon + k))


def test_the_shortest_cut_comes_first():
    """An L, with its inner corner at (1, 1), to which all three cuts lead: of lengths sqrt(2), twice, and sqrt(5)."""
    corners = np.array([(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 3, 0), (0, 3, 0)], float)
    fan = np.array([2, 3, 4, 5, 0, 1])  # from there, one triangle lies outside
    found, _ = triangulated(corners, fan, np.array([6]))
    sides = np.sort(np.stack([found, np.roll(found, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    cuts, count = np.unique(sides, axis=0, return_counts=True)
    assert cuts[count == 2].tolist() == [[0, 3], [1, 3], [3, 5]]


def test_polygons_that_cross_themselves_keep_their_fans():
    assert cut(outline([(0, 0), (3, 3), (3, 0), (0, 1)])).tolist() == [[0, 1, 2], [0, 2, 3]]


@pytest.mark.parametrize("corners", [LETTER_L, STRAIGHT[:-1], [(0, 0), (4, 0), (4, 3), (2, 2.9), (0, 3.5)]])
def test_the_first_corner_of_a_concave_polygon_decides_nothing(corners):
    """Its fan stayed if it happened not to be folded."""
    n, found = len(corners), set()
    for first in range(n):
        number = np.roll(np.arange(n), -first)
        found.add(frozenset(map(frozenset, number[cut(outline(corners, first))].tolist())))
    assert len(found) == 1


def test_convex_polygons_keep_their_fans_also_when_corners_are_off_by_rounding():
    angle = 2 * np.pi * np.arange(40) / 40
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    midpoints = (circle + np.roll(circle, -1, axis=0)) / 2
    points = np.stack([circle, midpoints], axis=1).reshape(-1, 2).astype(np.float32).astype(np.float64)
    assert cut(points).tolist() == [[0, i, i + 1] for i in range(1, 79)]


def test_some_concave_polygons_among_others_leave_these_as_they_are():
    vertices, faces = extruded(LETTER_H, 2)
    mesh = PolygonMesh.of(vertices, faces)
    sides = mesh.polygon >= 2
    assert mesh.triangles.faces[sides].tolist() == [
        triangle for a, b, c, d in faces[2:] for triangle in ([a, b, c], [a, c, d])]
    normal = cross(*(np.diff(vertices[mesh.triangles.faces], axis=1)).transpose(1, 0, 2))
    assert lengths(normal)[~sides].sum() / 2 == pytest.approx(2 * 12)


@pytest.mark.parametrize("seed", range(5))
def test_the_numbers_of_vertices_decide_nothing(seed):
    """Of the two ears of a folded quad, which have one diagonal, that of the lowest number was clipped first."""
    vertices, quads = bumps()
    one = PolygonMesh.of(vertices, quads).triangles
    number = np.random.default_rng(seed).permutation(len(vertices))
    two = PolygonMesh.of(vertices[number], np.argsort(number)[quads]).triangles
    np.testing.assert_array_equal(one.vertices[one.faces], two.vertices[two.faces])
    fan, _ = fans(quads.ravel(), np.full(len(quads), 4))
    assert (one.faces != fan).any(axis=1).sum() > 50


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("corners", [LETTER_H, GEAR])
def test_the_pose_decides_nothing(corners, seed):
    """Of ears that are equally good, and for corners in line with a cut, the rounding of the pose decided."""
    rng = np.random.default_rng(seed)
    flat = np.append(np.asarray(corners, float), np.zeros((len(corners), 1)), axis=1)
    once = [triangulated(vertices, np.arange(len(flat)), np.array([len(flat)]))[0]
            for vertices in (flat, flat @ shapes.rotation(rng).T + rng.normal(size=3))]
    np.testing.assert_array_equal(*once)


def test_polygons_of_thousands_of_corners_keep_their_fans():
    """A star of 3,000 rays, of which ears would be clipped for seconds."""
    angle = np.linspace(0, 2 * np.pi, 6_000, endpoint=False)
    radius = np.where(np.arange(6_000) % 2, 1.0, 0.5)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)
    fan = np.stack([np.zeros(5_998, np.int64), np.arange(1, 5_999), np.arange(2, 6_000)], axis=1)
    assert without_folds(points, fan, np.array([6_000])) is fan
