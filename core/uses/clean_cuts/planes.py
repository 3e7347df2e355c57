# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes in place of curves that they fit."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import largest_of_each, place_among, sums_by
from ...arrays.int64 import full
from ...arrays.pairs import both_ways
from ...arrays.vectors import middles_of_each, second_moments_of_each
from .band import Band

# A plane fits if no point of a curve is farther from it than so many edges and such a share of the curve's radius; if
# planes are asked for, than such a larger share.
PLANE_EDGES, PLANE_RADIUS, BENT_RADIUS = 0.25, 0.04, 0.6
# A curve has a plane if it has so many points and is no line: the square of its width is so much of that of its length.
FEWEST_POINTS, LEAST_WIDTH = 6, 0.01


@dataclass(frozen=True, eq=False)
class Planes:
    """Planes that curves lie in, near these curves.

    Attributes
    ----------
    number : (v,) int64
        Plane of the curve near each vertex, -1 for none.
    height : (v,) float64
        Distance of the vertex from it, with sign.
    above, below : (v,) int64
        Labels on the sides where the height is above 0, and where it is not.
    """

    number: np.ndarray
    height: np.ndarray
    above: np.ndarray
    below: np.ndarray

    @property
    def is_near(self) -> np.ndarray:
        """(v,) bool, whether a vertex is near a curve with a plane."""
        return self.number >= 0

    @property
    def label(self) -> np.ndarray:
        """(v,) int64, the label on the side of the plane where each vertex lies."""
        return np.where(self.height > 0, self.above, self.below)


def planes_of(band: Band, top: np.ndarray, share: np.ndarray, steps: int, bent: bool = False) -> Planes:
    """Find the curves that a plane fits, and the vertices for which it decides.

    bent : bool, planes are taken for curves, too, that leave them by up to half of their radius.
    """
    n = len(band.vertices)
    crossed = np.flatnonzero(~np.isnan(share))
    if not len(crossed):
        none = full(n, -1)
        return Planes(none, np.zeros(n), none, none)
    curve = _curves(band, crossed)
    count = curve.max() + 1
    center, normal, away, fits = _nearest_planes(band, crossed, share[crossed], curve, bent)
    pair = np.sort(top[band.table.edges[crossed]], axis=1)
    low, high = full((count, 2), len(band.names)), full((count, 2), -1)
    np.minimum.at(low, curve, pair)
    np.maximum.at(high, curve, pair)
    fits &= (low == high).all(axis=1)
    rings = np.where(fits, np.ceil(away).clip(max=steps) + 2, 0).astype(np.int64)
    number, ring = _owners(band, crossed, curve, rings)
    height = ((band.table.vertices - center[number]) * normal[number]).sum(axis=1)
    planes = _with_sides(Planes(number, height, low[number, 0], low[number, 1]), top, count)
    beside_others = _in_conflict(band, planes, top, count) if bent else _near_each_other(band, planes, count)
    wrong = (~fits | beside_others | _contradicted(planes, top, ring == rings[number], count)
             | _crossing(band, crossed, curve, planes, count))
    return replace(planes, number=np.where(planes.is_near & ~wrong[number], number, -1))


def _curves(band: Band, crossed: np.ndarray) -> np.ndarray:
    """Number of the curve that each of some crossed edges is on, 0..; curves go on across faces."""
    table = band.table
    place = place_among(crossed, len(band.edges))
    corner = np.flatnonzero(place[table.corner_edge] >= 0)
    point, face = place[table.corner_edge[corner]], table.corner_face[corner]
    same = face[1:] == face[:-1]
    return components(len(crossed), point[1:][same], point[:-1][same])[1]


def _nearest_planes(
    band: Band, crossed: np.ndarray, share: np.ndarray, curve: np.ndarray, bent: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """The plane nearest to each curve, and whether it fits.

    crossed, share, curve : (c,), edges that curves cross, where, and which curve does. Returns a point of each plane,
    its normal, (curves, 3), how many edges the curve goes away from it, (curves,) float64, and whether it fits.
    """
    count = curve.max() + 1
    start, end = band.table.vertices[band.table.edges[crossed]].transpose(1, 0, 2)
    point = start + share[:, None] * (end - start)
    n_points, center = middles_of_each(curve, point, np.ones(len(point)), count)
    offset = point - center[curve]
    moments = second_moments_of_each(curve, offset, np.ones(len(point)), count)
    size, axes = np.linalg.eigh(moments / n_points[:, None, None])
    normal = axes[:, :, 0]
    length = sums_by(curve, band.table.edge_length(crossed), count) / n_points
    away = largest_of_each(curve, np.abs((offset * normal[curve]).sum(axis=1)), count)
    fits = (size[:, 1] > LEAST_WIDTH * size[:, 2]) & (n_points >= FEWEST_POINTS)
    fits &= away <= PLANE_EDGES * length + (BENT_RADIUS if bent else PLANE_RADIUS) * np.sqrt(size.sum(axis=1).clip(0))
    return center, normal, away / np.maximum(length, 1e-300), fits


def _owners(band: Band, crossed: np.ndarray, curve: np.ndarray, rings: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The curve that each vertex is near, -1 for none, and how many edges away it is; (v,) int64 each.

    rings : (curves,) int64, how many edges each curve reaches; one of 0 has no vertices but those at its edges.
    """
    number, ring = full(len(band.vertices), -1), np.zeros(len(band.vertices), np.int64)
    number[band.table.edges[crossed]] = curve[:, None]
    start, end = both_ways(band.table.edges).T
    for step in range(1, int(rings.max(initial=0)) + 1):
        here = (number[start] >= 0) & (number[end] < 0)
        here[here] = (ring[start[here]] == step - 1) & (rings[number[start[here]]] >= step)
        # Of several curves that come to a vertex at once, the first.
        reached, owner = end[here], number[start[here]]
        order = np.lexsort((-owner, reached))
        number[reached[order]] = owner[order]
        ring[reached] = step
    return number, ring


def _with_sides(planes: Planes, top: np.ndarray, count: int) -> Planes:
    """The planes with heights above 0 on that side where most vertices of the smaller label are.

    top : (v,), label of each vertex. count : of curves.
    """
    near, number = planes.is_near, planes.number
    lean = np.where(top == planes.above, 1.0, -1.0) * np.sign(planes.height)
    sign = np.where(sums_by(number[near], lean[near], count) < 0, -1.0, 1.0)
    return replace(planes, height=np.where(near, planes.height * sign[number], 0.0))


def _contradicted(planes: Planes, top: np.ndarray, at_rim: np.ndarray, count: int) -> np.ndarray:
    """Curves, (count,) bool, near whose planes labels are none of the two, or at the rim not as the plane says.

    top, at_rim : (v,), label of each vertex, and whether a vertex is as far from the curve as its plane reaches.
    """
    strange = ((top != planes.above) & (top != planes.below)) | (at_rim & (top != planes.label))
    wrong = np.zeros(count, bool)
    wrong[planes.number[planes.is_near & strange]] = True
    return wrong


def _near_each_other(band: Band, planes: Planes, count: int) -> np.ndarray:
    """Curves, (count,) bool, whose planes decide for vertices beside those of other planes."""
    a, b = band.table.edges[_between_planes(band, planes)].T
    near = np.zeros(count, bool)
    near[planes.number[a]] = near[planes.number[b]] = True
    return near


def _in_conflict(band: Band, planes: Planes, top: np.ndarray, count: int) -> np.ndarray:
    """Curves, (count,) bool, whose planes say near those of others what the labels, (v,), are not without them."""
    a, b = band.table.edges[_between_planes(band, planes)].T
    wrong = planes.is_near & (top != planes.label)
    conflict = np.zeros(count, bool)
    for end, other_end in ((a, b), (b, a)):
        conflict[planes.number[end[wrong[end] | (top[end] != top[other_end])]]] = True
    return conflict


def _between_planes(band: Band, planes: Planes) -> np.ndarray:
    """Edges, (e,) bool, from a vertex near one plane to a vertex near another."""
    a, b = band.table.edges.T
    return planes.is_near[a] & planes.is_near[b] & (planes.number[a] != planes.number[b])


def _crossing(band: Band, crossed: np.ndarray, curve: np.ndarray, planes: Planes, count: int) -> np.ndarray:
    """Curves, (count,) bool, at an edge with an end near the plane of another: both.

    crossed, curve : (c,), edges that curves cross, and which curve does.
    """
    number = planes.number[band.table.edges[crossed]]
    other = number != curve[:, None]
    both = np.zeros(count, bool)
    both[number[other]] = True
    both[curve[other.any(axis=1)]] = True
    return both
