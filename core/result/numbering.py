# SPDX-License-Identifier: GPL-3.0-or-later
"""Part numbers that last: through every level of detail, and from one decomposition to the next.

A part's number is what its name, color, lock and vertex group are stored under; its label is only its place in
one result. Numbers start at 1, so that 0 can say "no part".

When the detail rises and a part is split, one side keeps the number of the part and the other side gets a new
number, which is born with that split. So every candidate carries one number: the last one that was born for a part
in which this candidate is the first to be mentioned. A part is known by the number that was born first among those
of its candidates. That depends on the candidates of the part alone, so no change elsewhere renumbers it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..surface.arrays import distinct_pairs, sums_by
from .decomposition import Decomposition, Parts
from .splits import Splits

# Added to areas that weigh votes, so that candidates without area vote, too.
LEAST_AREA = 1e-300


@dataclass(frozen=True, eq=False)
class NumberGraph:
    """Which part numbers touch at some level of detail; colors are chosen by it.

    Attributes
    ----------
    numbers : (k,) int64
        The numbers of the parts of all levels, rising.
    pairs : (e, 2) int64
        Indices into ``numbers``: which of them touch.
    unpinned : NumberGraph or None
        The graph of the same decomposition without pinned parts, if there are some.
    unpinned_index : (k,) int64 or None
        Index of each number in ``unpinned``; -1 for a number that was made by hand.
    """

    numbers: np.ndarray
    pairs: np.ndarray
    unpinned: NumberGraph | None = None
    unpinned_index: np.ndarray | None = None

    def including(self, numbers: np.ndarray) -> NumberGraph:
        """The graph with further numbers that belong to no level and touch nothing."""
        if np.isin(numbers, self.numbers).all():
            return self
        every = np.union1d(self.numbers, numbers)
        place = np.searchsorted(every, self.numbers)
        index = np.full(len(every), -1)
        index[place] = np.arange(len(place))
        return NumberGraph(every, place[self.pairs], self, index)


@dataclass(frozen=True, eq=False)
class NumberedParts:
    """Parts in the order of their numbers.

    Attributes
    ----------
    parts : Parts
        Label i is the part with the i-th smallest number.
    numbers : (count,) int64
        Rising, from 1; not all need to be in use.
    graph : NumberGraph
        Of all levels of detail.
    """

    parts: Parts
    numbers: np.ndarray
    graph: NumberGraph

    @property
    def candidates(self) -> np.ndarray:
        """(p,) int64, the candidate of each face."""
        return self.parts.decomposition.candidates

    @property
    def candidate_numbers(self) -> np.ndarray:
        """(c,) int64, the number of each candidate's part."""
        return self.numbers[self.parts.candidate_part]

    @property
    def face_numbers(self) -> np.ndarray:
        """(p,) int64, the number of each face's part."""
        return self.candidate_numbers[self.candidates]

    @property
    def names(self) -> tuple[str, ...]:
        """Part 01 and so on, by number."""
        return tuple(default_name(number) for number in self.numbers.tolist())


def default_name(number: int) -> str:
    """The name of a part until the user gives it another."""
    return f"Part {number:02d}"


def follow(part: np.ndarray, previous_number: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Number new parts by their largest overlap with numbered old ones.

    Pairs of a new part and an old number are taken by falling overlap, each part and each number once; ties go to
    the smaller part, then to the smaller number. Parts that are left over take the smallest numbers that
    ``previous_number`` does not contain.

    Parameters
    ----------
    part : (e,) int64
        New part of each element, 0..count-1, all in use.
    previous_number : (e,) int64
        Number of the part that each element belonged to; 0 for none.
    weight : (e,) float64
        Size of each element.

    Returns
    -------
    numbers : (count,) int64
    """
    count = int(part.max(initial=-1)) + 1
    numbers = np.zeros(count, np.int64)
    known = previous_number > 0
    pairs, pair = distinct_pairs(part[known], previous_number[known])
    overlap = sums_by(pair, weight[known], len(pairs))
    taken = set()
    for new, number in pairs[np.argsort(-overlap, kind="stable")].tolist():
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
    candidate_number : (c,) int64
        The number that each candidate carries; the same for all candidates of a pinned part.
    birth_order : (c,) int64
        Which candidate's number was born first, second ...: 0..c-1.
    graph : NumberGraph
    """

    decomposition: Decomposition
    splits: Splits
    candidate_number: np.ndarray
    birth_order: np.ndarray
    graph: NumberGraph

    @classmethod
    def of(cls, decomposition: Decomposition, previous_number: np.ndarray, pinned: np.ndarray) -> Numbering:
        """Number the parts of all levels so that parts known already keep their numbers.

        Parameters
        ----------
        decomposition : Decomposition
        previous_number : (c,) int64
            The number of the part that each candidate belonged to at some level, see ``inherited``; 0 for none.
            At that level the parts get these numbers again.
        pinned : (c,) int64
            Candidates with the same number above 0 are one part at every level, with that number.

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
        # A pinned part has its own number in the other graph, any other part that of the candidate it is known by.
        origin = np.where(np.isin(graph.numbers, pinned), graph.numbers, 0)
        free = pinned == 0
        origin[np.searchsorted(graph.numbers, candidate_number[free])] = unpinned_number[free]
        index = np.minimum(np.searchsorted(unpinned.numbers, origin), len(unpinned.numbers) - 1)
        index = np.where(unpinned.numbers[index] == origin, index, -1)
        graph = replace(graph, unpinned=unpinned, unpinned_index=index)
        return cls(decomposition, splits, candidate_number, birth_order, graph)

    def parts(self, detail: float, n_parts: int = 0) -> NumberedParts:
        """Parts at a level of detail, or of an exact number if that is not 0 (pinned parts may be more)."""
        part = self.splits.parts(self.splits.n_done(self.decomposition, detail, n_parts))
        first_born = np.full(part.max() + 1, len(part))
        np.minimum.at(first_born, part, self.birth_order)
        return self.numbered(self.candidate_number[np.argsort(self.birth_order)][first_born][part])

    def numbered(self, candidate_numbers: np.ndarray) -> NumberedParts:
        """Parts by the number of each candidate's part, (c,) int64."""
        numbers = np.unique(candidate_numbers)
        parts = Parts(self.decomposition, np.searchsorted(numbers, candidate_numbers))
        return NumberedParts(parts, numbers, self.graph.including(numbers))


def _births(
    decomposition: Decomposition, splits: Splits, previous_number: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The number that each candidate carries where nothing is pinned, and the order in which these were born.

    A new part takes a previous number if it has most of the area that had this number and no part has it yet; of
    several such numbers the one that it has the most area of. Otherwise it takes the number of parts there are at
    that level, or the next that is not taken.
    """
    area = decomposition.candidate_area[splits.order] + LEAST_AREA
    previous_number = previous_number[splits.order]
    known = np.unique(previous_number[previous_number > 0])
    code = np.where(previous_number > 0, np.searchsorted(known, previous_number), len(known))

    def overlap(start, end):
        return np.bincount(code[start:end], area[start:end], len(known) + 1)[:-1]

    total, free = overlap(0, len(code)), np.ones(len(known), bool)
    taken = set(known.tolist())

    def give(start, end, count):
        mine = overlap(start, end)
        mine[~free | (2 * mine <= total)] = 0.0
        if mine.any():
            free[mine.argmax()] = False
            return int(known[mine.argmax()])
        while count in taken:
            count += 1
        taken.add(count)
        return count

    number, births = np.zeros(len(code), np.int64), []
    for start, end in splits.root_intervals.tolist():
        births.append(give(start, end, len(births) + 1))
        number[start:end] = births[-1]
    counts = (decomposition.n_candidates - splits.merge).tolist()
    for (start, middle, end), count in zip(splits.intervals.tolist(), counts, strict=True):
        sides = (start, middle), (middle, end)
        kept = np.flatnonzero(known == number[start])
        weights = [(overlap(*side)[kept].sum(), area[slice(*side)].sum()) for side in sides]
        new = sides[1] if weights[0] >= weights[1] else sides[0]
        births.append(give(*new, count))
        number[slice(*new)] = births[-1]
    order = np.argsort(births)
    birth_order = order[np.searchsorted(np.array(births)[order], number)]
    place = np.argsort(splits.order)
    return _previous_first(number[place], birth_order[place], previous_number[place], known[free])


def _previous_first(
    number: np.ndarray, birth_order: np.ndarray, previous_number: np.ndarray, left_over: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Let previous numbers be born before all new ones, and give away those that are left over.

    left_over : (l,) int64. Previous numbers that no part had most of. Each goes to the candidate that had it and
    whose new number was born first.
    """
    number, new = number.copy(), ~np.isin(number, previous_number[previous_number > 0])
    for previous in left_over.tolist():
        place = np.flatnonzero(new & (previous_number == previous))
        if len(place):
            place = place[birth_order[place].argmin()]
            number[place], new[place] = previous, False
    return number, np.argsort(np.lexsort((birth_order, new)))


def _make_room(
    number: np.ndarray, birth_order: np.ndarray, previous_number: np.ndarray, pinned: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Numbers and their order of birth with those of pinned parts kept for the pinned parts."""
    number, order = number.copy(), np.argsort(birth_order)
    taken, known, last = set(pinned.tolist()), set(previous_number.tolist()), 0
    for candidate in order[~np.isin(number[order], previous_number[previous_number > 0])].tolist():
        free = max(int(number[candidate]), last + 1)
        while free in known or (free in taken and not pinned[candidate]):
            free += 1
        number[candidate] = last = free
    # A candidate outside a pinned part that carries the part's number gets another one, born last.
    robbed = np.isin(number, pinned[pinned > 0]) & (number != pinned)
    number[robbed] = max(number.max(), pinned.max()) + 1 + np.arange(robbed.sum())
    return np.where(pinned > 0, pinned, number), np.argsort(order[np.argsort(robbed[order], kind="stable")])


def _number_graph(
    decomposition: Decomposition, splits: Splits, candidate_number: np.ndarray, birth_order: np.ndarray
) -> NumberGraph:
    """Which numbers touch at some level: what touches later touches already when the later of both is born."""
    own, born = candidate_number[splits.order], birth_order[splits.order]
    pairs = np.argsort(splits.order)[decomposition.candidate_pairs]
    number, found = np.zeros_like(own), []

    def known_by(start, end):
        number[start:end] = own[start + born[start:end].argmin()]
        return int(number[start])

    def add_neighbors(new):
        ends = number[pairs]
        others = np.unique(ends[(ends == new).any(axis=1)])
        found.append(np.stack([np.full(len(others), new), others], axis=1)[others != new])

    for new in [known_by(start, end) for start, end in splits.root_intervals.tolist()]:
        add_neighbors(new)
    for start, middle, end in splits.intervals.tolist():
        kept = int(number[start])
        add_neighbors(next(new for new in (known_by(start, middle), known_by(middle, end)) if new != kept))
    numbers = np.unique(own)
    pairs, _ = distinct_pairs(*np.sort(np.concatenate(found), axis=1).T)
    return NumberGraph(numbers, np.searchsorted(numbers, pairs))


def inherited(
    decomposition: Decomposition, detail: float, n_parts: int, previous_number: np.ndarray, pinned: np.ndarray
) -> np.ndarray:
    """Number the parts of a new decomposition by what its candidates were part of before.

    Parameters
    ----------
    decomposition : Decomposition
    detail, n_parts
        The level at which numbers are given, as ``Numbering.parts`` takes it.
    previous_number, pinned : (c,) int64
        The number of the part that each candidate belonged to, or is pinned to; 0 for none. Each number goes to the
        part that has the most of it, see ``follow``.

    Returns
    -------
    numbers : (c,) int64
        Of the part of each candidate; ``previous_number`` for ``Numbering.of``.
    """
    level = Numbering.of(decomposition, np.zeros_like(previous_number), pinned).parts(detail, n_parts)
    part = decomposition.group(level.candidate_numbers).candidate_part
    # The number of a pinned part counts where candidates are pinned to it, and nowhere else.
    elsewhere = np.where(np.isin(previous_number, pinned), 0, previous_number)
    known = np.where(pinned > 0, pinned, elsewhere)
    return follow(part, known, decomposition.candidate_area + LEAST_AREA)[part]
