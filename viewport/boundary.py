# SPDX-License-Identifier: GPL-3.0-or-later
"""The boundary of a part, which can be slid over the surface."""

from __future__ import annotations

import bpy
import numpy as np

from ..scene import bridge, edits, mesh_arrays
from ..scene.store import Stored


class Boundary:
    """The boundary of one part, ready to be slid.

    Attributes
    ----------
    numbers : (p,) int64
        The part of each face, before.
    distance : (p,) float64
        From the boundary, negative inside the part; nan for faces that must stay.
    reach : (2,) float64
        How far it can be slid inwards and outwards, as distances.
    """

    def __init__(self, obj: bpy.types.Object, stored: Stored, number: int) -> None:
        from ..core.result.editing import boundary_distance

        self.number = number
        self.numbers = stored.face_numbers
        pairs, _ = mesh_arrays.corner_table(obj.data).face_pairs()
        center = bridge.face_centers(obj)
        length = np.linalg.norm(center[pairs[:, 0]] - center[pairs[:, 1]], axis=1)
        locked = edits.locked_others(obj.data, number)
        inside = self.numbers == number
        distance, across = boundary_distance(inside, pairs, length)
        # What a face inside would go to; its own part for one that has nowhere to go.
        self.receiver = np.where(inside & (across >= 0), self.numbers[across], self.numbers)
        self.distance = np.where(np.isin(self.numbers, locked) | np.isin(self.receiver, locked), np.nan, distance)
        known = self.distance[np.isfinite(self.distance)]
        self.reach = np.array([known.min(initial=0.0), known.max(initial=0.0)])

    def slid(self, offset: float) -> np.ndarray:
        """The part of each face with the boundary moved outwards by a distance, (p,) int64."""
        with np.errstate(invalid="ignore"):  # nan: the face stays
            taken = (self.distance > 0) & (self.distance <= offset)
            given = (self.distance < 0) & (self.distance >= offset)
        return np.where(taken, self.number, np.where(given, self.receiver, self.numbers))
