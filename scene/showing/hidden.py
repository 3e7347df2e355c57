# SPDX-License-Identifier: GPL-3.0-or-later
"""Hidden parts vanish from Object Mode, too, which shows hidden faces: a modifier of ours leaves these out in the view.

Blender keeps its own flags of hidden faces from nodes, so that these read a copy. In renders nothing is hidden.
"""

from __future__ import annotations

import bpy
import numpy as np

from .. import targets, transaction
from ..ours import modifiers
from ..outputs.kept_aside import add_attribute, find_attribute, remove_attribute
from ..reading import mesh_arrays
from . import selection

NAME = "Reeb Parts Hide"
ATTRIBUTE = "reeb_hidden"  # of faces
OURS = "reeb_parts_hide"  # on the node group


def hide(mesh: bpy.types.Mesh, mask: np.ndarray) -> None:
    """Hide faces and show all others, in every mode; Object Mode. mask : (p,) bool."""
    selection.hide_faces(mesh, mask)
    if not mask.any():
        forget_mesh(mesh)
        return
    transaction.keep_mesh(mesh)
    name = add_attribute(mesh, ATTRIBUTE if ATTRIBUTE in mesh.attributes else "", ATTRIBUTE, "BOOLEAN", "FACE")
    mesh.attributes[name].data.foreach_set("value", mask)
    for obj in targets.users(mesh):
        _ensure(obj, name)
    mesh.update()


def find(obj: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """Our modifier on an object, or None."""
    return modifiers.find_nodes(obj, OURS)


def forget(obj: bpy.types.Object) -> None:
    """Take the modifier away; pieces are the user's from now on."""
    modifiers.remove_nodes(obj, OURS)


def forget_mesh(mesh: bpy.types.Mesh) -> None:
    """Show the faces of a mesh in Object Mode as they are."""
    for obj in targets.users(mesh):
        forget(obj)
    forget_faces(mesh)


def forget_faces(mesh: bpy.types.Mesh) -> None:
    """Show in all modes the faces that the modifiers left out, now that there are none."""
    transaction.keep_mesh(mesh)
    found = find_attribute(mesh, ATTRIBUTE, "BOOLEAN", "FACE")
    if found is not None:
        selection.hide_faces(mesh, selection.hidden_faces(mesh) & ~mesh_arrays.attribute_values(found))
    remove_attribute(mesh, ATTRIBUTE)


def _ensure(obj: bpy.types.Object, attribute: str) -> None:
    """Put the modifier last, if it is not there."""
    modifier = find(obj)
    if modifier is None:
        modifier = modifiers.new(obj, NAME, "NODES")
        modifier.node_group = _node_group()
        modifier.show_render = False
    socket = modifier.node_group.nodes["Hidden"].inputs["Name"]
    transaction.keep(socket, "default_value")
    socket.default_value = attribute


def _node_group() -> bpy.types.NodeTree:
    """Nodes that leave out the faces that an attribute tells."""
    group = modifiers.new_nodes(NAME, OURS)
    start, attribute, left, end = (group.nodes.new(kind) for kind in (
        "NodeGroupInput", "GeometryNodeInputNamedAttribute", "GeometryNodeDeleteGeometry", "NodeGroupOutput"))
    for place, node in enumerate((start, attribute, left, end)):
        node.location.x = 180 * place
    attribute.name = attribute.label = "Hidden"
    attribute.data_type, left.domain = "BOOLEAN", "FACE"
    value = next(socket for socket in attribute.outputs if socket.enabled)
    for source, target in ((start.outputs[0], left.inputs["Geometry"]), (value, left.inputs["Selection"]),
                           (left.outputs[0], end.inputs[0])):
        group.links.new(source, target)
    return group
