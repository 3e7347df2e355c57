# SPDX-License-Identifier: GPL-3.0-or-later
"""In which part each vertex is, and where curves cross edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.int64 import full
from ...arrays.pairs import both_ways
from ...steps import Steps, stretched
from .band import Band
from .pins import Pins, are_between
from .planes import planes_of
from .shares import Diffusion, diffusing

# A cut as near to a vertex as such a share of the edge goes through the vertex; in a plane, as the second says, in one
# that was asked for, as the third.
SNAP, SNAP_IN_PLANE, SNAP_IN_ASKED_PLANE = 0.15, 0.02, 0.002
AWAY = 0.02  # share of the edge that a curve stays away from a vertex where it cannot go through it, at most


@dataclass(frozen=True, eq=False)
class Sides:
    """In which part each vertex is, and where curves cross edges.

    Attributes
    ----------
    low, high : (v,) int64
        The label of the vertex; two labels if a curve goes through it.
    share : (e,) float64
        Where a curve crosses the edge; nan where none does.
    plane : (v,) int64
        Number of the plane of the curve nearby, -1 for none.
    """

    low: np.ndarray
    high: np.ndarray
    share: np.ndarray
    plane: np.ndarray


def sides_of(band: Band, diffusion: Diffusion, pins: Pins, steps: int, reach: int = 0) -> Steps[Sides]:
    """Find the sides of smooth curves after so many steps of diffusion; in steps.

    reach : int, planes are taken, too, for bent curves that leave them by up to so many edges.
    """
    shares = yield from stretched(diffusing(band, diffusion, pins, steps), 0.0, 0.7)
    yield 0.7
    top = shares.top
    a, b = band.table.edges.T
    share = np.full(len(a), np.nan)
    apart = np.flatnonzero(top[a] != top[b])
    share[apart] = shares.crossing(band.table.edges[apart])
    yield 0.8
    planes = planes_of(band, top, share, reach or steps, reach > 0)
    top = np.where(planes.is_near, planes.label, top)
    flat = (planes.number[a] >= 0) & (planes.number[a] == planes.number[b])
    gap = planes.height[a] - planes.height[b]
    along = np.divide(planes.height[a], gap, out=np.full(len(a), 0.5), where=gap != 0)
    share = np.where(top[a] != top[b], np.where(flat, along, share), np.nan)
    return _snapped(band, pins, top, share, np.where(flat, SNAP_IN_ASKED_PLANE if reach else SNAP_IN_PLANE, SNAP),
                    planes.number)


def _snapped(band: Band, pins: Pins, top: np.ndarray, share: np.ndarray, near: np.ndarray,
             plane: np.ndarray) -> Sides:
    """Let a curve go through the vertices that it passes closely, if only two parts are there.

    near : (e,) float64, how closely.
    """
    n = len(band.vertices)
    a, b = band.table.edges.T
    apart = top[a] != top[b]
    start, end = both_ways(band.table.edges[apart]).T
    least, most = full(n, len(band.names)), full(n, -1)
    np.minimum.at(least, start, top[end])
    np.maximum.at(most, start, top[end])
    close = np.zeros(n, bool)
    with np.errstate(invalid="ignore"):
        close[a[share < near]] = True
        close[b[share > 1 - near]] = True
    through = close & (least == most)
    low = np.where(through, np.minimum(top, least), top)
    high = np.where(through, np.maximum(top, most), top)
    low[pins.vertex], high[pins.vertex] = np.where(are_between(band, pins, top)[:, None], pins.pair,
                                                   top[pins.vertex][:, None]).T
    meet = (low[a] == low[b]) | (low[a] == high[b]) | (high[a] == low[b]) | (high[a] == high[b])
    least = np.minimum(near, AWAY)
    share = np.where(meet, np.nan, share.clip(least, 1 - least))
    return Sides(low, high, share, plane)
