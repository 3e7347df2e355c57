# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of parts: which parts are chosen in it, which one is active."""

from __future__ import annotations

import re
from collections.abc import Container
from functools import lru_cache

import bmesh
import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Matrix

from ...core.arrays.indexing import inverse
from .. import property_updates, store, targets, transaction
from ..changes.settled import reaction
from ..errors import SceneError
from ..pieces import origins
from ..reading import mesh_arrays

# Up to so many parts there is no need to fold the small ones.
_SHORT = 12


def check_parts(obj: bpy.types.Object | None) -> None:
    """Raise SceneError unless the parts of an object can be worked on."""
    if not store.has_parts(obj):
        # After Separate a piece is active.
        original = origins.original(obj) if obj is not None else None
        if original is not None:
            raise SceneError(rpt_("Select the original, {name}, first.").format(name=original.name))
        if obj is not None and targets.is_foreign(obj):
            targets.check_object(obj)  # nor can it be decomposed
        raise SceneError(rpt_("Decompose the mesh first"))
    targets.check_object(obj)
    assert obj is not None
    store.check_list(obj.data)


def active_number(mesh: bpy.types.Mesh) -> int:
    """The number of the part that is active in the list."""
    result = mesh.reeb_parts
    return result.parts[result.active].number


def chosen_numbers(mesh: bpy.types.Mesh) -> list[int]:
    """Numbers of the parts marked in the list; of the active part if none is marked."""
    result = mesh.reeb_parts
    marked = [part.number for part in result.parts if part.selected]
    return marked or [part.number for part in result.parts[result.active : result.active + 1]]


def wanted_numbers(mesh: bpy.types.Mesh, which: str) -> list[int]:
    """Numbers of all parts, or of those chosen in the list. which : "ALL" or "CHOSEN"."""
    if which == "CHOSEN":
        return chosen_numbers(mesh)
    return [part.number for part in mesh.reeb_parts.parts]


def choose(mesh: bpy.types.Mesh, numbers: list[int]) -> None:
    """Choose these parts and no others: the first becomes the active one, and several are marked."""
    transaction.keep_result(mesh)
    result = mesh.reeb_parts
    with property_updates.quiet():
        for index, part in enumerate(result.parts):
            part.selected = part.number in numbers and len(numbers) > 1
            if part.number == numbers[0]:
                result.active = index
    _show_group(mesh)


def make_active(mesh: bpy.types.Mesh, number: int) -> None:
    """Make a part the active one of the list, which scrolls to it; no mark changes."""
    transaction.keep_result(mesh)
    with property_updates.quiet():
        for index, part in enumerate(mesh.reeb_parts.parts):
            if part.number == number:
                mesh.reeb_parts.active = index
    _show_group(mesh)


def toggle(mesh: bpy.types.Mesh, number: int) -> None:
    """Mark a part that is not marked, or take its mark away; it becomes the active one."""
    transaction.keep_result(mesh)
    result = mesh.reeb_parts
    with property_updates.quiet():
        if not any(part.selected for part in result.parts):
            result.parts[result.active].selected = True
        for index, part in enumerate(result.parts):
            if part.number == number:
                part.selected = not part.selected
                result.active = index
    _show_group(mesh)


def choose_more(mesh: bpy.types.Mesh, numbers: list[int], mode: str) -> None:
    """Choose some parts besides others. mode : "SET" for these alone, "ADD", or "SUB" for all but these."""
    marked = [] if mode == "SET" else chosen_numbers(mesh)
    if mode == "SUB":
        numbers = [number for number in marked if number not in numbers]
    elif numbers:
        numbers = [*numbers, *(number for number in marked if number not in numbers)]
    if numbers:
        choose(mesh, numbers)
    elif mode != "ADD":
        mark(mesh, "NONE")


def small_parts(mesh: bpy.types.Mesh) -> list[bpy.types.PropertyGroup]:
    """The small parts that are folded into one row; none of a short list.

    Beside a wide floor all parts are small: they are measured by what stands there.
    """
    parts = mesh.reeb_parts.parts
    if len(parts) <= _SHORT:
        return []
    least = bpy.context.scene.reeb_parts.small / 100 * sum(part.share for part in parts if not part.is_ground)
    return [part for part in parts if part.share < least]


def folded(mesh: bpy.types.Mesh) -> set[int]:
    """Numbers of the parts that the list leaves out: small ones, but for those that are marked or the active one."""
    if bpy.context.scene.reeb_parts.show_small:
        return set()
    active = mesh.reeb_parts.active
    shown = {part.number for part in mesh.reeb_parts.parts[active : active + 1]}
    return {part.number for part in small_parts(mesh) if not part.selected} - shown


def ordered(parts: bpy.types.bpy_prop_collection, by: str, matrix: Matrix) -> list[int]:
    """The places of parts in another order; asked for at each redraw.

    by : "NUMBER", "SIZE", "NAME" or "PLACE". matrix : of the object, in the world. Returns the place that each part,
    in the order given, has in the list.
    """
    if by == "NUMBER":
        return list(range(len(parts)))
    if by == "NAME":
        return list(_by_name(tuple(part.name for part in parts)))
    if by == "SIZE":
        return _places(-mesh_arrays.read(parts, "share", np.float32))
    middles = mesh_arrays.read(parts, "middle", np.float32, 3).astype(np.float64)
    height = middles @ np.array(matrix[2][:3]) + matrix[2][3]
    return _places(-height.astype(np.float32))


def _places(keys: np.ndarray) -> list[int]:
    """The place of each key among all, (k,); equal ones stay in their order."""
    return inverse(np.argsort(keys, kind="stable")).tolist()


@lru_cache(1)
def _by_name(names: tuple[str, ...]) -> tuple[int, ...]:
    """The place of each name among all."""
    order = sorted(range(len(names)), key=lambda index: _natural(names[index]))
    return tuple(inverse(np.array(order, np.int64)).tolist())


def _natural(name: str) -> list[tuple[int, str]]:
    """A key by which Part 9 comes before Part 10."""
    return [(int(word), "") if word.isdecimal() else (-1, word.casefold()) for word in re.split(r"(\d+)", name)]


def mark(mesh: bpy.types.Mesh, action: str, with_faces: Container[int] = ()) -> None:
    """Change the marks of all parts.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    action : str
        "ALL", "NONE", "INVERT" (parts that are not chosen), "SMALL" (parts smaller than the active one) or "FACES".
    with_faces : container of int
        Numbers of the parts that "FACES" marks.
    """
    transaction.keep_result(mesh)
    result = mesh.reeb_parts
    share, chosen = result.parts[result.active].share, chosen_numbers(mesh)
    for part in result.parts:
        part.selected = {
            "ALL": True, "NONE": False, "INVERT": part.number not in chosen,
            "SMALL": part.share < share, "FACES": part.number in with_faces,
        }[action]


def mark_numbers(mesh: bpy.types.Mesh, numbers: Container[int]) -> None:
    """Mark the parts of some numbers and no others; the active part stays."""
    transaction.keep_result(mesh)
    with property_updates.quiet():
        for part in mesh.reeb_parts.parts:
            part.selected = part.number in numbers


@reaction
def on_list_click(result: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """The user has clicked a part in the list: only it is chosen.

    In Edit Mode its faces are selected. Its vertex group becomes the active one, see ``_show_group``.
    """
    mesh = result.id_data
    if not len(result.parts):
        return
    if not 0 <= result.active < len(result.parts):  # a script has set it
        with property_updates.quiet():
            result.active = max(0, min(result.active, len(result.parts) - 1))
    mark(mesh, "NONE")
    if mesh.is_editmode:
        _select_in_edit_mode(mesh, active_number(mesh))
    _show_group(mesh)


def _show_group(mesh: bpy.types.Mesh) -> None:
    """Make the vertex group of the active part the active one, which Weight Paint shows.

    In other modes one of the user's own stays active.
    """
    result = mesh.reeb_parts
    ours = [part.group for part in result.parts]
    for obj in targets.users(mesh)[:1]:  # which group is active is of the mesh
        groups = obj.vertex_groups
        own = groups.active is not None and groups.active.name not in ours
        if (shown := groups.get(ours[result.active])) and not (own and obj.mode != "WEIGHT_PAINT"):
            transaction.keep(groups, "active_index")
            groups.active_index = shown.index


def _select_in_edit_mode(mesh: bpy.types.Mesh, number: int) -> None:
    """Select the faces of a part that are not hidden, and nothing else; the edit mesh cannot be written in bulk."""
    edit = bmesh.from_edit_mesh(mesh)
    layer = edit.faces.layers.int.get(mesh.reeb_parts.face_attribute)
    if layer is None:
        return
    before = [item for items in (edit.verts, edit.edges, edit.faces) for item in items if item.select]
    transaction.on_failure(_select_again, mesh, edit, before)
    for item in (*edit.verts, *edit.edges):
        item.select = False
    for face in edit.faces:
        face.select_set(face[layer] == number and not face.hide)
    edit.select_flush_mode()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def _select_again(mesh: bpy.types.Mesh, edit: bmesh.types.BMesh, selected: list) -> None:
    """Select elements of an edit mesh, and nothing else."""
    for item in (*edit.verts, *edit.edges, *edit.faces):
        item.select = False
    for item in selected:
        item.select = True
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
