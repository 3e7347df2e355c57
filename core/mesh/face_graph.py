# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph of faces across edges, and labels on it: filled in, made connected, straightened."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import begins_run, inverse, place_among, sums_by
from ..arrays.int64 import arange
from ..arrays.pairs import both_ways
from .labels import label_boundaries, longest_neighbor, majority, spread
from .triangles import TriMesh, vote_weights

#: What it costs faces to change label: called with faces, their labels and the new labels.
Loss = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class FaceGraph:
    """Which faces touch, along what length, and how large they are.

    Attributes
    ----------
    n_faces : int
    pairs : (e, 2) int64
        Faces that share an edge.
    length : (e,) float64
        Length of the shared edge, in the unit of the vertices.
    area : (n_faces,) float64
        Area of each face, in squared units of the vertices.
    """

    n_faces: int
    pairs: np.ndarray
    length: np.ndarray
    area: np.ndarray

    @classmethod
    def of(cls, mesh: TriMesh) -> FaceGraph:
        """The faces of a mesh that share an edge."""
        return cls(mesh.n_faces, mesh.edges.pairs, mesh.pair_length, mesh.face_area)

    @cached_property
    def weight(self) -> np.ndarray:
        """(n_faces,) float64, weight of the vote of each face: its area; faces without one vote after all others."""
        return vote_weights(self.area)

    def regions(self, label: np.ndarray) -> tuple[int, np.ndarray]:
        """How many connected regions of one label there are, and which each face is in, (n_faces,) int64.

        Regions are numbered in the order of their lowest faces.
        """
        first, second = self.pairs.T
        same = np.flatnonzero(label[first] == label[second])
        return components(self.n_faces, first[same], second[same])

    def with_contacts(self, contacts: np.ndarray) -> FaceGraph:
        """The graph with pairs of faces that touch along no length, (k, 2) int64."""
        length = np.concatenate([self.length, np.zeros(len(contacts))])
        return FaceGraph(self.n_faces, np.concatenate([self.pairs, contacts]), length, self.area)

    @cached_property
    def pieces(self) -> tuple[int, np.ndarray]:
        """Number of connected components of the faces, and that of each face, (n_faces,) int64, from 0."""
        return components(self.n_faces, *self.pairs.T)

    def boundaries(self, label: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Find which labels touch, and along what length.

        label : (n_faces,) int64, -1 for a face without a label. Returns what ``label_boundaries`` returns.
        """
        return label_boundaries(label, self.pairs, self.length)


def fill_unlabeled(graph: FaceGraph, label: np.ndarray) -> np.ndarray:
    """Give faces without a label the label of a neighbor.

    Parameters
    ----------
    graph : FaceGraph
    label : (n_faces,) int64
        -1 for a face without a label.

    Returns
    -------
    label : (n_faces,) int64
        0 or more. A face that no label reaches gets the lowest there is.
    """
    if (label >= 0).all():
        return label
    label = spread(label, *both_ways(graph.pairs).T)
    known = label[label >= 0]
    return np.where(label >= 0, label, known.min() if len(known) else 0)


def connect(graph: FaceGraph, label: np.ndarray) -> np.ndarray:
    """Make every label one connected set of faces.

    Where the faces of a label form several components, the component of most area keeps the label; every other
    component takes the label of the neighbor with which it shares its longest boundary.

    Parameters
    ----------
    graph : FaceGraph
    label : (n_faces,) int64
        0 or more.

    Returns
    -------
    label : (n_faces,) int64
        A label stays in several components only where these touch no other label.
    """
    count, part = graph.regions(label)
    name = np.empty(count, np.int64)
    name[part] = label
    area = np.bincount(part, graph.area, count)
    touching, length = graph.boundaries(part)
    # From here on components move as a whole, and there are few of them.
    while True:
        order = np.lexsort((-area, name))
        largest = begins_run(name[order])
        stray = np.ones(len(name), bool)
        stray[order[largest]] = False
        goal = _goal_of_strays(touching, length, area, stray)
        if not (goal >= 0).any():
            return name[part]
        before = name[np.where(goal >= 0, goal, arange(len(name)))]
        same = before[touching[:, 0]] == before[touching[:, 1]]
        count, union = components(len(name), *touching[same].T)
        name = np.empty(count, np.int64)
        name[union] = before
        part, area = union[part], np.bincount(union, area, count)
        touching, length = label_boundaries(union, touching, length)


def _goal_of_strays(touching: np.ndarray, length: np.ndarray, area: np.ndarray, stray: np.ndarray) -> np.ndarray:
    """Component that each stray component joins, (k,) int64; -1 for a component that stays.

    Where two stray components would join each other, only the smaller one moves. touching, length : what
    ``label_boundaries`` returns of the components.
    """
    goal = np.where(stray, longest_neighbor(touching, length, len(area)), -1)
    mover = np.flatnonzero(goal >= 0)
    mutual = mover[goal[goal[mover]] == mover]
    larger = mutual[(area[mutual] > area[goal[mutual]])
                    | ((area[mutual] == area[goal[mutual]]) & (mutual < goal[mutual]))]
    goal[larger] = -1
    return goal


def straighten(graph: FaceGraph, label: np.ndarray, rounds: int, loss: Loss | None = None) -> np.ndarray:
    """Take saw teeth off boundaries: faces change to the label that shortens the boundaries most.

    Two faces that touch never change in one round, so that every round shortens the boundaries.

    Parameters
    ----------
    graph : FaceGraph
    label : (n_faces,) int64
        0 or more.
    rounds : int
        Upper bound of the number of rounds; 0 changes nothing.
    loss : callable, optional
        Called with some faces, their labels and the labels that they would change to, (k,) int64 each; returns what
        this costs, (k,) float64, in the unit of ``graph.length``. A face changes if the boundaries shorten by more.

    Returns
    -------
    label : (n_faces,) int64
        Labels may no longer be connected.
    """
    first, second = graph.pairs.T
    zone = _around_boundaries(graph, label, rounds)
    faces = np.flatnonzero(zone)
    place = place_among(faces, graph.n_faces)
    inside = np.flatnonzero(zone[first] & zone[second])
    a, b = both_ways(place[graph.pairs[inside]]).T
    length = np.tile(graph.length[inside], 2)
    # A gain below 1e-9 of the longest edge is a rounding error.
    least = 1e-9 * graph.length.max(initial=0.0)
    whole, label = label.copy(), label[faces]
    for _ in range(rounds):
        gain, best = _gains(a, b, length, label)
        if loss is not None:
            willing = np.flatnonzero(gain > 0)
            gain[willing] -= loss(faces[willing], label[willing], best[willing])
        gain[gain <= least] = 0.0
        flip = gain > 0
        # Of two neighbors that both gain, the one that gains more changes; of equal ones that of the higher index.
        both = np.flatnonzero(flip[a] & flip[b])
        rank = inverse(np.argsort(gain, kind="stable"))
        flip[a[both[rank[b[both]] > rank[a[both]]]]] = False
        if not flip.any():
            break
        label[flip] = best[flip]
    whole[faces] = label
    return whole


def _around_boundaries(graph: FaceGraph, label: np.ndarray, rounds: int) -> np.ndarray:
    """Faces, (n_faces,) bool, that so many rounds of changes at the boundaries can reach, and their neighbors."""
    first, second = graph.pairs.T
    zone = np.zeros(graph.n_faces, bool)
    cut = np.flatnonzero(label[first] != label[second])
    for _ in range(rounds + 1):
        zone[first[cut]] = zone[second[cut]] = True
        cut = np.flatnonzero(zone[first] != zone[second])
    return zone


def _gains(a: np.ndarray, b: np.ndarray, length: np.ndarray, label: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """By how much the boundaries become shorter if a face changes its label, (n,) float64, and to which, (n,) int64.

    a, b, length : (e,), each pair of faces that touch, both ways. 0 and -1 for a face at no boundary.
    """
    differ = label[a] != label[b]
    edge = np.flatnonzero(differ)
    owner, other, weight = a[edge], label[b[edge]], length[edge]
    at_boundary = np.zeros(len(label), bool)
    at_boundary[owner] = True
    same = np.flatnonzero(at_boundary[a] & ~differ)
    inside = np.bincount(a[same], length[same], len(label))
    best = majority(owner, other, weight, len(label))
    toward = other == best[owner]
    gain = sums_by(owner[toward], weight[toward], len(label)) - inside
    gain[best < 0] = 0.0
    return gain, best
