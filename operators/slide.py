# SPDX-License-Identifier: GPL-3.0-or-later
"""Slide the boundary of a part over the surface, with the mouse or by a number."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import edits
from ..scene.errors import SceneError
from ..scene.part_list import active_number
from ..scene.reporting import PartOperator
from ..scene.store import Stored
from ..viewport.boundary import Boundary
from ..viewport.colored_tool import ColoredTool
from ..viewport.pointing import Target
from ..viewport.view_tool import turns_view


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

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        boundary = Boundary(obj, stored, active_number(obj.data))
        numbers = boundary.slid(self.offset)
        if (numbers == boundary.number).sum() == 0:
            raise SceneError(rpt_("Nothing would be left of the part. Slide the boundary less far."))
        edits.assign_faces(context, obj, stored, numbers)

    def hint(self) -> str:
        return rpt_("Move the mouse left and right to slide the boundary    Enter: confirm    Esc: cancel")

    def begin(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        """Read everything once; each move of the mouse is a comparison of distances then."""
        super().begin(context, obj)
        self.boundary = Boundary(obj, self.model.stored, self.number)
        self.offset = 0.0
        # The whole width of the view is half the size of the object.
        size = float(np.linalg.norm(np.array(obj.dimensions)))
        self.unit = 0.5 * size / max(context.area.width if context.area else 1000, 1)
        self.last_x = None  # of the pointer, unless it was used for something else since

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
        if not turns_view(context, event):
            return True
        self.last_x = None
        return False

    def finish(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        return self.execute(context)
