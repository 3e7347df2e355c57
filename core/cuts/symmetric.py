# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates and their hierarchy made the same on both sides of a plane of symmetry.

One side leads: its candidates and their mirror images are those of the whole, and candidates across the plane are kept
where both of their halves agree. What parts two of them is what the hierarchy found says, across the plane the mean of
both sides; average linkage, each merge with its mirror image, makes a hierarchy of that. Any method of cutting can be
made symmetric in this way, because only labels and a hierarchy are asked for.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..surface.arrays import components, renumbered, rounded
from ..surface.labels import FaceGraph, connect, fill_unlabeled, longest_neighbor, majority
from .hierarchy import Hierarchy
from .joining.method import LAST

# Shares of the area of the pieces that the plane mirrors: below SMALL, what little of a candidate is left on the
# leading side joins a neighbor, and so does what lies across the plane below CROSSING; a region without an image is one
# of its own from LONE on.
SMALL, CROSSING, LONE = 0.0004, 0.001, 0.005
OVERHANG = 0.25  # share of a candidate below which what lies beyond the plane is not asked for
# At these details the parts of both sides are compared with those found. Where more pairs of points than WORST come
# together or apart, the faces are too large to be mirrored, or what was found speaks against the plane.
DETAILS, WORST = (0.3, 0.4, 0.5, 0.6, 0.7), 0.05
MOST_CANDIDATES = 2_000  # every pair of them is compared; of more, such as the blades of a lawn, all stay as they are


@dataclass(frozen=True, eq=False)
class Cells:
    """The candidates of the leading side, and their mirror images.

    Attributes
    ----------
    label : (p,) int64
        Cell of each face, 0..c-1.
    own, other : (c,) int64
        The candidate in which each cell lies, and that in which its mirror image lies; -1 for none.
    side : (c,) int64
        1 for a cell of the leading side, -1 for its image, 0 for a cell that is its own image or has none.
    twin : (c,) int64
        The image of each cell; -1 for none.
    area : (c,) float64
    """

    label: np.ndarray
    own: np.ndarray
    other: np.ndarray
    side: np.ndarray
    twin: np.ndarray
    area: np.ndarray


def symmetric_candidates(
    graph: FaceGraph, contacts: np.ndarray, label: np.ndarray, hierarchy: Hierarchy, twin: np.ndarray,
    height: np.ndarray, first: float = 1.0,
) -> tuple[np.ndarray, Hierarchy]:
    """Make candidates and their hierarchy symmetric.

    Parameters
    ----------
    graph : FaceGraph
        Faces that share an edge.
    contacts : (k, 2) int64
        Faces that touch though they share no edge.
    label : (p,) int64
        Candidate of each face, 0..c-1, all in use.
    hierarchy : Hierarchy
        Of the candidates; all of them merge in the end.
    twin : (p,) int64
        Mirror image of each face; -1 for none.
    height : (p,) float64
        Signed distance of each face from the plane.
    first : float
        Above 0 if the side to which the normal points is to lead where both are equally good, below 0 for the other.

    Returns
    -------
    label : (p,) int64
        Candidate of each face, 0..c'-1; every candidate is connected. Twins have twin candidates.
    hierarchy : Hierarchy
        Of these. Candidates merge when and as their twins do.

    Notes
    -----
    Of both sides that one leads whose parts, mirrored, are more like those found on the whole. If neither is much like
    them, everything stays as it was found.
    """
    if hierarchy.n_candidates > MOST_CANDIDATES:
        return label, hierarchy
    salience = hierarchy.salience_table(np.arange(hierarchy.n_candidates))
    found = [hierarchy.parts(hierarchy.n_parts(detail))[label] for detail in DETAILS]
    concerned = _mirrored_area(graph, twin)
    whole = float(concerned.sum())
    best, least = (label, hierarchy), WORST
    for leads in (height * first >= 0, height * first <= 0):
        cells = _cells(graph, label, twin, leads, whole)
        merges, strength = _linkage(cells, _touching(cells, graph.with_contacts(contacts)), _means(cells, salience))
        tree = Hierarchy.of(len(cells.area), merges, strength)
        error = np.mean([_disagreement(tree.parts(tree.n_parts(detail))[cells.label], parts, concerned)
                         for detail, parts in zip(DETAILS, found, strict=True)])
        if error < least - 1e-9:
            best, least = (cells.label, tree), error
    return best


def _mirrored_area(graph: FaceGraph, twin: np.ndarray) -> np.ndarray:
    """Area of the faces, (p,), in the connected pieces that have a twin somewhere; 0 of those in others."""
    count, piece = graph.pieces
    return np.where((np.bincount(piece, twin >= 0, count) > 0)[piece], graph.area, 0.0)


def _cells(graph: FaceGraph, label: np.ndarray, twin: np.ndarray, leads: np.ndarray, whole: float) -> Cells:
    """The candidates of the leading side and their images, and the candidates of what has no image.

    whole : area of the pieces that the plane mirrors.
    """
    faces = np.arange(len(label))
    image = np.where(twin >= 0, twin, faces)
    # A face that follows is what its twin is, if that one leads; a small region without twins is what is around it.
    follows = (twin >= 0) & ~leads & leads[image]
    lone = (twin < 0) & ~leads & ~_large(graph, (twin < 0) & ~leads, LONE * whole)
    leader = np.where(follows, image, faces)
    asked = ~follows & ~lone
    cell, crosses, seen = _lead_cells(graph, label, np.where(twin >= 0, label[image], -1), leader, asked, whole)
    full = np.where(lone, -1, 2 * cell[leader] + (follows & ~crosses[cell[leader]]))
    full = connect(graph, fill_unlabeled(graph, full))
    full = connect(graph, fill_unlabeled(graph, _without_lone(graph, full, crosses & seen, seen, LONE * whole)))
    names, full = renumbered(full)
    lead, side = names // 2, np.where(names % 2, -1, 1)
    partner = np.searchsorted(names, names ^ 1).clip(max=len(names) - 1)
    partner = np.where(names[partner] == names ^ 1, partner, -1)
    partner = np.where(crosses[lead] & seen[lead], np.arange(len(names)), partner)
    weight = graph.area + 1e-12 * graph.area.sum()
    own = majority(full, label, weight, len(names))
    shown = np.where(twin >= 0, label[image], label)
    other = np.where(partner >= 0, majority(full, shown, weight, len(names)), -1)
    # What follows says of itself what its image says of it, to the letter.
    mirrored = np.flatnonzero((side < 0) & (partner >= 0))
    own[mirrored], other[mirrored] = other[partner[mirrored]], own[partner[mirrored]]
    side[(partner < 0) | (partner == np.arange(len(names)))] = 0
    return Cells(full, own, other, side, partner, np.bincount(full, graph.area))


def _without_lone(graph: FaceGraph, full: np.ndarray, itself: np.ndarray, seen: np.ndarray, least: float) -> np.ndarray:
    """Cell of each face, (p,): -1 for small cells whose image is not there, or not among the images of their neighbors.

    full : (p,), twice the leading cell of each face, and 1 on the side that follows. itself, seen : (c,), which leading
    cells are their own images, and which have one. least : area from which a cell is not small.
    """
    names, place = renumbered(full)
    image = np.where(itself[names // 2], names, names ^ 1)
    there = np.isin(image, names)
    image = np.searchsorted(names, image).clip(max=len(names) - 1)
    pairs = graph.boundaries(place)[0]
    here, mirrored = (np.sort(ends, axis=1) @ (len(names), 1) for ends in (pairs, image[pairs]))
    held = np.zeros(len(names), bool)
    held[pairs[np.isin(mirrored, here) & there[pairs].all(axis=1)]] = True
    free = np.bincount(pairs.ravel(), minlength=len(names)) == 0
    small = np.bincount(place, graph.area) < least
    return np.where((small & seen[names // 2] & ~(held & there) & ~free)[place], -1, full)


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
    graph: FaceGraph, label: np.ndarray, mirrored: np.ndarray, leader: np.ndarray, asked: np.ndarray, whole: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The candidates on the leading side, in connected pieces.

    mirrored, leader, asked : (p,), candidate of each face's image, -1 for none; the face that speaks for each face; and
    which faces speak. whole : area of the pieces that the plane mirrors. Returns the cell of each face that speaks,
    (p,) int64, and whether each cell lies across the plane and whether it has an image, (c,) bool.
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
    other = majority(mine, mirrored[asked] + 1, weight[asked], count) - 1
    area = rounded(np.bincount(cell[leader][spoken_for], graph.area[spoken_for], count))
    largest = np.zeros(int(own.max()) + 1)
    np.maximum.at(largest, own, area)
    crosses = own == other
    # What little of a candidate reaches over the plane from the side that follows is cut off there.
    little = np.bincount(mine, graph.area[asked], count) < OVERHANG * np.bincount(label, graph.area)[own]
    small = ((area < SMALL * whole) & (area < largest[own])) | little | (crosses & (area < CROSSING * whole))
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
    image = cells.twin[pairs]
    touching[tuple(image[(image >= 0).all(axis=1)].T)] = True
    return touching | touching.T


def _means(cells: Cells, salience: np.ndarray) -> np.ndarray:
    """Salience of what parts two cells, (c, c): as the leading side says, across the plane the mean of both sides.

    salience : of what parts two candidates that were found, (c', c').
    """
    here = salience[cells.own[:, None], cells.own]
    there = salience[cells.other[:, None], cells.other]
    unseen = (cells.other < 0)[:, None] | (cells.other < 0)
    weight = 0.5 + 0.5 * np.sign(cells.side[:, None] + cells.side)
    weight = np.where(unseen | ((cells.side == 0)[:, None] & (cells.side == 0)), 1.0, weight)
    # What nothing brought near each other stays apart to the last.
    return np.where(here >= LAST, here, weight * here + (1.0 - weight) * there)


class _Clusters:
    """Clusters of cells, the salience of what parts each two of them, and their images; ``merge_`` changes them."""

    def __init__(self, cells: Cells, touching: np.ndarray, mean: np.ndarray) -> None:
        self.area, self.twin = cells.area + 1e-12 * cells.area.sum(), cells.twin.copy()
        self.mean, self.touching = mean.copy(), touching.copy()
        np.fill_diagonal(self.touching, False)
        self.of = np.arange(len(self.area))
        self.merges: list[tuple[int, int]] = []
        self.strength: list[float] = []
        self.least = np.full(len(self.area), np.inf)
        self.nearest = np.zeros(len(self.area), np.int64)
        self.search_(np.arange(len(self.area)))

    def search_(self, clusters: np.ndarray) -> None:
        """Find the nearest neighbor of some clusters anew."""
        if not len(clusters):
            return
        reach = np.where(self.touching[clusters], self.cost(clusters), np.inf)
        self.nearest[clusters] = rounded(reach).argmin(axis=1)
        self.least[clusters] = reach[np.arange(len(clusters)), self.nearest[clusters]]

    def cost(self, clusters: np.ndarray) -> np.ndarray:
        """What some clusters cost to merge with each: the mean over all pairs of cells that come together, (k, c).

        A cluster that is its own image takes in another together with that one's image, which may be far from it.
        """
        mean, every = self.mean[clusters], np.arange(len(self.area))
        alone = self.twin == every
        image = np.where(self.twin >= 0, self.twin, every)
        apart = self.mean[every, image]
        three = alone[clusters][:, None] != alone
        other = np.where(alone, clusters[:, None], every)  # the one of the two that is not its own image
        three &= self.twin[other] >= 0
        mine, its = self.area[clusters][:, None] * self.area, self.area[other] ** 2
        return np.where(three, np.maximum((2 * mine * mean + its * apart[other]) / (2 * mine + its), mean), mean)

    def merge_(self, a: int, b: int, strength: float) -> None:
        """Let cluster b become part of cluster a; the means are weighted by area."""
        self.merges.append((a, b))
        self.strength.append(strength)
        share = self.area[a] / (self.area[a] + self.area[b])
        mean = self.mean[b] + share * (self.mean[a] - self.mean[b])
        self.mean[a] = self.mean[:, a] = mean
        near = self.touching[a] | self.touching[b]
        near[[a, b]] = False
        self.touching[a] = self.touching[:, a] = near
        self.touching[b] = self.touching[:, b] = False
        self.area[a] += self.area[b]
        self.of[self.of == b] = a
        self.least[b] = np.inf
        stale = np.flatnonzero(near | (np.isin(self.nearest, (a, b)) & np.isfinite(self.least)))
        self.search_(np.append(stale, a))


def _linkage(cells: Cells, touching: np.ndarray, mean: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Merge clusters of cells, the least parted first and each pair with its image, until none touch.

    Returns two cells of each merge, (s, 2) int64, and the salience, (s,) float64.
    """
    clusters = _Clusters(cells, touching, mean)
    while np.isfinite(clusters.least).any():
        a = int(rounded(clusters.least).argmin())
        b = int(clusters.nearest[a])
        _merge_with_image_(clusters, min(a, b), max(a, b), float(clusters.least[a]))
    return np.reshape(clusters.merges, (-1, 2)).astype(np.int64), np.array(clusters.strength, float)


def _merge_with_image_(clusters: _Clusters, a: int, b: int, strength: float) -> None:
    """Merge two clusters, and their images if these are others; the union's image is the union of the images."""
    twin = clusters.twin
    image_a, image_b = int(twin[a]), int(twin[b])
    clusters.merge_(a, b, strength)
    if image_a < 0 or image_b < 0:  # what has no image follows what has one
        image = max(image_a, image_b)
        image = a if image in (a, b) else image
        twin[a] = image
        if image >= 0:
            twin[image] = a
        return
    image_a, image_b = int(clusters.of[image_a]), int(clusters.of[image_b])
    if image_a != image_b and clusters.touching[image_a, image_b]:
        low, high = sorted((image_a, image_b))
        clusters.merge_(low, high, strength)
        image_a = image_b = low
    whole = int(clusters.of[a])
    if image_a == image_b:
        image = int(clusters.of[image_a])
        twin[whole], twin[image] = image, whole
    else:
        twin[[whole, image_a, image_b]] = -1
