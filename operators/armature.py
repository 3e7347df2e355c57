# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature with a bone for each part."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene.moving import armature
from ..scene.reporting import SelectedPartsOperator, report_kept
from ..scene.store import Stored


class REEB_PARTS_OT_armature(SelectedPartsOperator, bpy.types.Operator):
    """Make an armature that moves the mesh smoothly, with a bone along the center line of each part that can bend"""

    bl_idname = "reeb_parts.armature"
    bl_label = "Make Armature from Parts"
    one_per_mesh = False

    deform: bpy.props.BoolProperty(
        name="Move the Mesh", default=True,
        description="Add an Armature modifier, so that posing the bones moves the parts",
    )
    weights: bpy.props.EnumProperty(
        name="Weights", default="SMOOTH",
        items=[("SMOOTH", "Smooth", "Change smoothly across the cuts, as far as the limb is thick"),
               ("AUTOMATIC", "Automatic", "Blender's own, by heat from the bones"),
               ("PARTS", "Parts", "Each part moves as a whole, by its own vertex group")],
        description="How much each bone moves each vertex; at most four bones move one",
    )

    def look(self, obj: bpy.types.Object) -> Stored:
        armature.check_alone(obj)
        return super().look(obj)

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        rig, stiff, kept = armature.make(context, obj, stored, self.deform, self.weights)
        report_kept(self.tell, kept)
        other = armature.other_rig(obj)
        if other is not None:
            message = rpt_("{name} is moved by {rig}, too: the new bones lie where it is at rest")
            self.report({"WARNING"}, message.format(name=obj.name, rig=other.name))
        if stiff:
            message = rpt_("{n} {n:part moves with the one it hangs|parts move with the ones they hang} on: "
                           "no neck to bend at")
            self.tell({"INFO"}, message.format(n=Count(stiff)))
        return rpt_("{name} has {n} {n:bone|bones}").format(name=rig.name, n=Count(len(rig.data.bones)))
