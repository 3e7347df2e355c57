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
# It is one, too, if it is smaller than NARROW, a share of the area of its piece, and nearly all outline: its boundaries
# are longer than LONG, in units of the square root of its area. Such are single faces of the hollow of a pipe, or the
# ground between two teeth of a gear; docs/experiments.md has what other bounds do.
NARROW, LONG = 0.02, 6.0


def without_slivers(candidates: FaceCandidates) -> FaceCandidates:
    """Let the slivers among the parts of detail 0.5 join the candidates with which they share the longest boundary.

    Parameters
    ----------
    candidates : FaceCandidates
        Every candidate is connected, and some may have no face. Contacts do not count.

    Returns
    -------
    candidates : FaceCandidates
        Those of slivers are no longer in use, the others are connected. A sliver whose longest boundaries are with two
        parts stays, for one on a plane of symmetry belongs to neither side.
    """
    graph, hierarchy = candidates.graph, candidates.hierarchy
    present, place = renumbered(candidates.label)
    touching, length = graph.boundaries(place)
    touching, length = touching[length > 0], length[length > 0]
    part = hierarchy.parts_at(0.5)[present]
    parted = part[touching[:, 0]] != part[touching[:, 1]]
    region = components(len(present), *touching[~parted].T)[1]
    around = np.bincount(region[touching[parted]].ravel(), np.repeat(length[parted], 2), len(present))
    sliver = _are_slivers(np.bincount(place, graph.area), part, region, around,
                          components(len(present), *touching.T)[1])
    # From here on slivers move as a whole; what they join is one candidate.
    unit = np.where(sliver, len(present) + region, arange(len(present)))
    touching, length = label_boundaries(unit, touching, length)
    goal = _goals(touching, length, part, len(unit))
    goal = np.where(sliver, goal[region], -1)
    return replace(candidates, label=present[np.where(goal >= 0, goal, arange(len(present)))[place]])


def _are_slivers(
    area: np.ndarray, part: np.ndarray, region: np.ndarray, around: np.ndarray, piece: np.ndarray
) -> np.ndarray:
    """Whether the region of each candidate is a sliver, (c,) bool.

    area, part, region, piece : (c,), of candidates. around : (c,) float64, length of the boundary of each region.
    """
    of_region = np.bincount(region, area)[region]
    of_piece = np.bincount(piece, area)[piece]
    pairs, on_piece = distinct_pairs(part, piece)
    largest = largest_of_each(on_piece, of_region, len(pairs))[on_piece]
    ribbon = (of_region < NARROW * of_piece) & (around[region] ** 2 > LONG**2 * of_region)
    return (of_region < TINY * of_piece) | (of_region < SHARD * largest) | ribbon


def _goals(touching: np.ndarray, length: np.ndarray, part: np.ndarray, n_regions: int) -> np.ndarray:
    """Candidate that each region joins if it is a sliver, (n_regions,) int64; -1 for none.

    touching, length : boundaries of candidates and, numbered from c on, of slivers. part : (c,) int64, of candidates.
    """
    first, second = both_ways(touching).T
    beside = (first >= len(part)) & (second < len(part))
    sliver, other, length = first[beside] - len(part), second[beside], np.tile(length, 2)[beside]
    best = length >= (1 - TIE) * largest_of_each(sliver, length, n_regions)[sliver]
    sliver, other = sliver[best], other[best]
    goal = full(n_regions, -1)
    goal[sliver] = other
    of_several = sliver[part[other] != part[goal[sliver]]]
    goal[of_several] = -1
    return goal
