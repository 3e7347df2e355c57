# SPDX-License-Identifier: GPL-3.0-or-later
"""A material for each part, in the part's color."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from ...core.uses.colors import linear
from .. import renaming, transaction
from ..reading import mesh_arrays
from ..result import part_names
from . import former_slots

_OURS = "reeb_parts_material"  # on a material: it was made for a part; the name that we gave it


def add(obj: bpy.types.Object) -> None:
    """Keep aside which material slot each face uses."""
    transaction.keep_mesh(obj.data)
    if not obj.data.reeb_parts.has_materials:
        former_slots.keep(obj.data)
        obj.data.reeb_parts.has_materials = True


def remove(obj: bpy.types.Object) -> None:
    """Remove our materials and their slots; each face uses the slot it used before."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    keep(mesh)
    remove_these(mesh, [part.material for part in result.parts])
    former_slots.bring_back(mesh)
    result.has_materials = False


def keep(mesh: bpy.types.Mesh) -> None:
    """Keep aside what faces were given since the materials were written, before they are written anew or removed."""
    if former_slots.is_kept(mesh):
        former_slots.keep_since(mesh, _own(mesh))


def take_back(mesh: bpy.types.Mesh, ours: np.ndarray) -> None:
    """Remove the materials of another mesh's parts from faces that came with them. ours : (p,) bool.

    Blender has renumbered the slots, but not those kept aside: these are counted among the slots that no other face
    uses, as the other mesh had them.
    """
    own, kept, marked, before = _own(mesh), former_slots.is_kept(mesh), of_others(mesh), former_slots.found(mesh)
    if before is not None and marked:
        now = former_slots.used_now(mesh)
        used = set((former_slots.places(mesh, before[~ours]) if kept else now[~ours]).tolist())
        free = [index for index, material in enumerate(mesh.materials) if material not in {*own, *marked}]
        theirs = np.array([index for index in free if index not in used] or free or [0], np.int32)
        slots = np.where(_uses(now, mesh, marked), theirs[np.clip(before, 0, len(theirs) - 1)], now)
        mesh_arrays.set_element_values(mesh, "polygons", former_slots.INDEX, slots)
        remove_these(mesh, marked)
    if not kept:
        former_slots.forget(mesh)


def of_others(mesh: bpy.types.Mesh) -> list[bpy.types.Material]:
    """The materials that were made for parts of another mesh, as far as they have the names that we gave them."""
    own = _own(mesh)
    return [material for material in mesh.materials
            if material is not None and material not in own and material.get(_OURS) == material.name]


def _own(mesh: bpy.types.Mesh) -> set[bpy.types.Material]:
    """The materials of the mesh's own parts."""
    parts = mesh.reeb_parts.parts if mesh.is_property_set("reeb_parts") else ()
    return {part.material for part in parts if part.material is not None}


def _uses(slots: np.ndarray, mesh: bpy.types.Mesh, materials: Container[bpy.types.Material]) -> np.ndarray:
    """Whether slots, (p,), hold some of these materials, (p,) bool."""
    return np.isin(slots, [index for index, material in enumerate(mesh.materials) if material in materials])


def remove_these(mesh: bpy.types.Mesh, made: Iterable[bpy.types.Material | None]) -> None:
    """Remove materials that were made for parts, with their slots; in one pass, as there may be thousands."""
    gone = dict.fromkeys(material for material in made if material is not None)
    if not gone:
        return
    drop_slots(mesh, gone)
    if not len(mesh.materials):
        mesh.materials.clear()  # popping the last one leaves an empty slot on the objects
    for part in mesh.reeb_parts.parts:
        if part.material in gone:
            part.material = None
    for material in gone:
        if material.users == 0:
            transaction.discard(material)


def drop_slots(mesh: bpy.types.Mesh, gone: Container[bpy.types.Material]) -> None:
    """Remove the slots of some materials."""
    for index, material in reversed(list(enumerate(mesh.materials))):
        if material in gone:
            mesh.materials.pop(index=index)


def write(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Give each part a material and a slot, in the part's color of the list, if the materials are ours."""
    if not mesh.reeb_parts.has_materials:
        return
    shared = _shared(mesh, mesh.reeb_parts.parts)
    _have_own_(mesh, [part for part in mesh.reeb_parts.parts if part.material in shared
                      and (_is_misnamed(part) or not _has_color(part.material, _rgba(part)))])
    _take_names(mesh)
    slots, places = np.zeros(numbered.parts.count, np.int32), {}
    for index, material in enumerate(mesh.materials):
        places.setdefault(material, index)
    first = None
    for label, part in enumerate(mesh.reeb_parts.parts):
        if part.material is None:
            part.material = first = _new(part.name, first)
        _color_material(part.material, _rgba(part))
        if part.material not in places:
            places[part.material] = len(mesh.materials)
            mesh.materials.append(part.material)
        slots[label] = places[part.material]
    mesh_arrays.set_element_values(mesh, "polygons", former_slots.INDEX, slots[numbered.parts.labels])


def _new(name: str, like: bpy.types.Material | None) -> bpy.types.Material:
    """A material for a part, made like another one that is new, if there is one.

    For each that it makes from nothing Blender goes through all node trees that there are.
    """
    if like is None:
        material = bpy.data.materials.new(name)
        if bpy.app.version < (5, 0):  # newer ones always do
            material.use_nodes = True
    else:
        material = like.copy()
        renaming.rename(material, name)
    material[_OURS] = material.name
    return material


def _take_names(mesh: bpy.types.Mesh) -> None:
    """Give the materials the names of their parts, which may have been those of each other."""
    wrong = [part for part in mesh.reeb_parts.parts if _is_misnamed(part)]
    for part in wrong:
        _name(part.material, "Reeb Parts")  # no name is in the way of another one
    for part in wrong:
        if _is_misnamed(part):
            _name(part.material, part.name)


def rename(part: bpy.types.PropertyGroup) -> None:
    """Give the part's material, if there is one, the part's name, unless the user has given it another."""
    if _is_misnamed(part):
        if _shared(part.id_data, [part]):
            _have_own_(part.id_data, [part])
        _name(part.material, part.name)


def _is_misnamed(part: bpy.types.PropertyGroup) -> bool:
    """Whether the part's material has a name that we gave it, and this is not the part's, be it with a number behind.

    Materials of other models have their names, too: most have a number.
    """
    material = part.material
    if material is None or not material.is_editable or material.get(_OURS) != material.name:
        return False
    return part_names.without_number(material.name) != part.name != material.name


def _name(material: bpy.types.Material, name: str) -> None:
    """Give a material a name, or the nearest that is free, and remember that it is ours."""
    transaction.keep_keys(material, _OURS)
    transaction.keep(material, "name")
    renaming.rename(material, name)
    material[_OURS] = material.name


def _shared(mesh: bpy.types.Mesh, parts: Iterable[bpy.types.PropertyGroup]) -> set[bpy.types.Material]:
    """The materials of some parts of a mesh that are those of another mesh's, too, as a copy of a model has them."""
    # A slot and the list use it; else there is no need to look at all other meshes.
    several = {part.material for part in parts if part.material is not None and part.material.users > 2}
    return several and several & set().union(*(_own(other) for other in bpy.data.meshes if other != mesh))


def _have_own_(mesh: bpy.types.Mesh, parts: Collection[bpy.types.PropertyGroup]) -> None:
    """Give some parts of a mesh copies of their materials, so that a change of them is none of another model's."""
    if not parts:
        return
    transaction.keep_mesh(mesh)
    transaction.keep_result(mesh)
    copies = {}
    for part in parts:
        former = part.material
        copies[former] = part.material = own = former.copy()
        if former.get(_OURS) == former.name:
            own[_OURS] = own.name
    for index, material in enumerate(mesh.materials):
        if material in copies:
            mesh.materials[index] = copies[material]


def _rgba(part: bpy.types.PropertyGroup) -> tuple[float, ...]:
    """The color of a part's material, to the last bit as Blender keeps it."""
    return tuple(np.array((*linear(part.color), 1.0), np.float32).tolist())


def _has_color(material: bpy.types.Material, color: tuple[float, ...]) -> bool:
    return all(getattr(block, name)[:] == color for block, name in _colors(material))


def _color_material(material: bpy.types.Material, color: tuple[float, ...]) -> None:
    """Give a material a color; what has it already is left alone, as Blender takes a millisecond for each change."""
    for block, name in _colors(material):
        if getattr(block, name)[:] != color:
            transaction.keep(block, name)
            setattr(block, name, color)


def _colors(material: bpy.types.Material) -> list[tuple[bpy.types.bpy_struct, str]]:
    """What has the color of a material, and under which name."""
    nodes = [node.inputs["Base Color"] for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"]
    return [(material, "diffuse_color"), *((node, "default_value") for node in nodes)]
