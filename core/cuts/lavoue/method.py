# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates of like curvature after [Lavoue2005], for the preset "Lavoue 2005"."""

from __future__ import annotations

import numpy as np

from ...mesh.triangles import TriMesh
from ...surface.curvature import principal_curvatures
from ..hierarchy import Hierarchy
from ..patches import absorb_small
from .clusters import cluster
from .regions import CurvatureGraph, grow_regions, merge_regions

# Curvatures count as SCALE * arcsinh(curvature / SCALE), in units of 1 / square root of the area: a sharp edge has any
# curvature from some 20 upwards, as its triangles are small.
SCALE = 10.0
WIDTH = 0.02  # width over which the curvature of a vertex is taken, in units of the square root of the area
MOST_RINGS = 8  # upper bound of the number of rings of neighbors that lie in this width
SMALLEST = 0.001  # share of the area below which a region joins a neighbor before all others
DISTANCE_AT_HALF = 9.0  # distance, in units of 1 / square root of the area, at which a merge has salience 0.5


def lavoue_candidates(mesh: TriMesh, n_clusters: int = 0) -> tuple[np.ndarray, Hierarchy]:
    """Find regions of like curvature and the order in which they merge.

    Parameters
    ----------
    mesh : TriMesh
        m faces, turned outwards.
    n_clusters : int
        Number of classes of curvature; 0 chooses it from the data.

    Returns
    -------
    label : (m,) int64
        Region of each face, 0..c-1; every region is connected.
    hierarchy : Hierarchy
        Merges of the regions. Regions that touch along no edge never merge.
    """
    curvature = curvature_features(mesh)
    weight = mesh.vertex_area + 1e-12 * mesh.area
    region = grow_regions(mesh, cluster(curvature, weight, n_clusters))
    region = absorb_small(mesh, region, SMALLEST)
    merges, distance = merge_regions(CurvatureGraph(mesh, curvature, region))
    return region, Hierarchy.of(int(region.max()) + 1, merges, distance / (distance + DISTANCE_AT_HALF))


def curvature_features(mesh: TriMesh) -> np.ndarray:
    """Compute what vertices are classified by: both principal curvatures, large ones drawn together.

    mesh : TriMesh, n vertices. Returns (n, 2) float64, in units of 1 / square root of the area.
    """
    unit = np.sqrt(mesh.area)
    rings = int(np.clip(np.ceil(WIDTH * unit / max(mesh.edge_length.mean(), 1e-12 * unit)), 1, MOST_RINGS))
    return SCALE * np.arcsinh(principal_curvatures(mesh, rings) * unit / SCALE)
