# SPDX-License-Identifier: GPL-3.0-or-later
"""What is there several times, such as the four wheels of a car: each is a part of its own, or none is.

Each pair of parts is judged by itself, and a wheel that touches the hood as well is sooner one with the body than the
others are. Whoever sees one wheel as a part sees all of them so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from ...arrays.components import components
from ...arrays.int64 import arange, full
from ...arrays.ties import on_grid, rounded
from ...arrays.vectors import middles_of_each, second_moments_of_each
from ...mesh.triangles import TriMesh
from .linkage import JudgedPairs, Linkage

#: Pieces repeat each other if the logarithms of their size and extents are in the same cells of this width, or in cells
#: that touch.
CELL = 0.03
THIN = 0.003  # added to extents, in units of the size, as those of a sheet are 0 but for rounding
ROUNDS = 3  # of linkage at most: what was made even may join elsewhere


def piece_kinds(mesh: TriMesh) -> np.ndarray:
    """Number the shapes of the pieces of a mesh, however they lie or are mirrored.

    Parameters
    ----------
    mesh : TriMesh

    Returns
    -------
    kind : (p,) int64
        Of each of the p pieces, 0..; those that repeat each other have the same.
    """
    count, piece = mesh.face_components
    area = mesh.face_area + 1e-300
    total, center = middles_of_each(piece, mesh.face_centroids, area, count)
    offset = mesh.face_centroids - center[piece]
    values = np.linalg.eigvalsh(second_moments_of_each(piece, offset, area, count) / total[:, None, None])
    size = np.sqrt(total)
    extents = np.sqrt(np.maximum(values, 0.0)) / size[:, None]
    logs = np.column_stack([np.log(size / size.max()), np.log(extents + THIN)])
    cells, cell = np.unique(np.rint(logs / CELL), axis=0, return_inverse=True)  # the largest is in the midst of its own
    beside = cKDTree(cells).query_pairs(1.5, p=np.inf, output_type="ndarray")
    return components(len(cells), *beside.T)[1][cell.reshape(-1)]


def evenly_linked(
    link: Callable[[JudgedPairs], Linkage], pairs: JudgedPairs, piece: np.ndarray, kind: np.ndarray
) -> Linkage:
    """Link parts so that of groups that repeat each other, a tire or a tire with its rim, all go on alone or none.

    Where some of them join others at a score above 0 and some below, the log-odds between each and all others, but for
    pieces of the same kind, are moved so that it joins at what is the mean now, and all parts are linked anew.

    Parameters
    ----------
    link : callable
        Average linkage of judged pairs of parts.
    pairs : JudgedPairs
        Of parts; scores are log-odds that the two are one.
    piece : (c,) int64
        Piece of each part.
    kind : (p,) int64
        Of each piece, see ``piece_kinds``.

    Returns
    -------
    linked : Linkage
    """
    linked = link(pairs)
    if len(kind) == 0 or np.bincount(kind).max() < 2:
        return linked
    token, mine = _tokens(piece, kind), kind[piece]
    others = mine[pairs.members[:, 0]] != mine[pairs.members[:, 1]]
    for _ in range(ROUNDS):
        groups = _Groups.of(linked, token, mine)
        shift = groups.shifts()
        if not shift.any():
            break
        within = groups.innermost(np.flatnonzero(shift))[pairs.members]
        by = np.append(shift, 0.0)[within].sum(axis=1)  # -1, in none of these groups, is the last
        moved = others & (within[:, 0] != within[:, 1])
        pairs = replace(pairs, score=on_grid(np.where(moved, pairs.score + by, pairs.score)))
        linked = link(pairs)
    return linked


def _tokens(piece: np.ndarray, kind: np.ndarray) -> np.ndarray:
    """A number for each part, (c,) uint64, such that groups of the same kinds of whole pieces have the same sum.

    Sums wrap around. Other groups have other sums, but for one in 10**19.
    """
    chance = np.random.default_rng(0)
    of_kind, token = (chance.integers(2**64, size=count, dtype=np.uint64)
                      for count in (int(kind.max()) + 1, len(piece)))
    total = np.zeros(len(kind), np.uint64)
    np.add.at(total, piece, token)
    last = np.zeros(len(kind), np.int64)
    last[piece] = arange(len(piece))
    token[last] += of_kind[kind] - total
    return token


@dataclass(frozen=True, eq=False)
class _Groups:
    """Groups of c parts as they arise: first each part, then those of each of s merges.

    Attributes
    ----------
    n_parts : int
        c
    token : (c + s,) uint64
        The same for groups that repeat each other.
    joins : (c + s,) float64
        The score at which each joins another group, or for pieces of one kind the score at which they join any other;
        nan for what is left at the end.
    above : (c + s,) int64
        The group that it is in then; -1 for none.
    """

    n_parts: int
    token: np.ndarray
    joins: np.ndarray
    above: np.ndarray

    @classmethod
    def of(cls, linked: Linkage, token: np.ndarray, kind: np.ndarray) -> _Groups:
        """The groups of a linkage of parts; token, kind : (c,), of each part, and of the piece that it lies in."""
        count, made = len(token), len(linked.merges)
        newest = list(range(count))  # the group whose lowest member each part is
        both = np.empty((made, 2), np.int64)
        for k, (a, b) in enumerate(linked.merges.tolist()):
            both[k] = newest[a], newest[b]
            newest[a] = count + k
        sums, kinds = token.tolist(), kind.tolist()  # -1 for a group of several kinds
        for a, b in both.tolist():
            sums.append((sums[a] + sums[b]) % 2**64)
            kinds.append(kinds[a] if kinds[a] == kinds[b] else -1)
        joins, above = np.full(count + made, np.nan), full(count + made, -1)
        # A merge counts where the threshold is below the scores of all before it.
        joins[both] = np.minimum.accumulate(linked.scores)[:, None]
        above[both] = count + arange(made)[:, None]
        for k in np.flatnonzero(np.array(kinds[count:]) >= 0)[::-1]:
            joins[both[k]] = joins[count + k]
        return cls(count, np.array(sums, np.uint64), joins, above)

    def shifts(self) -> np.ndarray:
        """How much more surely each group should join others, (c + s,) float64; 0 where those like it do as it does."""
        _, like = np.unique(self.token, return_inverse=True)
        held = np.flatnonzero(np.isfinite(self.joins))
        held = held[np.lexsort((self.joins[held], like[held]))]  # sums in an order that is the same for any numbering
        like, joins = like[held], rounded(self.joins[held])
        count = int(like.max(initial=-1)) + 1
        mean = (np.bincount(like, joins, count) / np.maximum(np.bincount(like, minlength=count), 1))[like]
        uneven = np.bincount(like, (joins > 0) != (mean > 0), count) > 0
        shift = np.zeros(len(self.token))
        shift[held] = np.where(uneven[like], mean - joins, 0.0)
        return shift

    def innermost(self, groups: np.ndarray) -> np.ndarray:
        """The first of some groups that each part is in, (c,) int64; -1 for none."""
        chosen = full(len(self.token), -1)
        chosen[groups] = groups
        for group in range(len(self.token) - 1, -1, -1):  # what a group is in came after it
            if chosen[group] < 0 <= self.above[group]:
                chosen[group] = chosen[self.above[group]]
        return chosen[:self.n_parts]
