# SPDX-License-Identifier: GPL-3.0-or-later
"""Menus: of the parts in the list, and "Reeb Parts" in the header, where search (F3) finds every operator."""

from __future__ import annotations

import bpy


def _invoking(menu: bpy.types.Menu) -> bpy.types.UILayout:
    """The layout of a menu whose commands are invoked.

    One that a shortcut opens would execute them: they would ignore the panel, and no tool would start.
    """
    menu.layout.operator_context = "INVOKE_REGION_WIN"
    return menu.layout


class REEB_PARTS_MT_parts(bpy.types.Menu):
    bl_idname = "REEB_PARTS_MT_parts"
    bl_label = "Parts"

    def draw(self, context: bpy.types.Context) -> None:
        draw_part_menu(_invoking(self))


def _draw_operators(layout: bpy.types.UILayout, *entries: tuple[str, str]) -> None:
    """Operators by their ids, each with its icon."""
    for name, icon in entries:
        layout.operator(name, icon=icon)


def draw_part_menu(layout: bpy.types.UILayout) -> None:
    """All that can be done with the chosen parts; also in the list's context menu."""
    layout.operator_menu_enum("reeb_parts.mark", "action", icon="CHECKBOX_HLT")
    _draw_operators(
        layout, ("reeb_parts.suggest_names", "SORTALPHA"), ("reeb_parts.names_from_active", "NONE"),
        ("reeb_parts.find_similar", "NONE"), ("reeb_parts.frame", "VIEWZOOM"), ("reeb_parts.rename", "NONE"),
        ("reeb_parts.hide", "HIDE_ON"))
    layout.separator()
    _draw_operators(
        layout, ("reeb_parts.merge", "AUTOMERGE_ON"), ("reeb_parts.merge_neighbour", "NONE"),
        ("reeb_parts.merge_small", "NONE"),
        ("reeb_parts.split", "MOD_EDGESPLIT"), ("reeb_parts.cut", "MOD_BOOLEAN"), ("reeb_parts.grow", "ADD"),
        ("reeb_parts.shrink", "REMOVE"), ("reeb_parts.slide", "ARROW_LEFTRIGHT"), ("reeb_parts.paint", "BRUSH_DATA"))
    asking = layout.operator_context
    layout.operator_context = "EXEC_DEFAULT"
    layout.operator("reeb_parts.grow", text="Grow to Next Crease").rings = 0
    layout.operator("reeb_parts.shrink", text="Shrink to Next Crease").rings = 0
    layout.operator_context = asking  # it is that of the whole menu
    layout.separator()
    layout.operator("reeb_parts.assign", icon="FACESEL").new = False
    layout.operator("reeb_parts.assign", text="New Part of Selected Faces").new = True
    layout.operator("reeb_parts.from_face_sets")
    layout.separator()
    layout.operator("reeb_parts.release", icon="UNPINNED").everything = False
    layout.operator("reeb_parts.release", text="Release All Parts").everything = True
    layout.separator()
    layout.operator("reeb_parts.to_nodes", icon="EMPTY_AXIS")


def _draw_list_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """Under what Blender itself offers for an entry of a list."""
    ui_list = getattr(context, "ui_list", None)
    if ui_list is not None and ui_list.bl_idname == "REEB_PARTS_UL_parts":
        self.layout.separator()
        draw_part_menu(self.layout)


class REEB_PARTS_MT_pieces(bpy.types.Menu):
    bl_idname = "REEB_PARTS_MT_pieces"
    bl_label = "Separated Pieces"

    def draw(self, context: bpy.types.Context) -> None:
        layout = _invoking(self)
        _draw_operators(layout, ("reeb_parts.show_original", "NONE"), ("reeb_parts.show_pieces", "NONE"))
        layout.separator()
        _draw_operators(
            layout, ("reeb_parts.check_pieces", "NONE"), ("reeb_parts.select_faults", "NONE"),
            ("reeb_parts.repair_piece", "NONE"))


class REEB_PARTS_MT_use(bpy.types.Menu):
    bl_idname = "REEB_PARTS_MT_use"
    bl_label = "Use Parts"

    def draw(self, context: bpy.types.Context) -> None:
        layout = _invoking(self)
        _draw_operators(
            layout, ("reeb_parts.seams", "NONE"), ("reeb_parts.face_sets", "NONE"), ("reeb_parts.materials", "NONE"),
            ("reeb_parts.unwrap", "UV"))
        layout.separator()
        _draw_operators(
            layout, ("reeb_parts.export", "EXPORT"), ("reeb_parts.armature", "ARMATURE_DATA"),
            ("reeb_parts.hulls", "MESH_ICOSPHERE"), ("reeb_parts.rigid_bodies", "RIGID_BODY"))


class REEB_PARTS_MT_main(bpy.types.Menu):
    bl_idname = "REEB_PARTS_MT_main"
    bl_label = "Reeb Parts"

    def draw(self, context: bpy.types.Context) -> None:
        layout = _invoking(self)
        _draw_operators(layout, ("reeb_parts.decompose", "MOD_EXPLODE"), ("reeb_parts.clear", "TRASH"))
        _draw_operators(layout, ("reeb_parts.show_colors", "SHADING_SOLID"), ("reeb_parts.show_graph", "NONE"))
        layout.operator("reeb_parts.step_detail", text="Fewer Parts").more = False
        layout.operator("reeb_parts.step_detail", text="More Parts").more = True
        layout.separator()
        _draw_operators(layout, ("reeb_parts.pick", "EYEDROPPER"), ("reeb_parts.select", "RESTRICT_SELECT_OFF"))
        layout.operator("reeb_parts.isolate", icon="HIDE_OFF").show_all = False
        layout.operator("reeb_parts.isolate", text="Show All Parts").show_all = True
        layout.menu("REEB_PARTS_MT_parts")
        _draw_operators(layout, ("reeb_parts.from_nodes", "NONE"), ("reeb_parts.split_at_node", "NONE"))
        layout.separator()
        _draw_operators(layout, ("reeb_parts.separate", "OUTLINER_OB_GROUP_INSTANCE"))
        layout.menu("REEB_PARTS_MT_pieces")
        layout.menu("REEB_PARTS_MT_use")
        layout.separator()
        _draw_operators(
            layout, ("reeb_parts.reset_parameters", "LOOP_BACK"), ("reeb_parts.use_preferences", "PREFERENCES"))


# The menu of each mode that operators work in.
PLACES = (
    "VIEW3D_MT_object",
    "VIEW3D_MT_edit_mesh",
    "VIEW3D_MT_sculpt",
    "VIEW3D_MT_paint_weight",
    "VIEW3D_MT_paint_vertex",
)

CLASSES = (REEB_PARTS_MT_parts, REEB_PARTS_MT_pieces, REEB_PARTS_MT_use, REEB_PARTS_MT_main)


def _draw(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.menu("REEB_PARTS_MT_main")


def register() -> None:
    bpy.types.UI_MT_list_item_context_menu.append(_draw_list_menu)
    for name in PLACES:
        getattr(bpy.types, name).append(_draw)


def unregister() -> None:
    for name in PLACES:
        getattr(bpy.types, name).remove(_draw)
    bpy.types.UI_MT_list_item_context_menu.remove(_draw_list_menu)
