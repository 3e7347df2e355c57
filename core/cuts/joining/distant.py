# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of parts at any distance, and how the two hang together.

Both arms of a robot may touch the same shoulder and belong to it, each as far as its own contact shows; that they are
not one part shows only when they are compared with each other. So the largest parts are compared in all pairs: by what
parts them on the way from one to the other, by the level to which the AGD falls there, and by their shapes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.cluster.hierarchy import DisjointSet
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra, minimum_spanning_tree

from ...arrays.int64 import arange
from ...arrays.pairs import edge_keys, pair_keys
from ...arrays.ties import on_grid, rounded
from ...arrays.vectors import distances_between
from .pairs import PartPairs, Salience, cut_between

MOST_COMPARED = 80  # parts that are compared with all others; pairs grow as the square of it
#: Of one part; of a pair first the smaller.
PART = ("log_area", "log_piece_area", "extent_1", "extent_2", "extent_3", "agd", "climb")
#: Of a pair.
PAIR = ("odds", "weakest", "joined", "steps", "way", "distance", "pass", "same_piece", "salience", "alike")
FEATURES = (*PAIR, *(f"small_{n}" for n in PART), *(f"large_{n}" for n in PART))
# Values of features that are undefined: log-odds of parts that are not near each other, and of those that nothing
# joins; the lowest level; the length of a way in diameters, and its steps.
NOT_NEAR, NEVER, LOWEST, FAR, STEPS = -9.0, -20.0, -1.0, 5.0, 50.0


@dataclass(frozen=True, eq=False)
class DistantPairs:
    """All pairs of the largest parts, near each other or not.

    Attributes
    ----------
    parts : (e, 2) int64
        The smaller index first.
    features : (e, len(FEATURES)) float64
    """

    parts: np.ndarray
    features: np.ndarray


def distant_pairs(
    near: PartPairs, salience: Salience, odds: np.ndarray, merges: np.ndarray, score: np.ndarray
) -> DistantPairs:
    """Compare the largest parts of a body in all pairs.

    Parameters
    ----------
    near : PartPairs
        The e pairs that come near each other, and the shapes of all c parts.
    salience : callable
        Of the cut between two parts of one piece; not asked of others.
    odds : (e,) float64
        Log-odds that the two parts of a near pair are one.
    merges, score : (s, 2) int64 and (s,) float64
        In which order parts join as near pairs alone would have it, see ``average_linkage``, and how surely.

    Returns
    -------
    pairs : DistantPairs
        Empty if fewer than two parts are compared. Of more than MOST_COMPARED parts the largest are taken; a group of
        equal area that does not fit in whole is left out.
    """
    shapes, count = near.shapes, len(near.shapes.area)
    chosen = _largest(shapes.area)
    first, second = np.triu_indices(len(chosen), 1)
    parts = chosen[np.stack([first, second], axis=1)]
    swap = rounded(shapes.area[parts[:, 0]]) > rounded(shapes.area[parts[:, 1]])
    small, large = np.where(swap[:, None], parts[:, ::-1], parts).T
    level = _joined_at(*_strongest_first(near.parts, shapes.agd[near.parts].min(axis=1)), chosen, LOWEST)[first, second]
    steps, way = _ways(near.parts, shapes.center, chosen)
    same = shapes.piece[small] == shapes.piece[large]
    of_part = {
        "log_area": np.log(shapes.area), "log_piece_area": np.log(shapes.piece_area), "agd": shapes.agd,
        **{f"extent_{k + 1}": shapes.extents[:, k] for k in range(3)}}
    columns = {
        "odds": _direct(near.parts, odds, parts, count),
        "weakest": _joined_at(*_strongest_first(near.parts, odds), chosen, NEVER)[first, second],
        "joined": _joined_at(merges, np.minimum.accumulate(score), chosen, NEVER)[first, second],
        "steps": steps[first, second], "way": way[first, second],
        "distance": np.linalg.norm(shapes.center[small] - shapes.center[large], axis=1),
        "pass": level, "same_piece": same, "salience": cut_between(salience, small, large, same),
        "alike": shapes.unlikeness(small, large),
        **{f"small_{n}": value[small] for n, value in of_part.items()},
        **{f"large_{n}": value[large] for n, value in of_part.items()},
        "small_climb": shapes.agd[small] - level, "large_climb": shapes.agd[large] - level,
    }
    return DistantPairs(parts, np.stack([columns[n] for n in FEATURES], axis=1).astype(float))


def _largest(area: np.ndarray) -> np.ndarray:
    """The MOST_COMPARED largest parts, in their order, without a group of equal area that does not fit in whole."""
    if len(area) <= MOST_COMPARED:
        return arange(len(area))
    area = rounded(area)
    return np.flatnonzero(area > np.partition(area, -MOST_COMPARED - 1)[-MOST_COMPARED - 1])


def _direct(near: np.ndarray, odds: np.ndarray, parts: np.ndarray, count: int) -> np.ndarray:
    """Log-odds of those pairs, (e, 2), that are among the near ones; NOT_NEAR of the others."""
    key, wanted = pair_keys(near, count), pair_keys(parts, count)
    if not len(key):
        return np.full(len(parts), NOT_NEAR)
    order = np.argsort(key)
    place = order[np.searchsorted(key, wanted, sorter=order).clip(max=len(key) - 1)]
    return np.where(key[place] == wanted, odds[place], NOT_NEAR)


def _strongest_first(pairs: np.ndarray, strength: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The pairs in the order in which they join parts, if the strongest do first, and how strong each is."""
    order = np.argsort(-strength, kind="stable")
    return pairs[order], strength[order]


def _joined_at(merges: np.ndarray, level: np.ndarray, chosen: np.ndarray, never: float) -> np.ndarray:
    """The level at which each two of some parts come into one group, (k, k) float64, when groups join one by one.

    merges, level : (s, 2) and (s,), a member of each of two groups, in order. chosen : (k,) the parts.
    """
    found = np.full((len(chosen), len(chosen)), never)
    merges, level = _joining(merges, level)
    groups = DisjointSet(range(int(max(merges.max(initial=0), chosen.max(initial=0))) + 1))
    members: dict[int, list[int]] = {part: [place] for place, part in enumerate(chosen.tolist())}
    for (a, b), value in zip(merges.tolist(), level.tolist(), strict=True):
        a, b = groups[a], groups[b]
        of_a, of_b = members.pop(a, []), members.pop(b, [])
        if of_a and of_b:
            found[np.ix_(of_a, of_b)] = found[np.ix_(of_b, of_a)] = value
        groups.merge(a, b)
        members[groups[a]] = of_a + of_b
    return found


def _joining(pairs: np.ndarray, level: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Those of the pairs, (e, 2) and (e,), in order, whose two members no earlier ones brought into one group."""
    if not len(pairs):
        return pairs, level
    count = int(pairs.max()) + 1
    # Of two pairs with the same members the first counts; SciPy would add the numbers of both.
    _, first = np.unique(edge_keys(*pairs.T, count=count), return_index=True)
    ends = pairs[first].T.astype(np.int32)  # SciPy's trees take no others
    tree = minimum_spanning_tree(csr_array((first + 1.0, ends), shape=(count, count)))
    kept = np.sort(tree.data.astype(np.int64)) - 1
    return pairs[kept], level[kept]


def _ways(near: np.ndarray, center: np.ndarray, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Fewest steps, and shortest way from center to center, between some parts along near pairs; (k, k) each."""
    length = distances_between(center, *near.T) + 1e-6
    graph = csr_array((length, near.T), shape=(len(center), len(center)))
    steps = dijkstra(graph, directed=False, indices=chosen, unweighted=True)[:, chosen]
    way = dijkstra(graph, directed=False, indices=chosen)[:, chosen]
    return np.where(np.isinf(steps), STEPS, steps), on_grid(np.where(np.isinf(way), FAR, way))
