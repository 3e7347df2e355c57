# SPDX-License-Identifier: GPL-3.0-or-later
"""How parts come apart as the detail rises: one split after the other, around pinned parts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..cuts.hierarchy import Dendrogram
from ..surface.arrays import renumbered
from .decomposition import Decomposition


@dataclass(frozen=True, eq=False)
class Splits:
    """All levels of detail of a decomposition, from the coarsest on.

    With c candidates, r parts at the coarsest level and s splits:

    Attributes
    ----------
    order : (c,) int64
        The candidate at each place. Every part of every level is an interval of places.
    root_intervals : (r, 2) int64
        Start and end of each of the coarsest parts.
    intervals : (s, 3) int64
        Start, middle and end of each split, coarsest first: it parts [start, middle) from [middle, end).
    merge : (s,) int64
        The merge of the hierarchy that each split undoes; never rising.
    """

    order: np.ndarray
    root_intervals: np.ndarray
    intervals: np.ndarray
    merge: np.ndarray

    @classmethod
    def of(cls, decomposition: Decomposition, pinned: np.ndarray) -> Splits:
        """Read the splits off the hierarchy of a decomposition.

        Parameters
        ----------
        decomposition : Decomposition
        pinned : (c,) int64
            Candidates with the same number above 0 are one part at every level. The candidates with 0 are
            split as the hierarchy says, and stay apart where a pinned part lies between them.

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
        """The fewest parts possible."""
        return len(self.root_intervals)

    def n_done(self, decomposition: Decomposition, detail: float, n_parts: int = 0) -> int:
        """How many splits are done at a level of detail, or for an exact number of parts if that is not 0."""
        if n_parts:
            return min(max(n_parts - self.n_roots, 0), len(self.intervals))
        merged = decomposition.n_candidates - decomposition.hierarchy.n_parts(detail)
        return int((self.merge >= merged).sum())

    def parts(self, n_done: int) -> np.ndarray:
        """The part of each candidate after the first splits, (c,) int64, from 0."""
        part = np.repeat(np.arange(self.n_roots), np.diff(self.root_intervals, axis=1)[:, 0])
        for index, (_, middle, end) in enumerate(self.intervals[:n_done].tolist()):
            part[middle:end] = self.n_roots + index
        found = np.empty_like(part)
        found[self.order] = part
        return found


def _joins(decomposition: Decomposition, pinned: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of candidates to be joined, weakest cut first, and the merge of the hierarchy that each stands for.

    Some pairs are joined already by earlier ones. The merge is -1 between candidates of one pinned part.
    """
    hierarchy, pairs, merge = decomposition.hierarchy, decomposition.candidate_pairs, decomposition.pair_merge
    if not pinned.any():
        return hierarchy.merges, np.arange(len(hierarchy.merges))
    free = (pinned[pairs] == 0).all(axis=1) & (merge < len(hierarchy.merges))
    first = np.unique(pinned, return_index=True)[1][renumbered(pinned)[1]]
    held = np.flatnonzero(pinned)
    pairs = np.concatenate([np.stack([first[held], held], axis=1), pairs[free]])
    merge = np.concatenate([np.full(len(held), -1), merge[free]])
    order = np.argsort(merge, kind="stable")
    return pairs[order], merge[order]
