# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of a model around a curve, which a cap across the curve must not cross."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from mathutils.bvhtree import BVHTree

from ....core.arrays.indexing import renumbered, sums_by
from ....core.arrays.int64 import full
from ....core.arrays.vectors import cross, unit


def search_tree(points: np.ndarray, triangles: np.ndarray) -> BVHTree:
    """A tree of triangles, (t, 3) int, between points, (n, 3) float64."""
    # Tuples made of columns take two thirds of the time of lists made of rows.
    rows = (list(zip(*array.T.tolist(), strict=True)) for array in (points, triangles))
    return BVHTree.FromPolygons(*rows, all_triangles=True)


def crossing(tree: BVHTree, other: BVHTree, triangles: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Pairs of triangles of two trees that cross and have no corner in common, (k, 2) int64; of one tree, each once.

    triangles, others : (t, 3) and (s, 3) int, in which a corner of one that is a corner of the other is one number.
    """
    pairs = np.array(tree.overlap(other), np.int64).reshape(-1, 2)
    if tree is other:
        pairs = pairs[pairs[:, 0] < pairs[:, 1]]
    first, second = triangles[pairs[:, 0]], others[pairs[:, 1]]
    return pairs[(first[:, :, None] != second[:, None]).all(axis=(1, 2))]


@dataclass(frozen=True, eq=False)
class BodySurface:
    """Some triangles of a mesh, with numbers of their own for the vertices.

    Attributes
    ----------
    tree : BVHTree
    points : (v, 3) float64
    triangles : (t, 3) int64
    labels : (t,) int64
        Part of each triangle.
    own : (k,) int64
        The vertex that each point of the curve is; -1 for one that is none.
    vertices : (v,) int64
        The vertex of the mesh for each of these numbers.
    """

    tree: BVHTree
    points: np.ndarray
    triangles: np.ndarray
    labels: np.ndarray
    own: np.ndarray
    vertices: np.ndarray

    @classmethod
    def of(cls, points: np.ndarray, triangles: np.ndarray, labels: np.ndarray, curve: np.ndarray) -> BodySurface:
        """Triangles of a mesh with points (n, 3), as they are around a curve, (k, 3)."""
        used, triangles = renumbered(triangles)
        points = points[used]
        maybe = np.flatnonzero(np.isin(points[:, 0], curve[:, 0]))
        place = {bytes(points[index]): index for index in maybe.tolist()}
        tree = search_tree(points, triangles)
        own = np.array([place.get(bytes(point), -1) for point in np.ascontiguousarray(curve)])
        return cls(tree, points, triangles, labels, own, used)

    @cached_property
    def face_normals(self) -> np.ndarray:
        """(t, 3) float64, of length 1, or 0 where a triangle has no area."""
        return unit(self._areas)

    @cached_property
    def vertex_normals(self) -> np.ndarray:
        """(v, 3) float64."""
        areas = np.repeat(self._areas, 3, axis=0)
        return unit(sums_by(self.triangles.ravel(), areas, len(self.points)))

    @cached_property
    def crosses_itself(self) -> bool:
        """Whether triangles cross that have no vertex in common."""
        return len(crossing(self.tree, self.tree, self.triangles, self.triangles)) > 0

    @property
    def _areas(self) -> np.ndarray:
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        return cross(b - a, c - a)

    def nearest(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The nearest point of the surface to each of some places, and the normal there, (k, 3) float64 each."""
        found = [self.tree.find_nearest(place) for place in places.tolist()]
        return np.array([near[0][:] for near in found]), np.array([near[1][:] for near in found])

    def heights(self, places: np.ndarray) -> np.ndarray:
        """How far some places are above the surface near them; below it less than 0. (k,) float64."""
        on, normal = self.nearest(places)
        return ((places - on) * normal).sum(axis=1)

    def free_way(self, places: np.ndarray, direction: np.ndarray, start: float) -> np.ndarray:
        """How far it is to the surface from some places, in directions of length 1; (k,) float64, inf if it is not met.

        start : float, so far from the places the rays begin.
        """
        found = []
        for place, way in zip(places + start * direction, direction, strict=True):
            distance = self.tree.ray_cast(place.tolist(), way.tolist())[3] if way.any() else None
            found.append(np.inf if distance is None else distance + start)
        return np.array(found)

    def crossings(self, places: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pairs of triangles that cross and have no point in common.

        Parameters
        ----------
        places : (k + m, 3) float64
            Points of a surface; the first k are those of the curve.
        triangles : (t, 3) int64
            Its triangles.

        Returns
        -------
        with_body : (p, 2) int64
            Triangles of the surface, and of the body.
        within : (q, 2) int64
            Triangles of the surface.
        """
        tree = search_tree(places, triangles)
        own = np.concatenate([self.own, full(len(places) - len(self.own), -2)])[triangles]
        return crossing(tree, self.tree, own, self.triangles), crossing(tree, tree, triangles, triangles)
