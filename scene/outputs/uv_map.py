# SPDX-License-Identifier: GPL-3.0-or-later
"""Unwrap along cuts: a UV map of ours with an island for each part, or several where one would tear."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.indexing import renumbered
from ...core.arrays.int64 import full
from ...core.uses.maps.stacking import double_corners
from .. import store, transaction
from ..errors import SceneError
from ..modes import call_with, set_mode
from ..ours import made_objects
from ..reading import fingerprints, mesh_arrays
from ..showing.selection import nothing_selected
from ..store import Stored
from ..temporary import removed

if TYPE_CHECKING:
    from ...core.mesh.corners import CornerTable
    from ...core.uses.maps.distortion import Distortion

UV_MAP = "Reeb Parts UV"
MADE = "reeb_parts_uv"  # on the mesh: what Blender has called our map
WRITTEN = "reeb_parts_uv_digest"  # and what we wrote there, see _digest
FORMER = "reeb_parts_uv_former"  # and the map that was active before

# How many UV maps Blender allows.
_LAYERS = 8
# Between islands, as a share of the map.
_MARGIN = 0.005
# Blender's method of least stretch goes step by step; meshes of few, long faces need more steps, and have more time.
_FEWEST, _MOST, _FACES = 10, 100, 100_000


def find(mesh: bpy.types.Mesh) -> bpy.types.MeshUVLoopLayer | None:
    """Our UV map as we wrote it, or None: one that was changed since, or renamed, is the user's work."""
    layer = mesh.uv_layers.get(str(mesh.get(MADE, "")))
    return layer if layer is not None and _digest(layer) == mesh.get(WRITTEN) else None


def remove(mesh: bpy.types.Mesh) -> str:
    """Remove our UV map; the one that was active before is so again, unless the user has chosen another; Object Mode.

    Returns the name of one that was changed since and stays, or "".
    """
    transaction.keep_mesh(mesh)
    layer, name = find(mesh), str(mesh.get(MADE, ""))
    if layer is not None:
        active = mesh.uv_layers.active.name
        mesh.uv_layers.remove(layer)
        active = mesh.uv_layers.get(str(mesh.get(FORMER, "")) if active == name else active)
        if active is not None:
            mesh.uv_layers.active = active
    made_objects.hand_over(mesh, MADE, WRITTEN, FORMER)
    return name if name in mesh.uv_layers else ""


def _digest(layer: bpy.types.MeshUVLoopLayer) -> str:
    """Differs once a map was changed; Object Mode."""
    return fingerprints.digest(mesh_arrays.read(layer.uv, "vector", np.float32, 2))


def unwrap(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, open_parts: bool, method: str,
           stack: bool) -> tuple[str, Distortion]:
    """Unwrap an object into our UV map, which becomes the active one; Object Mode.

    One that the user has changed stays as it is, and a new one is made. Faces that lie on others, as on both sides of
    cloth and leaves, share the place of these in the map.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : Stored
    open_parts : bool
        Cut parts open where they would not lie flat.
    method : str
        "MINIMUM_STRETCH", or another of bpy.ops.uv.unwrap.
    stack : bool
        Lay parts that are exact mirror images of others over these.

    Returns
    -------
    name : str
        Of the map.
    distortion : Distortion

    Raises
    ------
    SceneError
        The mesh has as many maps as Blender allows.
    """
    mesh = obj.data
    if find(mesh) is None and len(mesh.uv_layers) >= _LAYERS:
        raise SceneError(
            rpt_("{name} has as many UV maps as Blender allows. Remove one and try again.").format(name=mesh.name))
    # Joined: parts hang together where only their vertices are split, as in .glb files, and so do their islands.
    table = mesh_arrays.joined_table(mesh, mesh_arrays.shown_points(obj) @ store.stretch_of(mesh).T)
    image = _images(table, stored) if stack else full(len(mesh.loops), -1)
    double = double_corners(table, ~_left_out(table, image))
    low, high = table.edge_labels(_of_faces_below(table, stored.face_numbers, double))
    seams = low < high
    by_hand = mesh_arrays.element_values(mesh, "edges", "use_seam")
    seams[table.corner_edge[by_hand[mesh_arrays.corner_edges(mesh)]]] = True
    if open_parts:
        seams |= _unfolding_seams(table, seams, _left_out(table, double))
    image = np.where(double >= 0, double, image)
    image = np.where((image >= 0) & (double[image] >= 0), double[image], image)  # images of doubles
    flat = _unwrapped(context, table, seams, method, image)
    flat = np.where(image[:, None] >= 0, flat[image], flat)
    return _write(mesh, flat), _distortion(table, flat, image)


def _left_out(table: CornerTable, image: np.ndarray) -> np.ndarray:
    """Faces that share the place of others, (p,) bool. image : (c,) int64, the corner that each is laid on, or -1."""
    left_out = np.zeros(table.n_faces, bool)
    left_out[table.corner_face[image >= 0]] = True
    return left_out


def _of_faces_below(table: CornerTable, numbers: np.ndarray, double: np.ndarray) -> np.ndarray:
    """Numbers of faces, (p,), where faces that lie on others have those of these. double : (c,) int64, or -1."""
    numbers, corner = numbers.copy(), np.flatnonzero(double >= 0)
    numbers[table.corner_face[corner]] = numbers[table.corner_face[double[corner]]]
    return numbers


def _unfolding_seams(table: CornerTable, cut: np.ndarray, left_out: np.ndarray) -> np.ndarray:
    """Edges to be cut so that all lies flat but for some faces, (e,) bool. cut : (e,) bool. left_out : (p,) bool."""
    from ...core.uses.maps.unfold import unfolding_seams  # imports SciPy

    rest = table.within(~left_out)
    faces, corner_face = renumbered(rest.corner_face)
    edges = np.unique(table.corner_edge[~left_out[table.corner_face]])
    seams = np.zeros(len(cut), bool)
    seams[edges] = unfolding_seams(replace(rest, corner_face=corner_face, n_faces=len(faces)), cut[edges])
    return seams


def _images(table: CornerTable, stored: Stored) -> np.ndarray:
    """The corner that each corner of a part is the exact mirror image of, (c,), -1 for none."""
    from ...core.uses.maps.stacking import image_corners

    decomposition, parts = stored.decomposition, stored.shown_parts().parts
    if decomposition.plane is None:
        return full(len(table.corner_vertex), -1)
    return image_corners(table, parts.labels, parts.side, decomposition.plane, decomposition.face_twin)


def _distortion(table: CornerTable, flat: np.ndarray, image: np.ndarray) -> Distortion:
    """What the map does, without faces that share the place of others."""
    from ...core.uses.maps.distortion import distortion

    alone = ~_left_out(table, image)
    return distortion(table.within(alone), flat[alone[table.corner_face]].astype(np.float64))


def _write(mesh: bpy.types.Mesh, flat: np.ndarray) -> str:
    """Write our map, which becomes the active one, and return its name. flat : (c, 2)."""
    transaction.keep_mesh(mesh)
    transaction.keep_keys(mesh, MADE, WRITTEN, FORMER)
    layer = find(mesh)
    if layer is None:
        if mesh.uv_layers.active is not None:
            mesh[FORMER] = mesh.uv_layers.active.name
        layer = mesh.uv_layers.new(name=UV_MAP, do_init=False)
        mesh[MADE] = layer.name
        mesh.uv_layers.active = layer
    layer.uv.foreach_set("vector", flat.ravel())
    mesh[WRITTEN] = _digest(layer)
    mesh.update()
    return layer.name


def _unwrapped(context: bpy.types.Context, table: CornerTable, seams: np.ndarray, method: str,
               image: np.ndarray) -> np.ndarray:
    """The UV coordinates of each corner, (c, 2) float32; unwrapped on a mesh of its own, of the table.

    seams : (e,) bool. Faces whose corners are images of others, (c,), are left out.
    """
    # At size 1: Blender's unwrapping has limits that are lengths and areas, below which models of millimeters are.
    low, size = table.vertices.min(axis=0), np.ptp(table.vertices, axis=0).max()
    mesh = mesh_arrays.mesh_of(replace(table, vertices=(table.vertices - low) / (size or 1.0)), UV_MAP)
    twin = bpy.data.objects.new(mesh.name, mesh)
    with removed(bpy.data.meshes, mesh), removed(bpy.data.objects, twin):
        seam = np.zeros(len(mesh.edges), bool)
        seam[mesh_arrays.corner_edges(mesh)] = seams[table.corner_edge]
        mesh_arrays.set_element_values(mesh, "edges", "use_seam", seam)
        for items in ("vertices", "edges", "polygons"):
            mesh_arrays.set_element_values(mesh, items, "select", np.ones(len(getattr(mesh, items)), bool))
        mesh_arrays.set_element_values(mesh, "polygons", "hide", _left_out(table, image))
        mesh.uv_layers.new(name=UV_MAP)
        context.scene.collection.objects.link(twin)
        with nothing_selected(context.view_layer):
            _unwrap_all(context, twin, method)
        return mesh_arrays.read(mesh.uv_layers.active.uv, "vector", np.float32, 2)


def _unwrap_all(context: bpy.types.Context, twin: bpy.types.Object, method: str) -> None:
    """Unwrap all faces of an object with Blender's operators, which work on the active object in Edit Mode."""
    twin.select_set(True)
    context.view_layer.objects.active = twin
    steps = int(np.clip(_FACES // max(len(twin.data.polygons), 1), _FEWEST, _MOST))
    set_mode(twin, "EDIT")
    known = bpy.ops.uv.unwrap.get_rna_type().properties["method"].enum_items.keys()
    if method != "MINIMUM_STRETCH":
        call_with(bpy.ops.uv.unwrap, twin, method=method, fill_holes=False, margin=_MARGIN)
    elif method in known:
        call_with(bpy.ops.uv.unwrap, twin, method=method, fill_holes=False, margin=_MARGIN, no_flip=True,
                  iterations=steps)
    else:  # before Blender 4.3
        call_with(bpy.ops.uv.unwrap, twin, method="ANGLE_BASED", fill_holes=False, margin=_MARGIN)
        call_with(bpy.ops.uv.minimize_stretch, twin, fill_holes=False, iterations=steps)
    call_with(bpy.ops.uv.average_islands_scale, twin)
    call_with(bpy.ops.uv.pack_islands, twin, margin=_MARGIN)
    set_mode(twin, "OBJECT")
