# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels on faces: votes, boundaries, connectedness, and boundaries without saw teeth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import both_ways, components, distinct_pairs, last_of_each, sums_by


def majority(owner: np.ndarray, label: np.ndarray, weight: np.ndarray, n_owners: int) -> np.ndarray:
    """Let weighted votes decide which label each owner gets.

    Parameters
    ----------
    owner, label : (r,) int64
        Who the vote is for and which label it names; both 0 or more.
    weight : (r,) float64
        What the vote counts.
    n_owners : int

    Returns
    -------
    winner : (n_owners,) int64
        The label with the most weight, the smallest of equals; -1 for an owner without a vote.
    """
    cells, cell = distinct_pairs(owner, label)
    of, name = cells.T
    last = last_of_each(of, sums_by(cell, weight, len(cells)), -name, count=n_owners)
    return np.where(last >= 0, np.append(name, -1)[last], -1)


def label_boundaries(
    label: np.ndarray, pairs: np.ndarray, length: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find which labels touch, and along what length.

    Parameters
    ----------
    label : (n,) int64
        Of each element; -1 for none.
    pairs : (e, 2) int64
        Elements that touch.
    length : (e,) float64
        Along which each pair touches.

    Returns
    -------
    touching : (c, 2) int64
        Labels, the smaller first, in lexicographic order.
    total : (c,) float64
        Length of their common boundary.
    """
    low, high = np.sort(label[pairs], axis=1).reshape(-1, 2).T
    apart = (low != high) & (low >= 0)
    touching, boundary = distinct_pairs(low[apart], high[apart])
    return touching, sums_by(boundary, length[apart], len(touching))


def longest_neighbor(touching: np.ndarray, length: np.ndarray, count: int) -> np.ndarray:
    """Find the neighbor that each label shares its longest boundary with.

    Parameters
    ----------
    touching : (c, 2) int64
        Labels that touch, each pair once.
    length : (c,) float64
    count : int
        Of labels.

    Returns
    -------
    neighbor : (count,) int64
        The smallest of equals; -1 for a label that touches no other.
    """
    label, other = both_ways(touching).T
    last = last_of_each(label, np.concatenate([length, length]), -other, count=count)
    return np.where(last >= 0, np.append(other, -1)[last], -1)


def spread(label: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Give unlabelled elements the label of an element beside them, outwards from the labelled ones.

    Parameters
    ----------
    label : (n,) int64
        -1 for an element without a label.
    a, b : (e,) int64
        Element a may take the label of element b.

    Returns
    -------
    label : (n,) int64
        Still -1 where no label arrives.
    """
    label = label.copy()
    unlabelled = label[a] < 0  # labelled elements keep what they have
    a, b = a[unlabelled], b[unlabelled]
    while True:
        reached = (label[a] < 0) & (label[b] >= 0)
        if not reached.any():
            return label
        label[a[reached]] = label[b[reached]]


@dataclass(frozen=True, eq=False)
class FaceGraph:
    """Which faces touch, along what length, and how large they are.

    Attributes
    ----------
    n_faces : int
    pairs : (e, 2) int64
        Faces that share an edge.
    length : (e,) float64
        Of that edge.
    area : (n_faces,) float64
    """

    n_faces: int
    pairs: np.ndarray
    length: np.ndarray
    area: np.ndarray

    def boundaries(self, label: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pairs of labels that touch, and along what length; see ``label_boundaries``."""
        return label_boundaries(label, self.pairs, self.length)


def fill_unlabelled(graph: FaceGraph, label: np.ndarray) -> np.ndarray:
    """Give faces labelled -1 the label of a neighbor; faces that touch no labelled face get label 0.

    label : (n_faces,) int64. Returns the same with no -1.
    """
    label = spread(label, *both_ways(graph.pairs).T)
    label[label < 0] = 0
    return label


def connect(graph: FaceGraph, label: np.ndarray) -> np.ndarray:
    """Make every label one connected set of faces.

    Of each label the component of most area keeps it; every other component joins the neighbor
    along its longest boundary.

    Parameters
    ----------
    graph : FaceGraph
    label : (n_faces,) int64

    Returns
    -------
    label : (n_faces,) int64
        Some labels may be gone.
    """
    label = label.copy()
    while True:
        same = label[graph.pairs[:, 0]] == label[graph.pairs[:, 1]]
        count, part = components(graph.n_faces, *graph.pairs[same].T)
        area = np.bincount(part, graph.area, count)
        name = np.empty(count, np.int64)
        name[part] = label
        order = np.lexsort((np.arange(count), -area, name))
        largest = np.append(True, name[order][1:] != name[order][:-1])
        stray = np.ones(count, bool)
        stray[order[largest]] = False
        goal = _goal_of_strays(graph, part, area, stray)
        if not (goal >= 0).any():
            return label
        label = name[np.where(goal >= 0, goal, np.arange(count))][part]


def _goal_of_strays(graph: FaceGraph, part: np.ndarray, area: np.ndarray, stray: np.ndarray) -> np.ndarray:
    """For each stray component, the neighbor it joins; -1 for the others.

    Where two strays would join each other, only the smaller one does.
    """
    goal = np.where(stray, longest_neighbor(*graph.boundaries(part), len(area)), -1)
    mover = np.flatnonzero(goal >= 0)
    mutual = mover[goal[goal[mover]] == mover]
    larger = mutual[(area[mutual] > area[goal[mutual]])
                    | ((area[mutual] == area[goal[mutual]]) & (mutual < goal[mutual]))]
    goal[larger] = -1
    return goal


def straighten(graph: FaceGraph, label: np.ndarray, rounds: int) -> np.ndarray:
    """Take saw teeth off boundaries: faces change to the label that shortens the boundary most.

    Faces that touch never change in the same round, so every round shortens the boundaries.

    Parameters
    ----------
    graph : FaceGraph
    label : (n_faces,) int64
    rounds : int
        At most so many; 0 changes nothing.

    Returns
    -------
    label : (n_faces,) int64
    """
    label = label.copy()
    a, b = both_ways(graph.pairs).T
    length = np.concatenate([graph.length, graph.length])
    for _ in range(rounds):
        edge = label[a] != label[b]  # only faces at a boundary can gain
        owner, other, weight = a[edge], label[b[edge]], length[edge]
        inside = np.bincount(a[~edge], length[~edge], graph.n_faces)
        best = majority(owner, other, weight, graph.n_faces)
        toward = other == best[owner]
        gain = np.bincount(owner[toward], weight[toward], graph.n_faces) - inside
        gain[best < 0] = 0.0
        # Below a billionth of the longest edge a gain is rounding.
        gain[gain <= 1e-9 * length.max(initial=0.0)] = 0.0
        # Of two neighbors that gain, the one that gains more changes; of equals the one with the higher index.
        rank = np.empty(graph.n_faces, np.int64)
        rank[np.lexsort((np.arange(graph.n_faces), gain))] = np.arange(graph.n_faces)
        beaten = np.zeros(graph.n_faces, bool)
        beaten[a[(gain[b] > 0) & (rank[b] > rank[a])]] = True
        flip = (gain > 0) & ~beaten
        if not flip.any():
            break
        label[flip] = best[flip]
    return label
