# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundaries between labels at edges where more than two faces meet.

A face graph chains the faces that meet at an edge, which is enough to tell what hangs together. Of three labels at one
edge, though, each touches both others, and the chain lacks one of the three pairs.
"""

from __future__ import annotations

import numpy as np

from ..surface.arrays import distinct_pairs, expanded, sums_by
from ..surface.labels import FaceGraph


def boundaries(
    graph: FaceGraph, label: np.ndarray, face: np.ndarray, edge: np.ndarray, edge_length: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find which labels touch, and along what length, also where more than two faces meet.

    Parameters
    ----------
    graph : FaceGraph
        Which faces touch; it chains those that meet at an edge in the order of their sides.
    label : (n_faces,) int64
        0 or more.
    face, edge : (s,) int64
        Face and edge of each side of a face.
    edge_length : (e,) float64

    Returns
    -------
    touching : (c, 2) int64
        Pairs of labels that touch, the smaller label first, in lexicographic order.
    total : (c,) float64
        Length of the boundary between the two labels, in the unit of ``edge_length``.
    """
    touching, total = graph.boundaries(label)
    among, where = _unchained(label, face, edge)
    if not len(among):
        return touching, total
    every = np.concatenate([touching, among])
    pairs, pair = distinct_pairs(*every.T)
    return pairs, sums_by(pair, np.concatenate([total, edge_length[where]]), len(pairs))


def _unchained(label: np.ndarray, face: np.ndarray, edge: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of labels at one edge, (k, 2), smaller first, whose faces do not follow each other there; and the edges."""
    meeting = np.bincount(edge)
    if meeting.max(initial=0) <= 2:
        return np.empty((0, 2), np.int64), np.empty(0, np.int64)
    several = np.flatnonzero(meeting[edge] > 2)
    several = several[np.argsort(edge[several], kind="stable")]
    at, name = edge[several], label[face[several]]
    follows = at[1:] == at[:-1]
    low, high = np.sort(np.stack([name[:-1], name[1:]], axis=1)[follows], axis=1).T
    width = int(name.max(initial=0)) + 1
    chained = (at[:-1][follows] * width + low) * width + high
    rows, _ = distinct_pairs(at, name)
    end = np.searchsorted(rows[:, 0], rows[:, 0], side="right")
    place = np.arange(len(rows))
    first, second = expanded(place + 1, end - place - 1)
    keys = (rows[first, 0] * width + rows[first, 1]) * width + rows[second, 1]
    new = ~np.isin(keys, chained)
    first, second = first[new], second[new]
    return np.stack([rows[first, 1], rows[second, 1]], axis=1), rows[first, 0]
