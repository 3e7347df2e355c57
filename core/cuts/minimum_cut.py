# SPDX-License-Identifier: GPL-3.0-or-later
"""Where exactly a cut runs: the cheapest line in a band around it.

Every pair of parts that touch is cut anew by a minimum cut: along creases a line costs little,
over ridges much, everywhere in proportion to its length, and more the farther it leaves its place.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, dijkstra, maximum_flow

from ..surface.arrays import both_ways, symmetric_matrix
from ..surface.labels import label_boundaries, spread
from ..surface.mesh import TriMesh
from .hierarchy import Hierarchy

WIDEST = 0.05  # half the width of the band, at most, over the square root of the area
CREASE = 12.0  # curvature, times the square root of the area, that changes the cost by e
CHEAPEST, DEAREST = 0.05, 3.0
UNITS = 10_000  # capacities are whole numbers: the mean edge has so many


def minimum_cuts(mesh: TriMesh, curvature: np.ndarray, part: np.ndarray, band_ratio: float = 0.5,
                within: np.ndarray | None = None) -> np.ndarray:
    """Move the borders of parts into the creases beside them.

    Parameters
    ----------
    mesh : TriMesh
        m faces, one connected component.
    curvature : (p,) float64
        Across each pair of faces, times the square root of the area; negative in concavities.
    part : (m,) int64
    band_ratio : float
        Half the width of the band over the radius of a circle as long as the cut; 0 moves nothing.
    within : (m,) int64, optional
        Coarser parts: cuts between these stay.

    Returns
    -------
    part : (m,) int64
        Parts may have come apart into pieces.
    """
    part = part.copy()
    if band_ratio <= 0:
        return part
    a, b = mesh.edges.pairs.T
    length = mesh.pair_length
    cost = length * np.clip(np.exp(curvature / CREASE), CHEAPEST, DEAREST)
    way = np.maximum(mesh.pair_distance, 1e-9 * np.sqrt(mesh.area))
    ways = symmetric_matrix(mesh.edges.pairs, way, mesh.n_faces)
    free = np.ones(len(a), bool) if within is None else within[a] == within[b]
    for first, second in _cuts_by_length(part, a[free], b[free], length[free]):
        on_cut = ((part[a] == first) & (part[b] == second)) | ((part[a] == second) & (part[b] == first))
        if on_cut.any():
            part = _cut_anew(mesh, part, first, second, on_cut, cost, ways, band_ratio)
    return part


def move_cuts(mesh: TriMesh, label: np.ndarray, hierarchy: Hierarchy, curvature: np.ndarray,
              band_ratio: float, details: tuple[float, ...] = (0.5, 0.75)) -> np.ndarray:
    """Candidates after the cuts of some levels of detail have moved into creases.

    Parameters
    ----------
    mesh : TriMesh
        m faces, one connected component.
    label : (m,) int64
        Candidate of each face.
    hierarchy : Hierarchy
        Over the candidates.
    curvature, band_ratio
        As ``minimum_cuts`` takes them.
    details : tuple of float
        Rising; cuts that an earlier one has moved stay there.

    Returns
    -------
    label : (m,) int64
        Faces that changed part follow a neighbor in their new part, from the cut outwards.
    """
    a, b = both_ways(mesh.edges.pairs).T
    coarser = None
    for detail in details:
        parts = hierarchy.parts(hierarchy.n_parts(detail))
        part = parts[label]
        moved = minimum_cuts(mesh, curvature, part, band_ratio, coarser)
        before, label = label, np.where(moved == part, label, -1)
        together = moved[a] == moved[b]
        label = spread(label, a[together], b[together])
        label = np.where(label < 0, before, label)  # an island with no such neighbor stays
        coarser = moved
    return label


def _cuts_by_length(part, a, b, length) -> np.ndarray:
    """(k, 2) pairs of parts that touch, the longest border first."""
    touching, total = label_boundaries(part, np.stack([a, b], axis=1), length)
    return touching[np.argsort(-total, kind="stable")]


def _cut_anew(mesh, part, first, second, on_cut, cost, ways, band_ratio) -> np.ndarray:
    """One minimum cut between two parts, in a band around their border."""
    a, b = mesh.edges.pairs.T
    unit = np.sqrt(mesh.area)
    border = mesh.pair_length[on_cut].sum()
    half = min(band_ratio * border / (2 * np.pi), WIDEST * unit)
    sources = np.unique(mesh.edges.pairs[on_cut])
    distance = dijkstra(ways, directed=True, indices=sources, min_only=True, limit=half)
    band = np.isfinite(distance) & ((part == first) | (part == second))
    inner = np.flatnonzero(band[a] & band[b])
    place = np.full(mesh.n_faces, -1)
    faces = np.flatnonzero(band)
    place[faces] = np.arange(len(faces))
    # Faces with a neighbor of the same part outside the band hold the ends of the band.
    edge = np.flatnonzero((band[a] != band[b]) & (part[a] == part[b]))
    held = np.unique(np.where(band[a[edge]], a[edge], b[edge]))
    if not ((part[held] == first).any() and (part[held] == second).any()):
        return part
    far = np.maximum(distance[a[inner]], distance[b[inner]]) / half
    side = _minimum_cut(place[a[inner]], place[b[inner]], cost[inner] * (1 + far**2), place[held],
                        part[held] == first, len(faces))
    part = part.copy()
    part[faces] = np.where(side, first, second)
    return part


def _minimum_cut(a, b, cost, held, is_source, n) -> np.ndarray:
    """(n,) bool, nodes on the source's side of the cheapest cut."""
    capacity = np.maximum(np.rint(cost / cost.mean() * UNITS), 1.0)
    endless = float(2**30)
    source, sink = n, n + 1
    rows = np.concatenate([a, b, np.full(is_source.sum(), source), held[~is_source]])
    columns = np.concatenate([b, a, held[is_source], np.full((~is_source).sum(), sink)])
    values = np.concatenate([capacity, capacity, np.full(len(held), endless)])
    graph = coo_array((np.minimum(values, endless).astype(np.int32), (rows, columns)),
                      shape=(n + 2, n + 2)).tocsr()
    flow = maximum_flow(graph, source, sink).flow
    left = graph - flow
    left.data = (left.data > 0).astype(np.int8)
    left.eliminate_zeros()
    reached = breadth_first_order(left, source, return_predecessors=False)
    side = np.zeros(n + 2, bool)
    side[reached] = True
    return side[:n]
