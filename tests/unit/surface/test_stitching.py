# SPDX-License-Identifier: GPL-3.0-or-later
"""Borders on whose edges the vertices of others lie: surfaces that are finer in one place than in another."""

import numpy as np
import pytest
import shapes

from core import decompose
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.metrics import rand_index_error
from core.surface.preparation import repair
from core.surface.stitching import stitched


def torn(shape, share):
    """Some of the faces split on one side, see ``split_on_one_side``."""
    chosen = np.random.default_rng(0).random(len(shape.faces)) < share
    return shapes.split_on_one_side(shape, np.flatnonzero(chosen))


def strip_beside_an_edge(ends):
    """A triangle above the edge from 0 to 1, and below it a row of triangles whose corners on it are given."""
    ends = np.sort(np.concatenate([[0.0, 1.0], ends]))
    on, below = np.stack([ends, 0 * ends, 0 * ends], axis=1), np.array([[0.5, -1.0, 0.0]])
    count = len(ends)
    fan = np.stack([np.full(count - 1, count), np.arange(1, count), np.arange(count - 1)], axis=1)
    return shapes.Shape(np.concatenate([on, below, [[0.5, 1.0, 0.0]]]),
                        np.concatenate([fan, [[0, count - 1, count + 1]]]))


def turned_alike(mesh):
    return not mesh.same_way.any()


@pytest.mark.parametrize(("make", "rounds"), [
    (shapes.icosphere, 1), (shapes.torus, 3), (shapes.genus_two, 1), (shapes.box, 5)])
def test_a_surface_finer_on_one_side_is_closed_again(make, rounds):
    shape = make()
    both, _ = shapes.finer_in(shape, shape.vertices[shape.faces].mean(axis=1) @ (0.3, 1.0, 0.2) > 0.01, rounds)
    given = PolygonMesh.of(*both)
    working = repair(given)
    assert (working.mesh.edges.n_faces == 2).all()
    assert working.mesh.face_components[0] == 1
    assert working.mesh.euler_characteristic == TriMesh(*shape).euler_characteristic
    assert working.mesh.area == pytest.approx(given.triangles.area, rel=1e-12)
    assert turned_alike(working.mesh)
    # Each face lies in that of the caller, and its corners are vertices of the caller.
    assert (np.diff(working.polygon) >= 0).all()
    np.testing.assert_allclose(np.bincount(working.polygon, working.mesh.face_area), given.triangles.face_area,
                               rtol=1e-9)
    np.testing.assert_array_equal(working.mesh.vertices, given.triangles.vertices[working.vertex_source])


@pytest.mark.parametrize("share", [0.02, 0.3, 1.0])
def test_edges_split_on_one_side_only_are_joined(share):
    shape = shapes.genus_two()
    working = repair(PolygonMesh.of(*torn(shape, share)[0]))
    assert (working.mesh.edges.n_faces == 2).all()
    assert working.mesh.euler_characteristic == TriMesh(*shape).euler_characteristic == -2


def test_pairs_are_the_faces_that_share_an_edge_only_now():
    shape = strip_beside_an_edge([0.25, 0.5, 0.75])
    result = stitched(TriMesh(*shape))
    assert result.pairs.tolist() == [[0, 4], [1, 4], [2, 4], [3, 4]]
    assert result.parent.tolist() == [0, 1, 2, 3, 4, 4, 4, 4]
    assert (result.mesh.edges.n_faces == 1).sum() == 4


def test_a_long_edge_is_split_at_hundreds_of_vertices():
    ends = (np.arange(1, 400) + 0.4 * np.random.default_rng(1).uniform(-1, 1, 399)) / 400
    result = stitched(TriMesh(*strip_beside_an_edge(ends)))
    assert (result.mesh.edges.n_faces == 1).sum() == 4
    assert result.mesh.face_components[0] == 1


def test_borders_that_overlap_by_half_like_bricks_are_joined():
    low = np.array([(x, 0.0, 0.0) for x in (0, 2, 4, 6)] + [(1, -1.0, 0), (3, -1, 0), (5, -1, 0)])
    high = np.array([(x, 0.0, 0.0) for x in (0, 1, 3, 5, 6)] + [(0.5, 1.0, 0), (2, 1, 0), (4, 1, 0), (5.5, 1, 0)])
    lower, upper = [(0, 4, 1), (1, 5, 2), (2, 6, 3)], [(0, 1, 5), (1, 2, 6), (2, 3, 7), (3, 4, 8)]
    shape = shapes.together(shapes.Shape(low, np.array(lower)), shapes.Shape(high, np.array(upper)))
    mesh = repair(PolygonMesh.of(*shape)).mesh
    assert mesh.face_components[0] == 1
    at_zero = (mesh.vertices[mesh.edges.vertices][:, :, 1] == 0).all(axis=1)
    assert at_zero.sum() == 6
    assert (mesh.edges.n_faces[at_zero] == 2).all()


@pytest.mark.parametrize(("off", "joined"), [(0.0, True), (2e-5, True), (1e-3, True), (3e-3, False)])
def test_a_vertex_lies_on_an_edge_within_the_gap_of_borders(off, joined):
    shape = strip_beside_an_edge([0.5])
    shape.vertices[1, 2] = off
    assert bool(len(stitched(TriMesh(*shape)).pairs)) == joined


def test_blades_as_thin_as_a_gap_stay_as_they_are():
    """A row of blades, each with a spine, so thin that the tips of both borders are within reach of each other."""
    width, height = 3e-4, np.array([0.0, 0.4, 0.7])
    blade = np.array([(x * width * (1 - z), 0.1 * abs(x) * width, z) for z in height for x in (-1, 0, 1)]
                     + [(0, 0, 1.0)])
    quads = [(k, k + 1, k + 4, k + 3) for k in (0, 1, 3, 4)]
    faces = np.array([f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))] + [(6, 7, 9), (7, 8, 9)])
    mesh = TriMesh(*shapes.together(*(shapes.moved(shapes.Shape(blade, faces), (0.05 * k, 0, 0)) for k in range(20))))
    assert stitched(mesh).mesh is mesh


def test_sheets_that_lie_on_each_other_stay_two():
    plate = shapes.flat_grid(20, 20)
    mesh = TriMesh(*shapes.together(plate, shapes.moved(plate, (0, 0, 0.01))))
    assert stitched(mesh).mesh is mesh


@pytest.mark.parametrize("name", ["grid", "closed", "touching in a corner", "flat face", "no face"])
def test_nothing_else_is_split(name):
    mesh = TriMesh(*{
        "grid": lambda: shapes.flat_grid(7, 5),
        "closed": shapes.torus,
        "touching in a corner": lambda: shapes.together(
            shapes.flat_grid(2, 2), shapes.moved(shapes.flat_grid(1, 1), (2, 0.5, 0))),
        # The corner across from the long edge lies on it: nothing could be split there.
        "flat face": lambda: shapes.Shape(np.array([(0.0, 0, 0), (1, 0, 0), (0.5, 0, 0)]), np.array([(0, 1, 2)])),
        "no face": lambda: shapes.Shape(np.zeros((2, 3)), np.zeros((0, 3), np.int64)),
    }[name]())
    result = stitched(mesh)
    assert result.mesh is mesh
    assert not len(result.pairs)
    np.testing.assert_array_equal(result.parent, np.arange(mesh.n_faces))


@pytest.mark.parametrize("borders", ["finer beyond the middle", "split on one side"])
def test_a_tree_whose_borders_do_not_meet_has_the_parts_of_the_whole(borders):
    shape = shapes.tube_tree()
    height = shape.vertices[shape.faces].mean(axis=1)[:, 2]
    broken, source = (shapes.finer_in(shape, height > np.median(height)) if borders == "finer beyond the middle"
                      else torn(shape, 0.3))
    whole, found = decompose(*shape), decompose(*broken)
    assert found.parts().count == whole.parts().count
    assert rand_index_error(whole.parts().labels[source], found.parts().labels) < 0.02
    assert any("treated as joined" in note for note in found.notes)
    assert len(found.contacts)
    assert not len(found.links)
