# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Use Parts": what parts can become."""

from __future__ import annotations

from collections.abc import Iterable

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_n as n_

from ..core.sentence import Count
from ..scene import store, targets
from ..scene.errors import SceneError
from ..scene.pieces import cut_list, origins, piece_checks, piece_objects
from ..scene.reading.placing import length_words
from .fitting import Room
from .panel import SubPanel
from .parts_list import BAR, FRAME

#: Why a cut has no joint, see joints.CutJoints.
REASONS = {"ROOM": n_("No room with a wall around it"), "BENT": n_("Too bent to have an axis"),
           "BODY": n_("A part is not closed"), "RESULT": n_("It would spoil a part")}

# What a field of a choice has beside its word, and a label with an icon, in pixels of a screen without scaling.
CHOICE, LABEL = 26, 38


class REEB_PARTS_PT_use(SubPanel, bpy.types.Panel):
    bl_label = "Use Parts"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return store.has_parts(context.object)

    def draw(self, context: bpy.types.Context) -> None:
        column, room, settings = self.layout.column(), Room(context), context.scene.reeb_parts_use
        # How the button Separate, which is just above, makes objects.
        room.properties(column, settings, settings.rows, expanded={"which"})
        if settings.joints != "NONE":
            self._draw_cuts(column, room, context.object)
        column.separator()
        room.properties(column, context.object.reeb_parts_made, ("explode",))
        self._draw_outputs(room, context.object)

    def _draw_cuts(self, column: bpy.types.UILayout, room: Room, obj: bpy.types.Object) -> None:
        """The cuts of the last time, each with what joins it and a choice for the next time."""
        made = obj.reeb_parts_made
        if made.cuts:
            rows = min(max(len(made.cuts), 2), 6)
            column.template_list("REEB_PARTS_UL_cuts", "", made, "cuts", made, "cut", rows=rows)
            active = made.cuts[min(made.cut, len(made.cuts) - 1)]
            lines = column.column(align=True)
            if not _has_name(room, obj, made.cuts, active):
                room.wrapped(lines, cut_list.cut_name(obj, active))
            if active.count:
                text = iface_("{n} {n:joint|joints}, {width} mm wide")
                room.wrapped(lines, text.format(n=Count(active.count), width=f"{active.width:.1f}"))
            elif active.why:
                room.wrapped(lines, iface_(REASONS[active.why]))

    def _draw_outputs(self, room: Room, obj: bpy.types.Object) -> None:
        """Buttons that stay pressed for as long as there is what they make."""
        result = obj.data.reeb_parts
        made = (
            ("seams", n_("Seams", "Operator"), result.has_seams),
            ("face_sets", n_("Face Sets", "Operator"), result.has_face_sets),
            ("materials", n_("Materials", "Operator"), result.has_materials),
        )
        row = room.row(self.layout, *(iface_(text, "Operator") for _, text, _ in made))
        for name, text, there in made:
            room.operator(row, f"reeb_parts.{name}", text=text, depress=there).remove = there
        room.operator(self.layout, "reeb_parts.unwrap", icon="UV")
        room.operator(self.layout, "reeb_parts.export", text="Export to Files...", icon="EXPORT")
        room.operator(self.layout, "reeb_parts.armature", text="Make Armature", icon="ARMATURE_DATA")
        room.operator(self.layout, "reeb_parts.hulls", text="Make Collision Hulls", icon="MESH_ICOSPHERE")
        if piece_objects.has_pieces(obj):
            room.operator(self.layout, "reeb_parts.rigid_bodies", text="Make Rigid Bodies", icon="RIGID_BODY")


class REEB_PARTS_UL_cuts(bpy.types.UIList):
    def draw_item(self, context: bpy.types.Context, layout: bpy.types.UILayout, data: bpy.types.PropertyGroup,
                  item: bpy.types.PropertyGroup, icon: int, active_data: bpy.types.PropertyGroup,
                  active_property: str) -> None:
        room = Room(context)
        # A row would take from both what does not fit.
        row = layout.split(factor=1 - _joint_width(room, data.cuts) / _listed(room), align=True)
        obj = item.id_data
        joined = {"icon": "CHECKMARK" if item.count else "ERROR" if item.why else "BLANK1"}
        row.label(text=cut_list.cut_name(obj, item), translate=False, **joined)
        row.prop(item, "joint", text="")


def _joint_width(room: Room, cuts: Iterable[bpy.types.PropertyGroup]) -> float:
    """Width of the choices of joints in the list of cuts: for the longest words there, or half of a row."""
    kind = next(iter(cuts)).bl_rna.properties["joint"]
    words = [iface_(kind.enum_items[joint].name, kind.translation_context) for joint in {cut.joint for cut in cuts}]
    return min(max(map(room.text, words)) + CHOICE, 0.5 * _listed(room))


def _has_name(room: Room, obj: bpy.types.Object, cuts: Iterable[bpy.types.PropertyGroup],
              cut: bpy.types.PropertyGroup) -> bool:
    """Whether the name of a cut fits into its row of the list."""
    return LABEL + room.text(cut_list.cut_name(obj, cut)) + _joint_width(room, cuts) <= _listed(room)


def _listed(room: Room) -> float:
    """Width of a row in a list that has the whole panel."""
    return max(room.width - FRAME - BAR, 1.0)


class REEB_PARTS_PT_piece(SubPanel, bpy.types.Panel):
    bl_label = "Separated Part"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.object is not None and origins.NUMBER in context.object

    def draw(self, context: bpy.types.Context) -> None:
        obj = origins.original(context.object)
        room = Room(context)
        if obj is None:
            self._draw_without_original(room, context.object)
            return
        room.wrapped(self.layout.column(align=True), iface_("A part of {name}").format(name=obj.name), "MESH_DATA")
        several = len(set(origins.originals([context.object, *context.selected_objects]).values())) > 1
        show = iface_("Show Originals") if several else iface_("Show {name}").format(name=obj.name)
        room.operator(self.layout, "reeb_parts.show_original", text=show, icon="HIDE_OFF")
        self._draw_check(room, context.object)
        room.operator(self.layout, "reeb_parts.rigid_bodies", text="Make Rigid Bodies", icon="RIGID_BODY")

    def _draw_without_original(self, room: Room, piece: bpy.types.Object) -> None:
        """Why little can be done with a piece whose original is gone, or nothing with one of another file."""
        try:
            targets.check_object(piece)
            piece_objects.original_of(piece)
        except SceneError as error:
            room.wrapped(self.layout.column(align=True), str(error), "INFO")
        if not targets.is_foreign(piece):
            self._draw_check(room, piece)

    def _draw_check(self, room: Room, piece: bpy.types.Object) -> None:
        """What a check has found; a click on a line selects it."""
        found = piece_checks.kept(piece)
        column = self.layout.column(align=True)
        if found is not None and found.sound:
            room.wrapped(column, iface_("Closed, crosses nothing"), "CHECKMARK")
        elif found is not None:
            self._draw_faults(room, column, found)
        if found is not None and found.thinnest is not None:
            words = iface_("Thinnest place: {width}").format(width=length_words(found.thinnest))
            room.operator(column, "reeb_parts.select_faults", text=words, icon="DRIVER_DISTANCE").kind = "THIN"
        row = room.row(self.layout, iface_("Check", "Operator"), iface_("Repair", "Operator"))
        row.operator("reeb_parts.check_pieces", text="Check")
        if found is not None and not found.sound:
            row.operator("reeb_parts.repair_piece", text="Repair")

    def _draw_faults(self, room: Room, column: bpy.types.UILayout, found: piece_checks.Check) -> None:
        """A line for each kind of fault that there is."""
        for kind, count, words in (
            ("OPEN", found.open_edges, iface_("{n} open {n:edge|edges}")),
            ("BRANCHING", found.branching_edges, iface_("{n} {n:edge|edges} of three faces")),
            ("CONTRARY", found.contrary_edges, iface_("Faces look both ways at {n} {n:edge|edges}")),
            ("CROSSING", found.crossing_faces, iface_("{n} {n:face crosses|faces cross} others")),
        ):
            if count:
                told = words.format(n=Count(count))
                room.operator(column, "reeb_parts.select_faults", text=told, icon="ERROR").kind = kind
        if found.inside_out:
            column.label(text=iface_("Inside out"), icon="ERROR")


CLASSES = (REEB_PARTS_UL_cuts, REEB_PARTS_PT_use, REEB_PARTS_PT_piece)
