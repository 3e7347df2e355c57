# SPDX-License-Identifier: GPL-3.0-or-later
"""What a transaction keeps: a mesh with all that is on it, and the values of property groups; brought back in place.

Brought back in place, since whoever holds the mesh - Blender in the midst of a slider's drag, a script - goes on with
it. It has to be exact and need not be fast: it is done when something has gone wrong.
"""

from __future__ import annotations

from typing import Any

import bpy

from . import targets
from .reading import mesh_arrays


def values_of(group: bpy.types.PropertyGroup) -> dict[str, Any]:
    """The properties of a group that are set, and those of the groups in it."""
    return {prop.identifier: _value(group, prop) for prop in group.bl_rna.properties
            if (not prop.is_readonly and group.is_property_set(prop.identifier)) or prop.type == "COLLECTION"}


def _value(group: bpy.types.PropertyGroup, prop: bpy.types.Property) -> Any:
    """The value of one property: a list of dicts of a collection, a tuple of an array."""
    value = getattr(group, prop.identifier)
    if prop.type == "COLLECTION":
        return [values_of(item) for item in value]
    return value[:] if getattr(prop, "is_array", False) else value


def set_values(group: bpy.types.PropertyGroup, values: dict[str, Any]) -> None:
    """Set the properties of a group as ``values_of`` gave them, and no others."""
    for _ in range(2):  # some set others, as a preset does
        _set_once(group, values)


def _set_once(group: bpy.types.PropertyGroup, values: dict[str, Any]) -> None:
    """Set what differs or is not set, and unset what is not among the values."""
    for prop in group.bl_rna.properties:
        name = prop.identifier
        if name not in values:
            if not prop.is_readonly and group.is_property_set(name):
                group.property_unset(name)
        elif prop.type == "COLLECTION":
            _set_items(getattr(group, name), values[name])
        elif not group.is_property_set(name) or _value(group, prop) != values[name]:
            setattr(group, name, values[name])


def _set_items(items: bpy.types.bpy_prop_collection, values: list[dict[str, Any]]) -> None:
    """Make the items of a collection anew, where they differ."""
    if [values_of(item) for item in items] != values:
        items.clear()
        for entry in values:
            set_values(items.add(), entry)


class MeshCopy:
    """A mesh as it was: its attributes, vertex groups, materials, and what is active of them; Object Mode.

    Attributes
    ----------
    copy : bpy.types.Mesh
        Shares its arrays with the mesh until they are written.
    """

    def __init__(self, mesh: bpy.types.Mesh) -> None:
        self.mesh = mesh
        self.copy = mesh.copy()
        self.materials = mesh.materials[:]
        for index in range(len(self.materials)):  # not to count as users
            self.copy.materials[index] = None
        self.copy.property_unset("reeb_parts")
        self.users = targets.users(mesh)
        self.slots = [[(slot.link, slot.material) for slot in obj.material_slots] for obj in self.users]
        self.active_slots = [obj.active_material_index for obj in self.users]
        self.groups = [(group.name, group.lock_weight) for group in self.users[0].vertex_groups] if self.users else []
        self.active_group = self.users[0].vertex_groups.active_index if self.users else -1

    def restore(self) -> None:
        """Have the mesh as it was."""
        self._restore_materials()
        self._restore_groups()
        self._restore_attributes()
        mesh_arrays.set_active(self.mesh, self.copy)
        self.mesh.update()

    def _restore_materials(self) -> None:
        materials = self.mesh.materials
        if materials[:] != self.materials:
            for index in range(min(len(materials), len(self.materials))):
                materials[index] = self.materials[index]
            for material in self.materials[len(materials) :]:
                materials.append(material)
            while len(materials) > len(self.materials):
                materials.pop()
            if not self.materials:
                materials.clear()  # popping the last one leaves an empty slot on the objects
        for obj, slots, active in zip(self.users, self.slots, self.active_slots, strict=True):
            for slot, (link, material) in zip(obj.material_slots, slots, strict=True):
                if (slot.link, slot.material) != (link, material):
                    slot.link, slot.material = link, material
            if obj.active_material_index != active:
                obj.active_material_index = active

    def _restore_groups(self) -> None:
        if not self.users:
            return
        obj = self.users[0]
        if [(group.name, group.lock_weight) for group in obj.vertex_groups] != self.groups:
            obj.vertex_groups.clear()
            for name, lock in self.groups:
                obj.vertex_groups.new(name=name).lock_weight = lock
        groups = list(obj.vertex_groups)
        for now, then in zip(self.mesh.vertices, self.copy.vertices, strict=True):
            before = [(entry.group, entry.weight) for entry in then.groups]
            after = [(entry.group, entry.weight) for entry in now.groups]
            if after != before:
                for group, _ in after:
                    groups[group].remove([now.index])
                for group, weight in before:
                    groups[group].add([now.index], weight, "REPLACE")
        if obj.vertex_groups.active_index != self.active_group:
            obj.vertex_groups.active_index = self.active_group

    def _restore_attributes(self) -> None:
        mesh, copy = self.mesh, self.copy
        there = _names(copy)
        for kind, names in _names(mesh).items():
            wanted = there.get(kind, [])
            same = next((i for i, pair in enumerate(zip(names, wanted, strict=False)) if pair[0] != pair[1]),
                        min(len(names), len(wanted)))
            for name in names[same:]:
                mesh.attributes.remove(mesh.attributes[name])
        for name in [name for names in there.values() for name in names]:
            if name not in mesh.attributes:
                mesh.attributes.new(name, copy.attributes[name].data_type, copy.attributes[name].domain)
        for name in [attribute.name for attribute in copy.attributes]:
            if name in mesh.attributes:
                _copy_values(copy.attributes[name], mesh.attributes[name])


def _names(mesh: bpy.types.Mesh) -> dict[tuple[str, str], list[str]]:
    """The names of the attributes that can be removed, in their order, which Blender 4 keeps by type and domain."""
    found: dict[tuple[str, str], list[str]] = {}
    for attribute in mesh.attributes:
        if not attribute.is_required:
            kind = (attribute.data_type, attribute.domain) if bpy.app.version < (5, 0) else ("", "")
            found.setdefault(kind, []).append(attribute.name)
    return found


def _copy_values(source: bpy.types.Attribute, target: bpy.types.Attribute) -> None:
    before, after = mesh_arrays.attribute_values(source), mesh_arrays.attribute_values(target)
    if before.tobytes() != after.tobytes() or before.dtype == object:
        mesh_arrays.set_attribute_values(target, before)
