# SPDX-License-Identifier: GPL-3.0-or-later
"""The splits by which parts come apart as the detail rises, one after the other; pinned parts are never split."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import renumbered
from ..arrays.int64 import arange, full
from ..cuts.hierarchy import Dendrogram
from .decomposition import Decomposition


@dataclass(frozen=True, eq=False)
class Splits:
    """All levels of detail of a decomposition, as a sequence of splits from the coarsest level on.

    With c candidates, r parts at the coarsest level and s splits:

    Attributes
    ----------
    order : (c,) int64
        Candidate at each place. Every part of every level is an interval of places.
    root_intervals : (r, 2) int64
        Start and end of the interval of each part of the coarsest level.
    intervals : (s, 3) int64
        Start, middle and end of each split, coarsest first: the split separates [start, middle) from [middle, end).
    merge : (s,) int64
        Merge of the hierarchy that each split undoes; never rising.
    """

    order: np.ndarray
    root_intervals: np.ndarray
    intervals: np.ndarray
    merge: np.ndarray

    @classmethod
    def of(cls, decomposition: Decomposition, pinned: np.ndarray) -> Splits:
        """Read the splits from the hierarchy of a decomposition.

        Parameters
        ----------
        decomposition : Decomposition
            With c candidates.
        pinned : (c,) int64
            Number of the pinned part to which each candidate belongs, 0 for none. The candidates of one pinned part are
            one part at every level. Candidates with 0 merge as the hierarchy says, but only where they touch, so that
            those on two sides of a pinned part stay apart.

        Returns
        -------
        splits : Splits
        """
        pairs, merge = _joins(decomposition, pinned)
        tree = Dendrogram.of(decomposition.n_candidates, pairs)
        merge = merge[tree.rows]
        undone = np.flatnonzero(merge >= 0)[::-1]
        return cls(tree.order, tree.roots, tree.joins[undone], merge[undone])

    @property
    def n_roots(self) -> int:
        """Number of parts at the coarsest level, the fewest possible."""
        return len(self.root_intervals)

    def n_done(self, decomposition: Decomposition, detail: float, n_parts: int = 0) -> int:
        """Count the splits that are done at a level of detail, or for an exact number of parts.

        Parameters
        ----------
        decomposition : Decomposition
            The decomposition from which the splits were read.
        detail : float
            0..1: cuts of salience 1 - detail and above stay.
        n_parts : int
            Exact number of parts, clipped to what is possible; 0 leaves the decision to the detail.

        Returns
        -------
        n_done : int
        """
        if n_parts:
            return min(max(n_parts - self.n_roots, 0), len(self.intervals))
        merged = decomposition.n_candidates - decomposition.hierarchy.n_parts(detail)
        return int((self.merge >= merged).sum())

    def parts(self, n_done: int) -> np.ndarray:
        """Find the parts after some splits.

        n_done : int, number of splits that are done, coarsest first. Returns the part of each candidate, (c,) int64,
        from 0.
        """
        part = np.repeat(arange(self.n_roots), np.diff(self.root_intervals, axis=1)[:, 0])
        for index, (_, middle, end) in enumerate(self.intervals[:n_done].tolist()):
            part[middle:end] = self.n_roots + index
        found = np.empty_like(part)
        found[self.order] = part
        return found


def _joins(decomposition: Decomposition, pinned: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of candidates that are joined, weakest cut first, (j, 2), and the merge that joins each pair, (j,).

    A pair may consist of candidates that earlier pairs have joined already. The merge of two candidates of one pinned
    part is -1: it comes before all merges of the hierarchy.
    """
    hierarchy, pairs, merge = decomposition.hierarchy, decomposition.candidate_pairs, decomposition.pair_merge
    if not pinned.any():
        return hierarchy.merges, arange(len(hierarchy.merges))
    free = (pinned[pairs] == 0).all(axis=1) & (merge < len(hierarchy.merges))
    first = np.unique(pinned, return_index=True)[1][renumbered(pinned)[1]]
    in_pinned = np.flatnonzero(pinned)
    pairs = np.concatenate([np.stack([first[in_pinned], in_pinned], axis=1), pairs[free]])
    merge = np.concatenate([full(len(in_pinned), -1), merge[free]])
    order = np.argsort(merge, kind="stable")
    return pairs[order], merge[order]
