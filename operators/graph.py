# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph as a handle: select a node or an arc, and the list chooses its part."""

import bpy
import numpy as np
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Vector

from ..scene import graph_objects, store
from ..scene.errors import SceneError
from ..viewport import pointing
from . import edit, parts
from .parts import choose


def part_of(item):
    """The decomposed object and the part's number that an object of a graph stands for, or None."""
    if item is None or item.get(graph_objects.ROLE) != "node" or item.parent is None:
        return None
    source = item.parent
    if source.type != "MESH" or not store.has_result(source.data):
        return None
    return source, item["part"]


def source_of_arcs(item):
    """The decomposed object that a curve of arcs stands for, or None."""
    if item is None or item.get(graph_objects.ROLE) != "arcs" or item.parent is None or item.parent.type != "MESH":
        return None
    return item.parent if store.has_result(item.parent.data) else None


class REEB_PARTS_OT_from_nodes(bpy.types.Operator):
    """Choose the parts of the selected nodes in the list, and make their object active"""

    bl_idname = "reeb_parts.from_nodes"
    bl_label = "Parts of Selected Nodes"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        found = part_of(context.view_layer.objects.active)
        if found is None:
            cls.poll_message_set(rpt_("Select a node of a graph"))
            return False
        return parts.has_parts(cls, context, found[0])

    def execute(self, context):
        source, number = part_of(context.view_layer.objects.active)
        chosen = {number: None}
        for item in context.view_layer.objects.selected:
            found = part_of(item)
            if found and found[0] == source:
                chosen[found[1]] = None
        choose(source, list(chosen))
        for item in list(context.view_layer.objects.selected):
            item.select_set(False)
        source.select_set(True)
        context.view_layer.objects.active = source
        return {"FINISHED"}


class REEB_PARTS_OT_from_arc(bpy.types.Operator):
    """Choose the part in which an arc was clicked, and make its object active"""

    bl_idname = "reeb_parts.from_arc"
    bl_label = "Part of Arc"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    location: bpy.props.FloatVectorProperty(
        name="Location", size=3, subtype="XYZ", description="A place on or beside the arc, in the world",
    )

    @classmethod
    def poll(cls, context):
        source = source_of_arcs(context.view_layer.objects.active)
        if source is None or context.mode != "OBJECT":
            cls.poll_message_set(rpt_("Select the arcs of a graph"))
            return False
        return parts.has_parts(cls, context, source)

    def invoke(self, context, event):
        """Blender has just selected the curve, by the last press of a button; the pointer may have gone on."""
        source = source_of_arcs(context.view_layer.objects.active)
        pressed = event.mouse_prev_press_x, event.mouse_prev_press_y
        place = pointing.view_region(context.area, *pressed) if context.area else None
        if place is None:  # it was selected elsewhere, in the outliner
            return {"CANCELLED"}
        try:
            target = pointing.Model(source).under(context, source, *place, surface=False)
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if target is None:
            return {"CANCELLED"}
        self.location = source.matrix_world @ Vector(target.location)
        return self.execute(context)

    def execute(self, context):
        item = context.view_layer.objects.active
        source = source_of_arcs(item)
        try:
            model = pointing.Model(source)
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        choose(source, [model.number(model.at(source, self.location, True))])
        item.select_set(False)
        source.select_set(True)
        context.view_layer.objects.active = source
        return {"FINISHED"}


class REEB_PARTS_OT_to_nodes(bpy.types.Operator):
    """Select the nodes of the chosen parts"""

    bl_idname = "reeb_parts.to_nodes"
    bl_label = "Nodes of Chosen Parts"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = context.view_layer.objects.active
        if not parts.has_parts(cls, context):
            return False
        if obj.mode != "OBJECT":
            cls.poll_message_set(rpt_("Go to Object Mode first"))
            return False
        if graph_objects.find(obj) is None:
            cls.poll_message_set(rpt_("The active object shows no graph"))
            return False
        return True

    def execute(self, context):
        obj = context.view_layer.objects.active
        numbers = parts.chosen_numbers(obj.data)
        for item in graph_objects.find(obj).objects:
            if item.get(graph_objects.ROLE) == "node":
                item.select_set(item["part"] in numbers)
        return {"FINISHED"}


class REEB_PARTS_OT_split_at_node(bpy.types.Operator):
    """Split the part that holds the selected node, at the best cut along the node's arcs"""

    bl_idname = "reeb_parts.split_at_node"
    bl_label = "Split at Graph Node"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        item = context.view_layer.objects.active
        if part_of(item) is None:
            cls.poll_message_set(rpt_("Select a node of a graph"))
            return False
        if item.parent.mode != "OBJECT":
            cls.poll_message_set(rpt_("Leave the object's mode first"))
            return False
        return parts.has_parts(cls, context, item.parent)

    def execute(self, context):
        item = context.view_layer.objects.active
        try:
            number, new = split_at_node(context, item.parent, item["node"])
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        # The node's part is the one to go on with.
        choose(item.parent, [item["part"]])
        name = store.part_name
        self.report({"INFO"}, rpt_("{new} was cut from {name}").format(
            new=name(item.parent.data, new), name=name(item.parent.data, number)))
        return {"FINISHED"}


def split_at_node(context, obj, node):
    """Split the part that holds a node; the smaller side becomes a new part.

    Returns
    -------
    number, new : int
        The part that was split, and the new one.

    Raises
    ------
    SceneError
        The part is locked, cannot be split, or the mesh was edited.
    """
    from ..core.result.editing import node_split

    stored = store.load(obj.data)
    decomposition = stored.decomposition
    number = int(stored.shown[decomposition.node_candidate[node]])
    edit.check_unlocked(obj, [number])
    mask = stored.shown == number
    side = node_split(decomposition, mask, node)
    if side is None:
        raise SceneError(
            rpt_("No cut was found inside {name}. Select faces in Edit Mode and assign them to another "
                 "part instead.").format(name=store.part_name(obj.data, number))
        )
    area = decomposition.candidate_area
    if area[side].sum() > area[mask & ~side].sum():
        side = mask & ~side
    new = edit.free_number(obj.data, stored)
    edit.tie(context, obj, stored, np.where(side, new, stored.shown), [number, new])
    return number, new


CLASSES = (
    REEB_PARTS_OT_from_nodes,
    REEB_PARTS_OT_from_arc,
    REEB_PARTS_OT_to_nodes,
    REEB_PARTS_OT_split_at_node,
)

_owner = object()


def _follow_active():
    """The active object changed: if it belongs to a graph, the list of its object follows."""
    item = bpy.context.view_layer.objects.active if bpy.context.view_layer else None
    found = part_of(item)
    if found is not None and item.select_get() and found[0].data.is_editable:
        choose(found[0], [found[1]])
    elif source_of_arcs(item) is not None and item.select_get() and not bpy.app.background:
        # Not within Blender's own click, which has yet to become a step of undo.
        bpy.app.timers.register(_ask_pointer, first_interval=0.0)


def _ask_pointer():
    """Which arc it was, only the pointer knows, by where its button was pressed."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type != "VIEW_3D":
                continue
            region = next(region for region in area.regions if region.type == "WINDOW")
            with bpy.context.temp_override(window=window, area=area, region=region):
                operator = bpy.ops.reeb_parts.from_arc
                if operator.poll() and "FINISHED" in operator("INVOKE_DEFAULT", True):
                    return


@persistent
def _subscribe(*_):
    # Subscriptions do not outlive the file.
    bpy.msgbus.subscribe_rna(
        key=(bpy.types.LayerObjects, "active"), owner=_owner, args=(), notify=_follow_active
    )


def register():
    _subscribe()
    bpy.app.handlers.load_post.append(_subscribe)


def unregister():
    bpy.app.handlers.load_post.remove(_subscribe)
    bpy.msgbus.clear_by_owner(_owner)
    if bpy.app.timers.is_registered(_ask_pointer):
        bpy.app.timers.unregister(_ask_pointer)
