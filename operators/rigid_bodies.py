# SPDX-License-Identifier: GPL-3.0-or-later
"""Separated parts as rigid bodies with joints."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene import piece_objects, store, targets
from ..scene.modes import object_mode
from ..scene.part_list import check_parts
from ..scene.reporting import ReportingOperator


class REEB_PARTS_OT_rigid_bodies(ReportingOperator, bpy.types.Operator):
    """Make rigid bodies of the separated parts, held together at the cuts; press Play to see them fall"""

    bl_idname = "reeb_parts.rigid_bodies"
    bl_label = "Make Rigid Bodies of Parts"

    joints: bpy.props.EnumProperty(
        name="Joints", default="HINGE",
        items=[("HINGE", "Hinges", "Bend about the longest line of the cut"),
               ("POINT", "Points", "Turn in every direction about the middle of the cut"),
               ("FIXED", "Fixed", "Do not move")],
        description="How parts hold together at the cuts",
    )

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        targets.check_object(targets.active_object(context))
        check_parts(piece_objects.whole(targets.active_object(context)))

    def run(self, context: bpy.types.Context) -> None:
        obj = piece_objects.whole(targets.active_object(context))
        with object_mode(context):
            made = piece_objects.make_bodies(context, obj, store.load(obj.data), self.joints)
        self.report({"INFO"}, rpt_("{n} {n:rigid body|rigid bodies}, {total} {total:joint|joints}").format(
            n=Count(len(made.bodies)), total=Count(len(made.joints))))
