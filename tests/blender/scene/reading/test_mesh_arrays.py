# SPDX-License-Identifier: GPL-3.0-or-later
"""The arrays of a mesh are what Blender itself would give."""

import importlib
import time

import bpy
import numpy as np
import pytest
from bulk import read
from systems import unix


@pytest.mark.parametrize("flat", [False, True])
@pytest.mark.parametrize("corners", [(3, 7), (3, 5), (4, 5)])  # from, to less than
def test_quads_and_larger_faces_are_divided_as_blender_divides_them(package, flat, corners):
    """Random ones, most of them not flat or crossing themselves, and some with three equal corners."""
    module = importlib.import_module(f"{package}.scene.reading.mesh_arrays")
    count = np.random.default_rng(0).integers(*corners, 600)
    points = np.random.default_rng(1).normal(size=(count.sum(), 3)).astype(np.float32)
    points = points.round() if flat else points
    mesh = bpy.data.meshes.new("Faces")
    first = np.cumsum(count) - count
    mesh.from_pydata(points.tolist(), [], [list(range(a, a + n)) for a, n in zip(first, count, strict=True)])
    mesh.calc_loop_triangles()
    triangles, face = module.triangles(mesh)
    assert np.array_equal(triangles, read(mesh.loop_triangles, "vertices", np.int32, 3))
    assert np.array_equal(face, read(mesh.loop_triangles, "polygon_index", np.int32))


def test_an_attribute_that_only_has_the_name_of_a_setting_is_left_alone(package):
    module = importlib.import_module(f"{package}.scene.reading.mesh_arrays")
    mesh = bpy.data.meshes.new("Face")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    mine = mesh.attributes.new("material_index", "FLOAT", "POINT")
    if mine is None:  # Blender 4 makes none
        assert bpy.app.version < (5, 0)
        return
    mine.data.foreach_set("value", np.array([0.25, 0.5, 0.75], np.float32))
    module.set_element_values(mesh, "polygons", "material_index", np.array([1]))
    assert module.element_values(mesh, "polygons", "material_index").tolist() == [0]
    assert read(mesh.attributes["material_index"].data, "value").tolist() == [0.25, 0.5, 0.75]


@unix  # Windows measures no milliseconds
def test_shape_keys_are_read_and_written_as_blender_has_them_in_no_time(package):
    """One by one, as by their data, a face with all its keys took longer than all the rest of Separate."""
    module = importlib.import_module(f"{package}.scene.reading.mesh_arrays")
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=150, y_subdivisions=150)
    obj = bpy.context.object
    key = [obj.shape_key_add(name=name) for name in ("Basis", "Key")][1]
    wanted = np.random.default_rng(0).random((len(obj.data.vertices), 3)).astype(np.float32)

    def seconds(work):
        """The least of several times, as a millisecond may be anything; and what was found."""
        taken = []
        for _ in range(7):
            start = time.process_time()
            found = work()
            taken.append(time.process_time() - start)
        return min(taken), found

    written, _ = seconds(lambda: module.set_key_points(key, wanted))
    one_by_one, found = seconds(lambda: read(key.data, "co", np.float32, 3))
    assert np.array_equal(found, wanted)
    at_once, found = seconds(lambda: module.key_points(key))
    assert np.array_equal(found, wanted)
    assert max(written, at_once) < 0.1 * one_by_one


def test_corners_are_read_again_once_they_are_in_another_order(scene_module, make):
    """Sort Elements leaves as many, and the stored result is that of before: pinned parts were cut along edges
    that were elsewhere by then, or there was an error.
    """
    mesh_arrays = scene_module("reading.mesh_arrays")
    corner = np.arange(20).reshape(4, 5)[:-1, :-1].ravel()
    faces = np.stack([corner, corner + 1, corner + 6, corner + 5], axis=1)
    points = np.stack([*np.divmod(np.arange(20), 5), np.zeros(20)], axis=1)
    # Two sheets side by side, whose vertices are split where they meet.
    mesh = make((np.concatenate([points, points + (3.0, 0.0, 0.0)]), np.concatenate([faces, faces + 20]))).data
    bpy.ops.reeb_parts.decompose()
    mesh_arrays.joined_table(mesh)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.sort_elements(type="RANDOMIZE", elements={"VERT", "EDGE", "FACE"})
    bpy.ops.object.mode_set(mode="OBJECT")
    found = mesh_arrays.joined_table(mesh)
    mesh_arrays.forget()
    wanted = mesh_arrays.joined_table(mesh)
    for name in ("edges", "corner_vertex", "corner_edge", "corner_face"):
        np.testing.assert_array_equal(getattr(found, name), getattr(wanted, name))


def test_a_sliver_between_split_vertices_is_a_face_that_blender_can_edit(scene_module, make):
    """Joined, it had a vertex twice: Unwrap along Cuts never came to an end, in Blender's Edit Mode."""
    mesh_arrays = scene_module("reading.mesh_arrays")
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 0, 1]])
    soup = make((square[faces].reshape(-1, 3), np.arange(9).reshape(3, 3))).data
    table = mesh_arrays.joined_table(soup)
    assert table.corner_vertex[6] == table.corner_vertex[7]
    mesh = mesh_arrays.mesh_of(table, "Joined")
    assert not mesh.validate()  # True where it had to be corrected
    found = mesh_arrays.corner_table(mesh)
    np.testing.assert_array_equal(found.vertices[found.corner_vertex], square[faces].reshape(-1, 3))
    np.testing.assert_array_equal(found.corner_vertex[:7], table.corner_vertex[:7])
