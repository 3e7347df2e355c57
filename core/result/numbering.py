# SPDX-License-Identifier: GPL-3.0-or-later
"""Part numbers that last: through every level of detail, and from one decomposition to the next.

A part's number is what its name, color, lock and vertex group are stored under; its label is only its place in
one result. Numbers start at 1, so that 0 can say "no part".

When the detail rises and a part is split, one side keeps the number of the part and the other side gets a new
number, which is born with that split. When all splits are done, every part is one candidate, and the candidate
carries the number that this part has then. At any level, a part is known by the number that was born first among
those of its candidates. That depends on the candidates of the part alone, so that no change elsewhere renumbers it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays.indexing import inverse, largest_of_each, place_among, stable_order, sums_by
from ..arrays.int64 import arange, full
from ..arrays.pairs import both_ways, distinct_pairs
from ..arrays.ties import TIE, ranks
from .births import area_votes, make_room, number_births
from .decomposition import Decomposition
from .levels import detail_between, strong_levels
from .parts import Parts, default_name
from .splits import Splits


@dataclass(frozen=True, eq=False)
class NumberGraph:
    """The part numbers of a decomposition, and which of them touch at some level of detail; colors are chosen by it.

    Attributes
    ----------
    numbers : (k,) int64
        Numbers of the parts of all levels, rising.
    pairs : (e, 2) int64
        Indices in ``numbers`` of the numbers that touch.
    unpinned : NumberGraph or None
        If there are pinned parts, the graph that the decomposition would have without them.
    unpinned_index : (k,) int64 or None
        Index in ``unpinned.numbers`` of the number from which each number arose; -1 for a number that was made by hand.
    """

    numbers: np.ndarray
    pairs: np.ndarray
    unpinned: NumberGraph | None = None
    unpinned_index: np.ndarray | None = None

    def including(self, numbers: np.ndarray) -> NumberGraph:
        """Add numbers that belong to no level and touch no other.

        numbers : (j,) int64. Returns this graph if it has them all, else a new graph.
        """
        if np.isin(numbers, self.numbers).all():
            return self
        every = np.union1d(self.numbers, numbers)
        place = np.searchsorted(every, self.numbers)
        return NumberGraph(every, place[self.pairs], self, place_among(place, len(every)))


@dataclass(frozen=True, eq=False)
class NumberedParts:
    """Parts at one level of detail, in the order of their numbers.

    Attributes
    ----------
    parts : Parts
        The part with the i-th smallest number has label i.
    numbers : (count,) int64
        Number of each part, 1 or more, rising; numbers may be missing between them.
    graph : NumberGraph
        Numbers of all levels of detail.
    """

    parts: Parts
    numbers: np.ndarray
    graph: NumberGraph

    @property
    def candidates(self) -> np.ndarray:
        """(p,) int64, candidate of each face."""
        return self.parts.decomposition.candidates

    @property
    def candidate_numbers(self) -> np.ndarray:
        """(c,) int64, number of the part to which each candidate belongs."""
        return self.numbers[self.parts.candidate_part]

    @property
    def face_numbers(self) -> np.ndarray:
        """(p,) int64, number of the part to which each face belongs."""
        return self.candidate_numbers[self.candidates]

    @property
    def names(self) -> tuple[str, ...]:
        """Default name of each part: Part 01 and so on, by number; twins have one number and end in .L and .R."""
        twin, side = self.parts.twin, self.parts.side
        first = np.where(side != 0, np.minimum(self.numbers, self.numbers[twin]), self.numbers)
        return tuple(default_name(number) + {1: ".L", -1: ".R"}.get(where, "")
                     for number, where in zip(first.tolist(), side.tolist(), strict=True))


def follow(part: np.ndarray, previous_number: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Number new parts by their overlap with numbered old parts.

    Pairs of a new part and an old number are taken by falling overlap, each part and each number once; of overlaps that
    are equal but for rounding, the pair of the smaller part and then that of the smaller number comes first. A part
    that has more than twice as much of another number takes none of which it has so little. Parts that are left over
    get the smallest numbers that ``previous_number`` does not contain.

    Parameters
    ----------
    part : (c,) int64
        New part of each candidate, 0..count-1, all in use.
    previous_number : (c,) int64
        Number of the old part to which each candidate belonged; 0 for none.
    weight : (c,) float64
        Size of each candidate, above 0, in any unit. An overlap is a sum of sizes.

    Returns
    -------
    numbers : (count,) int64
        Number of each new part, all different, 1 or more.
    """
    count = int(part.max(initial=-1)) + 1
    numbers = np.zeros(count, np.int64)
    known = previous_number > 0
    pairs, pair = distinct_pairs(part[known], previous_number[known])
    overlap = sums_by(pair, weight[known], len(pairs))
    fits = overlap > (0.5 - TIE) * largest_of_each(pairs[:, 0], overlap, count)[pairs[:, 0]]
    pairs, overlap = pairs[fits], overlap[fits]
    taken = set()
    for new, number in pairs[stable_order(ranks(-np.log(overlap), 1.0))].tolist():
        if not numbers[new] and number not in taken:
            numbers[new] = number
            taken.add(number)
    left_over = np.flatnonzero(numbers == 0)
    used = np.unique(previous_number)
    free = np.setdiff1d(arange(1, len(used) + len(left_over) + 1), used)
    numbers[left_over] = free[: len(left_over)]
    return numbers


@dataclass(frozen=True, eq=False)
class Numbering:
    """The number of every part at every level of detail.

    Attributes
    ----------
    decomposition : Decomposition
        With c candidates.
    splits : Splits
        Splits of the decomposition around pinned parts.
    candidate_number : (c,) int64
        Number that each candidate carries, 1 or more; all candidates of a pinned part carry the part's number.
    birth_order : (c,) int64
        Place of each candidate when they are sorted by the births of their numbers, 0..c-1.
    graph : NumberGraph
        Numbers of all levels of detail, and which of them touch.
    """

    decomposition: Decomposition
    splits: Splits
    candidate_number: np.ndarray
    birth_order: np.ndarray
    graph: NumberGraph

    @classmethod
    def of(cls, decomposition: Decomposition, previous_number: np.ndarray, pinned: np.ndarray) -> Numbering:
        """Number the parts of all levels so that parts that have numbers already keep them.

        Parameters
        ----------
        decomposition : Decomposition
            With c candidates.
        previous_number : (c,) int64
            Number of the part to which each candidate belonged at some level, see ``inherited``; 0 for none. The parts
            of that level get these numbers again.
        pinned : (c,) int64
            Number of the pinned part to which each candidate belongs, 0 for none. The candidates of one pinned part are
            one part at every level, with this number.

        Returns
        -------
        numbering : Numbering
        """
        splits = Splits.of(decomposition, np.zeros_like(pinned))
        unpinned_number, birth_order = number_births(decomposition, splits, previous_number)
        unpinned = _number_graph(decomposition, splits, unpinned_number, birth_order)
        if not pinned.any():
            return cls(decomposition, splits, unpinned_number, birth_order, unpinned)
        candidate_number, birth_order = make_room(unpinned_number, birth_order, previous_number, pinned)
        splits = Splits.of(decomposition, pinned)
        graph = _number_graph(decomposition, splits, candidate_number, birth_order)
        # The number of a pinned part arose from this number itself. The number of any other part arose from the number
        # that its candidate carries where nothing is pinned.
        origin = np.where(np.isin(graph.numbers, pinned), graph.numbers, 0)
        free = pinned == 0
        origin[np.searchsorted(graph.numbers, candidate_number[free])] = unpinned_number[free]
        index = np.minimum(np.searchsorted(unpinned.numbers, origin), len(unpinned.numbers) - 1)
        index = np.where(unpinned.numbers[index] == origin, index, -1)
        graph = replace(graph, unpinned=unpinned, unpinned_index=index)
        return cls(decomposition, splits, candidate_number, birth_order, graph)

    def parts(self, detail: float, n_parts: int = 0) -> NumberedParts:
        """Read the parts at a level of detail, or an exact number of parts.

        Parameters
        ----------
        detail : float
            0..1: cuts of salience 1 - detail and above stay.
        n_parts : int
            Exact number of parts, clipped to what is possible with the pinned parts; 0 leaves the decision to the
            detail.

        Returns
        -------
        parts : NumberedParts
        """
        part = self.splits.parts(self.splits.n_done(self.decomposition, detail, n_parts))
        first_born = full(part.max() + 1, len(part))
        np.minimum.at(first_born, part, self.birth_order)
        return self.numbered(self.candidate_number[inverse(self.birth_order)][first_born][part])

    @property
    def salience(self) -> np.ndarray:
        """(s,) float64, salience of the cut that each split makes, 0..1, never rising."""
        return self.decomposition.hierarchy.salience[self.splits.merge]

    @property
    def n_range(self) -> tuple[int, int]:
        """The fewest and the most parts that there can be around the pinned ones."""
        return self.splits.n_roots, self.splits.n_roots + len(self.splits.merge)

    def detail_of(self, n_parts: int) -> float:
        """Find the detail at which there are so many parts.

        n_parts : int, within ``n_range``. Returns the middle of the range of such details, 0..1; if there are only
        details of more or fewer parts, one between the two.
        """
        return detail_between(self.salience, n_parts - self.splits.n_roots)

    def strong_levels(self) -> np.ndarray:
        """(l,) int64, the numbers of parts that stand out, rising; see levels.strong_levels."""
        return strong_levels(self.salience, self.splits.n_roots)

    def numbered(self, candidate_numbers: np.ndarray) -> NumberedParts:
        """Make parts of numbered candidates.

        candidate_numbers : (c,) int64, number of the part to which each candidate belongs. Returns NumberedParts.
        """
        numbers = np.unique(candidate_numbers)
        parts = Parts(self.decomposition, np.searchsorted(numbers, candidate_numbers))
        return NumberedParts(parts, numbers, self.graph.including(numbers))


def _number_graph(
    decomposition: Decomposition, splits: Splits, candidate_number: np.ndarray, birth_order: np.ndarray
) -> NumberGraph:
    """Which numbers touch at some level of detail.

    Two parts that touch at any level touch already at the level at which the later of their two numbers is born. It is
    therefore enough to look up the neighbors of each number when it is born.
    """
    own, born = candidate_number[splits.order], birth_order[splits.order]
    beside = both_ways(inverse(splits.order)[decomposition.candidate_pairs])
    beside = beside[stable_order(beside[:, 0])]
    first = np.searchsorted(beside[:, 0], arange(len(own) + 1))
    number, found = np.zeros_like(own), []

    def known_by(start: int, end: int) -> int:
        """Number by which the part of an interval of places is known; it is noted for the interval's candidates."""
        number[start:end] = own[start + born[start:end].argmin()]
        return int(number[start])

    def add_neighbors(start: int, end: int) -> None:
        """Note which numbers that of an interval of places touches when it is born."""
        others = np.unique(number[beside[first[start]:first[end], 1]])
        found.append(np.stack([full(len(others), number[start]), others], axis=1)[others != number[start]])

    for start, end in splits.root_intervals.tolist():
        known_by(start, end)
    for start, end in splits.root_intervals.tolist():
        add_neighbors(start, end)
    for start, middle, end in splits.intervals.tolist():
        kept, lower, _ = int(number[start]), known_by(start, middle), known_by(middle, end)
        add_neighbors(*((middle, end) if lower == kept else (start, middle)))
    numbers = np.unique(own)
    pairs, _ = distinct_pairs(*np.sort(np.concatenate(found), axis=1).T)
    return NumberGraph(numbers, np.searchsorted(numbers, pairs))


def inherited(
    decomposition: Decomposition, detail: float, n_parts: int, previous_number: np.ndarray, pinned: np.ndarray
) -> np.ndarray:
    """Number the parts of a new decomposition at one level by the old parts to which its candidates belonged.

    A number goes to the part that overlaps most with the old part of this number, see ``follow``.

    Parameters
    ----------
    decomposition : Decomposition
        The new decomposition, c candidates.
    detail : float
        Level of detail at which the parts are numbered, 0..1.
    n_parts : int
        Exact number of parts instead of a level of detail; 0 for none.
    previous_number : (c,) int64
        Number of the old part to which each candidate belonged; 0 for none.
    pinned : (c,) int64
        Number of the pinned part to which each candidate belongs; 0 for none.

    Returns
    -------
    numbers : (c,) int64
        Number of the new part to which each candidate belongs: the ``previous_number`` that ``Numbering.of`` takes.
    """
    splits = Splits.of(decomposition, pinned)
    _, first, part = np.unique(splits.parts(splits.n_done(decomposition, detail, n_parts)), return_index=True,
                               return_inverse=True)
    part = decomposition.group(first[part]).candidate_part  # of parts in one place, that of the first candidate first
    # A candidate that had the number of a pinned part but is not pinned to it has no previous number.
    elsewhere = np.where(np.isin(previous_number, pinned), 0, previous_number)
    known = np.where(pinned > 0, pinned, elsewhere)
    return follow(part, known, area_votes(decomposition))[part]
