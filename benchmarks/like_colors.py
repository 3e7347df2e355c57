# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors for parts to compare: what is the same part in two labelings looks the same."""

from __future__ import annotations

import numpy as np

from core.arrays.indexing import sums_by
from core.uses.colors import PALETTE


def like_colors(labels: np.ndarray, reference: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Colors of faces, (m, 3): a part has the color of the reference's part that it shares most with, if it is free.

    labels, reference : (m,) int64, from 0. area : (m,) float64.
    """
    count, other = int(labels.max()) + 1, int(reference.max()) + 1
    rank = np.argsort(np.argsort(-np.bincount(reference, area), kind="stable"), kind="stable")
    shared = sums_by(labels, np.eye(other)[reference] * area[:, None], count)
    color, used = np.full(count, -1), set()
    for cell in np.argsort(-shared, axis=None, kind="stable").tolist():
        part, its = divmod(cell, other)
        if color[part] < 0 and rank[its] not in used and shared[part, its] > 0:
            color[part] = rank[its]
            used.add(int(rank[its]))
    free = iter(k for k in range(count + other) if k not in used)
    for part in np.flatnonzero(color < 0).tolist():
        color[part] = next(free)
    faded = np.where(color < len(PALETTE), 1.0, 0.6)[:, None]  # palettes are shorter than some lists of parts
    return (1 - faded * (1 - PALETTE[color % len(PALETTE)]))[labels]
