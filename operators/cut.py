# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut a part where the user points: along the contour of the field through a place of the graph or surface."""

from functools import partial

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Vector

from ..core.steps import Steps
from ..scene import redraw
from ..scene.reporting import PartOperator
from ..scene.store import Stored
from ..viewport import pointing
from ..viewport.modal.knife import Knife, cut_at, nothing_there
from ..viewport.modal.view_tool import ViewTool
from ..viewport.pointing import Target


class REEB_PARTS_OT_cut(ViewTool, PartOperator, bpy.types.Operator):
    """Cut a part where you click, on the graph or on the surface; a ring shows where the cut will be"""

    bl_idname = "reeb_parts.cut"
    bl_label = "Cut Part at Point"
    cursor = "KNIFE"

    location: bpy.props.FloatVectorProperty(
        name="Location", size=3, subtype="XYZ", description="Where to cut, in the world",
    )
    on_graph: bpy.props.BoolProperty(
        name="On the Graph", default=True,
        description="The location is on an arc of the graph; without it, on the surface",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> str:
        model = pointing.Model(obj)
        return cut_at(context, obj, model, model.at(obj, self.location, self.on_graph))

    def hint(self) -> str:
        return rpt_("Click the graph or the surface to cut the part there    Enter, Esc: end")

    def begin(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        self.knife = Knife(obj, self.model)
        self.told = self.hint()

    def hover(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        self._tell(self.hint())
        if target is None:
            self.preview.show(None)
        else:
            cut = context.scene.reeb_parts_use.cut
            self.preview.show(self.knife.ring(target), partial(self._finding_curve, target, cut))

    def _finding_curve(self, target: Target, cut: str) -> Steps[np.ndarray]:
        """The lines of the cut, in steps; where there is none, the status bar says so."""
        obj = self.model_object()
        lines = yield from self.knife.finding_curve(obj, target, cut == "PLANAR", cut == "FACES")
        if not len(lines):
            self._tell(nothing_there(obj, self.model.number(target)))
        return lines

    def _tell(self, text: str) -> None:
        """Say something in the status bar, until something else is said."""
        if text != self.told:
            self.told = text
            redraw.show_status(text)

    def press(self, context: bpy.types.Context, target: Target, event: bpy.types.Event) -> set[str]:
        obj = context.view_layer.objects.active
        self.location, self.on_graph = obj.matrix_world @ Vector(target.location), target.on_graph
        self.report({"INFO"}, cut_at(context, obj, self.model, target))
        return {"FINISHED"}
