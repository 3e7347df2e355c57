# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes of ours on a mesh, and what stood there before, kept aside in hidden attributes.

The names of hidden attributes start with a dot: Blender does not show them and carries them through edits.
"""

from __future__ import annotations

import bpy
import numpy as np

from .. import targets
from ..reading import mesh_arrays
from ..result import part_names

#: How the names of all attributes begin in which values of the user are kept aside.
PREFIX = ".reeb_former"


def find_attribute(mesh: bpy.types.Mesh, name: str, kind: str, domain: str) -> bpy.types.Attribute | None:
    """An attribute of ours; None if it is gone, or was converted since into one of the user's."""
    attribute = mesh.attributes.get(name) if name else None
    return attribute if attribute is not None and (attribute.data_type, attribute.domain) == (kind, domain) else None


def add_attribute(mesh: bpy.types.Mesh, known: str, name: str, kind: str, domain: str) -> str:
    """The name of an attribute of ours: the known one if it is still there, or a new one beside any of the user's."""
    if find_attribute(mesh, known, kind, domain) is not None:
        return known
    index = mesh.attributes.active_index
    # With the name of a vertex group, Blender 4 makes none.
    groups = {name for obj in targets.users(mesh)[:1] for name in obj.vertex_groups.keys()}
    name = mesh.attributes.new(part_names.distinct(name, groups.union(mesh.attributes.keys())), kind, domain).name
    mesh.attributes.active_index = index
    return name


def remove_attribute(mesh: bpy.types.Mesh, name: str) -> None:
    """Remove an attribute, if it is there; the active one stays active."""
    attribute = mesh.attributes.get(name) if name else None
    if attribute is not None:
        active = mesh.attributes.active
        kept = active.name if active else ""
        mesh.attributes.remove(attribute)
        if kept in mesh.attributes:
            mesh.attributes.active = mesh.attributes[kept]


def keep_aside(mesh: bpy.types.Mesh, values: np.ndarray, name: str, kind: str, domain: str) -> None:
    """Copy a value of each element into a hidden attribute."""
    remove_attribute(mesh, name)
    name = add_attribute(mesh, "", name, kind, domain)
    mesh.attributes[name].data.foreach_set("value", values)


def is_kept(mesh: bpy.types.Mesh, name: str, flag: str) -> bool:
    """Whether a hidden attribute is there, and the result stored with the mesh says by a flag that it counts."""
    # To ask a mesh without a result for it would give it an empty one.
    return name in mesh.attributes and mesh.is_property_set("reeb_parts") and getattr(mesh.reeb_parts, flag)


def taken_out(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    """The values that a hidden attribute keeps, to go back to where they came from; it is removed."""
    values = mesh_arrays.attribute_values(mesh.attributes[name])
    remove_attribute(mesh, name)
    return values
