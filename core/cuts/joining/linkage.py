# SPDX-License-Identifier: GPL-3.0-or-later
"""Average linkage: groups join in the order of how surely, on average, their members belong together."""

from __future__ import annotations

import heapq
import math

import numpy as np

NONE = math.inf, -1  # in place of a near pair


def average_linkage(
    count: int, pairs: np.ndarray, score: np.ndarray, weight: np.ndarray, size: np.ndarray | None = None,
    ease: float = 0.0, near: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Join groups, the best first; the score of two groups is the weighted mean of their pairs' scores.

    Parameters
    ----------
    count : int
        Of members; at first each is a group.
    pairs : (e, 2) int64
        Members that were compared, each pair once.
    score : (e,) float64
        How surely they belong together; log-odds, whose means tell a sure pair from many unsure ones.
    weight : (e,) float64
        What each pair counts, above 0.
    size : (count,) float64, optional
        Of each member, above 0. Groups have the sum.
    ease : float
        How much more easily small groups join: this, times the logarithm of the size of the smaller, is taken from the
        score of two groups, where that size is below 1.
    near : (e,) bool, optional
        Pairs that can join groups. The others have their say in the mean, but two groups without a near pair between
        them stay apart. Without it all pairs are near.

    Returns
    -------
    merges : (s, 2) int64
        A member of each of the two groups that join, in order; until no near pair is left apart.
    scores : (s,) float64
        Of the groups when they joined. It may rise from one merge to the next.
    rows : (s,) int64
        A near pair between the two groups: of the highest score.

    Notes
    -----
    O(e log e) in Python: of parts there are hundreds, not thousands.
    """
    # Of each group, by neighbor: the sum of weighted scores, the weight, and the best near pair as (-score, row).
    sizes = [1.0] * count if size is None else size.tolist()

    def cost_of(a: int, b: int, edge: tuple[float, float, tuple[float, int]]) -> float:
        return ease * math.log(min(sizes[a], sizes[b], 1.0)) - edge[0] / edge[1]

    around: list[dict[int, tuple[float, float, tuple[float, int]]]] = [{} for _ in range(count)]
    joins = [True] * len(pairs) if near is None else near.tolist()
    for row, ((a, b), s, w) in enumerate(zip(pairs.tolist(), score.tolist(), weight.tolist(), strict=True)):
        around[a][b] = around[b][a] = (s * w, w, (-s, row) if joins[row] else NONE)
    heap = [(cost_of(a, b, edge), a, b)
            for a in range(count) for b, edge in around[a].items() if a < b and edge[2] is not NONE]
    heapq.heapify(heap)
    merges, scores, rows = [], [], []
    while heap:
        cost, a, b = heapq.heappop(heap)
        edge = around[a].get(b)
        if edge is None or cost_of(a, b, edge) != cost:
            continue  # gone, or changed since
        merges.append((a, b))
        scores.append(-cost)
        rows.append(edge[2][1])
        del around[a][b], around[b][a]
        sizes[a] += sizes[b]
        changed = set(around[a]) if ease else set()
        for other, (s, w, best) in around[b].items():
            del around[other][b]
            known = around[a].get(other)
            joined = (s, w, best) if known is None else (s + known[0], w + known[1], min(best, known[2]))
            around[a][other] = around[other][a] = joined
            changed.add(other)
        for other in changed:
            if around[a][other][2] is NONE:
                continue
            heapq.heappush(heap, (cost_of(a, other, around[a][other]), min(a, other), max(a, other)))
        around[b] = {}
    return np.reshape(merges, (-1, 2)).astype(np.int64), np.array(scores, float), np.array(rows, np.int64)
