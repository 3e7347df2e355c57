# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers that are born as parts split, and the order of their births; ``numbering`` says what they are for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import inverse
from ..arrays.int64 import arange
from ..arrays.ties import TIE, first_largest
from .decomposition import Decomposition
from .splits import Splits

# Added to the areas by which candidates vote for numbers, in units of about the whole area: candidates without an area
# vote with this weight.
LEAST_AREA = 1e-300


def area_votes(decomposition: Decomposition) -> np.ndarray:
    """Weigh the vote of each candidate by its area, in such a unit that small meshes have votes, too.

    decomposition : Decomposition. Returns (c,) float64, above 0.
    """
    area = decomposition.candidate_area
    return np.ldexp(area, -int(np.frexp(area.sum())[1])) + LEAST_AREA  # a power of two changes no digit


def number_births(
    decomposition: Decomposition, splits: Splits, previous_number: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Let a number be born with each split, and number the candidates that are left when all splits are done.

    A new part takes a previous number if it has most of the area that had this number and no part has the number yet;
    of several such numbers, it takes the one of which it has most area. Otherwise it takes the number of parts at its
    level, or the next higher number that is not taken.

    Parameters
    ----------
    decomposition : Decomposition
        With c candidates.
    splits : Splits
        Of the decomposition, around no pinned parts.
    previous_number : (c,) int64
        Number of the part to which each candidate belonged; 0 for none.

    Returns
    -------
    number : (c,) int64
        That each candidate carries, 1 or more.
    birth_order : (c,) int64
        Place of each candidate when they are sorted by the births of their numbers, 0..c-1.
    """
    area = area_votes(decomposition)[splits.order]
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
    place = inverse(splits.order)
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
        free = arange(len(known) + 1) < len(known)
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
    return number, inverse(np.lexsort((birth_order, new)))


def make_room(
    number: np.ndarray, birth_order: np.ndarray, previous_number: np.ndarray, pinned: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Renumber so that a pinned part's number is carried only by its own candidates.

    New numbers that collide with a previous or a pinned number move up to the next free one.

    Parameters
    ----------
    number, birth_order : (c,) int64
        What ``number_births`` returns.
    previous_number : (c,) int64
        As there.
    pinned : (c,) int64
        Number of the pinned part of each candidate; 0 for none.

    Returns
    -------
    number, birth_order : (c,) int64
        The same of the candidates as they are now.
    """
    number, order = number.copy(), inverse(birth_order)
    taken, known, last = set(pinned.tolist()), set(previous_number.tolist()), 0
    for candidate in order[~np.isin(number[order], previous_number[previous_number > 0])].tolist():
        free = max(int(number[candidate]), last + 1)
        while free in known or (free in taken and not pinned[candidate]):
            free += 1
        number[candidate] = last = free
    # A candidate outside a pinned part that carries the number of this part gets a number that is born last.
    robbed = np.isin(number, pinned[pinned > 0]) & (number != pinned)
    number[robbed] = max(number.max(), pinned.max()) + 1 + arange(robbed.sum())
    return np.where(pinned > 0, pinned, number), inverse(order[np.argsort(robbed[order], kind="stable")])
