# SPDX-License-Identifier: GPL-3.0-or-later
"""Boundary search of the paper (section 3.2): each cut slides along its arc to a concavity."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.sparse import coo_array
from scipy.sparse.csgraph import depth_first_order

from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebTopology
from ...surface.arrays import components, renumbered

SAMPLES = 128  # points along a boundary; finer than any sigma in the range of parameters
# A boundary as concave as a circle of its own radius is worth a move over a tenth of the range
# of the field; three times that is all that a crease, however sharp, can be worth.
CREASE_WORTH = 0.1
MAX_WORTH = 0.3


def contour_curve(sets: LevelSets, contour: int) -> tuple[np.ndarray, np.ndarray, bool]:
    """The crossings of one contour in order along the curve.

    Returns
    -------
    edge : (c,) int64
        Edges of the mesh that the curve crosses, in order.
    points : (c, 3) float64
        Where it crosses them.
    closed : bool
        False for a contour that ends at borders.
    """
    segments = np.flatnonzero(sets.segment_contour == contour)
    edge, local = renumbered(sets.segment_edges[segments])
    degree = np.bincount(local.ravel())
    n = len(edge)
    graph = coo_array((np.ones(len(local), np.int8), tuple(local.T)), shape=(n, n)).tocsr()
    # On a cycle, depth first is the order along the curve; on an open curve from an end too.
    start = int(degree.argmin())
    order = depth_first_order(graph, start, directed=False, return_predecessors=False)
    edge = edge[order]
    share = sets.crossing(edge, np.full(n, sets.contour_level[contour]))[:, None]
    low, high = (sets.mesh.vertices[sets.mesh.edges.vertices[edge, k]] for k in (0, 1))
    return edge, low + share * (high - low), bool(degree.min() >= 2)


def concavity(sets: LevelSets, k_min: np.ndarray, contour: int, sigma: float) -> float:
    """E_concave of a contour, eq. (9), without unit.

    k_min is sampled along the curve, smoothed by a Gaussian over its normalized arc length, and
    its minimum is taken times the radius of a circle as long as the curve. The paper leaves the
    scale of k_min open: CREASE_WORTH and MAX_WORTH are ours (docs/method.md, section 4).

    Parameters
    ----------
    sets : LevelSets
    k_min : (n,) float64
        1 / length.
    contour : int
    sigma : float
        Share of the length of the curve.

    Returns
    -------
    energy : float
        Negative where the curve passes a concavity.
    """
    edge, points, closed = contour_curve(sets, contour)
    share = sets.crossing(edge, np.full(len(edge), sets.contour_level[contour]))
    low, high = (k_min[sets.mesh.edges.vertices[edge, k]] for k in (0, 1))
    along = low + share * (high - low)
    if closed:
        points, along = np.concatenate([points, points[:1]]), np.append(along, along[0])
    arc_length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    total = arc_length[-1]
    if total <= 0:
        return 0.0
    at = (np.arange(SAMPLES) + 0.5) / SAMPLES * total
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
    alpha: float,
    sigma: float,
) -> np.ndarray:
    """Move each cut along its arc of the Reeb graph to the level that minimises eq. (8).

    The search is exhaustive over the contours of the arc, where the paper descends a gradient;
    it passes neither a node nor the middle between two cuts.

    Parameters
    ----------
    sets : LevelSets
        P pieces.
    topology : ReebTopology
        Simplified: its arcs say how far a cut may go.
    k_min : (n,) float64
    piece_region : (P,) int64
    alpha : float
        Weight of concavity against staying, 0..1.
    sigma : float
        Gaussian along the boundary, share of its length.

    Returns
    -------
    piece_region : (P,) int64
        With the pieces between the old and the new place of each cut relabelled.
    """
    lower, upper = piece_region[sets.contour_pieces].T
    cuts = np.flatnonzero((lower != upper) & (topology.contour_arc >= 0))
    link = _links(sets, topology)
    moved = piece_region.copy()
    energies: dict[int, float] = {}
    for cut, run in _search_runs(sets, topology, cuts):
        value = sets.levels[sets.contour_level[run]]
        for contour in run.tolist():
            if contour not in energies:
                energies[contour] = concavity(sets, k_min, contour, sigma)
        concave = np.array([energies[c] for c in run.tolist()])
        stay = np.abs(value - sets.levels[sets.contour_level[cut]])
        best = int(((1 - alpha) * stay + alpha * concave).argmin())
        here = int(np.flatnonzero(run == cut)[0])
        passed = sets.contour_pieces[run[min(here, best): max(here, best) + 1]]
        below, above = piece_region[sets.contour_pieces[cut]]
        old, new = (above, below) if best > here else (below, above)
        # The links between the two contours: above all but the last, below all but the first.
        links = np.intersect1d(link[passed[:-1, 1]], link[passed[1:, 0]])
        moved[np.isin(link, links) & (piece_region == old)] = new
    return moved


def _links(sets: LevelSets, topology: ReebTopology) -> np.ndarray:
    """(P,) the stretch between consecutive contours of the graph that each piece lies in."""
    inner = sets.contour_pieces[topology.contour_arc < 0]
    return components(sets.n_pieces, *inner.T)[1]


def _search_runs(sets: LevelSets, topology: ReebTopology, cuts: np.ndarray):
    """For each cut, the contours of its arc it may move to, from low to high."""
    order = np.lexsort((sets.contour_level, topology.contour_arc))
    for arc in np.unique(topology.contour_arc[cuts]).tolist():
        run = order[topology.contour_arc[order] == arc]
        places = np.flatnonzero(np.isin(run, cuts))
        middles = (places[1:] + places[:-1]) // 2
        starts = np.append(0, middles + 1)
        stops = np.append(middles + 1, len(run))
        for place, start, stop in zip(places, starts, stops, strict=True):
            yield int(run[place]), run[start:stop]
