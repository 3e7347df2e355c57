# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the vertices of objects are in the world."""

import bpy
import numpy as np
from bulk import read


def world_points(obj):
    """Of the mesh that is stored, (n, 3)."""
    bpy.context.view_layer.update()
    return _moved(obj, obj.data)


def seen_points(obj):
    """Of the mesh as the viewport shows it, with its modifiers, (n, 3)."""
    bpy.context.view_layer.update()
    return _moved(obj, obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)


def _moved(obj, mesh):
    matrix = np.array(obj.matrix_world, np.float64)  # Blender 5.2 gives single precision
    return read(mesh.vertices, "co", width=3) @ matrix[:3, :3].T + matrix[:3, 3]
