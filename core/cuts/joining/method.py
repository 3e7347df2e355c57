# SPDX-License-Identifier: GPL-3.0-or-later
"""One order of merging over the candidates of all pieces of a body.

Within a piece the finest candidates merge as the method of cutting says. Above a fine level, parts of one piece and
of several are treated alike: a model of people's parts judges each pair of parts that are near each other, for parts of
one piece together with the method of cutting, and average linkage on the log-odds makes one order of all.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from ...surface.arrays import on_grid, renumbered
from ...surface.contact import TOUCH
from ...surface.mesh import TriMesh
from ..boosted_trees import BoostedTrees
from ..hierarchy import Hierarchy
from .linkage import average_linkage
from .pairs import FEATURES, PartPairs, part_pairs

# Cuts within a piece of less salience than this are not asked about: where a salience is the share of people who would
# cut there, and in the methods that measure how deep or how narrow a cut is.
FINE, FINE_MEASURED = 0.06, 0.2
# What a learned salience counts of the log-odds of two parts of one piece; the rest is the model's.
WITHIN = 0.2
# Share of people who put two parts together at which they are together at detail 0.5.
DECISION = 0.5
# Between candidates that nothing brought near each other.
LAST = 0.999
# Small groups are more often one part than their pairs are judged to be. Below LARGE, a share of the area, the odds of
# two groups are raised by so many times the smaller is below it, to the power of EASE.
LARGE, EASE = 0.1, 0.1
SURE = 1e-4, 1 - 1e-4  # bounds of a judgement, whose log-odds are to be finite
CUT = 0.02, 0.98  # of a salience, the same


@dataclass(frozen=True, eq=False)
class FineParts:
    """The finest parts of the pieces of a body that are asked about, and what pairs of them look like.

    Attributes
    ----------
    part : (m,) int64
        Part of each face of the body's mesh, 0..c-1.
    candidate : (c,) int64
        A candidate in each part.
    pairs : PartPairs
    fine : float
        Salience below which candidates are together in them.
    within : float
        What the salience of a cut counts of the log-odds of two parts of one piece, 0..1.
    """

    part: np.ndarray
    candidate: np.ndarray
    pairs: PartPairs
    fine: float
    within: float


def fine_parts(
    mesh: TriMesh, label: np.ndarray, hierarchy: Hierarchy, agd: np.ndarray, learned: bool = True
) -> FineParts:
    """Merge the candidates of each piece up to a fine level, and measure the pairs of parts that come near each other.

    Parameters
    ----------
    mesh : TriMesh
        Of a body, m faces and n vertices.
    label : (m,) int64
        Candidate of each face.
    hierarchy : Hierarchy
        Over the candidates; merges within pieces only.
    agd : (n,) float64
        Normalized, 0..1.
    learned : bool
        Whether saliences are shares of people who would cut there, or measures.

    Returns
    -------
    parts : FineParts
    """
    fine, within = (FINE, WITHIN) if learned else (FINE_MEASURED, 0.0)
    present, part = renumbered(hierarchy.parts(hierarchy.n_parts(1.0 - fine))[label])
    candidate = np.zeros(len(present), np.int64)
    candidate[part] = label
    pairs = part_pairs(mesh, part, hierarchy.salience_table(candidate), agd)
    return FineParts(part, candidate, pairs, fine, within)


def join_parts(
    parts: FineParts, hierarchy: Hierarchy, model: BoostedTrees | None = None
) -> tuple[Hierarchy, np.ndarray]:
    """Extend the hierarchies of several pieces to one over all of them.

    Parameters
    ----------
    parts : FineParts
    hierarchy : Hierarchy
        Over the candidates; merges within pieces only.
    model : BoostedTrees, optional
        What judges pairs; the one that ships with the package without.

    Returns
    -------
    hierarchy : Hierarchy
        Below ``parts.fine`` as it was. Salience 0.5 is DECISION.
    contacts : (k, 2) int64
        Faces of different parts that touch, or nearly so: wherever pieces touch, and where parts merge.
    """
    pairs = parts.pairs
    odds = _log_odds(np.clip((model or join_model()).predict(pairs.features), *SURE))
    cut = _log_odds(1 - np.clip(pairs.salience, *CUT))
    odds = np.where(pairs.same_piece, (1 - parts.within) * odds + parts.within * cut, odds)
    weight = np.sqrt(pairs.area[pairs.parts].min(axis=1)) + 1e-9
    merges, score, rows = average_linkage(
        len(parts.candidate), pairs.parts, on_grid(odds), weight,
        np.maximum(on_grid(pairs.area / LARGE), 1e-9), EASE)
    strength = np.interp(1 / (1 + np.exp(-score)), [0.0, DECISION, 1.0], [1.0, 0.5, parts.fine])
    touching = (pairs.gap <= TOUCH) & ~pairs.same_piece
    contacts = pairs.faces[np.union1d(rows, np.flatnonzero(touching))]
    kept = hierarchy.salience < parts.fine
    extended = Hierarchy.of(
        hierarchy.n_candidates, np.concatenate([hierarchy.merges[kept], parts.candidate[merges]]),
        np.concatenate([hierarchy.salience[kept], np.minimum(strength, LAST)]))
    return extended, contacts


def _log_odds(share: np.ndarray) -> np.ndarray:
    return np.log(share / (1 - share))


@cache
def join_model() -> BoostedTrees:
    """Read the model that judges pairs of parts, which benchmarks/train_joining.py trained; it is read once and kept.

    Returns a BoostedTrees over the columns FEATURES. Raises ReebError if the file was trained on other features.
    """
    return BoostedTrees.read(Path(__file__).parent / "join_model.npz", FEATURES)
