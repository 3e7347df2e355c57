# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Use Parts": what parts can become."""

from __future__ import annotations

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_n as n_

from ..scene import piece_objects, store
from .panel import SubPanel, settings_column


class REEB_PARTS_PT_use(SubPanel, bpy.types.Panel):
    bl_label = "Use Parts"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return store.has_parts(context.object)

    def draw(self, context: bpy.types.Context) -> None:
        column, _ = settings_column(self, context)
        settings = context.scene.reeb_parts_use
        # How the button Separate, which is just above, makes objects.
        column.row().prop(settings, "which", expand=True)
        for name in ("cut", "caps", "center", "modifiers", "seen", "parent", "hide"):
            column.prop(settings, name)
        column.separator()
        column.prop(context.object.reeb_parts_made, "explode", slider=True)
        self._draw_outputs(context.object.data.reeb_parts)

    def _draw_outputs(self, result: bpy.types.PropertyGroup) -> None:
        """Buttons that stay pressed for as long as there is what they make."""
        row = self.layout.row(align=True)
        for name, text, there in (
            ("seams", n_("Seams", "Operator"), result.has_seams),
            ("face_sets", n_("Face Sets", "Operator"), result.has_face_sets),
            ("materials", n_("Materials", "Operator"), result.has_materials),
        ):
            row.operator(f"reeb_parts.{name}", text=text, depress=there).remove = there
        self.layout.operator("reeb_parts.unwrap", icon="UV")
        self.layout.operator("reeb_parts.export", text="Export to Files...", icon="EXPORT")
        self.layout.operator("reeb_parts.armature", text="Make Armature", icon="ARMATURE_DATA")


class REEB_PARTS_PT_piece(SubPanel, bpy.types.Panel):
    bl_label = "Separated Part"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.object is not None and piece_objects.original(context.object) is not None

    def draw(self, context: bpy.types.Context) -> None:
        obj = piece_objects.original(context.object)
        assert obj is not None  # poll
        self.layout.label(text=iface_("A part of {name}").format(name=obj.name), icon="MESH_DATA")
        show = iface_("Show {name}").format(name=obj.name)
        self.layout.operator("reeb_parts.show_original", text=show, icon="HIDE_OFF")


CLASSES = (REEB_PARTS_PT_use, REEB_PARTS_PT_piece)
