# SPDX-License-Identifier: GPL-3.0-or-later
"""Where parts are and how large: what stands on the ground, is to one side, or in the midst of a creature."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...arrays.indexing import bounds_of_each
from ...arrays.vectors import middles_of_each, second_moments_of_each
from ...mesh.corners import CornerTable
from ...mesh.grounds import grounds_among
from ...result.parts import Parts
from .touching import LOOSE, Touching

# None of the numbers of creatures is sharp: each 0.7 or 1.4 times as large names 1,401 to 1,474 parts of rigged models
# rightly instead of 1,454, and 199 to 246 wrongly instead of 224 (docs/quality.md).
# Shares of the model's height, width or length.
FOOT = 0.08  # a part that comes so near to the ground stands on it
MIDST = 0.15  # a part whose middle is nearer than that to the body's lies in the midst of it
_APART = 0.075  # half of that: what belongs to a limb is so far to one side, and a belly that hangs down nearer
AHEAD = 0.15  # the middle of a head, or of a tail where these are weighed, is so far before or behind the body's
_SHOE = 0.2  # a foot is shorter than that; what is longer and flat, as a tail on the ground, lies there
RISE = 0.1  # a head reaches so far above the middle of the body, and a part that is chest and head above its top
# Ratios.
_UPRIGHT = 1.2  # a model so many times as high as long is upright
_CLEAR = 2.0  # the end of a creature with so many times as much hanging on it has the head
_LYING = 1.5  # a part that is so many times as long as high lies on the ground instead of standing there
_MIDWAY = 4.0  # and one so many times as long as it is to one side: a tail there, but no leg that is stretched out
LONG = 1.8  # a part so many times as long as wide is a limb
_LEVEL = 0.5  # a plane of symmetry is one of left and right if its normal is so level, as a share of its length
_OBLONG = 1.2  # seen from above, a model so many times as long as wide has a longest axis


@dataclass(frozen=True, eq=False)
class Shapes:
    """Where parts are and how large: upright as in the world, turned about that axis until the model lies along others.

    Attributes
    ----------
    touching : Touching
        Of k parts.
    low, high : (k, 3) float64
        Corners of the box around each part.
    middle : (k, 3) float64
        Middle of the surface of each part.
    length : (k, 3) float64
        Extents of each part along its own axes, longest first.
    across : int
        The axis, 0 or 1, across a creature.
    others : tuple of Shapes
        Other ways in which a creature may look, where no plane of symmetry tells.
    """

    touching: Touching
    low: np.ndarray
    high: np.ndarray
    middle: np.ndarray
    length: np.ndarray
    across: int
    others: tuple[Shapes, ...] = ()

    @classmethod
    def of(
        cls, parts: Parts, table: CornerTable, area: np.ndarray, is_ground: np.ndarray, turn: np.ndarray
    ) -> Shapes:
        """Measure parts.

        Parameters
        ----------
        parts : Parts
            Of p faces.
        table : CornerTable
            The p faces, in the world.
        area : (p,) float64
            Of the faces.
        is_ground : (p,) bool
            Which faces are those of a floor or the like. A part of these alone is no part of what stands there, unless
            all are.
        turn : (3, 3) float64
            Takes directions of the decomposition to those of the world.

        Returns
        -------
        shapes : Shapes
            With ``others`` where no plane of symmetry tells how a creature stands.
        """
        plane = parts.decomposition.plane
        normal = np.zeros(3) if plane is None else turn @ plane.normal
        known = np.linalg.norm(normal[:2]) > _LEVEL * np.linalg.norm(normal)
        weight = area + 1e-12 * area.sum() + 1e-300
        ground = grounds_among(parts.labels, is_ground)
        touching = Touching(parts, ground)
        found = cls._turned(touching, table, weight, _onto_axis(normal[:2]) if known else np.eye(3))
        found = replace(found, across=int(abs(normal[1]) > abs(normal[0])))
        if normal.any():  # if it is not level, a creature lies on its side
            return found
        others = [replace(found, across=1 - found.across)]
        stands = ~ground[parts.labels]
        if len(longest := _longest(table.face_means(table.vertices)[stands], weight[stands])):
            along = cls._turned(touching, table, weight, _onto_axis(longest))
            others += [replace(found, low=along.low, high=along.high, middle=along.middle, across=axis)
                       for axis in (0, 1)]
        return replace(found, others=tuple(others))

    @classmethod
    def _turned(cls, touching: Touching, table: CornerTable, weight: np.ndarray, turn: np.ndarray) -> Shapes:
        """Measure parts once they are turned. weight : (p,), of the faces. turn : (3, 3)."""
        labels, count = touching.parts.labels, touching.parts.count
        center = table.face_means(table.vertices) @ turn.T
        total, middle = middles_of_each(labels, center, weight, count)
        low, high = bounds_of_each(labels[table.corner_face], table.vertices[table.corner_vertex] @ turn.T, count)
        offset = center - middle[labels]
        spread = second_moments_of_each(labels, offset, weight, count) / total[:, None, None]
        length = np.sqrt(np.maximum(np.linalg.eigvalsh(spread)[:, ::-1], 0.0))
        return cls(touching, low, high, middle, length, 0)

    @property
    def parts(self) -> Parts:
        """The parts themselves."""
        return self.touching.parts

    @property
    def neighbors(self) -> list[set[int]]:
        """Parts that each part touches."""
        return self.touching.neighbors

    @property
    def body(self) -> int:
        """The part that most area hangs on."""
        return self.touching.body

    @property
    def steps(self) -> np.ndarray:
        """(k,) int64, over how many cuts each part hangs on the body."""
        return self.touching.steps

    @property
    def ground(self) -> np.ndarray:
        """(k,) bool, parts that are grounds; of these no more is said."""
        return self.touching.ground

    @cached_property
    def share(self) -> np.ndarray:
        """(k,) float64, area of each part as a share of that of the model."""
        return self.parts.share / self.parts.share[~self.ground].sum()

    @cached_property
    def bottom(self) -> float:
        """The height of the model's lowest point."""
        return float(self.low[~self.ground, 2].min())

    @cached_property
    def size(self) -> np.ndarray:
        """(3,) float64, extents of the whole model, which grounds are no part of."""
        return np.maximum(self.high[~self.ground].max(axis=0) - self.low[~self.ground].min(axis=0), 1e-300)

    @cached_property
    def elongation(self) -> np.ndarray:
        """(k,) float64, how many times as long as wide each part is."""
        return self.length[:, 0] / np.maximum(self.length[:, 1], 1e-9 * self.size.max())

    @cached_property
    def offset(self) -> np.ndarray:
        """(k, 3) float64, from the middle of the body to that of each part, as shares of the model's extents."""
        return (self.middle - self.middle[self.body]) / self.size

    @cached_property
    def upright(self) -> bool:
        """Whether a creature would stand on two legs: it is higher than long."""
        return bool(self.size[2] > _UPRIGHT * self.size[1 - self.across])

    @cached_property
    def aside(self) -> np.ndarray:
        """(k,) float64, how far to one side of the body each part is, as a share of the model's width."""
        return self.offset[:, self.across]

    @cached_property
    def hanging(self) -> list[int]:
        """Parts that hang on the body."""
        return np.flatnonzero((self.steps > 0) & (self.steps < LOOSE)).tolist()

    @cached_property
    def feet(self) -> list[int]:
        """Parts that stand on the ground: what lies there, as a tail does, or a belly in the midst, does not stand."""
        extent, aside, long = self.high - self.low, np.abs(self.aside), (self.high - self.low)[:, 1 - self.across]
        down = self.middle[:, 2] < self.middle[self.body, 2]
        lies = long > np.maximum(_LYING * extent[:, 2], _MIDWAY * aside * self.size[self.across])
        lies &= long > _SHOE * self.size.max()
        inside = (aside < _APART) & (not self.upright)
        grounded = self.low[:, 2] - self.bottom < FOOT * self.size[2]
        stands = grounded & (down | (self.elongation > LONG)) & ~lies & ~inside
        return [part for part in self.hanging if stands[part]]

    @cached_property
    def legs(self) -> list[int]:
        """The feet, and what is between them and the body."""
        return self.feet + self.between(self.feet)

    @cached_property
    def trunk(self) -> list[int]:
        """What belongs to the body although it is a part of its own: what a leg touches, unless it rises above that.

        A rump has the hind legs, and is neither a head nor a tail. What rises is chest, neck and head in one.
        """
        touched = {other for part in self.legs for other in self.neighbors[part]} - {*self.legs, self.body}
        return [part for part in sorted(touched) if self.high[part, 2] < self.high[self.body, 2] + RISE * self.size[2]]

    @cached_property
    def ahead(self) -> int:
        """1 or -1, the direction along a creature in which its head is; 0 if that is not clear.

        Head and neck, high and in the midst, are larger than a tail.
        """
        along = self.offset[:, 1 - self.across]
        there = (np.abs(self.aside) < MIDST) & (np.abs(along) > AHEAD) & (self.offset[:, 2] > 0.0)
        there[[self.body, *self.legs, *self.trunk]] = False
        there &= ~self.ground
        front, back = (float(self.share[there & (sign * along > 0)].sum()) for sign in (1, -1))
        return 0 if max(front, back) < _CLEAR * min(front, back) or front == back else 1 if front > back else -1

    def between(self, ends: list[int]) -> list[int]:
        """Parts on the way from the body to some ends of limbs, as far as they are to one side of the body."""
        found: list[int] = []
        at = list(ends)
        while at:
            at = [part for part in {other for part in at for other in self.neighbors[part]
                                    if 0 < self.steps[other] < self.steps[part]}
                  if (abs(self.aside[part]) > _APART or self.paired[part]) and part not in found and part not in ends]
            found += at
        return found

    @cached_property
    def paired(self) -> np.ndarray:
        """(k,) bool, whether a part has a mirror image that is another part."""
        return self.parts.side != 0

    @cached_property
    def pairs(self) -> list[tuple[int, int]]:
        """Every two parts that are mirror images."""
        return [(part, int(self.parts.twin[part])) for part in np.flatnonzero(self.paired).tolist()
                if part < self.parts.twin[part]]


def _longest(center: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """The longest axis of a model seen from above, (2,), or (0,) if it is not clear. center, weight : of the faces."""
    away = center[:, :2] - np.average(center[:, :2], axis=0, weights=weight)
    spread, axes = np.linalg.eigh((weight[:, None] * away).T @ away)
    return axes[:, 1] if spread[1] > _OBLONG**2 * spread[0] else np.empty(0)


def _onto_axis(level: np.ndarray) -> np.ndarray:
    """The least turn about the third axis, (3, 3), that brings a level direction, (2,), onto one of the others."""
    angle = np.arctan2(level[1], level[0])
    angle -= np.round(angle / (np.pi / 2)) * np.pi / 2
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
