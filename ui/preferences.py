# SPDX-License-Identifier: GPL-3.0-or-later
"""What every new scene starts with, in Blender's preferences."""

import bpy
from bpy.props import EnumProperty

from .. import __package__ as base_package
from ..scene.properties import OUTPUTS, OVERLAY, OutputProperties, OverlayProperties
from ..scene.settings import PRESET_ITEMS
from . import shortcut


class ReebPartsPreferences(bpy.types.AddonPreferences, OutputProperties, OverlayProperties):
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
