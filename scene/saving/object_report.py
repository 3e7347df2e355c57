# SPDX-License-Identifier: GPL-3.0-or-later
"""What the JSON says of an object."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from ...core.uses.report import bounding_boxes, report
from .. import bridge, store
from ..pieces import part_meshes, piece_checks
from ..reading import mesh_arrays, placing
from ..result import part_names
from ..store import Stored
from ..temporary import removed


def object_report(obj: bpy.types.Object, labels: bool = False, check: bool = False) -> dict:
    """The JSON of an object's stored result, in coordinates of the world; Object Mode.

    labels : bool, whether the part of every face is in it. check : bool, whether closed pieces are made and checked.

    Raises
    ------
    SceneError
        Nothing is stored, or the mesh was edited since.
    """
    mesh = obj.data
    world, stretch = np.array(placing.world_matrix(obj), np.float64), store.stretch_of(mesh)
    stored = _measured(obj, store.load(mesh), stretch)
    numbered = stored.shown_parts()
    from_result = world.copy()
    from_result[:3, :3] = world[:3, :3] @ bridge.unstretch(stretch)
    vertex, face = mesh_arrays.face_corners(mesh)
    points = placing.transformed(mesh_arrays.shown_points(obj), world)
    boxes = bounding_boxes(numbered.parts.labels[face], points[vertex], numbered.parts.count)
    colors = part_names.number_colors(mesh)[numbered.numbers, :3].astype(np.float64)
    names = [part_names.part_name(mesh, number) for number in numbered.numbers.tolist()]
    result = report(stored.decomposition, numbered.parts, obj.name, numbers=numbered.numbers, names=names,
                    colors=np.round(colors, 6), boxes=boxes, transform=from_result, labels=labels)
    result["notes"] = mesh.reeb_parts.notes.splitlines()
    if check:
        for part, found in zip(result["parts"], _checks(obj, stored.face_numbers, numbered.numbers), strict=True):
            part["check"] = found
    return result


def _measured(obj: bpy.types.Object, stored: Stored, stretch: np.ndarray) -> Stored:
    """A result with the areas and lengths that its mesh has as the object shows it.

    Of objects that share a mesh, the first was decomposed; and any may have been scaled since.

    stretch : (3, 3) float64, that of then.
    """
    now = bridge.world_stretch(obj)
    if np.allclose(now, stretch, rtol=1e-5, atol=1e-5 * np.abs(stretch).max()):
        return stored
    before, after = bridge.stretched_graphs(obj, stretch, now)
    return replace(stored, decomposition=stored.decomposition.remeasured(before, after))


def _checks(obj: bpy.types.Object, face_numbers: np.ndarray, numbers: np.ndarray) -> list[dict]:
    """What is wrong with the closed piece of each part; nothing stays of the pieces."""
    stretch = bridge.world_stretch(obj)
    made = part_meshes.piece_meshes(obj.data, face_numbers, numbers.tolist(), close=True, smooth=stretch)
    with removed(bpy.data.meshes, *made.meshes.values()):
        return [piece_checks.check(made.meshes[number], stretch)[0].as_dict() for number in numbers.tolist()]
