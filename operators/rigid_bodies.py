# SPDX-License-Identifier: GPL-3.0-or-later
"""Separated parts as rigid bodies with joints."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene import store, targets
from ..scene.changes import moved
from ..scene.modes import object_mode
from ..scene.pieces import piece_objects
from ..scene.reporting import ReportingOperator, named
from ..scene.result.part_list import check_parts
from ..scene.store import Stored


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
        chosen = targets.chosen_objects(context, self.report, one_per_mesh=False)
        active, *others = dict.fromkeys(map(piece_objects.separated, chosen))
        objects = [active, *(obj for obj in others if piece_objects.has_pieces(obj) and store.has_result(obj.data))]
        n_bodies = n_joints = 0
        with object_mode(context):
            for obj, stored in targets.usable(objects, _current, self.report):
                with named(obj, len(objects) > 1):
                    made = piece_objects.make_bodies(context, obj, stored, self.joints)
                n_bodies, n_joints = n_bodies + len(made.bodies), n_joints + len(made.joints)
        self.report({"INFO"}, rpt_("{n} {n:rigid body|rigid bodies}, {total} {total:joint|joints}").format(
            n=Count(n_bodies), total=Count(n_joints)))


def _current(obj: bpy.types.Object) -> Stored:
    """The parts of an object; raises SceneError if they are out of date, or its pieces are of other parts."""
    check_parts(obj)
    stored = moved.load(obj.data)
    piece_objects.check_current(obj, stored)
    return stored
