# SPDX-License-Identifier: GPL-3.0-or-later
"""Border vertices that are one are joined, for the working copy and for the caller's polygons alike."""

import numpy as np
import pytest
import shapes

from core.mesh.borders import GAP
from core.mesh.corners import CornerTable


def table_of(vertices, faces):
    return CornerTable.of(vertices, np.asarray(faces))


@pytest.mark.parametrize("gap", [0.0, 0.3 * GAP])
@pytest.mark.parametrize("make", [shapes.box_quads, shapes.torus, lambda: shapes.flat_grid(8, 5)])
def test_faces_that_were_all_taken_apart_are_neighbors_as_before(make, gap):
    vertices, faces = make()
    rng = np.random.default_rng(0)
    size = np.linalg.norm(np.ptp(vertices, axis=0))
    apart = vertices[faces.ravel()] + gap * size * rng.uniform(-1, 1, (faces.size, 3))
    table, first = table_of(apart, np.arange(faces.size).reshape(faces.shape)).joined()
    whole = table_of(vertices, faces)
    assert len(table.edges) == len(whole.edges)
    pairs, wanted = (set(map(frozenset, each.face_pairs()[0].tolist())) for each in (table, whole))
    assert pairs == wanted
    assert (first <= np.arange(len(first))).all()
    assert (first[first] == first).all()
    np.testing.assert_array_equal(table.corner_vertex, first)  # each corner had a vertex of its own


def test_a_vertex_of_no_face_does_not_say_how_near_is_near():
    """Two squares a thousandth of their size apart, and a vertex a hundred times as far away."""
    square, faces = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float), np.array([[0, 1, 2], [0, 2, 3]])
    vertices = np.concatenate([square, square + (1.001, 0, 0), [(100.0, 0, 0)]])
    _, first = table_of(vertices, np.concatenate([faces, faces + 4])).joined()
    np.testing.assert_array_equal(first, np.arange(9))


def test_closed_surfaces_that_touch_stay_apart():
    table = table_of(*shapes.together(shapes.box(), shapes.moved(shapes.box(), (1, 0, 0))))
    joined, first = table.joined()
    assert joined is table
    np.testing.assert_array_equal(first, np.arange(16))


def test_closed_surfaces_that_nearly_touch_stay_apart_with_every_corner_split_too():
    """As in .stl: their corners lay within GAP of each other, and what a file had split became one surface."""
    near = shapes.moved(shapes.box(), (1 + 0.5 * GAP, 0, 0))
    vertices, faces = shapes.together(shapes.box(), near)
    table, first = table_of(vertices[faces.ravel()], np.arange(faces.size).reshape(faces.shape)).joined()
    assert len(np.unique(first)) == 16
    assert (table.n_edge_faces == 2).all()
