# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangle meshes: checks at the door, edges, angles, components, polygons."""

import numpy as np
import pytest
import shapes

from core.arrays.components import components
from core.arrays.ties import first_largest
from core.errors import EmptyMeshError, MeshError
from core.mesh.polygons import PolygonMesh
from core.mesh.triangles import EdgeTable, TriMesh, corner_sides

CLOSED = {
    "tetrahedron": (shapes.tetrahedron, 2), "octahedron": (shapes.octahedron, 2),
    "icosphere": (shapes.icosphere, 2), "box": (shapes.box, 2), "torus": (shapes.torus, 0),
    "dumbbell": (shapes.dumbbell, 2), "two spheres": (shapes.two_spheres, 4),
    "tree": (shapes.tube_tree, 2), "amphora": (shapes.genus_two, -2),
    **{f"genus {g}": (lambda g=g: shapes.surface_of_genus(g), 2 - 2 * g) for g in range(4)},
}


@pytest.mark.parametrize("name", CLOSED)
def test_closed_shapes_are_what_the_other_tests_take_them_for(name):
    make, euler = CLOSED[name]
    mesh = TriMesh(*make())
    assert mesh.euler_characteristic == euler
    assert (mesh.edges.n_faces == 2).all()
    assert 3 * mesh.n_faces == 2 * len(mesh.edges.vertices)
    assert np.einsum("ij,ij->", mesh.area_normals, mesh.face_centroids) > 0  # turned outwards


def test_sides_at_the_corners_of_a_triangle_by_hand():
    points = np.array([[9.0, 9, 9], [0, 0, 0], [3, 0, 0], [0, 4, 0]])
    ends, to_next, to_last = corner_sides(points, np.array([[1, 2, 3]]))
    assert ends.tolist() == [[2, 3], [3, 1], [1, 2]]
    assert to_next.tolist() == [[3, 0, 0], [-3, 4, 0], [0, -4, 0]]
    assert to_last.tolist() == [[0, 4, 0], [-3, 0, 0], [3, -4, 0]]


def test_arrays_are_copied_and_read_only():
    vertices, faces = shapes.tetrahedron()
    mesh = TriMesh(vertices, faces)
    vertices[:] = 0
    faces[:] = 0
    assert mesh.area == pytest.approx(8 * np.sqrt(3))  # edges of length 2 sqrt(2)
    with pytest.raises(ValueError, match="read-only"):
        mesh.vertices[0] = 1
    with pytest.raises(ValueError, match="read-only"):
        mesh.faces[0] = 1


@pytest.mark.parametrize(("vertices", "faces", "message"), [
    (np.zeros((4, 2)), [(0, 1, 2)], r"shape \(n, 3\)"),
    (np.zeros(12), [(0, 1, 2)], r"shape \(n, 3\)"),
    (np.zeros((4, 3)), np.zeros((2, 5), int), r"shape \(m, 3\)"),
    (np.zeros((4, 3)), [(0.0, 1.0, 2.0)], "whole numbers"),
])
def test_wrong_arrays(vertices, faces, message):
    with pytest.raises(MeshError, match=message):
        TriMesh(vertices, faces)


def test_coordinates_that_are_not_finite_are_listed():
    vertices, faces = shapes.icosphere(1)
    vertices[[4, 17], [0, 2]] = np.nan, np.inf
    with pytest.raises(MeshError, match=r"^2 of 42 vertices .* \(first: vertex 4\)") as caught:
        TriMesh(vertices, faces)
    assert caught.value.vertices.tolist() == [4, 17]


@pytest.mark.parametrize("wrong", [-1, 6])
def test_vertices_that_do_not_exist_are_listed(wrong):
    vertices, faces = shapes.octahedron()
    faces[[2, 5], 1] = wrong
    with pytest.raises(MeshError, match=r"^2 of 8 faces .*first: face 2; there are 6") as caught:
        TriMesh(vertices, faces)
    assert caught.value.faces.tolist() == [2, 5]


def test_edges_of_two_triangles_by_hand():
    edges = EdgeTable.of(np.array([(0, 1, 2), (2, 1, 3)]))
    assert edges.vertices.tolist() == [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]
    assert edges.face_edges.tolist() == [[0, 2, 1], [2, 3, 4]]
    assert edges.n_faces.tolist() == [1, 1, 2, 1, 1]
    assert edges.pairs.tolist() == [[0, 1]]
    assert edges.pair_edge.tolist() == [2]


def test_three_faces_at_an_edge_are_chained():
    edges = EdgeTable.of(np.array([(0, 1, 2), (0, 1, 3), (1, 0, 4)]))
    assert edges.n_faces.max() == 3
    assert edges.pairs.tolist() == [[0, 1], [1, 2]]


def test_a_face_with_a_repeated_vertex_does_not_touch_itself():
    edges = EdgeTable.of(np.array([(0, 0, 1), (0, 1, 2)]))
    assert (edges.pairs[:, 0] != edges.pairs[:, 1]).all()


def test_areas_and_normals_of_a_box_by_hand():
    mesh = TriMesh(*shapes.box((1, 2, 3)))
    assert mesh.area == pytest.approx(2 * (2 + 3 + 6))
    assert sorted(mesh.face_area) == pytest.approx([1] * 4 + [1.5] * 4 + [3] * 4)
    assert mesh.vertex_area.sum() == pytest.approx(mesh.area)
    center = np.array((0.5, 1, 1.5))
    assert (((mesh.face_centroids - center) * mesh.face_normals).sum(axis=1) > 0).all()
    np.testing.assert_allclose(np.sort(np.abs(mesh.face_normals), axis=1), [(0, 0, 1)] * 12)


def test_the_diagonal_is_that_of_what_has_a_face():
    vertices = np.array([(0, 0, 0), (2, 0, 0), (0, 3, 0), (0, 0, 6), (-100, 5, 5)], float)
    assert TriMesh(vertices, [(0, 1, 2), (1, 3, 2)]).diagonal == 7  # 4 + 9 + 36 is the square


def test_dihedral_angles_of_a_box_are_right_angles_or_flat():
    mesh = TriMesh(*shapes.box())
    angles = np.sort(mesh.dihedral)
    assert angles == pytest.approx([0] * 6 + [np.pi / 2] * 12, abs=1e-12)
    inward = TriMesh(*shapes.inside_out(shapes.box()))
    assert np.sort(inward.dihedral) == pytest.approx([-np.pi / 2] * 12 + [0] * 6, abs=1e-12)


def test_folded_faces_and_faces_that_are_lines_have_the_same_angle_in_all_poses():
    # Two triangles folded onto each other, and one with a triangle whose corners are on a line.
    square = np.array([(0, 0, 0), (1, 0, 0), (0.3, 0.8, 0), (0.4, 0.7, 0), (0.6, 0, 0)])
    faces = [(0, 1, 2), (1, 0, 3), (0, 4, 1)]
    for seed in range(20):
        rng = np.random.default_rng(seed)
        mesh = TriMesh(square @ shapes.rotation(rng).T + rng.normal(size=3), faces)
        assert np.sort(mesh.dihedral) == pytest.approx([0, np.pi], abs=1e-12)


def test_dihedral_does_not_depend_on_the_order_of_faces():
    shape = shapes.tube_tree()
    mesh = TriMesh(*shape)
    other = TriMesh(shape.vertices, shape.faces[::-1])
    assert np.sort(mesh.dihedral) == pytest.approx(np.sort(other.dihedral), abs=1e-9)
    assert (mesh.dihedral < -0.05).any()
    assert (mesh.dihedral > 0.05).any()


def test_components_are_numbered_by_their_lowest_element():
    count, label = components(6, np.array([5, 2]), np.array([1, 4]))
    assert count == 4
    assert label.tolist() == [0, 1, 2, 3, 2, 1]


def test_the_first_of_values_that_differ_by_rounding_only():
    assert first_largest(np.array([1.0, 3 * (1 - 1e-15), 3.0, 3 * (1 - 1e-13)])) == 1
    assert first_largest(np.array([1.0, 3 * (1 - 1e-6), 3.0])) == 1  # as far as single precision goes
    assert first_largest(np.array([1.0, 3 * (1 - 1e-5), 3.0])) == 2
    assert first_largest(np.zeros(4)) == 0


def test_a_shared_vertex_does_not_join_faces():
    assert TriMesh(*shapes.bowtie(shapes.tetrahedron())).face_components[0] == 2
    assert TriMesh(*shapes.two_spheres()).face_components[0] == 2


def test_submesh_keeps_positions():
    mesh = TriMesh(*shapes.two_spheres())
    mask = mesh.face_components[1] == 1
    part, index = mesh.submesh(mask)
    assert part.euler_characteristic == 2
    np.testing.assert_array_equal(part.vertices, mesh.vertices[index])
    np.testing.assert_array_equal(part.corners, mesh.corners[mask])


def test_polygons_become_fans():
    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 1), (2, 1, 1), (3, 0, 0)], float)
    mesh = PolygonMesh.of(vertices, [[0, 1, 2, 3], [1, 4, 2], [4, 6, 5, 2, 1], [3, 2, 5]])
    assert mesh.n_polygons == 4
    assert mesh.triangles.faces.tolist() == [
        [0, 1, 2], [0, 2, 3], [1, 4, 2], [4, 6, 5], [4, 5, 2], [4, 2, 1], [3, 2, 5]]
    assert mesh.polygon.tolist() == [0, 0, 1, 2, 2, 2, 3]


def test_quads_as_array_as_lists_and_as_triangles_are_one_mesh():
    vertices, quads = shapes.box_quads()
    array = PolygonMesh.of(vertices, quads)
    lists = PolygonMesh.of(vertices, quads.tolist())
    triangles = PolygonMesh.of(vertices, shapes.split_quads(quads), np.repeat(np.arange(6), 2))
    for other in (lists, triangles):
        np.testing.assert_array_equal(array.triangles.faces, other.triangles.faces)
        np.testing.assert_array_equal(array.polygon, other.polygon)
        assert other.n_polygons == 6


def test_polygon_numbers_are_checked():
    vertices, faces = shapes.box()
    for wrong in (np.zeros(5, int), np.full(12, -1)):
        with pytest.raises(MeshError, match="12 whole numbers from 0"):
            PolygonMesh.of(vertices, faces, wrong)


def test_polygons_with_too_few_corners_are_listed():
    vertices, quads = shapes.box_quads()
    with pytest.raises(MeshError, match="2 faces have fewer than three corners") as caught:
        PolygonMesh.of(vertices, [*quads.tolist(), [0, 1], [4]])
    assert caught.value.faces.tolist() == [6, 7]


@pytest.mark.parametrize("faces", [[], np.empty((0, 3), int), np.empty((0, 4), int), ()])
def test_no_faces(faces):
    with pytest.raises(EmptyMeshError, match="no faces"):
        PolygonMesh.of(np.zeros((3, 3)), faces)


def test_fewer_than_four_faces():
    vertices, faces = shapes.tetrahedron()
    with pytest.raises(EmptyMeshError, match="only 3 of the 4 faces") as caught:
        PolygonMesh.of(vertices, faces[:3])
    assert caught.value.faces.tolist() == [0, 1, 2]
    # Four triangles of one polygon are one face.
    with pytest.raises(EmptyMeshError, match="only 1 of the 4 faces"):
        PolygonMesh.of(vertices, faces, np.zeros(4, int))


def test_zero_area():
    vertices, faces = shapes.box()
    with pytest.raises(EmptyMeshError, match="^All 12 faces have zero area"):
        PolygonMesh.of(0 * vertices, faces)
    with pytest.raises(EmptyMeshError, match="zero area"):
        PolygonMesh.of(vertices * (1, 0, 0) + (3, 0.1, 0.7), faces)
    assert PolygonMesh.of(vertices * 1e-9, faces).triangles.area > 0  # small is not nothing


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_area_scales_and_edges_do_not_care(scale):
    vertices, faces = shapes.tube_tree(2)
    mesh, scaled = TriMesh(vertices, faces), TriMesh(scale * vertices, faces)
    assert scaled.area == pytest.approx(scale**2 * mesh.area)
    np.testing.assert_allclose(scaled.dihedral, mesh.dihedral, atol=1e-9)


def test_a_face_without_area_but_for_rounding_has_no_normal():
    """Two of its corners lie at one place, and their direction is rounding: from there the sine is as large as any."""
    large = shapes.icosphere(1)
    for seed in range(20):
        triangle = np.array([(0.0, 0.0, 0.0), (1e-16, 0.0, 0.0), (0.3, 0.2, 0.1)])
        triangle[1] = shapes.rotation(np.random.default_rng(seed)) @ triangle[1]
        for turned in range(3):
            corners = np.roll(np.arange(3), turned) + len(large.vertices)
            mesh = TriMesh(np.concatenate([large.vertices, triangle]), np.concatenate([large.faces, [corners]]))
            assert (mesh.face_normals[-1] == 0).all()
