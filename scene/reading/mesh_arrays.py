# SPDX-License-Identifier: GPL-3.0-or-later
"""The arrays of a Blender mesh: positions, corners, edges, triangles.

Everything is read in bulk. n vertices, e edges, c corners, p faces.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from numpy.typing import DTypeLike

from ...core.arrays.indexing import renumbered, run_starts
from ...core.arrays.int64 import arange, cumsum
from ...core.arrays.vectors import cross, lengths, row_products
from ...core.mesh.corners import CornerTable

_VALUES = {  # of an attribute: the name of its values, their type, how many
    "FLOAT": ("value", np.float32, 1), "INT": ("value", np.int32, 1), "BOOLEAN": ("value", bool, 1),
    "INT8": ("value", np.int32, 1), "FLOAT_VECTOR": ("vector", np.float32, 3), "FLOAT2": ("vector", np.float32, 2),
    "FLOAT4": ("vector", np.float32, 4), "BYTE_COLOR": ("color_srgb", np.float32, 4),
    "FLOAT_COLOR": ("color", np.float32, 4), "INT32_2D": ("value", np.int32, 2), "INT16_2D": ("value", np.int32, 2),
    "QUATERNION": ("value", np.float32, 4), "FLOAT4X4": ("value", np.float32, 16),
}

_KEPT_IN = {  # where Blender 5 keeps a property of elements: name, type and domain of the attribute
    ("polygons", "hide"): (".hide_poly", "BOOLEAN", "FACE"),
    ("polygons", "select"): (".select_poly", "BOOLEAN", "FACE"),
    ("polygons", "material_index"): ("material_index", "INT", "FACE"),
    ("edges", "hide"): (".hide_edge", "BOOLEAN", "EDGE"),
    ("edges", "select"): (".select_edge", "BOOLEAN", "EDGE"),
    ("edges", "use_seam"): ("uv_seam", "BOOLEAN", "EDGE"),
    ("edges", "use_edge_sharp"): ("sharp_edge", "BOOLEAN", "EDGE"),
    ("vertices", "hide"): (".hide_vert", "BOOLEAN", "POINT"),
    ("vertices", "select"): (".select_vert", "BOOLEAN", "POINT"),
}

_face_corners: dict[tuple, tuple[np.ndarray, np.ndarray]] = {}
_joined_faces: dict[tuple, CornerTable | None] = {}  # None where nothing has to be joined


def read(items: Any, key: str, kind: DTypeLike, width: int = 1) -> np.ndarray:
    """A property of all items of a collection of Blender's, (k,) or, of several values each, (k, width)."""
    values = np.empty(width * len(items), kind)
    if len(items):
        items.foreach_get(key, values)
    return values if width == 1 else values.reshape(-1, width)


def element_values(mesh: bpy.types.Mesh, items: str, key: str) -> np.ndarray:
    """A property of all polygons, edges or vertices of a mesh that Blender keeps in an attribute.

    In Edit Mode, as it was when that began: there the elements alone tell it.

    items, key : of _KEPT_IN. From the elements themselves, Blender 5 looks for the attribute anew at each of them, past
    all vertex groups: that takes a hundred times as long where there are hundreds, of parts or of bones.
    """
    elements, kind = getattr(mesh, items), _VALUES[_KEPT_IN[items, key][1]][1]
    if bpy.app.version < (5, 0) or mesh.is_editmode:
        return read(elements, key, kind)
    attribute = _kept_in(mesh, items, key)
    return np.zeros(len(elements), kind) if attribute is None else attribute_values(attribute)


def set_element_values(mesh: bpy.types.Mesh, items: str, key: str, values: np.ndarray) -> None:
    """Set what ``element_values`` gives, (k,).

    Where an attribute of that name is somebody's own, nothing is set; Blender 5.0 would crash, which makes such ones
    of edges itself.
    """
    name, kind, domain = _KEPT_IN[items, key]
    values = np.ascontiguousarray(values, _VALUES[kind][1])
    if bpy.app.version < (5, 0):
        getattr(mesh, items).foreach_set(key, values)
    elif len(values):
        if name not in mesh.attributes:
            mesh.attributes.new(name, kind, domain)
        attribute = _kept_in(mesh, items, key)
        if attribute is not None:
            set_attribute_values(attribute, values)


def _kept_in(mesh: bpy.types.Mesh, items: str, key: str) -> bpy.types.Attribute | None:
    """The attribute that holds a property of elements; without one, all have the default.

    One of that name on other elements, or of another type, is somebody's own, and Blender does not look at it.
    """
    name, kind, domain = _KEPT_IN[items, key]
    attribute = mesh.attributes.get(name) if len(getattr(mesh, items)) else None
    return attribute if attribute and (attribute.data_type, attribute.domain) == (kind, domain) else None


def attribute_values(attribute: bpy.types.Attribute) -> np.ndarray:
    """What an attribute says of all elements, (k,) or (k, width); text, which is rare, as objects."""
    if attribute.data_type in _VALUES:
        return read(attribute.data, *_VALUES[attribute.data_type])
    values = np.empty(len(attribute.data), object)
    values[:] = [item.value for item in attribute.data]
    return values


def set_attribute_values(attribute: bpy.types.Attribute, values: np.ndarray) -> None:
    """Write what ``attribute_values`` gave of as many elements; of text, 0 stands for none."""
    if attribute.data_type in _VALUES:
        if len(values):
            attribute.data.foreach_set(_VALUES[attribute.data_type][0], values.ravel())
        return
    for item, value in zip(attribute.data, values.tolist(), strict=True):
        if value != 0 and item.value != value:
            item.value = value


def set_active(mesh: bpy.types.Mesh, like: bpy.types.Mesh) -> None:
    """Have the same attributes active as on another mesh with the same ones."""
    for name in ("active_color_name", "default_color_name"):
        if getattr(mesh.attributes, name) != getattr(like.attributes, name):
            setattr(mesh.attributes, name, getattr(like.attributes, name))
    if mesh.uv_layers.active_index != like.uv_layers.active_index:
        mesh.uv_layers.active_index = like.uv_layers.active_index
    for now, then in zip(mesh.uv_layers, like.uv_layers, strict=False):
        for name in ("active_render", "active_clone"):
            if getattr(then, name) and not getattr(now, name):
                setattr(now, name, True)
    active = like.attributes.active
    mesh.attributes.active = mesh.attributes.get(active.name) if active else None


def forget() -> None:
    """Free what is kept in memory."""
    _face_corners.clear()
    _joined_faces.clear()


def face_corners(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Vertex and face of each corner of a mesh, two (c,) int32 arrays; not in Edit Mode.

    Kept for as long as a mesh that has a result has the same corners: an edit may leave as many in another order.
    """
    key, vertex = _result_key(mesh), corner_vertices(mesh)
    if key not in _face_corners or not np.array_equal(_face_corners[key][0], vertex):
        total = face_sizes(mesh)
        face = np.repeat(np.arange(len(total), dtype=np.int32), total)
        if not key[0]:
            return vertex, face
        forget()
        _face_corners[key] = vertex, face
    return _face_corners[key]


def _result_key(mesh: bpy.types.Mesh) -> tuple[str, int, int, int]:
    """What changes with the mesh once its result is stored; "" and counts before."""
    # To ask a mesh that has no result for it would give it an empty one.
    fingerprint = mesh.reeb_parts.fingerprint if mesh.is_property_set("reeb_parts") else ""
    return fingerprint, len(mesh.vertices), len(mesh.polygons), len(mesh.loops)


def corner_vertices(mesh: bpy.types.Mesh) -> np.ndarray:
    """Vertex of each corner, (c,) int32; not in Edit Mode."""
    return _corners(mesh, ".corner_vert")


def corner_edges(mesh: bpy.types.Mesh) -> np.ndarray:
    """Edge from each corner to the next of its face, (c,) int32; not in Edit Mode."""
    return _corners(mesh, ".corner_edge")


def _corners(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    """The vertex or the edge of each corner."""
    return read(mesh.attributes[name].data if len(mesh.loops) else (), "value", np.int32)


def blocks(mesh: bpy.types.Mesh) -> np.ndarray:
    """Which faces may have come to a mesh as one object, and others before or after them as others, (p,) int64 from 0.

    Blender's Join puts the faces and the vertices of each object behind those before. A block begins wherever no face
    before has a vertex as high as those of the faces from there on: an object is one block, or several if loose pieces
    of it lie behind each other.
    """
    vertex, face = face_corners(mesh)
    starts = np.flatnonzero(np.diff(face)) + 1
    highest = np.maximum.accumulate(vertex)[starts - 1]
    lowest = np.minimum.accumulate(vertex[::-1])[::-1][starts]
    begins = np.zeros(len(mesh.polygons), bool)
    begins[face[starts]] = highest < lowest
    return cumsum(begins)


def edges_of(mesh: bpy.types.Mesh, faces: np.ndarray) -> np.ndarray:
    """Which edges some faces, (p,) bool, have, (e,) bool; not in Edit Mode."""
    there = np.zeros(len(mesh.edges), bool)
    there[corner_edges(mesh)[np.repeat(faces, face_sizes(mesh))]] = True
    return there


def edge_ends(mesh: bpy.types.Mesh) -> np.ndarray:
    """The vertices of each edge, (e, 2) int32; not in Edit Mode."""
    return read(mesh.attributes[".edge_verts"].data if len(mesh.edges) else (), "value", np.int32, 2)


def corner_table(mesh: bpy.types.Mesh, points: np.ndarray | None = None) -> CornerTable:
    """The faces of a mesh corner by corner, for core; not in Edit Mode.

    points : (n, 3), positions in any coordinates; those of the basis without.
    """
    vertex, face = face_corners(mesh)
    points = basis_points(mesh) if points is None else points
    return CornerTable(points.astype(np.float64), edge_ends(mesh), vertex, corner_edges(mesh), face, len(mesh.polygons))


def mesh_of(table: CornerTable, name: str) -> bpy.types.Mesh:
    """A new mesh of the faces of a table, for the caller to remove; its edges have numbers of their own.

    Where a face has a vertex twice, as a sliver between split vertices that are joined has, the second corner has a
    vertex of its own, behind those of the table: Blender would never come to an end with such a face in Edit Mode.
    """
    mesh = bpy.data.meshes.new(name)
    starts, vertex = run_starts(table.corner_face), table.corner_vertex.copy()
    order = np.lexsort((vertex, table.corner_face))
    again = order[1:][(np.diff(vertex[order]) == 0) & (np.diff(table.corner_face[order]) == 0)]
    points = np.concatenate([table.vertices, table.vertices[vertex[again]]])
    vertex[again] = arange(len(table.vertices), len(points))
    faces = [corners.tolist() for corners in np.split(vertex, starts)[1:]]
    mesh.from_pydata(points.tolist(), [], faces)
    return mesh


def joined_table(mesh: bpy.types.Mesh, points: np.ndarray | None = None) -> CornerTable:
    """As ``corner_table``, with border vertices joined that are one for Decompose: see core.mesh.borders.

    Vertices and faces keep their numbers; edges are not those of the mesh where it has such seams. Kept as
    ``face_corners`` are.
    """
    key = _result_key(mesh)
    table = corner_table(mesh, points)
    if key in _joined_faces:
        joined = _joined_faces[key]
    else:
        basis = table if points is None else corner_table(mesh)
        joined, _ = basis.joined()
        joined = None if joined is basis else joined
        if key[0]:
            _joined_faces.clear()
            _joined_faces[key] = joined
    return table if joined is None else replace(joined, vertices=table.vertices)


def face_sizes(mesh: bpy.types.Mesh) -> np.ndarray:
    """Number of corners of each face, (p,) int32; not in Edit Mode."""
    n = len(mesh.polygons)
    if len(mesh.loops) == 3 * n:
        return np.full(n, 3, np.int32)
    # Where faces begin can be read faster than how many corners they have.
    return np.diff(read(mesh.polygons, "loop_start", np.int32), append=np.int32(len(mesh.loops)))


def face_middles(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Mean of the corners of each face, (p, 3) float64, and its area, (p,) float64; Object Mode."""
    if len(mesh.loops) != 3 * len(mesh.polygons):
        area = np.minimum(read(mesh.polygons, "area", np.float32), np.finfo(np.float32).max)  # it may be infinite
        return read(mesh.polygons, "center", np.float32, 3).astype(np.float64), area.astype(np.float64)
    # Of triangles in no order, which are a dense mesh, Blender works both out in six times the time.
    points, corners = basis_points(mesh), corner_vertices(mesh).reshape(-1, 3).T
    a, b, c = (np.take(points, corner, axis=0).astype(np.float64) for corner in corners)
    return (a + b + c) / 3.0, 0.5 * lengths(cross(b - a, c - a))


def cut_edges(mesh: bpy.types.Mesh, numbers: np.ndarray) -> np.ndarray:
    """Whether faces of different parts meet at each edge, (e,) bool; both of two edges where vertices are split."""
    table, found = joined_table(mesh), np.zeros(len(mesh.edges), bool)
    low, high = table.edge_labels(numbers)
    found[corner_edges(mesh)[(low < high)[table.corner_edge]]] = True
    return found


def basis_points(mesh: bpy.types.Mesh) -> np.ndarray:
    """Positions without shape keys, (n, 3) float32; not in Edit Mode."""
    return read(mesh.attributes["position"].data if len(mesh.vertices) else (), "vector", np.float32, 3)


def triangles(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Blender's own triangulation, and the face of each triangle; not in Edit Mode."""
    if len(mesh.loops) == 3 * len(mesh.polygons):
        return corner_vertices(mesh).reshape(-1, 3), np.arange(len(mesh.polygons), dtype=np.int32)
    return triangulated(basis_points(mesh), face_sizes(mesh), corner_vertices(mesh))


def triangulated(points: np.ndarray, count: np.ndarray, corner_vertex: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Blender's own triangulation of faces.

    Parameters
    ----------
    points : (n, 3) float32
    count : (p,) int32
        Number of corners of each face.
    corner_vertex : (c,) int32
        Vertex of each corner.

    Returns
    -------
    triangles : (t, 3) int32
    face : (t,) int32
        Rising.
    """
    three, four = count == 3, count == 4
    if three.all():
        return corner_vertex.reshape(-1, 3), np.arange(len(count), dtype=np.int32)
    if four.all():
        return _halves(points, corner_vertex.reshape(-1, 4)), np.repeat(np.arange(len(count), dtype=np.int32), 2)
    number = np.maximum(count - 2, 0)
    face = np.repeat(np.arange(len(count), dtype=np.int32), number)
    found = np.empty((len(face), 3), np.int32)
    of_three, of_four = np.repeat(three, number), np.repeat(four, number)
    found[of_three] = corner_vertex[np.repeat(three, count)].reshape(-1, 3)
    found[of_four] = _halves(points, corner_vertex[np.repeat(four, count)].reshape(-1, 4))
    if not (three | four).all():
        found[~(of_three | of_four)] = _of_larger_faces(points, count, corner_vertex)
    return found, face


def _halves(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """The two triangles of each of some quadrilaterals, (q, 4) int32, as Blender divides them: (2 q, 3) int32.

    By the diagonal from the first to the third corner, unless both others lie on the same side of it.
    """
    a, b, c, d = (np.take(points, quads[:, i], axis=0) for i in range(4))  # faster than points[...]
    with np.errstate(over="ignore", invalid="ignore"):  # infinite ones are refused later, with large ones all is well
        diagonal = c - a
        flip = row_products(cross(b - a, diagonal), cross(d - a, diagonal)) > 0
    i, j, k, m = quads.T
    return np.stack([i, j, np.where(flip, m, k), np.where(flip, j, i), k, m], axis=1).reshape(-1, 3)


def _of_larger_faces(points: np.ndarray, count: np.ndarray, corner_vertex: np.ndarray) -> np.ndarray:
    """The triangles of the faces of five corners or more, in their order; arguments as of ``triangulated``."""
    three = count <= 4
    corner = np.repeat(three, count)
    used, place = renumbered(corner_vertex[~corner])
    mesh = bpy.data.meshes.new("Reeb Parts")
    try:
        mesh.vertices.add(len(used))
        mesh.loops.add(len(place))
        mesh.polygons.add(int((~three).sum()))
        mesh.attributes["position"].data.foreach_set("vector", points[used].ravel())
        mesh.attributes[".corner_vert"].data.foreach_set("value", place.astype(np.int32))
        mesh.polygons.foreach_set("loop_start", np.cumsum(count[~three], dtype=np.int32) - count[~three])
        mesh.calc_loop_triangles()
        return used[read(mesh.loop_triangles, "vertices", np.int32, 3)]  # which Blender lists face by face
    finally:
        bpy.data.meshes.remove(mesh)


def shown_points(obj: bpy.types.Object) -> np.ndarray:
    """Positions with the shape keys as the object shows them; the basis where keys are absolute."""
    keys = obj.data.shape_keys
    if keys is None:
        return basis_points(obj.data)
    if obj.show_only_shape_key:
        return key_points(obj.active_shape_key)
    basis = key_points(keys.reference_key)
    if not keys.use_relative:
        return basis
    mix = basis.copy()
    for key in keys.key_blocks:
        if key.mute or not key.value or key == keys.reference_key:
            continue
        move = key_points(key) - key_points(key.relative_key)
        if key.vertex_group in obj.vertex_groups:
            move *= _weights(obj, key.vertex_group)[:, None]
        mix += np.float32(key.value) * move
    return mix


def key_points(key: bpy.types.ShapeKey) -> np.ndarray:
    """Positions in a shape key, (n, 3) float32; of its ``data``, Blender takes a thousand times as long."""
    return read(key.points, "co", np.float32, 3)


def set_key_points(key: bpy.types.ShapeKey, points: np.ndarray) -> None:
    """Give a shape key its positions, (n, 3) float32."""
    key.points.foreach_set("co", points.ravel())


def _weights(obj: bpy.types.Object, name: str) -> np.ndarray:
    """Weight of each vertex in a group, (n,) float32."""
    index = obj.vertex_groups[name].index
    weights = np.zeros(len(obj.data.vertices), np.float32)
    for vertex in obj.data.vertices:  # groups cannot be read in bulk
        for entry in vertex.groups:
            if entry.group == index:
                weights[vertex.index] = entry.weight
    return weights
