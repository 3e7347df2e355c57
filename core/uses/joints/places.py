# SPDX-License-Identifier: GPL-3.0-or-later
"""Where two pieces can be joined across a cut: places for pegs that leave a wall around them, and how large these are.

Places are tried on the cap; how far the surface of a piece is from them is measured. A solid of a peg is tried at
points so near each other that a wall which is as thick as asked at each of them cannot be missing in between.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ...arrays.ties import rounded
from ...arrays.vectors import cross_in_plane
from .shapes import REACH, Kind

if TYPE_CHECKING:
    from ...graph.reeb import ReebGraph

# A cap that is so bent that less than this share of its area looks along the axis has no axis to speak of.
_STRAIGHT = 0.6
# Of its size: what is not farther from the middle of a cap is in the middle, but for rounding.
_SAME = 1e-9
# How many places on a cap are looked at, and along its longer side; how many of them are tried with all of the peg, and
# how often the deepest one is looked for between them.
_PLACES, _ALONG, _MOST, _FINER = 400, 64, 100, 3
# Places with this share of the most room are as good.
_NEARLY = 0.95
# Of the inscribed width of the cut, the width of a joint that is as large as it likes to be; and the smaller sizes.
_SHARE, _SMALLER = 1 / 3, (1.0, 0.8, 0.64, 0.5, 0.4)
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
class Cap:
    """What two pieces have in common.

    Attributes
    ----------
    points : (n, 3) float64
    triangles : (t, 3) int64
        They look from the first piece to the second.
    rims : (s, 2, 3) float64
        The edges around all that the two have in common: a tube is cut along two rims, one in the other.
    """

    points: np.ndarray
    triangles: np.ndarray
    rims: np.ndarray

    def corners(self) -> np.ndarray:
        """Of the triangles, (t, 3, 3) float64."""
        return self.points[self.triangles]

    def normals(self) -> np.ndarray:
        """Of the triangles, as long as their areas, (t, 3) float64."""
        a, b, c = self.corners().transpose(1, 0, 2)
        return 0.5 * np.cross(b - a, c - a)

    def area(self) -> float:
        """Of all triangles."""
        return float(np.linalg.norm(self.normals(), axis=1).sum())


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
class Places:
    """The joints of a cut.

    Attributes
    ----------
    joints : tuple of Joint
        All of one size; none if there is no room.
    into : int
        The piece that receives them, 0 or 1.
    width : float
        The inscribed width of the cut.
    bent : bool
        Whether there are none because the cap has no axis.
    """

    joints: tuple[Joint, ...]
    into: int
    width: float
    bent: bool = False


def joint_places(cap: Cap, bodies: tuple[Body, Body], wanted: Wanted, first: int = 1,
                 along: np.ndarray | None = None) -> Places:
    """Find the places of joints: where there is most room, as large and as many as asked for, else fewer and smaller.

    Parameters
    ----------
    cap : Cap
    bodies : (Body, Body)
    wanted : Wanted
    first : int
        The piece that should receive the joints; if it cannot, the other does.
    along : (3,) float64, optional
        The axis, in either direction, where the cap is too bent to tell.

    Returns
    -------
    places : Places
    """
    frame = _axes(cap, along)
    if frame is None:
        return Places((), first, 0.0, bent=True)
    grid = _Grid(cap, frame)
    room = _Room(grid, bodies, wanted, *_candidates(grid, bodies))
    width = 2 * float(room.room.max(initial=0.0))
    radius = wanted.size / 2 if wanted.size else _SHARE * width / 2
    for count in range(wanted.count, 0, -1):
        for share in _SMALLER:
            if 2 * share * radius < wanted.least:
                break
            for into in (first, 1 - first):
                if found := room.joints(share * radius, into, count):
                    return Places(found, into, width)
    return Places((), first, width)


def _axes(cap: Cap, along: np.ndarray | None) -> np.ndarray | None:
    """Rows: along the longer side of the cap, across, and out of the first piece; None without an axis."""
    normal, total = cap.normals().sum(axis=0), cap.area()
    if not total > 1e-12 * np.ptp(cap.corners(), axis=(0, 1)).max(initial=0.0) ** 2:
        return None
    if np.linalg.norm(normal) < _STRAIGHT * total:
        if along is None or not along.any():
            return None
        normal = along if along @ normal >= 0 else -along
    normal = normal / np.linalg.norm(normal)
    out, weight = _across(cap, normal)
    _, vectors = np.linalg.eigh((out * weight[:, None]).T @ out)
    u = vectors[:, 2] - (vectors[:, 2] @ normal) * normal
    u /= np.linalg.norm(u)
    u = u if rounded(np.array([weight @ (out @ u) ** 3]))[0] >= 0 else -u
    return np.stack([u, np.cross(normal, u), normal])


def _across(cap: Cap, normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How far the triangles are from the middle of a cap, across its axis, (k, 3), and their areas, (k,).

    Where all of them are in the middle, as in a cap of one triangle, their corners instead: these differ.
    """
    corners, weight = cap.corners(), np.linalg.norm(cap.normals(), axis=1)
    middle = corners.mean(axis=1)
    out = middle - np.average(middle, axis=0, weights=weight)
    out -= np.outer(out @ normal, normal)
    if np.abs(out).max() > _SAME * np.ptp(corners, axis=(0, 1)).max():
        return out, weight
    out = (corners - np.average(middle, axis=0, weights=weight)).reshape(-1, 3)
    return out - np.outer(out @ normal, normal), np.repeat(weight, 3)


def arc_direction(graph: ReebGraph, place: np.ndarray) -> np.ndarray | None:
    """Find how the Reeb graph runs beside a place.

    graph : ReebGraph. place : (3,) float64, in its units. Returns the direction of the arc with the nearest center
    point there, (3,) float64, or None if no arc has two points.
    """
    arc, points = graph.point_arc, graph.point_position
    long = np.flatnonzero(np.bincount(arc, minlength=graph.n_arcs)[arc] > 1)
    if not len(long):
        return None
    nearest = long[np.linalg.norm(points[long] - place, axis=1).argmin()]
    first, last = graph.arc_points[arc[nearest]], graph.arc_points[arc[nearest] + 1] - 1
    return points[min(nearest + 1, last)] - points[max(nearest - 1, first)]


class _Grid:
    """A cap seen along its axis, and how high it lies over each place.

    Parameters
    ----------
    cap : Cap
    axes : (3, 3) float64
        See _axes.
    """

    def __init__(self, cap: Cap, axes: np.ndarray) -> None:
        self.axes = axes
        self.rims = cap.rims
        self.origin = np.average(cap.corners().mean(axis=1), axis=0, weights=np.linalg.norm(cap.normals(), axis=1))
        self.seen = (cap.corners() - self.origin) @ axes.T
        self.size = float(np.ptp(self.seen[..., :2], axis=(0, 1)).max())

    def places(self) -> tuple[np.ndarray, float]:
        """A grid over the cap, (k, 2) float64, and how wide its meshes are."""
        low, high = self.seen[..., :2].min(axis=(0, 1)), self.seen[..., :2].max(axis=(0, 1))
        step = max(self.size / _ALONG, float(np.sqrt(np.prod(high - low) / _PLACES)))
        count = np.maximum(np.ceil((high - low) / step).astype(int), 1)
        lines = [(low[i] + high[i]) / 2 + step * (np.arange(count[i]) - (count[i] - 1) / 2) for i in (0, 1)]
        return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 2), step

    def heights(self, flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The lowest and the highest place of the cap over places, (k, 2): two (k,) float64, nan beside the cap."""
        low, high = np.empty(len(flat)), np.empty(len(flat))
        a, b, c = self.seen.transpose(1, 0, 2)
        twice = cross_in_plane(b - a, c - a)
        solid = np.abs(twice) > 1e-12 * self.size**2
        a, b, c, twice = a[solid], b[solid], c[solid], twice[solid]
        for part in np.array_split(np.arange(len(flat)), len(flat) * len(a) // 1_000_000 + 1):
            p = flat[part, None]
            v = cross_in_plane(p - a[:, :2], (c - a)[:, :2]) / twice
            w = cross_in_plane((b - a)[:, :2], p - a[:, :2]) / twice
            over = (v >= -1e-9) & (w >= -1e-9) & (v + w <= 1 + 1e-9)
            height = a[:, 2] + v * (b - a)[:, 2] + w * (c - a)[:, 2]
            least = np.where(over, height, np.inf).min(axis=1, initial=np.inf)
            most = np.where(over, height, -np.inf).max(axis=1, initial=-np.inf)
            low[part], high[part] = np.where(over.any(axis=1), [least, most], np.nan)
        return low, high

    def depth(self, points: np.ndarray) -> np.ndarray:
        """How far points, (k, 3), are from the rims, (k,) float64."""
        least = np.full(len(points), np.inf)
        for part in np.array_split(self.rims, len(points) * len(self.rims) // 1_000_000 + 1):
            start, along = part[:, 0], part[:, 1] - part[:, 0]
            out = points[:, None] - start
            share = (out * along).sum(axis=2) / np.maximum((along**2).sum(axis=1), 1e-300)
            out -= np.clip(share, 0, 1)[..., None] * along
            least = np.minimum(least, (out**2).sum(axis=2).min(axis=1, initial=np.inf))
        return np.sqrt(least)

    def world(self, flat: np.ndarray, height: np.ndarray) -> np.ndarray:
        """Points over places, (..., 2) and (...): (..., 3)."""
        return self.origin + np.concatenate([flat, height[..., None]], axis=-1) @ self.axes


def _candidates(grid: _Grid, bodies: tuple[Body, Body]) -> tuple[np.ndarray, np.ndarray]:
    """Places on the cap inside of both pieces, (k, 2), and how far the rims are; the deepest one first."""
    flat, step = grid.places()
    flat, room = _with_room(grid, bodies, np.concatenate([flat, np.zeros((1, 2))]))
    around = np.stack(np.meshgrid(*[np.arange(-2, 3)] * 2, indexing="ij"), axis=-1).reshape(-1, 2)
    for _ in range(_FINER):
        if not len(flat):
            break
        step /= 3
        finer, deeper = _with_room(grid, bodies, flat[rounded(room).argmax()] + step * around)
        flat, room = np.concatenate([finer, flat]), np.concatenate([deeper, room])
    order = np.argsort(-rounded(room), kind="stable")
    return flat[order], room[order]


def _with_room(grid: _Grid, bodies: tuple[Body, Body], flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Those of some places that are on the cap and, beside it, inside of both pieces, and how far the rims are."""
    low, high = grid.heights(flat)
    on = np.isfinite(low)
    flat, low, high = flat[on], low[on], high[on]
    beside = 1e-3 * grid.size
    both = (bodies[0].inside(grid.world(flat, low - beside)) & bodies[1].inside(grid.world(flat, high + beside)))
    return flat[both], grid.depth(grid.world(flat[both], ((low + high) / 2)[both]))


@dataclass(frozen=True, eq=False)
class _Room:
    """Places of a cap for joints.

    bodies : the two pieces. flat, room : (k, 2) and (k,), see _candidates.
    """

    grid: _Grid
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
        low, high = _under(self.grid, flat, reach)
        depth = self._depth(_Trial(self.grid, flat, reach, wall), low, high, radius, into)
        good = np.flatnonzero(depth >= 0)
        chosen = good[_packed(flat[good], room[good], count, 2 * reach + wall)]
        return self._made(flat[chosen], low[chosen], high[chosen], depth[chosen], radius, into)

    def _depth(self, trial: _Trial, low: np.ndarray, high: np.ndarray, radius: float, into: int) -> np.ndarray:
        """How deep a joint can be at each of some places, (k,) float64; -1 where it cannot be.

        low, high : (k,), of the cap under the joint; nan if it does not go so far.
        """
        wanted, bodies, sign = self.wanted, self.bodies, 1.0 if into else -1.0
        deep, least = (wanted.depth, wanted.depth) if wanted.depth else (
            radius * np.array(_DEPTH.get(wanted.kind, _DEEP))).tolist()
        start, end = (low, high) if into else (high, low)
        free = trial.is_free(bodies, low, high)
        depth = trial.depth(bodies[into], end, sign, deep + wanted.clearance) - wanted.clearance
        if wanted.kind.both_sides:
            depth = np.minimum(depth, trial.depth(bodies[1 - into], start, -sign, deep + wanted.clearance)
                               - wanted.clearance)
        else:
            free &= trial.holds(bodies[1 - into], start, -sign, _FOOT * radius)
        return np.where(np.isfinite(low) & (depth >= least * (1 - 1e-9)) & free, depth, -1.0)

    def _made(self, flat: np.ndarray, low: np.ndarray, high: np.ndarray, depth: np.ndarray, radius: float,
              into: int) -> tuple[Joint, ...]:
        """Joints at the places chosen, all as deep as the least deep can be. low, high, depth : (k,), see _depth."""
        deep = float(depth.min(initial=np.inf))
        foot = deep if self.wanted.kind.both_sides else _FOOT * radius
        axes = self.grid.axes if into else self.grid.axes * [[1], [-1], [-1]]
        ends = np.sort([low, high] if into else [-low, -high], axis=0)
        return tuple(Joint(self.grid.world(place, np.zeros(())), axes, radius, first, last, deep, foot)
                     for place, first, last in zip(flat, *ends.tolist(), strict=True))


def _under(grid: _Grid, flat: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """The lowest and the highest place of the cap under the disks around places; nan if it does not go so far."""
    low, high = grid.heights((flat[:, None] + _disk(reach)).reshape(-1, 2))
    return low.reshape(len(flat), -1).min(axis=1), high.reshape(len(flat), -1).max(axis=1)


def _disk(radius: float) -> np.ndarray:
    """The middle, eight places around it half way out, and sixteen at the rim of a disk, (25, 2) float64."""
    inner, outer = (2 * np.pi * np.arange(n) / n for n in (8, 16))
    return np.concatenate([[[0.0, 0.0]], radius / 2 * np.stack([np.cos(inner), np.sin(inner)], axis=1),
                           radius * np.stack([np.cos(outer), np.sin(outer)], axis=1)])


@dataclass(frozen=True, eq=False)
class _Trial:
    """Disks of some places, and the wall around them."""

    grid: _Grid
    flat: np.ndarray
    reach: float
    wall: float

    def depth(self, body: Body, height: np.ndarray, sign: float, deepest: float) -> np.ndarray:
        """How far the disks can go into a piece from some heights before the wall is too thin, (k,) float64."""
        share = np.arange(1, _LEVELS + 1) / _LEVELS
        levels = height[:, None] + sign * deepest * np.concatenate([[1e-3], share])
        fine = self._walled(body, levels)
        fine &= self._inside(body, levels[:, :1])
        reached = np.cumprod(fine, axis=1).sum(axis=1)
        return np.where(reached > 1, deepest * share[np.maximum(reached, 2) - 2], 0.0)

    def is_free(self, bodies: tuple[Body, Body], low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Whether the surfaces of both pieces stay clear of the disks from one height to another, (k,) bool."""
        levels = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, 3)
        return (self._walled(bodies[0], levels) & self._walled(bodies[1], levels)).all(axis=1)

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
    few = np.arange(len(flat)) if count < 3 else np.arange(0, len(flat), len(flat) // 32 + 1)
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
    kept = np.arange(len(groups))
    for value in (most, between):
        kept = kept[value[kept] >= _NEARLY * value[kept].max()]
    off = np.linalg.norm(flat[groups[kept]].mean(axis=1), axis=1)
    return groups[kept[rounded(off).argmin()]]
