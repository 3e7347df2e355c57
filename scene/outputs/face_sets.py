# SPDX-License-Identifier: GPL-3.0-or-later
"""A face set for each part, for Sculpt Mode."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from .. import transaction
from ..reading import mesh_arrays
from . import face_attribute
from .kept_aside import PREFIX, add_attribute, find_attribute, keep_aside, remove_attribute, taken_out

NAME = ".sculpt_face_set"
_KEPT = f"{PREFIX}_face_set"


def add(obj: bpy.types.Object) -> None:
    """Put our face sets where the user's were; those are kept aside."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    if result.has_face_sets and NAME in mesh.attributes:
        return
    result.had_face_sets = NAME in mesh.attributes
    if result.had_face_sets:
        keep_aside(mesh, mesh_arrays.attribute_values(mesh.attributes[NAME]), _KEPT, "INT", "FACE")
    else:
        add_attribute(mesh, "", NAME, "INT", "FACE")
    result.has_face_sets = True


def remove(obj: bpy.types.Object) -> None:
    """Bring the user's face sets back, or none."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    keep_drawn(mesh)
    result = mesh.reeb_parts
    if result.has_face_sets:
        if result.had_face_sets and _KEPT in mesh.attributes:
            values = taken_out(mesh, _KEPT)
            mesh.attributes[NAME].data.foreach_set("value", values)
        else:
            remove_attribute(mesh, NAME)
    result.has_face_sets = result.had_face_sets = False


def take_back(mesh: bpy.types.Mesh, numbers: np.ndarray) -> None:
    """Bring the user's face sets back of faces that came with ours from another mesh, or none.

    numbers : (p,) int32, of the parts of these faces, 0 for others.
    """
    if NAME in mesh.attributes:
        now = mesh_arrays.read(mesh.attributes[NAME].data, "value", np.int32)
        before = np.ones_like(now)
        if _KEPT in mesh.attributes:
            before = mesh_arrays.read(mesh.attributes[_KEPT].data, "value", np.int32)
        if _are_of_parts(mesh, now, numbers):
            others = now[numbers == 0]
            if _are_ours(mesh):  # what comes back of these then
                others = before[numbers == 0] if mesh.reeb_parts.had_face_sets else np.ones_like(others)
            now = np.where(numbers > 0, _apart(before, numbers > 0, others), now)
            mesh.attributes[NAME].data.foreach_set("value", now)
        if not _are_ours(mesh) and (now <= 1).all():  # one set is none
            remove_attribute(mesh, NAME)
    if not _are_ours(mesh):
        remove_attribute(mesh, _KEPT)


def _apart(sets: np.ndarray, joined: np.ndarray, others: np.ndarray) -> np.ndarray:
    """The face sets of faces that were joined, (p,) bool, raised as by Blender's Join so that other faces have none.

    sets : (p,) int32. others : (k,) int32, those of the other faces; 1 at most where there are none.
    """
    own = sets[joined]
    shared = np.isin(own, others).any() and max(own.max(), others.max()) > 1
    return sets + others.max() if shared else sets


def came_by_join(mesh: bpy.types.Mesh, numbers: np.ndarray) -> bool:
    """Whether faces have face sets of the parts of another mesh, which Blender's Join has raised.

    numbers : (p,) int32, of the parts of these faces, 0 for others.
    """
    sets = find_attribute(mesh, NAME, "INT", "FACE")
    if sets is None:
        return False
    now = mesh_arrays.read(sets.data, "value", np.int32)
    return _are_of_parts(mesh, now, numbers) and bool((now != numbers)[numbers > 0].any())


def lower(mesh: bpy.types.Mesh, numbers: np.ndarray) -> None:
    """Take back what Blender's Join has added to face sets of ours on copies of the mesh's own parts.

    numbers : (p,) int32, of the parts of these faces, 0 for others.
    """
    if _are_ours(mesh) and came_by_join(mesh, numbers):
        now = mesh_arrays.read(mesh.attributes[NAME].data, "value", np.int32)
        mesh.attributes[NAME].data.foreach_set("value", np.where(numbers > 0, numbers, now))


def keep(mesh: bpy.types.Mesh, new: np.ndarray, numbers: np.ndarray) -> None:
    """Keep the face sets aside of faces that were joined into a mesh with ours, but for ours.

    new : (p,) bool. numbers : (p,) int32, of the parts of faces, 0 for others.
    """
    if not _are_ours(mesh) or NAME not in mesh.attributes:
        return
    now = mesh_arrays.read(mesh.attributes[NAME].data, "value", np.int32)
    _keep_aside(mesh, now, new & (now != numbers))


def keep_drawn(mesh: bpy.types.Mesh) -> None:
    """Keep the face sets aside that were drawn over ours since, which the parts, or nothing, will take the place of.

    Where the numbers of the parts are not written as an attribute, nobody knows them.
    """
    sets = find_attribute(mesh, NAME, "INT", "FACE") if _are_ours(mesh) else None
    written = face_attribute.find(mesh) if sets else None
    if not sets or not written:
        return
    numbers, now = (mesh_arrays.read(each.data, "value", np.int32) for each in (written, sets))
    if not _are_of_parts(mesh, now, numbers):
        _keep_aside(mesh, now, (numbers > 0) & (now != numbers))


def _are_of_parts(mesh: bpy.types.Mesh, sets: np.ndarray, numbers: np.ndarray) -> bool:
    """Whether the face sets of all faces of parts, numbers above 0, are these; (p,) int32 each.

    Blender's Join adds a number to all of an object, a larger one to each that follows, so that no two objects share a
    face set.
    """
    known = np.flatnonzero(numbers > 0)
    added = np.diff((sets - numbers)[known])
    first = known[1:][added > 0]
    if (added < 0).any():
        return False
    return not len(first) or bool(np.diff(mesh_arrays.blocks(mesh))[first - 1].all())


def _keep_aside(mesh: bpy.types.Mesh, now: np.ndarray, some: np.ndarray) -> None:
    """Have the face sets of some faces, (p,) bool, come back as they are now, (p,) int32, when ours go."""
    had = mesh.reeb_parts.had_face_sets and _KEPT in mesh.attributes
    if had or (now[some] > 1).any():
        before = mesh_arrays.read(mesh.attributes[_KEPT].data, "value", np.int32) if had else np.ones_like(now)
        keep_aside(mesh, np.where(some, now, before), _KEPT, "INT", "FACE")
        mesh.reeb_parts.had_face_sets = True


def _are_ours(mesh: bpy.types.Mesh) -> bool:
    """Whether the face sets are those of the mesh's own parts."""
    return mesh.is_property_set("reeb_parts") and mesh.reeb_parts.has_face_sets


def write(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Bring the face sets up to date, if they are ours."""
    attribute = find_attribute(mesh, NAME, "INT", "FACE")
    if mesh.reeb_parts.has_face_sets and attribute:
        attribute.data.foreach_set("value", numbered.face_numbers.astype(np.int32))
