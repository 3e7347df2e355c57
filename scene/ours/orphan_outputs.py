# SPDX-License-Identifier: GPL-3.0-or-later
"""What of ours a mesh has beside a result of its own: that of an object that was joined into it with Blender's Join.

The attributes, groups and slots come along, but not what says whose they are. So they are taken for ours only where
they fit together: the numbers of the parts with their colors, and groups that hold the vertices of their parts. Where
the mesh has a result, its own outputs stay; the joined faces have nothing kept aside as its own ones have, so that what
they have of the user's is.
"""

from __future__ import annotations

import re

import bpy
import numpy as np

from ...core.arrays.int64 import arange
from .. import store, targets, transaction
from ..outputs import colors, face_attribute, face_sets, field, materials, seams, vertex_groups
from ..outputs.kept_aside import find_attribute, remove_attribute
from ..reading import fingerprints, mesh_arrays
from ..result import part_names
from ..showing import hidden

_OWN_NAME = re.compile(r"Part \d\d+(\.[LR])?")  # see core/result/numbering.py


def may_be(mesh: bpy.types.Mesh) -> bool:
    """Whether a mesh has no result and attributes as ours: a quick look."""
    return not store.has_result(mesh) and _has_both(mesh)


def _has_both(mesh: bpy.types.Mesh) -> bool:
    """Whether a mesh has numbers and colors of parts, by the names that we give these."""
    kinds = ((face_attribute.NAME, "INT", "FACE"), (colors.NAME, "BYTE_COLOR", "CORNER"))
    return all(find_attribute(mesh, *kind) for kind in kinds)


def remove(obj: bpy.types.Object) -> bool:
    """Remove what of ours is left on the mesh of an object, if it is certainly ours; Object Mode. Whether it was."""
    mesh = obj.data
    if store.has_result(mesh):
        return len(mesh.polygons) > mesh.reeb_parts.n_faces and _remove_joined(obj)
    if not may_be(mesh):
        return False
    numbers = _numbers(mesh)
    if not _one_color_each(mesh, numbers):
        return False
    transaction.keep_mesh(mesh)
    user = targets.users(mesh)[0]
    for name in _groups(user, numbers):
        vertex_groups.remove_one(user, name)
    ours = numbers > 0
    seams.take_back(mesh, ours)
    face_sets.take_back(mesh, numbers)
    materials.take_back(mesh, ours)
    hidden.remove_attributes(mesh)
    if find_attribute(mesh, field.NAME, "FLOAT", "POINT"):
        remove_attribute(mesh, field.NAME)
    for name in (colors.NAME, face_attribute.NAME):
        remove_attribute(mesh, name)
    mesh.update()
    return True


def settle_joined(obj: bpy.types.Object) -> None:
    """Settle what of ours came with the faces that Join has brought to a mesh with a result; Object Mode.

    Until the mesh is edited, they are known by their places; from then on the numbers of parts on them, which are those
    of another list, would be taken for the mesh's own.
    """
    mesh = obj.data
    written = face_attribute.find(mesh)
    if written is None or written.name != face_attribute.NAME:  # else theirs is not in ours
        return
    numbers = _numbers(mesh)
    known = (numbers > 0) & (numbers <= part_names.MAX_NUMBER)  # what is stored may be damaged
    joined = joined_faces(mesh, np.where(known, numbers, 0)) & known
    copies = known & ~joined & (arange(len(numbers)) >= mesh.reeb_parts.n_faces)
    transaction.keep_mesh(mesh)
    face_sets.lower(mesh, np.where(copies, numbers, 0))
    if joined.any():
        _remove_joined(obj)
        mesh.attributes[face_attribute.NAME].data.foreach_set("value", np.where(joined, 0, numbers).astype(np.int32))


def joined_faces(mesh: bpy.types.Mesh, numbers: np.ndarray) -> np.ndarray:
    """Which faces Join has brought from other meshes to one with a result that was not edited before, (p,) bool.

    It puts them behind the mesh's own, as Array and Duplicate do with copies, of which there are whole parts.

    numbers : (p,) int, of the part of each face.
    """
    result, n = mesh.reeb_parts, mesh.reeb_parts.n_faces
    if len(numbers) <= n or not fingerprints.begins_as(mesh, result.fingerprint, result.n_vertices, n):
        return np.zeros(len(numbers), bool)
    width = int(numbers.max()) + 1
    own, more = (np.bincount(faces, minlength=width) for faces in (numbers[:n], numbers[n:]))
    foreign = (own == 0) | (more % np.maximum(own, 1) > 0)
    return (arange(len(numbers)) >= n) & foreign[numbers]


def _remove_joined(obj: bpy.types.Object) -> bool:
    """What ``remove`` does for a mesh that has a result, and faces behind those of the result."""
    mesh, result = obj.data, obj.data.reeb_parts
    numbers = _numbers(mesh) if _has_both(mesh) else np.zeros(len(mesh.polygons), np.int32)
    new = arange(len(mesh.polygons)) >= result.n_faces
    numbers[~new] = 0
    transaction.keep_mesh(mesh)
    joined = bool(materials.of_others(mesh))
    if _one_color_each(mesh, numbers):
        joined |= _remove_groups(obj, numbers) | face_sets.came_by_join(mesh, numbers)
        if joined:  # else the faces may be extruded ones of the mesh itself
            face_sets.take_back(mesh, numbers)
        seams.take_back(mesh, numbers > 0)
    if joined or not result.has_materials:
        materials.take_back(mesh, numbers > 0 if numbers.any() else new)
    face_sets.keep(mesh, new, np.zeros_like(numbers) if joined else numbers)
    return joined


def _remove_groups(obj: bpy.types.Object, numbers: np.ndarray) -> bool:
    """Remove the vertex groups of another mesh's parts, which have the numbers, (p,) int32. Whether there were any."""
    user, own = targets.users(obj.data)[0], {part.group for part in obj.data.reeb_parts.parts}
    names = [name for name in _groups(user, numbers) if name not in own]
    for name in names:
        vertex_groups.remove_one(user, name)
    return bool(names)


def _numbers(mesh: bpy.types.Mesh) -> np.ndarray:
    """The number of each face's part, (p,) int32, as the attribute has it."""
    return mesh_arrays.read(mesh.attributes[face_attribute.NAME].data, "value", np.int32)


def _one_color_each(mesh: bpy.types.Mesh, numbers: np.ndarray) -> bool:
    """Whether there are faces of parts, and corners of one number have one color in each object that Join has brought.

    numbers : (p,) int32.
    """
    known = (numbers > 0) & (numbers <= part_names.MAX_NUMBER)
    return bool(known.any()) and _same_colors(mesh, np.where(known, numbers, 0), mesh_arrays.blocks(mesh))


def _same_colors(mesh: bpy.types.Mesh, numbers: np.ndarray, block: np.ndarray) -> bool:
    """Whether all corners of faces of one number and block have one color. Both (p,) int; number 0 is no part."""
    _, face = mesh_arrays.face_corners(mesh)
    corner = numbers[face] > 0
    cell = (block * (part_names.MAX_NUMBER + 1) + numbers)[face][corner]
    shade = mesh_arrays.read(mesh.attributes[colors.NAME].data, "color_srgb", np.float32, 4)[corner]
    _, first, place = np.unique(cell, return_index=True, return_inverse=True)
    return bool((shade == shade[first][place]).all())


def _groups(obj: bpy.types.Object, numbers: np.ndarray) -> list[str]:
    """Vertex groups that hold the vertices of a part, each wholly and no others. numbers : (p,) int32.

    Those with the own names of parts; others, which have the names that the user gave, only where all parts have
    groups, and no other one holds the same vertices. Where several objects with parts were joined, a group of a name
    that they share holds a part of each.
    """
    weights = _weights(obj)
    named, complete = _groups_of(obj, weights, numbers, np.zeros(len(numbers), np.int64))
    if not complete:
        named += _groups_of(obj, weights, numbers, mesh_arrays.blocks(obj.data))[0]
    return list(dict.fromkeys(named))


def _groups_of(obj: bpy.types.Object, weights: dict[int, dict[int, float]], numbers: np.ndarray,
               block: np.ndarray) -> tuple[list[str], bool]:
    """What ``_groups`` tells of parts that are each in one block of faces, (p,) int64, and whether all have groups."""
    vertex, face = mesh_arrays.face_corners(obj.data)
    vertex_block = np.zeros(len(obj.data.vertices), np.int64)
    vertex_block[vertex] = block[face]
    parts = _vertices_of_parts(vertex, numbers[face], block[face])
    region = frozenset().union(*parts)
    found: dict[frozenset[int], list[str]] = {}
    held: dict[str, list[frozenset[int]]] = {}
    there = set()  # a group of one name that both meshes had holds vertices of both
    for index, of_group in weights.items():
        inside = _by_block(frozenset(of_group) & region, vertex_block)
        if parts.issuperset(inside) and all(of_group[item] == 1.0 for items in inside for item in items):
            there.update(inside)
            if inside and sum(map(len, inside)) == len(of_group):
                name = obj.vertex_groups[index].name
                held[name] = inside
                for items in inside:
                    found.setdefault(items, []).append(name)
    named = [name for name in held if _OWN_NAME.fullmatch(name)]
    if there == parts:
        named += [name for name in held if name not in named and all(found[items] == [name] for items in held[name])]
    return named, there == parts


def _vertices_of_parts(vertex: np.ndarray, number: np.ndarray, block: np.ndarray) -> set[frozenset[int]]:
    """The vertices of each part in each block. All (corners,) int; a number of 0 or less is no part."""
    known = number > 0
    order = np.lexsort((number[known], block[known]))
    vertex, number, block = (values[known][order] for values in (vertex, number, block))
    ends = np.flatnonzero((np.diff(number) != 0) | (np.diff(block) != 0)) + 1
    return {frozenset(some.tolist()) for some in np.split(vertex, ends) if len(some)}


def _by_block(vertices: frozenset[int], vertex_block: np.ndarray) -> list[frozenset[int]]:
    """Some vertices, those of each block by themselves. vertex_block : (n,) int64."""
    found: dict[int, set[int]] = {}
    for item in vertices:
        found.setdefault(int(vertex_block[item]), set()).add(item)
    return [frozenset(some) for some in found.values()]


def _weights(obj: bpy.types.Object) -> dict[int, dict[int, float]]:
    """The weight of each vertex in each vertex group, by their indices."""
    found: dict[int, dict[int, float]] = {group.index: {} for group in obj.vertex_groups}
    for item in obj.data.vertices if found else ():  # cannot be read in bulk
        for entry in item.groups:
            found[entry.group][item.index] = entry.weight
    return found
