# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature with a bone for each part."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import armature
from ..scene.reporting import PartOperator
from ..scene.store import Stored


class REEB_PARTS_OT_armature(PartOperator, bpy.types.Operator):
    """Make an armature with a bone for each part, along the part's centre line, as a start for a rig"""

    bl_idname = "reeb_parts.armature"
    bl_label = "Make Armature from Parts"

    deform: bpy.props.BoolProperty(
        name="Move the Mesh", default=False,
        description="Add an Armature modifier, so that posing the bones moves the parts",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        rig = armature.make(context, obj, stored, self.deform)
        return rpt_("{name} has {n} bones").format(name=rig.name, n=len(rig.data.bones))
