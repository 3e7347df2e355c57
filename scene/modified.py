# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh of an object as it is seen: with its modifiers applied, and the part of each face that they make."""

from __future__ import annotations

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from . import explode, hidden, mesh_arrays, quiet
from .errors import SceneError
from .kept import set_values, values_of
from .temporary import removed

_NUMBER = "reeb_parts_face_number"  # face attribute of the copy that is evaluated


def has_modifiers(obj: bpy.types.Object) -> bool:
    """Whether modifiers other than ours change what is seen of an object."""
    ours = explode.find(obj), hidden.find(obj)
    return any(modifier.show_viewport and modifier not in ours for modifier in obj.modifiers)


def seen_mesh(context: bpy.types.Context, obj: bpy.types.Object,
              face_numbers: np.ndarray) -> tuple[bpy.types.Mesh, np.ndarray]:
    """The mesh of an object with its modifiers and shape keys applied; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
        Stays as it is.
    face_numbers : (p,) int64
        Number of the part of each face before the modifiers, 1 or more.

    Returns
    -------
    mesh : bpy.types.Mesh
        New, for the caller to remove. What a modifier makes of a face is in the part of the face.
    seen_numbers : (q,) int64
        Number of the part of each of its faces.

    Raises
    ------
    SceneError
        The modifiers make faces that come from no face of the mesh, as Remesh does.
    """
    twin = obj.copy()
    twin.data = obj.data.copy()
    with removed(bpy.data.meshes, twin.data), removed(bpy.data.objects, twin):
        explode.forget(twin)
        hidden.forget(twin)
        twin.data.attributes.new(_NUMBER, "INT", "FACE").data.foreach_set("value", face_numbers.astype(np.int32))
        context.scene.collection.objects.link(twin)
        context.view_layer.update()
        depsgraph = context.evaluated_depsgraph_get()
        mesh = bpy.data.meshes.new_from_object(twin.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                               depsgraph=depsgraph)
        # What is ours on the new mesh is told by the result, which does not come along.
        with quiet.quiet():
            set_values(mesh.reeb_parts, values_of(obj.data.reeb_parts))
    numbers = _numbers(mesh)
    lost = int((numbers == 0).sum())
    if lost:
        bpy.data.meshes.remove(mesh)
        raise SceneError(
            rpt_("The modifiers of {name} make {n} {n:face that belongs|faces that belong} to no part. Apply the "
                 "modifiers "
                 "and decompose again.").format(name=obj.name, n=Count(lost)))
    return mesh, numbers


def _numbers(mesh: bpy.types.Mesh) -> np.ndarray:
    """Take the numbers of the parts off a mesh, (q,) int64; 0 where there is none."""
    attribute = mesh.attributes.get(_NUMBER)
    if attribute is None or attribute.domain != "FACE":
        return np.zeros(len(mesh.polygons), np.int64)
    numbers = mesh_arrays.read(attribute.data, "value", np.int32).astype(np.int64)
    mesh.attributes.remove(attribute)
    return numbers
