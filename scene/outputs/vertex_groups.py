# SPDX-License-Identifier: GPL-3.0-or-later
"""A vertex group for each part: written, kept up to date, taken back; Object Mode.

Blender has no way to write weights in bulk but a list of vertices per group, so only what changes is written.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass

import bpy
import numpy as np

from ...core.arrays.indexing import run_starts
from ...core.arrays.int64 import arange
from ...core.result.numbering import NumberedParts
from .. import targets, transaction
from ..ours import made_objects
from ..reading import mesh_arrays
from ..result import part_names


@dataclass(frozen=True, eq=False)
class Grains:
    """Which vertices the faces of each candidate have; a vertex on a cut is one of several candidates.

    Attributes
    ----------
    inner : (k,) int32
        Vertices of one candidate alone, those of the first candidate first.
    bounds : (c + 1,) int64
        Where those of each candidate start, and the end.
    shared : (e, 2) int64
        Candidate and vertex, of the other vertices.
    """

    inner: np.ndarray
    bounds: np.ndarray
    shared: np.ndarray

    @classmethod
    def of(cls, vertex: np.ndarray, candidate: np.ndarray) -> Grains:
        """From the vertex and the candidate of each corner, two (k,) integer arrays."""
        n_vertices, count = int(vertex.max(initial=-1)) + 1, int(candidate.max(initial=-1)) + 1
        # Small whole numbers are sorted much faster.
        one = np.full(n_vertices, count, np.int16 if count < 2**15 else np.int32)
        one[vertex] = candidate
        other = np.flatnonzero(one[vertex] != candidate)
        mixed = np.zeros(n_vertices, bool)
        mixed[vertex[other]] = True
        several = np.flatnonzero(mixed)
        pairs = np.concatenate([candidate[other].astype(np.int64) * n_vertices + vertex[other],
                                one[several].astype(np.int64) * n_vertices + several])
        one[several] = count
        inner = np.argsort(one, kind="stable").astype(np.int32)
        bounds = np.searchsorted(one[inner], arange(count + 1))
        return cls(inner, bounds, np.column_stack(np.divmod(np.unique(pairs), max(n_vertices, 1))))

    def changes(self, before: np.ndarray, after: np.ndarray) -> tuple[dict, dict]:
        """Which vertices come to which parts, and which go.

        A vertex is in every part that has a face there, so that parts share those on cuts.

        Parameters
        ----------
        before, after : (c,) int
            Number of each candidate's part; 0 for none.

        Returns
        -------
        come, gone : dict of number -> (k,) int
        """
        candidate, vertex = self.shared.T
        width = int(vertex.max(initial=-1)) + 1
        near = np.zeros(width, bool)
        near[vertex[(before != after)[candidate]]] = True
        candidate, vertex = candidate[near[vertex]], vertex[near[vertex]]
        old, new = (np.unique(numbers[candidate].astype(np.int64) * width + vertex) for numbers in (before, after))
        moved = np.flatnonzero(before != after).tolist()
        found = []
        for numbers, mine, others in ((after, new, old), (before, old, new)):
            lists: dict[int, list[np.ndarray]] = {}
            for index in moved:
                inside = self.inner[self.bounds[index] : self.bounds[index + 1]]
                lists.setdefault(int(numbers[index]), []).append(inside)
            number, there = np.divmod(np.setdiff1d(mine, others, assume_unique=True), max(width, 1))
            start = run_starts(number)
            for first, vertices in zip(number[start].tolist(), np.split(there, start)[1:], strict=True):
                lists.setdefault(first, []).append(vertices)
            found.append({number: np.concatenate(there) for number, there in lists.items() if number > 0})
        come, gone = found
        return come, gone


_grains: list[tuple[np.ndarray, np.ndarray, Grains]] = []  # the last, with what it was made of


def grains(mesh: bpy.types.Mesh, candidates: np.ndarray) -> Grains:
    """The grains of a mesh, kept for the next step of a drag. candidates : (p,) int64, of each face."""
    vertex, face = mesh_arrays.face_corners(mesh)
    if not _grains or _grains[0][0] is not vertex or _grains[0][1] is not candidates:
        _grains[:] = [(vertex, candidates, Grains.of(vertex, candidates.astype(np.int32)[face]))]
    return _grains[0][2]


def forget() -> None:
    """Free what is kept in memory."""
    _grains.clear()


def add(obj: bpy.types.Object) -> None:
    """Let there be groups from the next update on."""
    obj.data.reeb_parts.has_groups = True


def write(obj: bpy.types.Object, numbered: NumberedParts, before: np.ndarray | None = None) -> None:
    """Make each part's group hold the part's vertices, if there are to be groups.

    before : (c,) int64, the candidates' numbers as they are written now, if that is known.
    """
    if not obj.data.reeb_parts.has_groups:
        return
    parts = {part.number: part for part in obj.data.reeb_parts.parts}
    taken = taken_names(targets.users(obj.data))
    _take_names(obj, taken)
    groups = {group.name: group for group in obj.vertex_groups}  # to look a name up there goes through all of them
    fresh = [number for number, part in parts.items() if part.group not in groups]
    after = numbered.candidate_numbers
    made = grains(obj.data, numbered.candidates)
    come, gone = made.changes(np.zeros_like(after) if before is None else before, after)
    if before is not None and np.isin(before, fresh).any():
        # The user has deleted a group: all of it comes back, and the others change as ever.
        whole, _ = made.changes(np.zeros_like(after), after)
        come |= {number: whole[number] for number in fresh}
    active = obj.vertex_groups.active_index
    for number in sorted(parts):
        part = parts[number]
        group = groups.get(part.group)
        if group is None:
            group = obj.vertex_groups.new(name=part_names.distinct(part.name, taken))
            part.group = group.name
        if number in gone:
            group.remove(gone[number].tolist())
        if number in come:
            group.add(come[number].tolist(), 1.0, "REPLACE")
    if active < 0:  # there were none
        shown = obj.data.reeb_parts.parts[obj.data.reeb_parts.active :][:1]
        active = obj.vertex_groups[shown[0].group].index if shown else active
    obj.vertex_groups.active_index = active


def remove_one(obj: bpy.types.Object, name: str) -> None:
    """Remove a group, if it is there; Blender keeps another one that is active."""
    group = obj.vertex_groups.get(name) if name else None
    if group is not None:
        obj.vertex_groups.remove(group)


def remove(obj: bpy.types.Object) -> None:
    """Remove the vertex groups that were made, and no other."""
    result = obj.data.reeb_parts
    if {part.group for part in result.parts} >= set(obj.vertex_groups.keys()):
        obj.vertex_groups.clear()  # at once, where each takes as long as all
    for part in result.parts:
        remove_one(obj, part.group)
        part.group = ""
    result.has_groups = False


def bones_that_move(objects: list[bpy.types.Object], ours: bool = False) -> set[str]:
    """Names of bones of the user's armatures that move some objects: a bone moves what is in a group of its name.

    ours : whether armatures that we made count, too.
    """
    rigs = {modifier.object for obj in objects for modifier in obj.modifiers if modifier.type == "ARMATURE"}
    rigs |= {obj.parent for obj in objects if obj.parent_type == "ARMATURE"}
    return {bone.name for rig in rigs if rig is not None and rig.type == "ARMATURE"
            and (ours or made_objects.ROLE not in rig) for bone in rig.data.bones if bone.use_deform}


def taken_names(objects: list[bpy.types.Object]) -> set[str]:
    """Names that none of our groups gets: those of bones that move some objects, and of attributes of their mesh.

    Where a group has the name of an attribute, as of a UV map, Blender 5 drops the attribute when Edit Mode is entered,
    and nodes of older ones are given the group in its place.
    """
    return bones_that_move(objects).union(*(obj.data.attributes.keys() for obj in objects[:1]))


def _take_names(obj: bpy.types.Object, taken: Container[str]) -> None:
    """Give the groups that are there the names of their parts, which may have been those of each other."""
    there = set(obj.vertex_groups.keys())
    wrong = [part for part in obj.data.reeb_parts.parts if part.group in there and _is_misnamed(obj, part)]
    for part in wrong:
        group = obj.vertex_groups[part.group]
        group.name = "\1Reeb Parts"  # no name is in the way of another one
        part.group = group.name
    for part in wrong:
        rename(obj, part, taken)


def rename(obj: bpy.types.Object, part: bpy.types.PropertyGroup, taken: Container[str]) -> None:
    """Give the part's vertex group the part's name, or the nearest that is free.

    taken : the taken_names() of the objects of the mesh.
    """
    transaction.keep_mesh(obj.data)
    if part.group in obj.vertex_groups and _is_misnamed(obj, part):
        group = obj.vertex_groups[part.group]
        group.name = part_names.distinct(part.name, taken)
        part.group = group.name


def _is_misnamed(obj: bpy.types.Object, part: bpy.types.PropertyGroup) -> bool:
    """Whether the part's vertex group has not the part's name, or that of an attribute, as one of an older file may."""
    return part.group != part.name or part.group in obj.data.attributes
