# SPDX-License-Identifier: GPL-3.0-or-later
"""Decompose: read, compute, write. The scene is untouched until the result exists."""

from dataclasses import replace

import bpy
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.parameters import Parameters
from ..core.sentence import Count
from ..core.steps import Steps, finished, stretched
from ..scene import another_window, bridge, defaults, targets
from ..scene.bridge import Shape
from ..scene.errors import SceneError, load_core, translated
from ..scene.former_names import FormerArguments, take_over_former_names
from ..scene.modes import object_mode
from ..scene.properties import (
    HINTS,
    OUTPUTS,
    OVERLAY,
    PARAMETERS,
    HintProperties,
    OutputProperties,
    OverlayProperties,
    ParameterProperties,
    fill_in,
)
from ..scene.reporting import ReportingOperator, report_kept
from ..scene.runs import jobs, results
from ..scene.runs.compute import Outcome
from ..scene.runs.results import check_unchanged, writing_result
from ..scene.stepped import LARGE, SteppedOperator
from ..viewport import shading

#: How far all is when a large mesh has been read.
READ = 0.05
# How much of reading the shapes take; the rest is for the core to be loaded.
SHAPES = 0.8


class REEB_PARTS_OT_decompose(
    SteppedOperator, bpy.types.Operator, FormerArguments, ParameterProperties, HintProperties, OutputProperties,
    OverlayProperties
):
    """Cut the selected mesh into the parts a person would name, and show its Reeb graph"""

    bl_idname = "reeb_parts.decompose"
    bl_label = "Decompose into Parts"
    stage = n_("writing the parts")

    # What the caller has left to the parts that each object shows, while the panel after it still says so.
    left_detail: bpy.props.FloatProperty(default=-1.0, options={"HIDDEN", "SKIP_SAVE"})
    left_n_parts: bpy.props.IntProperty(default=-1, options={"HIDDEN", "SKIP_SAVE"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if another_window.taken_over() is not None:  # whatever is active by now
            return True
        obj = targets.active_object(context)
        if obj is None or obj.type != "MESH":
            able = obj is not None and targets.can_become_mesh(obj)
            cls.poll_message_set(targets.to_become_mesh(obj) if able
                                 else targets.to_be_active(context) or rpt_("Select a mesh first"))
            # Scripts are let through, to be told what is wrong in a sentence.
            return bpy.app.background
        if jobs.current is not None:
            cls.poll_message_set(rpt_("Reeb Parts is still computing"))
            return False
        return True

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """From the panel: with the panel's settings, in a process of its own, so that the window stays alive."""
        left = self._complete_detail(context)
        defaults.adopt(context.scene)
        fill_in(self, context.scene.reeb_parts, (*PARAMETERS, *HINTS, *OUTPUTS, *OVERLAY))
        self._leave_detail(left)
        return self.attempt(self._start, context)

    def run(self, context: bpy.types.Context) -> None:
        """From scripts and the redo panel: all at once; what a script leaves out is as in the preferences.

        But for the detail, which is that of the parts that each object shows, or else that of the active one.
        """
        left = self._complete_detail(context)
        defaults.complete(self)
        self._leave_detail(left)
        parameters, shapes = finished(self._reading(context))
        finished(self._writing(context, jobs.computed(shapes, parameters)))

    def _complete_detail(self, context: bpy.types.Context) -> bool:
        """Take over former names, and how many parts the active object shows where a caller gives neither detail nor
        number; whether that is so.
        """
        for note in take_over_former_names(self.properties):
            self.report({"INFO"}, note)
        given = self.properties.is_property_set
        left = not given("detail") and not given("n_parts")
        if left:
            for name, value in results.detail_of(targets.active_object(context)).items():
                setattr(self, name, value)
        return left

    def _leave_detail(self, left: bool) -> None:
        """Remember what stands for the detail of each object, if the caller has left that to them."""
        if left:
            self.left_detail, self.left_n_parts = self.detail, self.n_parts

    def _as_shown(self, outcome: Outcome, obj: bpy.types.Object) -> Outcome:
        """The outcome for an object at the detail that it shows, unless another one is asked for."""
        asked = (self.detail, self.n_parts) != (self.left_detail, self.left_n_parts)
        shown = {} if asked else results.detail_of(obj)
        found = outcome.decomposition
        if found is None or not shown:
            return outcome
        parameters = replace(found.parameters, detail=float(shown["detail"]), n_parts=int(shown["n_parts"]))
        return replace(outcome, decomposition=found.asked(parameters))

    def draw(self, context: bpy.types.Context) -> None:
        """The redo panel: how many parts, and what differs from the defaults."""
        self.layout.use_property_split = True
        for names in (PARAMETERS, HINTS, OUTPUTS, OVERLAY):
            column = self.layout.column(align=True)
            for name in names:
                if name in {"detail", "n_parts"} or getattr(self, name) != self.rna_type.properties[name].default:
                    column.prop(self, name)

    def _reading(self, context: bpy.types.Context) -> Steps[tuple[Parameters, list[tuple[str, Shape]]]]:
        """The parameters and the shapes; raises SceneError or ReebError."""
        parameters, objects, shapes = self.parameters(), targets.chosen_objects(context, self.report), []
        names = [obj.name for obj in objects]
        for index, (obj, name) in enumerate(zip(objects, names, strict=True)):
            steps = bridge.reading_shape(obj, self.hints)
            try:
                shape = yield from stretched(steps, SHAPES * index / len(objects), SHAPES * (index + 1) / len(objects))
            except ReferenceError as error:  # removed by a script meanwhile, or by undo in another window
                raise SceneError(rpt_("{name} was changed while its parts were computed. Decompose it again.").format(
                    name=name)) from error
            shapes.append((name, shape))
        yield SHAPES
        load_core()
        return parameters, shapes

    def _writing(self, context: bpy.types.Context, outcomes: list[Outcome]) -> Steps[None]:
        """Write what was computed and report on it."""
        found = [(self._as_shown(outcome, obj), obj)
                 for outcome, obj in zip(outcomes, results.objects_of(outcomes), strict=True)]
        done = [(outcome, obj) for outcome, obj in found if outcome.decomposition is not None]
        if not done:
            raise SceneError(translated(outcomes[0].problem))
        kept = 0
        with object_mode(context):
            for index, (outcome, obj) in enumerate(done):
                steps = writing_result(context, obj, outcome, self)
                kept += yield from stretched(steps, index / len(done), (index + 1) / len(done))
        report_kept(self.report, kept)
        for outcome, obj in found:
            self._report(outcome, obj, len(found) > 1)

    def _report(self, outcome: Outcome, obj: bpy.types.Object, several: bool) -> None:
        name = f"{obj.name}: " if several else ""
        if outcome.decomposition is None:
            self.report({"WARNING"}, name + translated(outcome.problem))
            return
        for note in outcome.decomposition.notes + outcome.shape.notes:
            self.report({"INFO"}, name + translated(note))
        result = obj.data.reeb_parts
        self.report({"INFO"}, name + rpt_("{n} {n:part|parts} in {seconds:.1f} s").format(
            n=Count(len(result.parts)), seconds=outcome.seconds))

    def steps(self, context: bpy.types.Context) -> Steps[None]:
        """Write what was computed in the window."""
        assert self._job is not None
        if self._job.error is not None:
            raise self._job.error
        assert self._job.result is not None
        check_unchanged(context, self._job.result)
        if self.colors:
            shading.show_colors(context)
        yield from self._writing(context, self._job.result)
        if self._job.in_blender:
            self.report({"INFO"}, rpt_("Blender stood still, since its Python could not be started beside it"))

    # In the window

    def _start(self, context: bpy.types.Context) -> set[str]:
        self._rounds = 0
        self._job = another_window.taken_over()
        self._large = (sum(len(obj.data.vertices) for obj in targets.chosen_objects(context))
                       if self._job is None else self._job.n_vertices) >= LARGE
        self._launching = self._launch(context)
        if self._job is None and not self._large:
            finished(self._launching)
        self._watch(context, self._job or jobs.Progress(n_("reading the mesh")), 0.05)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _launch(self, context: bpy.types.Context) -> Steps[None]:
        """Read the shapes and start the process."""
        parameters, shapes = yield from self._reading(context)
        yield 1.0
        self._job = jobs.Job(shapes, parameters, READ if self._large else 0.0)
        self._job.start()

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Watch the process; every other event goes its usual way. Then write, in steps if that takes long."""
        if self._work is not None:
            return super().modal(context, event)
        if event.type == "ESC" and event.value == "PRESS":
            jobs.cancel()
        if event.type == "TIMER" and not self._advance(context):
            return {"CANCELLED"}
        if not self._progress.cancelled and (self._job is None or self._job.running):
            # While the mesh is read, nothing else can be done in the window.
            return {"RUNNING_MODAL" if event.type == "ESC" or self._job is None else "PASS_THROUGH"}
        self._stop_watching(context)
        if self._progress.cancelled:
            self.report({"INFO"}, rpt_("Cancelled; nothing was changed"))
            return {"CANCELLED"}
        if self._large:
            self.begin(context)
            return {"RUNNING_MODAL"}
        return self.attempt(lambda: finished(self.steps(context)))

    def _advance(self, context: bpy.types.Context) -> bool:
        """See how far it is; False if it could not be started."""
        self._rounds += 1
        if self._job is not None:
            self._job.poll(lambda: self._show_progress(context))
        elif self._progress.cancelled:
            self._launching.close()
        elif self._rounds > 2 and not self._goes_on(context):  # by now, the window has been drawn
            return False
        self._show_progress(context)
        return True

    def _goes_on(self, context: bpy.types.Context) -> bool:
        """Go on reading; False if it could not be started. Whatever is raised, the window waits for it no more."""
        goes_on = False
        try:
            goes_on = self.attempt(self._read_on) != {"CANCELLED"}
        finally:
            if not goes_on:
                self._stop_watching(context)
        return goes_on

    def _read_on(self) -> None:
        """Go on reading until there is something to show."""
        before = self._progress.share
        for share in self._launching:
            self._progress.share = READ * share
            if self._progress.share >= before + 0.01:
                return
        assert self._job is not None
        self._progress = jobs.current = self._job

    def interrupt(self) -> None:
        """Undo is about to begin: what is computed beside Blender goes on, as long as the mesh stays."""
        super().interrupt()
        if self._job is None:
            self._progress.cancel()

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender closes the window or opens another file, or Esc ends the writing.

        Where the user closes this window only, it goes on in another one.
        """
        if self._work is not None:
            super().cancel(context)
            return
        self._launching.close()
        self._stop_watching(context)
        if not self._go_on_elsewhere(context):
            self._progress.cancel()

    def progress_text(self) -> str:
        """For the status bar."""
        if self._job is not None and self._job.in_blender and self._work is None:
            return rpt_("Reeb Parts: {stage} ({share:.0%})    Blender stands still until the parts are there")
        return super().progress_text()


class REEB_PARTS_OT_cancel(ReportingOperator, bpy.types.Operator):
    """Stop computing; the scene is as it was before"""

    bl_idname = "reeb_parts.cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        if jobs.current is None:
            raise SceneError(rpt_("Nothing is being computed"))

    def run(self, context: bpy.types.Context) -> None:
        jobs.cancel()
