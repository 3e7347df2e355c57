# SPDX-License-Identifier: GPL-3.0-or-later
"""Greedy merging: the two regions of the weakest cut merge, and the cuts of the new region are judged again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...arrays.indexing import bounds_of_each, sums_by
from ...arrays.int64 import arange
from ...mesh.labels import borders
from ...mesh.triangles import TriMesh
from .features import RegionMeasures, cut_features_, region_shape
from .measures import BORDER, REGION, SurfaceMeasures

# While there are more than MANY_REGIONS regions, several pairs merge in one round: those whose cut is the weakest of
# both regions and among the weakest WEAKEST_SHARE of all cuts. With fewer regions, pairs whose cut is below WEAK_CUT
# (a salience, 0..1) still merge in rounds; after that, one pair merges at a time.
MANY_REGIONS = 60
WEAK_CUT = 0.12
WEAKEST_SHARE = 0.2
# How long a ring is whose rims are one cut, and one whose rims are two, in radii of a circle like its rims. Of rings
# found on benchmark meshes of categories not learned from, people had made 2 of 23 that were shorter than 0.94, 5 of 8
# up to 1.26, and 24 of 33 that were longer.
SHORT_RING, LONG_RING = 0.8, 1.5

#: Called with a graph and some of its borders, (k,) int64; returns how much each deserves to stay, (k,) float64, 0..1.
Judge = Callable[["RegionAdjacencyGraph", np.ndarray], np.ndarray]


class RegionAdjacencyGraph:
    """Regions, the borders between them, and the sums of measures over both; ``merge_`` changes them.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    measures : SurfaceMeasures
        Measures of the faces and pairs of faces of ``mesh``.
    label : (m,) int64
        Region of each face, 0..c-1, all in use.

    Attributes
    ----------
    regions : RegionMeasures
        c rows. When two regions merge, the row of one of them is used for the union.
    ends : (b, 2) int64
        The two regions of each border.
    border : (b, BORDER.width) float64
        Sum over each border of ``SurfaceMeasures.pair``.
    neighbors : list of dict of int -> int
        For each region the border that it shares with each neighbor.
    """

    def __init__(self, mesh: TriMesh, measures: SurfaceMeasures, label: np.ndarray) -> None:
        n = int(label.max()) + 1
        between, self.ends, border = borders(label, mesh.edges.pairs)
        self.border = sums_by(border, measures.pair[between], len(self.ends))
        first, second = self.ends.T
        around = sums_by(first, self.border, n) + sums_by(second, self.border, n)
        level_min, level_max = bounds_of_each(label, measures.level, n)
        _, agd_max = bounds_of_each(label, measures.agd, n)
        sums = sums_by(label, measures.face, n)
        perimeter = around[:, BORDER.length].copy()
        degree = np.bincount(self.ends.ravel(), minlength=n).astype(float)
        shape = region_shape(sums, perimeter, level_min, level_max)
        self.regions = RegionMeasures(sums, level_min, level_max, agd_max, perimeter, degree, around,
                               shape, np.ones(n, bool))
        self._changed: list[int] = []
        self.neighbors: list[dict[int, int]] = [{} for _ in range(n)]
        for index, (a, b) in enumerate(self.ends.tolist()):
            self.neighbors[a][b] = self.neighbors[b][a] = index

    def features_(self, borders: np.ndarray) -> np.ndarray:
        """Compute the features of some borders, and anew the shape of regions that others have merged into.

        borders : (k,) int64. Returns (k, len(FEATURES)) float64, see ``cut_features_``.
        """
        changed, self._changed = self._changed, []
        return cut_features_(self.regions, self.ends[borders], self.border[borders], changed)

    def merge_(self, border: int) -> list[int]:
        """Merge the second region of a border into the first.

        The shape of the first region is computed anew with the next features, or by ``measure_``.

        Parameters
        ----------
        border : int

        Returns
        -------
        gone : list of int
            Borders that no longer exist: the given one, and those that became one with another border.
        """
        a, b = (int(end) for end in self.ends[border])
        r, lost = self.regions, self.border[border]
        for sums in (r.sums, r.around, r.perimeter):
            sums[a] += sums[b]
        r.around[a] -= 2 * lost
        r.perimeter[a] = max(r.perimeter[a] - 2 * lost[BORDER.length], 0.0)
        r.level_min[a] = min(r.level_min[a], r.level_min[b])
        r.level_max[a] = max(r.level_max[a], r.level_max[b])
        r.agd_max[a] = max(r.agd_max[a], r.agd_max[b])
        r.alive[b] = False
        self._changed.append(a)
        del self.neighbors[a][b], self.neighbors[b][a]
        gone = [border]
        for other, index in self.neighbors[b].items():
            del self.neighbors[other][b]
            kept = self.neighbors[a].get(other)
            if kept is None:
                self.ends[index] = (a, other)
                self.neighbors[a][other] = self.neighbors[other][a] = index
            else:
                self.border[kept] += self.border[index]
                r.degree[other] -= 1
                gone.append(index)
        self.neighbors[b] = {}
        r.degree[a] = len(self.neighbors[a])
        return gone

    def measure_(self) -> None:
        """Compute the shape of regions anew into which others have merged since it was asked for features."""
        self.features_(np.empty(0, np.int64))


def merge_all_(graph: RegionAdjacencyGraph, judge: Judge) -> tuple[np.ndarray, np.ndarray]:
    """Merge regions, the weakest cut first, until one is left; changes the graph.

    Parameters
    ----------
    graph : RegionAdjacencyGraph
        c regions of one connected surface.
    judge : callable
        judge(graph, borders) returns how much each of some borders deserves to stay, 0..1.

    Returns
    -------
    merges : (c - 1, 2) int64
        The region that stays and the region that merges into it, in order.
    strength : (c - 1,) float64
        What the judge returned for the border of each merge, at the time of the merge, or less: see
        ``_share_of_its_own``; not monotone.
    """
    n = len(graph.regions.alive)
    strength = judge(graph, arange(len(graph.ends)))
    merges, strengths = [], []
    while len(merges) < n - 1 and np.isfinite(strength).any():
        again = set()
        for border in _next(graph, strength, n - len(merges)):
            merges.append(graph.ends[border].copy())
            strengths.append(_share_of_its_own(graph, strength, border))
            gone = graph.merge_(border)
            strength[gone] = np.inf
            again.update(graph.neighbors[int(merges[-1][0])].values())
            again.difference_update(gone)
        if again:
            changed = np.array(sorted(again))
            strength[changed] = judge(graph, changed)
    graph.measure_()
    return np.reshape(merges, (-1, 2)).astype(np.int64), np.array(strengths, float)


def _share_of_its_own(graph: RegionAdjacencyGraph, strength: np.ndarray, border: int) -> float:
    """How much the smaller region of a border deserves to stay, 0..1, by all larger regions that it may belong to.

    strength : (b,), what the judge returned for each border.

    The judge looks at one border at a time: to a wedge between finger and palm it gives 0.6 against either. But the
    wedge can belong to only one of them, so that what is left for a part of its own is 1 - 0.4 - 0.4 = 0.2.
    Of the other neighbors those count that touch the one across the border: the handle of a dumbbell belongs to neither
    ball. A neighbor counts from not at all, if it is as large as the region, to fully, if it is twice as large;
    otherwise chance would say which of two equal regions is the smaller. Of a ring whose two rims are one cut nothing
    is its own.
    """
    area = graph.regions.sums[:, REGION.area]
    small, large = sorted(graph.ends[border].tolist(), key=area.__getitem__)
    neighbors = list(graph.neighbors[small])
    larger = np.minimum(np.maximum(area[neighbors] / max(area[small], 1e-30) - 1, 0.0), 1.0)
    rival = np.array([other == large or other in graph.neighbors[large] for other in neighbors])
    left = 1 - strength[[graph.neighbors[small][other] for other in neighbors]]
    own = max(0.0, 1 - (larger * left)[rival].sum())
    if len(neighbors) == 2 and not rival.all():
        own *= 1 - larger.prod() * _is_one_cut(graph, small)
    share = float(strength[border])
    return share - float(larger[neighbors.index(large)]) * max(0.0, share - own)


def _is_one_cut(graph: RegionAdjacencyGraph, ring: int) -> float:
    """How much the two rims of a ring, a region between two others, are one cut that was found twice, 0..1."""
    rim = graph.border[list(graph.neighbors[ring].values()), BORDER.length].mean()
    length, radius = graph.regions.sums[ring, REGION.area] / max(rim, 1e-30), rim / (2 * np.pi)
    return float(np.clip((LONG_RING - length / max(radius, 1e-30)) / (LONG_RING - SHORT_RING), 0.0, 1.0))


def _next(graph: RegionAdjacencyGraph, strength: np.ndarray, n_regions: int) -> list[int]:
    """Borders whose regions merge in one round, the weakest first; no region occurs twice.

    strength : (b,), what the judge returned for each border; infinite for a border that no longer exists.
    """
    weakest = int(strength.argmin())
    if n_regions <= MANY_REGIONS and strength[weakest] >= WEAK_CUT:
        return [weakest]
    live = np.flatnonzero(np.isfinite(strength))
    s, ends = strength[live], graph.ends[live]
    limit = np.sort(s)[int(WEAKEST_SHARE * len(s))] if n_regions > MANY_REGIONS else WEAK_CUT
    least = np.full(len(graph.regions.alive), np.inf)
    np.minimum.at(least, ends, s[:, None])
    mutual = (s == least[ends[:, 0]]) & (s == least[ends[:, 1]])
    chosen = live[mutual & (s <= max(limit, strength[weakest]))]
    chosen = chosen[np.argsort(strength[chosen], kind="stable")]
    # A region may have two weakest borders of equal strength. The first of them merges.
    _, first = np.unique(graph.ends[chosen], return_index=True)
    once = np.zeros(2 * len(chosen), bool)
    once[first] = True
    return chosen[once.reshape(-1, 2).all(axis=1)].tolist()
