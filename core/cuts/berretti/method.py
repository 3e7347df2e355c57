# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of the paper, to the letter: candidates for the preset "Berretti 2009"."""

from __future__ import annotations

import numpy as np

from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebTopology
from ...parameters import Parameters
from ...surface.arrays import both_ways
from ...surface.curvature import SCALES, curvature_across, k_min
from ...surface.labels import majority, spread
from ..hierarchy import Candidates
from ..minimum_cut import move_cuts
from .boundary_search import search_boundaries
from .regions import berretti_regions, rank_regions

DECISION = 0.5  # the salience at which the paper's threshold cuts


def berretti_candidates(
    sets: LevelSets, topology: ReebTopology, parameters: Parameters
) -> Candidates:
    """Regions of section 3.1 with the boundaries of section 3.2.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component.
    topology : ReebTopology
        Its Reeb graph, simplified.
    parameters : Parameters

    Returns
    -------
    candidates : Candidates
        The regions before small ones are removed. These merge first; salience 0.5 is the paper's threshold.
    """
    regions = berretti_regions(sets, topology, parameters.small_region)
    curvature = k_min(sets.mesh)
    kept = regions.hierarchy.parts(regions.hierarchy.n_parts(1.0 - DECISION))
    piece_part = kept[regions.piece_region]
    moved = search_boundaries(sets, topology, curvature, piece_part, parameters.concavity_weight,
                              parameters.sigma)
    # A cut may leave little of a region: what is small is decided where the cuts have come to lie.
    regions = rank_regions(sets, _follow(sets, regions.piece_region, piece_part, moved),
                           parameters.small_region)
    candidate = regions.piece_region[sets.element_piece]
    if parameters.follow_level_sets:
        return Candidates(candidate, regions.hierarchy)
    area = sets.element_area + 1e-12 * sets.mesh.area
    label = majority(sets.element_face, candidate, area, sets.mesh.n_faces)
    across = curvature_across(sets.mesh, SCALES[:1])[0]
    label = move_cuts(sets.mesh, label, regions.hierarchy, across, parameters.band_ratio)
    return Candidates(label[sets.element_face], regions.hierarchy)


def _follow(sets, piece_region, piece_part, moved) -> np.ndarray:
    """Give pieces that changed part a region of their new part, that of a neighbor in it."""
    region = np.where(moved == piece_part, piece_region, -1)
    a, b = both_ways(sets.contour_pieces).T
    together = moved[a] == moved[b]
    region = spread(region, a[together], b[together])
    return np.where(region < 0, piece_region, region)
