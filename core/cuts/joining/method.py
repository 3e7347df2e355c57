# SPDX-License-Identifier: GPL-3.0-or-later
"""One order of merging over the candidates of all pieces of a body.

Within a piece the finest candidates merge as the method of cutting says. Above a fine level, parts of one piece and
of several are treated alike. A model of people's parts judges each pair of parts that are near each other, for parts of
one piece together with the method of cutting; a second model, which knows what the first said, judges all pairs of the
largest parts, those far from each other included. Average linkage on the log-odds makes one order of all.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, partial
from importlib.resources import files

import numpy as np

from ...arrays.indexing import renumbered
from ...arrays.pairs import pair_keys
from ...arrays.ties import in_steps, on_grid
from ...mesh.triangles import TriMesh
from ...surface.contact import TOUCH
from ..boosted_trees import BoostedTrees
from ..hierarchy import LAST, Hierarchy
from .distant import FEATURES as DISTANT_FEATURES
from .distant import DistantPairs, distant_pairs
from .linkage import JudgedPairs, Linkage, average_linkage
from .pairs import FEATURES, PartPairs, part_pairs, unseen_neighbors
from .repetition import evenly_linked, piece_kinds

# Cuts within a piece of less salience than this are not judged anew: FINE where a salience is the share of people who
# would cut there, FINE_MEASURED in the methods that measure how deep or how narrow a cut is.
FINE, FINE_MEASURED = 0.06, 0.2
# Weight of a learned salience in the log-odds of two parts of one piece; the model of pairs has the rest.
WITHIN = 0.2
# Share of people who put two parts together at which they are together at detail 0.5.
SHARE_AT_HALF = 0.5
# Small groups are more often one part than their pairs are judged to be: if the smaller of two has a share a of the
# area, below LARGE, their odds are multiplied by (LARGE / a) ** EASE.
LARGE, EASE = 0.1, 0.1
# Weight of what the first model says of a pair that comes near each other; what the second says of any pair has 1.
NEARNESS = 20.0
# Weight of what the method of cutting says of neighbors that do not come near each other by points: it lets groups
# join, and decides where nothing else is known of them.
UNSEEN = 1e-6
SURE = 1e-4, 1 - 1e-4  # bounds of a judgement, whose log-odds are to be finite
CUT = 0.02, 0.98  # bounds of a salience, for the same reason


@dataclass(frozen=True, eq=False)
class FineParts:
    """The finest parts of the pieces of a body that are asked about, and what pairs of them look like.

    Attributes
    ----------
    part : (m,) int64
        Part of each face of the body's mesh, 0..c-1.
    candidate : (c,) int64
        A candidate in each part.
    hierarchy : Hierarchy
        Over the candidates; merges within pieces only.
    pairs : PartPairs
    neighbors : (k, 2) int64
        Further pairs of parts: they share an edge, but no points of theirs come near each other.
    neighbor_faces : (k, 2) int64
        A face of either that share an edge.
    fine : float
        Salience below which candidates are together in them.
    within : float
        Weight of the salience of a cut in the log-odds of two parts of one piece, 0..1.
    kind : (p,) int64
        Of each piece; those that repeat each other have the same.
    """

    part: np.ndarray
    candidate: np.ndarray
    hierarchy: Hierarchy
    pairs: PartPairs
    neighbors: np.ndarray
    neighbor_faces: np.ndarray
    fine: float
    within: float
    kind: np.ndarray

    def salience(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Salience of the cut between two parts of one piece, (e,) float64. a, b : (e,) int64."""
        return self.hierarchy.salience_between(self.candidate[a], self.candidate[b])


@dataclass(frozen=True, eq=False)
class JoinModel:
    """What judges whether two parts are one.

    Attributes
    ----------
    near : BoostedTrees
        Over the features of pairs that come near each other.
    distant : BoostedTrees, optional
        Over those of all pairs of the largest parts. Without it, they are not compared.
    """

    near: BoostedTrees
    distant: BoostedTrees | None


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
    present, part = renumbered(hierarchy.parts_at(1.0 - fine)[label])
    candidate = np.zeros(len(present), np.int64)
    candidate[part] = label
    pairs = part_pairs(mesh, part, lambda a, b: hierarchy.salience_between(candidate[a], candidate[b]), agd)
    neighbors = unseen_neighbors(mesh, part, pairs.parts)
    return FineParts(part, candidate, hierarchy, pairs, *neighbors, fine, within, piece_kinds(mesh))


def join_parts(parts: FineParts, model: JoinModel | None = None) -> tuple[Hierarchy, np.ndarray]:
    """Extend the hierarchies of several pieces to one over all of them.

    Parameters
    ----------
    parts : FineParts
    model : JoinModel, optional
        What judges pairs; the one that ships with the package without.

    Returns
    -------
    hierarchy : Hierarchy
        Below ``parts.fine`` as it was. Salience 0.5 is SHARE_AT_HALF.
    contacts : (k, 2) int64
        Faces of different parts that touch, or nearly so: wherever pieces touch, and where parts merge.
    """
    model = model or join_model()
    pairs = parts.pairs
    odds = near_odds(parts, model.near)
    judged = _with_neighbors(parts, odds)
    if model.distant and len((distant := compare_distant(parts, odds)).parts):
        judged = _with_distant(parts, judged, distant, model.distant)
    linked = evenly_linked(partial(_linked, parts), judged, pairs.shapes.piece, parts.kind)
    strength = np.interp(1 / (1 + np.exp(-linked.scores)), [0.0, SHARE_AT_HALF, 1.0], [1.0, 0.5, parts.fine])
    touching = (pairs.gap <= TOUCH) & ~pairs.same_piece
    faces = np.concatenate([pairs.faces, parts.neighbor_faces])
    contacts = faces[np.union1d(linked.rows, np.flatnonzero(touching))]
    hierarchy = parts.hierarchy
    kept = hierarchy.salience < parts.fine
    extended = Hierarchy.of(
        hierarchy.n_candidates, np.concatenate([hierarchy.merges[kept], parts.candidate[linked.merges]]),
        np.concatenate([hierarchy.salience[kept], np.minimum(strength, LAST)]))
    return extended, contacts


def near_odds(parts: FineParts, model: BoostedTrees) -> np.ndarray:
    """Judge the pairs of parts that come near each other.

    Parameters
    ----------
    parts : FineParts
    model : BoostedTrees
        Over the columns ``pairs.FEATURES``.

    Returns
    -------
    odds : (e,) float64
        Log-odds that the two are one part; of parts of one piece the method of cutting has its say in them.
    """
    pairs = parts.pairs
    odds = _judged(model, pairs.features)
    cut = _log_odds(1 - np.clip(pairs.salience, *CUT))
    return on_grid(np.where(pairs.same_piece, (1 - parts.within) * odds + parts.within * cut, odds))


def compare_distant(parts: FineParts, odds: np.ndarray) -> DistantPairs:
    """Compare the largest parts in all pairs.

    Parameters
    ----------
    parts : FineParts
    odds : (e,) float64
        Of the pairs that come near each other, see ``near_odds``.

    Returns
    -------
    pairs : DistantPairs
    """
    linked = _linked(parts, _near_pairs(parts, odds))
    return distant_pairs(parts.pairs, parts.salience, odds, linked.merges, linked.scores)


def _near_pairs(parts: FineParts, odds: np.ndarray) -> JudgedPairs:
    """The pairs that come near each other, with log-odds, (e,) float64, that the two are one."""
    near = parts.pairs.parts
    return JudgedPairs(near, odds, _pair_weight(parts, near), np.ones(len(near), bool))


def _with_neighbors(parts: FineParts, odds: np.ndarray) -> JudgedPairs:
    """The pairs that come near each other, and the neighbors that do not, judged by the method of cutting alone."""
    near = _near_pairs(parts, odds)
    cut = _log_odds(1 - np.clip(parts.salience(*parts.neighbors.T), *CUT))
    return JudgedPairs(
        np.concatenate([near.members, parts.neighbors]), np.concatenate([near.score, on_grid(cut)]),
        np.concatenate([near.weight, UNSEEN * _pair_weight(parts, parts.neighbors)]),
        np.ones(len(near.members) + len(cut), bool))


def _with_distant(
    parts: FineParts, near: JudgedPairs, distant: DistantPairs, model: BoostedTrees
) -> JudgedPairs:
    """The pairs that can join parts, first, and all others of the largest parts.

    A pair that is both has one row, with the weighted mean of what both models say.
    """
    count = len(parts.candidate)
    pairs = np.concatenate([near.members, distant.parts])
    judged = np.concatenate([near.score, on_grid(_judged(model, distant.features))])
    weight = np.concatenate([NEARNESS * near.weight, _pair_weight(parts, distant.parts)])
    _, first, row = np.unique(pair_keys(pairs, count), return_index=True, return_inverse=True)
    total = np.bincount(row, weight)
    mean = np.bincount(row, weight * judged) / total
    order = np.argsort(first)  # the near pairs keep their places
    return JudgedPairs(pairs[first[order]], on_grid(mean[order]), total[order], first[order] < len(near.members))


def _linked(parts: FineParts, pairs: JudgedPairs) -> Linkage:
    """Average linkage in which small parts join more easily; see ``average_linkage``."""
    size = np.maximum(on_grid(parts.pairs.shapes.area / LARGE), 1e-9)
    return average_linkage(len(parts.candidate), pairs, size, EASE)


def _pair_weight(parts: FineParts, pairs: np.ndarray) -> np.ndarray:
    """What each pair of parts, (e, 2), counts: the square root of the smaller area."""
    return np.sqrt(parts.pairs.shapes.area[pairs].min(axis=1)) + 1e-9


def _judged(model: BoostedTrees, features: np.ndarray) -> np.ndarray:
    """Log-odds, (e,) float64, that a model gives pairs of parts by their features, (e, k)."""
    return _log_odds(np.clip(model.predict(in_steps(features)), *SURE))


def _log_odds(share: np.ndarray) -> np.ndarray:
    """Log-odds of shares, which are above 0 and below 1."""
    return np.log(share / (1 - share))


@cache
def join_model() -> JoinModel:
    """Read the models that judge pairs of parts, which benchmarks/train_joining.py trained; once, and they are kept.

    Returns a JoinModel. Raises ReebError if a file was trained on other features.
    """
    folder = files(__package__)
    return JoinModel(BoostedTrees.read(folder / "join_model.npz", FEATURES),
                     BoostedTrees.read(folder / "distant_model.npz", DISTANT_FEATURES))
