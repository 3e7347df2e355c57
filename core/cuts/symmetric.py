# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates and their hierarchy made the same on both sides of a plane of symmetry, or of several.

One side leads: its candidates and their mirror images are those of the whole, and candidates across the plane are kept
where both of their halves agree. What parts two of them is what the hierarchy found says, across the plane the mean of
both sides; average linkage, each merge with its mirror image, makes a hierarchy of that. Any method of cutting can be
made symmetric in this way, because only labels and a hierarchy are asked for.

Planes across each other divide a shape in quarters, or in eighths, one of which leads. Where exact planes meet at other
angles, as those of a star or a gear do, a wedge leads, and the shape is turned, too (``symmetry_group``).
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from scipy.sparse import csr_array

from ..surface.arrays import components, pair_keys, renumbered, rounded
from ..surface.labels import FaceGraph, connect, fill_unlabeled, longest_neighbor, majority
from .face_candidates import FaceCandidates
from .hierarchy import Hierarchy
from .joining.method import LAST
from .symmetry_group import SymmetryGroup

# Shares of the area of the pieces that the plane mirrors: below SMALL, what little of a candidate is left on the
# leading side joins a neighbor, and so does what lies across the plane below CROSSING; a region without an image is one
# of its own from LONE on.
SMALL, CROSSING, LONE = 0.0004, 0.001, 0.005
OVERHANG = 0.25  # share of a candidate below which what lies beyond the plane is not asked for
# At these details the parts of both sides are compared with those found. Where more pairs of points than WORST come
# together or apart, the faces are too large to be mirrored, or what was found speaks against the plane.
DETAILS, WORST = (0.3, 0.4, 0.5, 0.6, 0.7), 0.05
MOST_LEADS = 8  # upper bound of the number of wedges of which each is tried as the one that leads
MOST_CANDIDATES = 2_000  # every pair of them is compared; of more, such as the blades of a lawn, all stay as they are


@dataclass(frozen=True, eq=False)
class Cells:
    """The candidates of the leading side, and their images, in g ways of mirroring, the first of which is none.

    Attributes
    ----------
    label : (p,) int64
        Cell of each face, 0..c-1.
    found : (c, g) int64
        The candidate in which most of each image of each cell lies; -1 for none.
    shares : tuple of g (c, c') sparse float64
        Of each image of each cell, the share of its area in each of the c' candidates found.
    leads : (c, g) bool
        Which images of a cell lie on the leading side; only the cell itself where it has no image.
    image : (c, g) int64
        The images of each cell; -1 for none.
    area : (c,) float64
    group : SymmetryGroup
    """

    label: np.ndarray
    found: np.ndarray
    shares: tuple[csr_array, ...]
    leads: np.ndarray
    image: np.ndarray
    area: np.ndarray
    group: SymmetryGroup


def symmetric_candidates(
    candidates: FaceCandidates, twin: np.ndarray, height: np.ndarray, first: float | np.ndarray = 1.0,
    exact: bool = False,
) -> FaceCandidates:
    """Make candidates and their hierarchy symmetric.

    Parameters
    ----------
    candidates : FaceCandidates
        Of p faces; all candidates are in use, and all of them merge in the end.
    twin : (p,) or (k, p) int64
        Mirror image of each face in each of k planes; -1 for none. With several planes a face that has an image in one
        has images in all, and the image of its image does not depend on the order of the two planes.
    height : (p,) or (k, p) float64
        Signed distance of each face from each plane.
    first : float or (k,) float64
        Above 0 if the side to which the normal points is to lead where both are equally good, below 0 for the other.
    exact : bool
        Whether all twins are exact: then nothing that was found on a side speaks against a plane.

    Returns
    -------
    candidates : FaceCandidates
        Every candidate is connected. Twins have twin candidates, and candidates merge when and as their twins do. The
        very object that was given if everything stays as it was found.

    Notes
    -----
    Of both sides, or all quarters, that one leads whose parts, mirrored, are most like those found on the whole. If
    none is much like them, the last of several planes is left out; without any, everything stays as it was found.
    """
    if candidates.hierarchy.n_candidates > MOST_CANDIDATES:
        return candidates
    twin, height, first = np.atleast_2d(twin), np.atleast_2d(height), np.atleast_1d(first)
    group, beside = SymmetryGroup.of_planes(twin), height * first[:, None]
    leads = [(beside * np.reshape(sides, (-1, 1)) >= 0).all(axis=0) for sides in product((1, -1), repeat=len(beside))]
    best = _best(candidates, group, leads, np.inf if exact else WORST)
    if best is None and len(twin) > 1:
        return symmetric_candidates(candidates, twin[:-1], height[:-1], first[:-1], exact)
    return best or candidates


def turned_candidates(candidates: FaceCandidates, group: SymmetryGroup, height: np.ndarray) -> FaceCandidates:
    """Make candidates and their hierarchy alike in all wedges of a shape whose planes of symmetry meet in an axis.

    Parameters
    ----------
    candidates : FaceCandidates
        As ``symmetric_candidates`` has them, of p faces.
    group : SymmetryGroup
        All exact.
    height : (p,) float64
        Signed distance of each face from a plane through the middle that is none of symmetry.

    Returns
    -------
    candidates : FaceCandidates
        What ``symmetric_candidates`` returns.
    """
    if candidates.hierarchy.n_candidates > MOST_CANDIDATES:
        return candidates
    # Of all images of a face the one farthest from the plane leads: those that do form a wedge.
    lead = height >= height[group.image].max(axis=0) - 1e-6 * np.abs(height).max()
    leads = [lead[group.image[way]] for way in group.elements[:: -(-len(group.elements) // MOST_LEADS)]]
    return _best(candidates, group, leads, np.inf) or candidates


def _best(
    candidates: FaceCandidates, group: SymmetryGroup, leads: list[np.ndarray], least: float
) -> FaceCandidates | None:
    """The candidates that are most like those found, of those that some wedges make if they lead.

    leads : of (p,) bool, which faces lie in each wedge. least : upper bound of how unlike they may be; None if all are.
    """
    salience = candidates.hierarchy.salience_table(np.arange(int(candidates.label.max()) + 1))
    found = [candidates.parts(detail) for detail in DETAILS]
    graph, touching = candidates.graph, candidates.with_contacts()
    concerned = _mirrored_area(graph, group.image)
    whole, best = float(concerned.sum()), None
    for lead in leads:
        cells = _cells(graph, candidates.label, group, lead, whole)
        merges, strength = _linkage(cells, _touching(cells, touching), _means(cells, salience))
        made = replace(candidates, label=cells.label, hierarchy=Hierarchy.of(len(cells.area), merges, strength))
        error = float(np.mean([_disagreement(made.parts(detail), parts, concerned)
                               for detail, parts in zip(DETAILS, found, strict=True)]))
        if error < least - 1e-9:
            best, least = made, error
    return best


def _mirrored_area(graph: FaceGraph, image: np.ndarray) -> np.ndarray:
    """Area of the faces, (p,), in the connected pieces that have a twin somewhere; 0 of those in others."""
    count, piece = graph.pieces
    return np.where((np.bincount(piece, (image[1:] >= 0).any(axis=0), count) > 0)[piece], graph.area, 0.0)


def _cells(graph: FaceGraph, label: np.ndarray, group: SymmetryGroup, leads: np.ndarray, whole: float) -> Cells:
    """The candidates of the leading side and their images, and the candidates of what has no image.

    whole : area of the pieces that the planes mirror.
    """
    n_ways, faces = len(group.image), np.arange(len(label))
    has = group.image >= 0
    image = np.where(has, group.image, faces)
    # The cell of a face that does not lead itself is the mirror image of the cell of that image of it which leads: a
    # left arm's face, if the right side leads, gets the mirrored right arm. ``heard``: by which ways of mirroring a
    # face has such an image. ``lone``: small regions without any, which get the cell around them.
    heard = has & leads[image]
    way = heard.argmax(axis=0)
    unseen = ~has.all(axis=0) & ~heard.any(axis=0)
    lone = unseen & ~_large(graph, unseen, LONE * whole)
    leader = image[way, faces]
    asked = (way == 0) & ~lone
    cell, own, seen = _lead_cells(graph, label, np.where(has, label[image], -1), leader, asked, whole, group)
    kind = group.cosets(own)
    full = np.where(lone, -1, n_ways * cell[leader] + kind[cell[leader], way])
    full = connect(graph, fill_unlabeled(graph, full))
    full = connect(graph, fill_unlabeled(graph, _without_lone(graph, full, kind, seen, LONE * whole, group)))
    names, full = renumbered(full)
    lead, way = np.divmod(names, n_ways)
    partner = _places(names, n_ways * lead[:, None] + kind[lead[:, None], group.composition[way][:, group.inverse]])
    weight = graph.area + 1e-12 * graph.area.sum()
    # A cell that follows takes over all that is known of its leading image, instead of its own, nearly the same
    # numbers: so that rounding cannot make the two sides differ. ``asked``: of which cell, in which way, it is read.
    leading = np.where(way > 0, partner[np.arange(len(names)), way], -1)
    leader, way_there = np.where(leading < 0, (np.arange(len(names)), 0 * way), (leading, way))
    from_there = group.composition[:, group.inverse[way_there]].T
    asked = leader[:, None], from_there
    shown = np.where(has, label[image], label)
    found = np.stack([majority(full, of_way, weight, len(names)) for of_way in shown], axis=1)
    found = np.where(partner >= 0, found, -1)[asked]
    shares = _shares(full, shown, weight)
    shares = tuple(shares[leader + len(names) * of_way] for of_way in from_there.T)
    speaks = (partner >= 0) & (way[partner] == 0)
    speaks[~speaks.any(axis=1), 0] = True
    return Cells(full, found, shares, speaks, partner, np.bincount(full, graph.area), group)


def _shares(cell: np.ndarray, shown: np.ndarray, weight: np.ndarray) -> csr_array:
    """Share of each cell's area that is in each candidate, (g * c, c') sparse; shown : (g, p), candidate by way."""
    n_ways, n_cells = len(shown), int(cell.max()) + 1
    area = np.bincount(cell, weight, n_cells)
    row = cell + n_cells * np.arange(n_ways)[:, None]
    size = n_ways * n_cells, int(shown.max()) + 1
    return csr_array((np.tile(weight / area[cell], n_ways), (row.ravel(), shown.ravel())), size)


def _places(names: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Place of each of some wanted names among the names there are, which rise; -1 where it is not there."""
    place = np.searchsorted(names, wanted).clip(max=len(names) - 1)
    return np.where(names[place] == wanted, place, -1)


def _without_lone(
    graph: FaceGraph, full: np.ndarray, kind: np.ndarray, seen: np.ndarray, least: float, group: SymmetryGroup
) -> np.ndarray:
    """Cell of each face, (p,): -1 for small cells whose image is not there, or not among the images of their neighbors.

    full : (p,), g times the leading cell of each face, and the way in which it is mirrored. kind, seen : (c, g), see
    ``SymmetryGroup.cosets``, and which images leading cells have. least : area from which a cell is not small.
    """
    n_ways = kind.shape[1]
    names, place = renumbered(full)
    lead, way = np.divmod(names, n_ways)
    pairs = graph.boundaries(place)[0]
    here = pair_keys(np.sort(pairs, axis=1), len(names))
    alone = np.zeros(len(names), bool)
    for mirrored in range(1, n_ways):
        image = _places(names, n_ways * lead + kind[lead, group.composition[way, group.inverse[mirrored]]])
        there = image >= 0
        of_pairs = pair_keys(np.sort(image[pairs], axis=1), len(names))
        held = np.zeros(len(names), bool)
        held[pairs[np.isin(of_pairs, here) & there[pairs].all(axis=1)]] = True
        alone |= seen[lead, mirrored] & ~(held & there)
    free = np.bincount(pairs.ravel(), minlength=len(names)) == 0
    small = np.bincount(place, graph.area) < least
    return np.where((small & alone & ~free)[place], -1, full)


def _disagreement(first: np.ndarray, second: np.ndarray, area: np.ndarray) -> float:
    """Share of pairs of points that one labeling of the faces, (p,), joins and the other separates."""
    width = int(second.max()) + 1
    together = np.bincount(first * width + second, area, (int(first.max()) + 1) * width).reshape(-1, width)
    apart = sum((together.sum(axis=axis) ** 2).sum() for axis in (0, 1)) - 2 * (together**2).sum()
    return float(apart / area.sum() ** 2)


def _large(graph: FaceGraph, chosen: np.ndarray, least: float) -> np.ndarray:
    """Which of the chosen faces, (p,) bool, form connected regions of a least area."""
    a, b = graph.pairs.T
    both = np.flatnonzero(chosen[a] & chosen[b])
    count, region = components(len(chosen), a[both], b[both])
    return chosen & (np.bincount(region, graph.area, count) >= least)[region]


def _lead_cells(
    graph: FaceGraph, label: np.ndarray, mirrored: np.ndarray, leader: np.ndarray, asked: np.ndarray, whole: float,
    group: SymmetryGroup,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The candidates on the leading side, in connected pieces.

    mirrored : (g, p), candidate of each face's images, -1 for none. leader, asked : (p,), the face that speaks for each
    face, and which faces speak. whole : area of the pieces that the planes mirror. Returns the cell of each face that
    speaks, (p,) int64, and which of its images are each cell itself and which it has, (c, g) bool.
    """
    a, b = leader[graph.pairs.T]
    spoken = np.flatnonzero(asked[a] & asked[b])
    a, b, length = a[spoken], b[spoken], graph.length[spoken]
    same = np.flatnonzero(label[a] == label[b])
    cell = components(len(label), a[same], b[same])[1]
    cell = np.where(asked, cell, -1)
    cell[asked] = renumbered(cell[asked])[1]
    count = int(cell[asked].max()) + 1
    mine, spoken_for = cell[asked], asked[leader]
    own = np.empty(count, np.int64)
    own[mine] = label[asked]
    weight = graph.area + 1e-12 * graph.area.sum()
    other = np.stack([majority(mine, of_way[asked] + 1, weight[asked], count) - 1 for of_way in mirrored], axis=1)
    share = graph.area[spoken_for] / max(whole, 1e-300)
    area = rounded(np.bincount(cell[leader][spoken_for], share, count))
    largest = np.zeros(int(own.max()) + 1)
    np.maximum.at(largest, own, area)
    crosses = group.generated_subgroups(own[:, None] == other)
    # What little of a candidate reaches over the plane from the side that follows is cut off there.
    little = (np.bincount(mine, graph.area[asked], count)
              < OVERHANG * 2 / len(mirrored) * np.bincount(label, graph.area)[own])
    across = crosses[:, 1:].any(axis=1)
    small = ((area < SMALL) & (area < largest[own])) | little | (across & (area < CROSSING))
    joins = _joined(FaceGraph(len(label), np.stack([a, b], axis=1), length, graph.area), cell, own, area, small)
    left, cell[asked] = renumbered(joins[mine])
    return cell, crosses[left], other[left] >= 0


def _joined(
    graph: FaceGraph, cell: np.ndarray, own: np.ndarray, area: np.ndarray, small: np.ndarray
) -> np.ndarray:
    """Cell that each cell becomes, (c,) int64: small ones join a larger neighbor, if they can one of their candidate.

    cell : (p,), of each face, -1 for none. own, area, small : (c,).
    """
    touching, length = graph.boundaries(cell)
    length = length * np.where(own[touching[:, 0]] == own[touching[:, 1]], 1.0, 1e-6)
    goal = longest_neighbor(touching, length, len(area))
    goal = np.where(small & (goal >= 0) & (area[goal] > area), goal, np.arange(len(area)))
    while (goal[goal] != goal).any():
        goal = goal[goal]
    return goal


def _touching(cells: Cells, graph: FaceGraph) -> np.ndarray:
    """Which cells touch, (c, c) bool; images of cells that touch do, too."""
    pairs = graph.boundaries(cells.label)[0]
    touching = np.zeros((len(cells.area), len(cells.area)), bool)
    touching[tuple(pairs.T)] = True
    for image in cells.image.T[1:]:
        mirrored = image[pairs]
        touching[tuple(mirrored[(mirrored >= 0).all(axis=1)].T)] = True
    return touching | touching.T


def _means(cells: Cells, salience: np.ndarray) -> np.ndarray:
    """Salience of what parts two cells, (c, c): as the leading side says, across the planes the mean of all sides.

    salience : of what parts two candidates that were found, (c', c').

    A cell may lie in several candidates of a side that follows: the mean is one over its area, for with the largest
    candidate alone a wedge whose image is half a leg is apart from the body across the plane.
    """
    count, n_ways = cells.found.shape
    told, total = np.full((count, count), np.nan), np.zeros((count, count))
    n_seen = np.zeros((count, count))
    for way in range(n_ways):
        found, leads = cells.found[:, way], cells.leads[:, way]
        seen = (found[:, None] >= 0) & (found >= 0)
        first = np.isnan(told) & seen & leads[:, None] & leads
        told[first] = salience[found[:, None], found][first]
        said = cells.shares[way] @ (cells.shares[way] @ salience).T
        total += np.where(seen, said + said.T, 0.0) / 2
        n_seen += seen
    here = salience[cells.found[:, :1], cells.found[:, 0]]
    # What nothing brought near each other stays apart to the last.
    return np.where(here >= LAST, here, np.where(np.isnan(told), total / n_seen, told))


class _Groups:
    """Sets of ways that hold with two ways also one after the other: those that leave a cluster as it is.

    A set is a number whose bits are its ways.
    """

    def __init__(self, group: SymmetryGroup) -> None:
        self._group = group
        self._closed: dict[int, int] = {}
        self._joined: dict[tuple[int, int], tuple[int, int, int]] = {}

    def closed(self, chosen: int) -> int:
        """The smallest set that holds some ways."""
        if chosen not in self._closed:
            bits = [[chosen >> way & 1 == 1 for way in self._group.elements.tolist()]]
            subgroup = self._group.generated_subgroups(np.array(bits))
            self._closed[chosen] = sum(1 << way for way in np.flatnonzero(subgroup).tolist())
        return self._closed[chosen]

    def joined(self, one: int, other: int) -> tuple[int, int, int]:
        """The smallest set that holds two, and how many images it makes of what each of them leaves as it is."""
        if (one, other) not in self._joined:
            both = self.closed(one | other)
            size = both.bit_count()
            self._joined[one, other] = both, size // one.bit_count(), size // other.bit_count()
        return self._joined[one, other]


class _Clusters:
    """Clusters of cells, the salience of what parts each two of them, and their images; ``merge_`` changes them.

    What touches what is in sets and dictionaries: there are some ten neighbors, for which whole arrays take longer.
    """

    def __init__(self, cells: Cells, touching: np.ndarray, mean: np.ndarray) -> None:
        every = range(len(cells.area))
        self.area, self.image = (cells.area + 1e-12 * cells.area.sum()).tolist(), cells.image.tolist()
        self.mean, self.of = mean.copy(), np.arange(len(cells.area))
        self.touching = [set(np.flatnonzero(row).tolist()) - {k} for k, row in enumerate(touching)]
        self.groups, self.after = _Groups(cells.group), cells.group.composition.tolist()
        #: Of each cluster, the ways that leave it as it is, and what parts it from its image in each way.
        self.own, self.apart = [1 for _ in every], [[] for _ in every]
        self.spread: list[dict[int, float]] = [{} for _ in every]
        #: Of each cluster, by neighbor: what it costs to merge, rounded, the neighbor, and the cost.
        self.costs: list[dict[int, tuple[float, int, float]]] = [{} for _ in every]
        self.know_(every)
        self.nearest: list[tuple[float, int, float] | None] = [None for _ in every]
        self.queue: list[tuple[float, int, tuple[float, int, float]]] = []
        self.search_(every)
        self.merges: list[tuple[int, int]] = []
        self.strength: list[float] = []

    def search_(self, clusters: Iterable[int]) -> None:
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
        """What a cluster costs to merge with another: the mean over all pairs of cells.

        A cluster that is its own image takes in another together with that one's image, which may be far from it.
        """
        mean = self.mean.item(a, b)
        both, copies, its_copies = self.groups.joined(self.own[a], self.own[b])
        if copies == its_copies == 1:
            return mean
        area, its_area = self.area[a], self.area[b]
        between = copies * its_copies * area * its_area
        inside = its_copies * (its_copies - 1) // 2 * (its_area * its_area)
        weight, total = between + inside, between * mean + inside * self.spread_in(b, both)
        inside = copies * (copies - 1) // 2 * (area * area)
        value = (total + inside * self.spread_in(a, both)) / (weight + inside)
        return value if value > mean else mean  # nothing is known of some images: the value is nan

    def spread_in(self, cluster: int, both: int) -> float:
        """What parts a cluster from its images in the ways of a set, the mean; 0 if all leave it as it is."""
        known = self.spread[cluster]
        if both not in known:
            beyond = both & ~self.own[cluster]
            chosen = tuple(way for way in range(beyond.bit_length()) if beyond >> way & 1)
            known[both] = _mean(self.apart[cluster], chosen)
        return known[both]

    def know_(self, clusters: Iterable[int]) -> None:
        """Find anew in which ways some clusters are their own images, what parts them from others, and the costs."""
        for k in clusters:
            image = self.image[k]
            self.own[k] = self.groups.closed(sum(1 << way for way, other in enumerate(image) if other == k))
            self.apart[k] = [self.mean.item(k, other) if other >= 0 else np.nan for other in image]
            self.spread[k] = {}
        pairs = [pair for k in clusters for other in self.touching[k] for pair in ((k, other), (other, k))]
        costs = [self.cost(a, b) for a, b in pairs]
        for (a, b), cost, about in zip(pairs, costs, rounded(np.array(costs)).tolist(), strict=True):
            self.costs[a][b] = about, b, cost

    def merge_(self, a: int, b: int, strength: float) -> None:
        """Let cluster b become part of cluster a; the means are weighted by area."""
        self.merges.append((a, b))
        self.strength.append(strength)
        share = self.area[a] / (self.area[a] + self.area[b])
        mean = self.mean[b] + share * (self.mean[a] - self.mean[b])
        self.mean[a] = self.mean[:, a] = mean
        for other in self.touching[b]:
            self.touching[other].discard(b)
            del self.costs[other][b]
            self.touching[other].add(a)
        self.touching[a] |= self.touching[b]
        self.touching[a] -= {a, b}
        self.touching[b], self.costs[b], self.nearest[b] = set(), {}, None
        self.area[a] += self.area[b]
        self.of[self.of == b] = a
        self.know_([a, *(other for other in self.image[a][1:] if other >= 0)])
        self.search_([a, *self.touching[a]])


def _mean(values: list[float], chosen: tuple[int, ...]) -> float:
    """The mean of some values; 0 of none."""
    if len(chosen) < 2:
        return values[chosen[0]] if chosen else 0.0
    return float(np.sum([value if k in chosen else 0.0 for k, value in enumerate(values)])) / len(chosen)


def _linkage(cells: Cells, touching: np.ndarray, mean: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Merge clusters of cells, the least parted first and each pair with its image, until none touch.

    Returns two cells of each merge, (s, 2) int64, and the salience, (s,) float64.
    """
    clusters = _Clusters(cells, touching, mean)
    while (found := clusters.pop_()) is not None:
        a, b, strength = found
        _merge_with_images_(clusters, min(a, b), max(a, b), strength)
    return np.reshape(clusters.merges, (-1, 2)).astype(np.int64), np.array(clusters.strength, float)


def _merge_with_images_(clusters: _Clusters, a: int, b: int, strength: float) -> None:
    """Merge two clusters, and their images if these are others; the union's images are the unions of the images."""
    image = clusters.image
    images_a, images_b = image[a], image[b]
    clusters.merge_(a, b, strength)
    union = [a]
    for of_a, of_b in zip(images_a[1:], images_b[1:], strict=True):
        if of_a < 0 or of_b < 0:  # what has no image follows what has one
            union.append(max(of_a, of_b))
            continue
        low, high = sorted((int(clusters.of[of_a]), int(clusters.of[of_b])))
        if low != high and high in clusters.touching[low]:
            clusters.merge_(low, high, strength)
            high = low
        if low != high:
            for k in (low, high):
                image[k] = [image[k][0]] + [-1] * (len(image[k]) - 1)
        union.append(low if low == high else -1)
    union = [int(clusters.of[k]) if k >= 0 else -1 for k in union]
    for way, mirrored in enumerate(union):
        if mirrored >= 0:
            image[mirrored] = [union[further[way]] for further in clusters.after]
    clusters.know_({a, *(int(clusters.of[k]) for k in (*images_a, *images_b) if k >= 0)})
