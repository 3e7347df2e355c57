# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything about a Blender file that a user could miss, as plain values to compare.

Positions, topology, attributes with their values, vertex groups, colours, materials, shape keys, modifiers,
custom properties, the stored result, collections, parents, modes, the selection, and which data there is.
"""

import hashlib

import bpy
import numpy as np
from bulk import read

_VALUES = {  # of an attribute: the name of its values, their type, how many
    "FLOAT": ("value", np.float32, 1), "INT": ("value", np.int32, 1), "BOOLEAN": ("value", bool, 1),
    "INT8": ("value", np.int8, 1), "FLOAT_VECTOR": ("vector", np.float32, 3),
    "FLOAT2": ("vector", np.float32, 2), "BYTE_COLOR": ("color_srgb", np.float32, 4),
    "FLOAT_COLOR": ("color", np.float32, 4), "INT32_2D": ("value", np.int32, 2),
    "INT16_2D": ("value", np.int32, 2),
}
BRUSHES = "essentials_brushes"  # Blender's own, loaded when a mode for painting is entered
_KINDS = ("objects", "meshes", "collections", "materials", "curves", "armatures", "shape_keys", "node_groups",
          "actions", "images", "texts", "libraries")


def snapshot() -> dict:
    """The whole file. Objects in Edit Mode are looked at as when they had left it."""
    for obj in bpy.data.objects:
        if obj.mode == "EDIT":
            obj.update_from_editmode()
    layer = bpy.context.view_layer
    return {
        "data": {kind: sorted(item.name for item in getattr(bpy.data, kind)
                              if item.name != "Render Result" and not item.name.startswith(BRUSHES))
                 for kind in _KINDS},
        "objects": {obj.name: _object(obj) for obj in bpy.data.objects},
        "meshes": {mesh.name: _mesh(mesh) for mesh in bpy.data.meshes[:]},
        "collections": {c.name: _collection(c) for c in bpy.data.collections},
        "scene": _collection(bpy.context.scene.collection),
        "layer": _layer(layer.layer_collection),
        "settings": [_group(bpy.context.scene, name) for name in ("reeb_parts", "reeb_parts_use")],
        "materials": {m.name: _material(m) for m in bpy.data.materials},
        "curves": {curve.name: _curve(curve) for curve in bpy.data.curves},
        "armatures": {armature.name: _bones(armature) for armature in bpy.data.armatures},
        "nodes": {group.name: _nodes(group) for group in bpy.data.node_groups},
        "active": getattr(layer.objects.active, "name", None),
        "selected": sorted(obj.name for obj in layer.objects.selected),
    }


def activate(obj):
    """Make an object active and the only one selected."""
    for other in list(bpy.context.view_layer.objects.selected):
        other.select_set(False)
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj


def changes(before, after, path="") -> list:
    """Where two snapshots differ: path, value before, value after."""
    if not isinstance(before, dict) or not isinstance(after, dict):
        return [] if before == after else [(path, before, after)]
    keys = [*before, *(key for key in after if key not in before)]
    return [change for key in keys for change in changes(before.get(key), after.get(key), f"{path}/{key}")]


def check_undo(work):
    """Whether undo brings back the file as it was before some work, and redo as it was after it.

    What Blender's own references point to is another thing afterwards: look things up by name.
    """
    bpy.ops.ed.undo_push(message="before")
    before = snapshot()
    work()
    bpy.ops.ed.undo_push(message="after")
    after = snapshot()
    assert after != before
    bpy.ops.ed.undo()
    assert changes(before, snapshot()) == []
    bpy.ops.ed.redo()
    assert changes(after, snapshot()) == []


def _object(obj) -> dict:
    return {
        "mode": obj.mode,
        "data": obj.data.name if obj.data else None,
        "matrix": np.array(obj.matrix_world).tolist(),
        "parent": obj.parent.name if obj.parent else None,
        "modifiers": [str(_values(modifier)) for modifier in obj.modifiers],
        "groups": [(group.name, group.lock_weight) for group in obj.vertex_groups],
        "active group": obj.vertex_groups.active_index,
        "active key": obj.active_shape_key_index,
        "slots": [(slot.material.name if slot.material else None, slot.link) for slot in obj.material_slots],
        "hidden": (obj.hide_get(), obj.hide_viewport, obj.hide_render, obj.hide_select),
        "display": (obj.show_in_front, obj.display_type, obj.empty_display_type, obj.empty_display_size),
        "color": tuple(obj.color),
        "properties": _properties(obj),
        "made": _group(obj, "reeb_parts_made"),
    }


def _mesh(mesh) -> dict:
    """A mesh in Edit Mode by way of a copy, since Blender gives no access to its attributes there."""
    copy = mesh.copy() if mesh.is_editmode else None
    try:
        return {**_geometry(mesh if copy is None else copy, _user(mesh)), "name of keys": _key_name(mesh),
                "properties": _properties(mesh), "result": _group(mesh, "reeb_parts")}
    finally:
        if copy is not None:
            bpy.data.meshes.remove(copy)


def _geometry(mesh, user) -> dict:
    return {
        "positions": _hash(read(mesh.vertices, "co", np.float32, 3)),
        "edges": _hash(read(mesh.edges, "vertices", np.int32, 2)),
        "corners": _hash(read(mesh.loops, "vertex_index", np.int32, 1)),
        "faces": _hash(read(mesh.polygons, "loop_start", np.int32, 1)),
        "slots": _hash(read(mesh.polygons, "material_index", np.int32, 1)),
        "flags": {f"{name} {flag}": _hash(read(getattr(mesh, name), flag, bool, 1))
                  for name in ("vertices", "edges", "polygons") for flag in ("select", "hide")},
        "seams": _hash(read(mesh.edges, "use_seam", bool, 1)),
        "attributes": {a.name: _attribute(a) for a in mesh.attributes},
        "order": [a.name for a in mesh.attributes],
        "active attribute": mesh.attributes.active.name if mesh.attributes.active else None,
        "active color": mesh.attributes.active_color_name,
        "render color": mesh.attributes.default_color_name,
        "active UV map": mesh.uv_layers.active.name if mesh.uv_layers.active else None,
        "weights": _weights(mesh, user),
        "keys": _keys(mesh.shape_keys) if mesh.shape_keys else None,
        "materials": [m.name if m else None for m in mesh.materials],
    }


def _material(material) -> dict:
    tree = material.node_tree
    return {"users": material.users, "color": tuple(material.diffuse_color), "nodes": tree and _nodes(tree)}


def _nodes(tree) -> list:
    """Nodes with their settings and what their sockets are set to, and the links between them."""
    nodes = [(node.name, node.bl_idname, [_socket(socket) for socket in (*node.inputs, *node.outputs)])
             for node in tree.nodes]
    return [*nodes, *[(link.from_socket.path_from_id(), link.to_socket.path_from_id()) for link in tree.links],
            _properties(tree)]


def _socket(socket):
    value = getattr(socket, "default_value", None)
    return socket.name, tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else str(value)


def _curve(curve) -> dict:
    return {"thickness": curve.bevel_depth, "splines": [
        [_hash(read(spline.points, name, np.float32, width)) for name, width in (("co", 4), ("radius", 1))]
        for spline in curve.splines]}


def _bones(armature) -> list:
    return [(bone.name, bone.parent and bone.parent.name, tuple(bone.head_local), tuple(bone.tail_local),
             bone.use_connect) for bone in armature.bones]


def _user(mesh):
    """An object of a mesh, which knows the names of the vertex groups; or None."""
    return next((obj for obj in bpy.data.objects if obj.data == mesh), None)


def _key_name(mesh):
    return mesh.shape_keys.name if mesh.shape_keys else None


def _attribute(attribute):
    """Kind and values; no values where all are zero."""
    name, dtype, width = _VALUES.get(attribute.data_type, (None, None, None))
    values = np.zeros(0) if name is None else read(attribute.data, name, dtype, width)
    return attribute.data_type, attribute.domain, _hash(values) if values.any() else None


def _weights(mesh, user) -> dict:
    """The members of each vertex group and their weights."""
    names = user.vertex_groups.keys() if user else []
    found = {}
    for vertex in mesh.vertices:
        for entry in vertex.groups:
            group = names[entry.group] if entry.group < len(names) else entry.group
            found.setdefault(group, []).append((vertex.index, round(entry.weight, 6)))
    return {group: _hash(np.array(members)) for group, members in found.items()}


def _keys(keys):
    return [(k.name, k.value, k.mute, k.vertex_group, k.relative_key.name,
             _hash(read(k.data, "co", np.float32, 3))) for k in keys.key_blocks]


def _collection(collection) -> dict:
    return {
        "objects": sorted(collection.objects.keys()),
        "children": sorted(collection.children.keys()),
        "properties": _properties(collection),
        "hidden": (collection.hide_viewport, collection.hide_render),
    }


def _layer(layer) -> dict:
    return {child.name: (child.exclude, child.hide_viewport, _layer(child)) for child in layer.children}


def _properties(data) -> dict:
    values = {key: data[key] for key in data.keys()}
    return {key: getattr(value, "name", None) or str(value) for key, value in values.items()}


def _group(data, name):
    """What we keep with something of Blender's; None if there is nothing: older Blenders make it when it is read."""
    return str(_values(getattr(data, name))) if data.is_property_set(name) else None


def _values(data) -> dict:
    """The properties of something of Blender's, and of what it is made of."""
    return {p.identifier: _value(data, p) for p in data.bl_rna.properties if p.identifier not in _RUNTIME}


_RUNTIME = ("rna_type", "execution_time", "persistent_uid", "bl_system_properties_get", "bl_idname")


def _value(data, kind):
    value = getattr(data, kind.identifier)
    if kind.type == "COLLECTION":
        return [_values(item) if isinstance(item, bpy.types.PropertyGroup) else str(item) for item in value]
    if kind.type == "POINTER":
        return getattr(value, "name", None) or type(value).__name__
    if kind.type == "STRING" and isinstance(value, bytes):
        return _hash(value)
    return tuple(value) if getattr(kind, "is_array", False) else value


def _hash(data) -> str:
    data = data if isinstance(data, bytes) else data.tobytes()
    return hashlib.sha256(data).hexdigest()[:16]
