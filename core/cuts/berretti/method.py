# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates by the rules of [Berretti2009], for the preset "Berretti 2009"."""

from __future__ import annotations

from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebTopology
from ...mesh.labels import follow, majority
from ...parameters import Parameters
from ...surface.curvature import SCALES, curvature_across, k_min
from ..hierarchy import Candidates
from ..minimum_cut import MovableCuts, move_cuts
from .boundary_search import search_boundaries
from .regions import berretti_regions, rank_regions, with_finer

SALIENCE_OF_SMALL = 0.5  # salience of a merge whose area ratio is the paper's threshold, Parameters.small_region


def berretti_candidates(
    sets: LevelSets, topology: ReebTopology, parameters: Parameters
) -> Candidates:
    """Find the regions of [Berretti2009] (section 3.1) and move the cuts between them (section 3.2).

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component.
    topology : ReebTopology
        Reeb graph of the component, simplified.
    parameters : Parameters

    Returns
    -------
    candidates : Candidates
        Slab pieces of the regions, which merge first, then small regions. Merges below the paper's threshold have a
        salience below SALIENCE_OF_SMALL.
    """
    regions = berretti_regions(sets, topology, parameters.small_region)
    curvature = k_min(sets.mesh)
    kept = regions.hierarchy.parts_at(1.0 - SALIENCE_OF_SMALL)
    piece_part = kept[regions.piece_region]
    moved = search_boundaries(sets, topology, curvature, piece_part, parameters.concavity_weight,
                              parameters.sigma)
    # A cut that moves may leave little of a region. Regions are therefore ranked again after the cuts have moved.
    regions = rank_regions(sets, follow(regions.piece_region, piece_part, moved, sets.contour_pieces),
                           parameters.small_region)
    regions = with_finer(sets, topology, regions, parameters.small_region)
    candidate = regions.piece_region[sets.element_piece]
    if parameters.follow_level_sets:
        return Candidates(candidate, regions.hierarchy)
    label = majority(sets.element_face, candidate, sets.element_weight, sets.mesh.n_faces)
    across = curvature_across(sets.mesh, SCALES[:1])[0]
    label = move_cuts(MovableCuts(sets.mesh, across, parameters.band_ratio), label, regions.hierarchy)
    return Candidates(label[sets.element_face], regions.hierarchy)
