# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tool of the toolbar does that nothing else does: a box around parts, a name at the pointer."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import property_updates, redraw, transaction
from ..scene.changes import reactions
from ..scene.errors import SceneError
from ..scene.reporting import PartOperator, ReportingOperator
from ..scene.result import part_list
from ..scene.store import Stored
from ..viewport import hover, pointing
from ..viewport.modal.box import Frame, parts_in_box


class REEB_PARTS_OT_choose(ReportingOperator, bpy.types.Operator):
    """Choose the part that you click, or all parts that are seen in a box that you drag; beside parts, other objects"""

    bl_idname = "reeb_parts.choose"
    bl_label = "Choose Parts"
    bl_options = {"INTERNAL"}  # Blender's own way to select an object makes its own step of undo

    mode: bpy.props.EnumProperty(
        name="Action", translation_context="Reeb Parts",
        items=[("SET", "Set", "Choose these parts and no others"),
               ("ADD", "Extend", "Add parts to those that are chosen; a click takes one away again"),
               ("SUB", "Subtract", "Take parts from those that are chosen")],
    )

    def run(self, context: bpy.types.Context) -> None:
        raise SceneError(rpt_("This works over a 3D viewport."))

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.start = np.array([event.mouse_region_x, event.mouse_region_y])
        self.frame: Frame | None = None  # until it is a drag
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            corners = self.frame.corners if self.frame is not None else None
            self.cancel(context)
            result = self.attempt(self._choose, context, corners)
            if result == {"FINISHED"}:
                bpy.ops.ed.undo_push(message=rpt_("Choose Parts", "Operator"))
            return result
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self.cancel(context)
            return {"CANCELLED"}
        if event.type == "MOUSEMOVE":
            self._drag(context, np.array([event.mouse_region_x, event.mouse_region_y]))
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        if self.frame is not None:
            self.frame.remove()
        redraw.viewports()

    def _drag(self, context: bpy.types.Context, place: np.ndarray) -> None:
        preferences = context.preferences
        reach = preferences.inputs.drag_threshold_mouse * preferences.system.ui_scale
        if self.frame is None and np.abs(place - self.start).max() > reach:
            self.frame = Frame(context.region, tuple(self.start.tolist()))
        if self.frame is not None:
            self.frame.end = tuple(place.tolist())
            context.region.tag_redraw()

    def _choose(self, context: bpy.types.Context, corners: tuple | None) -> set[str] | None:
        obj, place = context.view_layer.objects.active, tuple(self.start.tolist())
        model = pointing.model_of(obj)
        if corners is not None:
            part_list.choose_more(obj.data, parts_in_box(context, obj, model, context.region, *corners), self.mode)
        elif (target := model.under(context, obj, context.region, place)) is None:
            # Where there is no object either, nothing is deselected.
            bpy.ops.view3d.select("EXEC_DEFAULT", True, location=place, toggle=self.mode != "SET")
            return {"CANCELLED"}
        elif self.mode == "ADD":
            part_list.toggle(obj.data, model.number(target))
        else:
            part_list.choose_more(obj.data, [model.number(target)], self.mode)
        obj.select_set(True)  # so that its parts are outlined
        return None


class REEB_PARTS_OT_rename(PartOperator, bpy.types.Operator):
    """Give another name to the part under the pointer, or else to the active one"""

    bl_idname = "reeb_parts.rename"
    bl_label = "Rename Part"

    new_name: bpy.props.StringProperty(
        name="Name", options={"SKIP_SAVE"}, description="The new name of the active part",
    )

    def work(self, context: bpy.types.Context, obj: bpy.types.Object, stored: Stored) -> None:
        if not self.new_name.strip():
            raise SceneError(rpt_("A part needs a name."))
        number = part_list.active_number(obj.data)
        part = next(entry for entry in obj.data.reeb_parts.parts if entry.number == number)
        transaction.keep_result(obj.data)
        with property_updates.quiet():
            part.name = self.new_name.strip()
        reactions.take_new_name(part, context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self.attempt(self._ask, context)

    def _ask(self, context: bpy.types.Context) -> set[str]:
        """Open the field for the name; what is typed there makes the step of undo."""
        mesh = context.view_layer.objects.active.data
        number = hover.number(context.view_layer.objects.active)
        if number and number != part_list.active_number(mesh):
            part_list.make_active(mesh, number)
        return bpy.ops.wm.call_panel("INVOKE_DEFAULT", name="REEB_PARTS_PT_rename", keep_open=False)


class REEB_PARTS_OT_no_key(ReportingOperator, bpy.types.Operator):
    """Say that a key which would move or delete the object does nothing while the tool is the active one"""

    bl_idname = "reeb_parts.no_key"
    bl_label = "Keep Object"
    bl_options = {"INTERNAL"}

    def run(self, context: bpy.types.Context) -> None:
        self.report({"INFO"}, rpt_("This key does nothing to parts. Choose another tool to move or delete the object."))
