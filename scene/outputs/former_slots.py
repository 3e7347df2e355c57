# SPDX-License-Identifier: GPL-3.0-or-later
"""Which material slots faces have as the user has it, while parts have materials of their own.

The slot of each face is kept aside, and of each slot the material: none of them is used meanwhile, so that the user may
move its slot, or have Blender remove it. ``result.former_slots`` keeps them in the file, too.
"""

from __future__ import annotations

from collections.abc import Container

import bpy
import numpy as np

from ..reading import mesh_arrays
from . import kept_aside

#: The attribute of Blender with the slot of each face.
INDEX = "material_index"
_KEPT = f"{kept_aside.PREFIX}_material"


def is_kept(mesh: bpy.types.Mesh) -> bool:
    """Whether they are kept aside, for the mesh's own result."""
    return kept_aside.is_kept(mesh, _KEPT, "has_materials")


def found(mesh: bpy.types.Mesh) -> np.ndarray | None:
    """The slots that are kept aside, (p,) int32, for whichever result; None if none are."""
    return mesh_arrays.attribute_values(mesh.attributes[_KEPT]) if _KEPT in mesh.attributes else None


def of_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """The material slot of each face, (p,) int32, as the user has it."""
    return mesh_arrays.attribute_values(mesh.attributes[_KEPT]) if is_kept(mesh) else used_now(mesh)


def used_now(mesh: bpy.types.Mesh) -> np.ndarray:
    """The material slot that each face uses, (p,) int32."""
    return mesh_arrays.element_values(mesh, "polygons", INDEX)


def keep(mesh: bpy.types.Mesh) -> None:
    """Keep aside the slots that faces use, before parts have materials."""
    mesh.reeb_parts.had_material_index = INDEX in mesh.attributes
    kept_aside.keep_aside(mesh, used_now(mesh), _KEPT, "INT", "FACE")
    mesh.reeb_parts.former_slots.clear()
    _remember(mesh, ())


def keep_since(mesh: bpy.types.Mesh, ours: Container[bpy.types.Material | None]) -> None:
    """Keep aside the slots of faces that have none of ours: new faces, and those to which the user gave another.

    An empty slot counts of new ones alone; of others it may be that of a part's material, which was deleted.
    """
    former = mesh.reeb_parts.former_slots
    if not len(former):  # as in a result of a version that did not remember them
        _remember(mesh, ours)
    now, slots = used_now(mesh), of_faces(mesh)
    known, changed = [slot.material for slot in former], False
    for index, material in enumerate(mesh.materials):
        if material in ours:
            continue
        there = now == index
        if material is None:
            there[: mesh.reeb_parts.n_faces] = False
        there &= ~np.isin(slots, [place for place, other in enumerate(known) if other == material])
        if there.any():
            if material not in known:
                former.add().material = material
                known.append(material)
            slots[there], changed = known.index(material), True
    if changed:
        mesh_arrays.set_attribute_values(mesh.attributes[_KEPT], slots)


def _remember(mesh: bpy.types.Mesh, ours: Container[bpy.types.Material | None]) -> None:
    """Remember the materials in the slots, without ours."""
    for material in [material for material in mesh.materials if material not in ours] or [None]:
        mesh.reeb_parts.former_slots.add().material = material


def bring_back(mesh: bpy.types.Mesh) -> None:
    """Have each face use the slot with the material that it had; nothing is kept aside any more."""
    if is_kept(mesh):
        slots = places(mesh, kept_aside.taken_out(mesh, _KEPT))
        mesh_arrays.set_element_values(mesh, "polygons", INDEX, slots)
        if not mesh.reeb_parts.had_material_index and not slots.any():
            kept_aside.remove_attribute(mesh, INDEX)
    mesh.reeb_parts.had_material_index = False
    mesh.reeb_parts.former_slots.clear()


def forget(mesh: bpy.types.Mesh) -> None:
    """Keep nothing aside any more."""
    kept_aside.remove_attribute(mesh, _KEPT)


def places(mesh: bpy.types.Mesh, former: np.ndarray) -> np.ndarray:
    """The slots in which the materials of former ones are now, (p,) int32; those that are missing are made again."""
    materials = [slot.material for slot in mesh.reeb_parts.former_slots]
    used, place = np.unique(former, return_inverse=True)
    # A result of a version that did not remember them has none.
    slots = [_place(mesh, materials, index) if 0 <= index < len(materials) else index for index in used.tolist()]
    return np.array(slots, np.int32)[place.ravel()]


def _place(mesh: bpy.types.Mesh, materials: list[bpy.types.Material | None], index: int) -> int:
    """What ``places`` does for one slot."""
    now, material = list(mesh.materials), materials[index]
    if material in now[index : index + 1] or (material is None and not now):
        return index
    if material in now:
        return now.index(material)
    if material is not None and index < len(materials) <= len(now) and now[index] not in materials:
        return index  # the user has put another one there
    mesh.materials.append(material)
    return len(now)
