# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls of the parts, for games and simulations."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene.moving import hulls
from ..scene.reporting import SelectedPartsOperator, report_kept
from ..scene.store import Stored


class REEB_PARTS_OT_hulls(SelectedPartsOperator, bpy.types.Operator):
    """Make convex hulls of each part, of at most 64 corners, with which games and simulations collide"""

    bl_idname = "reeb_parts.hulls"
    bl_label = "Make Collision Hulls of Parts"
    one_per_mesh = False

    engine: bpy.props.EnumProperty(
        name="Names", default="UNREAL",
        items=[("UNREAL", "Unreal", "UCX_, the object and a number"),
               ("GODOT", "Godot", "The part, then -convcolonly")],
        description="How the hulls are called, so that the game engine finds them",
    )
    count: bpy.props.IntProperty(
        name="Hulls per Part", default=1, min=1, max=8,
        description="How many hulls a part has at most; a part that one hull fits well has one",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        made = hulls.make(context, obj, stored, self.engine, self.count)
        report_kept(self.tell, made.kept)
        return rpt_("{n} {n:hull|hulls}").format(n=Count(len(made.hulls)))
