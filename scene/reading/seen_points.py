# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the vertices of a mesh are seen: in a pose, and as other modifiers move them."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays.indexing import sums_by
from ...core.arrays.int64 import arange
from ...core.arrays.vectors import cross
from ...core.mesh.corners import next_of_owner
from . import half_models, mesh_arrays

# Modifiers that move vertices or change what these carry, and such that put new ones behind those that there were.
_MOVE = {
    "ARMATURE", "CAST", "CLOTH", "CORRECTIVE_SMOOTH", "CURVE", "DATA_TRANSFER", "DISPLACE", "HOOK", "LAPLACIANDEFORM",
    "LAPLACIANSMOOTH", "LATTICE", "MESH_CACHE", "MESH_DEFORM", "NORMAL_EDIT", "SHRINKWRAP", "SIMPLE_DEFORM", "SMOOTH",
    "SOFT_BODY", "SURFACE_DEFORM", "UV_PROJECT", "UV_WARP", "VERTEX_WEIGHT_EDIT", "VERTEX_WEIGHT_MIX",
    "VERTEX_WEIGHT_PROXIMITY", "WARP", "WAVE", "WEIGHTED_NORMAL",
}
_DIVIDE = {"MULTIRES", "SUBSURF"}

_counts: dict[int, int] = {}  # by session_uid of objects: how often they were evaluated anew


def forget() -> None:
    """Free what is kept in memory."""
    _counts.clear()


def evaluated(obj: bpy.types.Object) -> None:
    """An object was evaluated anew."""
    _counts[obj.session_uid] = _counts.get(obj.session_uid, 0) + 1


def version(obj: bpy.types.Object) -> int:
    """A number that changes when an object with modifiers is evaluated anew; 0 without modifiers that are seen."""
    return 1 + _counts.get(obj.session_uid, 0) if _shown(obj) else 0


def seen_points(context: bpy.types.Context, obj: bpy.types.Object) -> np.ndarray:
    """Where each vertex of an object's mesh is seen, (n, 3) float32 in the object's coordinates; not in Edit Mode.

    Where modifiers make other faces than the mesh has and do not just divide them, as Remesh does, that is where it
    is without them; but for a Mirror that comes first.
    """
    points, own = mesh_arrays.shown_points(obj), obj.data
    if not _shown(obj):
        return points
    mesh = obj.evaluated_get(context.evaluated_depsgraph_get()).data
    seen = mesh_arrays.basis_points(mesh)
    if (len(mesh.polygons), len(mesh.loops)) == (len(own.polygons), len(own.loops)):
        before, after = mesh_arrays.corner_vertices(own), mesh_arrays.corner_vertices(mesh)
        if len(seen) == len(points) and np.array_equal(before, after):
            return seen
        points[before] = seen[after]  # where edges are split, there are more vertices
    elif {modifier.type for modifier in _shown(obj)} <= _MOVE | _DIVIDE and len(seen) > len(points):
        return seen[: len(points)]
    elif (both := seen_halves(context, obj)) is not None:
        points[mesh_arrays.corner_vertices(own)] = both[0]
    return points


def seen_corners(context: bpy.types.Context, obj: bpy.types.Object) -> np.ndarray | None:
    """Where each corner of each face is seen, (c, 3) float32 in the object's coordinates; not in Edit Mode.

    None if modifiers move nothing, or make other faces and do not just divide those that were moved. Of what a Mirror
    modifier mirrors first, these are its own corners, not those of the image.
    """
    shown = {modifier.type for modifier in _shown(obj)}
    if not shown:
        return None
    mesh, own = obj.evaluated_get(context.evaluated_depsgraph_get()).data, obj.data
    if (len(mesh.polygons), len(mesh.loops)) == (len(own.polygons), len(own.loops)):
        return mesh_arrays.basis_points(mesh)[mesh_arrays.corner_vertices(mesh)]
    both = seen_halves(context, obj)
    if both is not None:
        return both[0]
    if shown & _MOVE and shown <= _MOVE | _DIVIDE:
        return seen_points(context, obj)[mesh_arrays.corner_vertices(own)]
    return None


def seen_halves(context: bpy.types.Context, obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray] | None:
    """Where a model is seen that a Mirror modifier mirrors first: its own corners, and the faces of the image.

    In Blender the faces of the image come after those of the mesh, in the same order, and so do those that Subdivision
    makes of them; it leaves the vertices that it finds in front of its own.

    Returns
    -------
    corners : (c, 3) float32
        In the object's coordinates, as the next one.
    image : (p, 3) float64
        The middle of each face.

    None if nothing comes after the Mirror modifier, or if what does makes other faces; not in Edit Mode.
    """
    if half_models.mirror_of(obj) is None or len(_shown(obj)) < 2:
        return None
    mesh, own = obj.evaluated_get(context.evaluated_depsgraph_get()).data, obj.data
    vertex, points = mesh_arrays.corner_vertices(own), mesh_arrays.basis_points(mesh)
    after = {modifier.type for modifier in _shown(obj)[1:]}
    count, half = len(own.polygons), len(own.loops)
    if (len(mesh.polygons), len(mesh.loops)) == (2 * count, 2 * half):
        vertex, sizes = mesh_arrays.corner_vertices(mesh)[:half], np.ones(count, np.int64)
    elif after & _MOVE and after <= _MOVE | _DIVIDE and len(mesh.polygons) % (2 * half) == 0 < half:
        sizes = len(mesh.polygons) // (2 * half) * mesh_arrays.face_sizes(own).astype(np.int64)
    else:
        return None
    middles = mesh_arrays.face_middles(mesh)[0][len(mesh.polygons) // 2:]
    return points[vertex], sums_by(np.repeat(arange(count), sizes), middles, count) / sizes[:, None]


def corners(context: bpy.types.Context, obj: bpy.types.Object) -> np.ndarray:
    """As ``seen_corners``; where the object's own corners are if that knows none."""
    seen = seen_corners(context, obj)
    return mesh_arrays.shown_points(obj)[mesh_arrays.corner_vertices(obj.data)] if seen is None else seen


def seen_faces(context: bpy.types.Context, obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """The mean of the corners of each face as it is seen, and where it is turned to; not in Edit Mode.

    Returns two (p, 3) float64 in the object's coordinates; the second are as long as the faces are large.
    """
    seen, face = corners(context, obj).astype(np.float64), mesh_arrays.face_corners(obj.data)[1]
    count = len(obj.data.polygons)
    center = (sums_by(face, seen, count).T / np.bincount(face, minlength=count)).T
    arm = seen - center[face]
    return center, 0.5 * sums_by(face, cross(arm, arm[next_of_owner(face)]), count)


def _shown(obj: bpy.types.Object) -> list[bpy.types.Modifier]:
    return [modifier for modifier in obj.modifiers if modifier.show_viewport]
