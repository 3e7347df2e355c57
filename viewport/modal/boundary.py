# SPDX-License-Identifier: GPL-3.0-or-later
"""The boundary of a part, which can be moved over the surface: by a distance, or ring by ring."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.vectors import box_diagonal
from ...core.sentence import Count
from ...scene import bridge
from ...scene.changes import face_edits, pins
from ...scene.errors import SceneError
from ...scene.reading import mesh_arrays
from ...scene.result import part_names
from ...scene.store import Stored

RING = 0.01  # width of a ring, as a share of the object's size
FACES = 1.5  # and at least so many times as far as from face to face: else a ring would have gaps
AHEAD = 3  # so many rings are shown beyond the boundary


class Boundary:
    """The boundary of one part, ready to be moved.

    It moves into the parts that it touches, into each only from where it touches that part, and no further: growing
    never reaches through a part into the one behind it.

    Attributes
    ----------
    number : int
        The part.
    neighbors : list of int
        The parts beyond the boundary, in order.
    numbers : (p,) int64
        The part of each face, before.
    distance : (p,) float64
        From the boundary, negative inside the part; nan for faces that must stay.
    reach : (2,) float64
        How far it can be moved inwards and outwards, as distances.
    width : float
        Of a ring.
    """

    def __init__(self, obj: bpy.types.Object, stored: Stored, number: int, neighbor: int = 0) -> None:
        """Of the part ``number``: all of it, or only where it meets the part ``neighbor``."""
        from ...core.result.editing.changes import boundary_distance

        self.number = number
        self.numbers = stored.face_numbers
        table = mesh_arrays.joined_table(obj.data)
        pairs, edges = table.face_pairs()
        self.pairs, self.edges, self.ends = pairs, edges, table.edges  # (e, 2) faces that meet, and (e,) at which edges
        self.center = bridge.face_centers(obj)
        length = np.linalg.norm(self.center[pairs[:, 0]] - self.center[pairs[:, 1]], axis=1)
        size = box_diagonal(self.center)
        if not size:  # a scale of 0, at a frame before the object appears
            raise SceneError(rpt_("All {n} faces have zero area. Check the scale of the object.").format(
                n=len(self.center)))
        self.width = max(RING * size, FACES * float(length.mean()) if len(length) else 0.0)
        inside = self.numbers == number
        beyond = self.numbers[pairs]
        crossing = inside[pairs].sum(axis=1) == 1
        self.rim = pairs[crossing]  # (r, 2), faces on either side
        self.neighbors = np.setdiff1d(beyond[crossing], [number]).tolist()
        wanted = crossing & (beyond == neighbor).any(axis=1) if neighbor in self.neighbors else crossing
        kept = wanted | (beyond[:, 0] == beyond[:, 1])
        distance, across = boundary_distance(inside, pairs[kept], length[kept])
        # What a face inside would go to; its own part for one that has nowhere to go.
        self.receiver = np.where(inside & (across >= 0), self.numbers[across], self.numbers)
        locked = pins.locked_others(obj.data, number)
        stays = np.isin(self.numbers, locked) | np.isin(self.receiver, locked) | ~np.isfinite(distance)
        self.distance = np.where(stays, np.nan, distance)
        known = self.distance[np.isfinite(self.distance)]
        self.reach = np.array([known.min(initial=0.0), known.max(initial=0.0)])

    def nearest_neighbor(self, location: Sequence[float]) -> int:
        """The part beyond the stretch of the boundary that is nearest to a (3,) place of ``center``; 0 for none."""
        if not len(self.rim):
            return 0
        middle = self.center[self.rim].mean(axis=1)
        first, second = self.numbers[self.rim[np.linalg.norm(middle - location, axis=1).argmin()]].tolist()
        return first if second == self.number else second

    def slid(self, offset: float) -> np.ndarray:
        """The part of each face with the boundary moved outwards by a distance, (p,) int64."""
        with np.errstate(invalid="ignore"):  # nan: the face stays
            taken = (self.distance > 0) & (self.distance <= offset)
            given = (self.distance < 0) & (self.distance >= offset)
        return np.where(taken, self.number, np.where(given, self.receiver, self.numbers))

    def offset(self, rings: int) -> float:
        """How far some rings are, as a distance; something of the part is always left."""
        return max(rings * self.width, 0.999 * self.reach[0])

    @property
    def most(self) -> tuple[int, int]:
        """How many rings it can be moved inwards, as a negative number, and outwards."""
        low, high = self.reach / self.width
        return int(np.ceil(low)), int(np.ceil(high))

    def ring_edges(self, rings: int, ahead: int) -> tuple[np.ndarray, np.ndarray]:
        """Ends of edges where the boundary is after so many rings, (k, 2), and where it would be after a few more.

        ahead : 1 for more rings outwards, -1 inwards.
        """
        far = np.where(self.numbers == self.number, -np.inf, np.inf)
        ring = np.where(np.isnan(self.distance), far, self.distance) / self.width
        ring = np.where(ring > 0, np.ceil(ring), np.floor(ring))
        # 0 on this side of the boundary, 1 and so on ring by ring beyond it.
        label = np.clip(ahead * (ring - rings), 0, AHEAD).astype(np.int8)
        first, second = label[self.pairs[:, 0]], label[self.pairs[:, 1]]
        differ, on_boundary = first != second, np.minimum(first, second) == 0
        return self.ends[self.edges[differ & on_boundary]], self.ends[self.edges[differ & ~on_boundary]]


def check_borders(obj: bpy.types.Object, boundaries: Sequence[Boundary]) -> None:
    """Raise SceneError if there is nothing beyond any of some boundaries of an object's parts."""
    if not any(boundary.neighbors for boundary in boundaries):
        raise SceneError(rpt_("{name} shares no edge with another part: there is no boundary to move.").format(
            name=part_names.part_name(obj.data, boundaries[0].number)))


def write_moved(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, numbers: np.ndarray,
                parts: Sequence[int]) -> str | None:
    """Move boundaries for good; what happened to the parts that they are of, in a sentence, None for nothing.

    numbers : (p,) int64, the part of each face from now on.
    """
    before, names = stored.face_numbers, part_names.all_names(obj.data)
    if (numbers == before).all():
        return None
    wanted = face_edits.assign_faces(context, obj, stored, numbers, beside_taken=1.0)
    count = int(((wanted != before) & (np.isin(wanted, parts) | np.isin(before, parts))).sum())
    grew = np.isin(wanted, parts).sum() > np.isin(before, parts).sum()
    text = rpt_("{names} took {n} {n:face|faces}") if grew else rpt_("{names} gave away {n} {n:face|faces}")
    told = text.format(names=", ".join(part_names.part_name(obj.data, number) for number in parts), n=Count(count))
    rest, ended = face_edits.told_of_rest(obj.data, before, wanted), face_edits.told_of_ended(obj.data, names)
    return "; ".join(filter(None, (told, rest, ended)))
