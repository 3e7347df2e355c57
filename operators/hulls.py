# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls of the parts, for games and simulations."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene import hulls
from ..scene.reporting import PartOperator
from ..scene.store import Stored


class REEB_PARTS_OT_hulls(PartOperator, bpy.types.Operator):
    """Make a convex hull of each part, of at most 64 corners, with which games and simulations collide"""

    bl_idname = "reeb_parts.hulls"
    bl_label = "Make Collision Hulls of Parts"

    engine: bpy.props.EnumProperty(
        name="Names", default="UNREAL",
        items=[("UNREAL", "Unreal", "UCX_, the object and a number"),
               ("GODOT", "Godot", "The part, then -convcolonly")],
        description="How the hulls are called, so that the game engine finds them",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        return rpt_("{n} {n:hull|hulls}").format(n=Count(len(hulls.make(context, obj, stored, self.engine))))
