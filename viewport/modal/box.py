# SPDX-License-Identifier: GPL-3.0-or-later
"""Which parts are seen in a box that is drawn over the view."""

from __future__ import annotations

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ...core.arrays.int64 import arange
from ..clipping import is_clipped
from ..pointing import Model, on_screen, ray_of

SAMPLES = 64  # faces of each part that are looked at, whether something hides them


def parts_in_box(context: bpy.types.Context, obj: bpy.types.Object, model: Model, region: bpy.types.Region,
                 low: tuple[int, int], high: tuple[int, int]) -> list[int]:
    """The parts of which something is seen in a box, in the order of their numbers.

    A face is in the box if its middle is. In wireframe and X-ray nothing is hidden.

    low, high : corners of the box, in pixels of the region.
    """
    context.view_layer.update()
    model.look(context, obj)
    places = on_screen(model.face_center, obj.matrix_world, region)
    with np.errstate(invalid="ignore"):  # nan: behind the viewer
        inside = ((places >= low) & (places <= high)).all(axis=1)
    inside &= ~is_clipped(region.data, model.face_center, obj.matrix_world)
    shading = context.space_data.shading
    if not (shading.type == "WIREFRAME" or (shading.type == "SOLID" and shading.show_xray)):
        inside &= _turned_here(obj, model, region.data)
        inside[inside] = _sampled(model.numbers[inside])
        inside[inside] = [_is_seen(context, obj, model, region, face, places[face]) for face in np.flatnonzero(inside)]
    return np.unique(model.numbers[inside]).tolist()


def _turned_here(obj: bpy.types.Object, model: Model, view: bpy.types.RegionView3D) -> np.ndarray:
    """Whether each face is turned towards the viewer, (p,) bool."""
    back = obj.matrix_world.inverted_safe()
    eye = view.view_matrix.inverted_safe()
    if view.window_matrix[3][3] == 0.0:  # in perspective
        ahead = model.face_center - np.array(back @ eye.translation)
    else:
        ahead = np.array(back.to_3x3() @ -eye.to_3x3().col[2])
    return (model.face_normal * ahead).sum(axis=1) < 0.0


def _sampled(numbers: np.ndarray) -> np.ndarray:
    """Some of the faces of each part, evenly over their order. numbers : (k,) int64. Returns (k,) bool."""
    order = np.argsort(numbers, kind="stable")
    _, start, count = np.unique(numbers[order], return_index=True, return_counts=True)
    place = arange(len(numbers)) - np.repeat(start, count)
    chosen = np.empty(len(numbers), bool)
    step = np.repeat(-(-count // SAMPLES), count)
    chosen[order] = place % step == 0
    return chosen


def _is_seen(context: bpy.types.Context, obj: bpy.types.Object, model: Model, region: bpy.types.Region, face: int,
             place: np.ndarray) -> bool:
    """Whether the part of a face is what is seen where the middle of the face is."""
    hit = model.along(context, obj, *ray_of(region, place))
    return hit is not None and model.number(hit) == model.numbers[face]


class Frame:
    """A box that is drawn over one region while it is being dragged."""

    def __init__(self, region: bpy.types.Region, start: tuple[int, int]) -> None:
        self.region, self.start, self.end = region.as_pointer(), start, start
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_PIXEL")

    @property
    def corners(self) -> tuple[tuple[int, int], tuple[int, int]]:
        """The lower left and the upper right one."""
        (left, right), (low, high) = (sorted(pair) for pair in zip(self.start, self.end, strict=True))
        return (left, low), (right, high)

    def remove(self) -> None:
        bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")

    def _draw(self) -> None:
        if bpy.context.region is None or bpy.context.region.as_pointer() != self.region:
            return
        (left, low), (right, high) = self.corners
        places = [(left, low), (right, low), (right, high), (left, high)]
        shader = gpu.shader.from_builtin("UNIFORM_COLOR")
        gpu.state.blend_set("ALPHA")
        for kind, corners, color in (("TRI_FAN", places, (1.0, 1.0, 1.0, 0.08)),
                                     ("LINE_STRIP", [*places, places[0]], (1.0, 1.0, 1.0, 0.8))):
            shader.uniform_float("color", color)
            batch_for_shader(shader, kind, {"pos": corners}).draw(shader)
        gpu.state.blend_set("NONE")
