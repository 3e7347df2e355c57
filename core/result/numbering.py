# SPDX-License-Identifier: GPL-3.0-or-later
"""Part numbers that last: through every level of detail, and from one decomposition to the next.

A number is what a part is known by - its name, its colour, its lock, its vertex group - while a label is
only its place in one result. Numbers start at 1, so that 0 can say "no part".

While the detail rises, a part that is split keeps its number on one side, and all others keep theirs; the
other side takes a number of its own. So every candidate has a number: the last one born with it as the
first of its part. A part is known by the number of the candidate in it whose number was born first. That
depends on nothing but the part itself, and so nothing done elsewhere renumbers it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ..surface.mesh import frozen
from ..uses.colors import PALETTE, chosen_colors
from .decomposition import Decomposition, Parts
from .splits import Splits


@dataclass(frozen=True, eq=False)
class NumberGraph:
    """Which numbers touch at some level of detail: what colours depend on.

    Attributes
    ----------
    numbers : (k,) int64
        Of all levels, rising.
    pairs : (e, 2) int64
        Places in ``numbers`` of those that touch.
    plain : NumberGraph or None
        The same with nothing fixed, if something is.
    origin : (k,) int64
        The place of each number in ``plain``; -1 for one made by hand.
    """

    numbers: np.ndarray
    pairs: np.ndarray
    plain: NumberGraph | None = None
    origin: np.ndarray | None = None

    def including(self, numbers: np.ndarray) -> NumberGraph:
        """The same with numbers of no level, which touch nothing."""
        if np.isin(numbers, self.numbers).all():
            return self
        every = np.union1d(self.numbers, numbers)
        place = np.searchsorted(every, self.numbers)
        origin = np.full(len(every), -1)
        origin[place] = np.arange(len(place))
        return NumberGraph(every, place[self.pairs], self, origin)

    def colors(self, palette: np.ndarray) -> np.ndarray:
        """(k,) int64, place in the palette. What is done by hand changes no colour unless it makes two alike touch."""
        return _chosen(self, palette.tobytes())


@lru_cache(16)
def _chosen(graph: NumberGraph, palette: bytes) -> np.ndarray:
    """Chosen once for all levels of detail: they have one graph."""
    palette = np.frombuffer(palette).reshape(-1, 3)
    wanted = None
    if graph.plain is not None:
        wanted = np.where(graph.origin >= 0, graph.plain.colors(palette)[graph.origin], -1)
    return frozen(chosen_colors(len(graph.numbers), graph.pairs, palette, wanted), np.int64)


@dataclass(frozen=True, eq=False)
class NumberedParts:
    """Parts in the order of their numbers.

    Attributes
    ----------
    parts : Parts
        Label i is the part with the i-th smallest number.
    numbers : (count,) int64
        Rising, from 1; not all need to be in use.
    candidates : (p,) int64
        The candidate of each face.
    graph : NumberGraph
    """

    parts: Parts
    numbers: np.ndarray
    candidates: np.ndarray
    graph: NumberGraph

    @property
    def face_numbers(self) -> np.ndarray:
        """(p,) int64, the number of each face's part."""
        return self.candidate_numbers[self.candidates]

    @property
    def candidate_numbers(self) -> np.ndarray:
        """(c,) int64, the number of each candidate's part."""
        return self.numbers[self.parts.candidate_part]

    def colors(self, palette: np.ndarray = PALETTE) -> np.ndarray:
        """(count, 3) float64 sRGB. A number has one colour at all levels, and no other that touches it has it."""
        return palette[self.graph.colors(palette)[np.searchsorted(self.graph.numbers, self.numbers)]]

    @property
    def names(self) -> tuple[str, ...]:
        """Part 01 and so on, by number."""
        return tuple(default_name(number) for number in self.numbers.tolist())


def default_name(number: int) -> str:
    """What a part is called until somebody names it."""
    return f"Part {number:02d}"


def follow(part: np.ndarray, former: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Numbers for new parts, by their largest overlap with numbered old ones.

    Pairs are taken by falling overlap, each part and each number once; ties by part, then number. Parts
    left over take the smallest numbers that ``former`` does not contain.

    Parameters
    ----------
    part : (e,) int64
        New part of each element, 0..count-1, all in use.
    former : (e,) int64
        Number of the part each element belonged to; 0 for none.
    weight : (e,) float64
        Size of each element.

    Returns
    -------
    numbers : (count,) int64
    """
    count = int(part.max(initial=-1)) + 1
    numbers = np.zeros(count, np.int64)
    known = former > 0
    pairs, where = np.unique(np.stack([part[known], former[known]], axis=1), axis=0, return_inverse=True)
    overlap = np.bincount(where.reshape(-1), weight[known], len(pairs))
    taken = set()
    for new, old in pairs[np.argsort(-overlap, kind="stable")].tolist():
        if not numbers[new] and old not in taken:
            numbers[new] = old
            taken.add(old)
    open_parts = np.flatnonzero(numbers == 0)
    free = np.setdiff1d(np.arange(1, count + len(pairs) + len(open_parts) + 1), former)
    numbers[open_parts] = free[: len(open_parts)]
    return numbers


def transfer(part: np.ndarray, former: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """The number that most of each part's elements had, 0 where most had none.

    Unlike ``follow``, several parts may get the same number.

    Parameters
    ----------
    part, former, weight
        As in ``follow``.

    Returns
    -------
    numbers : (count,) int64
    """
    pairs, where = np.unique(np.stack([part, former], axis=1), axis=0, return_inverse=True)
    size = np.bincount(where.reshape(-1), weight, len(pairs))
    order = np.lexsort((-pairs[:, 1], size, pairs[:, 0]))
    numbers = np.zeros(int(part.max(initial=-1)) + 1, np.int64)
    numbers[pairs[order, 0]] = pairs[order, 1]
    return numbers


@dataclass(frozen=True, eq=False)
class Numbering:
    """The number of every part at every level of detail.

    Attributes
    ----------
    decomposition : Decomposition
        With c candidates.
    splits : Splits
    own : (c,) int64
        The number of each candidate; one for all of a fixed part.
    rank : (c,) int64
        When that number was born, 0..c-1.
    graph : NumberGraph
    """

    decomposition: Decomposition
    splits: Splits
    own: np.ndarray
    rank: np.ndarray
    graph: NumberGraph

    @classmethod
    def of(cls, decomposition: Decomposition, former: np.ndarray, fixed: np.ndarray) -> Numbering:
        """Numbers around those that are known.

        Parameters
        ----------
        decomposition : Decomposition
        former : (c,) int64
            The number that each candidate was given at some level, see ``inherited``; 0 for none. At that
            level the parts have these numbers.
        fixed : (c,) int64
            Candidates of one number above 0 are one part whatever the detail; 0 leaves them to it.
        """
        splits = Splits.of(decomposition, np.zeros_like(fixed))
        plain_own, rank = _born(decomposition, splits, former)
        graph = _graph(decomposition, splits, plain_own, rank)
        if not fixed.any():
            return cls(decomposition, splits, plain_own, rank, graph)
        own, rank = _around(plain_own, rank, former, fixed)
        splits = Splits.of(decomposition, fixed)
        fixed_graph = _graph(decomposition, splits, own, rank)
        # A fixed part goes by its number, any other by the candidate that its number is of.
        origin = np.where(np.isin(fixed_graph.numbers, fixed), fixed_graph.numbers, 0)
        free = fixed == 0
        origin[np.searchsorted(fixed_graph.numbers, own[free])] = plain_own[free]
        place = np.minimum(np.searchsorted(graph.numbers, origin), len(graph.numbers) - 1)
        place = np.where(graph.numbers[place] == origin, place, -1)
        return cls(decomposition, splits, own, rank, replace(fixed_graph, plain=graph, origin=place))

    def parts(self, detail: float, n_parts: int = 0) -> NumberedParts:
        """Parts at a level of detail, or of an exact number if that is not 0 (fixed parts may be more)."""
        part = self.splits.parts(self.splits.done(self.decomposition, detail, n_parts))
        first = np.full(part.max() + 1, len(part))
        np.minimum.at(first, part, self.rank)
        return self.shown(self.own[np.argsort(self.rank)][first][part])

    def shown(self, candidate_numbers: np.ndarray) -> NumberedParts:
        """Parts by the number of each candidate, (c,) int64."""
        parts = self.decomposition.group(candidate_numbers)
        numbers = np.zeros(parts.count, np.int64)
        numbers[parts.candidate_part] = candidate_numbers
        graph = self.graph.including(numbers)
        return _in_number_order(NumberedParts(parts, numbers, self.decomposition.candidates, graph))


def _born(decomposition, splits, former) -> tuple[np.ndarray, np.ndarray]:
    """The number of each candidate with nothing fixed, and when it was born.

    A new part takes, of the former numbers, the one that it has the most of, if it has most of that and it is
    free; or else as many as there are parts by then, or the next that nobody has.
    """
    area = decomposition.candidate_area[splits.order] + 1e-300
    former = former[splits.order]
    known = np.unique(former[former > 0])
    code = np.where(former > 0, np.searchsorted(known, former), len(known))

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
    for start, end in splits.root_runs.tolist():
        births.append(give(start, end, len(births) + 1))
        number[start:end] = births[-1]
    counts = (decomposition.n_candidates - splits.merge).tolist()
    for (start, middle, end), count in zip(splits.runs.tolist(), counts, strict=True):
        sides = (start, middle), (middle, end)
        held = np.flatnonzero(known == number[start])
        weights = [(overlap(*side)[held].sum(), area[slice(*side)].sum()) for side in sides]
        new = sides[1] if weights[0] >= weights[1] else sides[0]
        births.append(give(*new, count))
        number[slice(*new)] = births[-1]
    order = np.argsort(births)
    rank = order[np.searchsorted(np.array(births)[order], number)]
    place = np.argsort(splits.order)
    return _former_first(number[place], rank[place], former[place], known[free])


def _former_first(own, rank, former, lost) -> tuple[np.ndarray, np.ndarray]:
    """The same with former numbers born before all others, and those that no part had most of given, too."""
    own, new = own.copy(), ~np.isin(own, former[former > 0])
    for number in lost.tolist():
        place = np.flatnonzero(new & (former == number))
        if len(place):  # to the first that has a new one
            place = place[rank[place].argmin()]
            own[place], new[place] = number, False
    return own, np.argsort(np.lexsort((rank, new)))


def _around(own, rank, former, fixed) -> tuple[np.ndarray, np.ndarray]:
    """The same where fixed parts have numbers of their own: new numbers make room for these."""
    own, order = own.copy(), np.argsort(rank)
    taken, known, last = set(fixed.tolist()), set(former.tolist()), 0
    for candidate in order[~np.isin(own[order], former[former > 0])].tolist():
        number = max(int(own[candidate]), last + 1)
        while number in known or (number in taken and not fixed[candidate]):
            number += 1
        own[candidate] = last = number
    # A number that a fixed part took away from its candidate: another one, born last.
    lost = np.isin(own, fixed[fixed > 0]) & (own != fixed)
    own[lost] = max(own.max(), fixed.max()) + 1 + np.arange(lost.sum())
    return np.where(fixed > 0, fixed, own), np.argsort(order[np.argsort(lost[order], kind="stable")])


def _graph(decomposition, splits, own, rank) -> NumberGraph:
    """The numbers that touch at some level: those that a new part touches when it is born."""
    own, rank = own[splits.order], rank[splits.order]
    pairs = np.argsort(splits.order)[decomposition.candidate_pairs]
    number, found = np.zeros_like(own), []

    def name(start, end):
        number[start:end] = own[start + rank[start:end].argmin()]
        return int(number[start])

    def neighbours(born):
        ends = number[pairs]
        others = np.unique(ends[(ends == born).any(axis=1)])
        found.append(np.stack([np.full(len(others), born), others], axis=1)[others != born])

    for born in [name(start, end) for start, end in splits.root_runs.tolist()]:
        neighbours(born)
    for start, middle, end in splits.runs.tolist():
        kept = int(number[start])
        neighbours(next(born for born in (name(start, middle), name(middle, end)) if born != kept))
    numbers = np.unique(own)
    pairs = np.unique(np.sort(np.concatenate(found), axis=1), axis=0)
    return NumberGraph(numbers, np.searchsorted(numbers, pairs))


def inherited(decomposition: Decomposition, detail: float, n_parts: int, former: np.ndarray,
              fixed: np.ndarray) -> np.ndarray:
    """Numbers for the parts of a new decomposition, by what its candidates were part of before.

    Parameters
    ----------
    decomposition : Decomposition
    detail, n_parts
        As ``Numbering.parts``: the level at which numbers are given.
    former, fixed : (c,) int64
        The number that each candidate had, or is tied to; 0 for none. Numbers go where the most of them is,
        see ``follow``.

    Returns
    -------
    numbers : (c,) int64
        Of the part of each candidate; ``former`` for ``Numbering.of``.
    """
    level = Numbering.of(decomposition, np.zeros_like(former), fixed).parts(detail, n_parts)
    part = decomposition.group(level.candidate_numbers).candidate_part
    return follow(part, _without_held(former, fixed), decomposition.candidate_area + 1e-300)[part]


def _without_held(former, fixed) -> np.ndarray:
    """Former numbers, those of fixed parts where they are fixed and nowhere else."""
    return np.where(fixed > 0, fixed, np.where(np.isin(former, fixed), 0, former))


def _in_number_order(numbered: NumberedParts) -> NumberedParts:
    """The same with labels in the order of the numbers."""
    parts = numbered.parts
    order = np.argsort(numbered.numbers, kind="stable")
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    numbered = replace(numbered, numbers=numbered.numbers[order])
    parts = replace(
        parts,
        labels=place[parts.labels],
        vertex_labels=np.where(parts.vertex_labels >= 0, place[parts.vertex_labels], -1),
        candidate_part=place[parts.candidate_part],
        area=parts.area[order], share=parts.share[order],
        cuts=np.sort(place[parts.cuts], axis=1).reshape(-1, 2),
        colors=numbered.colors(),
        node_part=place[parts.node_part], arc_part=place[parts.arc_part],
        point_part=place[parts.point_part],
    )
    return replace(numbered, parts=parts)
