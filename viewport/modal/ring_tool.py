# SPDX-License-Identifier: GPL-3.0-or-later
"""A tool that moves the boundaries of the chosen parts ring by ring, by the wheel or by a number."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.sentence import Count
from ...core.steps import Steps
from ...scene.changes import pins
from ...scene.errors import SceneError
from ...scene.pieces import cut_curves
from ...scene.reading.seen_points import seen_points
from ...scene.result import part_list
from ...scene.store import Stored
from ..pointing import Target
from .boundary import Boundary, check_borders, write_moved
from .colored_tool import ColoredTool
from .view_tool import turns_view

if TYPE_CHECKING:
    from ...core.uses.clean_cuts.curves import Curves

_WORDS = ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE")
_DIGITS = {key: digit for digit, word in enumerate(_WORDS) for key in (word, f"NUMPAD_{digit}")}
_STEPS = {"WHEELUPMOUSE": 1, "WHEELDOWNMOUSE": -1, "NUMPAD_PLUS": 1, "PLUS": 1, "EQUAL": 1, "UP_ARROW": 1,
          "NUMPAD_MINUS": -1, "MINUS": -1, "DOWN_ARROW": -1}


def moved(boundaries: list[Boundary], rings: int) -> np.ndarray:
    """The part of each face with some boundaries moved outwards by so many rings, (p,) int64.

    Where two parts want the same face, the first has it.
    """
    numbers = boundaries[0].numbers.copy()
    for boundary in reversed(boundaries):
        after = boundary.slid(boundary.offset(rings))
        numbers = np.where(after != boundary.numbers, after, numbers)
    return numbers


def move(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, boundaries: list[Boundary],
         rings: int) -> str:
    """Move boundaries for good; what happened, in a sentence. Raises SceneError if nothing would change."""
    parts = [boundary.number for boundary in boundaries]
    told = write_moved(context, obj, stored, moved(boundaries, rings), parts)
    if told is None:
        raise SceneError(rpt_("Nothing beyond the boundary can be taken or given: it is locked, or all there is."))
    return told


class RingTool(ColoredTool):
    """Shows where the boundaries of the chosen parts would go, ring by ring, with the rings that come next.

    A class that inherits gives ``way`` and the property ``rings``.
    """

    cursor = "DEFAULT"
    aims = False
    way = 1  # 1 outwards, -1 inwards
    at_work = False
    rings: int

    def hint(self) -> str:
        low, high = self.limits
        text = rpt_("{rings} {rings:ring|rings}, {low} to {high}    Wheel or a number: rings, minus inwards    "
                    "Click, Enter: confirm    Esc: cancel")
        return text.format(rings=Count(self.rings), low=low, high=high)

    def boundaries(self, obj: bpy.types.Object, stored: Stored) -> list[Boundary]:
        """Of the chosen parts; raises SceneError if one is locked, or none borders on another part."""
        numbers = part_list.chosen_numbers(obj.data)
        pins.check_unlocked(obj.data, numbers)
        boundaries = [Boundary(obj, stored, number) for number in numbers]
        check_borders(obj, boundaries)
        return boundaries

    def _start(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        result = super()._start(context, event)
        self.at_work = True
        self._show_rings(context)
        return result

    def begin(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        super().begin(context, obj)
        self.read(obj)
        self._go_to(context, obj, self.way)

    def read(self, obj: bpy.types.Object) -> None:
        """Read everything once; each ring is a comparison of distances then."""
        self.moving = self.boundaries(obj, self.model.stored)
        lows, highs = zip(*(boundary.most for boundary in self.moving), strict=True)
        self.limits = max(lows), max(highs)
        self.points = seen_points(bpy.context, obj)
        self.typed = ""

    def hover(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        """The place of the pointer means nothing."""

    def other(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> bool:
        """Only the view can be turned meanwhile."""
        if event.value == "PRESS" and (rings := self._asked(event)) is not None:
            self._go_to(context, context.view_layer.objects.active, rings)
            return True
        return not turns_view(context, event)

    def _asked(self, event: bpy.types.Event) -> int | None:
        """How many rings an event asks for; None if it does not."""
        if event.ctrl or event.alt or event.oskey:
            return None
        if event.type in _DIGITS or event.type == "BACK_SPACE":
            typed = self.typed[:-1] if event.type == "BACK_SPACE" else f"{self.typed}{_DIGITS[event.type]}"[-4:]
            self.typed = typed
            return (-1 if self.rings < 0 or (not self.rings and self.way < 0) else 1) * int(typed or 0)
        if event.type not in _STEPS:
            return None
        if self.typed and event.type in {"MINUS", "NUMPAD_MINUS"}:  # the number that is being typed
            return -self.rings
        self.typed = ""
        return self.rings + _STEPS[event.type]

    def _go_to(self, context: bpy.types.Context, obj: bpy.types.Object, rings: int) -> None:
        self.go_to(obj, rings)
        if self.at_work:
            self._show_rings(context)

    def go_to(self, obj: bpy.types.Object, rings: int) -> None:
        """Show where the boundaries would be after so many rings."""
        self.rings = int(np.clip(rings, *self.limits))
        self.show(obj, moved(self.moving, self.rings))
        ahead = (1 if self.rings > 0 else -1) if self.rings else self.way
        found = [boundary.ring_edges(self.rings, ahead) for boundary in self.moving]
        self.rim, self.next = (self.points[np.concatenate(some)] for some in zip(*found, strict=True))

    def _show_rings(self, context: bpy.types.Context) -> None:
        cut = context.scene.reeb_parts_use.cut
        numbers = None if cut == "FACES" else self._shown
        self.preview.show(self.rim, None if numbers is None else partial(self.finding_rim, numbers, cut == "PLANAR"))
        self.preview.faint_lines = self.next
        context.workspace.status_text_set(self.hint())

    def finding_rim(self, numbers: np.ndarray, planar: bool) -> Steps[np.ndarray]:
        """Find the lines that Separate would cut along if each face were in the part of a number, (p,), in steps."""
        steps = cut_curves.finding_curves(*cut_curves.read(self.model_object()), numbers, planar)
        return self._rim_of(steps, [boundary.number for boundary in self.moving])

    def _rim_of(self, steps: Steps[Curves], parts: list[int]) -> Steps[np.ndarray]:
        curves = yield from steps
        here = np.any([curves.around([number]) for number in parts], axis=0)
        return curves.points(self.points)[curves.segments[here]]

    def finish(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        if not self.rings:
            return {"CANCELLED"}
        self.report({"INFO"}, move(context, obj, self.model.stored, self.moving, self.rings))
        return {"FINISHED"}
