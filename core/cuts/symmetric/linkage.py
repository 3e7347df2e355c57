# SPDX-License-Identifier: GPL-3.0-or-later
"""Average linkage of cells in which each merge happens together with its images under a group of symmetries."""

from __future__ import annotations

import heapq
from collections.abc import Iterable

import numpy as np

from ...arrays.int64 import arange
from ...arrays.ties import rounded
from ...mesh.face_graph import FaceGraph
from ...mesh.triangles import vote_weights
from ...symmetry.group import SymmetryGroup
from ..hierarchy import LAST, Hierarchy
from .cells import Cells


def symmetric_linkage(cells: Cells, graph: FaceGraph, salience: np.ndarray) -> Hierarchy:
    """Merge clusters of cells, the least parted first and each pair with its images, until none touch.

    Parameters
    ----------
    cells : Cells
        c cells.
    graph : FaceGraph
        All faces that touch.
    salience : (c', c') float64
        Of what parts each two candidates that were found.

    Returns
    -------
    hierarchy : Hierarchy
        Of the cells.
    """
    clusters = _Clusters(cells, _touching(cells, graph), _mean_salience(cells, salience))
    while (found := clusters.pop_()) is not None:
        a, b, strength = found
        _merge_with_images_(clusters, min(a, b), max(a, b), strength)
    merges = np.reshape(clusters.merges, (-1, 2)).astype(np.int64)
    return Hierarchy.of(len(cells.area), merges, np.array(clusters.strength, float))


def _touching(cells: Cells, graph: FaceGraph) -> np.ndarray:
    """Which cells touch, (c, c) bool; images of cells that touch do, too."""
    pairs = graph.boundaries(cells.label)[0]
    touching = np.zeros((len(cells.area), len(cells.area)), bool)
    touching[tuple(pairs.T)] = True
    for image in cells.image.T[1:]:
        mirrored = image[pairs]
        touching[tuple(mirrored[(mirrored >= 0).all(axis=1)].T)] = True
    return touching | touching.T


def _mean_salience(cells: Cells, salience: np.ndarray) -> np.ndarray:
    """Salience of what parts two cells, (c, c): as the leading side says, across the planes the mean of all sides.

    salience : of what parts two candidates that were found, (c', c').

    The image of a cell may spread over several candidates; their saliences are averaged by area. With the largest one
    alone, a wedge whose image is half of a leg would count as separate from the body.
    """
    count, order = cells.found.shape
    of_leading, total = np.full((count, count), np.nan), np.zeros((count, count))
    n_images = np.zeros((count, count))
    for element in range(order):
        found, leads = cells.found[:, element], cells.leads[:, element]
        both_there = (found[:, None] >= 0) & (found >= 0)
        first_to_lead = np.isnan(of_leading) & both_there & leads[:, None] & leads
        of_leading[first_to_lead] = salience[found[:, None], found][first_to_lead]
        by_area = cells.shares[element] @ (cells.shares[element] @ salience).T
        total += np.where(both_there, by_area + by_area.T, 0.0) / 2
        n_images += both_there
    of_cells = salience[cells.found[:, :1], cells.found[:, 0]]
    # What nothing brought near each other stays apart to the last.
    return np.where(of_cells >= LAST, of_cells, np.where(np.isnan(of_leading), total / n_images, of_leading))


class _Subgroups:
    """Subgroups of a group of symmetries, each a number whose bits are its elements; what was computed is kept."""

    def __init__(self, group: SymmetryGroup) -> None:
        self._group = group
        self._generated: dict[int, int] = {}
        self._joined: dict[tuple[int, int], tuple[int, int, int]] = {}

    def generated(self, chosen: int) -> int:
        """The smallest subgroup that contains some elements."""
        if chosen not in self._generated:
            bits = [[chosen >> element & 1 == 1 for element in self._group.elements.tolist()]]
            subgroup = self._group.generated_subgroups(np.array(bits))
            self._generated[chosen] = sum(1 << element for element in np.flatnonzero(subgroup).tolist())
        return self._generated[chosen]

    def joined(self, one: int, other: int) -> tuple[int, int, int]:
        """The smallest subgroup that contains two, and how many images it makes of what each of them stabilizes."""
        if (one, other) not in self._joined:
            both = self.generated(one | other)
            size = both.bit_count()
            self._joined[one, other] = both, size // one.bit_count(), size // other.bit_count()
        return self._joined[one, other]


class _Clusters:
    """Clusters of cells, the salience of what parts each two of them, and their images; ``merge_`` changes them.

    What touches what is in sets and dictionaries: there are some ten neighbors, for which whole arrays take longer.
    """

    def __init__(self, cells: Cells, touching: np.ndarray, mean: np.ndarray) -> None:
        every = range(len(cells.area))
        self.area, self.image = vote_weights(cells.area).tolist(), cells.image.tolist()
        self.mean, self.of = mean.copy(), arange(len(cells.area))
        self.touching = [set(np.flatnonzero(row).tolist()) - {k} for k, row in enumerate(touching)]
        self.subgroups, self.composition = _Subgroups(cells.group), cells.group.composition.tolist()
        #: Of each cluster, the subgroup under which it is its own image, and what parts it from each of its images.
        self.stabilizer, self.from_image = [1 for _ in every], [[] for _ in every]
        #: Of each cluster, by subgroup: what parts it from its images under that, the mean.
        self.spread: list[dict[int, float]] = [{} for _ in every]
        #: Of each cluster, by neighbor: what it costs to merge, rounded, the neighbor, and the cost.
        self.costs: list[dict[int, tuple[float, int, float]]] = [{} for _ in every]
        self.measure_(every)
        self.nearest: list[tuple[float, int, float] | None] = [None for _ in every]
        self.queue: list[tuple[float, int, tuple[float, int, float]]] = []
        self.find_nearest_(every)
        self.merges: list[tuple[int, int]] = []
        self.strength: list[float] = []

    def find_nearest_(self, clusters: Iterable[int]) -> None:
        """Find the nearest neighbor of some clusters anew."""
        for k in clusters:
            self.nearest[k] = nearest = min(self.costs[k].values(), default=None)
            if nearest is not None:
                heapq.heappush(self.queue, (nearest[0], k, nearest))

    def pop_(self) -> tuple[int, int, float] | None:
        """The cluster that costs least to merge with its nearest neighbor, which that is, and the cost."""
        while self.queue:
            _, k, nearest = heapq.heappop(self.queue)
            if nearest is self.nearest[k]:
                return k, nearest[1], nearest[2]
        return None

    def cost(self, a: int, b: int) -> float:
        """What two clusters cost to merge: the mean over all pairs of cells.

        A cluster that is its own image takes in another together with that one's image, which may be far from it.
        The lower one comes first, so that sums run in one order.
        """
        mean = self.mean.item(a, b)
        both, copies, its_copies = self.subgroups.joined(self.stabilizer[a], self.stabilizer[b])
        if copies == its_copies == 1:
            return mean
        area, its_area = self.area[a], self.area[b]
        between = copies * its_copies * area * its_area
        inside = its_copies * (its_copies - 1) // 2 * (its_area * its_area)
        weight, total = between + inside, between * mean + inside * self.spread_in(b, both)
        inside = copies * (copies - 1) // 2 * (area * area)
        value = (total + inside * self.spread_in(a, both)) / (weight + inside)
        return value if value > mean else mean  # nothing is known of some images: the value is nan

    def spread_in(self, cluster: int, subgroup: int) -> float:
        """What parts a cluster from its images under a subgroup, the mean; 0 if it is its own image under all of it."""
        known = self.spread[cluster]
        if subgroup not in known:
            beyond = subgroup & ~self.stabilizer[cluster]
            chosen = tuple(element for element in range(beyond.bit_length()) if beyond >> element & 1)
            known[subgroup] = _mean(self.from_image[cluster], chosen)
        return known[subgroup]

    def measure_(self, clusters: Iterable[int]) -> None:
        """Measure anew, of some clusters, the stabilizer, what parts them from their images, and the costs."""
        for k in clusters:
            image = self.image[k]
            own = sum(1 << element for element, other in enumerate(image) if other == k)
            self.stabilizer[k] = self.subgroups.generated(own)
            self.from_image[k] = [self.mean.item(k, other) if other >= 0 else np.nan for other in image]
            self.spread[k] = {}
        pairs = sorted({(min(k, other), max(k, other)) for k in clusters for other in self.touching[k]})
        costs = [self.cost(a, b) for a, b in pairs]
        for (a, b), cost, about in zip(pairs, costs, rounded(np.array(costs)).tolist(), strict=True):
            self.costs[a][b], self.costs[b][a] = (about, b, cost), (about, a, cost)

    def merge_(self, a: int, b: int, strength: float) -> None:
        """Let cluster b become part of cluster a, which is to be measured anew; the means are weighted by area."""
        self.merges.append((a, b))
        self.strength.append(strength)
        share = self.area[a] / (self.area[a] + self.area[b])
        mean = self.mean[b] + share * (self.mean[a] - self.mean[b])
        self.mean[a] = self.mean[:, a] = mean
        for other in self.touching[b]:
            self.touching[other].discard(b)
            self.costs[other].pop(b, None)  # none yet, if both have changed
            self.touching[other].add(a)
        self.touching[a] |= self.touching[b]
        self.touching[a] -= {a, b}
        self.touching[b], self.costs[b], self.nearest[b] = set(), {}, None
        self.area[a] += self.area[b]
        self.of[self.of == b] = a


def _mean(values: list[float], chosen: tuple[int, ...]) -> float:
    """The mean of some values; 0 of none."""
    if len(chosen) < 2:
        return values[chosen[0]] if chosen else 0.0
    return float(np.sum([value if k in chosen else 0.0 for k, value in enumerate(values)])) / len(chosen)


def _merge_with_images_(clusters: _Clusters, a: int, b: int, strength: float) -> None:
    """Merge two clusters, and their images if these are others; the union's images are the unions of the images."""
    images_a, images_b = clusters.image[a], clusters.image[b]
    clusters.merge_(a, b, strength)
    union = [a, *(_union_of_images_(clusters, *images, strength)
                  for images in zip(images_a[1:], images_b[1:], strict=True))]
    union = [int(clusters.of[k]) if k >= 0 else -1 for k in union]
    for element, mirrored in enumerate(union):
        if mirrored >= 0:
            clusters.image[mirrored] = [union[further[element]] for further in clusters.composition]
    changed = {a, *(int(clusters.of[k]) for k in (*images_a, *images_b) if k >= 0)}
    clusters.measure_(changed)
    clusters.find_nearest_(changed.union(*(clusters.touching[k] for k in changed)))


def _union_of_images_(clusters: _Clusters, one: int, other: int, strength: float) -> int:
    """The union of the images of two clusters under one element, merged if they touch; -1 if they cannot be.

    Two that stay apart have no images any more. What has no image, -1, follows what has one.
    """
    if one < 0 or other < 0:
        return max(one, other)
    low, high = sorted((int(clusters.of[one]), int(clusters.of[other])))
    if low == high:
        return low
    if high in clusters.touching[low]:
        clusters.merge_(low, high, strength)
        return low
    for k in (low, high):
        clusters.image[k] = [clusters.image[k][0]] + [-1] * (len(clusters.image[k]) - 1)
    return -1
