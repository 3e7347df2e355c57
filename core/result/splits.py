# SPDX-License-Identifier: GPL-3.0-or-later
"""How parts come apart as the detail rises: one split after the other, around what is fixed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .decomposition import Decomposition


@dataclass(frozen=True, eq=False)
class Splits:
    """All levels of detail of a decomposition, from the coarsest on.

    The candidates are in an order in which every part of every level is a run, so that a split is three
    places: the first of one side, the first of the other, and the end.

    Attributes
    ----------
    order : (c,) int64
        The candidate at each place.
    root_runs : (r, 2) int64
        Start and end of each of the coarsest parts.
    runs : (s, 3) int64
        Start, middle and end of each split, coarsest first.
    merge : (s,) int64
        The merge of the hierarchy that the split undoes, never rising.
    """

    order: np.ndarray
    root_runs: np.ndarray
    runs: np.ndarray
    merge: np.ndarray

    @classmethod
    def of(cls, decomposition: Decomposition, fixed: np.ndarray) -> Splits:
        """The splits of a hierarchy.

        fixed : (c,) int64. Candidates of one number above 0 are one part at every level; the others are
        parted as the hierarchy has it, in connected pieces. With 0 alone it is the hierarchy's own sequence.
        """
        count = decomposition.n_candidates
        runs = [[candidate] for candidate in range(count)]
        run_of = list(range(count))
        joins = []
        for a, b, merge in _joins(decomposition, fixed).tolist():
            first, second = run_of[a], run_of[b]
            if first == second:
                continue
            if merge >= 0:
                joins.append((first, second, len(runs[second]), merge))
            for candidate in runs[second]:
                run_of[candidate] = first
            runs[first] += runs[second]
        roots = [runs[candidate] for candidate in range(count) if run_of[candidate] == candidate]
        order = np.concatenate(roots).astype(np.int64)
        place = np.empty(count, np.int64)
        place[order] = np.arange(count)
        start, middle, size, merge = np.array(joins, np.int64).reshape(-1, 4)[::-1].T
        bounds = np.stack([place[start], place[middle], place[middle] + size], axis=1)
        ends = np.cumsum([0, *(len(run) for run in roots)])
        return cls(order, np.stack([ends[:-1], ends[1:]], axis=1), bounds, merge)

    @property
    def n_roots(self) -> int:
        """The fewest parts possible."""
        return len(self.root_runs)

    def done(self, decomposition: Decomposition, detail: float, n_parts: int = 0) -> int:
        """How many splits are done at a level of detail, or for an exact number of parts if that is not 0."""
        if n_parts:
            return min(max(n_parts - self.n_roots, 0), len(self.runs))
        merged = decomposition.n_candidates - decomposition.hierarchy.n_parts(detail)
        return int((self.merge >= merged).sum())


    def parts(self, done: int) -> np.ndarray:
        """The part of each candidate after some splits, (c,) int64, from 0."""
        part = np.repeat(np.arange(self.n_roots), np.diff(self.root_runs, axis=1)[:, 0])
        for index, (_, middle, end) in enumerate(self.runs[:done].tolist()):
            part[middle:end] = self.n_roots + index
        found = np.empty_like(part)
        found[self.order] = part
        return found


def _joins(decomposition, fixed) -> np.ndarray:
    """Candidates to be joined, weakest first, and the merge of the hierarchy that each stands for.

    Returns
    -------
    joins : (k, 3) int64
        Some join what is joined already. The merge is -1 between candidates of one fixed part.
    """
    hierarchy, pairs, merge = decomposition.hierarchy, decomposition.candidate_pairs, decomposition.pair_merge
    if not fixed.any():
        return np.column_stack([hierarchy.merges, np.arange(len(hierarchy.merges))])
    free = (fixed[pairs] == 0).all(axis=1) & (merge < len(hierarchy.merges))
    joins = np.column_stack([pairs[free], merge[free]])
    _, first, inverse = np.unique(fixed, return_index=True, return_inverse=True)
    held = np.flatnonzero(fixed)
    held = np.column_stack([first[inverse.reshape(-1)[held]], held, np.full(len(held), -1)])
    joins = np.concatenate([held, joins])
    return joins[np.argsort(joins[:, 2], kind="stable")]
