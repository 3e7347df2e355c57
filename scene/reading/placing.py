# SPDX-License-Identifier: GPL-3.0-or-later
"""Where objects are in the world, evaluated or not, how they get there, and how long its unit is."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Matrix


def world_matrix(obj: bpy.types.Object) -> Matrix:
    """Where an object is, also one that Blender does not evaluate and whose own ``matrix_world`` may be out of date.

    Such are objects of excluded or disabled collections and of other scenes, and those disabled in viewports. Of these
    parents count that are objects; constraints, and parents that are bones or vertices, are as they were last seen.
    """
    parent = obj.parent
    if _is_evaluated(obj) or obj.constraints or (parent and obj.parent_type != "OBJECT"):
        return obj.matrix_world.copy()
    return (world_matrix(parent) @ obj.matrix_parent_inverse if parent else Matrix()) @ obj.matrix_basis


def transformed(points: np.ndarray, matrix: Matrix | np.ndarray) -> np.ndarray:
    """Points, (n, 3), where a matrix, (4, 4), takes them: (n, 3) float64."""
    matrix = np.array(matrix, np.float64)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def put(item: bpy.types.Object, matrix: Matrix) -> None:
    """Put an object whose mesh is ours at a place.

    What shears, as a parent with another scale along each axis does, is no place of an object: then its mesh is moved.
    """
    if is_alike(Matrix.LocRotScale(*matrix.decompose()), matrix):
        item.matrix_world = matrix
        return
    move(item.data, matrix)


def move(mesh: bpy.types.Mesh, matrix: Matrix) -> None:
    """Move a mesh that is ours, with its shape keys; faces of its mirror image look out as those of the mesh do."""
    mesh.transform(matrix, shape_keys=True)
    if matrix.determinant() < 0:
        mesh.flip_normals()


def is_alike(one: Matrix, other: Matrix) -> bool:
    """Whether two places are one, but for rounding."""
    return bool(np.abs(np.array(one) - np.array(other)).max() <= 1e-5 * max(np.abs(np.array(other)).max(), 1e-30))


def millimeters() -> float:
    """Length of a unit of the scene in millimeters; 1 in scenes without units."""
    units = bpy.context.scene.unit_settings
    return 1.0 if units.system == "NONE" else 1000.0 * units.scale_length


def length_words(length: float) -> str:
    """A length in units of the world, as Blender says lengths in this scene: "8.363 mm", "329.3 thou"."""
    units = bpy.context.scene.unit_settings
    if units.system == "NONE":
        return f"{length:.4g}"
    return bpy.utils.units.to_string(units.system, "LENGTH", length * units.scale_length, precision=4)


def _is_evaluated(obj: bpy.types.Object) -> bool:
    """Whether the window's dependency graph has an object."""
    return obj.visible_get() or any(
        found.original == obj for found in bpy.context.evaluated_depsgraph_get().objects)
