# SPDX-License-Identifier: GPL-3.0-or-later
"""Look at something from near."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Vector

from ..scene import redraw

MARGIN = 1.3  # what is seen beyond a thing, as a share of it
SENSOR = 36.0  # mm, the width of the sensor by which the lens of a viewport is told, of which it shows twice as much


def look_at(context: bpy.types.Context, low: np.ndarray, high: np.ndarray) -> None:
    """Show a box of the world in the viewport that the pointer is in, or in all of them, from where it is looked at.

    low, high : (3,) float64, its corners.
    """
    space = context.space_data
    spaces = [space] if space is not None and space.type == "VIEW_3D" else list(redraw.view_spaces())
    for space in spaces:
        view = space.region_3d
        view.view_location = Vector(((low + high) / 2).tolist())
        # Half of the width is enough: a view may be half as high as wide.
        view.view_distance = max(MARGIN * float(np.linalg.norm(high - low)) * space.lens / SENSOR, 1e-6)
    redraw.viewports()
