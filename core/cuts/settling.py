# SPDX-License-Identifier: GPL-3.0-or-later
"""Only candidates that have faces stay, and they merge only where they touch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays.indexing import renumbered
from .face_candidates import FaceCandidates
from .hierarchy import Dendrogram, Hierarchy


def settle(candidates: FaceCandidates) -> FaceCandidates:
    """Drop candidates that no face of the caller has, and let candidates merge only where they touch.

    Parameters
    ----------
    candidates : FaceCandidates
        Of the caller's faces; every candidate is connected, and some may have no face.

    Returns
    -------
    candidates : FaceCandidates
        All candidates are in use. They merge in the given order, but a merge whose two sides do not touch on the
        caller's faces, along an edge or by contact, is put off until they do.
    """
    hierarchy = candidates.hierarchy
    present, label = renumbered(candidates.label)
    touching, _ = candidates.touching_graph().boundaries(label)
    merge = hierarchy.merge_of(*present[touching].T)
    order = np.argsort(merge, kind="stable")
    order = order[merge[order] < len(hierarchy.merges)]
    rows = order[Dendrogram.of(len(present), touching[order]).rows]
    settled = Hierarchy.of(len(present), touching[rows], hierarchy.salience[merge[rows]])
    return replace(candidates, label=label, hierarchy=settled)
