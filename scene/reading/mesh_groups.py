# SPDX-License-Identifier: GPL-3.0-or-later
"""The vertex groups of a mesh, which Blender gives and takes by an object of it only, and meshes written beside them.

A group may get the name of an attribute that is there. But an attribute that is made, or comes from a BMesh, beside a
group of its name gets another name, or is lost (seen in 4.2 and 5.2).
"""

from __future__ import annotations

import json
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager

import bpy
import numpy as np
from bmesh.types import BMesh

from ...core.arrays.indexing import begins_run
from ..temporary import removed
from . import fingerprints, matrix_layers

WEIGHTS = "reeb_parts_weights"  # on a mesh: the names of the groups with the weights of our armature, as JSON
MADE = "reeb_parts_weights_digest"  # and how many vertices it had, and what weights, when we wrote them

_lent: list[bpy.types.Object] = []  # objects that are given one mesh after the other


def of_weights(mesh: bpy.types.Mesh) -> list[str]:
    """The names of the groups that hold the weights of our armature, if these are others than the parts' groups."""
    try:
        return [str(name) for name in json.loads(mesh.get(WEIGHTS, "[]"))]
    except (ValueError, TypeError):  # not written by us
        return []


def mark_weights(mesh: bpy.types.Mesh) -> None:
    """Remember what the weights of our armature are, now that they are written; Object Mode."""
    mesh[MADE] = f"{len(mesh.vertices)} {_digest(mesh)}"


def weights_were_changed(mesh: bpy.types.Mesh, of_other_vertices: bool) -> bool:
    """Whether the weights of our armature are others than we wrote; Object Mode.

    of_other_vertices : the answer if they are and there are more vertices, or fewer, since then Blender has made some.
    """
    count, _, known = str(mesh.get(MADE, "")).partition(" ")
    if not known or _digest(mesh) == known:  # earlier versions kept nothing
        return False
    return True if count == str(len(mesh.vertices)) else of_other_vertices


def _digest(mesh: bpy.types.Mesh) -> str:
    """Differs once a weight of our armature has changed, or one of its groups got another name."""
    names = of_weights(mesh)
    with twin(mesh) as obj:
        there = {group.name: group.index for group in obj.vertex_groups}
    place = {there[name]: index for index, name in enumerate(names) if name in there}
    found = [(place[entry.group], vertex.index, entry.weight) for vertex in mesh.vertices
             for entry in vertex.groups if entry.group in place]  # cannot be read in bulk
    return fingerprints.digest(np.array(sorted(found), np.float64), np.array(sorted(place.values()), np.int64))


@contextmanager
def one_twin() -> Iterator[None]:
    """Read and make many meshes inside: Blender gives and takes vertex groups by an object of the mesh only, and to
    make and remove one for each takes the longer the more there is in the file."""
    empty = bpy.data.meshes.new("Reeb Parts")
    lent = bpy.data.objects.new("Reeb Parts", empty)
    with removed(bpy.data.meshes, empty), removed(bpy.data.objects, lent):
        _lent.append(lent)
        try:
            yield
        finally:
            _lent.remove(lent)


@contextmanager
def twin(mesh: bpy.types.Mesh) -> Iterator[bpy.types.Object]:
    """An object of a mesh, in no scene, for a moment."""
    if _lent:
        found = _lent[-1]
        own = found.data
        found.data = mesh
        try:
            yield found
        finally:
            found.data = own  # to remove a mesh is to remove its objects
    else:
        made = bpy.data.objects.new("Reeb Parts", mesh)
        with removed(bpy.data.objects, made):
            yield made


@contextmanager
def beside(mesh: bpy.types.Mesh, names: Container[str]) -> Iterator[None]:
    """Write attributes with some names inside: groups with such names are called otherwise for that long."""
    with twin(mesh) as obj:
        former = {group.index: group.name for group in obj.vertex_groups if group.name in names}
        for index in former:
            obj.vertex_groups[index].name = "\1Reeb Parts"
        try:
            yield
        finally:
            for index, name in former.items():
                obj.vertex_groups[index].name = name


def names_of(mesh: bpy.types.Mesh) -> list[str]:
    """The names of all groups of a mesh."""
    with twin(mesh) as obj:
        return list(obj.vertex_groups.keys())


def empty_without(mesh: bpy.types.Mesh, names: Container[str]) -> None:
    """Take all weights off a mesh, and the groups of some names; at once, where each takes as long as all."""
    with twin(mesh) as obj:
        stay = [(group.name, group.lock_weight) for group in obj.vertex_groups if group.name not in names]
        active = obj.vertex_groups.active
        active_name = "" if active is None else active.name
        obj.vertex_groups.clear()
        for name, locked in stay:
            obj.vertex_groups.new(name=name).lock_weight = locked
        if active_name in obj.vertex_groups:
            obj.vertex_groups.active_index = obj.vertex_groups[active_name].index


def of_names(obj: bpy.types.Object, names: Sequence[str], used: Iterable[int]) -> dict[int, bpy.types.VertexGroup]:
    """Groups of an object, by their places among names; made where they are not there.

    names : of all that there may be. used : the places of those that vertices are in. To these come those of the other
    side, be they empty, which a Mirror modifier needs.
    """
    place = {name: index for index, name in enumerate(names)}
    wanted = set(used)
    wanted |= {place[name] for index in wanted if (name := bpy.utils.flip_name(names[index])) in place}
    there = set(obj.vertex_groups.keys())
    return {index: obj.vertex_groups[names[index]] if names[index] in there
            else obj.vertex_groups.new(name=names[index]) for index in sorted(wanted)}


def give_weights(groups: Sequence[bpy.types.VertexGroup] | Mapping[int, bpy.types.VertexGroup], vertex: np.ndarray,
                 group: np.ndarray, weight: np.ndarray) -> None:
    """Give vertices weights, (k,) each: all that have one weight in a group at once, as Blender takes them.

    group : (k,) int, places in ``groups``.
    """
    order = np.lexsort((vertex, weight, group))
    vertex, group, weight = vertex[order], group[order], weight[order]
    first = np.flatnonzero(begins_run(group) | begins_run(weight))
    for start, some in zip(first.tolist(), np.split(vertex, first)[1:], strict=True):
        groups[group[start]].add(some.tolist(), float(weight[start]), "REPLACE")


def write(bm: BMesh, mesh: bpy.types.Mesh) -> None:
    """Write a BMesh to a mesh in Object Mode.

    Where a vertex is apart from its first shape, be it by rounding, Blender may move its other shapes by as much, and
    does so on some runs and not on others (seen in 4.2). New vertices often are.
    """
    for basis in bm.verts.layers.shape.values()[:1]:
        for vertex in bm.verts:
            vertex[basis] = vertex.co
    with beside(mesh, mesh.attributes.keys()):
        bm.to_mesh(mesh)
    matrix_layers.join(mesh)
