# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels of faces, or of anything else that has neighbors: votes, boundaries, and how far two labelings disagree."""

from __future__ import annotations

import numpy as np

from ..arrays.indexing import last_of_each, sums_by
from ..arrays.int64 import full
from ..arrays.pairs import both_ways, distinct_pairs


def majority(owner: np.ndarray, label: np.ndarray, weight: np.ndarray, n_owners: int) -> np.ndarray:
    """Let weighted votes decide which label each owner gets.

    Parameters
    ----------
    owner : (r,) int64
        Owner that each vote is for, 0..n_owners-1.
    label : (r,) int64
        Label that each vote names, 0 or more.
    weight : (r,) float64
        Weight of each vote.
    n_owners : int

    Returns
    -------
    winner : (n_owners,) int64
        Label with the largest sum of weights, of equal ones the smallest label; -1 for an owner without a vote.
    """
    winner = full(n_owners, -1)
    winner[owner] = label
    # Most owners' votes all name one label: only the others' are counted.
    divided = np.zeros(n_owners, bool)
    divided[owner[label != winner[owner]]] = True
    counted = np.flatnonzero(divided[owner])
    cells, cell = distinct_pairs(owner[counted], label[counted])
    of, name = cells.T
    last = last_of_each(of, sums_by(cell, weight[counted], len(cells)), -name, count=n_owners)
    return np.where(divided, np.append(name, -1)[last], winner)


def borders(label: np.ndarray, pairs: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find which labels touch, and where.

    Parameters
    ----------
    label : (n,) int64
        Label of each face (or of anything else that has neighbors); -1 for none.
    pairs : (e, 2) int64
        Faces that touch.

    Returns
    -------
    between : (k,) int64
        Rows of ``pairs`` whose faces have different labels, rising.
    touching : (c, 2) int64
        Pairs of labels that touch, the smaller label first, in lexicographic order.
    border : (k,) int64
        Row of ``touching`` that each of ``between`` belongs to.
    """
    first, second = label[pairs.T]
    between = np.flatnonzero((first != second) & (first >= 0) & (second >= 0))
    first, second = first[between], second[between]
    touching, border = distinct_pairs(np.minimum(first, second), np.maximum(first, second))
    return between, touching, border


def label_boundaries(
    label: np.ndarray, pairs: np.ndarray, length: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find which labels touch, and along what length.

    Parameters
    ----------
    label, pairs
        As ``borders`` takes them.
    length : (e,) float64
        Length of the boundary between the two faces of each pair.

    Returns
    -------
    touching : (c, 2) int64
        As ``borders`` returns it.
    total : (c,) float64
        Length of the boundary between the two labels, in the unit of ``length``.
    """
    between, touching, border = borders(label, pairs)
    return touching, sums_by(border, length[between], len(touching))


def longest_neighbor(touching: np.ndarray, length: np.ndarray, count: int) -> np.ndarray:
    """Find the neighbor that each label shares its longest boundary with.

    Parameters
    ----------
    touching : (c, 2) int64
        Labels that touch, each pair once.
    length : (c,) float64
        Length of the boundary between the two labels of each pair.
    count : int
        Number of labels.

    Returns
    -------
    neighbor : (count,) int64
        That neighbor, of equal ones the smallest label; -1 for a label that touches no other.
    """
    label, other = both_ways(touching).T
    last = last_of_each(label, np.concatenate([length, length]), -other, count=count)
    return np.where(last >= 0, np.append(other, -1)[last], -1)


def spread(label: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Let labels spread in rounds from labeled faces outwards to unlabeled ones.

    Parameters
    ----------
    label : (n,) int64
        Label of each face (or of anything else that has neighbors); -1 for none.
    a, b : (e,) int64
        Face a[i] may take the label of face b[i].

    Returns
    -------
    label : (n,) int64
        -1 remains where no label arrives.
    """
    label = label.copy()
    unlabeled = label[a] < 0  # labeled faces keep their labels
    a, b = a[unlabeled], b[unlabeled]
    while True:
        reached = (label[a] < 0) & (label[b] >= 0)
        if not reached.any():
            return label
        label[a[reached]] = label[b[reached]]


def follow(label: np.ndarray, part: np.ndarray, moved: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """Let labels follow where faces have moved from part to part, so that every label stays within one part.

    Parameters
    ----------
    label : (n,) int64
        Label of each face (or of anything else that has neighbors) before.
    part, moved : (n,) int64
        Part that it was in, and is in now.
    pairs : (e, 2) int64
        Faces that touch.

    Returns
    -------
    label : (n,) int64
        What moved takes that of a neighbor in its new part, from the cut outwards; what none reaches keeps its own.
    """
    a, b = both_ways(pairs).T
    together = moved[a] == moved[b]
    found = spread(np.where(moved == part, label, -1), a[together], b[together])
    return np.where(found < 0, label, found)


def disagreement(first: np.ndarray, second: np.ndarray, weight: np.ndarray) -> float:
    """Compute the share of pairs of points that one labeling joins and the other separates: 1 minus the Rand index.

    Parameters
    ----------
    first, second : (n,) int64
        Label of each face in the two labelings, 0 or more, and few: a table has all pairs of them.
    weight : (n,) float64
        How much of the points is on each face, such as its area.

    Returns
    -------
    share : float
        0..1.
    """
    width = int(second.max()) + 1
    together = np.bincount(first * width + second, weight, (int(first.max()) + 1) * width).reshape(-1, width)
    apart = sum((together.sum(axis=axis) ** 2).sum() for axis in (0, 1)) - 2 * (together**2).sum()
    return float(apart / weight.sum() ** 2)
