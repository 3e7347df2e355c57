# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates by recursive bisection after [Liu2007], for the preset "Liu 2007"."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...arrays.int64 import arange, full
from ...mesh.triangles import TriMesh
from ..hierarchy import Hierarchy
from .embedding import geometric, structural
from .outline import Outline
from .patch_graph import PatchGraph
from .row_cuts import best_cut, distances, rows

MOST_PARTS = 32  # upper bound of the number of candidates of a piece
LEAST_AREA = 0.004  # share of the area of a component below which there is no candidate
FEWEST_PATCHES = 4  # a part of fewer patches is not cut: an embedding in the plane needs three
TIPS = 6  # number of landmarks of an outline, every two of which are tried as samples
COST_AT_HALF = 0.68  # cost of a cut, see ``Bisection``, at which its salience is 0.5
DEAREST = 3 * COST_AT_HALF  # cost above which there is no cut; that of a ball in two halves is 2.5


@dataclass(frozen=True, eq=False)
class Bisection:
    """The best cut of a part.

    Attributes
    ----------
    kept, parted : (i,), (j,) int64
        The patches on both sides of the cut, rising; either side is connected.
    cost : float
        Cost of the cut over the square root of the smaller area, times 1 minus the segmentability of the outline, as
        far as this counts.
    """

    kept: np.ndarray
    parted: np.ndarray
    cost: float


def liu_candidates(
    mesh: TriMesh, outline_weight: float, progress: Callable[[float], None] | None = None
) -> tuple[np.ndarray, Hierarchy]:
    """Cut a surface in two, the parts in two again, and so on, the cheapest cut first.

    Parameters
    ----------
    mesh : TriMesh
        m faces, turned outwards.
    outline_weight : float
        How far the segmentability of a part's outline counts in the cost of its cut, 0..1.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    label : (m,) int64
        Candidate of each face, 0..c-1; every candidate is connected.
    hierarchy : Hierarchy
        The bisections backwards. Pieces of the surface never merge.

    Notes
    -----
    The faces are reduced to N_PATCHES patches first, so that the bisections take the same time on any mesh.
    """
    progress = progress or (lambda share: None)
    graph, patch = PatchGraph.of(mesh)
    progress(0.3)
    label = np.empty(len(graph.area), np.int64)
    merges, cost = [], []
    connected = graph.components_of(np.ones(len(graph.area), bool))
    first = 0
    for done, patches in enumerate(connected):
        names, splits, costs = _split(graph, patches, outline_weight)
        label[patches] = first + names
        merges += [(first + a, first + b) for a, b in splits[::-1]]
        cost += costs[::-1]
        first += len(splits) + 1
        progress(0.3 + 0.7 * (done + 1) / len(connected))
    salience = COST_AT_HALF / (COST_AT_HALF + np.array(cost))
    order = np.argsort(salience, kind="stable")
    return label[patch], Hierarchy.of(first, np.array(merges, np.int64).reshape(-1, 2)[order], salience[order])


def _split(
    graph: PatchGraph, connected: np.ndarray, outline_weight: float
) -> tuple[np.ndarray, list[tuple[int, int]], list[float]]:
    """Cut connected patches into parts: part of each patch, and the parts and the cost of each cut, cheapest first."""
    label = full(len(graph.area), -1)
    label[connected] = 0
    splits, costs = [], []
    queue: list[tuple[float, int, Bisection]] = []

    def consider(patches: np.ndarray, name: int, least: float) -> None:
        found = bisect(graph, patches, outline_weight)
        if found is not None:
            # What a dear cut has made possible is not cheaper than that cut.
            heapq.heappush(queue, (max(found.cost, least), name, found))

    consider(connected, 0, 0.0)
    while queue and len(splits) + 1 < MOST_PARTS:
        cost, name, found = heapq.heappop(queue)
        new = len(splits) + 1
        label[found.parted] = new
        splits.append((name, new))
        costs.append(cost)
        consider(found.kept, name, cost)
        consider(found.parted, new, cost)
    return label[connected], splits, costs


def bisect(whole: PatchGraph, patches: np.ndarray, outline_weight: float) -> Bisection | None:
    """Find the best cut of a part in two.

    Both embeddings are laid into the plane, every two of the first TIPS landmarks of either outline are tried as
    samples, and the cheapest cut between them is taken.

    Parameters
    ----------
    whole : PatchGraph
    patches : (j,) int64
        The part: connected patches, rising.
    outline_weight : float
        How far the segmentability of the outline counts, 0..1.

    Returns
    -------
    bisection : Bisection or None
        None if the part is too small to be cut, or every cut costs more than DEAREST.
    """
    if len(patches) < FEWEST_PATCHES or whole.area[patches].sum() < 2 * LEAST_AREA:
        return None
    graph = whole.within(patches)
    outlines = [Outline.of(embed(graph), graph.pairs) for embed in (structural, geometric)]
    rank = np.concatenate([rows(distances(graph, outline.landmarks[:TIPS])) for outline in outlines])
    side, cost = best_cut(graph, rank, LEAST_AREA)
    cost *= 1.0 - outline_weight * max(outline.segmentability for outline in outlines)
    if not cost <= DEAREST:
        return None
    rest = np.ones(len(patches), bool)
    rest[graph.components_of(side)[0]] = False
    kept = graph.components_of(rest)[0]
    # What hangs on neither of the two largest components goes to the side that surrounds it.
    parted = np.setdiff1d(arange(len(patches)), kept)
    return Bisection(patches[kept], patches[parted], cost)
