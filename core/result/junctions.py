# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundaries between labels at edges where more than two faces meet.

A face graph chains the faces that meet at an edge, which is enough to tell what hangs together. Of three labels at one
edge, though, each touches both others, and the chain lacks one of the three pairs; two labels that take turns around an
edge follow each other in the chain several times. A boundary has each of its edges once.

Nor can boundaries simply be added up when labels become one, as candidates of one part do: if one of three labels at an
edge touches two that are one now, both boundaries had that edge. Sets of three labels and more that meet at edges are
therefore kept as *junctions*.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.indexing import expanded, stable_order, sums_by
from ..arrays.int64 import arange
from ..arrays.pairs import distinct_pairs
from ..mesh.face_graph import FaceGraph


@dataclass(frozen=True, eq=False)
class FaceSides:
    """The sides of faces, and the edges along which they lie.

    Attributes
    ----------
    face, edge : (s,) int64
        Face and edge of each side.
    edge_length : (e,) float64
    """

    face: np.ndarray
    edge: np.ndarray
    edge_length: np.ndarray

    @cached_property
    def fans(self) -> np.ndarray:
        """(k,) int64, the sides at edges of more than two faces: edge by edge, in their own order."""
        meeting = np.bincount(self.edge)
        if meeting.max(initial=0) <= 2:
            return np.empty(0, np.int64)
        several = np.flatnonzero(meeting[self.edge] > 2)
        return several[stable_order(self.edge[several])]

    def around_fans(self, label: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Edge and label of each of the ``fans``, (k,) int64 twice. label : (n_faces,) int64."""
        return self.edge[self.fans], label[self.face[self.fans]]


def boundaries(graph: FaceGraph, label: np.ndarray, sides: FaceSides) -> tuple[np.ndarray, np.ndarray]:
    """Find which labels touch, and along what length, also where more than two faces meet.

    Parameters
    ----------
    graph : FaceGraph
        Which faces touch; it chains those that meet at an edge in the order of their sides.
    label : (n_faces,) int64
        0 or more.
    sides : FaceSides

    Returns
    -------
    touching : (c, 2) int64
        Pairs of labels that touch, the smaller label first, in lexicographic order.
    total : (c,) float64
        Length of the boundary between the two labels, each edge once, in the unit of ``sides.edge_length``.
    """
    touching, total = graph.boundaries(label)
    among, where, times = _miscounted(*sides.around_fans(label))
    if not len(among):
        return touching, total
    pairs, pair = distinct_pairs(*np.concatenate([touching, among]).T)
    return pairs, sums_by(pair, np.concatenate([total, times * sides.edge_length[where]]), len(pairs))


def junctions(label: np.ndarray, sides: FaceSides) -> tuple[np.ndarray, np.ndarray]:
    """Find the sets of three labels and more that meet at edges.

    Parameters
    ----------
    label, sides
        As of ``boundaries``.

    Returns
    -------
    members : (m, 2) int64
        Junctions, 0..j-1, and their labels, in lexicographic order.
    length : (j,) float64
        Of all edges at which just these labels meet.
    """
    rows, _ = distinct_pairs(*sides.around_fans(label))  # an edge and a label there
    size = np.bincount(rows[:, 0])[rows[:, 0]]
    members, length, count = [np.empty((0, 2), np.int64)], [np.empty(0)], 0
    for n in np.unique(size[size > 2]).tolist():
        own = rows[size == n].reshape(-1, n, 2)
        sets, which = np.unique(own[:, :, 1], axis=0, return_inverse=True)
        members.append(np.stack([np.repeat(count + arange(len(sets)), n), sets.ravel()], axis=1))
        length.append(sums_by(which.reshape(-1), sides.edge_length[own[:, 0, 0]], len(sets)))
        count += len(sets)
    return np.concatenate(members), np.concatenate(length)


def counted_again(members: np.ndarray, length: np.ndarray, group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find by how much the boundaries of labels are longer, together, than that of two groups of them.

    Parameters
    ----------
    members, length
        As ``junctions`` returns them.
    group : (n_labels,) int64
        Group of each label, 0 or more.

    Returns
    -------
    pairs : (k, 2) int64
        Pairs of groups, the smaller first; a pair may come several times.
    more : (k,) float64
        Length that is to be taken off their boundary.
    """
    rows, row = distinct_pairs(members[:, 0], group[members[:, 1]])
    n_labels = np.bincount(row)
    first, second = _pairs_within(rows[:, 0])
    times = n_labels[first] * n_labels[second] - 1
    return np.stack([rows[first, 1], rows[second, 1]], axis=1), times * length[rows[first, 0]]


def _miscounted(at: np.ndarray, name: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs of labels that meet at an edge of several faces, where the chain of these faces has the pair not just once.

    at, name : as ``FaceSides.around_fans`` returns them. Returns the pairs, (k, 2), smaller label first; the edge of
    each, (k,); and how often that edge is to be added to their boundary, (k,): 1, or less than 0.
    """
    follows = at[1:] == at[:-1]
    low, high = np.sort(np.stack([name[:-1], name[1:]], axis=1)[follows], axis=1).T
    width = int(name.max(initial=0)) + 1
    chained = (at[:-1][follows] * width + low) * width + high
    rows, _ = distinct_pairs(at, name)
    first, second = _pairs_within(rows[:, 0])
    keys = (rows[first, 0] * width + rows[first, 1]) * width + rows[second, 1]
    chained.sort()
    times = 1 - (np.searchsorted(chained, keys, side="right") - np.searchsorted(chained, keys))
    wrong = times != 0
    first, second = first[wrong], second[wrong]
    return np.stack([rows[first, 1], rows[second, 1]], axis=1), rows[first, 0], times[wrong]


def _pairs_within(group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places of all pairs of members of one group, (k,) each, the first before the second. group : (n,), rising."""
    place = arange(len(group))
    end = np.searchsorted(group, group, side="right")
    return expanded(place + 1, end - place - 1)
