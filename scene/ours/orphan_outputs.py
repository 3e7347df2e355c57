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
    """Whether there are faces of parts, and all corners of those of one number have one color. numbers : (p,) int32."""
    known = (numbers > 0) & (numbers <= part_names.MAX_NUMBER)
    if not known.any():
        return False
    _, face = mesh_arrays.face_corners(mesh)
    number = numbers[face][known[face]]
    shade = mesh_arrays.read(mesh.attributes[colors.NAME].data, "color_srgb", np.float32, 4)[known[face]]
    _, first, place = np.unique(number, return_index=True, return_inverse=True)
    return bool((shade == shade[first][place]).all())


def _groups(obj: bpy.types.Object, numbers: np.ndarray) -> list[str]:
    """Vertex groups that hold the vertices of a part, each wholly and no others. numbers : (p,) int32.

    Those with the own names of parts; others, which have the names that the user gave, only where all parts have
    groups, and no other one holds the same vertices.
    """
    vertex, face = mesh_arrays.face_corners(obj.data)
    of_parts = {frozenset(vertex[numbers[face] == number].tolist()) for number in np.unique(numbers[numbers > 0])}
    region = frozenset().union(*of_parts)
    found: dict[frozenset[int], list[str]] = {}
    there = set()  # a group of one name that both meshes had holds vertices of both
    for index, weights in _weights(obj).items():
        inside = frozenset(weights) & region
        if inside in of_parts and all(weights[item] == 1.0 for item in inside):
            there.add(inside)
            if len(inside) == len(weights):
                found.setdefault(inside, []).append(obj.vertex_groups[index].name)
    named = [name for names in found.values() for name in names if _OWN_NAME.fullmatch(name)]
    if there == of_parts:
        named += [names[0] for names in found.values() if len(names) == 1 and not _OWN_NAME.fullmatch(names[0])]
    return named


def _weights(obj: bpy.types.Object) -> dict[int, dict[int, float]]:
    """The weight of each vertex in each vertex group, by their indices."""
    found: dict[int, dict[int, float]] = {group.index: {} for group in obj.vertex_groups}
    for item in obj.data.vertices if found else ():  # cannot be read in bulk
        for entry in item.groups:
            found[entry.group][item.index] = entry.weight
    return found
