# SPDX-License-Identifier: GPL-3.0-or-later
"""The method of the paper, to the letter: candidates for the preset "Berretti 2009"."""

from __future__ import annotations

import numpy as np

from ...graph.level_sets import LevelSets
from ...graph.reeb import ReebStructure
from ...parameters import Parameters
from ...surface.curvature import k_min
from ...surface.labels import majority, spread
from ..hierarchy import Hierarchy
from ..minimum_cut import move_cuts
from ..perceptual.features import SCALES, curvature_across
from .boundary_search import search_boundaries
from .regions import berretti_regions, rank_regions

DECISION = 0.5  # the salience at which the paper's threshold cuts


def berretti_candidates(
    sets: LevelSets, structure: ReebStructure, parameters: Parameters
) -> tuple[np.ndarray, Hierarchy]:
    """Regions of section 3.1 with the boundaries of section 3.2.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component.
    structure : ReebStructure
        Its Reeb graph, simplified.
    parameters : Parameters

    Returns
    -------
    element_candidate : (E,) int64
        Region of each element, before small ones are removed.
    hierarchy : Hierarchy
        Small regions first; salience 0.5 is the paper's threshold.
    """
    regions = berretti_regions(sets, structure, parameters.small_region)
    curvature = k_min(sets.mesh)
    kept = regions.hierarchy.parts(regions.hierarchy.n_parts(1.0 - DECISION))
    piece_part = kept[regions.piece_region]
    moved = search_boundaries(sets, structure, curvature, piece_part, parameters.alpha,
                              parameters.sigma)
    # A cut may leave little of a region: what is small is decided where the cuts have come to lie.
    regions = rank_regions(sets, _follow(sets, regions.piece_region, piece_part, moved),
                           parameters.small_region)
    candidate = regions.piece_region[sets.element_piece]
    if parameters.follow_level_sets:
        return candidate, regions.hierarchy
    area = sets.element_area + 1e-12 * sets.mesh.area
    label = majority(sets.element_face, candidate, area, sets.mesh.n_faces)
    across = curvature_across(sets.mesh, SCALES[:1])[0]
    label = move_cuts(sets.mesh, label, regions.hierarchy, across, parameters.alpha)
    return label[sets.element_face], regions.hierarchy


def _follow(sets, piece_region, piece_part, moved) -> np.ndarray:
    """Give pieces that changed part a region of their new part, that of a neighbour in it."""
    region = np.where(moved == piece_part, piece_region, -1)
    a, b = np.concatenate([sets.contour_pieces, sets.contour_pieces[:, ::-1]]).T
    together = moved[a] == moved[b]
    region = spread(region, a[together], b[together])
    return np.where(region < 0, piece_region, region)
