# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and surfaces that are drawn over the view."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..scene.errors import SceneError
from .clipping import clipped_lines, clipped_view, is_clipped

NEARER = 0.002  # by what share of its distance a fill is drawn nearer than the surface, in perspective
FLAT = 2e-5  # and without, as a share of the depth of the view
RIM, DARK = 2.0, (0.0, 0.0, 0.0, 0.5)  # how much wider than a line its rim is, which makes it seen on white, too
ROUNDING = 1e-6  # in perspective, of that depth: far away the depths of all that lies nearer differ by no more


class Lines:
    """Lines, ready for the card.

    Parameters
    ----------
    points : (2 k, 3) float32
        Both ends of each line.
    colors : (2 k, 4) float32, optional
        Of the ends; without, all lines are drawn in one color.
    """

    def __init__(self, points: np.ndarray, colors: np.ndarray | None = None) -> None:
        self.shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR" if colors is None else "POLYLINE_FLAT_COLOR")
        self.points, self.colors = points, colors
        self.batch = self._batch(points, colors)

    def _batch(self, points: np.ndarray, colors: np.ndarray | None) -> gpu.types.GPUBatch:
        content = {"pos": points} if colors is None else {"pos": points, "color": colors}
        return batch_for_shader(self.shader, "LINES", content)

    @classmethod
    def of(cls, read: Callable[..., tuple[np.ndarray, ...]], *arguments: object) -> Lines | None:
        """Of the arrays that a function reads; None if there are no lines, or the function raises SceneError."""
        try:
            arrays = read(*arguments)
        except SceneError:
            return None
        return cls(*arrays) if len(arrays[0]) else None

    def draw(self, matrix: Matrix, width: float, color: tuple[float, ...] | None = None) -> None:
        """Draw what is in the coordinates that a matrix takes to the world; in one color, with a dark rim.

        width : in pixels of a screen without scaling.
        """
        scale, batch = bpy.context.preferences.system.ui_scale, self.batch
        if view := clipped_view():
            left, kept = clipped_lines(view, self.points.reshape(-1, 2, 3), matrix)
            if not kept.any():
                return
            colors = None if self.colors is None else self.colors[np.repeat(kept, 2)]
            batch = self._batch(left[kept].reshape(-1, 3), colors)
        self.shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
        with gpu.matrix.push_pop():
            gpu.matrix.multiply_matrix(matrix)
            for wide, shade in _strokes(width, color):
                self.shader.uniform_float("lineWidth", wide * scale)
                if shade is not None:
                    self.shader.uniform_float("color", shade)
                batch.draw(self.shader)


def _strokes(width: float, color: tuple[float, ...] | None) -> list[tuple[float, tuple[float, ...] | None]]:
    """What lines are drawn with, one over the other: widths and colors; the rim is as faint as they are."""
    if color is None:
        return [(width, None)]
    return [(width + RIM, (*DARK[:3], DARK[3] * color[3])), (width, color)]


class Surface:
    """A part of a surface, ready for the card.

    Parameters
    ----------
    triangles : (t, 3, 3) float32
        In the coordinates of the mesh.
    """

    def __init__(self, triangles: np.ndarray) -> None:
        self.shader = gpu.shader.from_builtin("UNIFORM_COLOR")
        self.triangles = triangles
        self.batch = self._batch(triangles)

    def _batch(self, triangles: np.ndarray) -> gpu.types.GPUBatch:
        return batch_for_shader(self.shader, "TRIS", {"pos": triangles.reshape(-1, 3)})

    @classmethod
    def of(cls, read: Callable[..., np.ndarray], *arguments: object) -> Surface | None:
        """Of what a function reads; None if that is nothing, or the function raises SceneError."""
        try:
            triangles = read(*arguments)
        except SceneError:
            return None
        return cls(triangles) if len(triangles) else None

    def draw(self, matrix: Matrix, color: tuple[float, ...], is_perspective: bool) -> None:
        """Fill what is seen of it. matrix : from the mesh to the world. is_perspective : whether the view is."""
        batch = self.batch
        if view := clipped_view():
            outside = is_clipped(view, self.triangles.reshape(-1, 3), matrix)
            kept = ~outside.reshape(-1, 3).any(axis=1)
            if not kept.any():
                return
            batch = self._batch(self.triangles[kept])
        self.shader.bind()
        self.shader.uniform_float("color", color)
        projection = gpu.matrix.get_projection_matrix()
        if is_perspective:
            # A share of the depth of the view would be a thousand times as far where that is a thousand times as deep:
            # through what lies before it.
            projection = projection @ Matrix.Diagonal((1.0 - NEARER, 1.0 - NEARER, 1.0 - NEARER, 1.0))
            projection[2] -= ROUNDING * projection[3]
        else:
            projection[2] -= projection[3] * FLAT
        gpu.state.blend_set("ALPHA")
        gpu.state.depth_test_set("LESS_EQUAL")
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            gpu.matrix.load_projection_matrix(projection)
            gpu.matrix.multiply_matrix(matrix)
            self._draw_nearest(batch)
        gpu.state.depth_test_set("NONE")
        gpu.state.blend_set("NONE")

    def _draw_nearest(self, batch: gpu.types.GPUBatch) -> None:
        """Draw what is nearest, once: the inner side of a thin wall is drawn nearer than the wall, too."""
        gpu.state.color_mask_set(False, False, False, False)
        gpu.state.depth_mask_set(True)
        batch.draw(self.shader)
        gpu.state.color_mask_set(True, True, True, True)
        gpu.state.depth_mask_set(False)
        gpu.state.depth_test_set("EQUAL")
        batch.draw(self.shader)


def fill(corners: np.ndarray, matrix: Matrix, color: tuple[float, ...]) -> None:
    """Draw a flat area over everything. corners : (t, 3), around its middle, which comes first."""
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    shader.uniform_float("color", color)
    gpu.state.blend_set("ALPHA")
    with gpu.matrix.push_pop():
        gpu.matrix.multiply_matrix(matrix)
        batch_for_shader(shader, "TRI_FAN", {"pos": corners.astype("float32")}).draw(shader)
    gpu.state.blend_set("NONE")
