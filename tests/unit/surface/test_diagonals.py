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
        faces = divided_by_shape(mesh, np.zeros(2, np.int64)).faces
        assert all({0, 2} <= set(triangle) for triangle in faces.tolist())


def test_what_is_no_convex_quadrilateral_stays():
    arrow = np.array([(0.0, 0, 0), (2, 1, 0), (0.5, 0, 0), (2, -1, 0)])
    twice = np.concatenate([arrow, arrow + (5, 0, 1)])
    faces = [[2, 3, 0, 1], [6, 7, 4, 5], [0, 1, 5, 4], [3, 7, 4, 0]]
    given, _ = sorted_by_place(PolygonMesh.of(twice, faces))
    area = np.bincount(given.polygon, given.triangles.face_area)
    np.testing.assert_allclose(np.sort(area)[:2], 0.5)  # of the arrows, not more


def test_triangles_stay_the_arrays_that_they_are():
    given = PolygonMesh.of(*shapes.octahedron())
    assert divided_by_shape(given.triangles, given.polygon) is given.triangles


def test_a_mirror_image_and_other_first_corners_have_the_same_parts():
    vertices, faces = wavy(shapes.cross_of_blocks(5, 3))
    one = decompose(vertices, faces)
    turn = np.random.default_rng(4).integers(4, size=len(faces))
    for other in (mirrored(vertices, faces),
                  (vertices, np.take_along_axis(faces, (turn[:, None] + np.arange(4)) % 4, axis=1))):
        two = decompose(*other)
        np.testing.assert_array_equal(one.candidates, two.candidates)
        np.testing.assert_array_equal(one.hierarchy.merges, two.hierarchy.merges)
