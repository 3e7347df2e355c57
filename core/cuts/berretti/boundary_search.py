# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundary search of [Berretti2009] (section 3.2): each cut slides along its arc of the Reeb graph to a concavity."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ...arrays.components import components
from ...arrays.int64 import arange
from ...arrays.vectors import lengths
from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebTopology
from .contour_curves import ContourCurves, contour_curves

SAMPLES = 128  # number of points along a contour at which k_min is sampled
# With r the radius of a circle as long as the contour, E_concave = max(CREASE_WORTH * r * k_min, -MAX_WORTH), in units
# of the range of the field. A contour whose k_min is -1 / r is thus worth a move over a tenth of this range.
CREASE_WORTH = 0.1
MAX_WORTH = 0.3


def concavities(sets: LevelSets, k_min: np.ndarray, contours: np.ndarray, sigma: float) -> np.ndarray:
    """Compute E_concave of contours, eq. (9) of docs/method.md.

    k_min is sampled along the contour and smoothed by a Gaussian; its minimum is multiplied by the radius of a circle
    as long as the contour, so that it has no unit. [Berretti2009] leaves the scale open: CREASE_WORTH and MAX_WORTH
    were chosen here (docs/method.md, section 4).

    Parameters
    ----------
    sets : LevelSets
        n vertices.
    k_min : (n,) float64
        Smaller principal curvature at each vertex, 1 / unit of the vertices.
    contours : (k,) int64
        Indices of contours in ``sets``.
    sigma : float
        Standard deviation of the Gaussian, in units of the length of the contour; 0 does not smooth.

    Returns
    -------
    energy : (k,) float64
        In units of the range of the field, at least -MAX_WORTH; negative where a contour passes a concavity. 0 for
        a contour without length.
    """
    found = [_least_along(sets, k_min, curves, sigma) for curves in contour_curves(sets, contours)]
    relative = np.concatenate([np.empty(0), *found]) / (2 * np.pi)
    return np.maximum(CREASE_WORTH * relative, -MAX_WORTH)


def _least_along(sets: LevelSets, k_min: np.ndarray, curves: ContourCurves, sigma: float) -> np.ndarray:
    """Least smoothed k_min along each of k curves, times its length: (k,) float64."""
    smooth, total = _sampled(curves, curves.at_crossings(sets, sets.mesh.vertices), curves.at_crossings(sets, k_min))
    if sigma > 0:
        for chosen, mode in ((curves.closed, "wrap"), (~curves.closed, "nearest")):
            smooth[chosen] = gaussian_filter1d(smooth[chosen], sigma * SAMPLES, mode=mode)
    return smooth.min(axis=1) * total


def _sampled(curves: ContourCurves, points: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Values, (c,), at SAMPLES points along each of k curves: (k, SAMPLES) float64; and their lengths, (k,) float64."""
    following = arange(1, len(points) + 1)
    following[curves.start[1:] - 1] = curves.start[:-1]
    step = lengths(points[following] - points)
    smooth, total = np.empty((len(curves.closed), SAMPLES)), np.empty(len(curves.closed))
    bounds = zip(curves.start[:-1].tolist(), curves.start[1:].tolist(), curves.closed.tolist(), strict=True)
    for row, (start, stop, closed) in enumerate(bounds):
        along, steps = (values[start:stop], step[start: stop - 1])
        if closed:
            along, steps = np.append(along, along[0]), step[start:stop]
        arc_length = np.append(0.0, np.cumsum(steps))
        total[row] = arc_length[-1]
        smooth[row] = np.interp((arange(SAMPLES) + 0.5) / SAMPLES * total[row], arc_length, along)
    return smooth, total


def search_boundaries(
    sets: LevelSets,
    topology: ReebTopology,
    k_min: np.ndarray,
    piece_region: np.ndarray,
    concavity_weight: float,
    sigma: float,
) -> np.ndarray:
    """Move each cut along its arc of the Reeb graph to the level that minimizes eq. (8) of docs/method.md.

    All contours of the arc are tried, where [Berretti2009] descends a gradient. A cut never passes a node of the graph
    nor the middle between itself and the next cut on its arc.

    Parameters
    ----------
    sets : LevelSets
        n vertices, P slab pieces.
    topology : ReebTopology
        Reeb graph of ``sets``, simplified; its arcs limit the moves of the cuts.
    k_min : (n,) float64
        Smaller principal curvature at each vertex, 1 / unit of the vertices.
    piece_region : (P,) int64
        Region of each slab piece; the cuts are the contours between two regions.
    concavity_weight : float
        Weight of concavity, 0..1; the weight of the distance from the present level is 1 - concavity_weight.
    sigma : float
        Standard deviation of the Gaussian along a contour, in units of its length.

    Returns
    -------
    piece_region : (P,) int64
        Region of each slab piece, after the cuts have moved.

    Notes
    -----
    The concavity is computed once for each contour that a cut can reach, and of all of them at once.
    """
    lower, upper = piece_region[sets.contour_pieces].T
    cuts = np.flatnonzero((lower != upper) & (topology.contour_arc >= 0))
    link = _links(sets, topology)
    moved = piece_region.copy()
    runs = list(_search_runs(sets, topology, cuts))
    energy = np.empty(sets.n_contours)
    if runs:
        reached = np.concatenate([run for _, run in runs])
        energy[reached] = concavities(sets, k_min, reached, sigma)
    for cut, run in runs:
        stay = np.abs(sets.levels[sets.contour_level[run]] - sets.levels[sets.contour_level[cut]])
        best = int(((1 - concavity_weight) * stay + concavity_weight * energy[run]).argmin())
        here = int(np.flatnonzero(run == cut)[0])
        passed = sets.contour_pieces[run[min(here, best): max(here, best) + 1]]
        below, above = piece_region[sets.contour_pieces[cut]]
        old, new = (above, below) if best > here else (below, above)
        # What lies between the contours passed: above each but the last, and below each but the first.
        links = np.intersect1d(link[passed[:-1, 1]], link[passed[1:, 0]])
        moved[np.isin(link, links) & (piece_region == old)] = new
    return moved


def _links(sets: LevelSets, topology: ReebTopology) -> np.ndarray:
    """Slab pieces that hang together between contours of the graph: the set of each, (P,) int64, from 0.

    Cancelled leaves have no contour in the graph and belong to the set to which they are attached.
    """
    inner = sets.contour_pieces[topology.contour_arc < 0]
    return components(sets.n_pieces, *inner.T)[1]


def _search_runs(
    sets: LevelSets, topology: ReebTopology, cuts: np.ndarray
) -> Iterator[tuple[int, np.ndarray]]:
    """Yield each cut, a contour, and the contours of its arc to which it may move, (k,) int64, from low to high."""
    order = np.lexsort((sets.contour_level, topology.contour_arc))
    for arc in np.unique(topology.contour_arc[cuts]).tolist():
        run = order[topology.contour_arc[order] == arc]
        places = np.flatnonzero(np.isin(run, cuts))
        middles = (places[1:] + places[:-1]) // 2
        starts = np.append(0, middles + 1)
        stops = np.append(middles + 1, len(run))
        for place, start, stop in zip(places, starts, stops, strict=True):
            yield int(run[place]), run[start:stop]
