# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial balls: the largest that touch a surface, or the outline of a sheet, from one side [Ma2012]."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..arrays.int64 import arange
from ..arrays.nearest import nearest
from ..arrays.vectors import lengths, row_products

STEPS = 12  # upper bound of the number of times that a ball shrinks
# Cosine of the smallest angle between the two points that a ball touches, seen from its center. A ball stops shrinking
# before the angle falls below this one: it would only fit into the roughness of the surface.
SEPARATION = np.cos(np.deg2rad(50.0))
BEFORE = 1.0 - 1e-4  # share of its radius at which a ball's nearest point is searched: a little before the center


def ball_radius(
    tree: cKDTree, point: np.ndarray, direction: np.ndarray, largest: float, slack: float = 0.0
) -> np.ndarray:
    """Measure the largest balls that touch some points and hold no other: a large ball shrinks until none lies in it.

    Parameters
    ----------
    tree : cKDTree
        Of the points that no ball may hold, in units of about the size of the surface.
    point : (k, 3) float64
        Where each ball touches.
    direction : (k, 3) float64
        Unit vector from there to its center.
    largest : float
        Radius at which balls begin to shrink, in the unit of the points.
    slack : float
        See ``nearest``.

    Returns
    -------
    radius : (k,) float64
        At most ``largest``.
    """
    radius = np.full(len(point), largest)
    active = arange(len(point))
    for _ in range(STEPS):
        p, d = point[active], direction[active]
        # A little before the center: of points that are equally far from it, as around the axis of a tube, the one
        # that makes the smallest ball is then the nearest.
        center = p + BEFORE * radius[active, None] * d
        distance, touched = nearest(tree, center, slack=slack)
        offset = tree.data[touched] - p
        height = row_products(offset, d)
        smaller = row_products(offset, offset) / np.maximum(2 * height, 1e-12)
        shrinks = (distance < radius[active] * (1 - 1e-3)) & (height > 1e-9)
        shrinks &= (smaller < radius[active]) & (_cosine(offset, smaller[:, None] * d) < SEPARATION)
        active = active[shrinks]
        if not len(active):
            break
        radius[active] = smaller[shrinks]
    return radius


def _cosine(offset: np.ndarray, to_center: np.ndarray) -> np.ndarray:
    """Cosine of the angle, (k,), between two points that a ball touches, seen from its center.

    offset, to_center : (k, 3), from the first point to the second and to the center.
    """
    a, b = -to_center, offset - to_center
    length = lengths(a) * lengths(b)
    return row_products(a, b) / np.maximum(length, 1e-300)
