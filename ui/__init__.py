# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab and the properties behind it."""

import bpy

from . import panel, properties, use_panel, use_properties

CLASSES = (*panel.CLASSES, *use_panel.CLASSES)


def register_properties():
    """Before the operators, which inherit from the properties."""
    properties.register()
    use_properties.register()


def unregister_properties():
    use_properties.unregister()
    properties.unregister()


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    panel.register_menus()


def unregister():
    panel.unregister_menus()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
