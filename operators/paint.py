# SPDX-License-Identifier: GPL-3.0-or-later
"""Paint faces into the active part with a round brush, over the surface."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Vector

from ..scene import mesh_arrays, store
from ..scene.errors import SceneError
from ..viewport import pointing
from ..viewport.view_tool import ColoredTool, active_number
from . import edit
from .parts import PartOperator

START_SIZE = 0.04  # radius of the brush, as a share of the object's size


class Brush:
    """Which faces a dab of the brush covers; read once.

    Attributes
    ----------
    number : int
        The part that is painted.
    chosen : (p,) bool
        Faces painted so far.
    """

    def __init__(self, obj, model, number):
        self.model, self.number = model, number
        count = len(model.face_value)
        pairs, _ = mesh_arrays.face_pairs(obj.data)
        first, second = np.concatenate([pairs, pairs[:, ::-1]]).T
        self.neighbors = second[np.argsort(first, kind="stable")]  # of each face, one face after the other
        self.start = np.append(0, np.cumsum(np.bincount(first, minlength=count)))
        self.place = np.full(count, -1)
        self.chosen = np.zeros(count, bool)
        self.free = ~np.isin(model.numbers, edit.locked_others(obj.data, number))

    def dab(self, location, radius):
        """Paint faces around a (3,) location, in coordinates of the mesh, as far as the surface goes there."""
        from ..core.surface.mesh import components

        _, first = self.model.tree.query(location)
        near = np.array(self.model.tree.query_ball_point(location, radius), np.int64)
        if first not in near:  # faces larger than the brush are painted one by one
            near = np.append(near, first)
        self.place[near] = np.arange(len(near))
        degree = self.start[near + 1] - self.start[near]
        owner = np.repeat(np.arange(len(near)), degree)
        row = np.arange(degree.sum()) - np.repeat(np.cumsum(degree) - degree, degree)
        beside = self.place[self.neighbors[np.repeat(self.start[near], degree) + row]]
        _, piece = components(len(near), owner[beside >= 0], beside[beside >= 0])
        hit = near[piece == piece[self.place[first]]]
        self.place[near] = -1
        self.chosen[hit[self.free[hit]]] = True

    def numbers(self) -> np.ndarray:
        """The part of each face once it is painted, (p,) int64."""
        return np.where(self.chosen, self.number, self.model.numbers)


class ReebDab(bpy.types.PropertyGroup):
    """A dab of the brush, in coordinates of the mesh."""

    location: bpy.props.FloatVectorProperty(name="Location", size=3, subtype="XYZ")
    radius: bpy.props.FloatProperty(name="Radius", min=0.0, subtype="DISTANCE")


class REEB_PARTS_OT_paint(ColoredTool, PartOperator, bpy.types.Operator):
    """Paint faces of other parts into the active part, with the pointer; locked parts stay"""

    bl_idname = "reeb_parts.paint"
    bl_label = "Paint into Part"
    cursor = "PAINT_BRUSH"
    uses_graph = False

    stroke: bpy.props.CollectionProperty(type=ReebDab, options={"SKIP_SAVE"})
    radius: bpy.props.FloatProperty(
        name="Radius", min=0.0, subtype="DISTANCE", description="Of the brush, in the units of the mesh",
    )

    def work(self, context, obj, stored):
        brush = Brush(obj, pointing.Model(obj), active_number(obj))
        for dab in self.stroke:
            brush.dab(dab.location[:], dab.radius)
        return _paint(context, obj, brush)

    def hint(self):
        return rpt_("Drag over the model to paint    Ctrl and wheel, [ ]: size    Enter: confirm    Esc: cancel")

    def begin(self, context, obj):
        if not self.radius:
            self.radius = START_SIZE * float(np.linalg.norm(np.ptp(self.model.face_center, axis=0)))
        super().begin(context, obj)
        self.stroke.clear()
        self.brush = Brush(obj, self.model, self.number)
        self.painting = False

    def hover(self, context, target, event):
        self._show_brush(target)
        if self.painting and target is not None:
            self._dab(context, target)

    def press(self, context, target, event):
        self.painting = True
        self._dab(context, target)

    def other(self, context, target, event):
        if event.type == "LEFTMOUSE":
            self.painting = False
            return True
        larger = {"RIGHT_BRACKET": True, "LEFT_BRACKET": False}
        if event.ctrl:
            larger |= {"WHEELUPMOUSE": True, "WHEELDOWNMOUSE": False}
        if event.type not in larger or event.value != "PRESS":
            return False
        self.radius *= 1.2 if larger[event.type] else 1 / 1.2
        self._show_brush(target)
        return True

    def finish(self, context, obj):
        self.report({"INFO"}, _paint(context, obj, self.brush))
        return {"FINISHED"}

    def _dab(self, context, target):
        self.brush.dab(target.location, self.radius)
        dab = self.stroke.add()
        dab.location, dab.radius = target.location.tolist(), self.radius
        self.show(context.view_layer.objects.active, self.brush.numbers())

    def _show_brush(self, target):
        """A circle as large as the brush, lying on the surface."""
        if target is None:
            self.preview.lines = None
            return
        angle = np.linspace(0.0, 2 * np.pi, 49)
        normal = Vector(self._normal(target.face))
        first = normal.orthogonal().normalized()
        axes = np.array([first, normal.cross(first)])
        ring = target.location + self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1) @ axes
        self.preview.lines = np.stack([ring[:-1], ring[1:]], axis=1)

    def _normal(self, face):
        return bpy.data.objects[self.model.name].data.polygons[face].normal


def _paint(context, obj, brush) -> str:
    """Give the painted faces to the part; what happened, in a sentence."""
    moved = brush.numbers() != brush.model.numbers
    if not moved.any():
        raise SceneError(rpt_("No faces were painted."))
    edit.assign_faces(context, obj, brush.model.stored, brush.numbers())
    stored = store.load(obj.data)
    joined = int((stored.shown[stored.decomposition.candidates[moved]] == brush.number).sum())
    name = store.part_name(obj.data, brush.number)
    if joined < moved.sum():
        text = rpt_("{n} of {total} faces are {name} now; the others do not touch it and are parts of their own")
        return text.format(n=joined, total=int(moved.sum()), name=name)
    return rpt_("{n} faces are {name} now").format(n=joined, name=name)


CLASSES = (ReebDab, REEB_PARTS_OT_paint,)
