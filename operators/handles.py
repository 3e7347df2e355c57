# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph as a handle: select a node, and the list chooses its part."""

import bpy
from bpy.app.handlers import persistent

from . import overlay, parts, store


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


CLASSES = (REEB_PARTS_OT_from_nodes, REEB_PARTS_OT_to_nodes)

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
