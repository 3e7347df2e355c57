# SPDX-License-Identifier: GPL-3.0-or-later
"""Modifiers that work by the whole mesh they get, as by its extent: a piece would be shaped otherwise."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Vector

from ..reading import mesh_arrays
from ..showing import explode, hidden
from ..temporary import removed


def array_offsets(context: bpy.types.Context, obj: bpy.types.Object) -> dict[str, Vector]:
    """The constant offset that does the same as a relative one, for each Array modifier that has one; Object Mode.

    Returns
    -------
    offsets : dict of str -> Vector
        By the name of the modifier, in the coordinates of the mesh.
    """
    offsets = {}
    for index, modifier in enumerate(obj.modifiers):
        if modifier.type == "ARRAY" and modifier.use_relative_offset:
            constant = modifier.constant_offset_displace if modifier.use_constant_offset else (0.0, 0.0, 0.0)
            extent = _extent_before(context, obj, index)
            offsets[modifier.name] = Vector(constant) + extent * Vector(modifier.relative_offset_displace)
    return offsets


def set_offsets(piece: bpy.types.Object, offsets: dict[str, Vector]) -> None:
    """Have the Array modifiers of a piece put its copies where those of the object put them; see ``array_offsets``."""
    for name, offset in offsets.items():
        modifier = piece.modifiers.get(name)
        if modifier is not None:
            modifier.use_relative_offset, modifier.use_constant_offset = False, True
            modifier.constant_offset_displace = offset


def others(obj: bpy.types.Object) -> list[str]:
    """The names of modifiers that shape by extent and cannot be told to keep to that of the object."""
    return [modifier.name for modifier in obj.modifiers
            if modifier.show_viewport and (modifier.type == "SIMPLE_DEFORM" or _casts_by_extent(modifier))]


def made_for_all(obj: bpy.types.Object, closed: bool) -> list[str]:
    """The names of modifiers that know the vertices of the object, move them along normals, or are of solids.

    closed : whether pieces are solids.
    """
    return [modifier.name for modifier in obj.modifiers
            if modifier.show_viewport and (_knows_vertices(modifier) or _follows_normals(modifier)
                                           or (not closed and modifier.type in {"BOOLEAN", "REMESH"}))]


def _knows_vertices(modifier: bpy.types.Modifier) -> bool:
    """Whether a modifier is bound to the vertices of its mesh, or has their indices."""
    if modifier.type in {"SURFACE_DEFORM", "MESH_DEFORM"}:
        return modifier.is_bound
    if modifier.type in {"LAPLACIANDEFORM", "CORRECTIVE_SMOOTH"}:
        return modifier.is_bind
    return modifier.type == "HOOK" and not modifier.vertex_group and len(modifier.vertex_indices) > 0


def _follows_normals(modifier: bpy.types.Modifier) -> bool:
    """Whether a modifier moves vertices along their normals, which are others where a piece was cut off."""
    if modifier.type == "DISPLACE":
        return modifier.direction in {"NORMAL", "CUSTOM_NORMAL"} and modifier.strength != 0.0
    if modifier.type != "SHRINKWRAP" or modifier.target is None:
        return False
    axes = modifier.use_project_x, modifier.use_project_y, modifier.use_project_z
    return modifier.offset != 0.0 or (modifier.wrap_method == "PROJECT" and not any(axes))


def _casts_by_extent(modifier: bpy.types.Modifier) -> bool:
    """Whether a modifier is a Cast without a size of its own."""
    if modifier.type != "CAST":
        return False
    return (modifier.radius if modifier.use_radius_as_size else modifier.size) <= 0.0


def _extent_before(context: bpy.types.Context, obj: bpy.types.Object, index: int) -> Vector:
    """The extent of the mesh that a modifier gets, by its place in the stack; 0 where it gets no vertices."""
    twin = obj.copy()
    with removed(bpy.data.objects, twin):
        explode.forget(twin)
        hidden.forget(twin)
        twin.hide_viewport = False  # or Blender would not evaluate it
        for modifier in list(twin.modifiers)[index:]:
            twin.modifiers.remove(modifier)
        context.scene.collection.objects.link(twin)
        context.view_layer.update()
        mesh = twin.evaluated_get(context.evaluated_depsgraph_get()).data
        points = mesh_arrays.read(mesh.vertices, "co", np.float32, 3)
        return Vector(np.ptp(points, axis=0).tolist()) if len(points) else Vector()
