# SPDX-License-Identifier: GPL-3.0-or-later
"""What caps look like: where they are in the UV maps of a piece, and a material of their own."""

from __future__ import annotations

import bpy
import numpy as np

from ....core.arrays.indexing import run_starts
from ....core.arrays.int64 import arange
from ....core.mesh.corners import next_of_owner
from ....core.uses.caps.maps import cap_map
from ...reading import mesh_arrays
from . import caps

CAP_MATERIAL = "reeb_parts_cap"  # on a material: it is that of caps


def map_caps(mesh: bpy.types.Mesh) -> None:
    """Give the caps of a piece a place in each of its UV maps, right of what it has there; Object Mode.

    They are flat and as large, for their area, as the other faces together; nothing of the map is changed. A map in
    which the other faces have no area is left alone.
    """
    cap = caps.is_cap(mesh)
    if not cap.any() or not len(mesh.uv_layers):
        return
    points = mesh_arrays.basis_points(mesh).astype(np.float64)
    count = mesh_arrays.face_sizes(mesh)
    vertex, on_cap = mesh_arrays.corner_vertices(mesh), np.repeat(cap, count)
    face = np.repeat(arange(len(count)), count)
    area = mesh_arrays.read(mesh.polygons, "area", np.float32)[~cap].sum(dtype=np.float64)
    for layer in mesh.uv_layers:
        places = mesh_arrays.read(layer.uv, "vector", np.float32, 2)
        others = places[~on_cap].astype(np.float64)
        in_map = _area(others, face[~on_cap])
        if not len(others) or not area > 0 or not in_map > 0:
            continue
        density = float(np.sqrt(in_map / area))
        flat = cap_map(points, vertex[on_cap].astype(np.int64), face[on_cap], density)
        # The next tile: whole numbers, so that what repeats does not change where it begins.
        places[on_cap] = flat + [np.ceil(others[:, 0].max()), np.floor(others[:, 1].min())]
        layer.uv.foreach_set("vector", places.ravel())


def _area(places: np.ndarray, face: np.ndarray) -> float:
    """The area of faces in a map, without sign. places : (c, 2); face : (c,), rising."""
    if not len(face):
        return 0.0
    first = run_starts(face)
    x, y = (places - np.repeat(places[first], np.diff(np.append(first, len(face))), axis=0)).T
    ahead = next_of_owner(face)
    return float(np.abs(np.add.reduceat(x * y[ahead] - y * x[ahead], first)).sum() / 2)


def own_material(meshes: list[bpy.types.Mesh]) -> None:
    """Give the caps of pieces a material of their own, in a slot behind those that they have."""
    some = [(mesh, cap) for mesh in meshes if (cap := caps.is_cap(mesh)).any()]
    material = _material() if some else None
    for mesh, cap in some:
        if not len(mesh.materials):
            mesh.materials.append(None)  # the slot of all other faces, which have no material
        mesh.materials.append(material)
        slots = mesh_arrays.element_values(mesh, "polygons", "material_index")
        slots[cap] = len(mesh.materials) - 1
        mesh_arrays.set_element_values(mesh, "polygons", "material_index", slots)


def _material() -> bpy.types.Material:
    """The material of caps in this file, a new one if there is none."""
    for material in bpy.data.materials:
        if material.get(CAP_MATERIAL) and material.library is None and material.override_library is None:
            return material
    material = bpy.data.materials.new("Cap")
    material[CAP_MATERIAL] = True
    if bpy.app.version < (5, 0):  # newer ones always do
        material.use_nodes = True
    return material
