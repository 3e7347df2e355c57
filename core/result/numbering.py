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

from ..arrays.indexing import place_among, stable_order, sums_by
from ..arrays.pairs import both_ways, distinct_pairs
from ..arrays.ties import TIE, first_largest, ranks
from .decomposition import Decomposition
from .levels import detail_between, strong_levels
from .parts import Parts, default_name
from .splits import Splits

# Added to the areas by which candidates vote for numbers, in units of about the whole area: candidates without an area
# vote with this weight.
LEAST_AREA = 1e-300


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


def _votes(decomposition: Decomposition) -> np.ndarray:
    """Weight of each candidate's vote, (c,) float64: its area, in such a unit that small meshes have votes, too."""
    area = decomposition.candidate_area
    return np.ldexp(area, -int(np.frexp(area.sum())[1])) + LEAST_AREA  # a power of two changes no digit


def follow(part: np.ndarray, previous_number: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Number new parts by their overlap with numbered old parts.

    Pairs of a new part and an old number are taken by falling overlap, each part and each number once; of overlaps that
    are equal but for rounding, the pair of the smaller part and then that of the smaller number comes first. Parts that
    are left over get the smallest numbers that ``previous_number`` does not contain.

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
    taken = set()
    for new, number in pairs[stable_order(ranks(-np.log(overlap), 1.0))].tolist():
        if not numbers[new] and number not in taken:
            numbers[new] = number
            taken.add(number)
    left_over = np.flatnonzero(numbers == 0)
    free = np.setdiff1d(np.arange(1, count + len(pairs) + len(left_over) + 1), previous_number)
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
        unpinned_number, birth_order = _births(decomposition, splits, previous_number)
        unpinned = _number_graph(decomposition, splits, unpinned_number, birth_order)
        if not pinned.any():
            return cls(decomposition, splits, unpinned_number, birth_order, unpinned)
        candidate_number, birth_order = _make_room(unpinned_number, birth_order, previous_number, pinned)
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
        first_born = np.full(part.max() + 1, len(part))
        np.minimum.at(first_born, part, self.birth_order)
        return self.numbered(self.candidate_number[np.argsort(self.birth_order)][first_born][part])

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


def _births(
    decomposition: Decomposition, splits: Splits, previous_number: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Number that each candidate carries where nothing is pinned, (c,), and the order of the numbers' births, (c,).

    A new part takes a previous number if it has most of the area that had this number and no part has the number yet;
    of several such numbers, it takes the one of which it has most area. Otherwise it takes the number of parts at its
    level, or the next higher number that is not taken.
    """
    area = _votes(decomposition)[splits.order]
    previous_number = previous_number[splits.order]
    vote = _AreaVote.of(previous_number, area)
    number, births = np.zeros(len(area), np.int64), []
    for start, end in splits.root_intervals.tolist():
        births.append(vote.give_(start, end, len(births) + 1))
        number[start:end] = births[-1]
    counts = (decomposition.n_candidates - splits.merge).tolist()
    for (start, middle, end), count in zip(splits.intervals.tolist(), counts, strict=True):
        sides = (start, middle), (middle, end)
        kept = int(number[start])
        weights = [(vote.area_of(kept, *side), area[slice(*side)].sum()) for side in sides]
        new = sides[0] if _is_larger(weights[1], weights[0]) else sides[1]
        births.append(vote.give_(*new, count))
        number[slice(*new)] = births[-1]
    order = np.argsort(births)
    birth_order = order[np.searchsorted(np.array(births)[order], number)]
    place = np.argsort(splits.order)
    return _previous_first(number[place], birth_order[place], previous_number[place], vote.left_over)


def _is_larger(areas: tuple[float, ...], others: tuple[float, ...]) -> bool:
    """Whether the first of some areas that differs from its like by more than rounding is larger than that."""
    for area, other in zip(areas, others, strict=True):
        if abs(area - other) > TIE * max(area, other):  # twins have areas whose last digits change with the pose
            return area > other
    return False


@dataclass(eq=False)
class _AreaVote:
    """Which previous numbers new parts take, by the area that had them; parts are intervals of c places.

    known : (l,), the previous numbers, rising; code : (c,), index in these of the one at each place, l for none; area :
    (c,); total : (l + 1,), area of each; free : (l + 1,) bool, those that no part has yet; taken : all numbers that are
    known or given.
    """

    known: np.ndarray
    code: np.ndarray
    area: np.ndarray
    total: np.ndarray
    free: np.ndarray
    taken: set[int]

    @classmethod
    def of(cls, previous_number: np.ndarray, area: np.ndarray) -> _AreaVote:
        """previous_number : (c,) int64, 0 for none."""
        known = np.unique(previous_number[previous_number > 0])
        code = np.where(previous_number > 0, np.searchsorted(known, previous_number), len(known))
        free = np.arange(len(known) + 1) < len(known)
        return cls(known, code, area, np.bincount(code, area, len(free)), free, set(known.tolist()))

    @property
    def left_over(self) -> np.ndarray:
        """Previous numbers that no part has, (k,) int64."""
        return self.known[self.free[:-1]]

    def area_of(self, number: int, start: int, end: int) -> float:
        """Area within an interval of places that had a previous number; 0 for a number that is none."""
        code = int(np.searchsorted(self.known, number))
        if code == len(self.known) or self.known[code] != number:
            return 0.0
        return float(np.bincount(self.code[start:end] == code, self.area[start:end], 2)[1])

    def give_(self, start: int, end: int, count: int) -> int:
        """Choose the number of a new part; ``count`` is the number of parts at its level."""
        # Of the numbers that are there alone: a table of all of them for every part would take the square of the time.
        codes, place = np.unique(self.code[start:end], return_inverse=True)
        mine = np.bincount(place, self.area[start:end])
        mine[~self.free[codes] | (2 * mine <= (1 + TIE) * self.total[codes])] = 0.0
        if mine.any():
            code = codes[first_largest(mine)]
            self.free[code] = False
            return int(self.known[code])
        while count in self.taken:
            count += 1
        self.taken.add(count)
        return count


def _previous_first(
    number: np.ndarray, birth_order: np.ndarray, previous_number: np.ndarray, left_over: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of the candidates and order of their births, (c,) each, with previous numbers born before all new ones.

    left_over : (l,) int64, previous numbers of which no part has most of the area. Each of them replaces the new number
    that was born first among the candidates that had the previous number.
    """
    number, new = number.copy(), ~np.isin(number, previous_number[previous_number > 0])
    place = np.flatnonzero(new & np.isin(previous_number, left_over))
    place = place[np.argsort(birth_order[place], kind="stable")]
    place = place[np.unique(previous_number[place], return_index=True)[1]]
    number[place], new[place] = previous_number[place], False
    return number, np.argsort(np.lexsort((birth_order, new)))


def _make_room(
    number: np.ndarray, birth_order: np.ndarray, previous_number: np.ndarray, pinned: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Renumber so that a pinned part's number is carried only by its own candidates.

    New numbers that collide with a previous or a pinned number move up to the next free one. pinned : (c,) int64,
    number of the pinned part of each candidate, 0 for none. Returns the numbers of the candidates and the order of
    their births, (c,) each.
    """
    number, order = number.copy(), np.argsort(birth_order)
    taken, known, last = set(pinned.tolist()), set(previous_number.tolist()), 0
    for candidate in order[~np.isin(number[order], previous_number[previous_number > 0])].tolist():
        free = max(int(number[candidate]), last + 1)
        while free in known or (free in taken and not pinned[candidate]):
            free += 1
        number[candidate] = last = free
    # A candidate outside a pinned part that carries the number of this part gets a number that is born last.
    robbed = np.isin(number, pinned[pinned > 0]) & (number != pinned)
    number[robbed] = max(number.max(), pinned.max()) + 1 + np.arange(robbed.sum())
    return np.where(pinned > 0, pinned, number), np.argsort(order[np.argsort(robbed[order], kind="stable")])


def _number_graph(
    decomposition: Decomposition, splits: Splits, candidate_number: np.ndarray, birth_order: np.ndarray
) -> NumberGraph:
    """Which numbers touch at some level of detail.

    Two parts that touch at any level touch already at the level at which the later of their two numbers is born. It is
    therefore enough to look up the neighbors of each number when it is born.
    """
    own, born = candidate_number[splits.order], birth_order[splits.order]
    beside = both_ways(np.argsort(splits.order)[decomposition.candidate_pairs])
    beside = beside[stable_order(beside[:, 0])]
    first = np.searchsorted(beside[:, 0], np.arange(len(own) + 1))
    number, found = np.zeros_like(own), []

    def known_by(start: int, end: int) -> int:
        """Number by which the part of an interval of places is known; it is noted for the interval's candidates."""
        number[start:end] = own[start + born[start:end].argmin()]
        return int(number[start])

    def add_neighbors(start: int, end: int) -> None:
        """Note which numbers that of an interval of places touches when it is born."""
        others = np.unique(number[beside[first[start]:first[end], 1]])
        found.append(np.stack([np.full(len(others), number[start]), others], axis=1)[others != number[start]])

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
    return follow(part, known, _votes(decomposition))[part]
