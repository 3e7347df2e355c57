# SPDX-License-Identifier: GPL-3.0-or-later
"""What Alt+B leaves of a view: what is drawn over the view ends there, too, and nothing else is pointed at."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Matrix


def clipped_view() -> bpy.types.RegionView3D | None:
    """The view that is drawn, if Alt+B leaves only a part of it."""
    view = bpy.context.region_data  # none where something is drawn into a picture
    return view if view is not None and view.use_clip_planes else None


def clip_planes(view: bpy.types.RegionView3D) -> np.ndarray:
    """The sides of what Alt+B leaves of a view, (4, 4) float64, less than 0 outside; or (0, 4)."""
    return np.array(view.clip_planes, np.float64).reshape(-1, 4)[:4 if view.use_clip_planes else 0]


def is_clipped(view: bpy.types.RegionView3D, points: np.ndarray, matrix: Matrix) -> np.ndarray:
    """Whether points, (k, 3), which a matrix takes to the world, are outside what Alt+B leaves of a view; (k,) bool."""
    planes = clip_planes(view) @ np.array(matrix, np.float64)
    return (points @ planes[:, :3].T + planes[:, 3] < 0.0).any(axis=1)


def clipped_lines(view: bpy.types.RegionView3D, ends: np.ndarray, matrix: Matrix) -> tuple[np.ndarray, np.ndarray]:
    """What Alt+B leaves of lines in a view.

    Parameters
    ----------
    view : bpy.types.RegionView3D
    ends : (k, 2, 3) float32
        In the coordinates that a matrix takes to the world.
    matrix : mathutils.Matrix

    Returns
    -------
    left : (k, 2, 3) float32
        The ends, moved to where the lines leave the view.
    kept : (k,) bool
        Whether anything is left of a line.
    """
    left, kept = ends.astype(np.float64), np.ones(len(ends), bool)
    for plane in clip_planes(view) @ np.array(matrix, np.float64):
        height = left @ plane[:3] + plane[3]
        outside = height < 0.0
        kept &= ~outside.all(axis=1)
        share = np.divide(height, height - height[:, ::-1], out=np.zeros_like(height),
                          where=outside & ~outside[:, ::-1])
        left += share[:, :, None] * (left[:, ::-1] - left)
    return left.astype(np.float32), kept
