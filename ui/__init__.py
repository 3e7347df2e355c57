# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab, menus, preferences and translations. An operator is named by its id, never imported."""

from __future__ import annotations

import bpy

from . import menus, panel, preferences, translations, use_panel

# Sub-panels stand in the order of their registration: what is used often comes before the settings.
_PLACE = panel.CLASSES.index(panel.REEB_PARTS_PT_parts) + 1
CLASSES = (*menus.CLASSES, *panel.CLASSES[:_PLACE], *use_panel.CLASSES, *panel.CLASSES[_PLACE:])


def register() -> None:
    translations.register()
    preferences.register()
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    menus.register()


def unregister() -> None:
    menus.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    preferences.unregister()
    translations.unregister()
