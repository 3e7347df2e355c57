# SPDX-License-Identifier: GPL-3.0-or-later
"""What every method of cutting ends in: candidate parts, and the order in which they merge.

The hierarchy of all cuts holds every level of detail: none is computed again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..surface.arrays import components, frozen


@dataclass(frozen=True, eq=False)
class Dendrogram:
    """Elements joined pair by pair, in an order in which whatever is joined at any time is an interval.

    With c elements, r sets that are left in the end and s joins:

    Attributes
    ----------
    order : (c,) int64
        The element at each place.
    roots : (r, 2) int64
        Start and end of the interval of each set that is left.
    joins : (s, 3) int64
        Start, middle and end of the two intervals that each join makes one.
    rows : (s,) int64
        Which of the given pairs each join stands for; the others were joined already.
    """

    order: np.ndarray
    roots: np.ndarray
    joins: np.ndarray
    rows: np.ndarray

    @classmethod
    def of(cls, count: int, pairs: np.ndarray) -> Dendrogram:
        """Join pairs of 0..count-1 in the order given, (e, 2) int64; the first of a pair comes first."""
        # Not above: Blender's panel comes up without SciPy, to say that it is missing.
        from scipy.cluster.hierarchy import DisjointSet

        sets = DisjointSet(range(count))
        head, tail, size = list(range(count)), list(range(count)), [1] * count  # of each set's representative
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
        place = np.empty(count, np.int64)
        place[order] = np.arange(count)
        first, second, size = np.array(joins, np.int64).reshape(-1, 3).T
        return cls(
            np.array(order, np.int64), np.stack([ends[:-1], ends[1:]], axis=1),
            np.stack([place[first], place[second], place[second] + size], axis=1), np.array(rows, np.int64))

    @cached_property
    def _gap_rows(self) -> list[np.ndarray]:
        """The row that joins what is left and right of each gap, and its maxima over 2, 4, 8 ... gaps."""
        gaps = np.full(max(len(self.order) - 1, 1), np.iinfo(np.int64).max)
        gaps[self.joins[:, 1] - 1] = self.rows
        maxima = [gaps]
        while len(maxima[-1]) > (width := 2 ** (len(maxima) - 1)):
            maxima.append(np.maximum(maxima[-1][:-width], maxima[-1][width:]))
        return maxima

    def row_of(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """The row that brings two elements together; the largest int64 where none does, 0 for one and itself.

        a, b : (e,) int64. Returns (e,) int64. O(c log c) once, then O(e).
        """
        place = np.empty(len(self.order), np.int64)
        place[self.order] = np.arange(len(place))
        low, high = np.sort([place[a], place[b]], axis=0)
        # The maximum over a run of gaps is that over two overlapping runs of a power of two each.
        level = np.frexp(np.maximum(high - low, 1))[1] - 1
        found = np.zeros(len(low), np.int64)
        for width, maxima in enumerate(self._gap_rows):
            mine = (level == width) & (low < high)
            found[mine] = np.maximum(maxima[low[mine]], maxima[high[mine] - 2**width])
        return found


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """Candidate parts and the order in which they merge, weakest cut first.

    Attributes
    ----------
    n_candidates : int
    merges : (s, 2) int64
        Two candidates whose parts merge, in order. A spanning forest: s is the number of
        candidates minus the number of loose parts.
    salience : (s,) float64
        How much each merged cut deserved to stay, 0..1, never falling along the sequence.
        0.5 is the method's own decision.
    """

    n_candidates: int
    merges: np.ndarray
    salience: np.ndarray

    @classmethod
    def of(cls, n_candidates: int, merges, salience) -> Hierarchy:
        """From a merging sequence; salience becomes its running maximum."""
        salience = np.clip(np.asarray(salience, np.float64), 0.0, 1.0)
        return cls(n_candidates, frozen(np.reshape(merges, (-1, 2)), np.int64),
                   frozen(np.maximum.accumulate(salience), np.float64))

    @classmethod
    def join(cls, hierarchies: list[Hierarchy]) -> Hierarchy:
        """One hierarchy of the hierarchies of several loose parts, candidates numbered in order."""
        offsets = np.cumsum([0] + [h.n_candidates for h in hierarchies])
        merges = np.concatenate([h.merges + o for h, o in zip(hierarchies, offsets, strict=False)])
        salience = np.concatenate([h.salience for h in hierarchies])
        order = np.argsort(salience, kind="stable")
        return cls(int(offsets[-1]), frozen(merges[order], np.int64),
                   frozen(salience[order], np.float64))

    @property
    def n_loose(self) -> int:
        """The fewest parts possible: loose parts never merge."""
        return self.n_candidates - len(self.merges)

    def n_parts(self, detail: float) -> int:
        """Number of parts at a level of detail: cuts of salience 1 - detail and above stay."""
        # With a tolerance, as 1 - 0.7 is not 0.3 in binary.
        return self.n_candidates - int(np.searchsorted(self.salience, 1.0 - detail - 1e-9))

    def parts(self, n_parts: int) -> np.ndarray:
        """Which part each candidate belongs to, for an exact number of parts.

        Parameters
        ----------
        n_parts : int
            Clipped to ``n_loose``..``n_candidates``.

        Returns
        -------
        part : (n_candidates,) int64
            0..n_parts-1.
        """
        n_parts = min(max(n_parts, self.n_loose), self.n_candidates)
        done = self.merges[: self.n_candidates - n_parts]
        return components(self.n_candidates, *done.T)[1]

    @cached_property
    def _dendrogram(self) -> Dendrogram:
        return Dendrogram.of(self.n_candidates, self.merges)

    def merge_of(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """The merge that joins two candidates; the number of merges where none does.

        a, b : (e,) int64. Returns (e,) int64.
        """
        return np.minimum(self._dendrogram.row_of(a, b), len(self.merges))


@dataclass(frozen=True, eq=False)
class Candidates:
    """What a method of cutting gives for one component.

    Attributes
    ----------
    element_candidate : (E,) int64
        Candidate of each element (face, slab) of the level sets, 0..count-1.
    hierarchy : Hierarchy
        Over the candidates; decides which cuts stay.
    """

    element_candidate: np.ndarray
    hierarchy: Hierarchy
