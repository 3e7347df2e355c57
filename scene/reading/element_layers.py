# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the elements of a Blender mesh as arrays, with all that they carry, and makes meshes of such arrays.

Blender gives and takes attributes as whole arrays. Weights it gives one by one only, and they are read only where a
mesh has vertex groups. What is in no array - the displacement of Multires - is in scene/pieces/sculpted_pieces.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext

import bmesh
import bpy
import numpy as np

from ...core.arrays.int64 import arange
from ..temporary import freed, removed
from . import fingerprints, mesh_arrays, mesh_groups
from .elements import CORNER, EDGE, FACE, POINT, Elements, Layer, Ragged

#: What is no attribute. Their layers have names that no attribute can have.
SPECIAL = KEY, WEIGHTS, SKIN, FREESTYLE = "shape key", "weights", "skin", "Freestyle"

# Of attributes, the beginnings of names that say what is selected, hidden or pinned, which is no work.
PASSING = (".select_", ".hide_", ".uv_select", ".vs.", ".es.", ".pn.")
_TOPOLOGY = {".edge_verts", ".corner_vert", ".corner_edge"}
# Attributes that are read in other ways.
_OTHERWISE = _TOPOLOGY if bpy.app.version < (5, 3, 0) else {
    *_TOPOLOGY, "skin_modifier_radius", "skin_modifier_root", "skin_modifier_loose"}
# What from_pydata of Blender 5.0 makes instead of one of BOOLEAN; nothing can be read from it, nor written to it.
_WITHOUT_VALUES = (".select_edge", "INT32_2D")
_ITEMS = {POINT: "vertices", EDGE: "edges", FACE: "polygons", CORNER: "loops"}
_WEIGHT = np.dtype([("group", np.int32), ("weight", np.float32)])
_SKIN = (("radius", np.float32, 2), ("use_root", bool, 1), ("use_loose", bool, 1))


def read(mesh: bpy.types.Mesh, n_groups: int | None = None) -> Elements:
    """The elements of a mesh in Object Mode, with all that they carry. n_groups : of vertex groups, where known."""
    layers = {a.name: Layer(a.data_type, a.domain, mesh_arrays.attribute_values(a))
              for a in mesh.attributes if a.name not in _OTHERWISE and (a.name, a.data_type) != _WITHOUT_VALUES}
    for index, key in enumerate(mesh.shape_keys.key_blocks if mesh.shape_keys else ()):
        layers[f"\0{KEY} {index}"] = Layer(KEY, POINT, mesh_arrays.key_points(key))
    for layer in mesh.skin_vertices:
        for name, kind, width in _SKIN:
            layers[f"\0{SKIN} {name}"] = Layer(SKIN, POINT, mesh_arrays.read(layer.data, name, kind, width))
    for domain in (EDGE, FACE) if bpy.app.version < (5, 0) else ():  # later they are attributes
        marks = mesh_arrays.read(getattr(mesh, _ITEMS[domain]), "use_freestyle_mark", bool)
        if marks.any():
            layers[f"\0{FREESTYLE} {domain}"] = Layer(FREESTYLE, domain, marks)
    if (weights := _weights(mesh, n_groups)) is not None:
        layers[f"\0{WEIGHTS}"] = Layer(WEIGHTS, POINT, weights)
    return Elements(mesh_arrays.edge_ends(mesh), mesh_arrays.face_sizes(mesh),
                    mesh_arrays.corner_vertices(mesh), mesh_arrays.corner_edges(mesh), layers)


def contents(mesh: bpy.types.Mesh, n_groups: int) -> str:
    """Changes when something is done to what the elements carry: maps, colors, weights, shape keys, marks ...

    Not when vertices move, which fingerprints.fingerprint tells, when elements are selected or hidden, nor when Blender
    makes a layer that says nothing. Not in Edit Mode. n_groups : how many vertex groups an object of the mesh has.
    """
    digests = []
    for name, layer in sorted(read(mesh, n_groups).layers.items()):
        values = layer.values
        says = values.count.any() if isinstance(values, Ragged) else values.any()
        if says and name != "position" and not name.startswith(PASSING):
            arrays = (values.count, values.items) if isinstance(values, Ragged) else (_bytes(values),)
            digests.append((name, layer.kind, layer.domain, fingerprints.digest(*arrays)))
    return str(digests)


def _bytes(values: np.ndarray) -> np.ndarray:
    """Values whose bytes tell them apart: of text, the text itself instead of where it is kept."""
    return np.array([str(value) for value in values]) if values.dtype == object else values


def made(elements: Elements, like: bpy.types.Mesh, groups: Sequence[str] | None = None) -> bpy.types.Mesh:
    """A new mesh of some elements; all else is as in another mesh, from which what they carry comes.

    groups : the names of the vertex groups that weights are in, where the other mesh lacks some: the new one has those
    that its vertices are in. Without, all are there.
    """
    mesh = like.copy()
    _resize(mesh, elements)
    if len(elements.ends):
        mesh.attributes[".edge_verts"].data.foreach_set("value", elements.ends.ravel())
    if len(elements.count):
        mesh.polygons.foreach_set("loop_start", np.cumsum(elements.count, dtype=np.int32) - elements.count)
        mesh.attributes[".corner_vert"].data.foreach_set("value", elements.corner_vertex)
        mesh.attributes[".corner_edge"].data.foreach_set("value", elements.corner_edge)
    for attribute in [a.name for a in mesh.attributes if a.name not in {*_OTHERWISE, *elements.layers}]:
        mesh.attributes.remove(mesh.attributes[attribute])
    _set_layers(mesh, elements, groups)
    mesh_arrays.set_active(mesh, like)
    mesh.update()
    return mesh


def _resize(mesh: bpy.types.Mesh, elements: Elements) -> None:
    """Give a mesh so many elements, which carry nothing."""
    n, skin = len(elements.points), any(layer.kind == SKIN for layer in elements.layers.values())
    with freed(bmesh.new()) as bm:
        # Only from a BMesh shape keys take over the number of vertices, and skin comes; it leaves the names of groups.
        if n and (mesh.shape_keys or skin):
            keys, points = mesh.copy(), bpy.data.meshes.new("Reeb Parts")
            with removed(bpy.data.meshes, keys, points):
                # Blender warns of each key that a BMesh does not know, and of no vertices it learns none.
                keys.clear_geometry()
                keys.vertices.add(1)
                points.vertices.add(n - 1)
                bm.from_mesh(keys)
                bm.from_mesh(points)
        if skin:
            bm.verts.layers.skin.verify()
        bm.to_mesh(mesh)
    mesh.vertices.add(n - len(mesh.vertices))
    mesh.edges.add(len(elements.ends))
    mesh.loops.add(len(elements.corner_vertex))
    mesh.polygons.add(len(elements.count))


def _set_layers(mesh: bpy.types.Mesh, elements: Elements, groups: Sequence[str] | None) -> None:
    """Write what the elements carry. groups : see ``made``."""
    new = {name: layer for name, layer in elements.layers.items()
           if layer.kind not in SPECIAL and name not in mesh.attributes}
    with mesh_groups.beside(mesh, new) if f"\0{WEIGHTS}" in elements.layers else nullcontext():
        for name, layer in new.items():
            mesh.attributes.new(name, layer.kind, layer.domain)
    for name, layer in elements.layers.items():
        if layer.kind == WEIGHTS:
            _set_weights(mesh, layer.values, groups)
        else:
            _set_values(mesh, name, layer)


def _set_values(mesh: bpy.types.Mesh, name: str, layer: Layer) -> None:
    """Write the values of a layer that is there, of any kind but weights."""
    of_kind = name.rsplit(" ", 1)[-1]  # the number of a shape key, the name of what skin has
    if layer.kind == KEY:
        mesh_arrays.set_key_points(mesh.shape_keys.key_blocks[int(of_kind)], layer.values)
    elif layer.kind == SKIN:
        mesh.skin_vertices[0].data.foreach_set(of_kind, layer.values.ravel())
    elif layer.kind == FREESTYLE:
        getattr(mesh, _ITEMS[layer.domain]).foreach_set("use_freestyle_mark", layer.values)
    else:
        mesh_arrays.set_attribute_values(mesh.attributes[name], layer.values)


def _weights(mesh: bpy.types.Mesh, n_groups: int | None) -> Ragged | None:
    """Groups and weights of each vertex; None without vertex groups. n_groups : as for ``read``."""
    if n_groups is None:
        with mesh_groups.twin(mesh) as twin:
            n_groups = len(twin.vertex_groups)
    if not n_groups:
        return None
    lists = [[(entry.group, entry.weight) for entry in vertex.groups if entry.group < n_groups]
             for vertex in mesh.vertices]  # cannot be read in bulk
    items = np.array([pair for pairs in lists for pair in pairs], _WEIGHT)
    return Ragged(np.fromiter(map(len, lists), np.int64, len(lists)), items)


def _set_weights(mesh: bpy.types.Mesh, weights: Ragged, names: Sequence[str] | None) -> None:
    """Give vertices their weights. names : of all groups, see ``made``."""
    vertex = np.repeat(arange(len(weights)), weights.count)
    with mesh_groups.twin(mesh) as twin:
        own = dict(enumerate(twin.vertex_groups)) if names is None else mesh_groups.of_names(
            twin, names, np.unique(weights.items["group"]).tolist())
        mesh_groups.give_weights(own, vertex, weights.items["group"], weights.items["weight"])
        groups = list(twin.vertex_groups)
        if not len(vertex) and groups:  # where no vertex has ever had a weight, a shape key works as if it had no group
            groups[0].add([0], 0.0, "REPLACE")
            groups[0].remove([0])
