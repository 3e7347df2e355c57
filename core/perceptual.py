# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts where people cut: candidates for the preset "Perceptual"."""

from __future__ import annotations

import numpy as np

from .agd import ScalarField
from .cuts import move_cuts
from .features import BORDER, surface_measures
from .hierarchy import Hierarchy
from .levelsets import LevelSets
from .merging import RegionGraph, merge_all_
from .parameters import Parameters
from .patches import concave_patches, level_set_patches
from .trees import cut_model

# Share of people who must separate two regions for the cut to stay at detail 0.5.
DECISION = 0.55


def perceptual_candidates(
    sets: LevelSets, field: ScalarField, parameters: Parameters
) -> tuple[np.ndarray, Hierarchy]:
    """Patches between creases, merged weakest cut first as a model of people's cuts tells.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component.
    field : ScalarField
        Its AGD.
    parameters : Parameters

    Returns
    -------
    element_candidate : (E,) int64
        Patch of each element.
    hierarchy : Hierarchy
        Salience 0.5 is the decision learned from people.
    """
    follow = parameters.follow_level_sets
    label = level_set_patches(sets) if follow else concave_patches(sets.mesh)
    measures = surface_measures(sets, field)
    graph = RegionGraph(sets.mesh, measures, label)
    merges, share = merge_all_(graph, judge_cuts)
    hierarchy = Hierarchy.of(label.max() + 1, merges, salience_of(share))
    if not follow:
        length, curvature = measures.pair[:, [BORDER.length, BORDER.curvature.start]].T
        curvature = np.divide(curvature, length, out=np.zeros_like(length), where=length > 0)
        label = move_cuts(sets.mesh, label, hierarchy, curvature, parameters.alpha)
    return label[sets.element_face], hierarchy


def judge_cuts(graph: RegionGraph, borders: np.ndarray) -> np.ndarray:
    """Share of people who would separate the regions of each border, 0..1."""
    return cut_model().predict(graph.features(borders))


def salience_of(share: np.ndarray) -> np.ndarray:
    """Stretch shares of people so that the decision falls on 0.5."""
    return np.interp(share, [0.0, DECISION, 1.0], [0.0, 0.5, 1.0])
