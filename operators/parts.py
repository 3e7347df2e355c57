# SPDX-License-Identifier: GPL-3.0-or-later
"""Work on the parts of the list: select, hide, look at, name, mark; show their colors."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene import store, targets
from ..scene.changes import moved, reactions
from ..scene.errors import SceneError
from ..scene.graph import graph_objects
from ..scene.modes import object_mode
from ..scene.reporting import PartOperator, ReportingOperator, chosen_with_parts, with_current_parts
from ..scene.result import naming, part_list, part_names, part_places
from ..scene.result.part_list import chosen_numbers
from ..scene.showing import hidden, selection
from ..scene.store import Stored
from ..viewport import framing, hover, pointing, shading


class REEB_PARTS_OT_select(PartOperator, bpy.types.Operator):
    """Select the faces of the parts chosen in the list, for Edit Mode"""

    bl_idname = "reeb_parts.select"
    bl_label = "Select Faces of Parts"

    action: bpy.props.EnumProperty(
        name="Action", translation_context="Reeb Parts",  # what Blender calls "Set" is a beginning in Chinese
        items=[("SET", "Set", "Select these faces and no others"),
               ("ADD", "Extend", "Add these faces to the selection"),
               ("SUBTRACT", "Subtract", "Take these faces from the selection")],
    )
    number: bpy.props.IntProperty(
        name="Part", default=0, min=0, options={"SKIP_SAVE"},
        description="Number of the part; 0 for those chosen in the list",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        numbers = [self.number] if self.number else chosen_numbers(obj.data)
        mask = np.isin(stored.face_numbers, numbers)
        if not mask.any():
            raise SceneError(rpt_("There is no part with the number {number}.").format(number=self.number))
        selection.select_faces(obj.data, mask, self.action)
        # In Object Mode nothing is seen of it.
        count = int(selection.selected_faces(obj.data).sum())
        return rpt_("{n} {n:face|faces} selected").format(n=Count(count))


class REEB_PARTS_OT_isolate(PartOperator, bpy.types.Operator):
    """Hide all faces but those of the chosen parts, or show all again"""

    bl_idname = "reeb_parts.isolate"
    bl_label = "Isolate Parts"

    show_all: bpy.props.BoolProperty(
        name="Show All", options={"SKIP_SAVE"}, description="Show every face again",
    )

    def run(self, context: bpy.types.Context) -> None:
        if not self.show_all:
            super().run(context)
            return
        obj = targets.active_object(context)
        assert obj is not None  # check_context has looked
        with object_mode(context):  # also if the mesh was edited, as a part is that was isolated for it
            hidden.isolate(obj.data, np.full(len(obj.data.polygons), True))
            _look_again(obj.data, store.last(obj.data))

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        hidden.isolate(obj.data, np.isin(stored.face_numbers, chosen_numbers(obj.data)))
        _look_again(obj.data, stored)


class REEB_PARTS_OT_hide(PartOperator, bpy.types.Operator):
    """Hide the faces of the chosen parts, beside those that are hidden"""

    bl_idname = "reeb_parts.hide"
    bl_label = "Hide Parts"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        hidden.hide(obj.data, np.isin(stored.face_numbers, chosen_numbers(obj.data)))
        _look_again(obj.data, stored)


def _look_again(mesh: bpy.types.Mesh, stored: Stored) -> None:
    """Show of the graph and of what is pointed at what is seen of the parts, now that others are hidden."""
    pointing.forget()
    hover.clear()  # until the pointer moves, it would stay filled
    for user in targets.users(mesh):
        graph_objects.update_parts(user, stored.shown_parts())


class REEB_PARTS_OT_frame(PartOperator, bpy.types.Operator):
    """Look at the chosen parts from near"""

    bl_idname = "reeb_parts.frame"
    bl_label = "Frame Parts"
    bl_options = {"REGISTER"}

    in_list: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"})  # only if the pointer is over the list

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        listed = getattr(context.ui_list, "bl_idname", "")
        return {"PASS_THROUGH"} if self.in_list and listed != "REEB_PARTS_UL_parts" else self.execute(context)

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        mask = np.isin(stored.face_numbers, chosen_numbers(obj.data))
        framing.look_at(context, *part_places.box(obj, mask))


class REEB_PARTS_OT_suggest_names(ReportingOperator, bpy.types.Operator):
    """Name the parts that you have not named by what they are: head, leg, handle; else by their place and kind"""

    bl_idname = "reeb_parts.suggest_names"
    bl_label = "Suggest Names"

    def run(self, context: bpy.types.Context) -> None:
        objects = chosen_with_parts(context, self.report)
        with object_mode(context):
            found = list(with_current_parts(objects, self.report))
            count = sum(self._named(obj, stored) for obj, stored in found)
        total = sum(len(obj.data.reeb_parts.parts) for obj, _ in found)
        if count or not total:
            self.report({"INFO"}, rpt_("{n} {n:part is|parts are} named").format(n=Count(count)))
        else:
            self.report({"INFO"}, rpt_("All named already: {n} {n:part|parts}").format(n=Count(total)))

    def _named(self, obj: bpy.types.Object, stored: Stored) -> int:
        """How many parts of an object were named."""
        named = part_names.kept_names(obj.data)
        names = {number: name for number, name in naming.suggested(obj, stored).items()
                 if number not in named or part_names.lacks_side(named[number], name)}
        return reactions.give_names(obj.data, names, given=True)


class REEB_PARTS_OT_show_colors(ReportingOperator, bpy.types.Operator):
    """Show the parts' colors in this viewport: Solid, colored by attribute"""

    bl_idname = "reeb_parts.show_colors"
    bl_label = "Show Colors of Parts"
    bl_options = {"REGISTER"}

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        if not store.has_parts(targets.active_object(context)):  # nothing is written to them: they may be linked
            super().check_context(context)

    def run(self, context: bpy.types.Context) -> None:
        obj = targets.active_object(context)
        assert obj is not None  # check_context has looked
        if not obj.data.reeb_parts.color_attribute:
            raise SceneError(rpt_("The parts have no colors. Switch these on under Advanced, Output; decompose again."))
        shading.turn_to_colors(context)


class REEB_PARTS_OT_mark(ReportingOperator, bpy.types.Operator):
    """Mark parts in the list"""

    bl_idname = "reeb_parts.mark"
    bl_label = "Mark Parts"

    action: bpy.props.EnumProperty(
        name="Action",
        items=[("ALL", "All", "Mark every part"), ("NONE", "None", "Mark no part"),
               ("INVERT", "Invert", "Mark the parts that are not chosen"),
               ("SMALL", "Smaller", "Mark the parts smaller than the active one"),
               ("FACES", "Of Selected Faces", "Mark the parts that have selected faces")],
    )

    def run(self, context: bpy.types.Context) -> None:
        obj = targets.active_object(context)
        assert obj is not None  # check_context has looked
        mesh = obj.data
        with_faces = set()
        if self.action == "FACES":
            with object_mode(context):
                with_faces = set(moved.load(mesh).face_numbers[selection.selected_faces(mesh)].tolist())
        part_list.mark(mesh, self.action, with_faces)
