# SPDX-License-Identifier: GPL-3.0-or-later
"""The distance field that the parts come from, as a vertex attribute."""

from __future__ import annotations

import bpy
import numpy as np

from .kept_aside import add_attribute, remove_attribute

NAME = "reeb_agd"


def add(obj: bpy.types.Object) -> None:
    """Make the attribute with the distance field, unless it is there."""
    result = obj.data.reeb_parts
    result.field_attribute = add_attribute(obj.data, result.field_attribute, NAME, "FLOAT", "POINT")


def remove(obj: bpy.types.Object) -> None:
    """Remove the attribute with the distance field."""
    remove_attribute(obj.data, obj.data.reeb_parts.field_attribute)
    obj.data.reeb_parts.field_attribute = ""


def write(mesh: bpy.types.Mesh, field: np.ndarray) -> None:
    """Write the field, if the attribute is there. field : (n,) float64; nan, which vertices of no face have, is 0."""
    if attribute := mesh.attributes.get(mesh.reeb_parts.field_attribute):
        attribute.data.foreach_set("value", np.nan_to_num(field).astype(np.float32))
