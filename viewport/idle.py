# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes too long to be found at each move: it is looked for step by step once all rests.

To draw again what is seen already, as Blender does to smooth the edges of its picture, is no move.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from typing import Generic

import bpy

from ..core.steps import Result, Steps
from ..scene import redraw
from ..scene.errors import SceneError

REST = 0.15  # seconds without a move
_BREATH = 0.008  # steps are taken for so many seconds before Blender gets on, but at least one

_views: dict[int, tuple[float, ...]] = {}  # what each viewport showed last, by its address
_last = 0.0  # when the pointer or a view has moved


def moved() -> None:
    """The pointer, a slider or a view has moved."""
    global _last
    _last = time.monotonic()


def _drawn() -> None:
    """Blender is drawing a viewport, or nothing."""
    region, view = bpy.context.region, bpy.context.region_data
    if region is None or view is None:
        return
    seen = tuple(value for row in view.perspective_matrix for value in row)
    if _views.get(region.as_pointer()) != seen:
        _views[region.as_pointer()] = seen
        moved()


class IdleSearch(Generic[Result]):
    """Looks for one thing at a time whenever all rests, and has the view drawn again once it is found.

    Parameters
    ----------
    keep : int
        So many of the last that were found are remembered.
    """

    def __init__(self, keep: int = 1) -> None:
        self._keep = keep
        self._found: dict[Hashable, Result | None] = {}
        self._key: Hashable = None
        self._start: Callable[[], Steps[Result]] | None = None
        self._steps: Steps[Result] | None = None
        self._timer = self._go_on  # Blender knows a timer by this very object

    def of(self, key: Hashable, start: Callable[[], Steps[Result]], at_once: bool = False) -> Result | None:
        """What belongs to a key; None for as long as it is not found. To be asked at each redraw.

        start : makes the steps that find it. It is called later, when all of Blender's data may have moved; where it
        or a step raises SceneError, there is nothing to be found.
        at_once : find it now.
        """
        if key in self._found:
            return self._found[key]
        if key != self._key:
            self._look_for(key, start)
            moved()
        if at_once:
            while self._step():
                pass
            return self._found[key]
        _drawn()
        if not bpy.app.timers.is_registered(self._timer):
            bpy.app.timers.register(self._timer, first_interval=REST)
        return None

    def forget(self) -> None:
        """Free what is kept in memory, and look for nothing."""
        self._found.clear()
        _views.clear()
        self._look_for(None, None)
        if bpy.app.timers.is_registered(self._timer):
            bpy.app.timers.unregister(self._timer)

    def _look_for(self, key: Hashable, start: Callable[[], Steps[Result]] | None) -> None:
        if self._steps is not None:
            self._steps.close()
        self._key, self._start, self._steps = key, start, None

    def _go_on(self) -> float | None:
        """Take some steps; returns when Blender's timer is to come again."""
        rested = time.monotonic() - _last
        if self._start is not None and rested < REST:
            return REST - rested
        end = time.monotonic() + _BREATH
        while self._step():
            if time.monotonic() >= end:
                return 0.0
        redraw.viewports()
        return None

    def _step(self) -> bool:
        """Take a step; whether there are more."""
        if self._start is None:
            return False
        found = None
        try:
            if self._steps is None:
                self._steps = self._start()
            next(self._steps)
        except StopIteration as end:
            found = end.value
        except SceneError:
            pass
        except BaseException:
            self._remember(None)  # what goes wrong once is not tried again
            raise
        else:
            return True
        self._remember(found)
        return False

    def _remember(self, found: Result | None) -> None:
        self._found[self._key] = found
        while len(self._found) > self._keep:
            del self._found[next(iter(self._found))]
        self._look_for(None, None)
