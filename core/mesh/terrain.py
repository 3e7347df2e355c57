# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain: ground that is one surface with what stands on it, as in a scan with a patch of the floor.

It is told by its slope, as in scans of landscapes [Vosselman2000]: what stands on it rises more steeply than it does
itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import bounds_of_each, largest_of_each, sums_by
from ..arrays.int64 import arange
from ..arrays.pairs import distinct_pairs
from ..arrays.vectors import (
    across,
    cross_in_plane,
    inner_products,
    middles_of_each,
    second_moments,
    unit,
    weighted_sum,
)
from .triangles import TriMesh

# Cosine of the slope, 60 degrees, up to which faces are terrain.
LEVEL = 0.5
# Seen from above, the outline of all has at least so many times the area of that of what stands there.
WIDER = 1.5
# Height of hills, in units of the root of the area of the whole outline. What stands there is higher, or, if all of it
# is low, higher than this share of the highest.
HILL, LOW = 0.05, 0.25
# Terrain covers this share of the outline, at least. This share of the area, at most, is lower by more than a hill: if
# it is solid, it is as thin. What something stands on with several feet may be so thick, in the same units as hills: on
# a table on its head each leg stands for itself.
COVERED, BELOW, THICK = 0.5, 0.1, 0.15
FOOT = 0.3  # share of the length of the longest seam of what stands there, from which on another one is of a foot, too
ALONG = 0.9  # cosine of the angle to what may be up from which on a face says more precisely what it is
SIDES = 32  # of the polygons by which outlines are measured
ROUNDS = 5  # in which normals are averaged over their neighbors if nothing is found without: scans are noisy


def rising_faces(mesh: TriMesh) -> Iterator[tuple[np.ndarray, bool]]:
    """Find faces that may stand on terrain, which all others are.

    Parameters
    ----------
    mesh : TriMesh
        One piece: m faces that hang together.

    Yields
    ------
    rising : (m,) bool
        Not none. Such faces for each direction that may be up, by normals as they are and averaged.
    on_feet : bool
        Whether something stands there on several feet.
    """
    for view, side, is_thin in _views(mesh):
        for rounds in (0, ROUNDS):
            rising = view.rising(side * _averaged(mesh, rounds))
            if not rising.any() or not view.is_wider_than(rising):
                continue
            on_feet = _stands_on_feet(mesh, rising)
            if is_thin or on_feet:
                yield rising, on_feet


def _views(mesh: TriMesh) -> Iterator[tuple[View, int, bool]]:
    """Views of a mesh in which what faces up may be terrain, the side of the faces that is outside, and what is below.

    That side is 1, or -1 as the mesh may be inside out. The last says whether little is below terrain: that it is thin.
    """
    for up in _directions(mesh):
        view = View(mesh, up)
        for side in (1, -1):
            height = view.heights_over_terrain(side * mesh.area_normals)
            if height is not None and view.may_rise(height):
                yield view, side, bool(mesh.face_area[height < -view.hill].sum() <= BELOW * mesh.area)


def _directions(mesh: TriMesh) -> list[np.ndarray]:
    """Unit vectors, (3,), that may be up: those along which most of the area faces, both ways."""
    direction = np.linalg.eigh(second_moments(unit(mesh.area_normals), mesh.face_area))[1][:, 2]
    along = inner_products(mesh.area_normals, direction)
    sign = np.where(np.abs(along) > ALONG * mesh.face_area, np.sign(along), 0.0)
    direction = np.asarray(weighted_sum(sign, mesh.area_normals))
    length = np.linalg.norm(direction)
    return [direction / length, -direction / length] if length > 0 else []


def _averaged(mesh: TriMesh, rounds: int) -> np.ndarray:
    """Normals of the faces, (m, 3), averaged over their neighbors so often, as long as their area."""
    normals = mesh.area_normals
    for _ in range(rounds):
        at_vertex = unit(sums_by(mesh.faces.ravel(), np.repeat(normals, 3, axis=0), mesh.n_vertices))
        normals = mesh.face_area[:, None] * unit(at_vertex[mesh.faces].sum(axis=1))
    return normals


def _stands_on_feet(mesh: TriMesh, rising: np.ndarray) -> bool:
    """Whether some of the faces that rise, (m,) bool, hang together and meet the others at several places."""
    pairs = mesh.edges.pairs
    inside = rising[pairs]
    count, region = components(mesh.n_faces, *pairs[inside.all(axis=1)].T)
    seam = np.flatnonzero(inside.sum(axis=1) == 1)
    edge = mesh.edges.pair_edge[seam]
    ends = mesh.edges.vertices[edge]
    n_seams, of_vertex = components(mesh.n_vertices, *ends.T)
    of = of_vertex[ends[:, 0]]
    length = np.bincount(of, mesh.edge_length[edge], n_seams)
    owner, which = distinct_pairs(region[pairs[seam][inside[seam]]], of)[0].T
    is_foot = length[which] >= FOOT * largest_of_each(owner, length[which], count)[owner]
    return bool((np.bincount(owner, is_foot) > 1).any())


@dataclass(frozen=True, eq=False)
class View:
    """A piece of a surface as seen from above.

    Attributes
    ----------
    mesh : TriMesh
        m faces.
    up : (3,) float64
        Of length 1.
    """

    mesh: TriMesh
    up: np.ndarray

    @cached_property
    def level(self) -> np.ndarray:
        """(m,) float64, height of the middle of each face, in the unit of the vertices."""
        return inner_products(self.mesh.vertices, self.up)[self.mesh.faces].mean(axis=1)

    @cached_property
    def outline(self) -> float:
        """Area of the outline of the whole, in squared units."""
        return self._outline_of(self.mesh.faces)

    @property
    def hill(self) -> float:
        """Height of hills, in the unit of the vertices."""
        return HILL * float(np.sqrt(self.outline))

    def is_wider_than(self, some: np.ndarray) -> bool:
        """Whether the outline is as much larger than that of some faces, (m,) bool, as that of terrain is."""
        return self.outline >= WIDER * self._outline_of(self.mesh.faces[some])

    def heights_over_terrain(self, normals: np.ndarray) -> np.ndarray | None:
        """How high faces are, (m,), over the middle height of those that face up.

        normals : (m, 3), as long as the areas. Returns None where these are no terrain: within a hill of that height
        they do not cover enough of the outline.
        """
        seen = inner_products(normals, self.up)
        facing = np.flatnonzero(seen > LEVEL * self.mesh.face_area)
        if not len(facing):
            return None
        order = facing[np.argsort(self.level[facing])]
        weight = np.cumsum(seen[order])
        height = self.level - self.level[order[np.searchsorted(weight, weight[-1] / 2)]]
        covered = seen[facing[np.abs(height[facing]) <= self.hill]].sum()
        return height if covered >= COVERED * self.outline else None

    def may_rise(self, height: np.ndarray) -> bool:
        """A quick look: whether what is high over terrain has a small outline, and nothing is far below.

        height : (m,), as of ``heights_over_terrain``.
        """
        high = height > min(self.hill, height.max() / 2)
        return bool(high.any() and height.min() >= -THICK * np.sqrt(self.outline)) and self.is_wider_than(high)

    def rising(self, normals: np.ndarray) -> np.ndarray:
        """The faces that rise from terrain, (m,) bool; normals : (m, 3), as long as the areas.

        Terrain is the largest region of faces that face up, and all regions beside it that are not higher than hills.
        """
        mesh, pairs = self.mesh, self.mesh.edges.pairs
        seen = inner_products(normals, self.up)
        facing = seen > LEVEL * mesh.face_area
        count, region = components(mesh.n_faces, *pairs[facing[pairs].all(axis=1)].T)
        terrain = region == np.bincount(region, np.where(facing, seen, 0.0), count).argmax()
        count, region = components(mesh.n_faces, *pairs[~terrain[pairs].any(axis=1)].T)
        seam = pairs[terrain[pairs].sum(axis=1) == 1]
        n_sides, foot = middles_of_each(
            region[seam[~terrain[seam]]], self.level[seam[terrain[seam]]][:, None], np.ones(len(seam)), count)
        middle = middles_of_each(region, self.level[:, None], mesh.face_area, count)[1]
        rise = np.where(n_sides > 0, bounds_of_each(region, self.level, count)[1] - foot[:, 0], 0.0)
        rises = (middle > foot)[:, 0] & (rise > min(self.hill, LOW * rise.max()))
        return rises[region] & ~terrain

    def _outline_of(self, faces: np.ndarray) -> float:
        """Area of the outline of some faces, (k, 3) int64."""
        there = np.zeros(self.mesh.n_vertices, bool)
        there[faces] = True
        return outline_area(self.mesh.vertices[there], self.up)


def outline_area(points: np.ndarray, up: np.ndarray) -> float:
    """Area of what points are around, seen from above: of the polygon of those that lie farthest out.

    points : (n, 3) float64, at least one. up : (3,) float64, of length 1. Returns squared units of the points.
    """
    one = across(up)
    x, y = inner_products(points, one), inner_products(points, np.cross(up, one))
    angle = 2 * np.pi * arange(SIDES) / SIDES
    farthest = [int((x * a + y * b).argmax()) for a, b in zip(np.cos(angle), np.sin(angle), strict=True)]
    corner = np.stack([x[farthest] - x[0], y[farthest] - y[0]], axis=1)
    return float(cross_in_plane(corner, np.roll(corner, -1, axis=0)).sum() / 2)
