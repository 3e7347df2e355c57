# SPDX-License-Identifier: GPL-3.0-or-later
"""UV seams where parts meet, beside the user's own."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from .. import transaction
from ..reading import mesh_arrays
from .kept_aside import PREFIX, is_kept, keep_aside, remove_attribute, taken_out

_KEPT = f"{PREFIX}_seam"


def own(mesh: bpy.types.Mesh) -> np.ndarray:
    """Which edges are seams of the user, (e,) bool."""
    if is_kept(mesh, _KEPT, "has_seams"):
        return mesh_arrays.attribute_values(mesh.attributes[_KEPT])
    return mesh_arrays.element_values(mesh, "edges", "use_seam")


def add(obj: bpy.types.Object) -> None:
    """Keep aside which seams the user has."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    if not is_kept(mesh, _KEPT, "has_seams"):
        result.had_seams = _seam_name(mesh) is not None
        keep_aside(mesh, mesh_arrays.element_values(mesh, "edges", "use_seam"), _KEPT, "BOOLEAN", "EDGE")
        result.has_seams = True


def remove(obj: bpy.types.Object) -> None:
    """Leave the user's seams alone again."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    if result.has_seams and _KEPT in mesh.attributes:
        seams = taken_out(mesh, _KEPT)
        mesh_arrays.set_element_values(mesh, "edges", "use_seam", seams)
        if not result.had_seams and not seams.any() and (name := _seam_name(mesh)):
            remove_attribute(mesh, name)
    result.has_seams = result.had_seams = False


def take_back(mesh: bpy.types.Mesh, numbers: np.ndarray) -> None:
    """Bring the user's seams back of faces that came with ours from another mesh.

    numbers : (p,) int32, of the parts of these faces, 0 for others.
    """
    if _KEPT not in mesh.attributes:
        return
    now, before = (mesh_arrays.element_values(mesh, "edges", "use_seam"),
                   mesh_arrays.read(mesh.attributes[_KEPT].data, "value", bool))
    cut = mesh_arrays.cut_edges(mesh, numbers) & _edges_of(mesh, numbers > 0)
    if now[cut].all():  # else the other mesh had none of ours, and nothing kept aside
        mesh_arrays.set_element_values(mesh, "edges", "use_seam", np.where(cut, before, now))
    if not is_kept(mesh, _KEPT, "has_seams"):
        remove_attribute(mesh, _KEPT)


def keep(mesh: bpy.types.Mesh, new: np.ndarray, numbers: np.ndarray) -> None:
    """Keep the seams aside of faces that were joined into a mesh with ours, but for those where parts meet.

    new : (p,) bool. numbers : (p,) int32, of the parts of faces, 0 for others.
    """
    if is_kept(mesh, _KEPT, "has_seams"):
        now, before = (mesh_arrays.element_values(mesh, "edges", "use_seam"),
                       mesh_arrays.read(mesh.attributes[_KEPT].data, "value", bool))
        there = _edges_of(mesh, new) & ~_edges_of(mesh, ~new) & ~mesh_arrays.cut_edges(mesh, numbers)
        mesh.attributes[_KEPT].data.foreach_set("value", np.where(there, now, before))


def _edges_of(mesh: bpy.types.Mesh, faces: np.ndarray) -> np.ndarray:
    """The edges of some faces, (e,) bool. faces : (p,) bool."""
    there = np.zeros(len(mesh.edges), bool)
    there[mesh_arrays.corner_edges(mesh)[np.repeat(faces, mesh_arrays.face_sizes(mesh))]] = True
    return there


def _seam_name(mesh: bpy.types.Mesh) -> str | None:
    """The attribute that holds seams, None before there is one."""
    return next((name for name in (".uv_seam", "uv_seam") if name in mesh.attributes), None)


def write(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Bring the seams up to date, if we have added some."""
    if not is_kept(mesh, _KEPT, "has_seams"):
        return
    seams = mesh_arrays.read(mesh.attributes[_KEPT].data, "value", bool)
    seams |= mesh_arrays.cut_edges(mesh, numbered.face_numbers)
    mesh_arrays.set_element_values(mesh, "edges", "use_seam", seams)
