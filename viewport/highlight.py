# SPDX-License-Identifier: GPL-3.0-or-later
"""The outline of the chosen parts, drawn over the active object in the window.

Built when the choice or the parts change, drawn as often as the view is; nothing is written anywhere.
"""

from __future__ import annotations

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..scene import explode, mesh_arrays, store
from ..scene.errors import SceneError
from ..scene.part_list import chosen_numbers

COLOR = (1.0, 1.0, 1.0, 0.9)
WIDTH = 2.5

_handle = None
_built = None  # what the lines below were built of
_lines = None


def register() -> None:
    global _handle
    if not bpy.app.background:  # there is nothing to draw on
        _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def unregister() -> None:
    global _handle, _built, _lines
    if _handle is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
    _handle = _built = _lines = None


def outline(obj: bpy.types.Object, numbers: list[int]) -> np.ndarray:
    """Where some parts border on others: ends of edges, (2e, 3) float32, in the object's coordinates.

    Raises
    ------
    SceneError
        The parts are out of date.
    """
    mesh = obj.data
    stored = store.load(mesh)
    mine = np.isin(stored.face_numbers, numbers)
    edges = mesh_arrays.edge_ends(mesh)[mesh_arrays.cut_edges(mesh, mine.astype(np.int64))]
    return mesh_arrays.shown_points(obj)[edges.ravel()]


def _draw() -> None:
    global _built, _lines
    context = bpy.context
    obj = context.object
    if (obj is None or obj.type != "MESH" or obj.mode != "OBJECT" or not obj.select_get()
            or not context.scene.reeb_parts.highlight or not context.space_data.overlay.show_overlays
            or not store.has_result(obj.data) or store.is_edited(obj.data)
            or explode.find(obj)):  # the parts are elsewhere then
        return
    result = obj.data.reeb_parts
    numbers = chosen_numbers(obj.data)
    key = (obj.session_uid, obj.data.session_uid, result.fingerprint, result.numbers, tuple(numbers))
    if key != _built:
        _built = key
        _lines = _batch(obj, numbers)
    if _lines is None:
        return
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", WIDTH)
    shader.uniform_float("color", COLOR)
    gpu.state.blend_set("ALPHA")
    with gpu.matrix.push_pop():
        gpu.matrix.multiply_matrix(obj.matrix_world)
        _lines.draw(shader)
    gpu.state.blend_set("NONE")


def _batch(obj: bpy.types.Object, numbers: list[int]) -> gpu.types.GPUBatch | None:
    """Lines for the card, None if there are none."""
    try:
        points = outline(obj, numbers)
    except SceneError:
        return None
    if not len(points):
        return None
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    return batch_for_shader(shader, "LINES", {"pos": points})
