# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface across closed curves, which a cap is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ....core.uses.caps.surfaces import spread

if TYPE_CHECKING:
    from scipy.sparse import csr_array


@dataclass(frozen=True, eq=False)
class Disc:
    """A surface across one or more closed curves of k points together.

    Attributes
    ----------
    triangles : (t, 3) int64
        0..k-1 are the points of the curves, in whose direction the triangles go round; k, k+1, ... those inside.
    places : (m, 3) float64
        Of the points inside.
    weights : csr_array, (k + m, k + m)
        What each point adds to a point inside that lies between them, see core.uses.caps.surfaces.
    following : (k,) int64
        The point after each on its curve.
    """

    triangles: np.ndarray
    places: np.ndarray
    weights: csr_array
    following: np.ndarray

    def spread(self, values: np.ndarray) -> np.ndarray:
        """What the points inside have if those of the curves have some values, (k, c): (m, c) float64."""
        return spread(self.weights, values)
