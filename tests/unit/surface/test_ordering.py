# SPDX-License-Identifier: GPL-3.0-or-later
"""The order in which a mesh is worked on: that of its places, whatever the caller's."""


import numpy as np
import pytest
import shapes
from shapes import Shape, bent

from core.mesh.polygons import PolygonMesh
from core.surface.ordering import principal_axes, sorted_by_place
from core.surface.preparation import repair

LOPSIDED = {"sphere": bent(shapes.icosphere(3)), "torus": bent(shapes.torus(24, 9)), "tree": bent(shapes.tube_tree()),
            "grid": bent(Shape(shapes.flat_grid(9, 5).vertices / 9, shapes.flat_grid(9, 5).faces))}


def sorted_mesh(shape):
    mesh, ordering = sorted_by_place(PolygonMesh.of(*shape))
    return mesh, ordering


@pytest.mark.parametrize("name", LOPSIDED)
def test_neither_order_nor_pose_nor_scale_changes_the_order(name):
    one, _ = sorted_mesh(LOPSIDED[name])
    for seed in range(3):
        rng = np.random.default_rng(seed)
        turn, by = shapes.rotation(rng), rng.normal(size=3)
        moved = Shape(3.7 * LOPSIDED[name].vertices @ turn.T + by, LOPSIDED[name].faces)
        two, ordering = sorted_mesh(shapes.shuffled(moved, rng)[0])
        np.testing.assert_array_equal(one.triangles.faces, two.triangles.faces)
        np.testing.assert_allclose(3.7 * one.triangles.vertices @ turn.T + by, two.triangles.vertices, atol=1e-12)
        assert sorted(ordering.vertex.tolist()) == list(range(len(moved.vertices)))
        assert sorted(ordering.polygon.tolist()) == list(range(len(moved.faces)))


@pytest.mark.parametrize("shape", [shapes.icosphere(2), shapes.torus(), shapes.dumbbell(), shapes.flat_grid(6, 6)])
def test_of_symmetric_shapes_the_order_of_the_faces_changes_nothing(shape):
    one, _ = sorted_mesh(shape)
    face = np.random.default_rng(0).permutation(len(shape.faces))
    two, _ = sorted_mesh(Shape(shape.vertices, shape.faces[face]))
    np.testing.assert_array_equal(one.triangles.faces, two.triangles.faces)
    np.testing.assert_array_equal(one.triangles.vertices, two.triangles.vertices)


@pytest.mark.parametrize("seed", [7, 9, 12])
def test_of_symmetric_quads_their_diagonals_decide(seed):
    """But for how its quads are divided a box is its own image: the order of the vertices chose its frame."""
    rng = np.random.default_rng(seed)
    vertices, quads = shapes.blocks(np.ones((3, 2, 1), bool))
    quads, found = np.array([np.roll(quad, rng.integers(0, 2)) for quad in quads]), set()
    for _ in range(6):
        order = rng.permutation(len(vertices))
        given, _ = sorted_by_place(PolygonMesh.of(
            (vertices * (1.0, 1.1, 1.7))[order], np.argsort(order)[rng.permutation(quads)]))
        found.add((given.triangles.vertices.tobytes(), given.triangles.faces.tobytes()))
    assert len(found) == 1


def test_polygons_stay_whole():
    _, ordering = sorted_mesh(LOPSIDED["grid"])
    faces = LOPSIDED["grid"].faces
    mesh, ordering = sorted_by_place(PolygonMesh.of(LOPSIDED["grid"].vertices, faces, np.arange(len(faces)) // 2))
    for place, polygon in enumerate(ordering.polygon.tolist()):
        here = ordering.vertex[mesh.triangles.faces[mesh.polygon == place]]
        there = faces[2 * polygon:2 * polygon + 2]
        assert here.shape == there.shape  # of a quadrilateral the diagonal may be the other
        assert set(here.ravel().tolist()) == set(there.ravel().tolist())


def test_two_vertices_at_one_place_are_told_apart_by_their_faces():
    """A seam: the sphere is cut in two, and both halves have the vertices between them."""
    sphere = LOPSIDED["sphere"]
    upper = sphere.vertices[sphere.faces].mean(axis=1)[:, 2] > 0
    cut = Shape(np.concatenate([sphere.vertices, sphere.vertices]),
                np.where(upper[:, None], sphere.faces, sphere.faces + len(sphere.vertices)))
    used = np.unique(cut.faces)
    cut = Shape(cut.vertices[used], np.searchsorted(used, cut.faces))
    one, _ = sorted_mesh(cut)
    two, _ = sorted_mesh(shapes.shuffled(cut, np.random.default_rng(0))[0])
    np.testing.assert_array_equal(one.triangles.faces, two.triangles.faces)


def test_principal_axes_of_what_has_more_than_three():
    eye = np.eye(3)
    np.testing.assert_allclose(principal_axes(np.diag([2.0, 2.0, 2.0]), eye), eye, atol=1e-12)
    toward = np.array([(0.01, 0, 5), (3.0, 4.0, 1.0), (1, 0, 0)])
    axes = principal_axes(np.diag([1.0, 1.0, 7.0]), toward)
    np.testing.assert_allclose(np.abs(axes[0]), (0, 0, 1), atol=1e-12)
    np.testing.assert_allclose(axes[1], (0.6, 0.8, 0), atol=1e-12)
    np.testing.assert_allclose(axes @ axes.T, eye, atol=1e-12)


def test_pieces_of_many_symmetries_are_sorted_by_the_whole():
    """Blocks, each with many frames, that lie without symmetry."""
    blocks = shapes.together(*(shapes.moved(shapes.Shape(size * shapes.box().vertices, shapes.box().faces), place)
                               for size, place in ((1.0, (0, 0, 0)), (0.7, (0.8, 0.1, 0.3)), (1.0, (0.2, 0.9, 0.4)))))
    one, _ = sorted_mesh(blocks)
    for seed in range(4):
        two, _ = sorted_mesh(shapes.shuffled(blocks, np.random.default_rng(seed))[0])
        np.testing.assert_array_equal(one.triangles.vertices, two.triangles.vertices)
        np.testing.assert_array_equal(one.triangles.faces, two.triangles.faces)


@pytest.mark.parametrize("place", [(0.4, 0.5, 0.6), (-3.0, 50.0, 7.0), (1e200, 0.0, -1e200)])
@pytest.mark.filterwarnings("error")
def test_a_vertex_of_no_face_changes_nothing(place):
    """Within the box of a piece it was another piece nearby, far away it made all others near, and then overflowed."""
    pair = shapes.together(shapes.box(), shapes.moved(shapes.box(), (3, 0, 0)))
    for together in (True, False):
        _, one = sorted_by_place(PolygonMesh.of(*pair), together)
        _, two = sorted_by_place(PolygonMesh.of(np.concatenate([pair.vertices, [place]]), pair.faces), together)
        np.testing.assert_array_equal(two.polygon, one.polygon)
        np.testing.assert_array_equal(two.vertex[two.vertex < len(pair.vertices)], one.vertex)


@pytest.mark.parametrize("seed", range(8))
def test_pieces_of_whole_numbers_are_sorted_alike_at_any_size(seed):
    """Their coordinates differ in few digits, and places apart were taken for one, others at twice the size."""
    cells = np.argwhere(np.random.default_rng(seed).random((6, 6)) < 0.6)
    vertices, faces = shapes.flat_cells(cells.tolist())
    one, *others = (sorted_by_place(PolygonMesh.of(size * vertices, faces, None))[1] for size in (1.0, 2.0, 0.5, 8.0))
    for other in others:
        np.testing.assert_array_equal(other.vertex, one.vertex)
        np.testing.assert_array_equal(other.polygon, one.polygon)


TREE_AND_BALL = shapes.together(shapes.tube_tree(step=0.2), shapes.moved(shapes.icosphere(2), (0.2, 0, 2.5)))
SPLIT = {"pieces": bent(TREE_AND_BALL),
         "figure": bent(shapes.mirrored_figure(0.2)), "fin": bent(shapes.with_fin(shapes.icosphere(2))), **LOPSIDED}


@pytest.mark.parametrize("name", SPLIT)
@pytest.mark.parametrize("share", [0.01, 0.5, 1.0])
def test_vertices_that_files_split_change_nothing(name, share):
    """Some or all corners of faces have vertices of their own, as in .stl files: the repaired mesh is the same."""
    rng, shape = np.random.default_rng(7), SPLIT[name]
    whole = repair(sorted_by_place(PolygonMesh.of(*shape))[0])
    faces = shape.faces.copy()
    split = np.flatnonzero(rng.random(faces.size) < share)
    faces.flat[split] = len(shape.vertices) + np.arange(len(split))
    points = np.concatenate([shape.vertices, shape.vertices[shape.faces.flat[split]]])
    order = rng.permutation(len(faces))
    soup = repair(sorted_by_place(PolygonMesh.of(points, faces[order]))[0])
    assert np.array_equal(soup.mesh.vertices, whole.mesh.vertices)
    assert np.array_equal(soup.mesh.faces, whole.mesh.faces)
    assert np.array_equal(soup.polygon, whole.polygon)


@pytest.mark.parametrize("name", SPLIT)
def test_split_vertices_that_differ_by_rounding_are_sorted_alike_in_any_order(name):
    """One of those at a place stood for all, the last in the order of the file: a race car had 6 or 7 parts."""
    rng, (vertices, faces) = np.random.default_rng(3), SPLIT[name]
    points = vertices[faces.ravel()] + 2e-6 * np.ptp(vertices) * rng.uniform(-1, 1, (faces.size, 3))
    corners, found = np.arange(faces.size).reshape(-1, 3), set()
    for _ in range(3):
        order = rng.permutation(len(points))
        found.add(sorted_by_place(PolygonMesh.of(points[order], np.argsort(order)[corners]))[1].polygon.tobytes())
    assert len(found) == 1


@pytest.mark.parametrize("offset", [(3.0, -2.0, 5.0), (0.0, 64.0, 0.0), (-8.0, 4.0, 2.0)])
def test_vertices_that_differ_by_rounding_are_at_one_place_before_and_after_a_move(offset):
    """Two pieces touch at a vertex whose coordinates differ in the last bit: moved, they are equal."""
    rng = np.random.default_rng(3)
    large, small = bent(shapes.tube_tree(step=0.2)), bent(shapes.icosphere(1, 0.2))
    at = large.vertices[rng.integers(len(large.vertices), size=12)]
    balls = [Shape(small.vertices - small.vertices[0] + at[k] + 2e-16 * (k % 3), small.faces) for k in range(12)]
    vertices, faces = shapes.together(large, *balls)
    order = sorted_mesh(Shape(vertices, faces))[1]
    moved = sorted_mesh(Shape(vertices + offset, faces))[1]
    assert np.array_equal(moved.polygon, order.polygon)
    assert np.array_equal(moved.vertex, order.vertex)
