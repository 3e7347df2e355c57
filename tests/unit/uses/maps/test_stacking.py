# SPDX-License-Identifier: GPL-3.0-or-later
"""Mirror images of corners, found where meshes are exact images and only there; corners of faces on other faces."""

import numpy as np
import pytest
import shapes

from core.mesh.corners import CornerTable, next_of_owner
from core.symmetry.plane import MirrorPlane
from core.uses.maps.stacking import double_corners, image_corners

ACROSS = MirrorPlane(np.array([1.0, 0.0, 0.0]), 2.0)


def pair():
    """A ball, and behind the plane x = 2 its image with turned faces in another order of corners and faces."""
    vertices, faces = shapes.icosphere(1)
    order = np.random.default_rng(0).permutation(len(faces))
    other = np.roll(faces[order][:, ::-1], 1, axis=1) + len(vertices)
    twin = np.concatenate([len(faces) + np.argsort(order), order])
    labels = np.repeat([0, 1], len(faces))
    return np.concatenate([vertices, ACROSS.mirrored(vertices)]), np.concatenate([faces, other]), labels, twin


@pytest.mark.parametrize("sides", [(1, -1), (-1, 1)])
def test_every_corner_of_one_side_is_the_image_of_one_of_the_other(sides):
    vertices, faces, labels, twin = pair()
    table = CornerTable.of(vertices, faces)
    image = image_corners(table, labels, np.array(sides), ACROSS, twin)
    has_image = image >= 0
    assert (has_image == (labels == sides.index(-1))[table.corner_face]).all()
    assert len(set(image[has_image])) == has_image.sum()
    points = vertices[table.corner_vertex]
    assert ACROSS.mirrored(points[has_image]) == pytest.approx(points[image[has_image]])
    assert (twin[table.corner_face[has_image]] == table.corner_face[image[has_image]]).all()


def test_a_part_that_differs_in_one_vertex_or_face_has_no_image():
    vertices, faces, labels, twin = pair()
    side = np.array([1, -1])
    moved = vertices.copy()
    moved[-1, 2] += 0.1
    assert (image_corners(CornerTable.of(moved, faces), labels, side, ACROSS, twin) == -1).all()
    less = np.where(np.arange(len(twin)) == 100, -1, twin)
    assert (image_corners(CornerTable.of(vertices, faces), labels, side, ACROSS, less) == -1).all()


def test_parts_without_twins_have_no_images():
    vertices, faces, labels, twin = pair()
    assert (image_corners(CornerTable.of(vertices, faces), labels, np.zeros(2, int), ACROSS, twin) == -1).all()


def lying_on_each_other():
    """A square, two triangles beside it, the square turned over and once more as it is, and a triangle of its corners.

    Worked out by hand: corners 10 to 13 and 14 to 17 are those of the second and the third square.
    """
    faces = [(0, 1, 2, 3), (1, 4, 2), (4, 5, 2), (0, 3, 2, 1), (2, 3, 0, 1), (0, 1, 2)]
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [2, 1]], float)
    vertex = np.concatenate(faces)
    face = np.repeat(np.arange(len(faces)), [len(corners) for corners in faces])
    ends = np.sort(np.stack([vertex, vertex[next_of_owner(face)]], axis=1), axis=1)
    edges, edge = np.unique(ends, axis=0, return_inverse=True)
    return CornerTable(np.column_stack([points, np.zeros(6)]), edges, vertex, edge.ravel(), face, len(faces))


def test_corners_of_a_face_on_an_earlier_one_are_those_of_the_same_vertices():
    first = double_corners(lying_on_each_other(), np.ones(6, bool))
    assert first.tolist() == [-1] * 10 + [0, 3, 2, 1] + [2, 3, 0, 1] + [-1] * 3


def test_the_first_face_is_one_of_those_that_count():
    table = lying_on_each_other()
    first = double_corners(table, np.array([False, True, True, True, True, True]))
    assert first.tolist() == [-1] * 14 + [12, 11, 10, 13] + [-1] * 3
    assert (double_corners(table, np.zeros(6, bool)) == -1).all()


@pytest.mark.parametrize("seed", range(3))
def test_doubles_have_the_vertices_of_a_face_that_is_none(seed):
    rng = np.random.default_rng(seed)
    vertices, faces = shapes.icosphere(2)
    faces = rng.permuted(faces[rng.integers(0, len(faces), 2 * len(faces))], axis=1)
    table = CornerTable.of(vertices, faces)
    first = double_corners(table, np.ones(len(faces), bool))
    double = first >= 0
    assert (table.corner_vertex[first[double]] == table.corner_vertex[double]).all()
    assert (first[first[double]] == -1).all()
    kept = ~double.reshape(-1, 3).any(axis=1)
    assert kept.sum() == len(np.unique(np.sort(faces, axis=1), axis=0))
