# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls of parts, as games and simulations collide with them.

A part that its hull fits badly - a bent limb, a handle, a bowl - can have several: it is divided by planes across its
principal axes, each time where the volume of the hulls becomes least.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from ...arrays.components import components
from ...arrays.indexing import renumbered, rounded_order, stable_order
from ...arrays.int64 import arange
from ...arrays.pairs import distinct_pairs
from ...arrays.vectors import cross, distances_between, inner_products, middles_of_each, second_moments
from ...mesh.corners import CornerTable
from ...surface.ordering import principal_axes

#: How many corners a hull has at most; game engines take 255, and are faster with fewer.
MOST_CORNERS = 64
# A part that is flat but for its rounding, below the first share of its extent, gets a hull as thick as the second.
_FLAT, _THIN = 1e-4, 0.01
# Planes that are tried for each axis are at the ends of so many slabs of equal width.
_SLABS = 16
# A part is divided further only where that takes off this share of its hulls, and as long as these are so much larger
# than the part.
_GAIN, _CLOSE = 0.01, 1.05
# Where two halves take off less than this share, quarters are tried.
_VAIN = 0.1


@dataclass(frozen=True, eq=False)
class Hull:
    """A closed convex surface.

    Attributes
    ----------
    vertices : (k, 3) float64
        In units of the mesh.
    triangles : (m, 3) int64
        Counterclockwise seen from outside.
    """

    vertices: np.ndarray
    triangles: np.ndarray

    @property
    def volume(self) -> float:
        """What it encloses, in cubed units of the mesh."""
        a, b, c = (self.vertices - self.vertices.mean(axis=0))[self.triangles].transpose(1, 0, 2)
        return float((a * cross(b, c)).sum()) / 6


def part_hulls(table: CornerTable, labels: np.ndarray, per_part: int = 1) -> list[tuple[Hull, ...]]:
    """Make the convex hull of each part, or several that fit it better.

    Parameters
    ----------
    table : CornerTable
        p faces.
    labels : (p,) int64
        Part of each face, 0..count-1, all in use.
    per_part : int
        How many hulls a part has at most.

    Returns
    -------
    hulls : list of tuple of Hull
        One or several for each part, in which all of it lies, but for what MOST_CORNERS leaves out. A part that lies in
        a plane, on a line or in a point has a thin one.
    """
    size = table.diagonal or 1.0
    closed, part = _closed(table, labels)
    order = stable_order(part)
    groups = np.split(closed.triangles[order], np.flatnonzero(np.diff(part[order])) + 1)
    volumes = _volumes(closed, part) if per_part > 1 else np.zeros(len(groups))  # which one hull alone does not ask for
    hulls = []
    for triangles, volume in zip(groups, volumes.tolist(), strict=True):
        pieces = _divided(_Surface(closed.points, triangles).used(), per_part, volume)
        hulls.append(tuple(_hull(_solid(piece.points, size)) for piece in pieces))
    return hulls


def part_volumes(table: CornerTable, labels: np.ndarray) -> np.ndarray:
    """Measure what each part encloses if its holes are closed by fans around the middle of their rims.

    Parameters
    ----------
    table : CornerTable
        p faces.
    labels : (p,) int64
        Part of each face, 0..count-1.

    Returns
    -------
    volume : (count,) float64
        In cubed units of the vertices; less than 0 for a part that is inside out.
    """
    return _volumes(*_closed(table, labels))


@dataclass(frozen=True, eq=False)
class _Surface:
    """Points, (n, 3), and triangles of them, (k, 3)."""

    points: np.ndarray
    triangles: np.ndarray

    def used(self) -> _Surface:
        """Without the points of no triangle."""
        used, triangles = renumbered(self.triangles)
        return _Surface(self.points[used], triangles)

    @property
    def volume(self) -> float:
        """Volume of its hull."""
        return float(_growing([self.points])[0])


def _closed(table: CornerTable, labels: np.ndarray) -> tuple[_Surface, np.ndarray]:
    """The triangles of all faces, and for each rim of a part a fan around its middle; the part of each."""
    triangles, face = table.fans()
    start, end = table.corner_vertex, table.corner_vertex[table.next_corner]
    part = labels[table.corner_face]
    edge = distinct_pairs(np.minimum(start, end), np.maximum(start, end))[1]
    side = distinct_pairs(part, edge)[1]
    # Inside of a part, faces go along an edge in both directions. The fan goes along a rim against its faces.
    rim = np.bincount(side, np.where(start < end, 1.0, -1.0))[side] != 0
    start, end, rim_part = end[rim], start[rim], part[rim]
    if not len(start):
        return _Surface(table.vertices, triangles), labels[face]
    first, second = distinct_pairs(np.tile(rim_part, 2), np.append(start, end))[1].reshape(2, -1)
    count, loop = components(int(max(first.max(), second.max())) + 1, first, second)
    loop = loop[first]
    length = distances_between(table.vertices, end, start) + np.finfo(float).tiny
    _, middle = middles_of_each(loop, 0.5 * (table.vertices[start] + table.vertices[end]), length, count)
    fans = np.stack([start, end, len(table.vertices) + loop], axis=1)
    surface = _Surface(np.concatenate([table.vertices, middle]), np.concatenate([triangles, fans]))
    return surface, np.append(labels[face], rim_part)


def _volumes(closed: _Surface, part: np.ndarray) -> np.ndarray:
    """What the parts of a surface enclose, (count,)."""
    a, b, c = (closed.points - closed.points[closed.triangles[:, 0]].mean(axis=0))[closed.triangles].transpose(1, 0, 2)
    return np.bincount(part, (a * cross(b, c)).sum(axis=1)) / 6


def _divided(part: _Surface, most: int, volume: float) -> list[_Surface]:
    """Divide a part, whose volume is given, for at most so many hulls."""
    pieces, splits = [part], [_UNKNOWN]
    total = part.volume if most > 1 else 0.0
    while len(pieces) < most and total > _CLOSE * abs(volume):
        room = most - len(pieces)
        splits = [_best_split(piece, room) if split is _UNKNOWN or split.more > room else split
                  for piece, split in zip(pieces, splits, strict=True)]
        best = int(np.argmax([split.gain_each for split in splits]))
        if splits[best].gain <= _GAIN * total:
            break
        total -= splits[best].gain
        made = _cut(pieces[best], splits[best].planes)
        pieces[best : best + 1], splits[best : best + 1] = made, [_UNKNOWN] * len(made)
    return pieces


@dataclass(frozen=True, eq=False)
class _Split:
    """Planes that divide a piece, each a normal and a level along it, and the volume that its hulls lose."""

    gain: float
    planes: tuple[tuple[np.ndarray, float], ...]

    @property
    def more(self) -> int:
        """How many pieces more there are after it: one plane makes two of one, two planes four."""
        return 2 ** len(self.planes) - 1

    @property
    def gain_each(self) -> float:
        """Gain for each piece more."""
        return self.gain / max(self.more, 1)


_UNKNOWN = _Split(0.0, ())


def _best_split(piece: _Surface, room: int) -> _Split:
    """Where to divide a piece into two, or into four where there is room for three more and two would be in vain."""
    center = piece.points.mean(axis=0)
    axes = principal_axes(second_moments(piece.points - center, np.ones(len(piece.points))), piece.points - center)
    whole = piece.volume
    best = _Split(0.0, ((axes[0], float(center @ axes[0])),))
    for axis in axes:
        height = piece.points @ axis
        levels = np.linspace(height.min(), height.max(), _SLABS + 1)
        slabs = _slabs(piece, height, levels[1:-1])
        loss = whole - (_growing(slabs)[:-1] + _growing(slabs[::-1])[::-1][1:])
        place = int(np.argmax(loss))
        if loss[place] > best.gain:
            best = _Split(float(loss[place]), ((axis, float(levels[place + 1])),))
    if room >= 3 and best.gain <= _VAIN * whole:
        # Half a bowl has a hull of half the size: only quarters of it are smaller.
        for first, second in ((0, 1), (0, 2), (1, 2)):
            planes = tuple((axis, float(center @ axis)) for axis in (axes[first], axes[second]))
            loss = whole - sum(quarter.volume for quarter in _cut(piece, planes))
            quarters = _Split(float(loss), planes)
            if quarters.gain_each > best.gain_each:
                best = quarters
    return best


def _slabs(piece: _Surface, height: np.ndarray, levels: np.ndarray) -> list[np.ndarray]:
    """Points that span what lies between each two levels: its points, and where edges cross the levels."""
    directions = _directions(MOST_CORNERS).T
    place = np.searchsorted(levels, height)
    order = stable_order(place)
    slabs = np.split(piece.points[order], np.searchsorted(place[order], arange(1, len(levels) + 1)))
    start, end = piece.triangles.ravel(), np.roll(piece.triangles, -1, axis=1).ravel()
    # Of an edge that two triangles go along, one direction is enough.
    rising = place[start] < place[end]
    start, end = start[rising], end[rising]
    for index, level in enumerate(levels.tolist()):
        crossing = (place[start] <= index) & (place[end] > index)
        points = _between(piece.points, height, start[crossing], end[crossing], level)
        slabs[index], slabs[index + 1] = (np.concatenate([slab, points]) for slab in slabs[index : index + 2])
    return [slab[np.unique((slab @ directions).argmax(axis=0))] if len(slab) > MOST_CORNERS else slab for slab in slabs]


def _between(points: np.ndarray, height: np.ndarray, start: np.ndarray, end: np.ndarray, level: float) -> np.ndarray:
    """Where edges, given by their ends, (k,), cross a level, (k, 3)."""
    share = ((level - height[start]) / (height[end] - height[start]))[:, None]
    return (1 - share) * points[start] + share * points[end]


def _cut(piece: _Surface, planes: tuple[tuple[np.ndarray, float], ...]) -> list[_Surface]:
    """A piece on all sides of some planes; triangles that cross one are divided. Nothing that is empty."""
    pieces = [piece]
    for axis, level in planes:
        pieces = [_below(piece, sign * axis, sign * level) for piece in pieces for sign in (1.0, -1.0)]
    return [piece for piece in pieces if len(piece.triangles)]


def _below(piece: _Surface, axis: np.ndarray, level: float) -> _Surface:
    """The side of a piece that looks away from the normal of a plane; open where it is cut."""
    height, points = piece.points @ axis, piece.points
    inside = height[piece.triangles] <= level
    found = [piece.triangles[inside.all(axis=1)]]
    for count, corners in ((1, [[0, 3, 4]]), (2, [[1, 2, 3], [2, 4, 3]])):
        # The corner that is alone on its side comes first; 3 and 4 are where the sides from it cross the plane.
        crossed = np.flatnonzero(inside.sum(axis=1) == count)
        alone = (inside[crossed] == (count == 1)).argmax(axis=1)
        a, b, c = (piece.triangles[crossed, (alone + k) % 3] for k in range(3))
        first = len(points) + arange(len(crossed))
        points = np.concatenate([points, *(_between(piece.points, height, a, other, level) for other in (b, c))])
        every = np.stack([a, b, c, first, first + len(crossed)], axis=1)
        found += [every[:, corner] for corner in corners]
    return _Surface(points, np.concatenate(found)).used()


def _growing(slabs: list[np.ndarray]) -> np.ndarray:
    """Volume of the hull of the first slab, of the first two, ..., (len(slabs),)."""
    volumes, points = [], np.empty((0, 3))
    for slab in slabs:
        points = np.concatenate([points, slab])
        try:
            found = ConvexHull(points)
        except (QhullError, ValueError):  # in a plane, or fewer than four
            volumes.append(0.0)
            continue
        points = points[found.vertices]
        volumes.append(float(found.volume))
    return np.array(volumes)


def _hull(points: np.ndarray) -> Hull:
    """The hull of points that do not lie in a plane; of more than MOST_CORNERS corners, that of the outermost."""
    middle = points.mean(axis=0)
    scale = np.abs(points - middle).max()
    found = ConvexHull((points - middle) / scale)
    if len(found.vertices) > MOST_CORNERS:
        corners = points[found.vertices]
        return _hull(corners[_outermost(_as_round(corners))])
    used, triangles = renumbered(found.simplices)
    a, b, c = points[found.simplices].transpose(1, 0, 2)
    inward = (cross(b - a, c - a) * found.equations[:, :3]).sum(axis=1) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return Hull(points[used], triangles.astype(np.int64))


def _as_round(points: np.ndarray) -> np.ndarray:
    """Points, (n, 3), around their middle, shortened along their length and width: as far out each way on average.

    Hulls stay hulls with the same shares of the volume.
    """
    offset = points - points.mean(axis=0)
    spread, axes = np.linalg.eigh(second_moments(offset, np.full(len(points), 1 / len(points))))
    return offset @ (axes / np.sqrt(spread.clip(1e-12 * spread.max()))) @ axes.T


def _outermost(corners: np.ndarray) -> np.ndarray:
    """MOST_CORNERS of the corners of a hull, (k, 3), or fewer, whose own hull has nearly its volume; their places.

    Half of them are outermost in directions that are spread evenly, of which several may have the same corner. Then,
    again and again, those follow that are farthest outside the hull of those found, a quarter of what lacks at a time.
    """
    kept = np.unique((_directions(MOST_CORNERS // 2) @ corners.T).argmax(axis=1))
    while len(kept) < MOST_CORNERS and len(beyond := _beyond(corners, kept)):
        kept = np.append(kept, beyond[: -(-(MOST_CORNERS - len(kept)) // 4)])
    return kept


def _beyond(corners: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """The corners, of (k, 3), that are farthest outside of the faces of the hull of some: (j,) int64, falling."""
    try:
        found = ConvexHull(corners[kept])
    except QhullError:  # they lie in a plane, but for rounding
        return np.empty(0, np.int64)
    height = inner_products(corners, found.equations[:, :3]) + found.equations[:, 3]
    height[kept] = 0.0
    farthest, most = height.argmax(axis=0), height.max(axis=0)
    order = rounded_order(-most)
    order = order[most[order] > 1e-9 * np.abs(corners).max()]
    return farthest[order[np.sort(np.unique(farthest[order], return_index=True)[1])]]


def _solid(points: np.ndarray, size: float) -> np.ndarray:
    """Points that do not lie in a plane: those given, moved to both sides where they are flat. size : of the model."""
    middle = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - middle, full_matrices=len(points) < 3)
    extent = np.ptp((points - middle) @ axes.T, axis=0)
    own = extent.max() or size  # a point has none
    for axis, thickness in zip(axes, extent.tolist(), strict=True):
        if thickness < _FLAT * own:
            points = np.concatenate([points + 0.5 * _THIN * own * axis, points - 0.5 * _THIN * own * axis])
    return points


def _directions(count: int) -> np.ndarray:
    """Directions that are spread evenly over the sphere, (count, 3), on a spiral."""
    place = arange(count) + 0.5
    height, angle = 1 - 2 * place / count, np.pi * (1 + np.sqrt(5)) * place
    radius = np.sqrt(1 - height**2)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1)
