# SPDX-License-Identifier: GPL-3.0-or-later
"""Slide the boundary of a part over the surface, with the mouse or by a number."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_n as n_
from bpy.app.translations import pgettext_rpt as rpt_

from . import attributes, bridge, edit, store
from .parts import PartOperator
from .problems import SceneError

HINT = n_("Move the mouse left and right to slide the boundary    Enter: confirm    Esc: cancel")


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
        from ..core.editing import boundary_distance

        self.number = number
        self.numbers = stored.shown[stored.decomposition.candidates]
        pairs, _ = bridge.face_pairs(obj.data)
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


class REEB_PARTS_OT_slide(PartOperator, bpy.types.Operator):
    """Slide the boundary of the active part over the surface with the mouse"""

    bl_idname = "reeb_parts.slide"
    bl_label = "Slide Boundary"

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

    def invoke(self, context, event):
        """Read everything once; each move of the mouse is a comparison of distances then."""
        obj = context.view_layer.objects.active
        if obj.mode != "OBJECT":
            self.report({"ERROR"}, rpt_("Slide boundaries in Object Mode, where the parts can be seen."))
            return {"CANCELLED"}
        try:
            stored = store.load(obj.data)
            edit.check_unlocked(obj, [active_number(obj)])
            self._boundary = Boundary(obj, stored, active_number(obj))
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self._previewed = self._boundary.numbers
        self._colors = store.number_colors(obj.data)
        self._name = obj.name
        self._start = event.mouse_x
        # The whole width of the view is half the size of the object.
        size = float(np.linalg.norm(np.array(obj.dimensions)))
        self._unit = 0.5 * size / max(context.area.width if context.area else 1000, 1)
        context.workspace.status_text_set(rpt_(HINT))
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "MOUSEMOVE":
            offset = (event.mouse_x - self._start) * self._unit * (0.1 if event.shift else 1.0)
            self.offset = float(np.clip(offset, *(0.999 * self._boundary.reach)))
            self._preview(self._boundary.slid(self.offset))
        elif event.type in {"RET", "NUMPAD_ENTER", "LEFTMOUSE"} and event.value == "PRESS":
            self._end(context)
            return self.execute(context)
        elif event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._end(context)
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        self._end(context)

    def _end(self, context):
        self._preview(self._boundary.numbers)
        context.workspace.status_text_set(None)

    def _preview(self, numbers):
        changed = np.flatnonzero(numbers != self._previewed)
        preview(bpy.data.objects[self._name].data, numbers, self._colors, changed)
        self._previewed = numbers


def preview(mesh, numbers, colors, changed=None):
    """Show parts by their colours alone; all else is written when the mouse is released.

    Takes what attributes.color_faces takes.
    """
    attributes.color_faces(mesh, numbers, colors, changed)
    mesh.update()


def active_number(obj) -> int:
    """The part that is active in the list."""
    result = obj.data.reeb_parts
    return result.parts[result.active].number


CLASSES = (REEB_PARTS_OT_slide,)
