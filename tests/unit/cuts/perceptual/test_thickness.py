# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness and clearance where they are known: in tubes, plates and slots."""

import numpy as np
import pytest
import shapes

from core.arrays.nearest import search_tree
from core.cuts.perceptual.thickness import LARGEST_BALL, _nearest, thickness
from core.mesh.triangles import TriMesh


def measured(shape, order=None):
    """The mesh, and the radii inside and outside in the unit of its vertices; sorted along an odd direction."""
    mesh = TriMesh(*shape)
    order = mesh.face_centroids @ (0.9, 0.4, 0.17) if order is None else order
    unit = np.sqrt(mesh.area)
    return mesh, *(radius * unit for radius in thickness(mesh, order))


@pytest.mark.parametrize("radius", [0.25, 1.0])
def test_inside_a_long_tube_it_is_the_radius(radius):
    """But for its sides: a ball that touches one beside its middle has its center beside the axis."""
    mesh, inside, outside = measured(shapes.cylinder(60, 96, radius, 20 * radius))
    along = mesh.face_centroids[:, 2] / radius
    midst = np.abs(along - (along.min() + along.max()) / 2) < 7
    assert midst.sum() > 1000
    np.testing.assert_allclose(inside[midst], radius, rtol=0.03)
    np.testing.assert_allclose(outside, LARGEST_BALL * np.sqrt(mesh.area))  # nothing is above what is convex


def plates(gap):
    """Two plates of 3 by 3 by 0.2, one above the other, as fine as 0.1."""
    solid = np.zeros((30, 30, 4 + round(10 * gap)), bool)
    solid[..., :2] = solid[..., -2:] = True
    vertices, quads = shapes.blocks(solid, 0.1)
    return vertices, shapes.split_quads(quads)


def test_of_a_plate_it_is_half_the_thickness_and_between_two_half_the_gap():
    mesh, inside, outside = measured(plates(0.6))
    x, y, z = mesh.face_centroids.T - mesh.face_centroids.mean(axis=0)[:, None]
    midst = (np.abs(x) < 1) & (np.abs(y) < 1)
    assert midst.sum() > 3000
    between = midst & (np.abs(z) < 0.35)
    np.testing.assert_allclose(inside[midst], 0.1, rtol=0.05)
    np.testing.assert_allclose(outside[between], 0.3, rtol=0.05)
    np.testing.assert_allclose(outside[midst & ~between], LARGEST_BALL * np.sqrt(mesh.area))


def test_the_order_of_the_faces_and_the_size_do_not_count():
    vertices, faces = shapes.tube_tree(step=0.2)
    mesh = TriMesh(vertices, faces)
    rng = np.random.default_rng(0)
    order, shuffle = rng.random(len(faces)), rng.permutation(len(faces))
    for one, other in zip(thickness(mesh, order), thickness(TriMesh(8 * vertices, faces[shuffle]), order[shuffle]),
                          strict=True):
        np.testing.assert_allclose(one[shuffle], other, rtol=1e-9)
        assert (one > 0).all()
        assert (one <= (1 + 1e-12) * LARGEST_BALL).all()


def test_all_that_are_as_near_as_the_third_count():
    """On a regular grid, rounding must not choose."""
    square = np.array([(0.0, 0), (1, 0), (0, 1), (1, 1), (3, 3), (4, 4), (5, 5)])
    square[0] -= 1e-12
    near, counts = _nearest(search_tree(square), np.array([(0.5, 0.5), (0.1, 0.2)]))
    assert np.sort(near[0][counts[0]]).tolist() == [0, 1, 2, 3]
    assert near[1][counts[1]].tolist() == [0, 2, 1]
