# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as objects, and back to the object that they come from."""

import bpy
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Count
from ..core.steps import Steps, stretched
from ..scene import targets
from ..scene.errors import SceneError
from ..scene.modes import is_object_mode, object_mode, set_mode
from ..scene.pieces import origins, piece_objects, separation
from ..scene.properties import SEPARATE, SeparateProperties, closes_holes, fill_in
from ..scene.reporting import (
    ReportingOperator,
    chosen_with_parts,
    listed,
    report_kept,
    telling_of,
    with_current_parts,
)
from ..scene.result.part_list import check_parts, wanted_numbers
from ..scene.showing.selection import in_layer, select_objects
from ..scene.stepped import SteppedOperator, is_long
from ..scene.targets import Report
from ..viewport import shading
from .checks import report_unsound


class REEB_PARTS_OT_separate(SteppedOperator, bpy.types.Operator, SeparateProperties):
    """Make separate objects of the parts, with all that the mesh carries; the original stays as it is"""

    bl_idname = "reeb_parts.separate"
    bl_label = "Separate Parts into Objects"
    stage = n_("separating parts")

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        # Then a piece is active. Blender shows the panel with the settings of what was done last only where that could
        # be done again, and asks before it takes back what was done.
        done = context.window_manager.operators
        if not done or done[-1].bl_idname != cls.__name__:
            super().check_context(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        fill_in(self, context.scene.reeb_parts_use, SEPARATE)
        # Whether they can be worked on is asked later, where the answer is reported.
        long = is_long([obj for obj in targets.active_and_selected(context) if obj.type == "MESH"], self)
        return self.start(context) if long else self.execute(context)

    def draw(self, context: bpy.types.Context) -> None:
        """The panel after it: in the order of Use Parts, and without what does not count."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in self.rows:
            layout.row().prop(self, name, expand=name == "which")

    def steps(self, context: bpy.types.Context) -> Steps[None]:
        check_parts(targets.active_object(context))
        objects = chosen_with_parts(context, self.report, one_per_mesh=False)
        made = []
        with object_mode(context):
            found = list(with_current_parts(objects, self.report))
            for index, (obj, stored) in enumerate(found):
                steps = separation.separating(context, obj, stored, wanted_numbers(obj.data, self.which), self)
                separated = yield from stretched(steps, index / len(found), (index + 1) / len(found))
                made.append((obj, separated))
        every = [piece for _, separated in made for piece in (*separated.pieces, *separated.loose)]
        origins.include(context, every)
        if self.hide:
            self._hide(context, [obj for obj, _ in made])
        self._show(context, every, made[0][1].pieces)
        for obj, separated in made:
            self._report(obj, separated, telling_of(self.report, obj, len(made) > 1))

    def _hide(self, context: bpy.types.Context, originals: list[bpy.types.Object]) -> None:
        """Hide the originals, which only Object Mode allows."""
        if not is_object_mode(context):
            set_mode(context.view_layer.objects.active, "OBJECT")
        for obj in originals:
            piece_objects.hide_original(context, obj)
        shading.show_pieces(context)

    def _show(self, context: bpy.types.Context, pieces: list[bpy.types.Object],
              of_active: list[bpy.types.Object]) -> None:
        """Show the pieces in the local view, too; leave them selected, unless the user is at work in another mode."""
        _show_in_local_view(context, pieces)
        if is_object_mode(context):
            select_objects(context, pieces, active=of_active[0] if self.hide and of_active else None)

    def _report(self, obj: bpy.types.Object, separated: separation.Separated, tell: Report) -> None:
        """Say what came of an object. tell : reports what does not have its name."""
        self._report_made(obj, separated, tell)
        if self.joints != "NONE":
            self._report_joints(separated, tell)
        if closes_holes(self):
            report_unsound(tell, separated.pieces, just_made=True)
        if separated.left_open:
            tell({"WARNING"}, rpt_("{n} {n:edge stays|edges stay} open: more than two faces meet beside "
                                   "{n:it|them}").format(n=Count(separated.left_open)))
        self._report_modifiers(obj, separated)
        if self.hide and (instances := piece_objects.instances(obj)):
            words = rpt_("{name} is missing from renders of instances of its collection: {names}")
            self.report({"WARNING"}, words.format(
                name=obj.name, names=listed([instance.name for instance in instances])))
        if self.hide and (scenes := piece_objects.other_scenes(obj)):
            self.report({"WARNING"}, rpt_("{name} is missing from renders of other scenes: {names}").format(
                name=obj.name, names=listed([scene.name for scene in scenes])))
        if separated.n_apart:
            tell({"WARNING"}, rpt_(
                "{n} border {n:vertex lies on another one but cannot be joined with it|vertices lie on others but "
                "cannot be joined with them}: parts stay open there").format(n=Count(separated.n_apart)))

    def _report_made(self, obj: bpy.types.Object, separated: separation.Separated, tell: Report) -> None:
        """Say how many pieces there are, of these how many for the bed, and what stayed as it was."""
        self.report({"INFO"}, rpt_("{name}: {n} {n:part is an object|parts are objects} now").format(
            name=obj.name, n=Count(len(separated.pieces) - separated.more)))
        if separated.more:
            tell({"INFO"}, rpt_("{n} more {n:piece|pieces}, so that all fit the bed").format(
                n=Count(separated.more)))
        if separated.too_long:
            tell({"WARNING"}, rpt_("Not closed, so not cut to fit the bed: {names}").format(
                names=listed([separated.names[key] for key in separated.too_long])))
        report_kept(tell, separated.kept)
        if separated.along_faces:
            message = rpt_("{n} {n:border runs|borders run} along faces: a smooth cut would tear or cross a part there")
            tell({"INFO"}, message.format(n=Count(separated.along_faces)))

    def _report_modifiers(self, obj: bpy.types.Object, separated: separation.Separated) -> None:
        """Say which modifiers shape the pieces otherwise than the whole."""
        if separated.by_extent:
            self.report({"WARNING"}, rpt_(
                "The effect of {modifiers} depends on the extent of the mesh, which differs for each part of {name}: "
                "use Apply Modifiers to keep the shape").format(
                    modifiers=", ".join(separated.by_extent), name=obj.name))
        if separated.made_for_all:
            self.report({"WARNING"}, rpt_(
                "The effect of {modifiers} is made for all of {name}, and each part takes another shape: use Apply "
                "Modifiers to keep the shape").format(
                    modifiers=", ".join(separated.made_for_all), name=obj.name))

    def _report_joints(self, separated: separation.Separated, tell: Report) -> None:
        """Say how many cuts have joints, and of which others why not."""
        cuts = separated.cuts
        if not cuts:
            tell({"WARNING"}, rpt_("No joints: there is no cut that could have one."))
            return
        tell({"INFO"}, rpt_("{n} of {total} {total:cut has|cuts have} joints").format(
            n=Count(sum(cut.count > 0 for cut in cuts)), total=Count(len(cuts))))
        for why, sentence in (
            ("ROOM", rpt_("No joint where there is no room for one with a wall around it: {cuts}")),
            ("BENT", rpt_("No joint where a cut is so bent that it has no axis: {cuts}")),
            ("BODY", rpt_("No joint where a part is not closed or crosses itself: {cuts}")),
            ("RESULT", rpt_("No joint where it would have left a part open or pierced: {cuts}")),
        ):
            names = [separated.cut_name(cut) for cut in cuts if cut.why == why]
            if names:
                tell({"WARNING"}, sentence.format(cuts=listed(names)))


class REEB_PARTS_OT_show_pieces(ReportingOperator, bpy.types.Operator):
    """Show and select the pieces that were separated from the selected objects, and hide these"""

    bl_idname = "reeb_parts.show_pieces"
    bl_label = "Show Separated Parts"

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        obj = targets.active_object(context)
        targets.check_object(obj)
        assert obj is not None
        if not piece_objects.has_pieces(obj):
            raise SceneError(rpt_("There are no separated parts of {name}. Separate them first.").format(
                name=obj.name))
        if not is_object_mode(context):
            raise SceneError(rpt_("Go to Object Mode first"))

    def run(self, context: bpy.types.Context) -> None:
        objects = [obj for obj in targets.active_and_selected(context) if piece_objects.has_pieces(obj)]
        pieces = []
        for obj, _ in targets.usable(objects, targets.check_object, self.report):
            # Appended alone to another file, an object comes with its pieces, but these are in no scene.
            origins.make_collection(context, obj)
            own = piece_objects.piece_objects(obj)
            origins.include(context, own)
            pieces += own
            piece_objects.hide_original(context, obj)
            piece_objects.show_pieces(context, obj, True)
        shading.show_pieces(context)
        _show_in_local_view(context, pieces)
        select_objects(context, pieces, active=pieces[0])


class REEB_PARTS_OT_show_original(ReportingOperator, bpy.types.Operator):
    """Show and select the objects that the selected pieces were separated from, and hide the pieces"""

    bl_idname = "reeb_parts.show_original"
    bl_label = "Show Original of Part"

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        _check_shown(context, piece_objects.original_of(piece_objects.active_piece(context)))

    def run(self, context: bpy.types.Context) -> None:
        found = list(dict.fromkeys(origins.originals(targets.active_and_selected(context)).values()))
        objects = [obj for obj, _ in targets.usable(found, lambda obj: _check_shown(context, obj), self.report)]
        for obj in objects:
            piece_objects.show_original(context, obj)
        shading.show_colors(context)
        _show_in_local_view(context, objects)
        select_objects(context, objects, active=objects[0])


def _check_shown(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Raise SceneError unless an object can be shown in the view layer."""
    targets.check_object(obj)
    if not in_layer(context.view_layer, obj):
        raise SceneError(rpt_("{name} is not in this view layer. Include its collection first.").format(name=obj.name))


def _show_in_local_view(context: bpy.types.Context, objects: list[bpy.types.Object]) -> None:
    """Show objects in the viewport where a button was pressed, if that shows some objects alone."""
    space = context.space_data
    if space is not None and space.type == "VIEW_3D" and space.local_view:
        for obj in objects:
            obj.local_view_set(space, True)
