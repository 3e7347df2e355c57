# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens when the user moves a slider or renames a part: the stored result is shown anew.

Blender itself makes an undo step for a property of the mesh that is changed in the interface.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import bpy
import numpy as np

from ...core.result.numbering import NumberedParts
from .. import outputs, property_updates, store, targets, transaction
from ..errors import SceneError
from ..graph import graph_objects
from ..modes import object_mode, why_not_left
from ..outputs import materials, vertex_groups
from ..result import part_names
from ..store import Stored
from ..transaction import keep_result
from . import moved
from .settled import reaction


@reaction
def show_detail(result: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """The Detail slider was moved."""
    if _goes_back(result, context):
        return
    result.by_number, result.asked = False, 0
    with object_mode(context):  # which leaves Edit Mode for all objects that are edited together
        show(result, context)
        for other in _other_results(result, context):
            with property_updates.quiet():
                other.by_number, other.asked, other.detail = False, 0, result.detail
            show(other, context)


@reaction
def show_number(result: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """A number of parts was typed: Detail goes to where there are so many."""
    if _goes_back(result, context):
        return
    result.by_number, asked = True, result.n_parts
    with object_mode(context):
        show(result, context)
        result.asked = 0 if result.n_parts == asked else asked
        for other in _other_results(result, context):
            with property_updates.quiet():
                other.by_number, other.asked, other.n_parts = True, 0, asked
            show(other, context)


def _other_results(result: bpy.types.PropertyGroup, context: bpy.types.Context) -> list[bpy.types.PropertyGroup]:
    """The results of other selected meshes, if that of the active one was changed; what cannot be written stays out."""
    active = context.view_layer.objects.active
    if active is None or active.data != result.id_data:
        return []
    meshes = dict.fromkeys(obj.data for obj in context.view_layer.objects.selected if store.has_parts(obj))
    others = [mesh for mesh in meshes if mesh != result.id_data and mesh.is_editable and not mesh.is_editmode]
    for mesh in others:
        transaction.keep_result(mesh)
    return [mesh.reeb_parts for mesh in others]


@reaction
def rename(part: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """A part was renamed."""
    take_new_name(part, context)


def take_new_name(part: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Let all that is called like a part take the name that it was given, and its mirror image the other side's."""
    mesh = part.id_data
    with property_updates.quiet():
        if not part.name.strip():
            part.name = part_names.part_name(mesh, part.number)
        part.name = part_names.free_name(mesh, part.number, part.name)
        _take_name(part, given=False)
        twin = part_names.unnamed_twin(part)
        if twin is not None and context.scene.reeb_parts.symmetry:
            twin.name = part_names.free_name(mesh, twin.number, bpy.utils.flip_name(part.name))
            _take_name(twin, given=True)
    for obj in targets.users(mesh):
        graph_objects.update_names(obj)


def _take_name(part: bpy.types.PropertyGroup, given: bool) -> None:
    """Let the vertex group, the material and the number of a part take its name. given : nobody typed it."""
    mesh = part.id_data
    users = targets.users(mesh)
    for obj in users[:1]:
        vertex_groups.rename(obj, part, vertex_groups.taken_names(users))
    materials.rename(part)
    part_names.keep_name(mesh, part.number, part.name, given)


def give_names(mesh: bpy.types.Mesh, names: dict[int, str], given: bool = False) -> int:
    """Name parts by number, in the order given; a name that another part has gets a number behind it.

    Of mirror images both get the same number. Returns how many parts were named. given : nobody has typed these names.
    """
    listed = {part.number: part for part in mesh.reeb_parts.parts}
    known = {number: name for number, name in names.items() if number in listed}
    naming, users = part_names.Naming(mesh), targets.users(mesh)
    taken = vertex_groups.taken_names(users)
    with property_updates.quiet():
        for together in part_names.in_pairs(mesh, known):
            for number, name in naming.free(together).items():
                part = listed[number]
                part.name = name
                for obj in users[:1]:
                    vertex_groups.rename(obj, part, taken)
                materials.rename(part)
                naming.keep(number, part.name, given)
    naming.end()
    for obj in users:
        graph_objects.update_names(obj)
    return len(known)


def show_graph(obj: bpy.types.Object | None, shown: bool, context: bpy.types.Context) -> None:
    """Hide the graph of an object that has parts, or show it; it is drawn if there is none yet."""
    if obj is None or not store.has_parts(obj):
        return
    if graph_objects.set_hidden(context, obj, not shown) or not shown:
        return

    def draw(stored: Stored) -> None:
        graph_objects.draw_graph(context, obj, stored.shown_parts(), context.scene.reeb_parts)

    _with_result(obj.data, context, draw)


def use_palette(obj: bpy.types.Object | None, palette: str, context: bpy.types.Context) -> None:
    """Color the parts of an object, if it has any, from another palette."""
    if obj is None or not store.has_parts(obj) or obj.data.reeb_parts.palette == palette:
        return
    mesh = obj.data

    def recolor_all(stored: Stored) -> None:
        keep_result(mesh)
        mesh.reeb_parts.palette = palette
        refresh(context, mesh, stored, stored.shown_parts())

    _with_result(mesh, context, recolor_all)


@reaction
def recolor(part: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """A part was given another color: all that is colored by it takes it, and it stays. Backspace takes it back."""
    mesh = part.id_data

    def keep(stored: Stored) -> None:
        numbered = stored.shown_parts()
        own = outputs.palette_colors(mesh, numbered)[numbered.numbers == part.number][0]
        if np.array_equal(part.color, np.array(part_names.NO_COLOR, np.float32)):
            with property_updates.quiet():
                part.color = own
        # Blender's popup, when it is cancelled, sets the color back.
        chosen = np.abs(own - part.color).max() > 0.5 / 255
        part_names.keep_color(mesh, part.number, part.color[:] if chosen else None)
        # The list is not filled anew: the user is just changing one of its colors.
        outputs.update_colors(mesh, numbered)
        for obj in targets.users(mesh):
            graph_objects.update_parts(obj, numbered)

    _with_result(mesh, context, keep)


@reaction
def lock(part: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """A part was locked or unlocked in the list; one that was changed by hand before stays pinned."""
    mesh = part.id_data
    number, locked = part.number, part.locked

    def pin(stored: Stored) -> None:
        stays = locked or (part.pinned and not part.only_locked)
        pinned = np.where(stored.shown == number, number if stays else 0, stored.pinned)
        transaction.keep_result(mesh)
        with property_updates.quiet():
            part.only_locked = locked and (part.only_locked or not part.pinned)
            store.save_numbers(mesh, replace(stored, pinned=pinned))
        show(mesh.reeb_parts, context)

    _with_result(mesh, context, pin)


def refresh(context: bpy.types.Context, mesh: bpy.types.Mesh, stored: Stored, numbered: NumberedParts) -> None:
    """Write other parts of the same decomposition: outputs, list and graphs."""
    before = stored.shown
    stored = stored.showing(numbered)
    objects = targets.users(mesh)
    with property_updates.quiet():
        store.save_numbers(mesh, stored)
        outputs.update_outputs(objects[0], numbered, before)
    store.mark_pins(mesh, stored)
    for obj in objects:
        graph_objects.update_parts(obj, numbered)


def show(result: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Show the parts of the detail or number that is set."""
    mesh = result.id_data

    def write(stored: Stored) -> None:
        numbered = stored.parts(result.detail, result.n_parts if result.by_number else 0)
        if np.array_equal(numbered.candidate_numbers, stored.shown):
            store.mark_pins(mesh, stored)
        else:
            refresh(context, mesh, stored, numbered)
        with property_updates.quiet():
            result.n_parts = numbered.parts.count
            if result.by_number:
                store.go_to_number(result, stored.numbering, numbered.parts.count)

    _with_result(mesh, context, write)


def _goes_back(result: bpy.types.PropertyGroup, context: bpy.types.Context) -> bool:
    """Whether a property that was changed has gone back, since its mesh cannot be written; the panel says why.

    A mesh of another file, or of no object, is changed by scripts only.
    """
    mesh = result.id_data
    writable = mesh.is_editable and mesh.override_library is None and targets.users(mesh)
    if writable and not why_not_left(context.view_layer.objects.active):
        return False
    with property_updates.quiet():
        result.take_back()
    return True


def _with_result(mesh: bpy.types.Mesh, context: bpy.types.Context, work: Callable[[Stored], None]) -> None:
    """Do something with the stored result of a mesh, in Object Mode."""
    if _goes_back(mesh.reeb_parts, context):
        return
    with object_mode(context):
        try:
            stored = moved.load(mesh)
        except SceneError as error:
            # The panel says that the mesh was edited; a property that is changed cannot say anything. A result that
            # cannot be read says itself what is wrong with it, once something is done with it.
            if not isinstance(error, store.UnreadableError):
                mesh.reeb_parts.edited = True
            with property_updates.quiet():  # what cannot be shown is not said either
                mesh.reeb_parts.take_back()
        else:
            work(stored)
