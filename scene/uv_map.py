# SPDX-License-Identifier: GPL-3.0-or-later
"""Unwrap along cuts: a UV map of ours with an island for each part, or several where one would tear."""

from __future__ import annotations

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from . import mesh_arrays, part_meshes, store, transaction
from .errors import SceneError
from .modes import call_with, set_mode
from .selection import nothing_selected
from .temporary import removed

UV_MAP = "Reeb Parts UV"
MADE = "reeb_parts_uv"  # on the mesh: what Blender has called our map


def find(mesh: bpy.types.Mesh) -> bpy.types.MeshUVLoopLayer | None:
    """Our UV map, or None."""
    return mesh.uv_layers.get(mesh.get(MADE, ""))


def remove(mesh: bpy.types.Mesh) -> None:
    """Remove our UV map."""
    transaction.keep_mesh(mesh)
    transaction.keep_keys(mesh, MADE)
    layer = find(mesh)
    if layer is not None:
        mesh.uv_layers.remove(layer)
    if MADE in mesh:
        del mesh[MADE]


def unwrap(context: bpy.types.Context, obj: bpy.types.Object, face_numbers: np.ndarray, open_parts: bool,
           method: str) -> str:
    """Unwrap an object into our UV map, which becomes the active one; Object Mode. Returns the name of the map.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    face_numbers : (p,) int64
        Number of each face's part.
    open_parts : bool
        Cut tubes and closed parts open, so that they can be laid flat.
    method : str
        Of bpy.ops.uv.unwrap.
    """
    mesh = obj.data
    coordinates = _unwrapped(context, obj, _seams(obj, face_numbers, open_parts), method)
    transaction.keep_mesh(mesh)
    transaction.keep_keys(mesh, MADE)
    layer = find(mesh)
    if layer is None:
        layer = mesh.uv_layers.new(name=UV_MAP, do_init=False)
        if layer is None:
            raise SceneError(
                rpt_("{name} has as many UV maps as Blender allows. Remove one and try again.").format(name=mesh.name))
        mesh[MADE] = layer.name
        mesh.uv_layers.active = layer
    layer.uv.foreach_set("vector", coordinates)
    mesh.update()
    return layer.name


def _seams(obj: bpy.types.Object, face_numbers: np.ndarray, open_parts: bool) -> np.ndarray:
    """The user's seams, the cuts between parts and, if asked for, what opens parts; (e,) bool."""
    mesh = obj.data
    seams = mesh_arrays.read(mesh.edges, "use_seam", bool) | mesh_arrays.cut_edges(mesh, face_numbers)
    if open_parts:
        from ..core.uses.unfold import opening_seams  # imports SciPy

        points = mesh_arrays.shown_points(obj) @ store.stretch_of(mesh).T
        seams |= opening_seams(mesh_arrays.corner_table(mesh, points), seams)
    return seams


def _unwrapped(context: bpy.types.Context, obj: bpy.types.Object, seams: np.ndarray, method: str) -> np.ndarray:
    """The UV coordinates of each corner, flat float32; unwrapped on a copy, so that no selection is touched."""
    copy = part_meshes.plain_copy(obj.data)
    twin = bpy.data.objects.new(copy.name, copy)
    with removed(bpy.data.meshes, copy), removed(bpy.data.objects, twin):
        _prepare(twin, mesh_arrays.shown_points(obj) @ store.stretch_of(obj.data).T, seams)
        context.scene.collection.objects.link(twin)
        with nothing_selected(context.view_layer):
            _unwrap_all(context, twin, method)
        return mesh_arrays.read(copy.uv_layers.active.uv, "vector", np.float32, 2).ravel()


def _unwrap_all(context: bpy.types.Context, twin: bpy.types.Object, method: str) -> None:
    """Unwrap all faces of an object with Blender's operator, which works on the active object in Edit Mode."""
    twin.select_set(True)
    context.view_layer.objects.active = twin
    set_mode(twin, "EDIT")
    call_with(bpy.ops.uv.unwrap, twin, method=method, margin=0.005)
    set_mode(twin, "OBJECT")


def _prepare(twin: bpy.types.Object, points: np.ndarray, seams: np.ndarray) -> None:
    """Give a copy the shape that is seen, our seams, one UV map, and all selected."""
    mesh = twin.data
    if mesh.shape_keys:
        name = mesh.shape_keys.name
        twin.shape_key_clear()
        if left := bpy.data.shape_keys.get(name):  # before Blender 5, those of a copy stay, with a user too many
            bpy.data.batch_remove([left])
    mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
    mesh.edges.foreach_set("use_seam", seams)
    for items in (mesh.vertices, mesh.edges, mesh.polygons):
        items.foreach_set("hide", np.zeros(len(items), bool))
        items.foreach_set("select", np.ones(len(items), bool))
    for name in mesh.uv_layers.keys():  # noqa: SIM118
        mesh.uv_layers.remove(mesh.uv_layers[name])
    mesh.uv_layers.new(name=UV_MAP)
