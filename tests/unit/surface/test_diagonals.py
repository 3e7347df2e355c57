# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of polygons that do not depend on the file."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.surface.diagonals import divided_by_shape
from core.surface.ordering import sorted_by_place


def divided(vertices, faces):
    """Places of the corners of the triangles of each polygon, by the places of its corners."""
    given, ordering = sorted_by_place(PolygonMesh.of(vertices, faces))
    triangles = ordering.vertex[given.triangles.faces]
    polygon = ordering.polygon[given.polygon]
    return {frozenset(map(tuple, vertices[faces[face]].tolist())):
            [frozenset(map(tuple, vertices[triangle].tolist())) for triangle in triangles[polygon == face]]
            for face in range(len(faces))}


def mirrored(vertices, faces):
    return vertices * (-1, 1, 1), np.concatenate([faces[:, :1], faces[:, :0:-1]], axis=1)


def opposite(places):
    return frozenset((-x, y, z) for x, y, z in places)


def wavy(shape):
    vertices, faces = shape
    return vertices + 0.03 * np.sin(2 * vertices[:, [1, 2, 0]]), faces


@pytest.mark.parametrize("shape", [shapes.table_of_blocks(), wavy(shapes.cross_of_blocks(5, 3))], ids=["table", "wavy"])
def test_neither_the_first_corner_nor_a_mirror_image_changes_the_triangles(shape):
    vertices, faces = shape
    expected = divided(vertices, faces)
    turn = np.random.default_rng(4).integers(4, size=len(faces))
    other_corners = np.take_along_axis(faces, (turn[:, None] + np.arange(4)) % 4, axis=1)
    assert divided(vertices, other_corners) == expected
    assert {opposite(quad): list(map(opposite, two))
            for quad, two in divided(*mirrored(vertices, faces)).items()} == expected


def prism(n_sides, twist=0.0):
    """Two polygons of many corners, and quadrilaterals whose diagonals end equally far out."""
    angle = 2 * np.pi * np.arange(n_sides) / n_sides
    ring = (3 + twist * np.arange(n_sides))[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    vertices = np.concatenate([np.column_stack([ring, np.full(n_sides, z)]) for z in (-1.0, 1.0)])
    low = np.arange(n_sides)
    sides = np.stack([low, np.roll(low, -1), np.roll(low, -1) + n_sides, low + n_sides], axis=1)
    return vertices, [low[::-1].tolist(), (low + n_sides).tolist(), *sides.tolist()]


def divided_polygons(vertices, faces):
    """As ``divided``, of polygons of any size, each a set of triangles."""
    given, ordering = sorted_by_place(PolygonMesh.of(vertices, faces))
    triangles, polygon = ordering.vertex[given.triangles.faces], ordering.polygon[given.polygon]
    assert (np.bincount(polygon) == [len(face) - 2 for face in faces]).all()
    return [{frozenset(triangle) for triangle in triangles[polygon == face].tolist()} for face in range(len(faces))]


def upside_down(divided_faces, n):
    """What ``divided_polygons`` has of the mirror image of a prism of n sides, in the plane between its ends."""
    def image(one):
        return {frozenset((corner + n) % (2 * n) for corner in triangle) for triangle in one}
    return [image(divided_faces[1]), image(divided_faces[0]), *map(image, divided_faces[2:])]


@pytest.mark.parametrize(("n", "twist"), [(7, 0.1), (9, 0.02), (30, 0.001)])
def test_the_first_corner_of_no_polygon_changes_the_triangles(n, twist):
    """An extruded plate came in 14 parts or in 9, by the corner at which the quadrilaterals of its rim begin."""
    vertices, faces = prism(n, twist)
    rng, expected = np.random.default_rng(4), divided_polygons(vertices, faces)
    alike = expected, upside_down(expected, n)  # which end is first remains open: the shape is its own mirror image
    for _ in range(3):
        turned = [face[k:] + face[:k] for face, k in ((face, int(rng.integers(len(face)))) for face in faces)]
        assert divided_polygons(vertices, turned) in alike
    assert divided_polygons(vertices * (1, -1, 1), [face[::-1] for face in faces]) in alike


def test_polygons_cut_in_another_way_become_the_same_fans():
    vertices, faces = prism(8, 0.02)
    expected = divided_polygons(vertices, faces)
    ears = [[2, 1, 0], [2, 0, 7], [2, 7, 6], [2, 6, 5], [5, 4, 3], [5, 3, 2]]  # two fans
    cut = ears + [[corner + 8 for corner in ear[::-1]] for ear in ears]
    cut += [triangle for a, b, c, d in faces[2:] for triangle in ([b, c, d], [d, a, b])]
    given, ordering = sorted_by_place(PolygonMesh.of(vertices, cut, np.repeat(np.arange(10), [6, 6, *[2] * 8])))
    triangles, polygon = ordering.vertex[given.triangles.faces], ordering.polygon[given.polygon]
    found = [{frozenset(one) for one in triangles[polygon == face].tolist()} for face in range(10)]
    assert found in (expected, upside_down(expected, 8))


def test_diagonals_end_far_out_and_the_outer_triangle_comes_first():
    grid = np.arange(9).reshape(3, 3)
    faces = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-1).reshape(-1, 4)
    vertices = np.array([(x, 1.1 * y, 0.0) for x in (-1, 0, 1) for y in (-1, 0, 1)])
    for x, y in ((1, 1.1), (1, -1.1), (-1, 1.1), (-1, -1.1)):
        middle, out, beside, above = (0, 0, 0), (x, y, 0), (x, 0, 0), (0, y, 0)
        assert divided(vertices, faces)[frozenset([middle, beside, out, above])] == [
            {middle, out, above}, {middle, out, beside}]  # 1.1 from the middle, and 1


def test_of_diagonals_that_end_as_far_out_the_other_end_decides():
    """Two corners are equally far from the middle, one on each diagonal; of the others that of the first is farther."""
    vertices = np.array([(3, 2, 0), (-3, 2, 0), (-2, -2.5, 0), (2, -1.5, 0)])
    for first in range(4):
        face = (np.arange(4) + first) % 4
        mesh = TriMesh(vertices, [[face[0], face[1], face[2]], [face[0], face[2], face[3]]])
        faces = divided_by_shape(mesh, np.zeros(2, np.int64)).mesh.faces
        assert all({0, 2} <= set(triangle) for triangle in faces.tolist())


def test_what_is_no_convex_quadrilateral_stays():
    arrow = np.array([(0.0, 0, 0), (2, 1, 0), (0.5, 0, 0), (2, -1, 0)])
    twice = np.concatenate([arrow, arrow + (5, 0, 1)])
    faces = [[2, 3, 0, 1], [6, 7, 4, 5], [0, 1, 5, 4], [3, 7, 4, 0]]
    given, _ = sorted_by_place(PolygonMesh.of(twice, faces))
    area = np.bincount(given.polygon, given.triangles.face_area)
    np.testing.assert_allclose(np.sort(area)[:2], 0.5)  # of the arrows, not more


def test_a_star_that_crosses_itself_stays_one():
    """Its corners, in the order in which they go round, are those of a convex polygon."""
    angle = 4 * np.pi * np.arange(5) / 5
    vertices = np.append(np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1), [[0.0, 0.0, 5.0]], axis=0)
    faces = [[0, 1, 2, 3, 4], [0, 1, 5], [1, 2, 5], [2, 3, 5]]
    given = PolygonMesh.of(vertices, faces)
    triangles = sorted_by_place(given)[0].triangles
    assert triangles.area == pytest.approx(given.triangles.area, rel=1e-12)


def test_triangles_stay_the_arrays_that_they_are():
    given = PolygonMesh.of(*shapes.octahedron())
    assert divided_by_shape(given.triangles, given.polygon).mesh is given.triangles


def test_a_mirror_image_and_other_first_corners_have_the_same_parts():
    vertices, faces = wavy(shapes.cross_of_blocks(5, 3))
    one = decompose(vertices, faces)
    turn = np.random.default_rng(4).integers(4, size=len(faces))
    for other in (mirrored(vertices, faces),
                  (vertices, np.take_along_axis(faces, (turn[:, None] + np.arange(4)) % 4, axis=1))):
        two = decompose(*other)
        np.testing.assert_array_equal(one.candidates, two.candidates)
        np.testing.assert_array_equal(one.hierarchy.merges, two.hierarchy.merges)
