# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose parts by clicking on the model or on the graph."""

import re

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import redraw, store
from ..scene.errors import SceneError
from ..scene.reporting import PartOperator
from ..scene.result import part_names
from ..scene.result.part_list import active_number, choose, make_active, mark_numbers, toggle
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
    # What several clicks have chosen in the end; which part is seen at a place, another view may not tell.
    number: bpy.props.IntProperty(
        name="Part", min=0, options={"SKIP_SAVE"},
        description="Number of the part that becomes the active one; 0 for the part at the location",
    )
    marked: bpy.props.StringProperty(
        name="Marked", options={"SKIP_SAVE"},
        description="With a number of a part: numbers of the parts that are marked, separated by commas",
    )

    def draw(self, context: bpy.types.Context) -> None:
        """The redo panel: what decides."""
        self.layout.use_property_split = True
        for name in ("number", "marked") if self.number else ("location", "extend"):
            self.layout.prop(self, name)

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        if self.number:
            self._choose_again(obj.data)
            return
        model = pointing.Model(obj)
        self._choose(obj, model.number(model.at(obj, self.location, False)), self.extend)

    def _choose_again(self, mesh: bpy.types.Mesh) -> None:
        """Choose what was chosen when the clicks were over."""
        marked = [int(number) for number in re.findall(r"\d+", self.marked)]
        known = {part.number for part in mesh.reeb_parts.parts}
        for number in (self.number, *marked):
            if number not in known:
                raise SceneError(rpt_("There is no part with the number {number}.").format(number=number))
        mark_numbers(mesh, marked)
        make_active(mesh, self.number)

    def hint(self) -> str:
        return rpt_("Click a part or the graph to choose it    Shift: several    Enter, Esc: end")

    def hover(self, context: bpy.types.Context, target: Target | None, event: bpy.types.Event) -> None:
        text = self.hint()
        if target is not None:
            mesh = context.view_layer.objects.active.data
            text = f"{part_names.part_name(mesh, self.model.number(target))}    {text}"
        context.workspace.status_text_set(text)

    def press(self, context: bpy.types.Context, target: Target, event: bpy.types.Event) -> None:
        self._choose(context.view_layer.objects.active, self.model.number(target), event.shift)
        redraw.viewports()

    def confirm(self, context: bpy.types.Context) -> set[str]:
        """Note what is chosen, for the panel of what was done last and for Repeat Last."""
        obj = context.view_layer.objects.active
        if store.has_parts(obj):
            self.number = active_number(obj.data)
            self.marked = ", ".join(str(part.number) for part in obj.data.reeb_parts.parts if part.selected)
        return {"FINISHED"}

    def give_up(self, context: bpy.types.Context) -> set[str]:
        # What was chosen is chosen, and can be undone.
        return self.confirm(context)

    def _choose(self, obj: bpy.types.Object, number: int, extend: bool) -> None:
        if extend:
            toggle(obj.data, number)
        else:
            choose(obj.data, [number])
