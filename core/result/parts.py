# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts at one level of detail, and what is known of each: its faces, area, twin and the cuts around it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..arrays.indexing import largest_of_each, sums_by
from ..arrays.int64 import arange
from ..arrays.pairs import distinct_pairs
from ..mesh.grounds import SHARE
from ..mesh.labels import borders, majority
from ..mesh.triangles import vote_weights
from .junctions import counted_again

if TYPE_CHECKING:
    from .decomposition import Decomposition


def default_name(number: int) -> str:
    """Name a part until the user gives it another name.

    number : int, 1 or more. Returns "Part 01" and so on.
    """
    return f"Part {number:02d}"


@dataclass(frozen=True, eq=False)
class Parts:
    """Parts at one level of detail, as a grouping of the candidates; other tables are computed when first asked for.

    Arrays are kept, and other tables are made of them: copy one before you change it. With p faces, n vertices and c
    candidates of the caller's mesh, and a graph of k nodes, q arcs and r center points:

    Attributes
    ----------
    decomposition : Decomposition
        The result to which the parts belong.
    candidate_part : (c,) int64
        Part of each candidate, 0..count-1.
    """

    decomposition: Decomposition
    candidate_part: np.ndarray

    def __repr__(self) -> str:
        return f"<Parts: {self.count} of {self.decomposition.n_faces} faces>"

    @cached_property
    def labels(self) -> np.ndarray:
        """(p,) int64, part of each face, 0..count-1."""
        return self.candidate_part[self.decomposition.candidates]

    @cached_property
    def vertex_labels(self) -> np.ndarray:
        """(n,) int64, part of each vertex; -1 for a vertex of no face."""
        candidate = self.decomposition.vertex_candidates
        return np.where(candidate >= 0, self.candidate_part[candidate], -1)

    @cached_property
    def area(self) -> np.ndarray:
        """(count,) float64, area of each part, in squared units of the vertices."""
        return np.bincount(self.candidate_part, self.decomposition.candidate_area)

    @cached_property
    def share(self) -> np.ndarray:
        """(count,) float64, area of each part as a share of the whole, 0..1."""
        return self.area / self.area.sum()

    @cached_property
    def ground(self) -> np.ndarray:
        """(count,) bool, parts of grounds alone: as large as a ground is, and with nothing of the graph."""
        in_graph = np.zeros(self.count, bool)
        in_graph[self.node_part] = in_graph[self.point_part] = True
        ground, area = ~in_graph, np.where(in_graph, 0.0, self.area)
        order = np.argsort(-area, kind="stable")
        left = self.area.sum() - np.cumsum(area[order]) + area[order]  # without those before
        ground[order] &= np.logical_and.accumulate(area[order] >= SHARE * left)
        return ground

    @property
    def count(self) -> int:
        """Number of parts."""
        return len(self.area)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Name of each part: Part 01, Part 02 and so on."""
        return tuple(default_name(i + 1) for i in range(self.count))

    @cached_property
    def twin(self) -> np.ndarray:
        """(count,) int64, part that is the mirror image of each part, itself where it is its own; -1 for none."""
        d = self.decomposition
        image = np.where(d.candidate_twin >= 0, self.candidate_part[d.candidate_twin], -1)
        twin = majority(self.candidate_part, image + 1, vote_weights(d.candidate_area), self.count) - 1
        return np.where(twin[np.maximum(twin, 0)] == arange(self.count), twin, -1)

    @cached_property
    def side(self) -> np.ndarray:
        """(count,) int64, of a part that has a twin: 1 or -1 as its faces, see ``face_side``; else 0."""
        side = np.bincount(self.candidate_part, self.decomposition.candidate_side, self.count)
        side = np.sign(side).astype(np.int64)
        apart = (self.twin >= 0) & (self.twin != arange(self.count))
        return np.where(apart & (side[self.twin] == -side), side, 0)

    @cached_property
    def _boundaries(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Pairs of parts, and length and salience of the cut between them."""
        d = self.decomposition
        between, cuts, cut = borders(self.candidate_part, d.candidate_pairs)
        salience = largest_of_each(cut, d.pair_salience[between], len(cuts))
        length = sums_by(cut, d.candidate_pair_length[between], len(cuts))
        if len(d.junctions):
            pairs, more = counted_again(d.junctions, d.junction_length, self.candidate_part)
            places, place = distinct_pairs(*np.concatenate([cuts, pairs]).T)
            if len(places) == len(cuts):  # as in any result that was not made by hand
                length -= sums_by(place[len(cuts):], more, len(cuts))
        return cuts, length, salience

    @property
    def cuts(self) -> np.ndarray:
        """(e, 2) int64, parts that touch or that only a link joins, see ``cut_touches``; the smaller number first."""
        return self._boundaries[0]

    @cached_property
    def cut_touches(self) -> np.ndarray:
        """(e,) bool, whether the two parts of each cut touch; else a link joins them.

        A cut of length 0 may be either: parts of separate pieces can touch without an edge.
        """
        pairs = self.candidate_part[self.decomposition.candidate_pairs[self.decomposition.pair_touches]]
        place = distinct_pairs(*np.concatenate([self.cuts, np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1)]).T)[1]
        return np.isin(place[: len(self.cuts)], place[len(self.cuts) :])

    @property
    def cut_length(self) -> np.ndarray:
        """(e,) float64, length of each cut, in units of the vertices."""
        return self._boundaries[1]

    @property
    def cut_salience(self) -> np.ndarray:
        """(e,) float64, salience of each cut, 0..1: how much it deserves to be there."""
        return self._boundaries[2]

    @property
    def node_part(self) -> np.ndarray:
        """(k,) int64, part of each node of the graph."""
        return self.candidate_part[self.decomposition.node_candidate]

    @property
    def point_part(self) -> np.ndarray:
        """(r,) int64, part of each center point of the graph."""
        return self.candidate_part[self.decomposition.point_candidate]

    @cached_property
    def arc_part(self) -> np.ndarray:
        """(q,) int64, part in which most center points of each arc lie; every arc has a point."""
        graph = self.decomposition.graph
        return majority(graph.point_arc, self.point_part, np.ones(len(self.point_part)), graph.n_arcs)
