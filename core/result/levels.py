# SPDX-License-Identifier: GPL-3.0-or-later
"""The levels of detail: at which detail there are so many parts, and which numbers of parts stand out."""

from __future__ import annotations

import numpy as np

from ..arrays.int64 import arange

# A number of parts stands out among those from a RATIO-th of it up to RATIO times it.
RATIO = 1.35


def detail_between(salience: np.ndarray, n_done: int) -> float:
    """Find the detail at which so many splits are done.

    Parameters
    ----------
    salience : (s,) float64
        Salience of the cut that each split makes, 0..1, never rising.
    n_done : int
        0..s.

    Returns
    -------
    detail : float
        Halfway between the details at which the last of these splits and the next one are done, 0..1.
    """
    around = np.concatenate([[1.0], salience, [0.0]])[n_done : n_done + 2]
    return float(1.0 - around.mean())


def strong_levels(salience: np.ndarray, n_fewest: int) -> np.ndarray:
    """Find the numbers of parts at which the salience of the cuts falls most.

    Parameters
    ----------
    salience : (s,) float64
        Salience of the cut that each split makes, 0..1, never rising.
    n_fewest : int
        Number of parts before the first split, 1 or more.

    Returns
    -------
    levels : (l,) int64
        Numbers of parts, rising; the fewest and the most possible are the first and the last.

    Notes
    -----
    The fall at a number of parts is the salience of the last cut that is made minus that of the first one that is not.
    A number stands out where no other number less than RATIO times larger or smaller has a larger fall; of equal falls
    the smaller number counts, and where nothing falls, no number stands out.
    """
    count = n_fewest + arange(len(salience) + 1)
    fall = np.concatenate([[1.0], salience]) - np.concatenate([salience, [0.0]])
    fall[0] = 0.0  # the first cut is always there to be made
    first = np.searchsorted(count, count / RATIO, side="right")
    last = np.searchsorted(count, count * RATIO, side="left")
    best = np.array([start + int(fall[start:end].argmax()) for start, end in zip(first, last, strict=True)])
    strong = (best == arange(len(count))) & (fall > 0.0)
    strong[[0, -1]] = True
    return count[strong]
