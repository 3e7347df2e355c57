# SPDX-License-Identifier: GPL-3.0-or-later
"""Work on the parts of the list: select, isolate."""

import bmesh
import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..scene import store, targets
from ..scene.errors import SceneError
from ..scene.modes import object_mode


def has_parts(cls, context, obj=None):
    """Whether an object's parts, else the active one's, can be worked on; explains itself."""
    obj = obj or context.view_layer.objects.active
    if obj is None or obj.type != "MESH" or not store.has_result(obj.data):
        cls.poll_message_set(rpt_("Decompose the mesh first"))
        return False
    try:
        targets.check_object(obj)
    except SceneError as error:
        cls.poll_message_set(str(error))
        return False
    return True


def chosen_numbers(mesh) -> list[int]:
    """Numbers of the parts marked in the list, or of the active one."""
    result = mesh.reeb_parts
    marked = [part.number for part in result.parts if part.selected]
    return marked or [part.number for part in result.parts[result.active : result.active + 1]]


def choose(source, numbers):
    """Mark parts in the list of an object; the first becomes the active one."""
    result = source.data.reeb_parts
    with store.quiet():
        for index, part in enumerate(result.parts):
            part.selected = part.number in numbers and len(numbers) > 1
            if part.number == numbers[0]:
                result.active = index


def make_active(mesh, number):
    """Make a part the active one of the list, which scrolls to it; no mark changes."""
    with store.quiet():
        for index, part in enumerate(mesh.reeb_parts.parts):
            if part.number == number:
                mesh.reeb_parts.active = index


def toggle(source, number):
    """Mark one part more, or one part less; it becomes the active one."""
    result = source.data.reeb_parts
    with store.quiet():
        if not any(part.selected for part in result.parts):
            result.parts[result.active].selected = True
        for index, part in enumerate(result.parts):
            if part.number == number:
                part.selected = not part.selected
                result.active = index


def select_faces(mesh, mask, mode="SET"):
    """Select faces with their edges and vertices, and nothing else; Object Mode.

    mask : (p,) bool. mode : "SET", "ADD" or "SUBTRACT".
    """
    if mode != "SET":
        now = np.empty(len(mask), bool)
        mesh.polygons.foreach_get("select", now)
        mask = (now | mask) if mode == "ADD" else (now & ~mask)
    edge = np.empty(len(mesh.loops), np.int32)
    vertex = np.empty(len(mesh.loops), np.int32)
    total = np.empty(len(mesh.polygons), np.int32)
    mesh.loops.foreach_get("edge_index", edge)
    mesh.loops.foreach_get("vertex_index", vertex)
    mesh.polygons.foreach_get("loop_total", total)
    corner = np.repeat(mask, total)
    for items, index in ((mesh.edges, edge), (mesh.vertices, vertex)):
        flags = np.zeros(len(items), bool)
        flags[index[corner]] = True
        items.foreach_set("select", flags)
    mesh.polygons.foreach_set("select", mask)
    mesh.update()


class PartOperator:
    """For operators on the parts of the active object: poll, errors, Object Mode."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return has_parts(cls, context)

    def execute(self, context):
        obj = context.view_layer.objects.active
        try:
            with object_mode(context):
                message = self.work(context, obj, store.load(obj.data))
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if message:
            self.report({"INFO"}, message)
        return {"FINISHED"}


class REEB_PARTS_OT_select(PartOperator, bpy.types.Operator):
    """Select the faces of the parts chosen in the list, for Edit Mode"""

    bl_idname = "reeb_parts.select"
    bl_label = "Select Faces of Parts"

    action: bpy.props.EnumProperty(
        name="Action",
        items=[("SET", "Set", "Select these faces and no others"),
               ("ADD", "Extend", "Add these faces to the selection"),
               ("SUBTRACT", "Subtract", "Take these faces from the selection")],
    )
    number: bpy.props.IntProperty(
        name="Part", default=0, min=0, options={"SKIP_SAVE"},
        description="Number of the part; 0 for those chosen in the list",
    )

    def work(self, context, obj, stored):
        numbers = [self.number] if self.number else chosen_numbers(obj.data)
        mask = np.isin(stored.shown[stored.decomposition.candidates], numbers)
        if not mask.any():
            raise SceneError(rpt_("There is no part with the number {number}.").format(number=self.number))
        if context.mode == "OBJECT":
            select_faces(obj.data, mask, self.action)


class REEB_PARTS_OT_isolate(PartOperator, bpy.types.Operator):
    """Hide all faces but those of the chosen parts, or show all again"""

    bl_idname = "reeb_parts.isolate"
    bl_label = "Isolate Parts"

    show_all: bpy.props.BoolProperty(name="Show all", description="Show every face again")

    def execute(self, context):
        seen = self.show_all or context.mode != "OBJECT"
        result = super().execute(context)
        if "FINISHED" in result and not seen:
            self.report({"INFO"}, rpt_("Object Mode shows hidden faces all the same; Edit Mode and paint modes do not"))
        return result

    def work(self, context, obj, stored):
        mesh = obj.data
        numbers = stored.shown[stored.decomposition.candidates]
        shown = np.full(len(numbers), True) if self.show_all else np.isin(numbers, chosen_numbers(mesh))
        hide_faces(mesh, ~shown)


def hide_faces(mesh, mask):
    """Hide faces, and the edges and vertices of no other face; Object Mode. mask : (p,) bool."""
    edge = np.empty(len(mesh.loops), np.int32)
    vertex = np.empty(len(mesh.loops), np.int32)
    total = np.empty(len(mesh.polygons), np.int32)
    mesh.loops.foreach_get("edge_index", edge)
    mesh.loops.foreach_get("vertex_index", vertex)
    mesh.polygons.foreach_get("loop_total", total)
    corner = np.repeat(~mask, total)
    for items, index in ((mesh.edges, edge), (mesh.vertices, vertex)):
        hidden = np.full(len(items), bool(mask.any()))
        hidden[index[corner]] = False
        items.foreach_set("hide", hidden)
    mesh.polygons.foreach_set("hide", mask)
    mesh.update()


class REEB_PARTS_OT_mark(bpy.types.Operator):
    """Mark parts in the list"""

    bl_idname = "reeb_parts.mark"
    bl_label = "Mark Parts"
    bl_options = {"REGISTER", "UNDO"}

    action: bpy.props.EnumProperty(
        name="Action",
        items=[("ALL", "All", "Mark every part"), ("NONE", "None", "Mark no part"),
               ("INVERT", "Invert", "Mark the parts that are not marked"),
               ("SMALL", "Smaller", "Mark the parts smaller than the active one"),
               ("FACES", "Of selected faces", "Mark the parts that have selected faces")],
    )

    @classmethod
    def poll(cls, context):
        return has_parts(cls, context)

    def execute(self, context):
        obj = context.view_layer.objects.active
        result = obj.data.reeb_parts
        share = result.parts[result.active].share
        try:
            faces = _numbers_of_selected_faces(context, obj) if self.action == "FACES" else ()
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for part in result.parts:
            part.selected = {
                "ALL": True, "NONE": False, "INVERT": not part.selected,
                "SMALL": part.share < share, "FACES": part.number in faces,
            }[self.action]
        return {"FINISHED"}


def _numbers_of_selected_faces(context, obj):
    with object_mode(context):
        stored = store.load(obj.data)
        chosen = np.empty(len(obj.data.polygons), bool)
        obj.data.polygons.foreach_get("select", chosen)
        return set(stored.shown[stored.decomposition.candidates[chosen]].tolist())


def pick(result, context):
    """A part was clicked in the list: it alone is chosen, and in Edit Mode its faces are selected."""
    mesh = result.id_data
    if store.is_quiet() or result.active >= len(result.parts):
        return
    for part in result.parts:
        part.selected = False
    if not mesh.is_editmode:
        return
    number = result.parts[result.active].number
    edit = bmesh.from_edit_mesh(mesh)
    layer = edit.faces.layers.int.get(result.face_attribute)
    if layer is None:
        return
    # The edit mesh cannot be written in bulk.
    for item in (*edit.verts, *edit.edges):
        item.select = False
    for face in edit.faces:
        face.select_set(face[layer] == number and not face.hide)
    edit.select_flush_mode()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


CLASSES = (REEB_PARTS_OT_select, REEB_PARTS_OT_isolate, REEB_PARTS_OT_mark)
