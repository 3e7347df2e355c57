# SPDX-License-Identifier: GPL-3.0-or-later
"""Half models: objects whose first modifier is a Mirror, which makes the other half of what is seen."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays.int64 import arange
from ...core.arrays.vectors import box_diagonal
from ...core.symmetry.halves import is_one_side
from .mesh_arrays import basis_points
from .placing import world_matrix

_ROUNDING = 1e-4  # by how much the axes of a mirror object may be no axes of a mirror, and a plane another one
_TINY = np.finfo(np.float64).tiny


def mirror_of(obj: bpy.types.Object) -> bpy.types.Modifier | None:
    """The Mirror modifier of an object whose mesh is a half model by its modifiers; None if it is none.

    It is the first, is shown, and mirrors once, without cutting anything off.
    """
    first = next(iter(obj.modifiers), None)
    if first is None or first.type != "MIRROR" or not first.show_viewport or sum(first.use_axis) != 1:
        return None
    return None if any(first.use_bisect_axis) else first


def moves_with_its_image(obj: bpy.types.Object, matrix: np.ndarray, offset: np.ndarray) -> bool:
    """Whether an object that was moved within its coordinates is seen as it was: it is no half model, or a plane of its
    own axes mirrors it that was where it is. Where another object mirrors it, nobody knows how that lay before.

    matrix : (3, 3) float64. offset : (3,) float64, added then.
    """
    modifier = mirror_of(obj)
    if modifier is None:
        return True
    flip = np.where(modifier.use_axis, -1.0, 1.0)
    turned = np.abs(matrix - flip[:, None] * matrix * flip).max() / np.linalg.norm(matrix)
    moved = np.abs(offset - flip * offset).max() / max(box_diagonal(basis_points(obj.data)), _TINY)
    return modifier.mirror_object is None and bool(max(turned, moved) <= _ROUNDING)


def half_plane(obj: bpy.types.Object, vertices: np.ndarray, stretch: np.ndarray) -> np.ndarray:
    """The plane behind which a Mirror modifier puts the other half of a shape.

    Parameters
    ----------
    obj : bpy.types.Object
    vertices : (n, 3) float64
        Of its shape; see ``bridge.Shape``.
    stretch : (3, 3) float64
        Takes the mesh's coordinates to those of the shape.

    Returns
    -------
    plane : (4,) float64 or (0,)
        Normal of length 1, and distance from the origin along it, in coordinates of the shape. Empty if there is no
        such modifier, if the mesh lies on both sides of its plane, or if what it makes is no mirror image of the shape.
    """
    nothing, modifier = np.empty(0), mirror_of(obj)
    if modifier is None:
        return nothing
    local = np.eye(4)
    if modifier.mirror_object is not None:
        local = np.array(world_matrix(modifier.mirror_object).inverted_safe() @ world_matrix(obj), dtype=np.float64)
    axis = list(modifier.use_axis).index(True)
    length = np.linalg.norm(local[axis, :3])
    image = np.linalg.pinv(local) @ np.diag(np.where(arange(4) == axis, -1.0, 1.0)) @ local  # of points of the mesh
    if not length > 0 or not np.isfinite(image).all():
        return nothing
    normal = np.linalg.pinv(stretch) @ (local[axis, :3] / length)  # covariant
    plane = np.append(normal, -local[axis, 3] / length) / np.linalg.norm(normal)
    # The modifier mirrors along an axis of the mirror object, which scales and shears may have turned off the normal.
    seen = stretch @ image[:3, :3] @ np.linalg.pinv(stretch)
    mirrored = np.eye(3) - 2.0 * np.outer(plane[:3], plane[:3])
    if np.abs(seen - mirrored).max() > _ROUNDING or not is_one_side(vertices, plane):
        return nothing
    return plane
