# SPDX-License-Identifier: GPL-3.0-or-later
"""A material for each part, in the part's color."""

from __future__ import annotations

from collections.abc import Container, Iterable

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from ...core.uses.colors import linear
from .. import renaming, transaction
from ..reading import mesh_arrays
from ..result import part_names
from .kept_aside import PREFIX, is_kept, keep_aside, remove_attribute, taken_out

_MATERIAL_INDEX = "material_index"
_KEPT = f"{PREFIX}_material"
_OURS = "reeb_parts_material"  # on a material: it was made for a part; the name that we gave it


def own_slots(mesh: bpy.types.Mesh) -> np.ndarray:
    """The material slot of each face, (p,) int32, as the user has it."""
    if is_kept(mesh, _KEPT, "has_materials"):
        return mesh_arrays.attribute_values(mesh.attributes[_KEPT])
    return mesh_arrays.element_values(mesh, "polygons", _MATERIAL_INDEX)


def add(obj: bpy.types.Object) -> None:
    """Keep aside which material slot each face uses."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    if not result.has_materials:
        result.had_material_index = _MATERIAL_INDEX in mesh.attributes
        keep_aside(mesh, mesh_arrays.element_values(mesh, "polygons", _MATERIAL_INDEX), _KEPT, "INT", "FACE")
        _keep_slots(mesh)
        result.has_materials = True


def remove(obj: bpy.types.Object) -> None:
    """Remove our materials and their slots; each face uses the slot it used before."""
    transaction.keep_mesh(obj.data)
    mesh = obj.data
    result = mesh.reeb_parts
    keep(mesh)
    remove_these(mesh, [part.material for part in result.parts])
    if result.has_materials and _KEPT in mesh.attributes:
        slots = _brought_back(mesh, taken_out(mesh, _KEPT))
        mesh_arrays.set_element_values(mesh, "polygons", _MATERIAL_INDEX, slots)
        if not result.had_material_index and not slots.any():
            remove_attribute(mesh, _MATERIAL_INDEX)
    result.has_materials = result.had_material_index = False
    result.former_slots.clear()


def _keep_slots(mesh: bpy.types.Mesh) -> None:
    """Remember the materials in the slots, which the user may move or, as none of them is used, remove."""
    own = _own(mesh)
    mesh.reeb_parts.former_slots.clear()
    for material in [material for material in mesh.materials if material not in own] or [None]:
        mesh.reeb_parts.former_slots.add().material = material


def _brought_back(mesh: bpy.types.Mesh, former: np.ndarray) -> np.ndarray:
    """The slots in which the materials of former ones are now, (p,) int32; those that are missing are made again."""
    materials = [slot.material for slot in mesh.reeb_parts.former_slots]
    used, place = np.unique(former, return_inverse=True)
    # A result of a version that did not remember them has none.
    slots = [_brought_back_one(mesh, materials, index) if 0 <= index < len(materials) else index
             for index in used.tolist()]
    return np.array(slots, np.int32)[place.ravel()]


def _brought_back_one(mesh: bpy.types.Mesh, materials: list[bpy.types.Material | None], index: int) -> int:
    """What ``_brought_back`` does for one slot."""
    now, material = list(mesh.materials), materials[index]
    if material in now[index : index + 1] or (material is None and not now):
        return index
    if material in now:
        return now.index(material)
    if material is not None and index < len(materials) <= len(now) and now[index] not in materials:
        return index  # the user has put another one there
    mesh.materials.append(material)
    return len(now)


def take_back(mesh: bpy.types.Mesh, ours: np.ndarray) -> None:
    """Remove the materials of another mesh's parts from faces that came with them. ours : (p,) bool.

    Blender has renumbered the slots, but not those kept aside: these are counted among the slots that no other face
    uses, as the other mesh had them.
    """
    own, kept, marked = _own(mesh), is_kept(mesh, _KEPT, "has_materials"), of_others(mesh)
    if _KEPT in mesh.attributes and marked:
        now, before = (mesh_arrays.element_values(mesh, "polygons", _MATERIAL_INDEX),
                       mesh_arrays.read(mesh.attributes[_KEPT].data, "value", np.int32))
        used = set((_brought_back(mesh, before[~ours]) if kept else now[~ours]).tolist())
        free = [index for index, material in enumerate(mesh.materials) if material not in {*own, *marked}]
        theirs = np.array([index for index in free if index not in used] or free or [0], np.int32)
        slots = np.where(_uses(now, mesh, marked), theirs[np.clip(before, 0, len(theirs) - 1)], now)
        mesh_arrays.set_element_values(mesh, "polygons", _MATERIAL_INDEX, slots)
        remove_these(mesh, marked)
    if not kept:
        remove_attribute(mesh, _KEPT)


def of_others(mesh: bpy.types.Mesh) -> list[bpy.types.Material]:
    """The materials that were made for parts of another mesh, as far as they have the names that we gave them."""
    own = _own(mesh)
    return [material for material in mesh.materials
            if material is not None and material not in own and material.get(_OURS) == material.name]


def keep(mesh: bpy.types.Mesh) -> None:
    """Keep aside which slots faces use that have none of ours: new ones, and those to which the user gave another.

    An empty slot counts of new ones alone; of others it may be that of a part's material, which was deleted.
    """
    if not is_kept(mesh, _KEPT, "has_materials"):
        return
    former, slots = mesh.reeb_parts.former_slots, mesh_arrays.read(mesh.attributes[_KEPT].data, "value", np.int32)
    if not len(former):  # as in a result of a version that did not remember them
        _keep_slots(mesh)
    now, own = mesh_arrays.element_values(mesh, "polygons", _MATERIAL_INDEX), _own(mesh)
    known = [slot.material for slot in former]
    for index, material in enumerate(mesh.materials):
        if material in own:
            continue
        there = now == index
        if material is None:
            there[: mesh.reeb_parts.n_faces] = False
        if there.any():
            if material not in known:
                former.add().material = material
                known.append(material)
            slots[there] = known.index(material)
    mesh.attributes[_KEPT].data.foreach_set("value", slots)


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
    _take_names(mesh)
    slots, places = np.zeros(numbered.parts.count, np.int32), {}
    for index, material in enumerate(mesh.materials):
        places.setdefault(material, index)
    first = None
    for label, part in enumerate(mesh.reeb_parts.parts):
        if part.material is None:
            part.material = first = _new(part.name, first)
        _color_material(part.material, linear(part.color))
        if part.material not in places:
            places[part.material] = len(mesh.materials)
            mesh.materials.append(part.material)
        slots[label] = places[part.material]
    mesh_arrays.set_element_values(mesh, "polygons", _MATERIAL_INDEX, slots[numbered.parts.labels])


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
        rename(part)


def rename(part: bpy.types.PropertyGroup) -> None:
    """Give the part's material, if there is one, the part's name, unless the user has given it another."""
    if _is_misnamed(part):
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


def _color_material(material: bpy.types.Material, color: np.ndarray) -> None:
    """Give a material a color; what has it already is left alone, as Blender takes a millisecond for each change."""
    nodes = [node.inputs["Base Color"] for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"]
    wanted = tuple(np.array((*color, 1.0), np.float32).tolist())
    for block, name in ((material, "diffuse_color"), *((node, "default_value") for node in nodes)):
        if getattr(block, name)[:] != wanted:
            transaction.keep(block, name)
            setattr(block, name, wanted)
