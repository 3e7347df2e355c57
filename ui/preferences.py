# SPDX-License-Identifier: GPL-3.0-or-later
"""What every new scene starts with, in Blender's preferences."""

from typing import Any

import bpy
from bpy.props import EnumProperty

from .. import __package__ as base_package
from ..scene.settings import OUTPUTS, OVERLAY, PRESET_ITEMS, OutputProperties, OverlayProperties
from . import shortcut


def _without_update(prop: Any) -> Any:
    """Copy a property without its update, for a place where changing it draws nothing."""
    return prop.function(**{key: value for key, value in prop.keywords.items() if key != "update"})


class OverlayDefaults:
    """The properties of OverlayProperties."""

    __annotations__ = {name: _without_update(prop) for name, prop in OverlayProperties.__annotations__.items()}


class ReebPartsPreferences(bpy.types.AddonPreferences, OutputProperties, OverlayDefaults):
    """Settings of new scenes, and of scripts that do not give their own."""

    bl_idname = base_package

    preset: EnumProperty(
        name="Preset", items=PRESET_ITEMS, description="The parameters that new scenes start with",
    )

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        shortcut.draw(layout, context)
        layout.use_property_split = True
        layout.label(text="New scenes start with these settings.")
        layout.prop(self, "preset")
        column = layout.column(heading="Output")
        for name in OUTPUTS:
            column.prop(self, name)
        column = layout.column()
        for name in OVERLAY:
            column.prop(self, name)
        layout.operator("reeb_parts.use_preferences")
