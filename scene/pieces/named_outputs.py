# SPDX-License-Identifier: GPL-3.0-or-later
"""What we wrote to a mesh and the user's modifiers and materials work by: without it, pieces would look otherwise.

A modifier that is to act on one part has the name of its vertex group. On a piece without the group it would act on
all of it, or, as a Mask does, hide none or all. A material that reads an attribute of ours would be black.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from .. import targets
from ..reading import mesh_arrays
from ..showing import explode, hidden

# So deep in a modifier its settings have settings of their own.
_DEPTH = 3


def groups_in_use(mesh: bpy.types.Mesh) -> set[str]:
    """The names of our vertex groups by which modifiers, nodes, particles or shape keys work on a mesh."""
    groups = {part.group for part in mesh.reeb_parts.parts} - {""}
    return groups & _texts_of(mesh) if groups else set()


class KeptAttributes:
    """Attributes of ours that nodes of modifiers or materials read, kept while a copy of a mesh loses all outputs."""

    def __init__(self, mesh: bpy.types.Mesh) -> None:
        result = mesh.reeb_parts
        ours = {result.face_attribute, result.field_attribute, result.color_attribute} & set(mesh.attributes.keys())
        found = [mesh.attributes[name] for name in sorted(ours & _texts_of(mesh) if ours else ())]
        self._found = [(a.name, a.data_type, a.domain, mesh_arrays.attribute_values(a)) for a in found]

    def write(self, copy: bpy.types.Mesh) -> None:
        """Give them to the copy."""
        for name, kind, domain, values in self._found:
            mesh_arrays.set_attribute_values(copy.attributes.new(name, kind, domain), values)


def _texts_of(mesh: bpy.types.Mesh) -> set[str]:
    """All texts, among them names of groups and attributes, in what works on a mesh, but for modifiers of ours."""
    found = {key.vertex_group for key in (mesh.shape_keys.key_blocks if mesh.shape_keys else ())}
    trees: dict[bpy.types.NodeTree, None] = {}
    for obj in targets.users(mesh):
        for slot in obj.material_slots:
            _collect_trees(slot.material and slot.material.node_tree, trees)
        ours = explode.find(obj), hidden.find(obj)
        theirs = [modifier for modifier in obj.modifiers if modifier not in ours]
        for item in (*theirs, *obj.particle_systems):
            found.update(_texts(item, _DEPTH))
        for modifier in [modifier for modifier in theirs if modifier.type == "NODES"]:
            if bpy.app.version < (5, 2):  # later they are properties like others
                found.update(value for value in modifier.values() if isinstance(value, str))
            _collect_trees(modifier.node_group, trees)
    return found.union(*(_texts_of_nodes(tree) for tree in trees))


def _texts(struct: bpy.types.bpy_struct, depth: int) -> Iterator[str]:
    """The texts of a struct and, so deep, of those in it that are no data blocks."""
    for prop in struct.bl_rna.properties:
        if prop.type == "STRING" and prop.identifier != "name":
            yield getattr(struct, prop.identifier)
        elif prop.type == "POINTER" and depth and prop.identifier != "rna_type":
            inner = getattr(struct, prop.identifier)
            if inner is not None and not isinstance(inner, bpy.types.ID):
                yield from _texts(inner, depth - 1)


def _collect_trees(tree: bpy.types.NodeTree | None, trees: dict[bpy.types.NodeTree, None]) -> None:
    """Add a node tree and those of the groups in it."""
    if tree is not None and tree not in trees:
        trees[tree] = None
        for node in tree.nodes:
            _collect_trees(getattr(node, "node_tree", None), trees)


def _texts_of_nodes(tree: bpy.types.NodeTree) -> set[str]:
    """The texts of nodes and in their sockets."""
    sockets = [socket for node in tree.nodes for socket in node.inputs if socket.type == "STRING"]
    # A group's own default counts where the modifier was given nothing else.
    items = [item for item in tree.interface.items_tree if getattr(item, "socket_type", "") == "NodeSocketString"]
    named = [getattr(item, "default_attribute_name", "") for item in tree.interface.items_tree]
    own = [text for node in tree.nodes for text in _texts(node, 0)]
    return {*(socket.default_value for socket in sockets), *(item.default_value for item in items), *named, *own}
