# SPDX-License-Identifier: GPL-3.0-or-later
"""Slivers: what is left of a part where cuts moved or sides were mirrored, and what is too small to be named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import largest_of_each, renumbered
from ..arrays.int64 import arange, full
from ..arrays.pairs import both_ways, distinct_pairs
from ..arrays.ties import TIE
from ..cuts.face_candidates import FaceCandidates
from ..mesh.labels import label_boundaries

# A connected region of a part of detail 0.5 is a sliver if it is smaller than TINY, a share of the area of its piece
# (such parts were found 15 times on 150 benchmark meshes, where no person has made one), or smaller than SHARD times
# the largest region that the part has on the same piece.
TINY, SHARD = 5e-4, 0.2


def without_slivers(candidates: FaceCandidates) -> FaceCandidates:
    """Let the slivers among the parts of detail 0.5 join the candidates with which they share the longest boundary.

    Parameters
    ----------
    candidates : FaceCandidates
        Every candidate is connected, and some may have no face. Contacts do not count.

    Returns
    -------
    candidates : FaceCandidates
        Those of slivers are no longer in use, the others are connected. A sliver with two longest boundaries stays, for
        one on a plane of symmetry belongs to neither side.
    """
    graph, hierarchy = candidates.graph, candidates.hierarchy
    present, place = renumbered(candidates.label)
    touching, length = graph.boundaries(place)
    touching, length = touching[length > 0], length[length > 0]
    part = hierarchy.parts_at(0.5)[present]
    together = touching[part[touching[:, 0]] == part[touching[:, 1]]]
    region = components(len(present), *together.T)[1]
    sliver = _are_slivers(np.bincount(place, graph.area), part, region, components(len(present), *touching.T)[1])
    # From here on slivers move as a whole; what they join is one candidate.
    unit = np.where(sliver, len(present) + region, arange(len(present)))
    touching, length = label_boundaries(unit, touching, length)
    goal = _goals(touching, length, len(present), len(unit))
    goal = np.where(sliver, goal[region], -1)
    return replace(candidates, label=present[np.where(goal >= 0, goal, arange(len(present)))[place]])


def _are_slivers(area: np.ndarray, part: np.ndarray, region: np.ndarray, piece: np.ndarray) -> np.ndarray:
    """Whether the region of each candidate is a sliver, (c,) bool; area, part, region, piece : (c,), of candidates."""
    of_region = np.bincount(region, area)[region]
    pairs, on_piece = distinct_pairs(part, piece)
    largest = largest_of_each(on_piece, of_region, len(pairs))[on_piece]
    return (of_region < TINY * np.bincount(piece, area)[piece]) | (of_region < SHARD * largest)


def _goals(touching: np.ndarray, length: np.ndarray, n_candidates: int, n_regions: int) -> np.ndarray:
    """Candidate that each region joins if it is a sliver, (n_regions,) int64; -1 for none.

    touching, length : boundaries of candidates and, numbered from ``n_candidates`` on, of slivers.
    """
    first, second = both_ways(touching).T
    beside = (first >= n_candidates) & (second < n_candidates)
    sliver, other, length = first[beside] - n_candidates, second[beside], np.tile(length, 2)[beside]
    best = length >= (1 - TIE) * largest_of_each(sliver, length, n_regions)[sliver]
    goal = full(n_regions, -1)
    goal[sliver[best]] = other[best]
    return np.where(np.bincount(sliver[best], minlength=n_regions) == 1, goal, -1)
