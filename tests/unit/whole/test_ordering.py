# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts do not depend on the order of vertices and faces, nor on where and how large a model is."""

import numpy as np
import pytest
import shapes
from shapes import Shape, bent

from core import Parameters, decompose


@pytest.mark.parametrize("parameters", [Parameters(), Parameters(symmetry=False, pieces="separate")])
def test_a_model_exported_again_has_the_same_parts(parameters):
    """To the last bit: other numbers for its vertices, other faces first."""
    rng = np.random.default_rng(5)
    noisy = shapes.flat_grid(30, 20)
    noisy = Shape(noisy.vertices / 30 + rng.normal(scale=0.004, size=noisy.vertices.shape), noisy.faces)
    pieces = shapes.together(bent(shapes.torus(24, 9)), bent(shapes.icosphere(3)))
    for shape in (bent(shapes.tube_tree()), noisy, pieces):
        other, vertex, face = shapes.shuffled(shape, rng)
        one, two = decompose(*shape, parameters), decompose(*other, parameters)
        np.testing.assert_array_equal(one.field[vertex], two.field)
        np.testing.assert_array_equal(one.hierarchy.salience, two.hierarchy.salience)
        np.testing.assert_array_equal(one.candidates[face], two.candidates)
        np.testing.assert_array_equal(one.graph.node_position, two.graph.node_position)
        if len(one.face_twin):
            back = np.argsort(face)
            np.testing.assert_array_equal(np.append(back, -1)[one.face_twin[face]], two.face_twin)


MIRRORED = {
    "half a ball": lambda: shapes.half_of(shapes.icosphere(2)), "grid": lambda: shapes.flat_grid(6, 4),
    "half a vase": lambda: shapes.half_of(shapes.lathe([0, 1, 0.6, 1, 0], [0, 1, 2, 3, 4], 12)),
    "ring": lambda: bent(shapes.torus(8, 5)), "figure": lambda: shapes.mirrored_figure(0.4),
    "pieces": lambda: shapes.together(bent(shapes.box()), shapes.moved(bent(shapes.icosphere(1)), (0.9, 0.2, 0.3)),
                                      shapes.moved(bent(shapes.torus(8, 5)), (0, 1, 0))),
    "pieces with faces of two equal sides": lambda: shapes.together(
        shapes.lathe([0, 1, 0.6, 1, 0], [0, 1, 2, 3, 4], 10), shapes.moved(shapes.icosphere(1), (1.4, 0.5, 1)),
        shapes.moved(shapes.torus(9, 6, 0.8, 0.2), (0.3, -0.2, 2.2))),
}


@pytest.mark.parametrize("name", MIRRORED)
def test_the_mirror_image_has_the_mirror_image_of_the_parts(name):
    """So a symmetric model has the same parts whichever of its sides is taken for the first."""
    shape = MIRRORED[name]()
    image = Shape(shape.vertices * (-1, 1, 1), shape.faces[:, ::-1])
    one, two = decompose(*shape), decompose(*image)
    np.testing.assert_array_equal(one.candidates, two.candidates)
    np.testing.assert_array_equal(one.hierarchy.merges, two.hierarchy.merges)
    np.testing.assert_allclose(one.hierarchy.salience, two.hierarchy.salience, rtol=1e-12)


def test_box_frames_with_their_faces_in_another_order():
    frame = shapes.torus(4, 4)
    face = np.random.default_rng(2).permutation(len(frame.faces))
    one, two = decompose(*frame), decompose(frame.vertices, frame.faces[face])
    np.testing.assert_array_equal(one.candidates[face], two.candidates)
    np.testing.assert_array_equal(one.hierarchy.merges, two.hierarchy.merges)


def test_moved_far_away():
    shape = bent(shapes.tube_tree())
    one, two = decompose(*shape), decompose(shape.vertices + (40.0, -7.0, 0.3), shape.faces)
    np.testing.assert_array_equal(one.candidates, two.candidates)


def test_a_dense_mesh_moved_turned_scaled_and_shuffled():
    """Distances are measured on a coarser copy; which vertices it keeps was once decided by their coordinates."""
    shape = bent(shapes.tube_tree(4, 0.028))
    assert len(shape.vertices) > 20_000
    rng = np.random.default_rng(1)
    moved = Shape(1.1 * shape.vertices @ shapes.rotation(rng).T + (3.0, 0.2, -5.0), shape.faces)
    other, _, face = shapes.shuffled(moved, rng)
    one, two = decompose(*shape).parts(), decompose(*other).parts()
    # Parts are numbered by the caller's order.
    assert len(np.unique(np.stack([one.labels[face], two.labels]), axis=1).T) == one.count == two.count
