# SPDX-License-Identifier: GPL-3.0-or-later
"""Fusion of the regions of [Berretti2009]: of the small ones, and of those that do not stick out."""

from __future__ import annotations

import heapq
from collections.abc import Iterator

import numpy as np

from ...graph.level_sets import LevelSets


class FusionGraph:
    """The regions while they are fused, with their areas and the lengths of the boundaries between them.

    Parameters
    ----------
    sets : LevelSets
        P slab pieces.
    count : int
        Number of regions.
    region : (P,) int64
        Region of each slab piece, 0..count-1.
    contours : (C,) bool, optional
        Contours across which regions are neighbors; all without.

    Attributes
    ----------
    area : list of float
        Area of each region, in squared units of the vertices.
    neighbors : list of dict of int -> float
        For each region the length of its boundary with each neighbor, in units of the vertices.
    contours : list of dict of int -> (int, float)
        Number of contours of each of these boundaries, and length of the longest.
    alive : set of int
        Regions that have not been fused into another.
    """

    def __init__(self, sets: LevelSets, count: int, region: np.ndarray, contours: np.ndarray | None = None) -> None:
        self.area = np.bincount(region, sets.piece_area, count).tolist()
        self.neighbors, self.contours = ([{} for _ in range(count)] for _ in range(2))
        self.alive = set(range(count))
        chosen = np.ones(sets.n_contours, bool) if contours is None else contours
        lower, upper = region[sets.contour_pieces[chosen]].T
        for a, b, length in zip(lower.tolist(), upper.tolist(), sets.contour_length[chosen].tolist(),
                                strict=True):
            if a != b:
                self._add(a, b, length, (1, length))

    def _add(self, a: int, b: int, length: float, contours: tuple[int, float]) -> None:
        """Add contours to the boundary between two regions: their length, their number and the longest one's length."""
        number, longest = self.contours[a].get(b, (0, 0.0))
        for one, other in ((a, b), (b, a)):
            self.neighbors[one][other] = self.neighbors[one].get(other, 0.0) + length
            self.contours[one][other] = number + contours[0], max(longest, contours[1])

    def merge_(self, keep: int, gone: int) -> None:
        """Fuse region ``gone`` into region ``keep``."""
        self.area[keep] += self.area[gone]
        self.alive.discard(gone)
        around = [(other, length, self.contours[gone][other]) for other, length in self.neighbors[gone].items()]
        for other, length, contours in around:
            del self.neighbors[other][gone], self.contours[other][gone]
            if other != keep:
                self._add(keep, other, length, contours)
        self.neighbors[gone], self.contours[gone] = {}, {}

    def longest_boundary(self, region: int) -> int:
        """Find the neighbor with which a region shares its longest boundary.

        region : int. Returns that neighbor, of equal ones the one of smallest number. ValueError without neighbors.
        """
        around = self.neighbors[region]
        return max(sorted(around), key=lambda other: around[other])

    def bridges(self) -> dict[tuple[int, int], float]:
        """Find the contours that part the surface in two.

        Returns
        -------
        side : dict of (int, int) -> float
            The two neighbors at each such contour, the smaller number first, and the area of its smaller side. The
            contours that are crossed on the way around a hole, such as the feet of a handle, are none of them.

        Notes
        -----
        The bridges of a graph, by one depth-first search [Tarjan1974]: O(regions + boundaries).
        """
        search, found = _DepthFirst(self), {}
        for root in sorted(self.alive):
            if root in search.place:
                continue
            for before, region in search.bridges_from(root):
                beyond = search.beyond[region]
                found[min(before, region), max(before, region)] = min(beyond, search.beyond[root] - beyond)
        return found


class _DepthFirst:
    """A depth-first search through a graph of regions [Tarjan1974].

    Attributes
    ----------
    place : dict of int -> int
        Place of each region in the order in which they are reached.
    earliest : dict of int -> int
        For each region the least place of what it touches, or what was reached from it, itself included.
    beyond : dict of int -> float
        Area of each region and of what was reached from it.
    """

    def __init__(self, graph: FusionGraph) -> None:
        self._graph = graph
        self.place: dict[int, int] = {}
        self.earliest: dict[int, int] = {}
        self.beyond: dict[int, float] = {}

    def bridges_from(self, root: int) -> list[tuple[int, int]]:
        """Reach all that hangs together with a region; each bridge there, the region reached before the other first."""
        bridges, trail = [], [(root, -1, self._reach(root))]
        while trail:
            region, before, ahead = trail[-1]
            other = next(ahead, None)
            if other is None:
                trail.pop()
                if before >= 0 and self._leave(region, before):
                    bridges.append((before, region))
            elif other not in self.place:
                trail.append((other, region, self._reach(other)))
            elif other != before:
                self.earliest[region] = min(self.earliest[region], self.place[other])
        return bridges

    def _reach(self, region: int) -> Iterator[int]:
        """Enter a region; returns its neighbors in order."""
        self.place[region] = self.earliest[region] = len(self.place)
        self.beyond[region] = self._graph.area[region]
        return iter(sorted(self._graph.neighbors[region]))

    def _leave(self, region: int, before: int) -> bool:
        """Go back to the region before; whether a single contour between the two is all that joins their sides."""
        self.earliest[before] = min(self.earliest[before], self.earliest[region])
        self.beyond[before] += self.beyond[region]
        return self.earliest[region] > self.place[before] and self._graph.contours[before][region][0] == 1


def fuse_small(
    sets: LevelSets, count: int, region: np.ndarray, contours: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Fuse the smallest region into the neighbor along its longest boundary, until no two regions touch.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component, P slab pieces.
    count : int
        Number of regions.
    region : (P,) int64
        Region of each slab piece, 0..count-1.
    contours : (C,) bool, optional
        Contours across which regions may be fused; all without.

    Returns
    -------
    merges : (s, 2) int64
        The region that stays and the region fused into it, in order; count - 1 unless level sets tear the component
        apart, as they do where a long bridge between two pieces spans whole slabs.
    ratio : (s,) float64
        Area of the fused region over that of the region that was then the largest.
    """
    graph = FusionGraph(sets, count, region, contours)
    merges, ratio, largest = [], [], max(graph.area, default=0.0)
    queue = [(area, r) for r, area in enumerate(graph.area)]
    heapq.heapify(queue)
    while queue:
        area, smallest = heapq.heappop(queue)
        if area != graph.area[smallest] or not graph.neighbors[smallest]:
            continue  # it has grown since, or nothing is left to join it
        neighbor = graph.longest_boundary(smallest)
        merges.append((neighbor, smallest))
        ratio.append(area / largest)
        graph.merge_(neighbor, smallest)
        largest = max(largest, graph.area[neighbor])
        heapq.heappush(queue, (graph.area[neighbor], neighbor))
    return np.array(merges, np.int64).reshape(-1, 2), np.array(ratio)


def fuse_weakest(
    sets: LevelSets, count: int, region: np.ndarray, small_region: float
) -> tuple[np.ndarray, np.ndarray]:
    """Fuse regions where the cut between them is weakest, until no two regions touch.

    A region is small, as [Berretti2009] has it, by its area over that of the largest region; the smallest joins the
    neighbor along its longest boundary. Beyond this, a contour cuts off a protrusion, "a portion of the surface that
    sticks out of the remaining surface", only if there is more area than in a flat disc whose border is as long: on
    its smaller side, or in the smaller region at it where it parts nothing, as on the way around a hole. Else it is
    weak, and the smaller region at it joins the larger one.

    Parameters
    ----------
    sets, count, region
        As ``fuse_small`` has them.
    small_region : float
        Area of a region over that of the largest region at which a merge has salience 0.5.

    Returns
    -------
    merges : (s, 2) int64
        See ``fuse_small``.
    salience : (s,) float64
        Of each merge, 0..1; need not rise. With x the area ratio over ``small_region``, or that area over the disc's,
        x / (x + 1).
    """
    graph = FusionGraph(sets, count, region)
    protrusions = _Protrusions(graph, 1e-12 * sets.mesh.area)
    queue = [(area, r) for r, area in enumerate(graph.area)]
    weak = [protrusions.weakness(a, b) for a in range(count) for b in graph.neighbors[a] if a < b]
    heapq.heapify(queue)
    heapq.heapify(weak)
    merges, salience, largest = [], [], max(graph.area, default=0.0)
    while True:
        # What has been fused or changed since is in the queues anew.
        while queue and not (graph.neighbors[queue[0][1]] and queue[0][0] == graph.area[queue[0][1]]):
            heapq.heappop(queue)
        if not queue:
            return np.array(merges, np.int64).reshape(-1, 2), np.array(salience)
        while weak[0][2] not in graph.neighbors[weak[0][1]] or protrusions.weakness(*weak[0][1:]) != weak[0]:
            heapq.heappop(weak)
        area, small = queue[0]
        worth, gone, keep = min((area / (area + small_region * largest), small, graph.longest_boundary(small)), weak[0])
        merges.append((keep, gone))
        salience.append(worth)
        protrusions.merge_(keep, gone)
        largest = max(largest, graph.area[keep])
        heapq.heappush(queue, (graph.area[keep], keep))
        for other in graph.neighbors[keep]:
            heapq.heappush(weak, protrusions.weakness(keep, other))


class _Protrusions:
    """What the boundaries in a graph of regions cut off, while the regions are fused.

    nothing : an area beside which all others are large.
    """

    def __init__(self, graph: FusionGraph, nothing: float) -> None:
        self._graph, self._nothing = graph, nothing
        # A contour that parts the surface does so whatever is fused elsewhere, and its sides stay the same.
        self._sides = graph.bridges()

    def weakness(self, a: int, b: int) -> tuple[float, int, int]:
        """How much the boundary of two regions cuts off, 0..1, the smaller region and the larger one."""
        area = self._graph.area
        small, large = (a, b) if (area[a], a) < (area[b], b) else (b, a)
        beyond = self._sides.get((min(a, b), max(a, b)), area[small])
        return beyond / (beyond + disc(self._graph.contours[a][b][1]) + self._nothing), small, large

    def merge_(self, keep: int, gone: int) -> None:
        """Fuse region ``gone`` into region ``keep``, whose the other boundaries of ``gone`` are then."""
        for other in self._graph.neighbors[gone]:
            side = self._sides.pop((min(gone, other), max(gone, other)), None)
            if side is not None and other != keep:
                self._sides[min(keep, other), max(keep, other)] = side
        self._graph.merge_(keep, gone)


def disc(length: float) -> float:
    """Area of a flat disc with a border of this length, the most that a curve can hold in a plane.

    length : float, in any unit. Returns the area, in the square of the unit.
    """
    return length**2 / (4 * np.pi)
