# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams, face sets and materials of the parts, each with one click, and taken back with another."""

import bpy
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_

from ..core.sentence import Count
from ..scene import modes, outputs, property_updates, store, targets
from ..scene.reporting import SelectedPartsOperator
from ..scene.store import Stored
from ..viewport import shading


class OutputOperator(SelectedPartsOperator):
    """For operators that write one thing more to the mesh, which then follows the parts until it is taken back.

    A class that inherits gives ``output``: its name, see outputs.write.OUTPUTS, and the sentences said of it when it
    was written and when it was taken back.
    """

    output: tuple[str, str, str]

    remove: bpy.props.BoolProperty(
        name="Take Back", options={"SKIP_SAVE"},
        description="Take them away again; what was there before is back",
    )

    @classmethod
    def description(cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """The tooltip of a button that is pressed already; else what the class says."""
        return tip_(properties.bl_rna.properties["remove"].description) if properties.remove else ""

    def look(self, obj: bpy.types.Object) -> Stored:
        # What is taken away need not be up to date.
        return store.last(obj.data) if self.remove else super().look(obj)

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        name, done, undone = self.output
        obj = targets.users(obj.data)[0]
        with property_updates.quiet():
            outputs.switch(obj, name, on=not self.remove)
            if not self.remove:
                numbered = stored.shown_parts()
                outputs.update_outputs(obj, numbered, numbered.candidate_numbers)
        obj.data.update()
        return rpt_(undone) if self.remove else rpt_(done).format(n=Count(len(obj.data.reeb_parts.parts)))


class REEB_PARTS_OT_seams(OutputOperator, bpy.types.Operator):
    """Mark UV seams where parts meet, beside your own; they follow the parts"""

    bl_idname = "reeb_parts.seams"
    bl_label = "Mark Seams between Parts"
    output = ("seams", n_("Seams around {n} {n:part|parts}"), n_("The seams are yours alone again"))


class REEB_PARTS_OT_face_sets(OutputOperator, bpy.types.Operator):
    """Make a face set of each part, for Sculpt Mode; they follow the parts"""

    bl_idname = "reeb_parts.face_sets"
    bl_label = "Make Face Sets of Parts"
    output = ("face_sets", n_("{n} {n:part is a face set|parts are face sets}"),
              n_("The face sets are yours alone again"))


class REEB_PARTS_OT_materials(OutputOperator, bpy.types.Operator):
    """Give each part a material of its own, in the part's color; they follow the parts"""

    bl_idname = "reeb_parts.materials"
    bl_label = "Give Each Part a Material"
    output = ("materials", n_("{n} {n:part has a material|parts have materials}"),
              n_("The materials are yours alone again"))

    def run(self, context: bpy.types.Context) -> None:
        super().run(context)
        if not self.remove and modes.lacks_colors(targets.active_object(context)):
            shading.show_colors(context)  # those of materials
