# SPDX-License-Identifier: GPL-3.0-or-later
"""Minimum cuts: each cut between two parts moves to the cheapest line in a band around it.

The cost of a line is its length, weighed by curvature: a line costs little along creases and much across ridges. It
costs more toward the rim of the band, so that cuts stay near their places.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, dijkstra, maximum_flow

from ..arrays.indexing import place_among
from ..arrays.int64 import full
from ..arrays.pairs import symmetric_matrix
from ..mesh.labels import follow, label_boundaries
from ..mesh.triangles import TriMesh
from .hierarchy import Hierarchy

if TYPE_CHECKING:
    from scipy.sparse import csr_array

WIDEST = 0.05  # upper bound of half the width of the band, in units of the square root of the area
# The cost of an edge is its length times exp(curvature / CREASE), where this factor is bounded by CHEAPEST and DEAREST.
# CREASE is in units of 1 / square root of the area.
CREASE = 12.0
CHEAPEST, DEAREST = 0.05, 3.0
UNITS = 10_000  # capacity of an edge of mean cost; SciPy takes whole numbers only


@dataclass(frozen=True, eq=False)
class MovableCuts:
    """A surface of m faces on which cuts move: what they cost where, and how far they may go.

    Attributes
    ----------
    mesh : TriMesh
        m faces, one connected component.
    curvature : (p,) float64
        Curvature across each pair of faces, in units of 1 / square root of the area; negative in concavities.
    band_ratio : float
        Half the width of the band over the radius of a circle as long as the cut; 0 moves nothing.
    widest : float, optional
        Upper bound of half the width of the band, in the unit of the vertices; without it, WIDEST.
    fixed : (m,) bool, optional
        Faces that keep their part.
    """

    mesh: TriMesh
    curvature: np.ndarray
    band_ratio: float = 0.5
    widest: float | None = None
    fixed: np.ndarray | None = None

    @cached_property
    def cost(self) -> np.ndarray:
        """(p,) float64, what it costs to cut between each pair of faces, in the unit of the vertices."""
        return self.mesh.pair_length * np.clip(np.exp(self.curvature / CREASE), CHEAPEST, DEAREST)

    @cached_property
    def distance(self) -> csr_array:
        """(m, m) csr, distance between the faces of each pair, above 0."""
        mesh = self.mesh
        return symmetric_matrix(mesh.edges.pairs, np.maximum(mesh.pair_distance, 1e-9 * np.sqrt(mesh.area)),
                                mesh.n_faces)

    def half_width(self, length: float) -> float:
        """Half the width of the band around a cut of some length."""
        widest = WIDEST * np.sqrt(self.mesh.area) if self.widest is None else self.widest
        return min(self.band_ratio * length / (2 * np.pi), widest)


def minimum_cuts(movable: MovableCuts, part: np.ndarray, within: np.ndarray | None = None) -> np.ndarray:
    """Move the cuts between parts into the creases beside them.

    Parameters
    ----------
    movable : MovableCuts
        Of m faces.
    part : (m,) int64
        Part of each face, 0 or more.
    within : (m,) int64, optional
        Coarser part of each face: cuts between coarser parts stay where they are.

    Returns
    -------
    part : (m,) int64
        Parts may no longer be connected.

    Notes
    -----
    The longest cut moves first. One minimum cut per pair of parts that touch.
    """
    part = part.copy()
    if movable.band_ratio <= 0:
        return part
    a, b = movable.mesh.edges.pairs.T
    length = movable.mesh.pair_length
    free = np.ones(len(a), bool) if within is None else within[a] == within[b]
    for first, second in _cuts_by_length(part, a[free], b[free], length[free]):
        of_a, of_b = part[a], part[b]
        on_cut = ((of_a == first) & (of_b == second)) | ((of_a == second) & (of_b == first))
        half_width = movable.half_width(length[on_cut].sum())
        if half_width > 0:  # parts may touch no longer, or along edges without a length
            part = _cut_anew(movable, part, (first, second), on_cut, half_width)
    return part


def move_cuts(
    movable: MovableCuts, label: np.ndarray, hierarchy: Hierarchy, details: tuple[float, ...] = (0.5, 0.75)
) -> np.ndarray:
    """Move the cuts of some levels of detail into creases, and let the candidates follow.

    Parameters
    ----------
    movable : MovableCuts
        Of m faces.
    label : (m,) int64
        Candidate of each face.
    hierarchy : Hierarchy
        The order in which the candidates merge.
    details : tuple of float
        Levels of detail whose cuts move, rising. Cuts that moved at one level stay in place at the next.

    Returns
    -------
    label : (m,) int64
        Candidate of each face. A face that changed part takes the candidate of a neighbor in its new part, from the cut
        outwards.
    """
    coarser = None
    for detail in details:
        part = hierarchy.parts_at(detail)[label]
        moved = minimum_cuts(movable, part, coarser)
        label = follow(label, part, moved, movable.mesh.edges.pairs)
        coarser = moved
    return label


def _cuts_by_length(part: np.ndarray, a: np.ndarray, b: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Pairs of parts that touch, (k, 2), the longest cut first."""
    touching, total = label_boundaries(part, np.stack([a, b], axis=1), length)
    return touching[np.argsort(-total, kind="stable")]


def _cut_anew(
    movable: MovableCuts, part: np.ndarray, two: tuple[int, int], on_cut: np.ndarray, half_width: float
) -> np.ndarray:
    """Part of each face, (m,), after one minimum cut between two parts, in a band around the cut that they have.

    on_cut : (p,) bool, whether each pair of faces lies across the cut.
    """
    pairs = movable.mesh.edges.pairs
    a, b = pairs.T
    first, second = two
    distance = dijkstra(movable.distance, directed=True, indices=np.unique(pairs[on_cut]), min_only=True,
                        limit=half_width)
    band = np.isfinite(distance) & ((part == first) | (part == second))
    rim = _rim(pairs, band, part)
    held = np.flatnonzero(rim if movable.fixed is None else rim | (band & movable.fixed))
    if not ((part[held] == first).any() and (part[held] == second).any()):
        return part
    faces, inner = np.flatnonzero(band), np.flatnonzero(band[a] & band[b])
    place = place_among(faces, len(part))
    far = np.maximum(distance[a[inner]], distance[b[inner]]) / half_width
    side = _minimum_cut(place[a[inner]], place[b[inner]], movable.cost[inner] * (1 + far**2), place[held],
                        part[held] == first, len(faces))
    part = part.copy()
    part[faces] = np.where(side, first, second)
    return part


def _rim(pairs: np.ndarray, band: np.ndarray, part: np.ndarray) -> np.ndarray:
    """The rim of a band, (m,) bool: its faces with a neighbor of their own part outside, which cannot change part."""
    across = np.flatnonzero(band[pairs[:, 0]] != band[pairs[:, 1]])
    a, b = pairs[across[part[pairs[across, 0]] == part[pairs[across, 1]]]].T
    rim = np.zeros(len(band), bool)
    rim[np.where(band[a], a, b)] = True
    return rim


def _minimum_cut(
    a: np.ndarray, b: np.ndarray, cost: np.ndarray, held: np.ndarray, is_source: np.ndarray, n: int
) -> np.ndarray:
    """Which of n nodes are on the source's side of the cheapest cut, (n,) bool.

    Nodes a[i] and b[i] are joined by an edge of cost[i]; nodes in ``held`` belong to the source where ``is_source`` is
    true, to the sink elsewhere.
    """
    capacity = np.maximum(np.rint(cost / cost.mean() * UNITS), 1.0)
    endless = float(2**30)  # what no cut is to go through; SciPy takes numbers of 32 bits
    source, sink = n, n + 1
    rows = np.concatenate([a, b, full(is_source.sum(), source), held[~is_source]])
    columns = np.concatenate([b, a, held[is_source], full((~is_source).sum(), sink)])
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
