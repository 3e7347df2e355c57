# SPDX-License-Identifier: GPL-3.0-or-later
"""The solids of joints: pegs, keys, dowels and what they go into, as prisms whose ends are narrower."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from ...arrays.int64 import arange


class Kind(Enum):
    """What joins two pieces."""

    ROUND = "ROUND"
    SQUARE = "SQUARE"
    KEY = "KEY"
    DOWEL = "DOWEL"
    MAGNET = "MAGNET"

    @property
    def both_sides(self) -> bool:
        """Whether both pieces have a hole, instead of one of them a peg."""
        return self in {Kind.DOWEL, Kind.MAGNET}


_ROUND = 2 * np.pi * (arange(48) + 0.5) / 48
_CIRCLE = np.stack([np.cos(_ROUND), np.sin(_ROUND)], axis=1) / np.cos(np.pi / 48)
_SQUARE = np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
# As the tail of a dove: one way round only.
_KEY = np.array([[1.0, -1.0], [0.5, 1.0], [-0.5, 1.0], [-1.0, -1.0]])
#: What a joint of radius 1 looks like from above, (k, 2), counterclockwise; half of its width is 1.
OUTLINES = {Kind.ROUND: _CIRCLE, Kind.SQUARE: _SQUARE, Kind.KEY: _KEY, Kind.DOWEL: _CIRCLE, Kind.MAGNET: _CIRCLE}
#: How far that reaches from its middle.
REACH = {kind: float(np.linalg.norm(outline, axis=1).max()) for kind, outline in OUTLINES.items()}
# How much of its radius the end of a joint gets narrower, so that it finds its way.
_CHAMFER = 0.15
# Sides that lie as far apart everywhere: where two of them meet at 135 degrees, corners lie so much to the side.
_MITER = float(np.tan(np.pi / 8))


@dataclass(frozen=True, eq=False)
class Solid:
    """A closed surface.

    Attributes
    ----------
    points : (n, 3) float64
    faces : tuple of tuple of int
        Counterclockwise seen from outside.
    """

    points: np.ndarray
    faces: tuple[tuple[int, ...], ...]


def solid(kind: Kind, radius: float, low: float, high: float, clearance: float = 0.0) -> Solid:
    """Make a joint, or with a clearance what it goes into; along the third axis.

    Parameters
    ----------
    kind : Kind
    radius : float
        Half the width of the joint.
    low, high : float
        Where it begins and ends.
    clearance : float
        By how much it is larger all around.

    Returns
    -------
    made : Solid
        Dowels are narrower at both ends, magnets at none, pegs at the upper one.
    """
    outline = radius * OUTLINES[kind]
    chamfer = 0.0 if kind is Kind.MAGNET else _CHAMFER * radius
    upper = [(0.0, high - chamfer, 1.0, _MITER), (-chamfer, high, _MITER, 1.0)] if chamfer else [(0.0, high, 1.0, 1.0)]
    lower = [(0.0, low, 1.0, -1.0)]
    if kind is Kind.DOWEL:
        lower = [(-chamfer, low, _MITER, -1.0), (0.0, low + chamfer, 1.0, -_MITER)]
    return _stacked([(_offset(outline, inward + out * clearance), z + up * clearance)
                     for inward, z, out, up in [*lower, *upper]])


def volume_from(kind: Kind, radius: float, start: float, end: float, clearance: float = 0.0) -> float:
    """What a solid as ``solid`` makes it encloses between a place along the axis and its end, before clearance."""
    single = Kind.ROUND if kind is Kind.DOWEL else kind
    return volume(solid(single, radius, start + clearance, end, clearance))


def volume(made: Solid) -> float:
    """What a solid encloses."""
    fans = np.array([(face[0], face[i], face[i + 1]) for face in made.faces for i in range(1, len(face) - 1)])
    a, b, c = made.points[fans].transpose(1, 0, 2)
    return float((a * np.cross(b, c)).sum() / 6)


def _offset(outline: np.ndarray, by: float) -> np.ndarray:
    """Move the sides of a convex outline outwards, (k, 2)."""
    along = np.roll(outline, -1, axis=0) - outline
    out = np.stack([along[:, 1], -along[:, 0]], axis=1) / np.linalg.norm(along, axis=1)[:, None]
    before = np.roll(out, 1, axis=0)
    return outline + by * (before + out) / (1 + (before * out).sum(axis=1))[:, None]


def _stacked(rings: list[tuple[np.ndarray, float]]) -> Solid:
    """Rings of equally many points one above the other, closed at both ends."""
    k = len(rings[0][0])
    points = np.concatenate([np.column_stack([ring, np.full(k, z)]) for ring, z in rings])
    step = np.roll(arange(k), -1)
    around = [np.stack([a + arange(k), a + step, a + k + step, a + k + arange(k)], axis=1)
              for a in range(0, k * (len(rings) - 1), k)]
    ends = [tuple(range(k - 1, -1, -1)), tuple(range(k * (len(rings) - 1), k * len(rings)))]
    return Solid(points, (*map(tuple, np.concatenate(around).tolist()), *ends))
