# SPDX-License-Identifier: GPL-3.0-or-later
"""Pegs and holes as meshes, and Blender's own booleans between them and pieces."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...core.arrays.int64 import cumsum
from ..pieces.closing import caps
from ..reading import mesh_arrays
from ..reading.modified import evaluated_mesh
from ..temporary import removed

if TYPE_CHECKING:
    from ...core.uses.joints.room import Joint, Wanted
    from ...core.uses.joints.shapes import Solid


def solid_of(joint: Joint, wanted: Wanted, hole: bool) -> Solid:
    """A peg, or what it goes into, in its place."""
    from ...core.uses.joints.shapes import solid

    hole = hole or wanted.kind.both_sides
    made = solid(wanted.kind, joint.radius, joint.low - joint.foot, joint.high + joint.depth,
                 wanted.clearance if hole else 0.0)
    return replace(made, points=joint.origin + made.points @ joint.axes)


def dowel(joint: Joint, wanted: Wanted, to_mesh: np.ndarray) -> bpy.types.Mesh:
    """A dowel as a mesh, in its place."""
    made = replace(wanted, clearance=0.0)
    found = solid_of(joint, made, True)
    mesh = bpy.data.meshes.new("Dowel")
    mesh.from_pydata((found.points @ to_mesh.T).tolist(), [], found.faces)
    return mesh


def with_solids(context: bpy.types.Context, mesh: bpy.types.Mesh, tools: list[tuple[list[Solid], str]],
                to_mesh: np.ndarray, patient: bool) -> bpy.types.Mesh:
    """A mesh with solids added or taken away, which are caps.

    to_mesh : (3, 3), from the world to the mesh. patient : whether the solver is to expect crossings and holes.
    """
    material = Counter(mesh_arrays.element_values(mesh, "polygons", "material_index")[caps.is_cap(mesh)].tolist())
    index = material.most_common(1)[0][0] if material else 0
    base = bpy.data.objects.new("Reeb Parts", mesh)
    solids = [(bpy.data.objects.new("Reeb Parts", _tool(mesh, found, to_mesh, index)), operation)
              for found, operation in tools]
    with (removed(bpy.data.meshes, *(obj.data for obj, _ in solids)),
          removed(bpy.data.objects, base, *(obj for obj, _ in solids))):
        if mesh.shape_keys is not None:
            base.show_only_shape_key, base.active_shape_key_index = True, 0
        for obj in (base, *(obj for obj, _ in solids)):
            context.scene.collection.objects.link(obj)
        for obj, operation in solids:
            modifier = base.modifiers.new("Reeb Parts", "BOOLEAN")
            modifier.object, modifier.operation, modifier.solver = obj, operation, "EXACT"
            modifier.use_self = modifier.use_hole_tolerant = patient
        made = evaluated_mesh(context, base)
    made.name = mesh.name
    return made


def _tool(mesh: bpy.types.Mesh, solids: list[Solid], to_mesh: np.ndarray, material: int) -> bpy.types.Mesh:
    """A mesh of solids, with the materials of another mesh; all of it are caps."""
    made = bpy.data.meshes.new("Reeb Parts")
    start = cumsum([0, *(len(solid.points) for solid in solids)]).tolist()
    points = np.concatenate([solid.points for solid in solids]) @ to_mesh.T
    faces = [tuple(first + corner for corner in face)
             for solid, first in zip(solids, start, strict=False) for face in solid.faces]
    made.from_pydata(points.tolist(), [], faces)
    for slot in mesh.materials:
        made.materials.append(slot)
    made.polygons.foreach_set("material_index", np.full(len(faces), material, np.int32))
    made.attributes.new(caps.CAP, "INT", "FACE").data.foreach_set("value", np.ones(len(faces), np.int32))
    return made
