# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles that rays and other triangles can meet: few of many, so that a search tree is made of few only."""

from __future__ import annotations

from itertools import product

import numpy as np

from ..arrays.int64 import arange

# Cells of the grid along the longest side: as many as make about one cell for each triangle of the surface of a cube.
_MOST_CELLS = 128
# How far in cells the box of a triangle is widened; rays are looked at every half cell.
_WIDER = 0.3


def within_reach(points: np.ndarray, triangles: np.ndarray, tried: np.ndarray, start: np.ndarray,
                 direction: np.ndarray) -> np.ndarray:
    """Find the triangles that some rays and some of the triangles can meet, by a grid.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (t, 3) int
        At least one.
    tried : (t,) bool
        Triangles of which all are looked for that may meet them; they are among these.
    start, direction : (r, 3) float64
        Of the rays. Directions have length 1.

    Returns
    -------
    reached : (t,) bool
        Whether a ray or the box of a triangle that is tried meets a cell of the grid that the triangle may be in: true
        for all triangles that are met, and for some that are not.

    Notes
    -----
    O(t + 128**3) time and memory.
    """
    # By columns, which is many times as fast as all three together.
    low, size = np.array([axis.min() for axis in points.T]), max(float(np.ptp(axis)) for axis in points.T) or 1.0
    n = int(np.clip(np.sqrt(len(triangles) / 6), 8, _MOST_CELLS))
    # One more cell on each side, for what is widened.
    scaled, start = ((places - low) * (n / size) + 1.0 for places in (points, start))
    corners = [np.take(scaled, triangles[:, i], axis=0) for i in range(3)]
    first = (np.minimum(np.minimum(*corners[:2]), corners[2]) - _WIDER).astype(np.int32)
    last = (np.maximum(np.maximum(*corners[:2]), corners[2]) + _WIDER).astype(np.int32)
    marked = _boxes(first[tried], last[tried], n + 3) > 0
    along = arange(int(2 * np.sqrt(3) * (n + 2)) + 2) / 2
    cell = np.floor(start[:, None] + along[:, None] * direction[:, None]).astype(np.int64).reshape(-1, 3)
    cell = cell[((cell >= 0) & (cell < n + 3)).all(axis=1)]
    marked[tuple(cell.T)] = True
    return _sums(marked, first, last) > 0


def _boxes(first: np.ndarray, last: np.ndarray, n: int) -> np.ndarray:
    """How many boxes of cells, (k, 3) from and to, each cell of a grid is in, (n, n, n) int32."""
    change = np.zeros((n + 1,) * 3, np.int32)
    for ends in product((0, 1), repeat=3):
        cell = tuple(np.where(end, last[:, axis] + 1, first[:, axis]) for axis, end in enumerate(ends))
        np.add.at(change, cell, (-1) ** sum(ends))
    for axis in range(3):
        np.cumsum(change, axis=axis, out=change)
    return change[:n, :n, :n]


def _sums(marked: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """How many marked cells there are in boxes of cells, (k, 3) from and to: (k,) int32."""
    total = np.zeros(tuple(n + 1 for n in marked.shape), np.int32)
    total[1:, 1:, 1:] = marked
    for axis in range(3):
        np.cumsum(total, axis=axis, out=total)
    n = total.shape[0]
    flat = total.ravel()
    found = np.zeros(len(first), np.int32)
    upper = last + 1
    for ends in product((0, 1), repeat=3):
        x, y, z = ((upper if end else first)[:, axis] for axis, end in enumerate(ends))
        found += (-1) ** (3 - sum(ends)) * flat[(x * n + y) * n + z]
    return found
