# SPDX-License-Identifier: GPL-3.0-or-later
"""Paint faces into the active part with a round brush, over the surface."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Vector

from ..core.arrays.int64 import arange
from ..core.arrays.vectors import box_diagonal
from ..scene.changes import pins
from ..scene.reporting import PartOperator
from ..scene.result import part_names
from ..scene.result.part_list import active_number
from ..scene.store import Stored
from ..viewport import pointing
from ..viewport.modal.brush import START_SIZE, Brush, ReebDab, paint
from ..viewport.modal.colored_tool import ColoredTool
from ..viewport.pointing import Target


class REEB_PARTS_OT_paint(ColoredTool, PartOperator, bpy.types.Operator):
    """Paint faces of other parts into the active part, with the pointer; locked parts stay"""

    bl_idname = "reeb_parts.paint"
    bl_label = "Paint into Part"
    cursor = "PAINT_BRUSH"
    uses_graph = False

    # Not in the panel of what was done last: each dab has the radius that it was painted with.
    stroke: bpy.props.CollectionProperty(type=ReebDab, options={"SKIP_SAVE", "HIDDEN"})
    radius: bpy.props.FloatProperty(
        name="Radius", min=0.0, subtype="DISTANCE", options={"HIDDEN"},
        description="Of the brush, in the units of the mesh",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        number = active_number(obj.data)
        pins.check_unlocked(obj.data, [number])
        brush = Brush(obj, pointing.Model(obj), number)
        for dab in self.stroke:
            brush.dab(dab.location[:], dab.radius, brush.model.face_at(obj, dab.location[:]))
        return paint(context, obj, brush)

    def hint(self) -> str:
        keys = rpt_("Drag over the model to paint    Ctrl and wheel, [ ]: size    Enter: confirm    Esc: cancel")
        return "    ".join((self.told, keys))

    def begin(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        if not self.radius:
            self.radius = START_SIZE * box_diagonal(self.model.face_center)
        super().begin(context, obj)
        self.stroke.clear()
        self.brush = Brush(obj, self.model, self.number)
        self.painting = False
        self.last: tuple[bpy.types.Region, np.ndarray, Target] | None = None  # where the stroke was seen last
        # Not as bright as the part, which has light and shade.
        self.color = (*part_names.number_colors(obj.data)[self.number, :3].tolist(), 0.7)
        self.told = rpt_("Into {name}").format(name=part_names.part_name(obj.data, self.number))

    def hover(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        self._show_brush(target)
        if self.painting:
            self._stroke_to(context, target, event)

    def press(self, context: bpy.types.Context, target: Target, event: bpy.types.Event) -> None:
        self.painting, self.last = True, None
        self._stroke_to(context, target, event)

    def other(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> bool:
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self.painting, self.last = False, None
            return True
        larger = {"RIGHT_BRACKET": True, "LEFT_BRACKET": False}
        if event.ctrl:
            larger |= {"WHEELUPMOUSE": True, "WHEELDOWNMOUSE": False}
        if event.type not in larger or event.value != "PRESS":
            return False
        self.radius *= 1.2 if larger[event.type] else 1 / 1.2
        self._show_brush(target)
        return True

    def finish(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        self.report({"INFO"}, paint(context, obj, self.brush))
        return {"FINISHED"}

    def _stroke_to(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        """Go on with the stroke: a fast pointer is seen in places far apart, and there are dabs between them, too."""
        place = pointing.viewport_region(context.window.screen, event.mouse_x, event.mouse_y)
        if target is None or place is None:
            self.last = None
            return
        region, mouse = place[0], np.array(place[1])
        if self.last is not None and self.last[0] == region:
            self._dabs_between(context, self.last[2], target, region, self.last[1], mouse)
        self.last = region, mouse, target
        self._dab(target)
        self.show(context.view_layer.objects.active, self.brush.numbers())

    def _dabs_between(self, context: bpy.types.Context, before: Target, after: Target, region: bpy.types.Region,
                      start: np.ndarray, end: np.ndarray) -> None:
        """Dabs at steps of half a radius, under the line from one (2,) place of a region to another; never denser than
        its pixels."""
        length = np.linalg.norm(after.location - before.location) / (0.5 * self.radius)
        count = int(min(np.ceil(length), np.ceil(np.abs(end - start).max())))
        obj = context.view_layer.objects.active
        for share in arange(1, count) / max(count, 1):
            mouse = tuple((start + share * (end - start)).tolist())
            target = self.model.under(context, obj, region, mouse, graph=False)
            if target is not None:
                self._dab(target)

    def _dab(self, target: Target) -> None:
        self.brush.dab(target.location, self.radius, target.face)
        dab = self.stroke.add()
        dab.location, dab.radius = target.location.tolist(), self.radius

    def _show_brush(self, target: Target | None) -> None:
        """A disc as large as the brush, lying on the surface, in the color that it gives."""
        if target is None:
            self.preview.show(None)
            self.preview.disc = None
            return
        angle = np.linspace(0.0, 2 * np.pi, 49)
        normal = Vector(self.model.face_normal[target.face]).normalized()
        first = normal.orthogonal().normalized()
        axes = np.array([first, normal.cross(first)])
        ring = target.location + self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1) @ axes
        self.preview.show(np.stack([ring[:-1], ring[1:]], axis=1))
        self.preview.disc, self.preview.disc_color = np.concatenate([[target.location], ring]), self.color
