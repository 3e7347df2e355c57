# SPDX-License-Identifier: GPL-3.0-or-later
"""The shortcut of the menu "Reeb Parts" over a 3D viewport, which the preferences show and let change.

And a double click on a part in the list, beside its name: on the name, Blender lets the user change it.
"""

from __future__ import annotations

import bpy

_added: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []


def register() -> None:
    keys = bpy.context.window_manager.keyconfigs.addon
    if keys is None:  # without a window
        return
    keymap = keys.keymaps.new("3D View", space_type="VIEW_3D")
    item = keymap.keymap_items.new("wm.call_menu", "P", "PRESS", ctrl=True, alt=True)
    item.properties.name = "REEB_PARTS_MT_main"
    _added.append((keymap, item))
    keymap = keys.keymaps.new("User Interface")
    item = keymap.keymap_items.new("reeb_parts.frame", "LEFTMOUSE", "DOUBLE_CLICK")
    item.properties.in_list = True
    _added.append((keymap, item))


def unregister() -> None:
    while _added:
        keymap, item = _added.pop()
        keymap.keymap_items.remove(item)


def draw(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """The keys of the menu, as the user has set them."""
    import rna_keymap_ui

    keys = context.window_manager.keyconfigs.user
    keymap = keys.keymaps.get("3D View") if keys is not None else None
    for item in keymap.keymap_items if keymap is not None else ():
        if item.idname == "wm.call_menu" and getattr(item.properties, "name", "") == "REEB_PARTS_MT_main":
            rna_keymap_ui.draw_kmi([], keys, keymap, item, layout, 0)
