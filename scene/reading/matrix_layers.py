# SPDX-License-Identifier: GPL-3.0-or-later
"""A BMesh of a mesh with all that it carries, matrices too.

Below Blender 5.0 a BMesh with an attribute of matrices crashes Blender when an edge or a face is divided: for as long
as there is a BMesh, each matrix is eight layers, each of half a row.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bmesh
import bpy
import numpy as np
from bmesh.types import BMesh

from ..temporary import freed
from .mesh_arrays import attribute_values, set_attribute_values

_MATRIX, _HALF_ROW = "FLOAT4X4", "INT32_2D"  # the bits of two numbers, which nothing mixes, as nothing does matrices
_MARKS = [f"\1{place}" for place in range(8)]  # how the names of the half rows begin, which no user can type


@contextmanager
def as_bmesh(mesh: bpy.types.Mesh, normals: bool = False) -> Iterator[BMesh]:
    """A BMesh of a mesh in Object Mode, for a while; ``mesh_groups.write`` writes it. normals : whether it has them."""
    split(mesh)
    try:
        with freed(bmesh.new()) as bm:
            bm.from_mesh(mesh, face_normals=normals, vertex_normals=normals)
            yield bm
    finally:
        join(mesh)


def split(mesh: bpy.types.Mesh) -> None:
    """Make eight layers of each attribute of matrices, where a BMesh cannot have it."""
    if bpy.app.version >= (5, 0):
        return
    for name in [attribute.name for attribute in mesh.attributes if attribute.data_type == _MATRIX]:
        attribute = mesh.attributes[name]
        domain, bits = attribute.domain, attribute_values(attribute).view(np.int32)
        mesh.attributes.remove(attribute)
        for place, mark in enumerate(_MARKS):
            new = mesh.attributes.new(mark + name, _HALF_ROW, domain)
            set_attribute_values(new, np.ascontiguousarray(bits[:, 2 * place : 2 * place + 2]))


def join(mesh: bpy.types.Mesh) -> None:
    """Make matrices again of what ``split`` made."""
    for first in [attribute.name for attribute in mesh.attributes if attribute.name.startswith(_MARKS[0])]:
        name = first.removeprefix(_MARKS[0])
        layers = [mark + name for mark in _MARKS]
        bits = np.concatenate([attribute_values(mesh.attributes[layer]) for layer in layers], axis=1)
        domain = mesh.attributes[first].domain
        for layer in layers:
            mesh.attributes.remove(mesh.attributes[layer])
        bits[~bits.any(axis=1)] = np.eye(4, dtype=np.float32).view(np.int32).ravel()  # as Blender has it on what is new
        set_attribute_values(mesh.attributes.new(name, _MATRIX, domain), bits.view(np.float32))
