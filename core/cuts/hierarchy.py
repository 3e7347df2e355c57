# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of every method of cutting: candidates, and the order in which they merge.

The parts at every level of detail are read from the hierarchy; nothing is computed again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from operator import index
from typing import TYPE_CHECKING

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import frozen, inverse
from ..arrays.int64 import cumsum, full
from ..arrays.pairs import distinct_pairs
from ..errors import wrong_kind

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

#: Salience between candidates that nothing brought near each other.
LAST = 0.999


@dataclass(frozen=True, eq=False)
class Dendrogram:
    """The tree of sets that arises when candidates are joined pair by pair.

    The candidates are put in an order in which every set, at every time, is an interval of places. With c candidates,
    r sets that are left in the end and s joins:

    Attributes
    ----------
    order : (c,) int64
        Candidate at each place.
    roots : (r, 2) int64
        Start and end of the interval of each set that is left.
    joins : (s, 3) int64
        Start, middle and end: each join makes one set of [start, middle) and [middle, end).
    rows : (s,) int64
        Row of the given pairs that made each join, rising; the pairs of other rows had been joined before.
    """

    order: np.ndarray
    roots: np.ndarray
    joins: np.ndarray
    rows: np.ndarray

    @classmethod
    def of(cls, count: int, pairs: np.ndarray) -> Dendrogram:
        """Join candidates pair by pair.

        Parameters
        ----------
        count : int
            Number of candidates.
        pairs : (e, 2) int64
            Candidates to join, 0..count-1, in the order in which they are joined. The set of the first candidate of
            a pair gets the places before that of the second.

        Returns
        -------
        dendrogram : Dendrogram
        """
        # Imported here, because Blender's panel is shown also where SciPy is missing, to say that it is.
        from scipy.cluster.hierarchy import DisjointSet

        sets = DisjointSet(range(count))
        head, tail, size = list(range(count)), list(range(count)), [1] * count  # by representative of a set
        following = [-1] * count
        joins, rows = [], []
        for row, (a, b) in enumerate(pairs.tolist()):
            a, b = sets[a], sets[b]
            if not sets.merge(a, b):
                continue
            joins.append((head[a], head[b], size[b]))
            rows.append(row)
            following[tail[a]] = head[b]
            joined = sets[a]
            head[joined], tail[joined], size[joined] = head[a], tail[b], size[a] + size[b]
        order, ends = [], [0]
        for start in sorted({head[sets[element]] for element in range(count)}):
            while start >= 0:
                order.append(start)
                start = following[start]
            ends.append(len(order))
        place = inverse(np.array(order, np.int64))
        first, second, added = np.array(joins, np.int64).reshape(-1, 3).T
        return cls(
            np.array(order, np.int64), np.stack([ends[:-1], ends[1:]], axis=1),
            np.stack([place[first], place[second], place[second] + added], axis=1), np.array(rows, np.int64))

    @cached_property
    def place(self) -> np.ndarray:
        """(c,) int64, place of each candidate in ``order``."""
        return inverse(self.order)

    @cached_property
    def _gap_rows(self) -> list[np.ndarray]:
        """Row that joins the sets left and right of each gap between places, and its maxima over 2, 4, 8 ... gaps."""
        gaps = full(max(len(self.order) - 1, 1), np.iinfo(np.int64).max)
        gaps[self.joins[:, 1] - 1] = self.rows
        maxima = [gaps]
        while len(maxima[-1]) > (width := 2 ** (len(maxima) - 1)):
            maxima.append(np.maximum(maxima[-1][:-width], maxima[-1][width:]))
        return maxima

    def row_of(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Find the row of the pairs that brings two candidates into one set.

        Parameters
        ----------
        a, b : (e,) int64
            Candidates.

        Returns
        -------
        row : (e,) int64
            The largest int64 where no row does; 0 where a and b are one candidate.

        Notes
        -----
        O(c log c) when it is first called, then O(e log c).
        """
        low, high = np.sort([self.place[a], self.place[b]], axis=0)
        # The maximum over consecutive gaps is that over two overlapping ranges, each a power of two long.
        level = np.frexp(np.maximum(high - low, 1))[1] - 1
        found = np.zeros(len(low), np.int64)
        for width, maxima in enumerate(self._gap_rows):
            mine = (level == width) & (low < high)
            found[mine] = np.maximum(maxima[low[mine]], maxima[high[mine] - 2**width])
        return found


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """The order in which candidates merge, weakest cut first.

    Attributes
    ----------
    n_candidates : int
    merges : (s, 2) int64
        Two candidates whose parts merge, in order. The merges are a spanning forest: s is the number of candidates
        minus the number of loose parts.
    salience : (s,) float64
        How much the cut between the two parts of each merge deserves to stay, 0..1, never falling from one merge to
        the next. At 0.5 the method itself decides between cutting and merging.
    """

    n_candidates: int
    merges: np.ndarray
    salience: np.ndarray

    def __repr__(self) -> str:
        return f"<Hierarchy: {self.n_candidates} candidates, {len(self.merges)} merges>"

    @classmethod
    def of(cls, n_candidates: int, merges: ArrayLike, salience: ArrayLike) -> Hierarchy:
        """Make a hierarchy of a sequence of merges.

        Parameters
        ----------
        n_candidates : int
        merges : (s, 2) array_like of int
            Two candidates of each merge, in order.
        salience : (s,) array_like of float
            Salience of each merge, which need not rise; clipped to 0..1 and replaced by its running maximum.

        Returns
        -------
        hierarchy : Hierarchy
        """
        salience = np.clip(np.asarray(salience, np.float64), 0.0, 1.0)
        return cls(n_candidates, frozen(np.reshape(merges, (-1, 2)), np.int64),
                   frozen(np.maximum.accumulate(salience), np.float64))

    @classmethod
    def join(cls, hierarchies: list[Hierarchy]) -> Hierarchy:
        """Put the hierarchies of several components into one.

        hierarchies : list of Hierarchy. Returns a Hierarchy whose candidates follow the order of the list and whose
        merges are sorted by salience. Components never merge.
        """
        offsets = cumsum([0] + [h.n_candidates for h in hierarchies])
        none = cls.of(0, [], [])
        merges = np.concatenate([none.merges, *(h.merges + o for h, o in zip(hierarchies, offsets, strict=False))])
        salience = np.concatenate([none.salience, *(h.salience for h in hierarchies)])
        order = np.argsort(salience, kind="stable")
        return cls(int(offsets[-1]), frozen(merges[order], np.int64),
                   frozen(salience[order], np.float64))

    @property
    def n_loose(self) -> int:
        """Number of loose parts, which never merge: the fewest parts possible."""
        return self.n_candidates - len(self.merges)

    def n_parts(self, detail: float) -> int:
        """Count the parts at a level of detail: cuts of salience 1 - detail and above stay.

        detail : float, 0..1. Returns int.
        """
        # The tolerance is for rounding: 1 - 0.7 is not 0.3 in binary.
        return self.n_candidates - int(np.searchsorted(self.salience, 1.0 - detail - 1e-9))

    def parts(self, n_parts: int) -> np.ndarray:
        """Merge candidates to an exact number of parts.

        Parameters
        ----------
        n_parts : int
            Clipped to ``n_loose``..``n_candidates``.

        Returns
        -------
        part : (n_candidates,) int64
            Part of each candidate, 0..n_parts-1.

        Raises
        ------
        ParameterError
            ``n_parts`` is no whole number.
        """
        try:
            count = index(n_parts)  # of a small type of NumPy's, the number of candidates would be one, too
        except TypeError:
            raise wrong_kind("n_parts", "a whole number", n_parts) from None
        done = self.merges[: max(self.n_candidates - count, 0)]
        return components(self.n_candidates, *done.T)[1]

    def parts_at(self, detail: float) -> np.ndarray:
        """Merge candidates to the parts at a level of detail: part of each candidate, (n_candidates,) int64, from 0."""
        return self.parts(self.n_parts(detail))

    def coarsest(self, n_parts: int) -> tuple[np.ndarray, Hierarchy]:
        """Merge candidates to a number of parts, and these in the order that follows.

        Parameters
        ----------
        n_parts : int
            Clipped as ``parts`` does.

        Returns
        -------
        part : (n_candidates,) int64
            Part of each candidate, 0..n_parts-1.
        hierarchy : Hierarchy
            Of these parts; at ``n_parts`` and fewer its parts are those of this one.
        """
        n_parts = min(max(n_parts, self.n_loose), self.n_candidates)
        part, done = self.parts(n_parts), self.n_candidates - n_parts
        return part, Hierarchy.of(n_parts, part[self.merges[done:]], self.salience[done:])

    @cached_property
    def dendrogram(self) -> Dendrogram:
        """Dendrogram of the merges."""
        return Dendrogram.of(self.n_candidates, self.merges)

    def merge_of(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Find the merge that brings two candidates into one part.

        a, b : (e,) int64, candidates. Returns the place of the merge in ``merges``, (e,) int64; the number of merges
        where no merge does, 0 where a and b are one candidate.
        """
        return np.minimum(self.dendrogram.row_of(a, b), len(self.merges))

    def salience_between(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Salience of what parts each two candidates.

        a, b : (e,) int64, candidates. Returns (e,) float64: 1 where no merge joins the two, 0 of one and itself.
        """
        return np.where(a == b, 0.0, np.append(self.salience, 1.0)[self.merge_of(a, b)])

    def salience_table(self, candidates: np.ndarray) -> np.ndarray:
        """Salience of what parts each two of some candidates.

        candidates : (k,) int64. Returns (k, k) float64: 1 where no merge joins two candidates, 0 of one and itself.
        """
        order = np.argsort(self.dendrogram.place[candidates], kind="stable")
        row = candidates[order]
        step = np.append(self.salience, 1.0)[self.merge_of(row[:-1], row[1:])]
        step[row[:-1] == row[1:]] = 0.0
        # In the order of the dendrogram, two are parted by the most that parts any two neighbors between them.
        between = np.triu(np.tile(np.append(0.0, step), (len(row), 1)), 1)
        between = np.maximum.accumulate(between, axis=1)
        table = np.empty_like(between)
        table[np.ix_(order, order)] = between + between.T
        return table


@dataclass(frozen=True, eq=False)
class Candidates:
    """The candidates that a method of cutting finds on one component.

    Attributes
    ----------
    element_candidate : (E,) int64
        Candidate of each element of the level sets, 0..hierarchy.n_candidates-1.
    hierarchy : Hierarchy
        The order in which the candidates merge.
    """

    element_candidate: np.ndarray
    hierarchy: Hierarchy

    def within(self, piece: np.ndarray) -> Candidates:
        """Split candidates that lie in several pieces, and merge within pieces only, in the same order.

        piece : (E,) int64, of each element. Returns Candidates.
        """
        from scipy.cluster.hierarchy import DisjointSet  # imported here for the reason that ``Dendrogram.of`` gives

        cells, element = distinct_pairs(self.element_candidate, piece)
        # Of each set, one of the new candidates in each piece that it has elements in.
        inside: list[dict[int, int]] = [{} for _ in range(self.hierarchy.n_candidates)]
        for new, (old, place) in enumerate(cells.tolist()):
            inside[old][place] = new
        sets = DisjointSet(range(len(inside)))
        merges, salience = [], []
        for (a, b), strength in zip(self.hierarchy.merges.tolist(), self.hierarchy.salience.tolist(), strict=True):
            joined, others = inside[sets[a]], inside[sets[b]]
            for place, new in others.items():
                if joined.setdefault(place, new) != new:
                    merges.append((joined[place], new))
                    salience.append(strength)
            sets.merge(a, b)
            inside[sets[a]] = joined
        return Candidates(element, Hierarchy.of(len(cells), merges, salience))
