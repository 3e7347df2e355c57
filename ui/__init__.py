# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab and the properties behind it."""

import bpy

from ..scene import properties, use_properties
from . import menus, panel, preferences, translations, use_panel

# Sub-panels stand in the order of their registration: what is used often comes before the settings.
_PLACE = panel.CLASSES.index(panel.REEB_PARTS_PT_parts) + 1
CLASSES = (*menus.CLASSES, *panel.CLASSES[:_PLACE], *use_panel.CLASSES, *panel.CLASSES[_PLACE:])


def register_properties():
    """Before the operators, which inherit from the properties."""
    properties.register()
    preferences.register()
    use_properties.register()


def unregister_properties():
    use_properties.unregister()
    preferences.unregister()
    properties.unregister()


def register():
    translations.register()
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    menus.register()


def unregister():
    menus.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    translations.unregister()
