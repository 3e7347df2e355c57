# SPDX-License-Identifier: GPL-3.0-or-later
"""How groups of points have moved: a rotation and a shift for each, as near to the points as these can be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.indexing import sums_by

# Points on a line leave the rotation around it open: so little of their spread as if in all directions keeps it small.
_ROUND = 1e-9


@dataclass(frozen=True, eq=False)
class Motions:
    """Rigid motions of c groups.

    Attributes
    ----------
    rotation : (c, 3, 3) float64
    start, end : (c, 3) float64
        The middle of each group before and after; 0 of a group without points, which does not move.
    """

    rotation: np.ndarray
    start: np.ndarray
    end: np.ndarray

    def moved(self, points: np.ndarray, label: np.ndarray) -> np.ndarray:
        """Other points, (m, 3) float64, each moved with its group; label : (m,) int64."""
        return np.einsum("mij,mj->mi", self.rotation[label], points - self.start[label]) + self.end[label]


def rigid_motions(before: np.ndarray, after: np.ndarray, weight: np.ndarray, label: np.ndarray,
                  n_labels: int) -> Motions:
    """Fit a rigid motion to each group of points, by least squares.

    Parameters
    ----------
    before, after : (m, 3) float64
    weight : (m,) float64
        Of each point; 0 or more.
    label : (m,) int64
        The group of each point, from 0 to ``n_labels`` - 1.
    n_labels : int

    Returns
    -------
    motions : Motions

    Notes
    -----
    [Kabsch1976]: the rotation of the singular vectors of the covariance, O(m).
    """
    weight = np.where(weight > 0, weight, np.finfo(np.float64).tiny)  # they count where there are no others
    total = np.bincount(label, weight, n_labels)
    share = weight / total[label]
    start, end = (sums_by(label, share[:, None] * points, n_labels) for points in (before, after))
    one, two = before - start[label], after - end[label]
    spread = sums_by(label, (share[:, None, None] * one[:, :, None] * two[:, None, :]).reshape(-1, 9), n_labels)
    spread = spread.reshape(-1, 3, 3)
    size = np.bincount(label, share * np.maximum((one**2).sum(axis=1), (two**2).sum(axis=1)), n_labels)
    spread += _ROUND * size[:, None, None] * np.eye(3)
    left, _, right = np.linalg.svd(spread)
    right[:, 2] *= np.where(np.linalg.det(left) * np.linalg.det(right) < 0, -1.0, 1.0)[:, None]  # no mirror images
    return Motions(np.swapaxes(right, 1, 2) @ np.swapaxes(left, 1, 2), start, end)
