# SPDX-License-Identifier: GPL-3.0-or-later
"""The vertex groups of a mesh, which Blender gives and takes by an object of it only, and meshes written beside them.

A group may get the name of an attribute that is there. But an attribute that is made, or comes from a BMesh, beside a
group of its name gets another name, or is lost (seen in 4.2 and 5.2).
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from contextlib import contextmanager

import bpy
import numpy as np
from bmesh.types import BMesh

from ..core.surface.arrays import begins_run
from . import matrix_layers
from .temporary import removed

_lent: list[bpy.types.Object] = []  # objects that are given one mesh after the other


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


def give_weights(groups: Sequence[bpy.types.VertexGroup], vertex: np.ndarray, group: np.ndarray,
                 weight: np.ndarray) -> None:
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
