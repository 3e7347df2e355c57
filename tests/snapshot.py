# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything about a Blender file that a user could miss, as plain values to compare.

Positions, topology, attributes, vertex groups, colours, materials, shape keys, modifiers, custom
properties, collections, parents, modes, the selection.
"""

import hashlib

import bpy
import numpy as np

_VALUES = {  # of an attribute: the name of its values, their type, how many
    "FLOAT": ("value", np.float32, 1), "INT": ("value", np.int32, 1), "BOOLEAN": ("value", bool, 1),
    "INT8": ("value", np.int8, 1), "FLOAT_VECTOR": ("vector", np.float32, 3),
    "FLOAT2": ("vector", np.float32, 2), "BYTE_COLOR": ("color_srgb", np.float32, 4),
    "FLOAT_COLOR": ("color", np.float32, 4), "INT32_2D": ("value", np.int32, 2),
    "INT16_2D": ("value", np.int32, 2),
}  # fmt: skip


def snapshot() -> dict:
    """The whole file. Objects in Edit Mode are looked at as when they had left it."""
    for obj in bpy.data.objects:
        if obj.mode == "EDIT":
            obj.update_from_editmode()
    return {
        "objects": {obj.name: _object(obj) for obj in bpy.data.objects},
        "meshes": {mesh.name: _mesh(mesh) for mesh in bpy.data.meshes},
        "collections": {c.name: _collection(c) for c in bpy.data.collections},
        "scene": _collection(bpy.context.scene.collection),
        "materials": {m.name: (m.users, tuple(m.diffuse_color)) for m in bpy.data.materials},
        "curves": sorted(bpy.data.curves.keys()),
        "active": getattr(bpy.context.view_layer.objects.active, "name", None),
        "selected": sorted(obj.name for obj in bpy.context.view_layer.objects.selected),
    }


def activate(obj):
    """Make an object active and the only one selected."""
    for other in list(bpy.context.view_layer.objects.selected):
        other.select_set(False)
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj


def _object(obj) -> dict:
    return {
        "mode": obj.mode,
        "data": obj.data.name if obj.data else None,
        "matrix": np.array(obj.matrix_world).tolist(),
        "parent": obj.parent.name if obj.parent else None,
        "modifiers": [(m.name, m.type) for m in obj.modifiers],
        "groups": [group.name for group in obj.vertex_groups],
        "active group": obj.vertex_groups.active_index,
        "slots": [slot.material.name if slot.material else None for slot in obj.material_slots],
        "hidden": (obj.hide_get(), obj.hide_viewport, obj.hide_render),
        "color": tuple(obj.color),
        "properties": _properties(obj),
    }


def _mesh(mesh) -> dict:
    editing = mesh.is_editmode
    return {
        "positions": _hash(_read(mesh.vertices, "co", np.float32, 3)),
        "edges": _hash(_read(mesh.edges, "vertices", np.int32, 2)),
        "corners": _hash(_read(mesh.loops, "vertex_index", np.int32, 1)),
        "faces": _hash(_read(mesh.polygons, "loop_start", np.int32, 1)),
        "seams": _hash(_read(mesh.edges, "use_seam", bool, 1)),
        "slots": _hash(_read(mesh.polygons, "material_index", np.int32, 1)),
        "attributes": {} if editing else {a.name: _attribute(a) for a in mesh.attributes},
        "active attribute": mesh.attributes.active.name if mesh.attributes.active else None,
        "active color": mesh.attributes.active_color_name,
        "render color": mesh.attributes.default_color_name,
        "weights": [] if editing else _weights(mesh),
        "keys": _keys(mesh.shape_keys) if mesh.shape_keys else None,
        "materials": [m.name if m else None for m in mesh.materials],
        "properties": _properties(mesh),
        "result": mesh.is_property_set("reeb_parts"),
    }


def _attribute(attribute):
    name, dtype, width = _VALUES.get(attribute.data_type, (None, None, None))
    values = None if name is None else _hash(_read(attribute.data, name, dtype, width))
    return attribute.data_type, attribute.domain, values


def _weights(mesh):
    return [sorted((entry.group, round(entry.weight, 6)) for entry in v.groups) for v in mesh.vertices]


def _keys(keys):
    return [(k.name, k.value, _hash(_read(k.data, "co", np.float32, 3))) for k in keys.key_blocks]


def _collection(collection) -> dict:
    return {
        "objects": sorted(collection.objects.keys()),
        "children": sorted(collection.children.keys()),
        "properties": _properties(collection),
        "hidden": (collection.hide_viewport, collection.hide_render),
    }


def _properties(data) -> dict:
    values = {key: data[key] for key in data.keys()}  # noqa: SIM118 - Blender's data is no dict
    return {key: getattr(value, "name", None) or str(value) for key, value in values.items()}


def _read(items, name, dtype, width):
    values = np.zeros(len(items) * width, dtype)
    items.foreach_get(name, values)
    return values


def _hash(array) -> str:
    return hashlib.sha256(array.tobytes()).hexdigest()[:16]
