# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces with a border that have an inside all the same."""

import numpy as np
import shapes


def with_holes(shape, share=0.03, seed=0):
    """Some faces are missing."""
    return shapes.Shape(shape.vertices, shape.faces[np.random.default_rng(seed).random(len(shape.faces)) >= share])


def opened(shape, axis, level):
    """What lies below a level is cut off."""
    low = shape.vertices[shape.faces, axis].max(axis=1) < level
    return shapes.Shape(shape.vertices, shape.faces[~low])


OPEN = {
    "ball": lambda: with_holes(shapes.icosphere(3)), "torus": lambda: with_holes(shapes.torus(24, 12)),
    "tree of tubes": lambda: with_holes(shapes.tube_tree(3, 0.3)),
    "genus 2": lambda: with_holes(shapes.surface_of_genus(2)),
    "thin pipe": lambda: shapes.cylinder(20, 8, 0.05, 4.0, False),
    "cup of one layer": lambda: opened(shapes.icosphere(3), 2, -0.5),
    "half a pipe": lambda: opened(shapes.cylinder(20, 24, 1.0, 3.0, False), 0, -0.1),
    "box without a lid": lambda: shapes.Shape(shapes.box().vertices, shapes.box().faces[2:]),
    "many": lambda: shapes.together(*(shapes.moved(with_holes(shapes.icosphere(1), 0.1, i), (3 * i, 0, 0))
                                      for i in range(40))),
}
