# SPDX-License-Identifier: GPL-3.0-or-later
"""A face set for each part, for Sculpt Mode."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from .. import transaction
from .kept_aside import PREFIX, add_attribute, bring_back, keep_aside, remove_attribute

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
        keep_aside(mesh, mesh.attributes[NAME].data, "value", _KEPT, "INT", "FACE")
    else:
        add_attribute(mesh, "", NAME, "INT", "FACE")
    result.has_face_sets = True


def remove(obj: bpy.types.Object) -> None:
    """Bring the user's face sets back, or none."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    if result.has_face_sets:
        if result.had_face_sets and _KEPT in mesh.attributes:
            bring_back(mesh, lambda: mesh.attributes[NAME].data, "value", _KEPT)
        else:
            remove_attribute(mesh, NAME)
    result.has_face_sets = result.had_face_sets = False


def write(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Bring the face sets up to date, if they are ours."""
    if mesh.reeb_parts.has_face_sets:
        mesh.attributes[NAME].data.foreach_set("value", numbered.face_numbers.astype(np.int32))
