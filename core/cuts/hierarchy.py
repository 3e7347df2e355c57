# SPDX-License-Identifier: GPL-3.0-or-later
"""The hierarchy of cuts: every level of detail from one merging sequence."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..surface.mesh import components, frozen


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """Candidate parts and the order in which they merge, weakest cut first.

    Attributes
    ----------
    n_candidates : int
    merges : (c, 2) int64
        Two candidates whose parts merge, in order. A spanning forest: c is the number of
        candidates minus the number of loose parts.
    salience : (c,) float64
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
    def join(cls, parts: list[Hierarchy]) -> Hierarchy:
        """One hierarchy of several loose parts' hierarchies, candidates numbered in order."""
        offsets = np.cumsum([0] + [h.n_candidates for h in parts])
        merges = np.concatenate([h.merges + o for h, o in zip(parts, offsets, strict=False)])
        salience = np.concatenate([h.salience for h in parts])
        order = np.argsort(salience, kind="stable")
        return cls(int(offsets[-1]), frozen(merges[order], np.int64),
                   frozen(salience[order], np.float64))

    @property
    def n_loose(self) -> int:
        """The fewest parts possible: loose parts never merge."""
        return self.n_candidates - len(self.merges)

    def n_parts(self, detail: float) -> int:
        """Parts at a level of detail: cuts of salience 1 - detail and above stay."""
        # A hair of tolerance: 1 - 0.7 is not 0.3 in binary.
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

    def merge_of(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """The merge that joins candidates a and b; the number of merges where none does.

        a, b : (e,) int64. Returns (e,) int64.
        """
        joined = np.full(len(a), len(self.merges), np.int64)
        part = np.arange(self.n_candidates)
        for index, (first, second) in enumerate(self.merges.tolist()):
            part[part == part[second]] = part[first]
            joined[(part[a] == part[b]) & (joined > index)] = index
        return joined

    def cut_salience(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Salience of the merge that joins candidates a and b; 1 where none does.

        a, b : (e,) int64. Returns (e,) float64.
        """
        return np.append(self.salience, 1.0)[self.merge_of(a, b)]
