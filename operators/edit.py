# SPDX-License-Identifier: GPL-3.0-or-later
"""Change parts by hand: merge, split, grow, shrink, assign, release; see edits and face_edits in scene.changes."""

from collections.abc import Callable

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene.changes import edits, face_edits, pins
from ..scene.errors import SceneError
from ..scene.reporting import PartOperator
from ..scene.result import part_list, part_names
from ..scene.result.part_list import chosen_numbers
from ..scene.store import Stored
from ..viewport.modal.ring_tool import RingTool, move


class REEB_PARTS_OT_merge(PartOperator, bpy.types.Operator):
    """Make one part of the parts marked in the list; it takes the name of the active one"""

    bl_idname = "reeb_parts.merge"
    bl_label = "Merge Parts"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        numbers = chosen_numbers(obj.data)
        if len(numbers) < 2:
            raise SceneError(rpt_("Mark the parts to merge in the list, two or more."))
        active = part_list.active_number(obj.data)
        into = active if active in numbers else numbers[0]
        after = edits.merged(obj.data, stored, numbers, into)
        together = np.unique(stored.shown[after.shown == into])  # with mirror images that were not marked
        pins.write(context, obj.data, stored, after)
        part_list.mark(obj.data, "NONE")
        return rpt_("{n} {n:part is|parts are} {name} now").format(
            n=Count(len(together)), name=part_names.part_name(obj.data, into))


class ChosenPartsOperator(PartOperator):
    """For operators that do something with each of the chosen parts: ``edit`` of scene.changes.edits.

    If it is not possible with one of them, nothing is done.
    """

    edit: Callable[[bpy.types.Mesh, Stored, int], Stored]

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str | None:
        numbers, names = chosen_numbers(obj.data), part_names.all_names(obj.data)
        pins.check_unlocked(obj.data, numbers)
        after = stored
        for number in edits.one_of_each_pair(stored, numbers):
            after = self.edit(obj.data, after, number)
        pins.write(context, obj.data, stored, after)
        ended = face_edits.told_of_ended(obj.data, names)
        return ended[:1].upper() + ended[1:] or None


class REEB_PARTS_OT_merge_neighbour(PartOperator, bpy.types.Operator):
    """Merge each chosen part into the neighbor that it is least clearly cut from"""

    bl_idname = "reeb_parts.merge_neighbour"
    bl_label = "Merge into Neighbor"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        numbers = chosen_numbers(obj.data)
        pins.check_unlocked(obj.data, numbers)
        pins.write(context, obj.data, stored, edits.merged_into_neighbors(obj.data, stored, numbers))


class REEB_PARTS_OT_merge_small(PartOperator, bpy.types.Operator):
    """Merge each of the small parts into the neighbor that it is least clearly cut from"""

    bl_idname = "reeb_parts.merge_small"
    bl_label = "Merge Small Parts"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        small = sorted(part_list.small_parts(obj.data), key=lambda part: part.share)
        after, count = edits.small_merged(obj.data, stored, [part.number for part in small])
        if not count:
            raise SceneError(rpt_("There are no small parts to merge."))
        pins.write(context, obj.data, stored, after)
        return rpt_("{n} small {n:part is|parts are} merged").format(n=Count(count))


class REEB_PARTS_OT_split(ChosenPartsOperator, bpy.types.Operator):
    """Split each chosen part in two, where its own best cut is"""

    bl_idname = "reeb_parts.split"
    bl_label = "Split Parts"
    edit = staticmethod(edits.halved)


class MovedPartsOperator(RingTool, ChosenPartsOperator):
    """For Grow and Shrink: over a view ring by ring, for scripts by a number of rings or as far as the next crease."""

    needs_object_mode = False

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        in_view = context.area is not None and context.area.type == "VIEW_3D" and context.mode == "OBJECT"
        return super().invoke(context, event) if in_view else self.execute(context)

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str | None:
        if not self.rings:
            return super().work(context, obj, stored)
        return move(context, obj, stored, self.boundaries(obj, stored), self.rings)


class REEB_PARTS_OT_grow(MovedPartsOperator, bpy.types.Operator):
    """Move the boundary of each chosen part outwards, ring by ring"""

    bl_idname = "reeb_parts.grow"
    bl_label = "Grow Parts"
    edit = staticmethod(edits.grown)

    rings: bpy.props.IntProperty(
        name="Rings", default=0, options={"SKIP_SAVE"},
        description="How many rings, negative inwards; 0 for as far as the next crease beyond the weakest stretch",
    )


class REEB_PARTS_OT_shrink(MovedPartsOperator, bpy.types.Operator):
    """Move the boundary of each chosen part inwards, ring by ring"""

    bl_idname = "reeb_parts.shrink"
    bl_label = "Shrink Parts"
    way = -1
    edit = staticmethod(edits.shrunk)

    rings: bpy.props.IntProperty(
        name="Rings", default=0, options={"SKIP_SAVE"},
        description="How many rings, positive outwards; 0 for as far as the next crease",
    )


class REEB_PARTS_OT_assign(PartOperator, bpy.types.Operator):
    """Give the faces selected in Edit Mode to the active part"""

    bl_idname = "reeb_parts.assign"
    bl_label = "Assign Faces to Part"

    new: bpy.props.BoolProperty(
        name="New Part", options={"SKIP_SAVE"}, description="Make a part of its own of the faces",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        mesh = obj.data
        number = pins.free_number(mesh, stored) if self.new else part_list.active_number(mesh)
        told = face_edits.assign_selected(context, obj, stored, number)
        part_list.make_active(mesh, number)
        return told


class REEB_PARTS_OT_from_face_sets(PartOperator, bpy.types.Operator):
    """Take over what you have painted with face sets in Sculpt Mode: each face goes to the part of its face set"""

    bl_idname = "reeb_parts.from_face_sets"
    bl_label = "Parts from Face Sets"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        names = part_names.all_names(obj.data)
        count = face_edits.assign_face_sets(context, obj, stored)
        told = rpt_("{n} {n:face is in another part|faces are in other parts} now").format(n=Count(count))
        return "; ".join(filter(None, (told, face_edits.told_of_ended(obj.data, names))))


class REEB_PARTS_OT_release(PartOperator, bpy.types.Operator):
    """Let the detail decide about the chosen parts again, which were changed by hand"""

    bl_idname = "reeb_parts.release"
    bl_label = "Release Parts"

    everything: bpy.props.BoolProperty(
        name="All", options={"SKIP_SAVE"}, description="Release every part that is not locked",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        which = "ALL" if self.everything else "CHOSEN"
        pins.release(context, obj.data, stored, part_list.wanted_numbers(obj.data, which))
