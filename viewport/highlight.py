# SPDX-License-Identifier: GPL-3.0-or-later
"""The outline of the chosen parts, and a fill of those without one, drawn over the active object in the window.

Built when the choice or the parts change, drawn as often as the view is; nothing is written anywhere.
"""

from __future__ import annotations

import bpy
import gpu
import numpy as np

from ..scene import explode, graph_objects, mesh_arrays, selection, store
from ..scene.part_list import chosen_numbers
from .lines import Lines, Surface

COLOR = (1.0, 1.0, 1.0, 0.9)
WIDTH = 2.5

FILL = (1.0, 1.0, 1.0, 0.15)  # of loose pieces, which border on nothing

_built = None  # what the lines and the surface below were built of
_lines: Lines | None = None
_surface: Surface | None = None


def forget() -> None:
    """Free what is kept in memory."""
    global _built, _lines, _surface
    _built = _lines = _surface = None


def outline(obj: bpy.types.Object, numbers: list[int]) -> tuple[np.ndarray]:
    """Where some parts border on others: ends of edges, (2e, 3) float32, in the object's coordinates; in a tuple.

    Faces that are hidden are in none of them.

    Raises
    ------
    SceneError
        The parts are out of date.
    """
    mesh = obj.data
    stored = store.load(mesh)
    mine = np.isin(stored.face_numbers, numbers) & ~selection.hidden_faces(mesh)
    edges = mesh_arrays.edge_ends(mesh)[mesh_arrays.cut_edges(mesh, mine.astype(np.int64))]
    return (mesh_arrays.shown_points(obj)[edges.ravel()],)


def without_outline(obj: bpy.types.Object, numbers: list[int]) -> np.ndarray:
    """The surface of those of some parts that border on none, as loose pieces do: (t, 3, 3) float32 triangles.

    Raises
    ------
    SceneError
        The parts are out of date.
    """
    mesh = obj.data
    part = store.load(mesh).face_numbers
    mine = np.isin(part, numbers) & ~selection.hidden_faces(mesh)
    _, face = mesh_arrays.face_corners(mesh)
    at_cut = mesh_arrays.cut_edges(mesh, mine.astype(np.int64))[mesh_arrays.corner_edges(mesh)]
    whole = mine & ~np.isin(part, part[face[at_cut]])
    if not whole.any():
        return np.empty((0, 3, 3), np.float32)
    corners, of = mesh_arrays.triangles(mesh)
    return mesh_arrays.shown_points(obj)[corners[whole[of]]]


def draw() -> None:
    """Draw the outline of the chosen parts in the viewport that Blender is drawing."""
    global _built, _lines, _surface
    context = bpy.context
    obj = context.object
    of_node = graph_objects.part_of(obj)  # a node that is selected lights its part
    obj, chosen = (of_node[0], obj.select_get()) if of_node else (obj, obj is not None and obj.select_get())
    if (obj is None or obj.type != "MESH" or obj.mode != "OBJECT" or not chosen
            or not context.scene.reeb_parts.highlight or not context.space_data.overlay.show_overlays
            or not store.has_result(obj.data) or store.is_edited(obj.data)
            or explode.find(obj)):  # the parts are elsewhere then
        return
    result = obj.data.reeb_parts
    numbers = chosen_numbers(obj.data)
    hidden = selection.hidden_faces(obj.data).tobytes() if selection.hides_faces(obj.data) else b""
    key = (obj.session_uid, obj.data.session_uid, result.fingerprint, result.numbers, tuple(numbers), hash(hidden))
    if key != _built:
        _built = key
        _lines = Lines.of(outline, obj, numbers)
        _surface = Surface.of(without_outline, obj, numbers)
    if _surface is not None:
        _surface.draw(obj.matrix_world, FILL, context.region_data.is_perspective)
    if _lines is not None:
        gpu.state.blend_set("ALPHA")
        _lines.draw(obj.matrix_world, WIDTH, COLOR)
        gpu.state.blend_set("NONE")
