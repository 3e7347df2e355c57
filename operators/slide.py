# SPDX-License-Identifier: GPL-3.0-or-later
"""Slide the boundary of a part over the surface, with the mouse or by a number."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import bridge, mesh_arrays
from ..scene.errors import SceneError
from ..viewport.view_tool import ColoredTool, active_number, turns_view
from . import edit
from .parts import PartOperator


class Boundary:
    """The boundary of one part, ready to be slid.

    Attributes
    ----------
    numbers : (p,) int64
        The part of each face, before.
    distance : (p,) float64
        From the boundary, negative inside the part; nan for faces that must stay.
    reach : (2,) float64
        How far it can be slid inwards and outwards, as distances.
    """

    def __init__(self, obj, stored, number):
        from ..core.result.editing import boundary_distance

        self.number = number
        self.numbers = stored.shown[stored.decomposition.candidates]
        pairs, _ = mesh_arrays.face_pairs(obj.data)
        center = bridge.face_centers(obj)
        length = np.linalg.norm(center[pairs[:, 0]] - center[pairs[:, 1]], axis=1)
        locked = edit.locked_others(obj.data, number)
        inside = self.numbers == number
        distance, across = boundary_distance(inside, pairs, length)
        # What a face inside would go to; its own part for one that has nowhere to go.
        self.receiver = np.where(inside & (across >= 0), self.numbers[across], self.numbers)
        self.distance = np.where(np.isin(self.numbers, locked) | np.isin(self.receiver, locked), np.nan, distance)
        known = self.distance[np.isfinite(self.distance)]
        self.reach = np.array([known.min(initial=0.0), known.max(initial=0.0)])

    def slid(self, offset) -> np.ndarray:
        """The part of each face with the boundary moved outwards by a distance, (p,) int64."""
        with np.errstate(invalid="ignore"):  # nan: the face stays
            taken = (self.distance > 0) & (self.distance <= offset)
            given = (self.distance < 0) & (self.distance >= offset)
        return np.where(taken, self.number, np.where(given, self.receiver, self.numbers))


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

    def work(self, context, obj, stored):
        boundary = Boundary(obj, stored, active_number(obj))
        numbers = boundary.slid(self.offset)
        if (numbers == boundary.number).sum() == 0:
            raise SceneError(rpt_("Nothing would be left of the part. Slide the boundary less far."))
        edit.assign_faces(context, obj, stored, numbers)

    def hint(self):
        return rpt_("Move the mouse left and right to slide the boundary    Enter: confirm    Esc: cancel")

    def begin(self, context, obj):
        """Read everything once; each move of the mouse is a comparison of distances then."""
        super().begin(context, obj)
        self.boundary = Boundary(obj, self.model.stored, self.number)
        self.offset = 0.0
        # The whole width of the view is half the size of the object.
        size = float(np.linalg.norm(np.array(obj.dimensions)))
        self.unit = 0.5 * size / max(context.area.width if context.area else 1000, 1)
        self.last_x = None  # of the pointer, unless it was used for something else since

    def hover(self, context, target, event):
        if event.type != "MOUSEMOVE":  # those between would only make it late
            return
        if self.last_x is not None:
            way = (event.mouse_x - self.last_x) * self.unit * (0.1 if event.shift else 1.0)
            self.offset = float(np.clip(self.offset + way, *(0.999 * self.boundary.reach)))
            self.show(context.view_layer.objects.active, self.boundary.slid(self.offset))
        self.last_x = event.mouse_x

    def press(self, context, target, event):
        return self.confirm(context)

    def other(self, context, target, event):
        """Only the view can be turned meanwhile."""
        if not turns_view(context, event):
            return True
        self.last_x = None
        return False

    def finish(self, context, obj):
        return self.execute(context)


CLASSES = (REEB_PARTS_OT_slide,)
