# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface reduced to some hundred patches: what is bisected, whatever the number of faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import place_among, renumbered
from ...arrays.int64 import cumsum
from ...arrays.vectors import distances_between, middles_of_each
from ...mesh.labels import label_boundaries
from ...mesh.triangles import TriMesh
from ...surface.curvature import curvature_across
from ..patches import concave_patches

N_PATCHES = 600  # upper bound of the number of patches
CREASE_SCALE = (0.015,)  # width over which normals are smoothed, in units of the square root of the area


@dataclass(frozen=True, eq=False)
class PatchGraph:
    """Patches and the borders between them; all lengths in units of the square root of the whole area.

    Attributes
    ----------
    area : (k,) float64
        Share of each patch in the whole area.
    pairs : (b, 2) int64
        Patches that touch, the smaller first.
    length : (b,) float64
        Length of each border.
    way : (b,) float64
        Distance of the centroids of the two patches.
    crease : (b,) float64
        Mean concavity along each border: the negative part of the curvature across it, 0 where it is convex.
    """

    area: np.ndarray
    pairs: np.ndarray
    length: np.ndarray
    way: np.ndarray
    crease: np.ndarray

    @classmethod
    def of(cls, mesh: TriMesh) -> tuple[PatchGraph, np.ndarray]:
        """Divide a surface into patches.

        mesh : TriMesh, m faces turned outwards. Returns a PatchGraph and the patch of each face, (m,) int64.
        """
        label = concave_patches(mesh, N_PATCHES)
        count, unit = int(label.max()) + 1, np.sqrt(mesh.area)
        area, center = middles_of_each(label, mesh.face_centroids, mesh.face_weight, count)
        concave = np.maximum(-curvature_across(mesh, CREASE_SCALE)[0], 0.0)
        pairs, length = label_boundaries(label, mesh.edges.pairs, mesh.pair_length)
        crease = label_boundaries(label, mesh.edges.pairs, mesh.pair_length * concave)[1]
        length = length + 1e-9 * unit
        a, b = pairs.T
        way = distances_between(center, a, b) / unit
        return cls(area / area.sum(), pairs, length / unit, np.maximum(way, 1e-6), crease / length), label

    def within(self, chosen: np.ndarray) -> PatchGraph:
        """Copy some patches, given in rising order as (j,) int64, and the borders between them."""
        pairs = place_among(chosen, len(self.area))[self.pairs]
        kept = (pairs >= 0).all(axis=1)
        return PatchGraph(self.area[chosen], pairs[kept], self.length[kept], self.way[kept], self.crease[kept])

    def components_of(self, chosen: np.ndarray) -> list[np.ndarray]:
        """Connected components of some patches, (k,) bool: the patches of each in rising order, the largest one first.
        """
        a, b = self.pairs[chosen[self.pairs].all(axis=1)].T
        component = renumbered(components(len(chosen), a, b)[1][chosen])[1]
        patches = np.flatnonzero(chosen)
        area = np.bincount(component, self.area[patches])
        order = np.argsort(component, kind="stable")
        parts = np.split(patches[order], cumsum(np.bincount(component))[:-1])
        return [parts[p] for p in np.argsort(-area, kind="stable")]
