# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose parts by clicking on the model or on the graph."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Vector

from ..scene import redraw
from ..scene.reporting import PartOperator
from ..scene.result import part_names
from ..scene.result.part_list import choose, toggle
from ..scene.store import Stored
from ..viewport import pointing
from ..viewport.modal.view_tool import ViewTool
from ..viewport.pointing import Target


class REEB_PARTS_OT_pick(ViewTool, PartOperator, bpy.types.Operator):
    """Choose parts by clicking on the model or its graph; Shift chooses several"""

    bl_idname = "reeb_parts.pick"
    bl_label = "Pick Parts"

    location: bpy.props.FloatVectorProperty(
        name="Location", size=3, subtype="XYZ", description="A place on or beside the part, in the world",
    )
    extend: bpy.props.BoolProperty(
        name="Extend", description="Add the part to those that are chosen, or take it away again",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        model = pointing.Model(obj)
        self._choose(obj, model.number(model.at(obj, self.location, False)), self.extend)

    def hint(self) -> str:
        return rpt_("Click a part or the graph to choose it    Shift: several    Enter, Esc: end")

    def hover(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        text = self.hint()
        if target is not None:
            mesh = context.view_layer.objects.active.data
            text = f"{part_names.part_name(mesh, self.model.number(target))}    {text}"
        context.workspace.status_text_set(text)

    def press(self, context: bpy.types.Context, target: Target, event: bpy.types.Event) -> None:
        obj = context.view_layer.objects.active
        self.location, self.extend = obj.matrix_world @ Vector(target.location), event.shift
        self._choose(obj, self.model.number(target), event.shift)
        redraw.viewports()

    def give_up(self, context: bpy.types.Context) -> set[str]:
        # What was chosen is chosen, and can be undone.
        return {"FINISHED"}

    def _choose(self, obj: bpy.types.Object, number: int, extend: bool) -> None:
        if extend:
            toggle(obj.data, number)
        else:
            choose(obj.data, [number])
