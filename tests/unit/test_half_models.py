# SPDX-License-Identifier: GPL-3.0-or-later
"""Half models get the parts of the whole of which they are one side."""

import numpy as np
import pytest
import shapes
from results import same_partition

from core import Decomposition, MeshError, decompose
from core.graph.critical import SADDLE
from core.mesh.corners import CornerTable
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import TriMesh
from core.symmetry.halves import completed, completed_table, is_one_side, plane_of
from core.symmetry.plane import MirrorPlane

X = np.array([1.0, 0, 0, 0])


def posed(shape, plane, seed):
    """A shape turned, scaled and moved, and the plane with it."""
    turn, scale, offset = shapes.rotation(np.random.default_rng(seed)), 10.0**(seed - 1), np.array([0.3, -2.0, 1.0])
    normal = turn @ plane[:3]
    return (shapes.Shape(scale * shape.vertices @ turn.T + offset, shape.faces),
            np.append(normal, scale * plane[3] + normal @ offset))


@pytest.mark.parametrize("seed", range(3))
def test_the_parts_of_the_whole(seed):
    half, plane = posed(shapes.half_of(shapes.mirrored_figure()), X, seed)
    whole = completed(PolygonMesh.of(*half), plane)
    expected = decompose(whole.vertices, whole.triangles)
    found = decompose(*half, mirror=plane * (5.0, 5.0, 5.0, 1.0))
    assert found.n_faces == len(half.faces)
    assert found.n_vertices == len(half.vertices)
    for detail in (0.2, 0.5, 0.8):
        count = len(half.faces)
        assert same_partition(found.parts(detail).labels, expected.parts(detail).labels[:count]), detail
    assert found.parts(0.0).count == 1
    assert found.graph.n_nodes == expected.graph.n_nodes
    np.testing.assert_allclose(found.field, expected.field[:len(half.vertices)])
    # The figure is open at its ends, and there a few vertices are moved onto the plane.
    assert found.candidate_area.sum() == pytest.approx(expected.candidate_area.sum() / 2, rel=1e-4)
    _nodes_lie_in_their_parts(found, expected)


def _nodes_lie_in_their_parts(found, expected):
    """Each node lies in the part of the half in which its part of the whole, or the image of that, is."""
    parts, whole = found.parts(), expected.parts()
    home = np.full(whole.count, -1)
    home[whole.labels[:found.n_faces]] = parts.labels
    twin = home[whole.twin]
    for mine, of_whole in zip(parts.node_part, whole.node_part, strict=True):
        assert mine in (home[of_whole], twin[of_whole])


def test_the_graph_has_the_loops_of_the_whole():
    half = shapes.half_of(shapes.torus())
    assert decompose(*half, mirror=X).graph.n_loops == 1
    assert decompose(*half).graph.n_loops == 0


@pytest.mark.parametrize(("shape", "euler"), [
    (shapes.torus(), 0), (shapes.moved(shapes.subdivide(shapes.subdivide(shapes.box())), (-0.5, 0, 0)), 2)])
def test_the_border_at_the_plane_is_closed(shape, euler):
    half = shapes.half_of(shape)
    half.vertices[np.abs(half.vertices[:, 0]) < 1e-9, 0] = 3e-4  # not quite on the plane
    whole = completed(PolygonMesh.of(*half), X)
    mesh = TriMesh(whole.vertices, whole.triangles)
    sides = np.bincount(mesh.edges.face_edges.ravel())
    assert (sides == 2).all()
    assert mesh.n_vertices - len(sides) + mesh.n_faces == euler
    assert (np.bincount(whole.polygon) == 1).all()
    count = len(half.faces)
    np.testing.assert_allclose(mesh.face_centroids[:count] * (-1, 1, 1), mesh.face_centroids[count:], atol=1e-12)
    np.testing.assert_allclose(mesh.face_normals[:count] * (-1, 1, 1), mesh.face_normals[count:], atol=1e-12)


def test_stored_and_read_again():
    half = shapes.half_of(shapes.mirrored_figure())
    found = decompose(*half, mirror=X)
    read = Decomposition.from_bytes(found.to_bytes(), (found.n_vertices, found.n_faces))
    np.testing.assert_array_equal(read.parts().labels, found.parts().labels)


@pytest.mark.parametrize("plane", [
    (0, 0, 0, 1), (1, 0, 0), (1, 0, 0, np.nan), (np.inf, 0, 0, 0), "x", None, (1j, 0, 0, 0), [[1, 0, 0, 0]]])
def test_what_is_no_plane(plane):
    with pytest.raises(MeshError, match="four numbers"):
        plane_of(plane)


@pytest.mark.parametrize("scale", [1e-200, 1e200])
def test_planes_have_a_normal_of_length_one(scale):
    np.testing.assert_allclose(plane_of((3 * scale, 4 * scale, 0, 2)), (0.6, 0.8, 0, 2))


def test_one_side():
    shape = shapes.icosphere(2)
    assert not is_one_side(shape.vertices, X)
    assert is_one_side(shapes.half_of(shape).vertices, X)
    assert is_one_side(shapes.half_of(shape).vertices - (1e-3, 0, 0), X)
    assert is_one_side(-shapes.half_of(shape).vertices, X)


@pytest.mark.parametrize("side", [1, -1])
def test_a_tip_lies_in_the_part_that_it_or_its_image_is_on(side):
    half = shapes.half_of(shapes.mirrored_figure())
    vertices = half.vertices * (side, 1, 1)
    found = decompose(vertices, half.faces[:, ::side], mirror=X)
    parts, tips = found.parts(), np.flatnonzero(found.graph.node_kind != SADDLE)
    position = found.graph.node_position[tips]
    same_side = vertices[:, 0].mean() * position[:, 0] >= 0
    position = np.where(same_side[:, None], position, position * (-1, 1, 1))
    middle = vertices[half.faces].mean(axis=1)
    nearest = np.linalg.norm(middle - position[:, None], axis=2).argmin(axis=1)
    np.testing.assert_array_equal(parts.labels[nearest], parts.node_part[tips])


def test_notes_count_what_the_half_has():
    half = shapes.with_flat_faces(shapes.with_unused_vertices(shapes.half_of(shapes.mirrored_figure()), 3), 5)
    alone, found = decompose(*half), decompose(*half, mirror=X)
    both = completed(PolygonMesh.of(*half), X)
    whole = decompose(both.vertices, both.triangles)
    for text, share in (("no part", 1), ("zero area", 1), ("border", 0.5)):
        (note,), (of_half,), (of_whole,) = ([n for n in made.notes if text in n] for made in (found, alone, whole))
        assert note.values["n"] == of_whole.values["n"] // 2
        assert share == 0.5 or note == of_half


def test_a_note_on_an_edge_in_the_plane_counts_it_once():
    """Where half a box and two fins meet in the plane, the whole has one such edge, too; it read "0 edges"."""
    box = [(0, 3, 2, 1), (4, 5, 6, 7), (1, 2, 6, 5), (0, 1, 5, 4), (2, 3, 7, 6)]
    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),
                         (0.6, -0.5, 0), (0.6, -0.5, 1), (0.3, -0.7, 0), (0.3, -0.7, 1)])
    notes = decompose(vertices, [*box, (0, 4, 9, 8), (0, 4, 11, 10)], mirror=X).notes
    assert "1 edge joins more than two faces (non-manifold)." in notes


def test_contacts_of_a_half_are_between_faces_that_it_has():
    ball = shapes.icosphere(2)
    beside = shapes.moved(shapes.icosphere(2, 0.5), (1.49, 0, 0))
    half = shapes.together(shapes.half_of(ball), beside)
    found = decompose(*half, mirror=X)
    assert 0 < len(found.contacts)
    assert found.contacts.max() < found.n_faces
    assert (found.contacts[:, 0] != found.contacts[:, 1]).all()


@pytest.mark.parametrize(("away", "closed"), [(4e-4, True), (6e-4, False), (-4e-4, True), (-6e-4, False)])
def test_a_border_at_the_plane_is_closed_if_it_is_within_a_two_thousandth_of_the_size(away, closed):
    """Two squares in a row, whose left side is so far from the plane, in units of the diagonal."""
    row = shapes.flat_grid(2, 1)
    half = PolygonMesh.of(row.vertices + (away * np.sqrt(5), 0, 0), row.faces)
    assert len(completed(half, X).vertices) == (10 if closed else 12)


def test_what_has_no_face_or_lies_within_the_surface_closes_nothing():
    """A vertex far away does not make the mesh large, and one amid the surface, near to the plane, stays there."""
    row = shapes.flat_grid(2, 1)
    far = np.append(row.vertices + (6e-4 * np.sqrt(5), 0, 0), [(1000.0, 0, 0)], axis=0)
    assert len(completed(PolygonMesh.of(far, row.faces), X).vertices) == 2 * 7
    grid = shapes.flat_grid(2, 2)
    bent = grid.vertices * (1, 1, 0) + np.where(np.arange(9) == 4, 1e-5, 1.0)[:, None] * (0, 0, 1)
    z = np.array([0.0, 0, 1, 0])
    assert len(completed(PolygonMesh.of(bent, grid.faces), z).vertices) == 2 * 9


def test_a_mesh_without_vertices_is_on_no_side():
    assert not is_one_side(np.empty((0, 3)), X)


def test_faces_of_the_other_half_look_the_other_way_round():
    """Of a strip at the plane: neighbors agree across it, and each face is the image of one."""
    whole, image = completed_table(CornerTable.of(*shapes.flat_grid(2, 3)), MirrorPlane.of(X))
    assert (whole.n_faces, len(whole.vertices)) == (24, 12 + 8)
    assert not whole.contrary_edges().any()
    assert (np.bincount(whole.corner_edge) == 2).sum() == 24 * 3 - len(whole.edges)
    for face in range(12):
        corners, others = (whole.corner_vertex[whole.corner_face == k] for k in (face, face + 12))
        assert set(image[corners].tolist()) == set(others.tolist())
