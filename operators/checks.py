# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with separated parts: found, shown and repaired."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..scene import bridge, redraw, targets, transaction
from ..scene.errors import SceneError
from ..scene.modes import set_mode
from ..scene.pieces import origins, piece_checks, piece_objects, piece_repairs
from ..scene.reporting import ReportingOperator, listed
from ..scene.showing.selection import select_faces
from ..scene.targets import Report


class PieceOperator(ReportingOperator):
    """For operators on a separated part that is the active object, in Object Mode."""

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        targets.check_object(piece_objects.active_piece(context))


class REEB_PARTS_OT_check_pieces(PieceOperator, bpy.types.Operator):
    """Check the selected separated parts: whether they are closed, cross themselves or are inside out"""

    bl_idname = "reeb_parts.check_pieces"
    bl_label = "Check Parts"

    def run(self, context: bpy.types.Context) -> None:
        pieces = _chosen_pieces(context, self.report)
        piece_objects.check_pieces(pieces)
        redraw.sidebars()
        report_unsound(self.report, pieces)


def _chosen_pieces(context: bpy.types.Context, report: Report) -> list[bpy.types.Object]:
    """The active one and all selected ones that can be written and are not being edited; of others it is said why."""
    pieces = [item for item in targets.active_and_selected(context) if origins.NUMBER in item]
    return [piece for piece, _ in targets.usable(pieces, targets.check_at_rest, report)]


class REEB_PARTS_OT_select_faults(PieceOperator, bpy.types.Operator):
    """Select, in Edit Mode, the faces of the part where something is wrong"""

    bl_idname = "reeb_parts.select_faults"
    bl_label = "Select What Is Wrong"

    kind: bpy.props.EnumProperty(
        name="Kind",
        items=[("OPEN", "Open Edges", "Faces at edges of one face"),
               ("BRANCHING", "Branching Edges", "Faces at edges of three faces or more"),
               ("CONTRARY", "Faces That Look Both Ways", "Faces at edges where one looks out and the other in"),
               ("CROSSING", "Crossing Faces", "Faces that cross others"),
               ("THIN", "Thinnest Place", "The face where the part is thinnest")],
        description="What to select",
    )

    def run(self, context: bpy.types.Context) -> None:
        piece = piece_objects.active_piece(context)
        found, faults = piece_checks.check(piece.data, bridge.world_stretch(piece))
        piece_checks.keep(piece, found)
        mask = getattr(faults, self.kind.lower())
        if not mask.any():
            raise SceneError(rpt_("{name} has nothing of the kind.").format(name=piece.name))
        select_faces(piece.data, mask)
        transaction.keep(context.tool_settings, "mesh_select_mode")
        context.tool_settings.mesh_select_mode = (False, False, True)
        set_mode(piece, "EDIT")
        self.report({"INFO"}, rpt_("{n} {n:face|faces} selected").format(n=Count(int(mask.sum()))))


class REEB_PARTS_OT_repair_piece(PieceOperator, bpy.types.Operator):
    """Turn faces that look inwards, close holes, and make caps anew that cross something, where that helps"""

    bl_idname = "reeb_parts.repair_piece"
    bl_label = "Repair Part"

    def run(self, context: bpy.types.Context) -> None:
        pieces = _chosen_pieces(context, self.report)
        shared = [piece.name for piece in pieces if len(targets.users(piece.data)) > 1 or piece.data.asset_data]
        if shared:
            raise SceneError(rpt_("Other objects share the mesh of {name}").format(name=listed(shared)))
        found = [piece_repairs.repair(piece, bridge.world_stretch(piece)) for piece in pieces]
        faulty = [piece.name for piece, (before, _) in zip(pieces, found, strict=True) if not before.sound]
        if not faulty:
            raise SceneError(rpt_("Nothing has to be repaired"))
        if all(after == before for before, after in found):
            raise SceneError(rpt_("Nothing of {name} can be repaired").format(name=listed(faulty)))
        report_unsound(self.report, pieces)


def report_unsound(report: Report, pieces: list[bpy.types.Object], just_made: bool = False) -> None:
    """Say which of some pieces that were checked are not sound; of those just made also which are as the model is."""
    wrong, as_model, turned = [], [], []
    for piece in pieces:
        found = piece_checks.kept(piece)
        if found is not None and found.faces_wrong_way:
            turned.append(piece.name)
        if found is None or found.open_or_crossing:
            # Later on, what the model does not have either may be the user's work.
            (as_model if just_made and found is not None and found.as_model else wrong).append(piece.name)
    for names, sentence in (
        (wrong, rpt_("{n} of {total} {total:part|parts} {n:is not closed or crosses itself|are not closed or cross "
                     "themselves}: {names}")),
        (as_model, rpt_("{n} of {total} {total:part|parts} {n:is open or crosses itself|are open or cross themselves} "
                        "as the model does there: {names}")),
        (turned, rpt_("{n} of {total} {total:part|parts} {n:has|have} faces that look inwards: {names}")),
    ):
        if names:
            report({"WARNING"}, sentence.format(
                n=Count(len(names)), total=Count(len(pieces)), names=listed(names)))
    if not (wrong or as_model or turned):
        report({"INFO"}, rpt_("{n} {n:part is closed and does not cross itself|parts are closed and do not "
                              "cross themselves}").format(n=Count(len(pieces))))
