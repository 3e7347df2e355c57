# SPDX-License-Identifier: GPL-3.0-or-later
"""From the working copy back to the caller's faces and vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..cuts.hierarchy import Hierarchy
from .mesh import components


def majority(owner: np.ndarray, label: np.ndarray, weight: np.ndarray, n_owners: int) -> np.ndarray:
    """The label with the most weight in each owner; the smallest label of equals.

    Parameters
    ----------
    owner, label : (r,) int64
        Labels 0 or more.
    weight : (r,) float64
    n_owners : int

    Returns
    -------
    winner : (n_owners,) int64
        -1 for owners without a row.
    """
    n_labels = int(label.max(initial=0)) + 1
    cell, where = np.unique(owner * np.int64(n_labels) + label, return_inverse=True)
    total = np.bincount(where.reshape(-1), weight, len(cell))
    of, name = np.divmod(cell, n_labels)
    order = np.lexsort((-name, total, of))
    winner = np.full(n_owners, -1)
    winner[of[order]] = name[order]  # the last one written has the most weight
    return winner


@dataclass(frozen=True, eq=False)
class FaceGraph:
    """Which faces of the caller touch, and along what length.

    Attributes
    ----------
    n_faces : int
    pairs : (e, 2) int64
    length : (e,) float64
    area : (n_faces,) float64
    """

    n_faces: int
    pairs: np.ndarray
    length: np.ndarray
    area: np.ndarray

    def boundaries(self, label: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pairs of labels that touch, and along what length; see ``label_boundaries``."""
        return label_boundaries(label, self.pairs, self.length)


def label_boundaries(
    label: np.ndarray, pairs: np.ndarray, length: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Which labels touch, and along what length.

    Parameters
    ----------
    label : (n,) int64
        -1 for none.
    pairs : (e, 2) int64
        Elements that touch.
    length : (e,) float64

    Returns
    -------
    touching : (c, 2) int64
        The smaller label first, in lexicographic order.
    total : (c,) float64
    """
    low, high = np.sort(label[pairs], axis=1).reshape(-1, 2).T
    apart = (low != high) & (low >= 0)
    n = int(label.max(initial=0)) + 1
    cell, where = np.unique(low[apart] * np.int64(n) + high[apart], return_inverse=True)
    total = np.bincount(where.reshape(-1), length[apart], len(cell))
    return np.stack(np.divmod(cell, n), axis=1), total


def spread(label: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Give elements labelled -1 the label of an element beside them, outwards from the labelled.

    Parameters
    ----------
    label : (n,) int64
    a, b : (e,) int64
        Element a may take the label of element b.

    Returns
    -------
    label : (n,) int64
        Still -1 where no label comes.
    """
    label = label.copy()
    beside = label[a] < 0  # the others keep what they have
    a, b = a[beside], b[beside]
    while True:
        reach = (label[a] < 0) & (label[b] >= 0)
        if not reach.any():
            return label
        label[a[reach]] = label[b[reach]]


def fill_unlabelled(graph: FaceGraph, label: np.ndarray) -> np.ndarray:
    """Give faces labelled -1 the label of a neighbour, outwards from the labelled ones.

    What touches no labelled face gets label 0.
    """
    label = spread(label, *np.concatenate([graph.pairs, graph.pairs[:, ::-1]]).T)
    label[label < 0] = 0
    return label


def connect(graph: FaceGraph, label: np.ndarray, min_faces: int = 1) -> np.ndarray:
    """Make every label one connected set of faces.

    Of each label the component of most area keeps it; the others, and components of fewer than
    ``min_faces`` faces, go to the neighbour along the longest boundary.

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
        size = np.bincount(part, minlength=count)
        name = np.empty(count, np.int64)
        name[part] = label
        order = np.lexsort((np.arange(count), -area, name))
        largest = np.append(True, name[order][1:] != name[order][:-1])
        stray = np.ones(count, bool)
        stray[order[largest]] = False
        stray |= size < min_faces
        goal = _best_neighbour(graph, part, area, stray)
        if not (goal >= 0).any():
            return label
        label = name[np.where(goal >= 0, goal, np.arange(count))][part]


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
    a, b = np.concatenate([graph.pairs, graph.pairs[:, ::-1]]).T
    length = np.concatenate([graph.length, graph.length])
    for _ in range(rounds):
        edge = label[a] != label[b]  # only faces at a boundary can gain
        owner, other, weight = a[edge], label[b[edge]], length[edge]
        inside = np.bincount(a[~edge], length[~edge], graph.n_faces)
        best = majority(owner, other, weight, graph.n_faces)
        toward = other == best[owner]
        gain = np.bincount(owner[toward], weight[toward], graph.n_faces) - inside
        gain[best < 0] = 0.0
        # A hair above rounding; of two neighbours that gain, the one that gains more goes.
        gain[gain <= 1e-9 * length.max(initial=0.0)] = 0.0
        rank = np.empty(graph.n_faces, np.int64)
        rank[np.lexsort((np.arange(graph.n_faces), gain))] = np.arange(graph.n_faces)
        beaten = np.zeros(graph.n_faces, bool)
        beaten[a[(gain[b] > 0) & (rank[b] > rank[a])]] = True
        flip = (gain > 0) & ~beaten
        if not flip.any():
            break
        label[flip] = best[flip]
    return label


def _best_neighbour(graph, part, area, stray) -> np.ndarray:
    """For each stray component, the neighbour it joins; -1 for the others.

    Where two stray ones are each other's best, only the smaller moves.
    """
    boundary, length = graph.boundaries(part)
    both = np.concatenate([boundary, boundary[:, ::-1]])
    length = np.concatenate([length, length])
    keep = stray[both[:, 0]]
    both, length = both[keep], length[keep]
    order = np.lexsort((-both[:, 1], length, both[:, 0]))
    goal = np.full(len(area), -1)
    goal[both[order, 0]] = both[order, 1]
    mover = np.flatnonzero(goal >= 0)
    mutual = mover[goal[goal[mover]] == mover]
    larger = mutual[(area[mutual] > area[goal[mutual]])
                    | ((area[mutual] == area[goal[mutual]]) & (mutual < goal[mutual]))]
    goal[larger] = -1
    return goal


def settle(graph: FaceGraph, label: np.ndarray, hierarchy: Hierarchy) -> tuple[np.ndarray, Hierarchy]:
    """Candidates that exist on the caller's faces, and a hierarchy that only merges neighbours.

    Parameters
    ----------
    graph : FaceGraph
    label : (n_faces,) int64
        Candidate of each face; each candidate connected.
    hierarchy : Hierarchy
        Of all candidates, present on faces or not.

    Returns
    -------
    label : (n_faces,) int64
        0..c-1, all present.
    hierarchy : Hierarchy
        Of the c candidates. Merges follow the given order; one whose two sides do not touch on
        the caller's faces waits until they do.
    """
    present, label = np.unique(label, return_inverse=True)
    label = label.reshape(-1)
    touching, _ = graph.boundaries(label)
    group = np.arange(hierarchy.n_candidates)  # merged by the hierarchy as given
    joined = np.arange(len(present))  # merged on the faces
    merges, salience = [], []
    for (a, b), strength in zip(hierarchy.merges, hierarchy.salience, strict=True):
        group[group == group[b]] = group[a]
        together = group[present]
        waiting = (together[touching[:, 0]] == together[touching[:, 1]]) & (
            joined[touching[:, 0]] != joined[touching[:, 1]])
        while waiting.any():
            first, second = touching[waiting.argmax()]
            merges.append((first, second))
            salience.append(strength)
            joined[joined == joined[second]] = joined[first]
            waiting &= joined[touching[:, 0]] != joined[touching[:, 1]]
    return label, Hierarchy.of(len(present), merges, salience)
