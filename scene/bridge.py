# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's objects as arrays; the only reader of bmesh.

Everything is read in bulk on the main thread, so that what follows can run in any other.
"""

import hashlib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_rpt as rpt_

from ..core.sentence import Sentence
from .errors import SceneError
from .modes import check_mode


@dataclass(frozen=True, eq=False)
class Shape:
    """The geometry of an object as it is in the world, up to place and rotation.

    Attributes
    ----------
    vertices : (n, 3) float64
        Along the object's axes, in units of the world.
    triangles : (m, 3) int32
    polygon : (m,) int32
        The face of the mesh that each triangle lies in.
    stretch : (3, 3) float64
        Symmetric; takes the mesh's coordinates to ``vertices``.
    digest : str
        Equal for equal arrays.
    notes : tuple of Sentence
    """

    vertices: np.ndarray
    triangles: np.ndarray
    polygon: np.ndarray
    stretch: np.ndarray
    digest: str
    notes: tuple[Sentence, ...]


def targets(context):
    """The objects to work on: the active mesh, then other selected meshes; one per mesh.

    Raises
    ------
    SceneError
        The active object is none that can be decomposed.
    """
    active = context.view_layer.objects.active
    check_object(active)
    chosen = [active, *(o for o in context.view_layer.objects.selected if o.type == "MESH" and o != active)]
    first = {}
    for obj in chosen:
        first.setdefault(obj.data, obj)
    return list(first.values())


def check_object(obj):
    """Raise SceneError unless the object is a mesh that can be read and written."""
    if obj is None:
        raise SceneError(rpt_("There is no active object. Select a mesh and try again."))
    if obj.type != "MESH":
        raise SceneError(rpt_("{name} is not a mesh but of the type {kind}. Select a mesh and try again.").format(
            name=obj.name, kind=_kind(obj)))
    for data in (obj, obj.data):
        if data.override_library:
            raise SceneError(
                rpt_("{name} is a library override and its mesh cannot be written. Make it local (Object > "
                     "Library Override > Make Local) and try again.").format(name=data.name)
            )
        if data.library or not data.is_editable:
            source = data.library.filepath if data.library else rpt_("another file")
            raise SceneError(
                rpt_("{name} is linked from {source} and cannot be written. Make it local (Object > "
                     "Relations > Make Local) and try again.").format(name=data.name, source=source)
            )
    check_mode(obj)
    if obj.data.is_editmode and obj.mode != "EDIT":
        raise SceneError(
            rpt_("The mesh of {name} is being edited through another object. Leave Edit Mode there first.").format(
                name=obj.name)
        )


def _kind(obj) -> str:
    """What sort of object it is, in Blender's own word."""
    prop = obj.bl_rna.properties["type"]
    word = prop.enum_items[obj.type].name
    local = iface_(word, prop.translation_context)
    # Other languages may write nouns with a capital.
    return word.lower() if local == word else local


def read_shape(obj) -> Shape:
    """Read the mesh of an object: all of it, hidden or not, before any modifier."""
    mesh = obj.data
    if obj.mode == "EDIT":
        # A copy as a mesh of its own can be read in bulk; the edit mesh itself cannot.
        copy = bpy.data.meshes.new("Reeb Parts")
        try:
            edit = bmesh.from_edit_mesh(mesh).copy()
            try:
                edit.to_mesh(copy)
            finally:
                edit.free()
            points, triangles, polygon = _points(copy), *_triangles(copy)
        finally:
            bpy.data.meshes.remove(copy)
    else:
        points, triangles, polygon = shown_points(obj), *_triangles(mesh)
    stretch = world_stretch(obj)
    vertices = points.astype(np.float64)
    if not np.array_equal(stretch, np.eye(3)):
        vertices = vertices @ stretch.T
    digest = _digest(vertices, triangles, polygon)
    return Shape(vertices, triangles, polygon, stretch, digest, _notes(obj))


def world_stretch(obj) -> np.ndarray:
    """What the object's world matrix does to its mesh besides turning and moving it, (3, 3).

    The symmetric factor of the polar decomposition, rounded so that it does not change when the object
    is only rotated. A mirrored object gives that of the object itself.
    """
    matrix = np.array(obj.matrix_world, dtype=np.float64)[:3, :3]
    if not np.isfinite(matrix).all() or not matrix.any():
        return matrix
    _, scales, axes = np.linalg.svd(matrix)
    stretch = (axes.T * scales) @ axes
    return np.round(stretch, 5 - round(float(np.log10(scales.max()))))


def fingerprint(mesh) -> str:
    """Changes when the mesh is edited: its basis positions or its faces. Not in Edit Mode."""
    # The edges of the corners tell where a face ends, and can be read much faster than that.
    arrays = (_points(mesh), _corners(mesh, ".corner_vert"), _corners(mesh, ".corner_edge"),
              np.array([len(mesh.polygons)]))
    # While a slider is dragged, all is as it was a moment ago; to compare is faster than to digest.
    for known, digest in _digested:
        if all(np.array_equal(a.view(np.int32), b.view(np.int32)) for a, b in zip(arrays, known, strict=True)):
            return digest
    _digested[:] = [(arrays, _digest(*arrays))]
    return _digested[0][1]


def face_corners(mesh) -> tuple[np.ndarray, np.ndarray]:
    """Vertex and face of each corner of a mesh, two (c,) int32 arrays; not in Edit Mode.

    Kept for as long as the stored result is that of the mesh: the caller has made sure of that, or has
    just stored it.
    """
    result = mesh.reeb_parts
    key = (result.fingerprint, len(mesh.vertices), len(mesh.polygons), len(mesh.loops))
    if key not in _face_corners:
        total = np.empty(len(mesh.polygons), np.int32)
        mesh.polygons.foreach_get("loop_total", total)
        face = np.repeat(np.arange(len(total), dtype=np.int32), total)
        corners = _corners(mesh, ".corner_vert"), face
        if not result.fingerprint:
            return corners
        _face_corners.clear()
        _face_corners[key] = corners
    return _face_corners[key]


def corner_edges(mesh) -> np.ndarray:
    """Edge from each corner to the next of its face, (c,) int32; not in Edit Mode."""
    return _corners(mesh, ".corner_edge")


def face_graph(obj) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """How the faces of an object's mesh lie beside each other; Object Mode.

    Returns
    -------
    area : (p,) float64
        Of each face, in units of the world.
    pairs : (e, 2) int32
        Faces that share an edge.
    length : (e,) float64
        Of that edge.
    """
    shape = read_shape(obj)
    a, b, c = shape.vertices[shape.triangles].transpose(1, 0, 2)
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    pairs, edge = face_pairs(obj.data)
    start, end = shape.vertices[edge_ends(obj.data)[edge]].transpose(1, 0, 2)
    return np.bincount(shape.polygon, area, len(obj.data.polygons)), pairs, np.linalg.norm(end - start, axis=1)


def face_pairs(mesh) -> tuple[np.ndarray, np.ndarray]:
    """Faces that share an edge, (e, 2) int32, and the edge, (e,) int32; Object Mode."""
    _, face = face_corners(mesh)
    edge = corner_edges(mesh)
    order = np.argsort(edge, kind="stable")
    together = np.flatnonzero(np.diff(edge[order]) == 0)
    first, second = order[together], order[together + 1]
    return np.stack([face[first], face[second]], axis=1), edge[first]


def edge_ends(mesh) -> np.ndarray:
    """The vertices of each edge, (e, 2) int32; not in Edit Mode."""
    ends = np.empty(2 * len(mesh.edges), np.int32)
    mesh.edges.foreach_get("vertices", ends)
    return ends.reshape(-1, 2)


def edge_labels(mesh, labels) -> tuple[np.ndarray, np.ndarray]:
    """The smallest and the largest label of the faces at each edge, two (e,) int64 arrays.

    labels : (p,) int64. An edge of no face has the smallest above the largest.
    """
    edge, (_, face) = corner_edges(mesh), face_corners(mesh)
    low, high = np.full(len(mesh.edges), np.iinfo(np.int64).max), np.full(len(mesh.edges), -1, np.int64)
    np.minimum.at(low, edge, labels[face])
    np.maximum.at(high, edge, labels[face])
    return low, high


def face_means(mesh, values) -> np.ndarray:
    """Mean over the corners of each face of what each vertex has: (n,) to (p,), or (n, k) to (p, k)."""
    vertex, face = face_corners(mesh)
    count = len(mesh.polygons)
    total = np.bincount(face, minlength=count)
    means = [np.bincount(face, column, count) / total for column in np.atleast_2d(values.T)[:, vertex]]
    return np.stack(means, axis=1) if values.ndim > 1 else means[0]


def face_centers(obj) -> np.ndarray:
    """Mean of the corners of each face, (p, 3) float64, along the object's axes in units of the world."""
    return face_means(obj.data, shown_points(obj).astype(np.float64) @ world_stretch(obj).T)


_face_corners: dict[tuple, tuple[np.ndarray, np.ndarray]] = {}
_digested: list[tuple[tuple[np.ndarray, ...], str]] = []


def forget():
    """Free what is kept in memory."""
    _face_corners.clear()
    _digested.clear()


def _corners(mesh, name) -> np.ndarray:
    """The vertex or the edge of each corner."""
    corners = np.empty(len(mesh.loops), np.int32)
    if len(corners):
        mesh.attributes[name].data.foreach_get("value", corners)
    return corners


def _digest(*arrays) -> str:
    digest = hashlib.blake2b(digest_size=16)
    with ThreadPoolExecutor() as pool:  # hashing large arrays leaves the interpreter to the others
        for array, part in zip(arrays, pool.map(_digest_of, arrays), strict=True):
            digest.update(str(array.shape).encode() + part)
    return digest.hexdigest()


def _digest_of(array) -> bytes:
    return hashlib.blake2b(np.ascontiguousarray(array), digest_size=16).digest()


def _points(mesh) -> np.ndarray:
    points = np.empty(3 * len(mesh.vertices), np.float32)
    if len(points):
        mesh.attributes["position"].data.foreach_get("vector", points)
    return points.reshape(-1, 3)


def _triangles(mesh) -> tuple[np.ndarray, np.ndarray]:
    """Blender's own triangulation, and the face of each triangle."""
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    polygon = np.empty(len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("polygon_index", polygon)
    return triangles.reshape(-1, 3), polygon


def shown_points(obj) -> np.ndarray:
    """Positions with the shape keys as the object shows them; the basis where keys are absolute."""
    keys = obj.data.shape_keys
    if keys is None:
        return _points(obj.data)
    if obj.show_only_shape_key:
        return _key_points(obj.active_shape_key)
    basis = _key_points(keys.reference_key)
    if not keys.use_relative:
        return basis
    mix = basis.copy()
    for key in keys.key_blocks:
        if key.mute or not key.value or key == keys.reference_key:
            continue
        move = _key_points(key) - _key_points(key.relative_key)
        if key.vertex_group in obj.vertex_groups:
            move *= _weights(obj, key.vertex_group)[:, None]
        mix += np.float32(key.value) * move
    return mix


def _key_points(key) -> np.ndarray:
    points = np.empty(3 * len(key.data), np.float32)
    key.data.foreach_get("co", points)
    return points.reshape(-1, 3)


def _weights(obj, name) -> np.ndarray:
    """Weight of each vertex in a group, (n,) float32."""
    index = obj.vertex_groups[name].index
    weights = np.zeros(len(obj.data.vertices), np.float32)
    for vertex in obj.data.vertices:  # groups cannot be read in bulk
        for entry in vertex.groups:
            if entry.group == index:
                weights[vertex.index] = entry.weight
    return weights


def _notes(obj) -> tuple[Sentence, ...]:
    notes = []
    # One of ours only moves the parts in the view.
    count = sum(not modifier.name.startswith("Reeb Parts") for modifier in obj.modifiers)
    if count == 1:
        notes.append(Sentence("{name} was decomposed as it is before its modifier was applied.", name=obj.name))
    elif count:
        notes.append(Sentence("{name} was decomposed as it is before its {n} modifiers were applied.",
                              name=obj.name, n=count))
    if obj.data.users > 1 and (users := _users(obj.data)) > 1:
        notes.append(Sentence("{n} objects share this mesh; all of them show its parts.", n=users))
    return tuple(notes)


def _users(mesh) -> int:
    return sum(obj.data == mesh for obj in bpy.data.objects)
