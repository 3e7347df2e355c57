# SPDX-License-Identifier: GPL-3.0-or-later
"""Level sets of heights on shapes, for tests of what is made of them."""

import numpy as np
import shapes

from core.graph.level_sets import cut_at_levels, uniform_levels
from core.mesh.triangles import TriMesh


def along(shape, direction, n_slabs=40, noise=0.0):
    """Those of the heights in a direction, 0 to 1, with noise of that size beside them."""
    values = shape.vertices @ np.asarray(direction, float)
    values = (values - values.min()) / np.ptp(values)
    values = values + noise * np.random.default_rng(0).random(len(values))
    return cut_at_levels(TriMesh(*shape), values / values.max(), uniform_levels(n_slabs))


def counted(sets):
    """Heights of levels by which ``simplify`` counts the levels that a leaf crosses."""
    return np.ones(len(sets.levels))


HEIGHTS = {
    "genus 1": lambda: along(shapes.surface_of_genus(1), (1, 0.1, 0)),
    "genus 3": lambda: along(shapes.surface_of_genus(3), (1, 0.1, 0)),
    "tree": lambda: along(shapes.tube_tree(), (0.3, 1, 0.2)),
    "dumbbell": lambda: along(shapes.dumbbell(), (0, 0, 1)),
    "noise": lambda: along(shapes.tube_tree(), (0.3, 1, 0.2), noise=0.4),
}
