# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph as a handle: select a node, and the list chooses its part."""

import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import edit, overlay, parts, store
from .problems import SceneError


def part_of(item):
    """The decomposed object and the part's number that an object of a graph stands for, or None."""
    if item is None or item.get(overlay.ROLE) != "node" or item.parent is None:
        return None
    source = item.parent
    if source.type != "MESH" or not store.has_result(source.data):
        return None
    return source, item["part"]


def choose(source, numbers):
    """Mark parts in the list of an object; the first becomes the active one."""
    result = source.data.reeb_parts
    with store.quiet():
        for index, part in enumerate(result.parts):
            part.selected = part.number in numbers and len(numbers) > 1
            if part.number == numbers[0]:
                result.active = index


class REEB_PARTS_OT_from_nodes(bpy.types.Operator):
    """Choose the parts of the selected nodes in the list, and make their object active"""

    bl_idname = "reeb_parts.from_nodes"
    bl_label = "Parts of Selected Nodes"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if part_of(context.view_layer.objects.active) is None:
            cls.poll_message_set("Select a node of a graph")
            return False
        return True

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


class REEB_PARTS_OT_to_nodes(bpy.types.Operator):
    """Select the nodes of the chosen parts"""

    bl_idname = "reeb_parts.to_nodes"
    bl_label = "Nodes of Chosen Parts"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = context.view_layer.objects.active
        if obj is None or obj.mode != "OBJECT" or overlay.find(obj) is None:
            cls.poll_message_set("The active object shows no graph")
            return False
        return True

    def execute(self, context):
        obj = context.view_layer.objects.active
        numbers = parts.chosen_numbers(obj.data)
        for item in overlay.find(obj).objects:
            if item.get(overlay.ROLE) == "node":
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
            cls.poll_message_set("Select a node of a graph")
            return False
        if item.parent.mode != "OBJECT":
            cls.poll_message_set("Leave the object's mode first")
            return False
        return True

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
        self.report({"INFO"}, f"{name(item.parent.data, new)} was cut from {name(item.parent.data, number)}")
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
    from ..core.editing import node_split

    stored = store.load(obj.data)
    decomposition = stored.decomposition
    number = int(stored.shown[decomposition.node_candidate[node]])
    edit.check_unlocked(obj, [number])
    mask = stored.shown == number
    side = node_split(decomposition, mask, node)
    if side is None:
        raise SceneError(
            f"No cut was found inside {store.part_name(obj.data, number)}. Select faces in Edit Mode and "
            "assign them to another part instead."
        )
    area = decomposition.candidate_area
    if area[side].sum() > area[mask & ~side].sum():
        side = mask & ~side
    new = edit.free_number(obj.data, stored)
    edit.tie(context, obj, stored, np.where(side, new, stored.shown), [number, new])
    return number, new


CLASSES = (REEB_PARTS_OT_from_nodes, REEB_PARTS_OT_to_nodes, REEB_PARTS_OT_split_at_node)

_owner = object()


def _follow_active():
    """The active object changed: if it is a node, the list of its object follows."""
    item = bpy.context.view_layer.objects.active if bpy.context.view_layer else None
    found = part_of(item)
    if found is not None and item.select_get():
        choose(found[0], [found[1]])


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
