# SPDX-License-Identifier: GPL-3.0-or-later
"""The first level of the sidebar tab "Reeb Parts": draws stored facts, never computes."""

from __future__ import annotations

import blf
import bpy
from bpy.app.translations import pgettext_iface as iface_
from mathutils import Matrix

from ..core.sentence import Count
from ..scene import graph_objects, jobs, notes, part_list, part_names, store
from . import toolbar, wrapping

MODELS = 8  # so many selected models are listed
# Widths in pixels of a screen without scaling: of a sidebar that has no room for shares, and, in a row of the list, of
# all beside the name and the share.
NARROW, BESIDE_NAME = 215, 190


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


def settings_column(panel: bpy.types.Panel, context: bpy.types.Context
                    ) -> tuple[bpy.types.UILayout, bpy.types.PropertyGroup]:
    """A column for properties with their names before them, and the settings of the scene."""
    return _names_before(panel.layout).column(), context.scene.reeb_parts


def _names_before(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    """The same layout, in which the names of properties stand before them."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout


class REEB_PARTS_UL_parts(bpy.types.UIList):
    """Parts with color, name, share of the area, lock and mark; small ones are left out of a long list."""

    def draw_item(self, context: bpy.types.Context, layout: bpy.types.UILayout, data: bpy.types.PropertyGroup,
                  item: bpy.types.PropertyGroup, icon: int, active_data: bpy.types.PropertyGroup, active_property: str,
                  index: int) -> None:
        row = layout.row(align=True)
        chip = row.row()
        chip.ui_units_x = 1.0
        chip.prop(item, "color", text="")
        row.prop(item, "name", text="", emboss=False)
        percent = f"{100 * item.share:.1f} %"
        if _has_room(context, item.name, percent):
            share = row.row()
            share.alignment = "RIGHT"
            share.label(text=percent)
        unlocked = "PINNED" if item.pinned else "UNLOCKED"
        row.prop(item, "locked", text="", emboss=False, icon="LOCKED" if item.locked else unlocked)
        row.prop(item, "selected", text="", emboss=False,
                 icon="CHECKBOX_HLT" if item.selected else "CHECKBOX_DEHLT")

    def draw_filter(self, context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
        row = layout.row(align=True)
        row.prop(self, "filter_name", text="", icon="VIEWZOOM")
        row.prop(context.scene.reeb_parts, "sort", text="")

    def filter_items(self, context: bpy.types.Context, data: bpy.types.PropertyGroup, property: str
                     ) -> tuple[list[int], list[int]]:
        parts, settings = getattr(data, property), context.scene.reeb_parts
        flags = [self.bitflag_filter_item] * len(parts)
        if self.filter_name:  # a small part that is looked for by its name is shown
            flags = bpy.types.UI_UL_list.filter_items_by_name(
                self.filter_name, self.bitflag_filter_item, parts, "name")
        elif left_out := part_list.folded(data.id_data):
            flags = [0 if part.number in left_out else self.bitflag_filter_item for part in parts]
        matrix = context.object.matrix_world if context.object is not None else Matrix()
        return flags, part_list.ordered(parts, settings.sort, matrix)


def _has_room(context: bpy.types.Context, name: str, percent: str) -> bool:
    """Whether the share of a part fits beside its name: the name is the last to be cut off."""
    scale = context.preferences.system.ui_scale
    blf.size(0, context.preferences.ui_styles[0].widget.points * scale)
    text = sum(blf.dimensions(0, word)[0] for word in (name, percent))
    return context.region.width > max(scale * NARROW, scale * BESIDE_NAME + text)


class REEB_PARTS_PT_main(ReebPanel, bpy.types.Panel):
    bl_idname = "REEB_PARTS_PT_main"
    bl_label = "Reeb Parts"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        result = _result(context)
        # Letters are about 7 pixels wide, and the icon takes 30.
        width = max(int((context.region.width / context.preferences.system.ui_scale - 60) / 7), 20)
        _draw_decompose(layout, result is not None)
        found = graph_objects.part_of(context.object) if result is None else None
        if found is not None:
            source, number = found
            text = iface_("{part} of {name}").format(part=part_names.part_name(source.data, number), name=source.name)
            layout.label(text=text, icon="EMPTY_AXIS")
            layout.operator("reeb_parts.from_nodes")
            layout.operator("reeb_parts.split_at_node", icon="MOD_EDGESPLIT")
            _draw_parts(layout, context, source.data.reeb_parts)
        elif result is None:
            _draw_hint(layout, context, width)
            column = _names_before(layout).column(align=True)
            column.prop(context.scene.reeb_parts, "detail", slider=True)
            column.prop(context.scene.reeb_parts, "n_parts")
        else:
            _draw_notes(layout, result, width)
            _draw_unseen(layout, context, result, width)
            _draw_models(layout, context)
            _draw_detail(layout, context, result)
            _draw_parts(layout, context, result)


def _draw_decompose(layout: bpy.types.UILayout, again: bool) -> None:
    """The button, or how far its run is; beside it the way back, once there are parts."""
    row = layout.row(align=True)
    row.scale_y = 1.5
    if jobs.current is not None:
        text = jobs.current.text
        row.progress(factor=jobs.current.share, text=text[:1].upper() + text[1:])
        if isinstance(jobs.current, jobs.Job):  # in steps of Blender's own only keys reach it
            row.operator("reeb_parts.cancel", text="", icon="X")
        return
    row.operator("reeb_parts.decompose", text="Decompose", icon="MOD_EXPLODE")
    if again:
        row.operator("reeb_parts.clear", text="", icon="TRASH")


def _draw_hint(layout: bpy.types.UILayout, context: bpy.types.Context, width: int) -> None:
    """What there is to do, while there are no parts."""
    is_mesh = context.object is not None and context.object.type == "MESH"
    text = (iface_("Decompose cuts the selected mesh into parts. The mesh itself stays as it is.") if is_mesh
            else iface_("Select a mesh, then press Decompose."))
    _wrapped(layout.column(align=True), text, width, "INFO")


def _draw_notes(layout: bpy.types.UILayout, result: bpy.types.PropertyGroup, width: int) -> None:
    """That the mesh was edited; the notes on it, folded into one line."""
    if store.is_edited(result.id_data):
        _wrapped(layout.box().column(align=True), iface_("The mesh was edited since. Decompose it again."), width,
                 "ERROR")
    found = notes.spoken(result)
    if not found:
        return
    header, body = layout.panel("REEB_PARTS_notes", default_closed=True)
    header.label(text=iface_("{n} {n:note|notes} on the mesh").format(n=Count(len(found))))
    if body is not None:
        column = body.column(align=True)
        column.scale_y = 0.8
        for note in found:
            _wrapped(column, note, width, "INFO")


def hides_parts(space: bpy.types.SpaceView3D, has_colors: bool, has_materials: bool) -> bool:
    """Whether a viewport shows neither the parts' colors nor their materials, if the mesh has these."""
    shading = space.shading
    if shading.type in {"MATERIAL", "RENDERED"}:
        return not has_materials
    if shading.type != "SOLID":
        return False
    return not ((has_colors and shading.color_type == "VERTEX") or (has_materials and shading.color_type == "MATERIAL"))


def _draw_unseen(layout: bpy.types.UILayout, context: bpy.types.Context, result: bpy.types.PropertyGroup,
                 width: int) -> None:
    """How the parts are seen, in a viewport that does not show them."""
    if not hides_parts(context.space_data, bool(result.color_attribute), result.has_materials):
        return
    box = layout.box().column(align=True)
    _wrapped(box, iface_("This viewport does not show the parts."), width, "HIDE_ON")
    row = box.row(align=True)
    if result.color_attribute:
        row.operator("reeb_parts.show_colors", text="Show Colors")
    row.operator("reeb_parts.materials", text="Give Materials").remove = False


def _draw_models(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """How many parts each of several selected models has; the list below is of the active one."""
    models = [obj for obj in context.selected_objects if store.has_parts(obj)]
    if len(models) < 2:
        return
    column = layout.box().column(align=True)
    column.scale_y = 0.8
    for obj in models[:MODELS]:
        row = column.row()
        row.label(text=obj.name, icon="RADIOBUT_ON" if obj == context.object else "RADIOBUT_OFF", translate=False)
        count = row.row()
        count.alignment = "RIGHT"
        count.label(text=iface_("{n} {n:part|parts}").format(n=Count(len(obj.data.reeb_parts.parts))))
    if len(models) > MODELS:
        column.label(text=iface_("and {n} more {n:model|models}").format(n=Count(len(models) - MODELS)), icon="BLANK1")


def _wrapped(column: bpy.types.UILayout, text: str, width: int, icon: str) -> None:
    """A text in lines of some letters, with an icon before the first one."""
    for index, line in enumerate(wrapping.lines(text, width)):
        column.label(text=line, icon="BLANK1" if index else icon)


def _draw_detail(layout: bpy.types.UILayout, context: bpy.types.Context, result: bpy.types.PropertyGroup) -> None:
    """How many parts there are, by a slider, by a number, and by steps from one clear choice to the next."""
    column = layout.column(align=True)
    column.enabled = not store.is_edited(result.id_data)
    row = column.row(align=True)
    row.prop(result, "detail", slider=True)
    shown = graph_objects.is_shown(context, context.object)
    row.operator("reeb_parts.show_graph", text="", icon="HIDE_OFF" if shown else "HIDE_ON", depress=shown)
    row = column.row(align=True)
    row.operator("reeb_parts.step_detail", text="Fewer", text_ctxt="Reeb Parts").more = False
    row.prop(result, "n_parts", text="Parts")
    row.operator("reeb_parts.step_detail", text="More", text_ctxt="Reeb Parts").more = True
    if result.asked:
        text = iface_("{n} {n:part|parts} cannot be had, only {fewest} to {most}")
        column.label(text=text.format(n=Count(result.asked), fewest=result.fewest, most=result.most), icon="ERROR")


def facts(result: bpy.types.PropertyGroup) -> list[str]:
    """What came out, in two lines."""
    parts = iface_("{n} {n:part|parts}").format(n=Count(len(result.parts)))
    graph = (
        iface_("{n} {n:node|nodes}").format(n=Count(result.n_nodes)),
        iface_("{n} {n:arc|arcs}").format(n=Count(result.n_arcs)),
        iface_("{n} {n:loop|loops}").format(n=Count(result.n_loops)),
    )
    return [iface_("{parts} in {seconds:.2f} s").format(parts=parts, seconds=result.seconds), ", ".join(graph)]


def _draw_parts(layout: bpy.types.UILayout, context: bpy.types.Context, result: bpy.types.PropertyGroup) -> None:
    """The list, what is done with its parts, and the way to objects."""
    row = layout.row()
    row.template_list("REEB_PARTS_UL_parts", "", result, "parts", result, "active", rows=7)
    column = row.column(align=True)
    column.operator("reeb_parts.merge", text="", icon="AUTOMERGE_ON")
    column.operator("reeb_parts.split", text="", icon="MOD_EDGESPLIT")
    column.separator()
    column.operator("reeb_parts.grow", text="", icon="ADD")
    column.operator("reeb_parts.shrink", text="", icon="REMOVE")
    column.separator()
    column.operator("reeb_parts.frame", text="", icon="VIEWZOOM")
    column.menu("REEB_PARTS_MT_parts", text="", icon="DOWNARROW_HLT")
    _draw_small(layout, context, result)
    _draw_tools(layout, context)
    row = layout.row(align=True)
    row.operator("reeb_parts.select", text="Select")
    row.operator("reeb_parts.isolate", text="Isolate").show_all = False
    row.operator("reeb_parts.isolate", text="Show All").show_all = True
    row = layout.split(factor=0.42, align=True)
    row.scale_y = 1.2
    row.operator("reeb_parts.suggest_names")
    row.operator("reeb_parts.separate", text="Separate", icon="OUTLINER_OB_GROUP_INSTANCE")


def _draw_small(layout: bpy.types.UILayout, context: bpy.types.Context, result: bpy.types.PropertyGroup) -> None:
    """One row for all small parts of a long list."""
    small = part_list.small_parts(result.id_data)
    if not small:
        return
    settings = context.scene.reeb_parts
    row = layout.row(align=True)
    row.prop(settings, "show_small", text=iface_("{n} Small {n:Part|Parts}").format(n=Count(len(small))),
             icon="DOWNARROW_HLT" if settings.show_small else "RIGHTARROW", toggle=True)
    row.operator("reeb_parts.merge_small", text="Merge Small")


def _draw_tools(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """What works with the pointer over the model; in two rows, since other languages have longer words."""
    flow = layout.grid_flow(row_major=True, columns=2, even_columns=True, align=True)
    # In a context of our own: by "Cut", Blender means the clipboard, and in some languages says so.
    toolbar.draw_button(flow, context)
    flow.operator("reeb_parts.cut", text="Cut", text_ctxt="Reeb Parts", icon="MOD_BOOLEAN")
    flow.operator("reeb_parts.slide", text="Slide", text_ctxt="Reeb Parts", icon="ARROW_LEFTRIGHT")
    flow.operator("reeb_parts.paint", text="Paint", text_ctxt="Reeb Parts", icon="BRUSH_DATA")


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


CLASSES = (REEB_PARTS_UL_parts, REEB_PARTS_PT_main, REEB_PARTS_PT_rename)
