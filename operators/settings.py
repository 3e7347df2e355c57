# SPDX-License-Identifier: GPL-3.0-or-later
"""Set the scene's settings as the preferences or the preset have them."""

import bpy

from ..core.parameters import PRESETS
from ..scene import defaults
from ..scene.properties import OUTPUTS, OVERLAY
from ..scene.reporting import ReportingOperator
from ..scene.transaction import keep_group


class SceneOperator(ReportingOperator):
    """For operators on the settings of the scene."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene.is_editable


class REEB_PARTS_OT_use_preferences(SceneOperator, bpy.types.Operator):
    """Set this scene's preset, output and overlay as new scenes have them; see Preferences, Add-ons"""

    bl_idname = "reeb_parts.use_preferences"
    bl_label = "Use Preferences in This Scene"

    def run(self, context: bpy.types.Context) -> None:
        keep_group(context.scene, "reeb_parts")
        settings = context.scene.reeb_parts
        defaults.use(settings, ("preset", *OUTPUTS, *OVERLAY))
        # Also what was changed after the preset was chosen.
        settings.preset = settings.preset


class REEB_PARTS_OT_reset_parameters(SceneOperator, bpy.types.Operator):
    """Set the parameters back to those of the preset; some of them were changed"""

    bl_idname = "reeb_parts.reset_parameters"
    bl_label = "Reset Parameters to Preset"

    def run(self, context: bpy.types.Context) -> None:
        keep_group(context.scene, "reeb_parts")
        settings = context.scene.reeb_parts
        detail, n_parts = settings.detail, settings.n_parts
        settings.use_parameters(PRESETS[settings.preset])
        settings.detail, settings.n_parts = detail, n_parts
