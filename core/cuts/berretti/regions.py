# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of the paper (section 3.1): intervals fused, then regions, then small ones removed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebTopology
from ...surface.arrays import components, renumbered
from ..hierarchy import Hierarchy


@dataclass(frozen=True, eq=False)
class Regions:
    """Pieces of slabs grouped to regions, and the order in which small regions go.

    Attributes
    ----------
    piece_region : (P,) int64
        0..count-1.
    count : int
    hierarchy : Hierarchy
        The fusion of the smallest region first, continued until one is left.
    """

    piece_region: np.ndarray
    count: int
    hierarchy: Hierarchy


def berretti_regions(
    sets: LevelSets, topology: ReebTopology, small_region: float
) -> Regions:
    """The paper's regions, before and through its removal of small ones.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component.
    topology : ReebTopology
        Its Reeb graph without ripples.
    small_region : float
        A region is small whose area is below this share of the largest region's (paper: 0.05).
        Salience 0.5 stands for this threshold.

    Returns
    -------
    regions : Regions
    """
    count, region = fuse_intervals(sets, topology)
    count, region = fuse_equal_adjacency(sets, count, region)
    return rank_regions(sets, region, small_region)


def rank_regions(sets: LevelSets, region: np.ndarray, small_region: float) -> Regions:
    """The hierarchy of given regions, (P,) int64: small ones go first, as above."""
    names, region = renumbered(region)
    merges, ratio = fuse_small(sets, len(names), region)
    salience = ratio / (ratio + small_region)
    return Regions(region, len(names), Hierarchy.of(len(names), merges, salience))


def fuse_intervals(sets: LevelSets, topology: ReebTopology) -> tuple[int, np.ndarray]:
    """Fuse contiguous slabs with the same number of connected components until all differ.

    Ripples (leaves that ``simplify`` cancelled) are not counted: each would end an interval for
    the whole surface. They belong to the region they sit on.

    Returns
    -------
    count : int
        Of regions: connected components of the intervals.
    region : (P,) int64
    """
    kept = topology.contour_arc >= 0
    on_graph = np.zeros(sets.n_pieces, bool)
    on_graph[sets.contour_pieces[kept]] = True
    on_graph |= ~on_graph.any()  # a graph of one node has no contour
    interval = np.arange(len(sets.levels) + 1)  # of each slab
    while True:
        piece_interval = interval[sets.piece_slab]
        lower, upper = piece_interval[sets.contour_pieces].T
        _, part = components(sets.n_pieces, *sets.contour_pieces[lower == upper].T)
        first = np.unique(part[on_graph], return_index=True)[1]
        n_parts = np.bincount(piece_interval[on_graph][first], minlength=interval[-1] + 1)
        starts = np.append(True, n_parts[1:] != n_parts[:-1])
        if starts.all():
            break
        interval = (np.cumsum(starts) - 1)[interval]
    return components(sets.n_pieces, *sets.contour_pieces[(lower == upper) | ~kept].T)


class FusionGraph:
    """Regions that touch, with areas and the length of the boundaries between them."""

    def __init__(self, sets: LevelSets, count: int, region: np.ndarray):
        self.area = np.bincount(region, sets.piece_area, count).tolist()
        self.neighbors = [{} for _ in range(count)]
        self.alive = set(range(count))
        lower, upper = region[sets.contour_pieces].T
        for a, b, length in zip(lower.tolist(), upper.tolist(), sets.contour_length.tolist(),
                                strict=True):
            if a != b:
                self.neighbors[a][b] = self.neighbors[a].get(b, 0.0) + length
                self.neighbors[b][a] = self.neighbors[b].get(a, 0.0) + length

    def merge(self, keep: int, gone: int):
        """Fuse one region into another."""
        self.area[keep] += self.area[gone]
        self.alive.discard(gone)
        for other, length in self.neighbors[gone].items():
            del self.neighbors[other][gone]
            if other != keep:
                for a, b in ((keep, other), (other, keep)):
                    self.neighbors[a][b] = self.neighbors[a].get(b, 0.0) + length
        self.neighbors[gone] = {}

    def longest_boundary(self, region: int) -> int:
        """The neighbor that shares the longest boundary; the first of equals."""
        around = self.neighbors[region]
        return max(sorted(around), key=lambda other: around[other])


def fuse_equal_adjacency(
    sets: LevelSets, count: int, region: np.ndarray
) -> tuple[int, np.ndarray]:
    """Fuse adjacent regions with the same number of neighbors, until no two are left.

    The paper leaves the order open: the pair of least area first, so that slivers go before
    parts.

    Returns
    -------
    count : int
    region : (P,) int64
    """
    graph = FusionGraph(sets, count, region)
    target = np.arange(count)
    while True:
        pairs = [(graph.area[a] + graph.area[b], a, b) for a in sorted(graph.alive)
                 for b in graph.neighbors[a]
                 if a < b and len(graph.neighbors[a]) == len(graph.neighbors[b])]
        # Two regions are each other's only neighbor: fusing them would end with none.
        if not pairs or len(graph.alive) <= 2:
            break
        _, keep, gone = min(pairs)
        graph.merge(keep, gone)
        target[target == gone] = keep
    kept, fused = renumbered(target[region])
    return len(kept), fused


def fuse_small(
    sets: LevelSets, count: int, region: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Fuse the smallest region into the neighbor with the longest boundary, until one is left.

    Returns
    -------
    merges : (count - 1, 2) int64
        Regions fused, in order.
    ratio : (count - 1,) float64
        Area of the smaller over that of the largest region at that time.
    """
    graph = FusionGraph(sets, count, region)
    merges, ratio = [], []
    while len(graph.alive) > 1:
        smallest = min(graph.alive, key=lambda r: (graph.area[r], r))
        largest = max(graph.area[r] for r in graph.alive)
        neighbor = graph.longest_boundary(smallest)
        merges.append((neighbor, smallest))
        ratio.append(graph.area[smallest] / largest)
        graph.merge(neighbor, smallest)
    return np.array(merges, np.int64).reshape(-1, 2), np.array(ratio)
