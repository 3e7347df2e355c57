# SPDX-License-Identifier: GPL-3.0-or-later
"""Modifiers of ours, given to an object and taken off it, so that it can be taken back; see transaction."""

from __future__ import annotations

import bpy

from .. import transaction
from . import made_objects


def new(obj: bpy.types.Object, name: str, kind: str) -> bpy.types.Modifier:
    """A new modifier, the last of the object."""
    transaction.on_failure(_cut, obj, len(obj.modifiers))
    return obj.modifiers.new(name, kind)


def remove(obj: bpy.types.Object, modifier: bpy.types.Modifier) -> None:
    """Take a modifier off an object, at the end if the object is not a new one."""
    if transaction.is_new(obj):
        obj.modifiers.remove(modifier)
    else:
        transaction.at_end(obj.modifiers.remove, modifier)


def only_shades(modifier: bpy.types.Modifier) -> bool:
    """Whether a modifier leaves the shape as it is, as that of Blender's Shade Auto Smooth does."""
    nodes = modifier.node_group if modifier.type == "NODES" else None
    return nodes is not None and nodes.name.startswith("Smooth by Angle")


def find_nodes(obj: bpy.types.Object, ours: str) -> bpy.types.NodesModifier | None:
    """The modifier on an object whose node group is marked by a property of that name, or None."""
    return next((modifier for modifier in obj.modifiers
                 if modifier.type == "NODES" and modifier.node_group and ours in modifier.node_group), None)


def remove_nodes(obj: bpy.types.Object, ours: str) -> None:
    """Take such a modifier off an object, if there is one, and its nodes away if nothing else uses them."""
    modifier = find_nodes(obj, ours)
    if modifier is not None:
        group = modifier.node_group
        unused = group.users == 1
        remove(obj, modifier)
        if unused:
            _give_up_nodes(group, ours)


def set_nodes(modifier: bpy.types.NodesModifier, group: bpy.types.NodeTree, ours: str) -> None:
    """Give such a modifier other nodes; those that it has go if nothing else uses them."""
    former = modifier.node_group
    transaction.keep(modifier, "node_group")
    modifier.node_group = group
    if former is not None and not former.users:
        _give_up_nodes(former, ours)


def _give_up_nodes(group: bpy.types.NodeTree, ours: str) -> None:
    """Remove nodes of such a modifier that nothing uses any more; those that the user has changed stay in the file."""
    if group[ours] in (True, _told(group)):  # earlier versions kept nothing
        transaction.discard(group)
        return
    transaction.keep(group, "use_fake_user")
    group.use_fake_user = True
    made_objects.hand_over(group, ours)


def mark_nodes(group: bpy.types.NodeTree, ours: str) -> None:
    """Remember what nodes of such a modifier are like, now that they are made."""
    group[ours] = _told(group)


def _told(group: bpy.types.NodeTree) -> str:
    """Differs once nodes are others, or linked otherwise."""
    return str([sorted((node.name, node.bl_idname, node.mute) for node in group.nodes),
                sorted((link.from_socket.path_from_id(), link.to_socket.path_from_id()) for link in group.links)])


def new_nodes(name: str, ours: str) -> bpy.types.NodeTree:
    """A node group for such a modifier, marked as that: geometry comes in and goes out."""
    group = bpy.data.node_groups.new(name, "GeometryNodeTree")
    group[ours] = True
    group.is_modifier = True
    for way in ("INPUT", "OUTPUT"):
        group.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    return group


def _cut(obj: bpy.types.Object, count: int) -> None:
    """Remove the modifiers that are more than so many."""
    while len(obj.modifiers) > count:
        obj.modifiers.remove(obj.modifiers[-1])
