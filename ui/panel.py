# SPDX-License-Identifier: GPL-3.0-or-later
"""The first level of the sidebar tab "Reeb Parts": draws stored facts, never computes."""

from __future__ import annotations

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ..core.sentence import Count
from ..scene import modes, store, targets
from ..scene.graph import graph_finding, graph_objects
from ..scene.pieces import piece_objects
from ..scene.result import notes, part_names
from ..scene.runs import jobs
from . import parts_list, toolbar
from .fitting import Room

MODELS = 8  # so many selected models are listed
FOLD = 18  # width of what folds a panel, before its words, in pixels of a screen without scaling
BETWEEN = 0.43  # share of its row that the number of parts has between the two buttons where all is narrow


def _result(context: bpy.types.Context) -> bpy.types.PropertyGroup | None:
    """The stored result of the active mesh, or None."""
    return context.object.data.reeb_parts if store.has_parts(context.object) else None


class ReebPanel:
    """Where all panels of the tab live."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Reeb Parts"


class SubPanel(ReebPanel):
    """The panels below the first one."""

    bl_parent_id = "REEB_PARTS_PT_main"


class REEB_PARTS_PT_main(ReebPanel, bpy.types.Panel):
    bl_idname = "REEB_PARTS_PT_main"
    bl_label = "Reeb Parts"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        result = _result(context)
        room = Room(context)
        _draw_decompose(layout, room, result is not None)
        found = graph_finding.part_of(context.object) if result is None else None
        if found is not None:
            source, number = found
            text = iface_("{part} of {name}").format(part=part_names.part_name(source.data, number), name=source.name)
            room.wrapped(layout.column(align=True), text, "EMPTY_AXIS")
            room.operator(layout, "reeb_parts.from_nodes", spare="RESTRICT_SELECT_OFF")
            room.operator(layout, "reeb_parts.split_at_node", icon="MOD_EDGESPLIT")
            _draw_parts(layout, context, room, source.data.reeb_parts)
        elif result is None:
            _draw_hint(layout, context, room)
            room.properties(layout.column(align=True), context.scene.reeb_parts, ("detail", "n_parts"))
        else:
            _draw_notes(layout, context, result, room)
            _draw_unseen(layout, context, result, room)
            _draw_models(layout, context, room)
            _draw_detail(layout, context, room, result)
            _draw_parts(layout, context, room, result)


def _draw_decompose(layout: bpy.types.UILayout, room: Room, again: bool) -> None:
    """The button, or how far its run is; beside it the way back, once there are parts."""
    if jobs.current is not None:
        row = layout.row(align=True)
        row.scale_y = 1.5
        text = progress_text(jobs.current)
        beside = room.has(text, icons=1)
        row.progress(factor=jobs.current.share, text=text if beside else "")
        if isinstance(jobs.current, jobs.Job):  # in steps of Blender's own only keys reach it
            row.operator("reeb_parts.cancel", text="", icon="X")
        if not beside:
            room.wrapped(layout.column(align=True), text)
        return
    row = room.row(layout, iface_("Decompose", "Operator"), icons=1 + again)
    row.scale_y = 1.5
    room.operator(row, "reeb_parts.decompose", text="Decompose", icon="MOD_EXPLODE")
    if again:
        row.operator("reeb_parts.clear", text="", icon="TRASH")


def progress_text(work: jobs.Job | jobs.Progress) -> str:
    """What is being done, with a capital; a name at its beginning stays as it is."""
    return work.text if work.of else work.text[:1].upper() + work.text[1:]


def _draw_hint(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room) -> None:
    """What there is to do, while there are no parts, or why it cannot be done with a mesh, as with a linked one."""
    obj = context.object
    if obj is not None and obj.type == "MESH":
        text = (targets.why_not(obj)
                or iface_("Decompose cuts the selected mesh into parts. The mesh itself stays as it is."))
    elif obj is not None and targets.can_become_mesh(obj):
        text = targets.to_become_mesh(obj)
    else:
        text = targets.to_be_active(context) or iface_("Select a mesh, then press Decompose.")
    room.wrapped(layout.column(align=True), text, "INFO")


def _draw_notes(layout: bpy.types.UILayout, context: bpy.types.Context, result: bpy.types.PropertyGroup,
                room: Room) -> None:
    """Why the parts cannot be changed, as that the mesh was edited; the notes on it, folded into one line."""
    words = modes.why_not_left(context.object)
    if not words and store.is_edited(result.id_data):
        words = iface_("The mesh was edited since. Decompose it again.")
    if words:
        room.less().wrapped(layout.box().column(align=True), words, "ERROR")
    found = notes.spoken(result)
    if not found:
        return
    header, body = layout.panel("REEB_PARTS_notes", default_closed=True)
    words = iface_("{n} {n:note|notes} on the mesh").format(n=Count(len(found)))
    if not room.less(FOLD).has(words):
        words = iface_("{n} {n:note|notes}").format(n=Count(len(found)))
    header.label(text=words, translate=False)
    if body is not None:
        column = body.column(align=True)
        column.scale_y = 0.8
        for note in found:
            room.less().wrapped(column, note, "INFO")


def hides_parts(space: bpy.types.SpaceView3D, has_colors: bool, has_materials: bool) -> bool:
    """Whether a viewport shows neither the parts' colors nor their materials, if the mesh has these."""
    shading = space.shading
    if shading.type in {"MATERIAL", "RENDERED"}:
        return not has_materials
    if shading.type != "SOLID":
        return False
    return not ((has_colors and shading.color_type == "VERTEX") or (has_materials and shading.color_type == "MATERIAL"))


def _draw_unseen(layout: bpy.types.UILayout, context: bpy.types.Context, result: bpy.types.PropertyGroup,
                 room: Room) -> None:
    """How the parts are seen, in a viewport that does not show them."""
    has_colors = bool(result.color_attribute) and not modes.lacks_colors(context.object)
    if not hides_parts(context.space_data, has_colors, result.has_materials):
        return
    box, room = layout.box().column(align=True), room.less()
    room.wrapped(box, iface_("This viewport does not show the parts."), "HIDE_ON")
    words = [iface_(word, "Operator") for word in ("Show Colors", "Give Materials")]
    row = room.row(box, *words)
    if has_colors or (result.color_attribute and result.has_materials):
        room.operator(row, "reeb_parts.show_colors", text="Show Colors", spare="COLOR")
    room.operator(row, "reeb_parts.materials", text="Give Materials", spare="MATERIAL").remove = False


def _draw_models(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room) -> None:
    """How many parts each of several selected models has; the list below is of the active one."""
    room = room.less()
    models = [obj for obj in context.selected_objects if store.has_parts(obj)]
    if len(models) < 2:
        return
    column = layout.box().column(align=True)
    column.scale_y = 0.8
    for obj in models[:MODELS]:
        parts = iface_("{n} {n:part|parts}").format(n=Count(len(obj.data.reeb_parts.parts)))
        row = room.row(column, obj.name, parts, icons=2)
        row.label(text=obj.name, icon="RADIOBUT_ON" if obj == context.object else "RADIOBUT_OFF", translate=False)
        count = row.row()
        count.alignment = "RIGHT"
        count.label(text=parts)
    if len(models) > MODELS:
        column.label(text=iface_("and {n} more {n:model|models}").format(n=Count(len(models) - MODELS)), icon="BLANK1")


def _draw_detail(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room,
                 result: bpy.types.PropertyGroup) -> None:
    """How many parts there are, by a slider, by a number, and by steps from one clear choice to the next."""
    column = layout.column(align=True)
    known = not store.is_edited(result.id_data) and not modes.why_not_left(context.object)
    row = room.field(column, result, "detail", iface_("Detail"), "0.00", icons=1, enabled=known, slider=True)
    shown = graph_objects.is_shown(context, context.object)
    row.operator("reeb_parts.show_graph", text="", icon="HIDE_OFF" if shown else "HIDE_ON", depress=shown)
    column = column.column(align=True)
    column.enabled = known
    fewer, more, count = iface_("Fewer", "Reeb Parts"), iface_("More", "Reeb Parts"), str(len(result.parts))
    row = column.row(align=True)
    whole = (room.has(fewer, iface_("Parts"), count, more, fields=1)
             and room.less((1 - BETWEEN) * room.width).has(iface_("Parts"), count, fields=1))
    if not whole:
        room.field(column, result, "n_parts", iface_("Parts"), count)
        row = room.row(column, fewer, more)
    row.operator("reeb_parts.step_detail", text="Fewer", text_ctxt="Reeb Parts").more = False
    if whole:
        field = row.row(align=True)
        field.scale_x = 1.4  # for the arrows that it has under the pointer
        field.prop(result, "n_parts", text="Parts")
    row.operator("reeb_parts.step_detail", text="More", text_ctxt="Reeb Parts").more = True
    if result.asked:
        text = iface_("{n} {n:part|parts} cannot be had, only {fewest} to {most}")
        room.wrapped(column, text.format(n=Count(result.asked), fewest=result.fewest, most=result.most), "ERROR")


def _draw_parts(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room,
                result: bpy.types.PropertyGroup) -> None:
    """The list, what is done with its parts, and the way to objects."""
    parts_list.draw(layout, context, room, result)
    parts_list.draw_small(layout, context, room, result)
    _draw_tools(layout, context, room)
    words = [iface_(word, "Operator") for word in ("Select", "Isolate", "Show All")]
    row = room.row(layout, *words)
    room.operator(row, "reeb_parts.select", text="Select", spare="RESTRICT_SELECT_OFF")
    room.operator(row, "reeb_parts.isolate", text="Isolate", spare="ZOOM_SELECTED").show_all = False
    room.operator(row, "reeb_parts.isolate", text="Show All", spare="HIDE_OFF").show_all = True
    suggest, separate = iface_("Suggest Names", "Operator"), iface_("Separate", "Operator")
    beside = room.has(suggest, separate, icons=1)
    share = max(0.42, room.share(suggest))  # Separate is the larger one, as far as the words of both fit
    row = layout.split(factor=share, align=True) if beside else layout.column(align=True)
    row.scale_y = 1.2
    room.operator(row, "reeb_parts.suggest_names", spare="SORTALPHA")
    room.operator(row, "reeb_parts.separate", text="Separate", icon="OUTLINER_OB_GROUP_INSTANCE")
    if piece_objects.hides_pieces(context, context.object):
        room.operator(layout, "reeb_parts.show_pieces", icon="HIDE_OFF")


def _draw_tools(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room) -> None:
    """What works with the pointer over the model; in two rows, since other languages have longer words."""
    # In a context of our own: by "Cut", Blender means the clipboard, and in some languages says so.
    flow = room.grid(layout, *(iface_(word, "Reeb Parts") for word in ("Pick", "Cut", "Slide", "Paint")), icons=1)
    toolbar.draw_button(flow, context, room)
    flow.operator_context = "INVOKE_DEFAULT"  # asked in the sidebar, and not for the view, whether they can be pressed
    room.operator(flow, "reeb_parts.cut", text="Cut", text_ctxt="Reeb Parts", icon="MOD_BOOLEAN")
    room.operator(flow, "reeb_parts.slide", text="Slide", text_ctxt="Reeb Parts", icon="ARROW_LEFTRIGHT")
    room.operator(flow, "reeb_parts.paint", text="Paint", text_ctxt="Reeb Parts", icon="BRUSH_DATA")


class REEB_PARTS_PT_rename(bpy.types.Panel):
    """Opens at the pointer."""

    bl_idname = "REEB_PARTS_PT_rename"
    bl_label = "Rename Part"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"INSTANCED"}
    bl_ui_units_x = 14

    def draw(self, context: bpy.types.Context) -> None:
        result = _result(context)
        if result is None:
            return
        self.layout.label(text="Rename Part", text_ctxt="Operator")
        row = self.layout.row()
        row.activate_init = True
        row.prop(result.parts[result.active], "name", text="")


CLASSES = (REEB_PARTS_PT_main, REEB_PARTS_PT_rename)
