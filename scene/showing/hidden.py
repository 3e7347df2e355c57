# SPDX-License-Identifier: GPL-3.0-or-later
"""Hidden parts vanish from Object Mode, too, which shows hidden faces: a modifier of ours leaves these out in the view.

Blender keeps its own flags of hidden faces from nodes, so that these read a copy. In renders nothing is hidden.
"""

from __future__ import annotations

import bpy
import numpy as np

from .. import targets, transaction
from ..ours import modifiers
from ..outputs.kept_aside import PREFIX, add_attribute, find_attribute, keep_aside, remove_attribute
from ..reading import mesh_arrays
from . import selection

NAME = "Reeb Parts Hide"
ATTRIBUTE = "reeb_hidden"  # of faces
OURS = "reeb_parts_hide"  # on the node group
_KEPT = f"{PREFIX}_hidden"  # which of these faces the user had hidden before
# What the user had hidden before we hid anything: faces do not tell which of their edges and vertices were.
_FIRST = {"polygons": (f"{PREFIX}_hide_poly", "FACE"), "edges": (f"{PREFIX}_hide_edge", "EDGE"),
          "vertices": (f"{PREFIX}_hide_vert", "POINT")}


def hide(mesh: bpy.types.Mesh, mask: np.ndarray) -> None:
    """Hide faces, in every mode, beside those that are hidden; Object Mode. mask : (p,) bool."""
    _leave_out(mesh, _ours(mesh) | mask, selection.hidden_faces(mesh) | mask)


def isolate(mesh: bpy.types.Mesh, shown: np.ndarray) -> None:
    """Show faces and hide all others, in every mode; Object Mode. shown : (p,) bool."""
    _leave_out(mesh, ~shown, ~shown)


def _leave_out(mesh: bpy.types.Mesh, ours: np.ndarray, every: np.ndarray) -> None:
    """Hide some faces, (p,) bool, in Edit Mode and those of ours in Object Mode, too."""
    _keep_first(mesh)
    users = _hidden_by_user(mesh) & ours
    selection.hide_faces(mesh, every)
    if not ours.any():
        for obj in targets.users(mesh):
            forget(obj)
        remove_attributes(mesh)
        return
    name = add_attribute(mesh, ATTRIBUTE if ATTRIBUTE in mesh.attributes else "", ATTRIBUTE, "BOOLEAN", "FACE")
    mesh.attributes[name].data.foreach_set("value", ours)
    keep_aside(mesh, users, _KEPT, "BOOLEAN", "FACE")
    for obj in targets.users(mesh):
        _ensure(obj, name)
    mesh.update()


def _ours(mesh: bpy.types.Mesh, name: str = ATTRIBUTE) -> np.ndarray:
    """Whether we hide each face, (p,) bool."""
    found = find_attribute(mesh, name, "BOOLEAN", "FACE")
    return np.zeros(len(mesh.polygons), bool) if found is None else mesh_arrays.attribute_values(found)


def _hidden_by_user(mesh: bpy.types.Mesh) -> np.ndarray:
    """Whether each face is hidden, and would be without us, (p,) bool."""
    return selection.hidden_faces(mesh) & (_ours(mesh, _KEPT) | ~_ours(mesh))


def find(obj: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """Our modifier on an object, or None."""
    return modifiers.find_nodes(obj, OURS)


def forget(obj: bpy.types.Object) -> None:
    """Take the modifier away; pieces are the user's from now on."""
    modifiers.remove_nodes(obj, OURS)


def forget_faces(mesh: bpy.types.Mesh) -> None:
    """Show in all modes the faces that the modifiers left out, now that there are none, but for the user's."""
    transaction.keep_mesh(mesh)
    if find_attribute(mesh, ATTRIBUTE, "BOOLEAN", "FACE"):
        first = _first(mesh)
        if first and _is_as_we_left_it(mesh, first["polygons"]):
            selection.hide_elements(mesh, first)
        else:
            selection.hide_faces(mesh, _hidden_by_user(mesh))
    remove_attributes(mesh)


def _keep_first(mesh: bpy.types.Mesh) -> None:
    """Keep aside what the user has hidden, if we hide nothing yet; forget it once the user has hidden more."""
    transaction.keep_mesh(mesh)
    first = _first(mesh)
    if find_attribute(mesh, ATTRIBUTE, "BOOLEAN", "FACE"):
        if first and not _is_as_we_left_it(mesh, first["polygons"]):
            _remove_first(mesh)
        return
    _remove_first(mesh)
    hidden = selection.hidden_elements(mesh)
    if any(values.any() for values in hidden.values()):
        for items, (name, domain) in _FIRST.items():
            keep_aside(mesh, hidden[items], name, "BOOLEAN", domain)


def _first(mesh: bpy.types.Mesh) -> dict[str, np.ndarray]:
    """What the user had hidden at first, see selection.hidden_elements; empty if nothing, or if it is not known."""
    found = {items: find_attribute(mesh, name, "BOOLEAN", domain) for items, (name, domain) in _FIRST.items()}
    return {items: mesh_arrays.attribute_values(kept) for items, kept in found.items() if kept} if all(
        found.values()) else {}


def _is_as_we_left_it(mesh: bpy.types.Mesh, first: np.ndarray) -> bool:
    """Whether those faces are hidden that we have hidden, beside the user's first ones, (p,) bool, or alone."""
    ours, now = _ours(mesh), selection.hidden_faces(mesh)
    return np.array_equal(now, ours) or np.array_equal(now, ours | first)


def remove_attributes(mesh: bpy.types.Mesh) -> None:
    """Remove what tells on a mesh which faces we hide."""
    for name in (ATTRIBUTE, _KEPT):
        if find_attribute(mesh, name, "BOOLEAN", "FACE"):
            remove_attribute(mesh, name)
    _remove_first(mesh)


def _remove_first(mesh: bpy.types.Mesh) -> None:
    for name, domain in _FIRST.values():
        if find_attribute(mesh, name, "BOOLEAN", domain):
            remove_attribute(mesh, name)


def _ensure(obj: bpy.types.Object, attribute: str) -> None:
    """Put the modifier last, if it is not there."""
    modifier = find(obj)
    if modifier is None:
        modifier = modifiers.new(obj, NAME, "NODES")
        modifier.show_render = False
    if modifier.node_group is None or "Hidden" not in modifier.node_group.nodes:  # which the user has renamed
        modifiers.set_nodes(modifier, _node_group(), OURS)
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
    modifiers.mark_nodes(group, OURS)
    return group
