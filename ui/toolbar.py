# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool "Reeb Parts" in the toolbar (T) of a 3D viewport: parts are pointed at, and each key does something to them.

Blender shows its keys in the preferences, under Keymap, where they can be changed. A key whose operator cannot be used,
as on an object without parts, goes on to Blender.
"""

from __future__ import annotations

from importlib.resources import files
from typing import Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_n as n_

from ..scene import store
from .fitting import Room

IDNAME = "reeb_parts.parts"


def _item(operator: str, key: str, properties: dict[str, Any] | None = None,
          **held: bool) -> tuple[str, dict[str, Any], dict[str, Any] | None]:
    """An item of a keymap, as Blender writes them. held : shift, ctrl or alt."""
    given = {"properties": list(properties.items())} if properties else None
    return operator, {"type": key, "value": "PRESS", **held}, given


KEYMAP = (  # Blender asks in no order that can be relied on
    _item("reeb_parts.choose", "LEFTMOUSE", properties={"mode": "SET"}),
    _item("reeb_parts.choose", "LEFTMOUSE", properties={"mode": "ADD"}, shift=True),
    _item("reeb_parts.choose", "LEFTMOUSE", properties={"mode": "SUB"}, ctrl=True),
    _item("reeb_parts.merge", "M"),
    _item("reeb_parts.cut", "C"),
    _item("reeb_parts.slide", "S"),
    _item("reeb_parts.grow", "G"),
    _item("reeb_parts.paint", "P"),
    _item("reeb_parts.rename", "F2"),
    _item("reeb_parts.hide", "H"),
    _item("reeb_parts.isolate", "H", properties={"show_all": False}, shift=True),
    _item("reeb_parts.isolate", "H", properties={"show_all": True}, alt=True),
    _item("reeb_parts.frame", "NUMPAD_PERIOD"),
    _item("reeb_parts.mark", "A", properties={"action": "ALL"}),
    _item("reeb_parts.mark", "A", properties={"action": "NONE"}, alt=True),
    _item("reeb_parts.mark", "I", properties={"action": "INVERT"}, ctrl=True),
    _item("reeb_parts.no_key", "R"),
    _item("reeb_parts.no_key", "X"),
    _item("reeb_parts.no_key", "DEL"),
)

#: What the status bar says, in this order.
SHOWN = {
    "reeb_parts.merge": n_("Merge", "Reeb Parts"), "reeb_parts.cut": n_("Cut", "Reeb Parts"),
    "reeb_parts.slide": n_("Slide", "Reeb Parts"), "reeb_parts.grow": n_("Grow", "Reeb Parts"),
    "reeb_parts.paint": n_("Paint", "Reeb Parts"), "reeb_parts.rename": n_("Rename", "Reeb Parts"),
    "reeb_parts.hide": n_("Hide", "Reeb Parts"), "reeb_parts.frame": n_("Frame", "Reeb Parts"),
}


class ReebPartsTool(bpy.types.WorkSpaceTool):
    bl_space_type = "VIEW_3D"
    bl_context_mode = "OBJECT"
    bl_idname = IDNAME
    bl_label = "Reeb Parts"
    bl_description = n_("Choose and change parts: what is under the pointer is filled and named")
    bl_icon = str(files(__package__) / "parts")  # parts.dat; Blender adds the ending
    bl_cursor = "DEFAULT"
    bl_widget = "REEB_PARTS_GGT_hover"
    bl_keymap = KEYMAP

    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, tool: bpy.types.WorkSpaceTool) -> None:
        obj = context.view_layer.objects.active
        if not store.has_parts(obj):
            layout.operator("reeb_parts.decompose", text="Decompose", icon="MOD_EXPLODE")


def is_active(context: bpy.types.Context) -> bool:
    """Whether the tool is the active one of the workspace, in Object Mode."""
    tool = context.workspace.tools.from_space_view3d_mode("OBJECT", create=False)
    return tool is not None and tool.idname == IDNAME and context.mode == "OBJECT"


def draw_button(layout: bpy.types.UILayout, context: bpy.types.Context, room: Room) -> None:
    """The button of the sidebar that makes the tool the active one."""
    row = layout.row(align=True)
    row.enabled = context.mode == "OBJECT"
    room.operator(row, "wm.tool_set_by_id", text="Pick", text_ctxt="Reeb Parts", icon="EYEDROPPER",
                  depress=is_active(context)).name = IDNAME


def _draw_keys(self: bpy.types.Header, context: bpy.types.Context) -> None:
    """The keys of the tool in the status bar, as the user has set them."""
    if (not is_active(context) or context.window.modal_operators
            or not store.has_parts(context.view_layer.objects.active)):
        return
    keymap = context.window_manager.keyconfigs.user.keymaps.get(ReebPartsTool._bl_tool.keymap[0])
    keys = {item.idname: item for item in reversed(keymap.keymap_items) if item.active} if keymap else {}
    row = self.layout.row(align=True)
    for name, text in SHOWN.items():
        if name in keys:
            _draw_key(row, keys[name], iface_(text, "Reeb Parts"))


def _draw_key(row: bpy.types.UILayout, item: bpy.types.KeyMapItem, text: str) -> None:
    icon = f"EVENT_{item.type}"
    plain = not (item.shift or item.ctrl or item.alt or item.oskey)
    if plain and icon in bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items:
        row.label(text=text, icon=icon)
    else:
        row.label(text=f"{item.to_string()} {text}")
    row.separator()


def register() -> None:
    bpy.utils.register_tool(ReebPartsTool, separator=True)
    bpy.types.STATUSBAR_HT_header.prepend(_draw_keys)


def unregister() -> None:
    bpy.types.STATUSBAR_HT_header.remove(_draw_keys)
    bpy.utils.unregister_tool(ReebPartsTool)
