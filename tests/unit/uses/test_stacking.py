# SPDX-License-Identifier: GPL-3.0-or-later
"""Mirror images of corners: found where meshes are exact images, and only there."""

import numpy as np
import pytest
import shapes

from core.surface.corners import CornerTable
from core.surface.mirror_plane import MirrorPlane
from core.uses.stacking import image_corners

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
