# SPDX-License-Identifier: GPL-3.0-or-later
"""The number of each face's part as an attribute."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from .. import transaction
from .kept_aside import add_attribute, find_attribute, remove_attribute

NAME = "reeb_part"


def find(mesh: bpy.types.Mesh) -> bpy.types.Attribute | None:
    """The attribute, if it is there."""
    return find_attribute(mesh, mesh.reeb_parts.face_attribute, "INT", "FACE")


def add(obj: bpy.types.Object) -> None:
    """Make the attribute with each face's part number, unless it is there."""
    transaction.keep_mesh(obj.data)
    result = obj.data.reeb_parts
    result.face_attribute = add_attribute(obj.data, result.face_attribute, NAME, "INT", "FACE")


def remove(obj: bpy.types.Object) -> None:
    """Remove the attribute with each face's part number."""
    remove_attribute(obj.data, obj.data.reeb_parts.face_attribute)
    obj.data.reeb_parts.face_attribute = ""


def write(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Bring the numbers up to date, if the attribute is there."""
    if attribute := find(mesh):
        attribute.data.foreach_set("value", numbered.face_numbers.astype(np.int32))
