# SPDX-License-Identifier: GPL-3.0-or-later
"""Explode: the parts drift apart in the view; the mesh itself stays as it is.

A modifier of ours moves the faces of each part away from the middle of the whole. How far is a property of
the object, which drives a value in the modifier's nodes: so it can be dragged, typed and animated.
"""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from .. import outputs, property_updates, store, targets, transaction
from ..changes.settled import reaction
from ..errors import SceneError
from ..graph import graph_follow
from ..ours import modifiers
from ..outputs import face_attribute

NAME = "Reeb Parts Explode"
PROPERTY = "reeb_parts_made.explode"
OURS = "reeb_parts_explode"  # on the node group


def find(obj: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """Our modifier on an object, or None."""
    return modifiers.find_nodes(obj, OURS)


@reaction
def changed(made: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """The slider was moved: the modifier is there while there is something for it to do."""
    obj = made.id_data
    _leave_copies(obj)
    if made.explode or _is_animated(obj):
        _ensure(obj)
    else:
        modifiers.remove_nodes(obj, OURS)
    graph_follow.soon(obj)  # what evaluates the object first may be a tool, of which no handler is told


def _is_animated(obj: bpy.types.Object) -> bool:
    """Whether the slider may be moved by an action, or is by a driver."""
    return _is_driven(obj) or bool(obj.animation_data and obj.animation_data.action)


def _is_driven(obj: bpy.types.Object) -> bool:
    """Whether a driver moves the slider."""
    return bool(obj.animation_data) and obj.animation_data.drivers.find(PROPERTY) is not None


def waits(obj: bpy.types.Object) -> bool:
    """Whether a driver moves the slider of an object with parts, and there is no modifier that would heed it.

    Blender tells of a property that is changed by hand or a script, and not of one that a driver changes.
    """
    return _is_driven(obj) and obj.is_editable and obj.mode != "EDIT" and store.has_parts(obj) and find(obj) is None


def begin(obj: bpy.types.Object) -> None:
    """Give an object that ``waits`` its modifier."""
    _ensure(obj)
    graph_follow.soon(obj)


def _leave_copies(obj: bpy.types.Object) -> None:
    """Let copies of an object, which came with its nodes, listen to their own sliders: they would follow that of it."""
    modifier = find(obj)
    if modifier is None or modifier.node_group.users < 2:
        return
    for other in bpy.data.objects:
        copied = find(other) if other != obj and other.is_editable else None
        if copied is not None and copied.node_group == modifier.node_group:
            _ensure(other)


def settle(obj: bpy.types.Object) -> None:
    """Set the slider back to 0 where the modifier was applied or removed: it moves nothing then."""
    if not obj.is_property_set("reeb_parts_made"):  # to read it would set it
        return
    made = obj.reeb_parts_made
    if made.explode and find(obj) is None:
        transaction.keep(made, "explode")
        with property_updates.quiet():
            made.explode = 0.0


def forget(obj: bpy.types.Object) -> None:
    """Take the modifier away and forget what was made of the object; pieces are the user's from now on."""
    modifiers.remove_nodes(obj, OURS)
    transaction.unset_group(obj, "reeb_parts_made")


def _ensure(obj: bpy.types.Object) -> None:
    """Put the modifier last, for the parts as they are now."""
    if not store.has_parts(obj):
        return
    name = _face_attribute(obj)
    modifier = find(obj) or modifiers.new(obj, NAME, "NODES")
    group = modifier.node_group
    if group is None or _source(group) != obj or "Part" not in group.nodes:
        # A copy of the object comes with the group of the original, which listens to the original; and the user may
        # have renamed nodes, or removed some.
        group = _node_group(obj)
        modifiers.set_nodes(modifier, group, OURS)
    for node in (group.nodes["Part"], group.nodes.get("Number")):
        if node is not None:  # files of before have no such node
            socket = node.inputs["Name"]
            transaction.keep(socket, "default_value")
            socket.default_value = name


def _face_attribute(obj: bpy.types.Object) -> str:
    """Name of the attribute with the part numbers; made unless it is there."""
    result = obj.data.reeb_parts
    if face_attribute.find(obj.data) is None:
        try:
            numbered = store.load(obj.data).shown_parts()
        except SceneError:  # the mesh was edited: the panel says so
            return ""
        with property_updates.quiet():
            face_attribute.add(obj)
            outputs.update_outputs(targets.users(obj.data)[0], numbered, numbered.candidate_numbers)
    return result.face_attribute


def _node_group(obj: bpy.types.Object) -> bpy.types.NodeTree:
    """Nodes that move each part from the middle of the whole by a multiple of its distance from there."""
    group = modifiers.new_nodes(f"{NAME} {obj.name}", OURS)
    made = _Nodes(group)
    start, end = made.new("NodeGroupInput"), made.new("NodeGroupOutput")
    part = made.new("GeometryNodeInputNamedAttribute", "Part", data_type="INT")
    amount = made.new("ShaderNodeValue", "Amount")
    numbered = _with_all_numbered(made, start.outputs[0], part.outputs[0])
    # Areas as weights, so that dense stretches do not draw the middle towards them.
    area = made.new("GeometryNodeInputMeshFaceArea").outputs[0]
    moment = made.math("SCALE", made.new("GeometryNodeInputPosition").outputs[0], area)
    offset = made.math("SUBTRACT", made.middle(moment, area, part.outputs[0]), made.middle(moment, area))
    edges = made.new("GeometryNodeMeshFaceSetBoundaries", inputs=[part.outputs[0]])
    split = made.new("GeometryNodeSplitEdges", inputs=[numbered, edges.outputs[0]])
    move = made.new("GeometryNodeSetPosition", inputs=[split.outputs[0]])
    made.link(made.math("SCALE", offset, amount.outputs[0]), move.inputs["Offset"])
    made.link(move.outputs[0], end.inputs[0])
    _drive(amount.outputs[0], obj)
    modifiers.mark_nodes(group, OURS)
    return group


def _with_all_numbered(made: _Nodes, geometry: bpy.types.NodeSocket, part: bpy.types.NodeSocket
                       ) -> bpy.types.NodeSocket:
    """Nodes that give faces without a number, which a Boolean modifier adds, that of the nearest face with one."""
    has_none = made.new("FunctionNodeCompare", data_type="INT", operation="EQUAL")
    made.link(part, next(socket for socket in has_none.inputs if socket.type == "INT"))  # the other one is 0
    others = made.new("GeometryNodeSeparateGeometry", domain="FACE", inputs=[geometry, has_none.outputs[0]])
    nearest = made.new("GeometryNodeSampleNearest", domain="FACE", inputs=[others.outputs["Inverted"]])
    number = made.new("GeometryNodeSampleIndex", data_type="INT", domain="FACE", inputs=[others.outputs["Inverted"]])
    made.link(part, next(socket for socket in number.inputs if socket.name == "Value" and socket.enabled))
    made.link(nearest.outputs[0], number.inputs["Index"])
    # Written, and only where it is missing: so the nearest are not looked for on meshes whose faces all have numbers.
    written = made.new("GeometryNodeStoreNamedAttribute", "Number", data_type="INT", domain="FACE", inputs=[geometry])
    made.link(has_none.outputs[0], written.inputs["Selection"])
    made.link(next(socket for socket in number.outputs if socket.enabled),
              next(socket for socket in written.inputs if socket.name == "Value" and socket.enabled))
    return written.outputs[0]


def _drive(socket: bpy.types.NodeSocket, obj: bpy.types.Object) -> None:
    driver = socket.driver_add("default_value").driver
    driver.type = "SUM"
    variable = driver.variables.new()
    variable.targets[0].id = obj
    variable.targets[0].data_path = PROPERTY


def _source(group: bpy.types.NodeTree) -> bpy.types.Object | None:
    """The object that nodes of ours listen to."""
    drivers = group.animation_data.drivers if group.animation_data else ()
    return next((target.id for curve in drivers for variable in curve.driver.variables
                 for target in variable.targets), None)


class _Nodes:
    """Makes nodes in a row."""

    def __init__(self, group: bpy.types.NodeTree) -> None:
        self.group = group

    def new(self, kind: str, name: str = "", inputs: Iterable[bpy.types.NodeSocket] = (),
            **values: object) -> bpy.types.Node:
        """A node with what comes in, in order."""
        node = self.group.nodes.new(kind)
        node.location.x = 180 * len(self.group.nodes)
        if name:
            node.name = node.label = name
        for key, value in values.items():
            setattr(node, key, value)
        for source, socket in zip(inputs, node.inputs, strict=False):
            self.link(source, socket)
        return node

    def link(self, source: bpy.types.NodeSocket, target: bpy.types.NodeSocket) -> None:
        self.group.links.new(source, target)

    def math(self, operation: str, first: bpy.types.NodeSocket, second: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
        """Vector arithmetic; the output."""
        node = self.new("ShaderNodeVectorMath", operation=operation)
        self.link(first, node.inputs[0])
        self.link(second, node.inputs["Scale"] if operation == "SCALE" else node.inputs[1])
        return node.outputs[0]

    def middle(self, moment: bpy.types.NodeSocket, area: bpy.types.NodeSocket,
               part: bpy.types.NodeSocket | None = None) -> bpy.types.NodeSocket:
        """Middle of the surface, or of each part's."""
        total = []
        for value, kind in ((moment, "FLOAT_VECTOR"), (area, "FLOAT")):
            node = self.new("GeometryNodeAccumulateField", data_type=kind, domain="FACE", inputs=[value])
            if part is not None:
                self.link(part, node.inputs["Group ID"])
            total.append(node.outputs["Total"])
        return self.math("DIVIDE", *total)
