# SPDX-License-Identifier: GPL-3.0-or-later
"""What two pieces have in common at a cut, and how it looks along its axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...arrays.int64 import arange
from ...arrays.ties import rounded
from ...arrays.vectors import cross_in_plane

if TYPE_CHECKING:
    from ...graph.reeb import ReebGraph

# A cap that is so bent that less than this share of its area looks along the axis has no axis to speak of.
_STRAIGHT = 0.6
# Of its size: what is not farther from the middle of a cap is in the middle, but for rounding.
_SAME = 1e-9
# How many places on a cap are looked at, and along its longer side.
_PLACES, _ALONG = 400, 64


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


def cap_axes(cap: Cap, along: np.ndarray | None) -> np.ndarray | None:
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


class CapGrid:
    """A cap seen along its axis, and how high it lies over each place.

    Parameters
    ----------
    cap : Cap
    axes : (3, 3) float64
        See cap_axes.
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
        count = np.maximum(np.ceil((high - low) / step).astype(np.int64), 1)
        lines = [(low[i] + high[i]) / 2 + step * (arange(count[i]) - (count[i] - 1) / 2) for i in (0, 1)]
        return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 2), step

    def heights(self, flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The lowest and the highest place of the cap over places, (k, 2): two (k,) float64, nan beside the cap."""
        low, high = np.empty(len(flat)), np.empty(len(flat))
        a, b, c = self.seen.transpose(1, 0, 2)
        twice = cross_in_plane(b - a, c - a)
        solid = np.abs(twice) > 1e-12 * self.size**2
        a, b, c, twice = a[solid], b[solid], c[solid], twice[solid]
        for part in np.array_split(arange(len(flat)), len(flat) * len(a) // 1_000_000 + 1):
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
