# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar tab, menus, preferences and translations. An operator is named by its id, never imported."""

from __future__ import annotations

import bpy

from . import advanced_panel, menus, panel, parts_list, preferences, shortcut, toolbar, translations, use_panel

# Sub-panels stand in the order of their registration: what is used often comes before the settings.
CLASSES = (preferences.ReebPartsPreferences, *menus.CLASSES, *parts_list.CLASSES, *panel.CLASSES,
           *use_panel.CLASSES, *advanced_panel.CLASSES)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register() -> None:
    translations.register()
    _register_classes()
    menus.register()
    shortcut.register()
    toolbar.register()


def unregister() -> None:
    toolbar.unregister()
    shortcut.unregister()
    menus.unregister()
    _unregister_classes()
    translations.unregister()
