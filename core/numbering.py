# SPDX-License-Identifier: GPL-3.0-or-later
"""Part numbers that outlive a decomposition: new parts take the numbers of the old ones they cover.

A number is what a part is known by - its name, its lock, its vertex group - while a label is only its
place in one result. Numbers start at 1, so that 0 can say "no part".
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .colors import part_colors
from .decomposition import Decomposition, Parts
from .mesh import components


@dataclass(frozen=True, eq=False)
class NumberedParts:
    """Parts in the order of their numbers.

    Attributes
    ----------
    parts : Parts
        Label i is the part with the i-th smallest number.
    numbers : (count,) int64
        Rising, from 1; not all need to be in use.
    """

    parts: Parts
    numbers: np.ndarray

    @property
    def face_numbers(self) -> np.ndarray:
        """(p,) int64, the number of each face's part."""
        return self.numbers[self.parts.labels]

    @property
    def candidate_numbers(self) -> np.ndarray:
        """(c,) int64, the number of each candidate's part."""
        return self.numbers[self.parts.candidate_part]

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


def numbered_parts(
    decomposition: Decomposition,
    detail: float | None = None,
    n_parts: int | None = None,
    former: np.ndarray | None = None,
    fixed: np.ndarray | None = None,
) -> NumberedParts:
    """Parts of a level of detail or of an exact number, with numbers that last.

    Parameters
    ----------
    decomposition : Decomposition
        With c candidates.
    detail, n_parts
        As ``Decomposition.parts``.
    former : (c,) int64, optional
        The number that each candidate had; 0 for none.
    fixed : (c,) int64, optional
        Candidates of one number above 0 are one part whatever the detail; 0 leaves them to it.

    Returns
    -------
    numbered : NumberedParts
    """
    none = np.zeros(decomposition.n_candidates, np.int64)
    former = none if former is None else former
    fixed = none if fixed is None else fixed
    grouping = _grouping(decomposition, detail, n_parts, fixed)
    parts = decomposition.group(grouping)
    held = np.zeros(parts.count, np.int64)
    np.maximum.at(held, parts.candidate_part, fixed)
    if not former.any() and not held.any():
        return NumberedParts(parts, np.arange(1, parts.count + 1))
    # A fixed number is taken: nobody else may follow it.
    former = np.where(fixed > 0, fixed, np.where(np.isin(former, held), 0, former))
    numbers = follow(parts.candidate_part, former, decomposition.candidate_area + 1e-300)
    return in_number_order(parts, numbers)


def in_number_order(parts: Parts, numbers: np.ndarray) -> NumberedParts:
    """Relabel parts so that label order is number order."""
    order = np.argsort(numbers, kind="stable")
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    cuts = np.sort(place[parts.cuts], axis=1).reshape(-1, 2)
    return NumberedParts(replace(
        parts,
        labels=place[parts.labels],
        vertex_labels=np.where(parts.vertex_labels >= 0, place[parts.vertex_labels], -1),
        candidate_part=place[parts.candidate_part],
        area=parts.area[order], share=parts.share[order], cuts=cuts,
        colors=part_colors(parts.count, cuts),
        node_part=place[parts.node_part], arc_part=place[parts.arc_part],
        point_part=place[parts.point_part],
    ), numbers[order])


def _grouping(decomposition, detail, n_parts, fixed) -> np.ndarray:
    """Groups of candidates, from 0: the hierarchy's where nothing is fixed, in connected pieces."""
    hierarchy = decomposition.hierarchy
    if not fixed.any():
        return hierarchy.parts(n_parts or hierarchy.n_parts(detail))
    if not n_parts:
        return _around(decomposition, hierarchy.parts(hierarchy.n_parts(detail)), fixed)
    low, high = hierarchy.n_loose, hierarchy.n_candidates
    while low < high:  # finer groupings never have fewer pieces
        middle = (low + high) // 2
        if _around(decomposition, hierarchy.parts(middle), fixed).max() + 1 < n_parts:
            low = middle + 1
        else:
            high = middle
    return _around(decomposition, hierarchy.parts(low), fixed)


def _around(decomposition, part, fixed) -> np.ndarray:
    """Connected pieces of a grouping without its fixed candidates, and the fixed parts, from 0."""
    a, b = decomposition.candidate_pairs.T
    together = (part[a] == part[b]) & (fixed[a] == 0) & (fixed[b] == 0)
    # One candidate of each fixed part stands for all of it, connected or not.
    _, first, inverse = np.unique(fixed, return_index=True, return_inverse=True)
    held = np.flatnonzero(fixed)
    pairs = np.stack([np.concatenate([a[together], held]),
                      np.concatenate([b[together], first[inverse.reshape(-1)[held]]])])
    return components(len(part), *pairs)[1]
