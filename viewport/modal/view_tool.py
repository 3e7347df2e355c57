# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools that are used with the pointer over the model until they are confirmed or cancelled."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import gpu
import numpy as np
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.steps import Steps
from ...scene import redraw, running
from ...scene.errors import SceneError, translated
from ...scene.reporting import ReportingOperator
from ...scene.transaction import transaction
from .. import hover, idle, pointing
from ..idle import IdleSearch
from ..lines import Lines, fill
from ..pointing import Target

_CONFIRM = {"RET", "NUMPAD_ENTER"}
_CANCEL = {"ESC", "RIGHTMOUSE"}
_MOVES = {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"}
CHANGED = n_("The object was changed meanwhile.")
UNSEEN = n_("This works in Object Mode, where the parts can be seen.")
_TURNS = {"view3d.rotate", "view3d.move", "view3d.zoom", "view3d.dolly"}


class Preview:
    """Lines that are drawn over the view while a tool is at work; outlives nothing of Blender's."""

    def __init__(self) -> None:
        self._lines: np.ndarray | None = None  # (k, 2, 3) float, in coordinates of the mesh
        self._smoothing: Callable[[], Steps[np.ndarray]] | None = None  # makes the steps that find better ones
        self._shown = 0  # how often lines were shown
        self._search: IdleSearch[np.ndarray] = IdleSearch()
        self.faint_lines = None  # as the lines, of what comes next
        self.disc = None  # (t, 3) float, corners around its middle, which comes first
        self.disc_color = (1.0, 1.0, 1.0, 1.0)
        self.matrix = None  # of the object, in the world
        self.color = (1.0, 1.0, 1.0, 1.0)
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_VIEW")

    def remove(self) -> None:
        bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")
        self._search.forget()

    def show(self, lines: np.ndarray | None, smoothing: Callable[[], Steps[np.ndarray]] | None = None) -> None:
        """Draw lines, (k, 2, 3) in coordinates of the mesh, and others in their place once the view rests.

        smoothing : makes the steps that find these.
        """
        self._lines, self._smoothing = lines, smoothing
        self._shown += 1

    @property
    def lines(self) -> np.ndarray | None:
        """The lines that are drawn now; asked for at each redraw."""
        smooth = self._search.of(self._shown, self._smoothing) if self._smoothing is not None else None
        return self._lines if smooth is None else smooth

    def _draw(self) -> None:
        if self.disc is not None:
            fill(self.disc, self.matrix, self.disc_color)
        for lines, width, opacity in ((self.faint_lines, 1.0, 0.4), (self.lines, 3.0, 1.0)):
            if lines is not None and len(lines):
                gpu.state.blend_set("ALPHA")
                color = (*self.color[:3], opacity)
                Lines(lines.reshape(-1, 3).astype("float32")).draw(self.matrix, width, color)
                gpu.state.blend_set("NONE")


class ViewTool(ReportingOperator):
    """For operators that look at what is under the pointer; the active object is the model.

    A class that inherits gives ``hint()`` and any of ``hover``, ``press``, ``other`` and ``confirm``. Events
    that it does not use go their usual way, so that the view can be turned meanwhile.
    """

    cursor = "EYEDROPPER"
    aims = True  # at places of the model; a tool that does not is confirmed by a click
    uses_graph = True  # or only the surface
    needs_object_mode = True  # or does its work at once in other modes

    @classmethod
    def check_context(cls, context: bpy.types.Context) -> None:
        super().check_context(context)
        # Of what has no button that could be grey, as in a search or a script, the call itself tells.
        has_button = context.region is not None and context.region.type == "UI"
        if has_button and cls.needs_object_mode and context.mode != "OBJECT":
            raise SceneError(rpt_(UNSEEN))

    def hint(self) -> str:
        """What the status bar says."""
        raise NotImplementedError

    def begin(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        """Read what more is needed; raises SceneError."""

    def hover(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        """The pointer moved; target is None beside the model."""

    def press(self, context: bpy.types.Context, target: Target, event: bpy.types.Event) -> set[str] | None:
        """The left button went down on the model; the operator's result, or None to go on."""

    def other(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> bool:
        """Any other event over the view; True if it was used."""
        return False

    def confirm(self, context: bpy.types.Context) -> set[str]:
        """Enter was pressed; the operator's result."""
        return {"FINISHED"}

    def give_up(self, context: bpy.types.Context) -> set[str]:
        """Esc was pressed; the operator's result."""
        return {"CANCELLED"}

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self.attempt(self._start, context, event)

    def _start(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        obj = context.view_layer.objects.active
        if context.area is None or context.area.type != "VIEW_3D":
            raise SceneError(rpt_("This works over a 3D viewport."))
        if obj.mode != "OBJECT":
            raise SceneError(rpt_(UNSEEN))
        self._read(context, obj)
        self.preview = Preview()
        self.preview.matrix = obj.matrix_world.copy()
        hover.clear()
        context.window.cursor_modal_set(self.cursor)
        context.workspace.status_text_set(self.hint())
        if self.aims:  # started by a key, the pointer rests over the model already
            try:
                place = pointing.viewport_region(context.window.screen, event.mouse_x, event.mouse_y)
                self.hover(context, self._target(context, place), event)
            except BaseException:
                self._end(context)
                raise
        redraw.viewports()
        context.window_manager.modal_handler_add(self)
        running.begun(self, context)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        result = {"CANCELLED"}  # by Blender, if it ends with an exception
        try:
            result = self._answer(context, event)
        finally:
            if result & {"FINISHED", "CANCELLED"}:
                self._end(context)
        return result

    def cancel(self, context: bpy.types.Context) -> None:
        self._end(context)

    def _answer(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        try:
            with transaction():
                return self._do(context, event)
        except (SceneError, MemoryError) as error:
            self.report({"ERROR"}, translated(error))
            return self.give_up(context)

    def _do(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        moves_view = event.type == "RIGHTMOUSE" and event.alt  # where Alt and a button move the view
        if event.type in _CANCEL and event.value == "PRESS" and not moves_view:
            return self.give_up(context)
        if event.type in _CONFIRM and event.value == "PRESS":
            return self.confirm(context)
        # Of the area that it was started in there may be nothing left: another workspace, a maximized area.
        place = pointing.viewport_region(context.window.screen, event.mouse_x, event.mouse_y)
        if place is None and self.aims:
            return {"PASS_THROUGH"}
        return self._use(context, self._target(context, place), event)

    def _use(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> set[str]:
        if event.type in _MOVES:
            idle.moved()
            self.hover(context, target, event)
            redraw.viewports()
            return {"RUNNING_MODAL"}
        if event.type == "LEFTMOUSE" and event.value == "PRESS" and not event.alt:  # Alt turns the view
            if not self.aims:
                return self.confirm(context)
            # Beside the model a click would deselect it.
            return (None if target is None else self.press(context, target, event)) or {"RUNNING_MODAL"}
        used = self.other(context, target, event)
        redraw.viewports()
        return {"RUNNING_MODAL"} if used else {"PASS_THROUGH"}

    def _target(self, context: bpy.types.Context,
                place: tuple[bpy.types.Region, tuple[float, float]] | None) -> Target | None:
        """What is under the pointer; everything is read again if parts or object have changed."""
        obj = context.view_layer.objects.active
        if obj is None or obj.type != "MESH" or obj.mode != "OBJECT":
            raise SceneError(rpt_(CHANGED))
        if not self.is_current(obj):
            self._read(context, obj)
        self.preview.matrix = obj.matrix_world.copy()
        if place is None or not self.aims:
            return None
        region, mouse = place
        return self.model.under(context, obj, region, mouse, graph=self.uses_graph)

    def model_object(self) -> bpy.types.Object:
        """The object that was read. Raises SceneError if it or its parts have changed since."""
        obj = bpy.data.objects.get(self.model.name)
        if not self.is_current(obj):
            raise SceneError(rpt_(CHANGED))
        return obj

    def is_current(self, obj: bpy.types.Object | None) -> bool:
        """Whether an object is the one that was read, with the parts that it had then; it may be None."""
        return obj is not None and obj.type == "MESH" and self._key == pointing.result_key(obj)

    def _read(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        self.model = pointing.Model(obj)
        self._key = pointing.result_key(obj)
        self.begin(context, obj)

    def _end(self, context: bpy.types.Context) -> None:
        self.preview.remove()
        context.window.cursor_modal_restore()
        redraw.show_status(None)
        redraw.viewports()
        running.ended(self)


def turns_view(context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Whether an event moves the view, by the keys and buttons that the user has set."""
    keymap = context.window_manager.keyconfigs.user.keymaps["3D View"]
    found = keymap.keymap_items.match_event(event)
    return found is not None and (found.idname in _TURNS or found.idname.startswith(("view3d.view_", "view3d.ndof_")))
