# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces as core.uses.joints.room sees them: how far their surface is, and what is inside."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from ...core.arrays.vectors import box_diagonal
from ..pieces.closing import caps
from ..reading import mesh_arrays

if TYPE_CHECKING:
    from ...core.uses.joints.shapes import Solid
    from .cuts import Cut


class PieceSurface:
    """A piece for distances, for what is inside, and with the holes that it will have.

    Attributes
    ----------
    points : (n, 3) float64
        In units of the world.
    triangles : (t, 3) int32
    polygon : (t,) int32
        The face of the mesh that each triangle lies in.
    is_cap : (t,) bool
        Whether that is one of a cap.
    whole, sides : BVHTree
        All triangles, and those of no cap.
    holes : list of BVHTree
    """

    def __init__(self, mesh: bpy.types.Mesh, stretch: np.ndarray) -> None:
        self.points = mesh_arrays.basis_points(mesh).astype(np.float64) @ stretch.T
        self.triangles, self.polygon = mesh_arrays.triangles(mesh)
        self._places = self.points.tolist()
        self.is_cap = caps.is_cap(mesh)[self.polygon]
        self.whole, self.sides = self.tree(slice(None)), self.tree(~self.is_cap)
        self.holes: list[BVHTree] = []

    def add_hole(self, solid: Solid) -> None:
        """There will be a hole."""
        self.holes.append(BVHTree.FromPolygons(solid.points.tolist(), solid.faces))

    def tree(self, which: np.ndarray | slice) -> BVHTree:
        """The surface of some triangles."""
        triangles = self.triangles[which]
        return BVHTree.FromPolygons(self._places, triangles.tolist(), all_triangles=True)


class Side:
    """A piece as seen from one of its cuts, without the cap of that cut: a Body of core.uses.joints.room."""

    def __init__(self, surfaces: dict[int, PieceSurface], cut: Cut, side: int) -> None:
        surface = surfaces[cut.keys[side]]
        self._whole = surface.whole
        self._trees = [surface.sides, *surface.holes]
        others = surface.is_cap & ~np.isin(surface.polygon, cut.faces[side])
        if others.any():
            self._trees.append(surface.tree(others))
        self._size = box_diagonal(surface.points)

    def distance(self, points: np.ndarray) -> np.ndarray:
        return np.min([[tree.find_nearest(point)[3] or 0.0 for point in points.tolist()] for tree in self._trees],
                      axis=0, initial=np.inf) if len(points) else np.empty(0)

    def inside(self, points: np.ndarray) -> np.ndarray:
        return np.array([self._is_inside(point) for point in points.tolist()], bool)

    def _is_inside(self, point: list[float]) -> bool:
        # Directions that no mesh has for its own; most of the three are right.
        first, second, third = (0.287, 0.513, 0.809), (-0.743, 0.431, -0.512), (0.339, -0.871, 0.355)
        odd = self._crossings(point, first) % 2
        same = self._crossings(point, second) % 2 == odd
        return bool(odd if same else self._crossings(point, third) % 2)

    def _crossings(self, point: list[float], way: tuple[float, float, float]) -> int:
        count, step = 0, 1e-6 * self._size
        while True:
            place, _, _, _ = self._whole.ray_cast(point, way)
            if place is None or count > 1000:  # one may lie in a face
                return count
            count += 1
            point = [x + step * d for x, d in zip(place, way, strict=True)]
