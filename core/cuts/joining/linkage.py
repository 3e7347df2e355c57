# SPDX-License-Identifier: GPL-3.0-or-later
"""Average linkage: groups join in the order of how surely, on average, their members belong together."""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

NONE = math.inf, -1  # in place of a near pair

#: What two groups cost to join, both groups, the lower first, the sum of their weighted scores, that of the weights,
#: and the best near pair as (-score, row). Without a near pair it costs infinitely much.
Edge = tuple[float, int, int, float, float, tuple[float, int]]


@dataclass(frozen=True, eq=False)
class JudgedPairs:
    """Pairs of members of which it was judged how surely they belong together.

    Attributes
    ----------
    members : (e, 2) int64
        Each pair once.
    score : (e,) float64
        How surely they belong together; log-odds, whose means tell a sure pair from many unsure ones.
    weight : (e,) float64
        What each pair counts, above 0.
    near : (e,) bool
        Pairs that can join groups. The others have their say in the mean, but two groups without a near pair between
        them stay apart.
    """

    members: np.ndarray
    score: np.ndarray
    weight: np.ndarray
    near: np.ndarray


class Linkage(NamedTuple):
    """The order in which groups of members join.

    Attributes
    ----------
    merges : (s, 2) int64
        The lowest member of each of the two groups that join, in order; the lower one first.
    scores : (s,) float64
        Of the groups when they joined. It may rise from one merge to the next.
    rows : (s,) int64
        A near pair between the two groups: of the highest score.
    """

    merges: np.ndarray
    scores: np.ndarray
    rows: np.ndarray


def average_linkage(
    count: int, pairs: JudgedPairs, size: np.ndarray | None = None, ease: float = 0.0
) -> Linkage:
    """Join groups, the best first; the score of two groups is the weighted mean of their pairs' scores.

    Parameters
    ----------
    count : int
        Of members; at first each is a group.
    pairs : JudgedPairs
        Of these.
    size : (count,) float64, optional
        Of each member, above 0. Groups have the sum.
    ease : float
        How much more easily small groups join: this, times the logarithm of the size of the smaller, is taken from the
        score of two groups, where that size is below 1.

    Returns
    -------
    linkage : Linkage
        Until no near pair is left apart.

    Notes
    -----
    After [Muellner2011], his generic algorithm: each group knows a bound of what its cheapest neighbor costs, which is
    found anew only when no other is less. About O(e log c) in Python, c members: of parts there are hundreds, of
    which each is near some ten.
    """
    groups = _Groups([1.0] * count if size is None else size.tolist(), ease)
    columns = (column.tolist() for column in (pairs.members, pairs.score, pairs.weight, pairs.near))
    for row, ((a, b), s, w, joins) in enumerate(zip(*columns, strict=True)):
        groups.link_(a, b, s * w, w, (-s, row) if joins else NONE)
    groups.search_(range(count))
    merges, scores, rows = [], [], []
    while (edge := groups.pop_()) is not None:
        merges.append(edge[1:3])
        scores.append(-edge[0])
        rows.append(edge[5][1])
        groups.merge_(*edge[1:3])
    return Linkage(np.reshape(merges, (-1, 2)).astype(np.int64), np.array(scores, float), np.array(rows, np.int64))


class _Groups:
    """Groups, and between which of them there are pairs; ``merge_`` joins two, ``search_`` and ``pop_`` find which."""

    def __init__(self, sizes: list[float], ease: float) -> None:
        self.sizes, self.ease = sizes, ease
        self.around: list[dict[int, Edge]] = [{} for _ in sizes]
        #: Of each group a lower bound: no edge that it has costs less than this one, which may no longer be there.
        self.nearest: list[Edge | None] = [None for _ in sizes]
        self.queue: list[tuple[Edge, int]] = []

    def link_(self, a: int, b: int, score: float, weight: float, best: tuple[float, int]) -> Edge:
        """Put an edge between two groups, in place of the one that is there."""
        cost = math.inf
        if best is not NONE:
            cost = self.ease * math.log(min(self.sizes[a], self.sizes[b], 1.0)) - score / weight
        edge = (cost, a, b, score, weight, best) if a < b else (cost, b, a, score, weight, best)
        self.around[a][b] = self.around[b][a] = edge
        return edge

    def search_(self, groups: Iterable[int]) -> None:
        """Find the cheapest edge of some groups anew."""
        for group in groups:
            edge = min(self.around[group].values(), default=None)
            self.nearest[group] = edge
            if edge is not None and edge[5] is not NONE:
                heapq.heappush(self.queue, (edge, group))

    def pop_(self) -> Edge | None:
        """The cheapest edge of all."""
        while self.queue:
            edge, group = heapq.heappop(self.queue)
            if self.nearest[group] is not edge:
                continue  # a cheaper one has come
            if self.around[edge[1]].get(edge[2]) is edge:
                return edge
            self.search_([group])
        return None

    def merge_(self, a: int, b: int) -> None:
        """Let group b become part of group a."""
        around, sizes, before = self.around, self.sizes, self.sizes[a]
        of_a, of_b = around[a], around[b]
        del of_a[b], of_b[a]
        sizes[a] += sizes[b]
        changed = [(other, edge[3:]) for other, edge in of_a.items()
                   if self.ease and before < min(sizes[other], 1.0) and other not in of_b]
        for other, (_, _, _, score, weight, best) in of_b.items():
            del around[other][b]
            if (known := of_a.get(other)) is not None:
                score, weight, best = score + known[3], weight + known[4], min(best, known[5])
            changed.append((other, (score, weight, best)))
        for other, (score, weight, best) in changed:
            edge, nearest = self.link_(a, other, score, weight, best), self.nearest[other]
            if best is not NONE and (nearest is None or edge < nearest):
                self.nearest[other] = edge
                heapq.heappush(self.queue, (edge, other))
        self.around[b], self.nearest[b] = {}, None
        self.search_([a])
