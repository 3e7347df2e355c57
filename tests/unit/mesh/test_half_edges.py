# SPDX-License-Identifier: GPL-3.0-or-later
"""Half-edges of polygons, made of the triangles that these are cut into."""

import numpy as np
import pytest
import shapes

from core.mesh.half_edges import HalfEdges
from core.mesh.polygons import PolygonMesh
from core.surface.preparation import repair


def half_edges(vertices, faces):
    working = repair(PolygonMesh.of(vertices, faces))
    return HalfEdges.of(working.mesh, working.polygon), working


def test_sides_of_a_cube_of_quads_go_round_and_lie_across_each_other():
    half, _ = half_edges(*shapes.box_quads())
    every = np.arange(24)
    assert half.count == 24
    assert np.array_equal(np.bincount(half.polygon), np.full(6, 4))
    around = half.following
    for _ in range(3):
        assert not (around == every).any()
        around = half.following[around]
    assert np.array_equal(around, every)  # after four sides
    assert np.array_equal(half.before[half.following], every)
    assert np.array_equal(half.polygon[half.following], half.polygon)
    assert np.array_equal(half.opposite[half.opposite], every)
    assert np.array_equal(half.start[half.opposite], half.end)
    assert np.array_equal(half.end, half.start[half.following])
    assert half.length == pytest.approx(np.ones(24))
    assert (half.piece == 0).all()


def test_a_polygon_of_any_number_of_corners_has_so_many_sides():
    vertices, faces = shapes.prism_of_rays(5)
    half, _ = half_edges(vertices, faces)
    assert sorted(np.bincount(half.polygon).tolist()) == sorted(map(len, faces))
    assert (half.opposite >= 0).all()


def test_borders_fins_and_faces_turned_the_other_way_have_nothing_across():
    vertices, faces = shapes.with_fin(shapes.icosphere(1))
    half, working = half_edges(vertices, faces)
    number = working.mesh.edges.n_faces[working.mesh.edges.face_edges.ravel()]
    assert np.array_equal(half.opposite >= 0, number == 2)
    grid, _ = half_edges(*shapes.flat_grid(3, 2))
    assert (grid.opposite < 0).sum() == 10


def test_pieces_are_those_of_the_mesh():
    half, working = half_edges(*shapes.two_spheres(1))
    assert np.array_equal(half.piece, working.mesh.face_components[1].repeat(3))
