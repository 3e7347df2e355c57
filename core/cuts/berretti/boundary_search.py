# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundary search of [Berretti2009] (section 3.2): each cut slides along its arc of the Reeb graph to a concavity."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.sparse import coo_array
from scipy.sparse.csgraph import depth_first_order

from ...arrays.components import components
from ...arrays.indexing import renumbered
from ...arrays.int64 import arange
from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebTopology

SAMPLES = 128  # number of points along a contour at which k_min is sampled
# With r the radius of a circle as long as the contour, E_concave = max(CREASE_WORTH * r * k_min, -MAX_WORTH), in units
# of the range of the field. A contour whose k_min is -1 / r is thus worth a move over a tenth of this range.
CREASE_WORTH = 0.1
MAX_WORTH = 0.3


def contour_curve(sets: LevelSets, contour: int) -> tuple[np.ndarray, np.ndarray, bool]:
    """List the edges of the mesh that a contour crosses, in order along the contour.

    Parameters
    ----------
    sets : LevelSets
    contour : int
        Index of the contour in ``sets``.

    Returns
    -------
    edge : (c,) int64
    share : (c,) float64
        Where the contour crosses each of them, 0..1 from the first vertex of the edge.
    closed : bool
        Whether the contour is a closed curve; False if it ends at borders of the surface.
    """
    segments = np.flatnonzero(sets.segment_contour == contour)
    edge, local = renumbered(sets.segment_edges[segments])
    degree = np.bincount(local.ravel())
    n = len(edge)
    # Where bridges join pieces, a contour has a curve on each: the longest stands for it.
    _, curve = components(n, *local.T)
    main = curve == np.bincount(curve).argmax()
    graph = coo_array((np.ones(len(local), np.int8), tuple(local.T)), shape=(n, n)).tocsr()
    # Depth-first search follows the curve: a closed one from anywhere, an open one from an end, which has degree 1.
    start = int(np.where(main, degree, degree.max() + 1).argmin())
    order = depth_first_order(graph, start, directed=False, return_predecessors=False)
    edge = edge[order]
    return edge, sets.crossing(edge, sets.contour_level[contour]), bool(degree[main].min() >= 2)


def at_crossings(values: np.ndarray, ends: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Values at points of edges, (c,) or (c, k), from those at the vertices, (n,) or (n, k).

    ends : (c, 2) int64, of the edges. share : (c,) float64, where on the edges, from the first end.
    """
    low, high = (values[end] for end in ends.T)
    return low + (share * (high - low).T).T


def concavity(sets: LevelSets, k_min: np.ndarray, contour: int, sigma: float) -> float:
    """Compute E_concave of a contour, eq. (9) of docs/method.md.

    k_min is sampled along the contour and smoothed by a Gaussian; its minimum is multiplied by the radius of a circle
    as long as the contour, so that it has no unit. [Berretti2009] leaves the scale open: CREASE_WORTH and MAX_WORTH
    were chosen here (docs/method.md, section 4).

    Parameters
    ----------
    sets : LevelSets
        n vertices.
    k_min : (n,) float64
        Smaller principal curvature at each vertex, 1 / unit of the vertices.
    contour : int
        Index of the contour in ``sets``.
    sigma : float
        Standard deviation of the Gaussian, in units of the length of the contour; 0 does not smooth.

    Returns
    -------
    energy : float
        In units of the range of the field, at least -MAX_WORTH; negative where the contour passes a concavity. 0 for
        a contour without length.
    """
    edge, share, closed = contour_curve(sets, contour)
    points, along = (at_crossings(values, sets.mesh.edges.vertices[edge], share)
                     for values in (sets.mesh.vertices, k_min))
    if closed:
        points, along = np.concatenate([points, points[:1]]), np.append(along, along[0])
    arc_length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    total = arc_length[-1]
    at = (arange(SAMPLES) + 0.5) / SAMPLES * total
    smooth = np.interp(at, arc_length, along)
    if sigma > 0:
        smooth = gaussian_filter1d(smooth, sigma * SAMPLES, mode="wrap" if closed else "nearest")
    relative = smooth.min() * total / (2 * np.pi)
    return float(max(CREASE_WORTH * relative, -MAX_WORTH))


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
    ``concavity`` is computed once for each contour that a cut can reach.
    """
    lower, upper = piece_region[sets.contour_pieces].T
    cuts = np.flatnonzero((lower != upper) & (topology.contour_arc >= 0))
    link = _links(sets, topology)
    moved = piece_region.copy()
    for cut, run in _search_runs(sets, topology, cuts):
        stay = np.abs(sets.levels[sets.contour_level[run]] - sets.levels[sets.contour_level[cut]])
        concave = np.array([concavity(sets, k_min, contour, sigma) for contour in run.tolist()])
        best = int(((1 - concavity_weight) * stay + concavity_weight * concave).argmin())
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
