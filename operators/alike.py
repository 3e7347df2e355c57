# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that are alike, and names carried from one model to another."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene.changes import alike
from ..scene.reporting import PartOperator
from ..scene.store import Stored


class REEB_PARTS_OT_find_similar(PartOperator, bpy.types.Operator):
    """Mark the parts that are like the active one in size, shape and place, on all objects of the scene"""

    bl_idname = "reeb_parts.find_similar"
    bl_label = "Find Similar Parts"

    limit: bpy.props.FloatProperty(
        name="Difference", default=0.8, min=0.0, soft_max=3.0, step=10,
        description="How much parts may differ: 0 finds copies only, 1 most parts of a kind",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        n_parts, n_objects = alike.find_similar(context, obj, self.limit)
        if not n_parts:
            result = obj.data.reeb_parts
            return rpt_("No other part is like {name}; a larger difference finds more").format(
                name=result.parts[result.active].name)
        return rpt_("Similar parts: {n}, marked on {objects} {objects:object|objects}").format(
            n=n_parts, objects=Count(n_objects))


class REEB_PARTS_OT_names_from_active(PartOperator, bpy.types.Operator):
    """Give parts of the other selected objects the names of the same parts of the active one, in any pose"""

    bl_idname = "reeb_parts.names_from_active"
    bl_label = "Names from Active"

    everywhere: bpy.props.BoolProperty(
        name="All Objects", description="Name the parts of all decomposed objects, not only of selected ones")

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        n_parts, n_objects = alike.carry_names(context, obj, self.everywhere)
        return rpt_("Parts named: {n}, on {objects} {objects:object|objects}").format(
            n=n_parts, objects=Count(n_objects))
