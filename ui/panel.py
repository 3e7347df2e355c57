# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab "Reeb Parts": draws stored facts, never computes."""

from __future__ import annotations

import textwrap

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_n as n_

from ..core.parameters import BERRETTI, LAVOUE, LIU
from ..scene import graph_objects, jobs, notes, part_names, store


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
    """Parts with colour, name, share of the area, lock and mark."""

    def draw_item(self, context: bpy.types.Context, layout: bpy.types.UILayout, data: bpy.types.PropertyGroup,
                  item: bpy.types.PropertyGroup, icon: int, active_data: bpy.types.PropertyGroup, active_property: str,
                  index: int) -> None:
        row = layout.row(align=True)
        chip = row.row()
        chip.ui_units_x = 1.0
        chip.prop(item, "color", text="")
        row.prop(item, "name", text="", emboss=False)
        share = row.row()
        share.alignment = "RIGHT"
        share.label(text=f"{100 * item.share:.1f} %")
        unlocked = "PINNED" if item.pinned else "UNLOCKED"
        row.prop(item, "locked", text="", emboss=False, icon="LOCKED" if item.locked else unlocked)
        row.prop(item, "selected", text="", emboss=False,
                 icon="CHECKBOX_HLT" if item.selected else "CHECKBOX_DEHLT")


class REEB_PARTS_PT_main(ReebPanel, bpy.types.Panel):
    bl_idname = "REEB_PARTS_PT_main"
    bl_label = "Reeb Parts"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        settings = context.scene.reeb_parts
        row = layout.row(align=True)
        row.prop(settings, "preset", text="")
        if settings.differs_from_preset():
            row.operator("reeb_parts.reset_parameters", text="", icon="LOOP_BACK")
        if jobs.current is not None:
            _draw_progress(layout, jobs.current)
        else:
            row = layout.row()
            row.scale_y = 1.5
            row.operator("reeb_parts.decompose", text="Decompose", icon="MOD_EXPLODE")
        result = _result(context)
        found = graph_objects.part_of(context.object) if result is None else None
        if found is not None:
            source, number = found
            text = iface_("{part} of {name}").format(part=part_names.part_name(source.data, number), name=source.name)
            layout.label(text=text, icon="EMPTY_AXIS")
            layout.operator("reeb_parts.from_nodes")
            layout.operator("reeb_parts.split_at_node", icon="MOD_EDGESPLIT")
        elif result is None:
            column = _names_before(layout).column(align=True)
            column.prop(settings, "detail", slider=True)
            column.prop(settings, "n_parts")
        else:
            # Letters are about 7 pixels wide, and the icon takes 30.
            width = int((context.region.width / context.preferences.system.ui_scale - 60) / 7)
            _draw_result(layout, context.object.data, result, max(width, 20))


def _draw_progress(layout: bpy.types.UILayout, job: jobs.Job) -> None:
    row = layout.row(align=True)
    row.scale_y = 1.5
    row.progress(factor=job.share, text=job.text[:1].upper() + job.text[1:])
    row.operator("reeb_parts.cancel", text="", icon="X")


def _draw_result(layout: bpy.types.UILayout, mesh: bpy.types.Mesh, result: bpy.types.PropertyGroup, width: int) -> None:
    edited = store.is_edited(mesh)
    if edited:
        box = layout.box().column(align=True)
        box.label(text="The mesh was edited since.", icon="ERROR")
        box.label(text="Decompose it again.", icon="BLANK1")
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in facts(result):
        column.label(text=line)
    for note in notes.spoken(result):
        for index, line in enumerate(textwrap.wrap(note, width)):
            column.label(text=line, icon="BLANK1" if index else "INFO")
    column = _names_before(layout.column(align=True))
    column.enabled = not edited
    column.prop(result, "detail", slider=True)
    column.prop(result, "n_parts", text="Parts")
    layout.operator("reeb_parts.clear", icon="TRASH")


def facts(result: bpy.types.PropertyGroup) -> list[str]:
    """What came out, in two lines."""
    parts = _count(len(result.parts), n_("{n} part"), n_("{n} parts"))
    graph = (
        _count(result.n_nodes, n_("{n} node"), n_("{n} nodes")),
        _count(result.n_arcs, n_("{n} arc"), n_("{n} arcs")),
        _count(result.n_loops, n_("{n} loop"), n_("{n} loops")),
    )
    return [iface_("{parts} in {seconds:.2f} s").format(parts=parts, seconds=result.seconds), ", ".join(graph)]


def _count(number: int, one: str, several: str) -> str:
    return iface_(one if number == 1 else several).format(n=number)


class REEB_PARTS_PT_parts(SubPanel, bpy.types.Panel):
    bl_label = "Parts"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return _result(context) is not None

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        result = _result(context)
        row = layout.row()
        row.template_list("REEB_PARTS_UL_parts", "", result, "parts", result, "active", rows=6)
        column = row.column(align=True)
        column.operator("reeb_parts.merge", text="", icon="AUTOMERGE_ON")
        column.operator("reeb_parts.split", text="", icon="MOD_EDGESPLIT")
        column.separator()
        column.operator("reeb_parts.grow", text="", icon="ADD")
        column.operator("reeb_parts.shrink", text="", icon="REMOVE")
        column.separator()
        column.menu("REEB_PARTS_MT_parts", text="", icon="DOWNARROW_HLT")
        _draw_tools(layout)
        row = layout.row(align=True)
        row.operator("reeb_parts.select", text="Select")
        row.operator("reeb_parts.isolate", text="Isolate").show_all = False
        row.operator("reeb_parts.isolate", text="Show All").show_all = True


def _draw_tools(layout: bpy.types.UILayout) -> None:
    """What works with the pointer over the model; in two rows, since other languages have longer words."""
    flow = layout.grid_flow(row_major=True, columns=2, even_columns=True, align=True)
    # In a context of our own: by "Cut", Blender means the clipboard, and in some languages says so.
    flow.operator("reeb_parts.pick", text="Pick", text_ctxt="Reeb Parts", icon="EYEDROPPER")
    flow.operator("reeb_parts.cut", text="Cut", text_ctxt="Reeb Parts", icon="MOD_BOOLEAN")
    flow.operator("reeb_parts.slide", text="Slide", text_ctxt="Reeb Parts", icon="ARROW_LEFTRIGHT")
    flow.operator("reeb_parts.paint", text="Paint", text_ctxt="Reeb Parts", icon="BRUSH_DATA")


class SettingsPanel(SubPanel):
    """For closed sub-panels that show settings of the scene, by name, one below the other."""

    bl_options = {"DEFAULT_CLOSED"}
    names: tuple[str, ...]

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = settings_column(self, context)
        for name in self.names:
            column.prop(settings, name)


class REEB_PARTS_PT_field(SettingsPanel, bpy.types.Panel):
    bl_label = "Field"
    names = ("base_spacing", "equalize", "n_slabs")


class REEB_PARTS_PT_graph(SettingsPanel, bpy.types.Panel):
    bl_label = "Graph"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = settings_column(self, context)
        own = {LAVOUE: ("n_clusters",), LIU: ("outline_weight",)}.get(settings.method, ("small_region",))
        for name in ("method", "pieces", "symmetry", *own, "loose_part"):
            column.prop(settings, name)


class REEB_PARTS_PT_boundaries(SettingsPanel, bpy.types.Panel):
    bl_label = "Boundaries"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = settings_column(self, context)
        of_paper = ("concavity_weight", "sigma") if settings.method == BERRETTI else ()
        movable = () if settings.method in {LAVOUE, LIU} else ("follow_level_sets", "band_ratio")
        for name in (*movable, *of_paper, "smoothing"):
            column.prop(settings, name)


class REEB_PARTS_PT_output(SettingsPanel, bpy.types.Panel):
    bl_label = "Output"
    names = ("vertex_groups", "face_attribute", "colors", "palette", "face_sets", "materials", "seams", "field")


class REEB_PARTS_PT_overlay(SettingsPanel, bpy.types.Panel):
    bl_label = "Overlay"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = settings_column(self, context)
        column.prop(settings, "graph", text="Show graph")
        column = column.column()
        column.enabled = settings.graph
        for name in ("node_size", "line_thickness", "in_front"):
            column.prop(settings, name)
        self.layout.column().prop(settings, "highlight")


CLASSES = (
    REEB_PARTS_UL_parts,
    REEB_PARTS_PT_main,
    REEB_PARTS_PT_parts,
    REEB_PARTS_PT_field,
    REEB_PARTS_PT_graph,
    REEB_PARTS_PT_boundaries,
    REEB_PARTS_PT_output,
    REEB_PARTS_PT_overlay,
)
