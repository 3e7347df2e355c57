# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates of the faces there are, which merge only where they touch."""

from __future__ import annotations

import numpy as np

from ..surface.arrays import renumbered
from ..surface.labels import FaceGraph
from .hierarchy import Dendrogram, Hierarchy


def settle(graph: FaceGraph, label: np.ndarray, hierarchy: Hierarchy) -> tuple[np.ndarray, Hierarchy]:
    """Drop candidates that no face of the caller has, and let candidates merge only where they touch.

    Parameters
    ----------
    graph : FaceGraph
        Which of the caller's faces touch.
    label : (n_faces,) int64
        Candidate of each face; every candidate is connected.
    hierarchy : Hierarchy
        Merges of all candidates, also of those that no face has.

    Returns
    -------
    label : (n_faces,) int64
        Candidate of each face, 0..c-1, all in use.
    hierarchy : Hierarchy
        Merges of the c candidates, in the given order. A merge whose two sides do not touch on the caller's faces is
        put off until they do.
    """
    present, label = renumbered(label)
    touching, _ = graph.boundaries(label)
    merge = hierarchy.merge_of(*present[touching].T)
    order = np.argsort(merge, kind="stable")
    order = order[merge[order] < len(hierarchy.merges)]
    rows = order[Dendrogram.of(len(present), touching[order]).rows]
    return label, Hierarchy.of(len(present), touching[rows], hierarchy.salience[merge[rows]])
