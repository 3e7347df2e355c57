# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidates and their hierarchy as they are with a hint: labels that the mesh brings along, such as its materials.

Where the hint changes, a cut becomes possible, whatever the shape, and likelier; elsewhere a cut becomes less likely.
What the method of cutting says of two candidates and what the hint says are added as log-odds, and average linkage
makes a hierarchy of the sums, as it does over the pieces of a body. If all hints are the same, nothing changes.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import is_last_of_each, renumbered
from ..arrays.int64 import arange
from ..arrays.pairs import both_ways
from ..arrays.ties import in_steps
from ..mesh.face_graph import FaceGraph
from ..mesh.labels import majority, spread
from .face_candidates import FaceCandidates
from .hierarchy import LAST, Hierarchy
from .joining.linkage import JudgedPairs, average_linkage

# What it adds to the log-odds that two candidates belong together if their hints are the same, and takes from them if
# they differ.
SAME_HINT, OTHER_HINT = 0.5, 1.5
# Share of the area below which what a hint cuts out of a candidate stays in it.
LEAST_CUT_OUT = 0.002
# Least salience between cells of different hints: there, that the method saw no cut counts for nothing.
LEAST_SALIENCE = 0.2
ROUNDING = 1e-6  # bounds of saliences, whose log-odds are to be finite
STEP = 2.0**-20  # of the weights of pairs
NO_AREA = 1e-6  # share of the whole area that is added to the vote of each face, as some have none


def hinted_candidates(candidates: FaceCandidates, hint: np.ndarray) -> FaceCandidates:
    """Let candidates end where a hint changes, and merge in the order that follows from both.

    Parameters
    ----------
    candidates : FaceCandidates
        Of p faces; every candidate is connected, some may have no face, and all of them merge in the end.
    hint : (p,) int64
        Hint of each face, such as its material.

    Returns
    -------
    candidates : FaceCandidates
        Each of one hint but for small places, and in one of those given but for small places.
    """
    if (hint == hint[0]).all():
        return candidates
    graph, label = candidates.graph, candidates.label
    cell = _cells(graph, label, hint)
    area = np.bincount(cell, graph.area)
    own, said = (majority(cell, named, graph.area + NO_AREA * area.sum(), len(area)) for named in (label, hint))
    pairs, _ = candidates.touching_graph().boundaries(cell)
    a, b = pairs.T
    salience = candidates.hierarchy.salience_between(own[a], own[b])
    other = said[a] != said[b]
    salience = salience.clip(np.where(other, LEAST_SALIENCE, ROUNDING), 1.0 - ROUNDING)
    # With so few digits sums of scores times weights are exact: of many pairs of one score rounding would choose.
    score = in_steps(np.log(1.0 / salience - 1.0)) + np.where(other, -OTHER_HINT, SAME_HINT)
    weight = np.maximum(np.rint(np.sqrt(area[pairs].min(axis=1) / area.sum()) / STEP), 1.0) * STEP
    linked = average_linkage(len(area), JudgedPairs(pairs, score, weight, np.ones(len(pairs), bool)))
    hierarchy = Hierarchy.of(len(area), linked.merges, np.minimum(1.0 / (1.0 + np.exp(linked.scores)), LAST))
    return replace(candidates, label=cell, hierarchy=hierarchy)


def _cells(graph: FaceGraph, label: np.ndarray, hint: np.ndarray) -> np.ndarray:
    """The connected places of one candidate and one hint, (p,) int64, 0..c-1.

    What little a hint cuts off a candidate joins a neighbor of the same hint: there the candidate ends at the hint.
    """
    least = LEAST_CUT_OUT * graph.area.sum()
    a, b = graph.pairs.T
    alike = hint[a] == hint[b]
    region = graph.regions(hint)[1]
    # A region of one hint that is small as a whole does not end candidates.
    speck = (np.bincount(region, graph.area) < least)[region]
    alike |= speck[a] | speck[b]
    within = label[a] == label[b]
    cell = components(len(label), *graph.pairs[alike & within].T)[1]
    area, own = np.bincount(cell, graph.area), np.empty(int(cell.max()) + 1, np.int64)
    own[cell] = label
    kept = (area >= least) | is_last_of_each(own, area, -arange(len(area)), count=int(label.max()) + 1)
    cell = np.where(kept[cell], cell, -1)
    for chosen in (alike, within):
        cell = spread(cell, *both_ways(graph.pairs[chosen]).T)
    return renumbered(cell)[1]
