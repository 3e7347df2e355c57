# SPDX-License-Identifier: GPL-3.0-or-later
"""How much room there is for joints at some places of a cap.

How far the surface of a piece is from them is measured. A solid of a peg is tried at points so near each other that a
wall which is as thick as asked at each of them cannot be missing in between.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Protocol

import numpy as np

from ...arrays.int64 import arange
from ...arrays.ties import rounded
from .cap import CapGrid
from .shapes import REACH, Kind

# How many places are tried with all of a peg.
_MOST = 100
# Places with this share of the most room are as good.
_NEARLY = 0.95
# The wall around a joint is at least this share of its radius: points at which it is tried are nearer than twice that.
_WALL = 1 / 3
# Of its radius: how deep a joint goes, and the least that holds; and how far the foot of a peg stands in its own piece.
_DEPTH = {Kind.MAGNET: (0.7, 0.5)}
_DEEP, _FOOT = (2.5, 1.2), 0.35
_LEVELS = 7


class Body(Protocol):
    """A piece, for what has to be known of it at some points."""

    def distance(self, points: np.ndarray) -> np.ndarray:
        """How far its surface, without the cap in question, is from points, (k, 3): (k,) float64."""

    def inside(self, points: np.ndarray) -> np.ndarray:
        """Whether points, (k, 3), lie inside: (k,) bool."""


@dataclass(frozen=True)
class Wanted:
    """What joints are to be like, in units of the mesh.

    Attributes
    ----------
    kind : Kind
    count : int
        How many a cut has at most, 1 to 3.
    clearance : float
        Between a joint and what it goes into, all around.
    size : float
        Their width; 0 for a third of the cut's.
    depth : float
        How far they go into a piece; 0 for what suits their width.
    wall : float
        The least thickness of what remains around them.
    least : float
        The smallest width.
    """

    kind: Kind
    count: int
    clearance: float
    size: float
    depth: float
    wall: float
    least: float


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint in its place.

    Attributes
    ----------
    origin : (3,) float64
    axes : (3, 3) float64
        Rows: two across, and the one along, into the piece that receives the joint.
    radius : float
        Half its width.
    low, high : float
        Where the cap lies below it at the lowest and at the highest, along the axis from the origin.
    depth : float
        How far it goes into the piece, from there.
    foot : float
        How far it goes into the other piece, from the lowest.
    """

    origin: np.ndarray
    axes: np.ndarray
    radius: float
    low: float
    high: float
    depth: float
    foot: float


@dataclass(frozen=True, eq=False)
class Room:
    """Places of a cap for joints.

    bodies : the two pieces. flat, room : (k, 2) and (k,), see ``joint_places``.
    """

    grid: CapGrid
    bodies: tuple[Body, Body]
    wanted: Wanted
    flat: np.ndarray
    room: np.ndarray

    def joints(self, radius: float, into: int, count: int) -> tuple[Joint, ...]:
        """So many joints of a size into a piece, at the best places; none if there is no room for all of them."""
        reach = REACH[self.wanted.kind] * radius + self.wanted.clearance
        wall = max(self.wanted.wall, _WALL * radius)
        wide = np.flatnonzero(self.room >= reach + wall)
        if len(wide) < count:
            return ()
        wide = np.unique(np.concatenate([wide[:1], wide[:: len(wide) // _MOST + 1]]))
        flat, room = self.flat[wide], self.room[wide]
        ends = _under(self.grid, flat, reach)
        depth = self._depth(_Trial(self.grid, flat, reach, wall), ends, radius, into)
        good = np.flatnonzero(depth >= 0)
        chosen = good[_packed(flat[good], room[good], count, 2 * reach + wall)]
        # All as deep as the least deep of them can be.
        return self._made(flat[chosen], ends[:, chosen], float(depth[chosen].min(initial=np.inf)), radius, into)

    def _depth(self, trial: _Trial, ends: np.ndarray, radius: float, into: int) -> np.ndarray:
        """How deep a joint can be at each of some places, (k,) float64; -1 where it cannot be.

        ends : (2, k), the lowest and the highest of the cap under the joint; nan if it does not go so far.
        """
        low, high = ends
        wanted, bodies, sign = self.wanted, self.bodies, 1.0 if into else -1.0
        deep, least = (wanted.depth, wanted.depth) if wanted.depth else (
            radius * np.array(_DEPTH.get(wanted.kind, _DEEP))).tolist()
        start, end = (low, high) if into else (high, low)
        possible = np.isfinite(low) & trial.is_free(bodies, low, high)
        if not wanted.kind.both_sides:
            possible &= trial.holds(bodies[1 - into], np.where(possible, start, np.nan), -sign, _FOOT * radius)
        depth = np.full(len(low), np.inf)
        for side, height, way in ((into, end, sign), (1 - into, start, -sign))[: 1 + wanted.kind.both_sides]:
            # Heights that are nan are not tried.
            found = trial.depth(bodies[side], np.where(possible, height, np.nan), way, deep + wanted.clearance)
            depth = np.minimum(depth, found - wanted.clearance)
            possible &= depth >= least * (1 - 1e-9)
        return np.where(possible, depth, -1.0)

    def _made(self, flat: np.ndarray, ends: np.ndarray, depth: float, radius: float, into: int) -> tuple[Joint, ...]:
        """Joints of one depth at k places. ends : (2, k), where the cap lies below each, at the lowest and highest."""
        foot = depth if self.wanted.kind.both_sides else _FOOT * radius
        axes = self.grid.axes if into else self.grid.axes * [[1], [-1], [-1]]
        low, high = ends if into else -ends[::-1]
        return tuple(Joint(self.grid.world(place, np.zeros(())), axes, radius, first, last, depth, foot)
                     for place, first, last in zip(flat, low.tolist(), high.tolist(), strict=True))


def _under(grid: CapGrid, flat: np.ndarray, reach: float) -> np.ndarray:
    """The lowest and the highest place of the cap under the disks around k places, (2, k); nan if it goes less far."""
    low, high = grid.heights((flat[:, None] + _disk(reach)).reshape(-1, 2))
    return np.stack([low.reshape(len(flat), -1).min(axis=1), high.reshape(len(flat), -1).max(axis=1)])


def _disk(radius: float) -> np.ndarray:
    """The middle, eight places around it half way out, and sixteen at the rim of a disk, (25, 2) float64."""
    inner, outer = (2 * np.pi * arange(n) / n for n in (8, 16))
    return np.concatenate([[[0.0, 0.0]], radius / 2 * np.stack([np.cos(inner), np.sin(inner)], axis=1),
                           radius * np.stack([np.cos(outer), np.sin(outer)], axis=1)])


@dataclass(frozen=True, eq=False)
class _Trial:
    """Disks of some places, and the wall around them."""

    grid: CapGrid
    flat: np.ndarray
    reach: float
    wall: float

    def depth(self, body: Body, height: np.ndarray, sign: float, deepest: float) -> np.ndarray:
        """How far the disks can go into a piece from some heights before the wall is too thin, (k,) float64."""
        share = arange(1, _LEVELS + 1) / _LEVELS
        levels = height[:, None] + sign * deepest * np.concatenate([[1e-3], share])
        fine, reached = self._inside(body, levels[:, :1])[:, 0], np.zeros(len(height), np.int64)
        for level in levels.T:  # the next one only where this one has a wall
            fine &= self._walled(body, np.where(fine, level, np.nan)[:, None])[:, 0]
            reached += fine
        return np.where(reached > 1, deepest * share[np.maximum(reached, 2) - 2], 0.0)

    def is_free(self, bodies: tuple[Body, Body], low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Whether the surfaces of both pieces stay clear of the disks from one height to another, (k,) bool."""
        levels = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, 3)
        for body in bodies:
            levels[~self._walled(body, levels).all(axis=1)] = np.nan
        return np.isfinite(levels).all(axis=1)

    def holds(self, body: Body, start: np.ndarray, sign: float, foot: float) -> np.ndarray:
        """Whether the foot of a peg is in the piece that it belongs to, (k,) bool."""
        levels = start[:, None] + sign * foot * np.array([[0.1, 0.55, 1.0]])
        return (self._walled(body, levels) & self._inside(body, levels)).all(axis=1)

    def _walled(self, body: Body, levels: np.ndarray) -> np.ndarray:
        """Whether the surface keeps away from the disks at some levels of each place, (k, l): (k, l) bool."""
        fine = np.isfinite(levels)
        k, level = np.nonzero(fine)
        height = levels[k, level]
        middle = body.distance(self.grid.world(self.flat[k], height))
        close = np.flatnonzero(middle < self.reach + self.wall)
        around = self.flat[k[close], None] + _disk(self.reach)
        points = self.grid.world(around, np.broadcast_to(height[close, None], around.shape[:2]))
        near = body.distance(points.reshape(-1, 3)).reshape(around.shape[:2])
        fine[k[close], level[close]] = (near >= self.wall * (1 - 1e-6)).all(axis=1)
        return fine

    def _inside(self, body: Body, levels: np.ndarray) -> np.ndarray:
        """Whether the middles of the disks are inside, (k, l) bool."""
        fine = np.isfinite(levels)
        k, level = np.nonzero(fine)
        fine[k, level] = body.inside(self.grid.world(self.flat[k], levels[k, level]))
        return fine


def _packed(flat: np.ndarray, room: np.ndarray, count: int, apart: float) -> np.ndarray:
    """Which places give so many joints the most room, from the surface and from each other; indices, or none."""
    if len(flat) < count:
        return np.empty(0, np.int64)
    few = arange(len(flat)) if count < 3 else arange(0, len(flat), len(flat) // 32 + 1)
    groups = np.array(list(combinations(few.tolist(), count)))
    if not len(groups):
        return np.empty(0, np.int64)
    pairs = list(combinations(range(count), 2))
    between = np.min([np.linalg.norm(flat[groups[:, i]] - flat[groups[:, j]], axis=1) for i, j in pairs]
                     or [np.full(len(groups), np.inf)], axis=0)
    groups, between = groups[between >= apart], between[between >= apart]
    if not len(groups):
        return np.empty(0, np.int64)
    most = np.minimum(room[groups].min(axis=1), between / 2)
    # Of those with nearly the most room the ones farthest apart, and of these the ones around the middle of the cap.
    kept = arange(len(groups))
    for value in (most, between):
        kept = kept[value[kept] >= _NEARLY * value[kept].max()]
    off = np.linalg.norm(flat[groups[kept]].mean(axis=1), axis=1)
    return groups[kept[rounded(off).argmin()]]
