# SPDX-License-Identifier: GPL-3.0-or-later
"""What was at work in a window that the user has closed goes on in another one.

Blender drops what goes on in a window that it closes. The same command is called again, with what it was called with,
as soon as the window is gone, in one that shows the same objects.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import running
from .redraw import viewports_of
from .runs import jobs

# What is about to go on, if anything.
_left: _Left | None = None


def is_closing(context: bpy.types.Context) -> bool:
    """Whether Blender is closing this window, and others stay.

    Where it opens another file, or quits, the windows are all still there while it drops what goes on in them.
    """
    windows = context.window_manager.windows[:]
    return context.window is not None and context.window not in windows and bool(windows)


def go_on(operator: bpy.types.Operator, context: bpy.types.Context, job: jobs.Job | None) -> None:
    """Call an operator again once its window is closed.

    job : for ``taken_over``; ended if there is no window in which that can be.
    """
    global _left
    _left = _Left(operator, context, job)
    running.begun(_left, context)
    bpy.app.timers.register(_left.timer, first_interval=0.0)


def taken_over() -> jobs.Job | None:
    """The job of the operator that goes on, to whoever is called for it; None if there is none."""
    return _left.job if _left is not None else None


class _Left:
    """What was at work in a window that is being closed."""

    def __init__(self, operator: bpy.types.Operator, context: bpy.types.Context, job: jobs.Job | None) -> None:
        self.job = job
        self._called, self._label = type(operator).__name__, operator.bl_label
        self._arguments = _arguments(operator.properties)
        self._showed = _shown(context.window)
        self.timer = self.go_on  # Blender knows a timer by this very object

    def go_on(self) -> None:
        """Called by Blender when the window is gone."""
        # Windows with a viewport first, before those of the preferences and such.
        windows = sorted(bpy.context.window_manager.windows, key=lambda window: not viewports_of(window))
        same = [window for window in windows if _shown(window) == self._showed]
        try:
            if not same or jobs.current is not None or not self._start(same[0]):
                self._end(windows)
        finally:
            self._forget()

    def _start(self, window: bpy.types.Window) -> bool:
        """Call the operator in a window, over a viewport if it has one; whether it has begun."""
        module, name = self._called.lower().split("_ot_")
        call = getattr(getattr(bpy.ops, module), name)
        place: dict[str, Any] = {}
        for area in viewports_of(window)[:1]:
            place = {"area": area, "region": next(region for region in area.regions if region.type == "WINDOW")}
        try:
            with bpy.context.temp_override(window=window, **place):
                done = call("INVOKE_DEFAULT", True, **self._arguments)
        except RuntimeError:  # what it was at work on is not there any more
            return False
        return done != {"CANCELLED"}

    def _end(self, windows: list[bpy.types.Window]) -> None:
        """End it, and say so in one of the windows: nobody would hear of it."""
        self.cancel(bpy.context)
        if not windows:  # Blender quits
            return
        words = rpt_("{command} was ended with its window; nothing was changed.").format(
            command=rpt_(self._label, "Operator"))
        with bpy.context.temp_override(window=windows[0]):
            bpy.context.window_manager.popup_menu(
                lambda menu, _: menu.layout.label(text=words), title="Reeb Parts", icon="INFO")

    def cancel(self, context: bpy.types.Context) -> None:
        """The extension is switched off; see running."""
        if self.job is not None:
            self.job.cancel()
        self._forget()

    def _forget(self) -> None:
        global _left
        running.ended(self)
        _left = None
        if bpy.app.timers.is_registered(self.timer):
            bpy.app.timers.unregister(self.timer)


def _arguments(properties: bpy.types.OperatorProperties) -> dict[str, Any]:
    """What an operator was called with, of which nothing is the operator's own, which Blender frees."""
    found = {}
    for prop in properties.bl_rna.properties:
        if prop.identifier != "rna_type" and properties.is_property_set(prop.identifier):
            value = getattr(properties, prop.identifier)
            found[prop.identifier] = tuple(value) if getattr(prop, "is_array", False) else value
    return found


def _shown(window: bpy.types.Window) -> tuple[str, str]:
    """The scene and the view layer that a window shows."""
    return window.scene.name_full, window.view_layer.name
