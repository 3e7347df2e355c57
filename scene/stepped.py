# SPDX-License-Identifier: GPL-3.0-or-later
"""For operators whose work can be long: in the window they go on step by step, with progress, and Esc ends them."""

from __future__ import annotations

import time

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.errors import ReebError
from . import jobs, redraw
from .errors import SceneError, translated
from .reporting import ReportingOperator
from .steps import Steps, finished
from .transaction import transaction

# Steps are taken for so many seconds before the window is drawn again.
_BREATH = 0.1


class SteppedOperator(ReportingOperator):
    """For operators whose work can be long. A class that inherits gives ``steps`` and ``stage``.

    Nothing else can be done in the window meanwhile: what is written in the end was read in the beginning.
    """

    #: What it is doing, for the status bar.
    stage = ""

    def steps(self, context: bpy.types.Context) -> Steps[None]:
        """Do what the operator is for, see steps.py. Raises SceneError or ReebError."""
        raise NotImplementedError

    def run(self, context: bpy.types.Context) -> None:
        """From scripts and the redo panel: all at once."""
        finished(self.steps(context))

    def start(self, context: bpy.types.Context) -> set[str]:
        """From ``invoke``: go on in steps, unless the window shows another work already."""
        if bpy.app.background or jobs.current is not None:
            return self.execute(context)
        self._begin(context)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take steps; every event ends here."""
        if self._progress.cancelled or (event.type == "ESC" and event.value == "PRESS"):
            self.cancel(context)
            self.report({"INFO"}, rpt_("Cancelled; nothing was changed"))
            return {"CANCELLED"}
        return self._go_on(context) if event.type == "TIMER" else {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Esc, or Blender closes the window: take back what was done."""
        try:
            self._work.close()
        finally:
            self._stop_watching(context)

    def _begin(self, context: bpy.types.Context) -> None:
        self._work, self._shown = self._in_transaction(context), ""
        self._progress = jobs.current = jobs.Progress(self.stage)
        self._timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        self._show_progress(context)

    def _in_transaction(self, context: bpy.types.Context) -> Steps[None]:
        with transaction():
            yield 0.0
            yield from self.steps(context)

    def _go_on(self, context: bpy.types.Context) -> set[str]:
        """Take some steps, and show how far it is."""
        start = time.monotonic()
        try:
            while time.monotonic() < start + _BREATH:
                self._progress.share = next(self._work)
        except StopIteration:
            self._stop_watching(context)
            return {"FINISHED"}
        except (SceneError, ReebError) as error:
            self._stop_watching(context)
            self.report({"ERROR"}, translated(error))
            return {"CANCELLED"}
        except BaseException:
            self._stop_watching(context)
            raise
        self._show_progress(context)
        return {"RUNNING_MODAL"}

    def _show_progress(self, context: bpy.types.Context) -> None:
        text = rpt_("Reeb Parts: {stage} ({share:.0%})    Esc: cancel")
        text = text.format(stage=self._progress.text, share=self._progress.share)
        if text != self._shown:
            self._shown = text
            context.window_manager.progress_update(round(100 * self._progress.share))
            context.workspace.status_text_set(text)
            redraw.sidebars()

    def _stop_watching(self, context: bpy.types.Context) -> None:
        jobs.current = None
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        redraw.sidebars()
