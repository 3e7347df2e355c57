# SPDX-License-Identifier: GPL-3.0-or-later
"""Grounds for tests, and what stands on them."""

import numpy as np
import shapes

from core.mesh.grounds import find_standing
from core.mesh.polygons import PolygonMesh


def sheet(width, n=1, depth=None):
    """A square grid of n x n quads in the plane z = 0, or a slab, its top there."""
    if depth:
        return shapes.moved(shapes.box((width, width, depth)), (-width / 2, -width / 2, -depth))
    at = np.linspace(-width / 2, width / 2, n + 1)
    x, y = np.meshgrid(at, at, indexing="ij")
    corner = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]))
    return shapes.Shape(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1),
                        np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]))


def hills(width, n=30):
    """A grid of n x n quads that goes up and down, below z = 0."""
    vertices, faces = sheet(width, n)
    x, y = vertices[:, :2].T / width
    height = 0.06 * width * (np.sin(9 * x + 1) * np.cos(7 * y) - 1)
    return shapes.Shape(vertices + height[:, None] * (0, 0, 1), faces)


def tree():
    """The tree of tubes, its lowest point at z = 0."""
    return shapes.moved(shapes.tube_tree(), (0, 0, -shapes.tube_tree().vertices[:, 2].min()))


def column(height, foot):
    """A box of many faces, 1 wide."""
    shape = shapes.box((1, 1, height))
    for _ in range(3):
        shape = shapes.subdivide(shape)
    return shapes.moved(shape, (0, 0, foot))


def collider():
    """The smallest box around the tree that lies along the axes."""
    low, high = tree().vertices.min(axis=0), tree().vertices.max(axis=0)
    return shapes.moved(shapes.box(high - low), low)


def has_ground(*things):
    return find_standing(PolygonMesh.of(*shapes.together(*things))) is not None
