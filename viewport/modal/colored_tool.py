# SPDX-License-Identifier: GPL-3.0-or-later
"""A tool that shows in colors what the active part would be, and writes its parts once that is confirmed."""

from __future__ import annotations

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.int64 import full
from ...scene.changes import pins
from ...scene.errors import SceneError
from ...scene.outputs import colors
from ...scene.result import part_names
from ...scene.result.part_list import active_number
from .view_tool import CHANGED, ViewTool


class ColoredTool(ViewTool):
    """Shows in colors what the active part would be; all else is written once that is confirmed.

    A class that inherits gives ``finish(context, obj)``, too.
    """

    _shown = None  # (p,) int64, the part that each face has the color of

    def finish(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """It was confirmed; the operator's result. Raises SceneError."""
        raise NotImplementedError

    def begin(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        if self._shown is not None:  # another command has written its parts, and maybe not over all that was shown
            self._shown = full(len(self.model.numbers), -1)
            self.restore()
        self._shown = self.model.numbers
        self.number = active_number(obj.data)
        pins.check_unlocked(obj.data, [self.number])

    def show(self, obj: bpy.types.Object, numbers: np.ndarray) -> None:
        """Color the faces as if they were in other parts. numbers : (p,) int64."""
        changed = np.flatnonzero(numbers != self._shown)
        colors.write(obj.data, numbers, part_names.number_colors(obj.data), changed)
        obj.data.update()
        self._shown = numbers

    def restore(self) -> None:
        """Show the parts as they are."""
        obj = bpy.data.objects.get(self.model.name)
        if self.is_current(obj):
            self.show(obj, self.model.numbers)

    def confirm(self, context: bpy.types.Context) -> set[str]:
        self.restore()
        obj = context.view_layer.objects.active
        if not self.is_current(obj):
            raise SceneError(rpt_(CHANGED))
        return self.finish(context, obj)

    def give_up(self, context: bpy.types.Context) -> set[str]:
        self.restore()
        return {"CANCELLED"}

    def cancel(self, context: bpy.types.Context) -> None:
        self.restore()
        super().cancel(context)
