# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes in place of curves that they fit."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...surface.arrays import components, sums_by
from .band import Band

# A plane fits if no point of a curve is farther from it than so many edges and such a share of the curve's radius; if
# planes are asked for, than such a larger share.
PLANE_EDGES, PLANE_RADIUS, BENT_RADIUS = 0.25, 0.04, 0.6


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


def planes_of(band: Band, top: np.ndarray, share: np.ndarray, steps: int, bent: bool = False) -> Planes:
    """Find the curves that a plane fits, and the vertices for which it decides.

    bent : bool, planes are taken for curves, too, that leave them by up to half of their radius.
    """
    n = len(band.vertices)
    crossed = np.flatnonzero(~np.isnan(share))
    if not len(crossed):
        none = np.full(n, -1)
        return Planes(none, np.zeros(n), none, none)
    curve = _curves(band, crossed)
    count = curve.max() + 1
    a, b = band.ends[crossed].T
    point = band.points[a] + share[crossed, None] * (band.points[b] - band.points[a])
    center = sums_by(curve, point, count) / np.bincount(curve, minlength=count)[:, None]
    offset = point - center[curve]
    moments = sums_by(curve, (offset[:, :, None] * offset[:, None]).reshape(-1, 9), count).reshape(-1, 3, 3)
    size, axes = np.linalg.eigh(moments / np.bincount(curve)[:, None, None])
    normal = axes[:, :, 0]
    length = sums_by(curve, band.edge_length[crossed], count) / np.bincount(curve)
    away = np.zeros(count)
    np.maximum.at(away, curve, np.abs((offset * normal[curve]).sum(axis=1)))
    pair = np.sort(np.stack([top[a], top[b]], axis=1), axis=1)
    low, high = np.full((count, 2), len(band.names)), np.full((count, 2), -1)
    np.minimum.at(low, curve, pair)
    np.maximum.at(high, curve, pair)
    fits = (low == high).all(axis=1) & (size[:, 1] > 0.01 * size[:, 2]) & (np.bincount(curve) >= 6)
    fits &= away <= PLANE_EDGES * length + (BENT_RADIUS if bent else PLANE_RADIUS) * np.sqrt(size.sum(axis=1).clip(0))
    rings = np.where(fits, np.ceil(away / np.maximum(length, 1e-300)).clip(max=steps) + 2, 0).astype(np.int64)
    number, ring = _owners(band, crossed, curve, rings)
    height = ((band.points - center[number]) * normal[number]).sum(axis=1)
    planes = Planes(number, height, low[number, 0], low[number, 1])
    return _valid(band, top, crossed, curve, planes, ring, rings, fits, bent)


def _curves(band: Band, crossed: np.ndarray) -> np.ndarray:
    """Number of the curve that each of some crossed edges is on, 0..; curves go on across faces."""
    place = np.full(len(band.edges), -1)
    place[crossed] = np.arange(len(crossed))
    corner = np.flatnonzero(place[band.corner_edge] >= 0)
    point, face = place[band.corner_edge[corner]], band.corner_face[corner]
    same = face[1:] == face[:-1]
    return components(len(crossed), point[1:][same], point[:-1][same])[1]


def _owners(band: Band, crossed: np.ndarray, curve: np.ndarray, rings: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The curve that each vertex is near, -1 for none, and how many edges away it is; (v,) int64 each.

    rings : (curves,) int64, how many edges each curve reaches; one of 0 has no vertices but those at its edges.
    """
    number, ring = np.full(len(band.vertices), -1), np.zeros(len(band.vertices), np.int64)
    number[band.ends[crossed]] = curve[:, None]
    start, end = np.concatenate([band.ends, band.ends[:, ::-1]]).T
    for step in range(1, int(rings.max(initial=0)) + 1):
        here = (number[start] >= 0) & (number[end] < 0)
        here[here] = (ring[start[here]] == step - 1) & (rings[number[start[here]]] >= step)
        # Of several curves that come to a vertex at once, the first.
        reached, owner = end[here], number[start[here]]
        order = np.lexsort((-owner, reached))
        number[reached[order]] = owner[order]
        ring[reached] = step
    return number, ring


def _valid(band: Band, top: np.ndarray, crossed: np.ndarray, curve: np.ndarray, planes: Planes, ring: np.ndarray,
           rings: np.ndarray, fits: np.ndarray, bent: bool) -> Planes:
    """The planes without those that go wrong: near another curve, or where labels beyond are not as the plane says."""
    number, height = planes.number, planes.height
    owned = number >= 0
    bad = ~fits
    # The side of each plane that is above is the one where most vertices of the smaller label are.
    lean = np.where(top == planes.above, 1.0, -1.0) * np.sign(height)
    sign = np.where(sums_by(number[owned], lean[owned], len(fits)) < 0, -1.0, 1.0)
    height = np.where(owned, height * sign[number], 0.0)
    strange = owned & (top != planes.above) & (top != planes.below)
    said = np.where(height > 0, planes.above, planes.below)
    strange |= owned & (ring == rings[number]) & (top != said)
    bad[number[strange]] = True
    a, b = band.ends.T
    meet = owned[a] & owned[b] & (number[a] != number[b])
    if bent:
        # Where two curves are near each other, each plane has to say there what the parts are without it.
        wrong = owned & (top != said)
        for end, other_end in ((a, b), (b, a)):
            bad[number[end[meet & (wrong[end] | (top[end] != top[other_end]))]]] = True
    else:
        bad[number[a[meet]]] = bad[number[b[meet]]] = True
    other = number[band.ends[crossed]] != curve[:, None]
    bad[number[band.ends[crossed]][other]] = True
    bad[curve[other.any(axis=1)]] = True
    number = np.where(owned & ~bad[number], number, -1)
    return replace(planes, number=number, height=height)
