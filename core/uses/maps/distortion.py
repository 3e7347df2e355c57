# SPDX-License-Identifier: GPL-3.0-or-later
"""How much a map into the plane changes the areas and the angles of a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.indexing import inverse, sums_by
from ...arrays.vectors import cross_in_plane
from ...mesh.corners import CornerTable

#: Areas between these, as multiples of their share of the whole map, are called even.
EVEN = (0.3, 3.0)


@dataclass(frozen=True, eq=False)
class Distortion:
    """What a map of p faces does.

    Attributes
    ----------
    scale : (p,) float64
        Area of each face in the map over its area on the surface, divided by the same of the whole: 1 is even, and
        less than 0 is turned over. nan for a face without an area, and 0 where the whole map has none.
    angle : float
        By how much the angle at a corner changes, averaged over all corners, in radians.
    """

    scale: np.ndarray
    angle: float

    @property
    def even(self) -> float:
        """Share of the faces whose areas are even, 0..1."""
        scale = self.scale[np.isfinite(self.scale)]
        return float(np.mean((scale > EVEN[0]) & (scale < EVEN[1]))) if len(scale) else 1.0

    @property
    def range(self) -> tuple[float, float]:
        """Scale that 1 in 100 faces are below, and scale that 1 in 100 are above, be they turned over or not."""
        scale = np.abs(self.scale[np.isfinite(self.scale)])
        low, high = np.quantile(scale, (0.01, 0.99)) if len(scale) else (1.0, 1.0)
        return float(low), float(high)

    @property
    def turned(self) -> int:
        """How many faces are turned over."""
        return int((self.scale < 0).sum())


def distortion(table: CornerTable, flat: np.ndarray) -> Distortion:
    """Compare a map with its surface.

    Parameters
    ----------
    table : CornerTable
        p faces with c corners.
    flat : (c, 2) float64
        Where the map puts each corner.

    Returns
    -------
    distortion : Distortion
    """
    area = np.linalg.norm(table.face_vectors(), axis=1)
    mapped = _areas(table, flat)
    total = np.abs(mapped).sum()
    # A map into a point or a line has areas of rounding only.
    whole = area.sum() / total if total > 1e-12 * np.abs(flat).max(initial=0.0) ** 2 else 0.0
    has_area = area > 1e-9 * area.max(initial=0.0)
    scale = np.full(len(area), np.nan)
    scale[has_area] = whole * mapped[has_area] / area[has_area]
    change = np.abs(_angles(table, table.vertices[table.corner_vertex]) - _angles(table, flat))
    change = change[has_area[table.corner_face]]
    return Distortion(scale, float(change.mean()) if len(change) else 0.0)


def _areas(table: CornerTable, flat: np.ndarray) -> np.ndarray:
    """Signed area of each face in the map, (p,)."""
    return sums_by(table.corner_face, 0.5 * cross_in_plane(flat, flat[table.next_corner]), table.n_faces)


def _angles(table: CornerTable, points: np.ndarray) -> np.ndarray:
    """Angle between the two sides at each corner, (c,), in radians. points : (c, 2) or (c, 3)."""
    following = table.next_corner
    x, y = points[following] - points, points[inverse(following)] - points
    length = np.linalg.norm(x, axis=1) * np.linalg.norm(y, axis=1)
    return np.arccos(((x * y).sum(axis=1) / np.maximum(length, np.finfo(float).tiny)).clip(-1.0, 1.0))
