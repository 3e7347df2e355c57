# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Advanced": the method and its parameters, what is written, how the graph is drawn."""

from __future__ import annotations

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ..core.parameters import heeded
from ..core.sentence import Count
from ..scene import store
from ..scene.properties import OUTPUTS, OVERLAY
from .fitting import Room
from .panel import ReebPanel, SubPanel


def facts(result: bpy.types.PropertyGroup) -> list[str]:
    """What came out, in two lines."""
    parts = iface_("{n} {n:part|parts}").format(n=Count(len(result.parts)))
    graph = iface_("{nodes}, {arcs}, {loops}").format(
        nodes=iface_("{n} {n:node|nodes}").format(n=Count(result.n_nodes)),
        arcs=iface_("{n} {n:arc|arcs}").format(n=Count(result.n_arcs)),
        loops=iface_("{n} {n:loop|loops}").format(n=Count(result.n_loops)))
    return [iface_("{parts} in {seconds:.2f} s").format(parts=parts, seconds=result.seconds), graph]


class REEB_PARTS_PT_advanced(SubPanel, bpy.types.Panel):
    bl_idname = "REEB_PARTS_PT_advanced"
    bl_label = "Advanced"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.reeb_parts
        row = self.layout.row(align=True)
        row.prop(settings, "preset", text="")
        if settings.differs_from_preset():
            row.operator("reeb_parts.reset_parameters", text="", icon="LOOP_BACK")
        if store.has_parts(context.object):
            column = self.layout.column(align=True)
            column.scale_y = 0.8
            room = Room(context)
            for line in facts(context.object.data.reeb_parts):
                room.wrapped(column, line)


class SettingsPanel(ReebPanel):
    """For closed panels below Advanced that show settings of the scene, by name, one below the other.

    Those that do not count with the method are left out.
    """

    bl_parent_id = "REEB_PARTS_PT_advanced"
    bl_options = {"DEFAULT_CLOSED"}
    layout: bpy.types.UILayout  # of bpy.types.Panel, which the class that inherits is, too
    names: tuple[str, ...]

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.reeb_parts
        Room(context).properties(self.layout.column(), settings, self.counting(settings.method))

    @classmethod
    def counting(cls, method: str) -> list[str]:
        """The names of the settings that count with a method."""
        return heeded(method, cls.names)


class REEB_PARTS_PT_field(SettingsPanel, bpy.types.Panel):
    bl_label = "Field"
    names = ("base_spacing", "equalize", "n_slabs")


class REEB_PARTS_PT_graph(SettingsPanel, bpy.types.Panel):
    bl_label = "Graph"
    names = ("method", "hints", "pieces", "symmetry", "small_region", "n_clusters", "outline_weight", "loose_part")


class REEB_PARTS_PT_boundaries(SettingsPanel, bpy.types.Panel):
    bl_label = "Boundaries"
    names = ("follow_level_sets", "band_ratio", "concavity_weight", "sigma", "smoothing")


class REEB_PARTS_PT_output(SettingsPanel, bpy.types.Panel):
    bl_label = "Output"
    names = OUTPUTS


class REEB_PARTS_PT_overlay(SettingsPanel, bpy.types.Panel):
    bl_label = "Overlay"
    names = (*OVERLAY, "highlight", "show_cuts", "small")


CLASSES = (
    REEB_PARTS_PT_advanced,
    REEB_PARTS_PT_field,
    REEB_PARTS_PT_graph,
    REEB_PARTS_PT_boundaries,
    REEB_PARTS_PT_output,
    REEB_PARTS_PT_overlay,
)
