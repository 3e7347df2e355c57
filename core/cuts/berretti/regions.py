# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of [Berretti2009] (section 3.1): between events, then fused by adjacency, then ranked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.components import components
from ...arrays.indexing import renumbered
from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebTopology
from ...mesh.labels import borders
from ..hierarchy import Hierarchy
from .fusion import fuse_small, fuse_weakest


@dataclass(frozen=True, eq=False)
class Regions:
    """Slab pieces grouped to regions, and the order in which the regions merge.

    Attributes
    ----------
    piece_region : (P,) int64
        Region of each slab piece.
    hierarchy : Hierarchy
        Merges of the regions, the weakest boundary first, until one is left.
    """

    piece_region: np.ndarray
    hierarchy: Hierarchy


def berretti_regions(
    sets: LevelSets, topology: ReebTopology, small_region: float
) -> Regions:
    """Form the regions of [Berretti2009] and rank them.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component, P slab pieces.
    topology : ReebTopology
        Reeb graph of the component without ripples.
    small_region : float
        Area of a region over that of the largest region, below which the paper removes the region (0.05 in the paper).
        A merge at this ratio has salience 0.5.

    Returns
    -------
    regions : Regions
    """
    count, region = regions_between_events(sets, topology)
    count, region = fuse_equal_adjacency(sets, count, region)
    return rank_regions(sets, region, small_region)


def rank_regions(sets: LevelSets, region: np.ndarray, small_region: float) -> Regions:
    """Rank regions: find the order in which they merge, see ``fuse_weakest``.

    Parameters
    ----------
    sets : LevelSets
        P slab pieces.
    region : (P,) int64
        Region of each slab piece, any whole numbers.
    small_region : float
        Area of a region over that of the largest region at which a merge has salience 0.5.

    Returns
    -------
    regions : Regions
        With regions numbered from 0.
    """
    names, region = renumbered(region)
    merges, salience = fuse_weakest(sets, len(names), region, small_region)
    return Regions(region, Hierarchy.of(len(names), merges, salience))


def regions_between_events(sets: LevelSets, topology: ReebTopology) -> tuple[int, np.ndarray]:
    """Find the regions between the values at which the number of connected components changes.

    The number is that of the connected component that is followed, not of the whole surface: a limb is not cut where
    another limb begins or ends. A slab piece in which components join or split belongs to the side on which they are
    one. What rises from a minimum is the middle of a body, no protrusion, and belongs to what it joins. Ripples (leaves
    that ``simplify`` cancelled) are not counted, and belong to the region to which they are attached.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component, P slab pieces.
    topology : ReebTopology
        Reeb graph of the component without ripples.

    Returns
    -------
    count : int
        Number of regions.
    region : (P,) int64
        Region of each slab piece, 0..count-1; every region is connected.
    """
    return components(sets.n_pieces, *sets.contour_pieces[~_events(sets, topology)].T)


def _events(sets: LevelSets, topology: ReebTopology) -> np.ndarray:
    """Which contours are next to a slab piece in which components join or split, on the side of several, (C,) bool."""
    on_graph = topology.contour_arc >= 0
    lower, upper = sets.contour_pieces.T
    n_above = np.bincount(lower[on_graph], minlength=sets.n_pieces)
    n_below = np.bincount(upper[on_graph], minlength=sets.n_pieces)
    ends_below = np.bincount(topology.arcs.ravel(), minlength=topology.n_nodes)[topology.arcs[:, 0]] == 1
    from_minimum = np.zeros(sets.n_contours, bool)
    from_minimum[on_graph] = ends_below[topology.contour_arc[on_graph]]
    return on_graph & ((n_above[lower] > 1) | ((n_below[upper] > 1) & ~from_minimum))


def with_finer(sets: LevelSets, topology: ReebTopology, regions: Regions, small_region: float) -> Regions:
    """Cut regions where components begin, end, join or split anywhere, so that there is something finer than regions.

    The slab pieces of a region merge before any two regions do, the smallest first.

    Parameters
    ----------
    sets : LevelSets
        P slab pieces.
    topology : ReebTopology
        Reeb graph of the component without ripples.
    regions : Regions
    small_region : float
        See ``rank_regions``.

    Returns
    -------
    regions : Regions
        With the parts of ``regions`` at every level of detail at which no region is cut.
    """
    on_graph = topology.contour_arc >= 0
    at_node = on_graph & (topology.piece_node[sets.contour_pieces] >= 0).any(axis=1)
    has_event = np.zeros(len(sets.levels), bool)  # whether components begin, end, join or split beside each level
    has_event[sets.contour_level[at_node]] = True
    lower, upper = regions.piece_region[sets.contour_pieces].T
    inside = lower == upper
    # Next to the node itself nothing is cut: ``regions_between_events`` has decided there.
    cut = on_graph & has_event[sets.contour_level] & ~at_node
    count, fine = components(sets.n_pieces, *sets.contour_pieces[inside & ~cut].T)
    merges, ratio = fuse_small(sets, count, fine, inside)
    least = regions.hierarchy.salience.min(initial=0.5)
    one_of = np.empty(regions.hierarchy.n_candidates, np.int64)  # a slab piece of each stands for it
    one_of[regions.piece_region] = fine
    return Regions(fine, Hierarchy.of(
        count, np.concatenate([merges, one_of[regions.hierarchy.merges]]),
        np.concatenate([least * ratio / (ratio + small_region), regions.hierarchy.salience])))


def fuse_equal_adjacency(
    sets: LevelSets, count: int, region: np.ndarray
) -> tuple[int, np.ndarray]:
    """Fuse adjacent regions with equally many neighbors, until no such pair or only two regions are left.

    [Berretti2009] leaves the order open. Here all pairs are fused at once that have equally many neighbors, then the
    neighbors are counted anew. So a chain of regions, from each of which one limb branches off, becomes one region;
    pair by pair, the first pair would have one neighbor more than the rest of the chain. A round that would leave no
    cut fuses the pair of least area only.

    Parameters
    ----------
    sets : LevelSets
        P slab pieces.
    count : int
        Number of regions.
    region : (P,) int64
        Region of each slab piece, 0..count-1.

    Returns
    -------
    count : int
        Number of regions left.
    region : (P,) int64
        Region of each slab piece, 0..count-1.
    """
    region = np.asarray(region)
    while count > 2:
        _, pairs, _ = borders(region, sets.contour_pieces)
        degree = np.bincount(pairs.ravel(), minlength=count)
        equal = pairs[degree[pairs[:, 0]] == degree[pairs[:, 1]]]
        if not len(equal):
            break
        left, target = components(count, *equal.T)
        if left < 2:
            area = np.bincount(region, sets.piece_area, count)
            least = area[equal].sum(axis=1).argmin()
            left, target = components(count, *equal[[least]].T)
        count, region = left, target[region]
    return count, region
