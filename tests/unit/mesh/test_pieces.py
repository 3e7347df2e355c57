# SPDX-License-Identifier: GPL-3.0-or-later
"""What of one piece is nearest to another one, and points that are scattered over pieces."""

import numpy as np
import pytest
import shapes

from core.arrays.hashes import hashed_rows
from core.mesh.pieces import Pieces, nearest_polygons, nearest_vertices, scattered
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh


def nearest_of_base(vertices, faces, base):
    """Polygons and vertices nearest to each; base : of each piece."""
    given = PolygonMesh.of(vertices, faces)
    pieces = Pieces.of(given, hashed_rows(given.triangles.vertices))
    numbers = {int(pieces.of_polygon[face]): int(pieces.of_polygon[its]) for face, its in base.items()}
    of = np.array([numbers.get(piece, -1) for piece in range(pieces.count)])
    return nearest_polygons(given, pieces, of, 0), nearest_vertices(given, pieces, of)


def test_a_face_without_area_is_nearest_to_none():
    """It has the part of a neighbor: what had its part did not hang together with that."""
    solid = shapes.octahedron()
    line = solid.faces[0, [0, 1, 1]]  # its middle, weighted by area, is 0
    both = shapes.together(shapes.Shape(solid.vertices, np.vstack([solid.faces, line])),
                           shapes.Shape(0.01 * np.eye(3), np.arange(3).reshape(1, 3)))
    polygon, _ = nearest_of_base(*both, {9: 0})
    assert polygon[:9].tolist() == list(range(9))
    assert polygon[9] in range(8)


def test_a_vertex_of_no_face_is_nearest_to_none():
    """What was at its place had no field and no part."""
    solid, n = shapes.octahedron(), len(shapes.octahedron().vertices)
    loose = shapes.Shape(np.vstack([solid.vertices, solid.vertices]), solid.faces + n)
    both = shapes.together(loose, shapes.Shape(0.9 * solid.vertices, solid.faces))
    _, vertex = nearest_of_base(*both, {8: 0})
    assert vertex[2 * n:].tolist() == list(range(n, 2 * n))


@pytest.mark.parametrize("shape", [shapes.octahedron(), shapes.torus(24, 8)], ids=["alike", "of any size"])
def test_points_lie_on_their_faces_evenly(shape):
    mesh = TriMesh(*shape)
    some = np.arange(1, mesh.n_faces)
    face, point = scattered(mesh, some, mesh.face_area[some], 1000)
    assert np.isin(face, some).all()
    expected = 1000 * mesh.face_area[some] / mesh.face_area[some].sum()
    assert np.abs(np.bincount(face, minlength=mesh.n_faces)[some] - expected).max() < 1 + 1e-9
    shares = np.linalg.solve(mesh.corners[face].transpose(0, 2, 1), point[:, :, None])[:, :, 0]
    assert shares.min() >= -1e-9
    assert shares.sum(axis=1) == pytest.approx(1)
    # As often near each corner as elsewhere.
    assert shares.mean(axis=0) == pytest.approx(1 / 3, abs=0.02)
