# SPDX-License-Identifier: GPL-3.0-or-later
"""For operators whose work can be long: in the window they go on step by step, with progress, and Esc ends them."""

from __future__ import annotations

import time

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.errors import ReebError
from ..core.steps import Steps, finished
from . import another_window, redraw, running, store
from .errors import SceneError, translated
from .properties import SeparateProperties
from .reporting import ReportingOperator
from .runs import jobs
from .transaction import transaction

#: With so many vertices it can take a second or more: then there is progress, and Esc.
LARGE = 40_000

# What becomes an object of its own takes as long as so many vertices more.
_OF_A_PART = 40

# Steps are taken for so many seconds before the window is drawn again.
_BREATH = 0.1


def is_long(objects: list[bpy.types.Object], style: SeparateProperties) -> bool:
    """Whether to make objects of the parts of some objects can take a second or more.

    With joints, or cut to fit a bed, it does of any model: each place and each plane is tried.
    """
    if style.joints != "NONE" or style.fit_bed:
        return True
    return sum(len(obj.data.vertices) + _OF_A_PART * len(obj.data.reeb_parts.parts)
               for obj in objects if store.has_result(obj.data)) >= LARGE


class SteppedOperator(ReportingOperator):
    """For operators whose work can be long. A class that inherits gives ``steps`` and ``stage``.

    Nothing else can be done in the window meanwhile: what is written in the end was read in the beginning.
    """

    #: What it is doing, for the status bar.
    stage = ""
    _work: Steps[None] | None = None
    _job: jobs.Job | None = None  # what is computed before the work, if anything

    def steps(self, context: bpy.types.Context) -> Steps[None]:
        """Do what the operator is for, see core/steps.py. Raises SceneError or ReebError."""
        raise NotImplementedError

    def run(self, context: bpy.types.Context) -> None:
        """From scripts and the redo panel: all at once."""
        finished(self.steps(context))

    def start(self, context: bpy.types.Context) -> set[str]:
        """From ``invoke``: go on in steps, unless the window shows another work already."""
        if bpy.app.background or jobs.current is not None:
            return self.execute(context)
        self.begin(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def begin(self, context: bpy.types.Context) -> None:
        """Go on in steps whenever ``modal`` is called."""
        self._work = self._in_transaction(context)
        self._watch(context, jobs.Progress(self.stage), 0.01)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take steps; every event ends here."""
        if self._progress.cancelled or (event.type == "ESC" and event.value == "PRESS"):
            self.cancel(context)
            self.report({"INFO"}, rpt_("Cancelled; nothing was changed"))
            return {"CANCELLED"}
        return self._go_on(context) if event.type == "TIMER" else {"RUNNING_MODAL"}

    def interrupt(self) -> None:
        """Undo is about to begin: take back what was done. The next call of ``modal`` ends it."""
        if self._work is not None:
            self._work.close()
            self._progress.cancel()

    def cancel(self, context: bpy.types.Context) -> None:
        """Esc, or Blender closes the window: take back what was done. In another window it then begins anew."""
        assert self._work is not None
        try:
            self._work.close()
        finally:
            self._stop_watching(context)
        self._go_on_elsewhere(context)

    def _go_on_elsewhere(self, context: bpy.types.Context) -> bool:
        """Have it called again in another window if the user closes this one; whether it will be."""
        if self._progress.cancelled or not another_window.is_closing(context):
            return False
        another_window.go_on(self, context, self._job)
        return True

    def _in_transaction(self, context: bpy.types.Context) -> Steps[None]:
        with transaction():
            yield 0.0
            yield from self.steps(context)

    def _go_on(self, context: bpy.types.Context) -> set[str]:
        """Take some steps, and show how far it is."""
        assert self._work is not None
        start = time.monotonic()
        try:
            while time.monotonic() < start + _BREATH:
                self._progress.share = next(self._work)
        except StopIteration:
            self._stop_watching(context)
            return {"FINISHED"}
        except (SceneError, ReebError, MemoryError) as error:
            self._stop_watching(context)
            self.report({"ERROR"}, translated(error))
            return {"CANCELLED"}
        except ReferenceError:  # a script goes on meanwhile
            self._stop_watching(context)
            self.report({"ERROR"}, rpt_("What was worked on has been deleted meanwhile; nothing was made."))
            return {"CANCELLED"}
        except BaseException:
            self._stop_watching(context)
            raise
        self._show_progress(context)
        return {"RUNNING_MODAL"}

    def progress_text(self) -> str:
        """For the status bar."""
        return rpt_("Reeb Parts: {stage} ({share:.0%})    Esc: cancel")

    def _watch(self, context: bpy.types.Context, progress: jobs.Job | jobs.Progress, interval: float) -> None:
        """Have the window show how far it is, and call ``modal`` after so many seconds, again and again."""
        self._progress = jobs.current = progress
        self._shown = ""
        running.begun(self, context)
        self._timer = context.window_manager.event_timer_add(interval, window=context.window)
        context.window_manager.progress_begin(0, 100)
        self._show_progress(context)

    def _show_progress(self, context: bpy.types.Context) -> None:
        text = self.progress_text().format(stage=self._progress.text, share=self._progress.share)
        if text != self._shown:
            self._shown = text
            context.window_manager.progress_update(round(100 * self._progress.share))
            context.workspace.status_text_set(text)
            redraw.sidebars()

    def _stop_watching(self, context: bpy.types.Context) -> None:
        jobs.current = None
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        redraw.show_status(None)
        redraw.sidebars()
        running.ended(self)
