# SPDX-License-Identifier: GPL-3.0-or-later
"""All outputs of the parts together, and the list that the panel shows; Object Mode.

Each output is a module with ``add(obj)``, which makes room for it, ``write``, which brings it up to date with
the parts, and ``remove(obj)``, which takes it back. What was made is remembered in ``mesh.reeb_parts`` under the
name that Blender gave it, so that nothing of the user's is touched, not even under the same name.
"""

from __future__ import annotations

import json
from typing import Any

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from ...core.uses.colors import PALETTE, PALETTES, number_colors, number_places
from .. import property_updates, transaction
from ..result import part_names, part_places
from . import colors, face_attribute, face_sets, field, materials, seams, vertex_groups

#: The outputs by the names of their switches, see properties.OutputProperties.
OUTPUTS = {
    "vertex_groups": vertex_groups, "face_attribute": face_attribute, "colors": colors, "field": field,
    "face_sets": face_sets, "materials": materials, "seams": seams,
}


def write_outputs(obj: bpy.types.Object, numbered: NumberedParts, distances: np.ndarray, outputs: Any) -> None:
    """Write the chosen outputs, and take back what an earlier run wrote and this one does not want.

    What a button has switched on stays until it is switched off there.

    Parameters
    ----------
    obj : bpy.types.Object
    numbered : NumberedParts
    distances : (n,) float64
        The field.
    outputs
        Has the switches of properties.OutputProperties.
    """
    transaction.keep_mesh(obj.data)
    face_sets.keep_drawn(obj.data)
    vertex_groups.remove(obj)
    stay = obj.data.reeb_parts.by_button.split()
    for name, output in OUTPUTS.items():
        (output.add if name in stay or getattr(outputs, name) else output.remove)(obj)
    obj.data.reeb_parts.palette = outputs.palette
    field.write(obj.data, distances)
    update_outputs(obj, numbered)


def switch(obj: bpy.types.Object, name: str, on: bool) -> None:
    """Add an output to an object, or remove it, because its button was pressed; ``update_outputs`` writes it."""
    (OUTPUTS[name].add if on else OUTPUTS[name].remove)(obj)
    others = [other for other in obj.data.reeb_parts.by_button.split() if other != name]
    obj.data.reeb_parts.by_button = " ".join([*others, name] if on else others)


def update_outputs(obj: bpy.types.Object, numbered: NumberedParts, before: np.ndarray | None = None) -> None:
    """Bring the list and all that was written up to date with the parts.

    Parameters
    ----------
    obj : bpy.types.Object
    numbered : NumberedParts
    before : (c,) int64, optional
        Numbers of the candidates' parts as they are written now, so that only what differs is written
        where writing is slow.
    """
    mesh = obj.data
    transaction.keep_mesh(mesh)
    materials.keep(mesh)
    face_sets.keep_drawn(mesh)
    old = part_names.number_colors(mesh)
    gone = _list_parts(mesh, numbered)
    new = part_names.number_colors(mesh)
    # Colors first: what evaluates the scene there finds nothing else changed yet.
    colors.write(mesh, numbered.face_numbers, new, _recolored(numbered, before, old, new))
    for group, _ in gone:
        vertex_groups.remove_one(obj, group)
    materials.remove_these(mesh, [material for _, material in gone])
    vertex_groups.write(obj, numbered, before)
    for output in (face_attribute, materials, face_sets, seams):
        output.write(mesh, numbered)
    mesh.update()


def update_colors(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Bring the color attribute and the materials up to date with the colors of the list, which stays."""
    transaction.keep_mesh(mesh)
    materials.keep(mesh)
    colors.write(mesh, numbered.face_numbers, part_names.number_colors(mesh))
    materials.write(mesh, numbered)
    mesh.update()


def _recolored(numbered: NumberedParts, before: np.ndarray | None, old: np.ndarray,
               new: np.ndarray) -> np.ndarray | None:
    """The faces whose color changes, None if that is not known."""
    if before is None:
        return None
    same = np.zeros(len(new), bool)
    both = min(len(old), len(new))
    same[:both] = (old[:both] == new[:both]).all(axis=1)
    changed = (before != numbered.candidate_numbers) | ~same[numbered.candidate_numbers]
    return np.flatnonzero(changed[numbered.candidates])


def remove_outputs(obj: bpy.types.Object) -> None:
    """Take back all that was written to the mesh; the result itself stays."""
    transaction.keep_mesh(obj.data)
    for output in reversed(OUTPUTS.values()):  # face sets before the numbers that tell which of them are ours
        output.remove(obj)
    obj.data.update()


def _list_parts(mesh: bpy.types.Mesh, numbered: NumberedParts) -> list:
    """Fill the list of parts; what is known of a number stays.

    Returns the vertex group and the material of each part that was in the list and is gone.
    """
    result = mesh.reeb_parts
    active = result.parts[result.active].number if 0 <= result.active < len(result.parts) else 0
    keys = ("group", "material", "locked", "only_locked", "selected")
    known = {part.number: [getattr(part, key) for key in keys] for part in result.parts}
    wanted = numbered.numbers.tolist()
    shades = _part_colors(mesh, numbered)
    own_names, kept_names = numbered.names, part_names.kept_names(mesh)
    middles = part_places.middles(mesh, numbered)
    with property_updates.quiet():
        result.parts.clear()
        for label, number in enumerate(wanted):
            part = result.parts.add()
            part.number = number
            part.own_name = own_names[label]
            part.name = part_names.shown_name(number, own_names[label], kept_names)
            part.color = shades[label]
            part.share = numbered.parts.share[label]
            part.is_ground = bool(numbered.parts.ground[label])
            part.middle = middles[label]
            for key, value in zip(keys, known.get(number, ()), strict=False):
                setattr(part, key, value)
        result.active = wanted.index(active) if active in wanted else 0
        result.n_parts = len(wanted)
    return [values[:2] for number, values in known.items() if number not in wanted]


def palette_colors(mesh: bpy.types.Mesh, numbered: NumberedParts) -> np.ndarray:
    """The color of each part from the mesh's palette, (count, 3) float64 sRGB."""
    return number_colors(numbered, _palette(mesh), _former_places(mesh))


def keep_places(mesh: bpy.types.Mesh, numbered: NumberedParts) -> None:
    """Remember the colors of the parts, for those of a later result that take over their numbers."""
    mesh.reeb_parts.color_places = json.dumps(number_places(numbered, _palette(mesh), _former_places(mesh)))


def _palette(mesh: bpy.types.Mesh) -> np.ndarray:
    return PALETTES.get(mesh.reeb_parts.palette, PALETTE)


def _former_places(mesh: bpy.types.Mesh) -> tuple[tuple[int, int], ...]:
    """Numbers of parts, and the place in the palette of the color that each had in an earlier result."""
    try:
        return tuple((int(number), int(place) % len(PALETTE)) for number, place in
                     json.loads(mesh.reeb_parts.color_places or "[]"))
    except (ValueError, TypeError):  # not written by us
        return ()


def _part_colors(mesh: bpy.types.Mesh, numbered: NumberedParts) -> np.ndarray:
    """The color of each part, (count, 3) float64 sRGB: what the user chose, or else of the palette."""
    shades = palette_colors(mesh, numbered)
    for number, color in part_names.kept_colors(mesh).items():
        shades[numbered.numbers == number] = color
    return shades
