# SPDX-License-Identifier: GPL-3.0-or-later
"""Slide the boundary of a part over the surface, with the mouse or by a number."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene.changes import pins
from ..scene.errors import SceneError
from ..scene.reporting import PartOperator
from ..scene.result import part_names
from ..scene.result.part_list import active_number
from ..scene.store import Stored
from ..viewport import pointing
from ..viewport.modal.boundary import Boundary, check_borders, write_moved
from ..viewport.modal.colored_tool import ColoredTool
from ..viewport.modal.view_tool import turns_view
from ..viewport.pointing import Target


class REEB_PARTS_OT_slide(ColoredTool, PartOperator, bpy.types.Operator):
    """Slide the boundary of the active part over the surface with the mouse"""

    bl_idname = "reeb_parts.slide"
    bl_label = "Slide Boundary"
    bl_options = {"REGISTER", "UNDO", "BLOCKING", "GRAB_CURSOR_X"}  # from the button at the edge, too
    cursor = "MOVE_X"
    aims = False

    offset: bpy.props.FloatProperty(
        name="Distance", subtype="DISTANCE", options={"SKIP_SAVE"},
        description="How far along the surface; negative inwards",
    )

    neighbor: bpy.props.IntProperty(
        name="Neighbor", default=0, min=0, options={"SKIP_SAVE"},
        description="Number of the part at which the boundary slides; 0 for all of the boundary",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str | None:
        number = active_number(obj.data)
        pins.check_unlocked(obj.data, [number])
        boundary = Boundary(obj, stored, number, self.neighbor)
        check_borders(obj, [boundary])
        numbers = boundary.slid(self.offset)
        if (numbers == boundary.number).sum() == 0:
            raise SceneError(rpt_("Nothing would be left of the part. Slide the boundary less far."))
        return write_moved(context, obj, stored, numbers, [boundary.number])

    def hint(self) -> str:
        keys = rpt_("Move the mouse left and right to slide it    A: all of it    Enter: confirm    Esc: cancel")
        return "    ".join((self.told, keys))

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.place = event.mouse_x, event.mouse_y
        return super().invoke(context, event)

    def begin(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        """Read everything once; each move of the mouse is a comparison of distances then."""
        super().begin(context, obj)
        self.whole = self.boundary = Boundary(obj, self.model.stored, self.number)
        check_borders(obj, [self.whole])
        self._keep_to(obj, self._pointed(context, obj))
        self.offset = 0.0
        # The whole width of the view is half the size of the object.
        size = float(np.linalg.norm(np.array(obj.dimensions)))
        self.unit = 0.5 * size / max(context.area.width if context.area else 1000, 1)
        self.last_x = None  # of the pointer, unless it was used for something else since

    def _pointed(self, context: bpy.types.Context, obj: bpy.types.Object) -> int:
        """The neighbor whose stretch of the boundary is nearest to the pointer; 0 where that does not tell."""
        view = pointing.viewport_region(context.window.screen, *self.place)
        target = self.model.under(context, obj, *view, graph=False) if view is not None else None
        if target is None or len(self.whole.neighbors) < 2:
            return 0
        number = self.model.number(target)
        if number == self.number:
            return self.whole.nearest_neighbor(self.whole.center[target.face])
        return number if number in self.whole.neighbors else 0

    def _keep_to(self, obj: bpy.types.Object, neighbor: int) -> None:
        """Slide the boundary where it meets a neighbor, or all of it."""
        self.neighbor = neighbor
        self.boundary = Boundary(obj, self.model.stored, self.number, neighbor) if neighbor else self.whole
        name = part_names.part_name(obj.data, self.number)
        if neighbor:
            text, other = rpt_("Boundary of {name} at {other}"), part_names.part_name(obj.data, neighbor)
            self.told = text.format(name=name, other=other)
        else:
            self.told = rpt_("All of the boundary of {name}").format(name=name)

    def hover(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        if event.type != "MOUSEMOVE":  # those between would only make it late
            return
        if self.last_x is not None:
            way = (event.mouse_x - self.last_x) * self.unit * (0.1 if event.shift else 1.0)
            self.offset = float(np.clip(self.offset + way, *(0.999 * self.boundary.reach)))
            self.show(context.view_layer.objects.active, self.boundary.slid(self.offset))
        self.last_x = event.mouse_x

    def other(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> bool:
        """Only the view can be turned meanwhile."""
        if event.type == "A" and event.value == "PRESS" and self.neighbor:
            obj = context.view_layer.objects.active
            self._keep_to(obj, 0)
            self.show(obj, self.boundary.slid(self.offset))
            context.workspace.status_text_set(self.hint())
        if not turns_view(context, event):
            return True
        self.last_x = None
        return False

    def finish(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        if np.array_equal(self.boundary.slid(self.offset), self.boundary.numbers):
            return {"CANCELLED"}
        return self.execute(context)
