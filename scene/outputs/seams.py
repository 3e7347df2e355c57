# SPDX-License-Identifier: GPL-3.0-or-later
"""UV seams where parts meet, beside the user's own.

What is a seam elsewhere, or is none any more, is so because the user wanted it, before or since.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from .. import transaction
from ..reading import mesh_arrays
from . import face_attribute
from .kept_aside import PREFIX, is_kept, keep_aside, remove_attribute

_KEPT = f"{PREFIX}_seam"
# What is kept aside of each edge: whether we made it a seam, and whether it was one of the user's as well. Edges that
# come with another object have 0.
_OURS, _BOTH = 1, 2


def own(mesh: bpy.types.Mesh) -> np.ndarray:
    """Which edges are seams of the user, (e,) bool."""
    return (_theirs(mesh) & ~_merged(mesh) if is_kept(mesh, _KEPT, "has_seams")
            else mesh_arrays.element_values(mesh, "edges", "use_seam"))


def _theirs(mesh: bpy.types.Mesh) -> np.ndarray:
    """What ``own`` returns where something is kept aside."""
    now, kept = (mesh_arrays.element_values(mesh, "edges", "use_seam"),
                 mesh_arrays.attribute_values(mesh.attributes[_KEPT]))
    if kept.dtype == bool:  # by a version that kept the user's seams
        return now & kept
    return now & ((kept == 0) | (kept == _BOTH))


def _merged(mesh: bpy.types.Mesh) -> np.ndarray:
    """Which edges are seams of ours that became one with an edge that was none, (e,) bool.

    As Merge by Distance and Decimate do it: the edge is a seam then, but what was kept aside is that of the other one.
    It lies where parts met; there users have no reason to mark a seam, as there is one. More faces may be joined ones.
    """
    numbers = face_attribute.find(mesh)
    if numbers is None or len(mesh.polygons) >= mesh.reeb_parts.n_faces or mesh.attributes[_KEPT].data_type != "INT8":
        return np.zeros(len(mesh.edges), bool)
    kept = mesh_arrays.attribute_values(mesh.attributes[_KEPT])
    return (kept == 0) & mesh_arrays.cut_edges(mesh, mesh_arrays.attribute_values(numbers))


def claim_merged(mesh: bpy.types.Mesh) -> None:
    """Let seams of ours that were merged with other edges be ours, as long as faces have the numbers from before."""
    if is_kept(mesh, _KEPT, "has_seams") and (merged := _merged(mesh)).any():
        transaction.keep_mesh(mesh)
        kept = np.where(merged, _OURS, mesh_arrays.attribute_values(mesh.attributes[_KEPT]))
        mesh_arrays.set_attribute_values(mesh.attributes[_KEPT], kept.astype(np.int8))


def add(obj: bpy.types.Object) -> None:
    """Make room for which seams are ours."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    if not is_kept(mesh, _KEPT, "has_seams"):
        result.had_seams = _seam_name(mesh) is not None
        keep_aside(mesh, np.zeros(len(mesh.edges), np.int8), _KEPT, "INT8", "EDGE")
        result.has_seams = True


def remove(obj: bpy.types.Object) -> None:
    """Leave the user's seams alone again."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    claim_merged(mesh)
    if result.has_seams and _KEPT in mesh.attributes:
        seams = _theirs(mesh)
        remove_attribute(mesh, _KEPT)
        mesh_arrays.set_element_values(mesh, "edges", "use_seam", seams)
        if not result.had_seams and not seams.any() and (name := _seam_name(mesh)):
            remove_attribute(mesh, name)
    result.has_seams = result.had_seams = False


def take_back(mesh: bpy.types.Mesh, ours: np.ndarray) -> None:
    """Leave the user's seams alone of faces that came with ours from another mesh. ours : (p,) bool."""
    if _KEPT not in mesh.attributes or is_kept(mesh, _KEPT, "has_seams"):
        return
    now, came = mesh_arrays.element_values(mesh, "edges", "use_seam"), mesh_arrays.edges_of(mesh, ours)
    mesh_arrays.set_element_values(mesh, "edges", "use_seam", np.where(came, _theirs(mesh), now))
    remove_attribute(mesh, _KEPT)


def _seam_name(mesh: bpy.types.Mesh) -> str | None:
    """The attribute that holds seams, None before there is one."""
    return next((name for name in (".uv_seam", "uv_seam") if name in mesh.attributes), None)


def write(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Bring the seams up to date, if we have added some."""
    if not is_kept(mesh, _KEPT, "has_seams"):
        return
    theirs, cut = _theirs(mesh), mesh_arrays.cut_edges(mesh, numbered.face_numbers)
    if mesh.attributes[_KEPT].data_type != "INT8":
        keep_aside(mesh, np.zeros(len(cut), np.int8), _KEPT, "INT8", "EDGE")
    kept = np.where(cut, np.where(theirs, _BOTH, _OURS), 0)
    mesh_arrays.set_attribute_values(mesh.attributes[_KEPT], kept.astype(np.int8))
    mesh_arrays.set_element_values(mesh, "edges", "use_seam", theirs | cut)
