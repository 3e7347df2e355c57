# SPDX-License-Identifier: GPL-3.0-or-later
"""How much a curve turns."""

from __future__ import annotations

import numpy as np

from ...arrays.indexing import stable_order
from ...arrays.int64 import cumsum


def turning(points: np.ndarray, segments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Measure by how much curves of straight segments turn at their points.

    Parameters
    ----------
    points : (n, 3) float64
    segments : (s, 2) int64
        Ends of each segment.

    Returns
    -------
    point : (k,) int64
        Points where two segments meet; where more do, curves end.
    angle : (k,) float64
        By how much the direction changes there, in radians.
    """
    ends = segments.ravel()
    order = stable_order(ends)
    count = np.bincount(ends, minlength=len(points))
    point = np.flatnonzero(count == 2)
    place = cumsum(count)[point] - 2
    other = segments[:, ::-1].ravel()[order]
    back, ahead = points[point] - points[other[place]], points[other[place + 1]] - points[point]
    angle = np.arctan2(np.linalg.norm(np.cross(back, ahead), axis=1), (back * ahead).sum(axis=1))
    return point, angle
