# SPDX-License-Identifier: GPL-3.0-or-later
"""Which candidate each of the caller's faces gets, where the working copy has divided the face among several.

Candidates are smaller than the faces of a coarse mesh, and the largest candidate in a face may belong to a part that
has little of the face. So faces choose from above: first the side of the last merge that has most of the face, then,
within this side, that of an earlier merge, down to one candidate.
"""

from __future__ import annotations

import numpy as np

from ..arrays.indexing import run_starts, sums_by
from ..arrays.int64 import arange, full
from ..arrays.pairs import distinct_pairs
from ..cuts.hierarchy import Hierarchy

# A refined face leaves the part that has most of it only if this shortens the boundary by more than the area lost,
# divided by this width, in units of the square root of the area of the component.
WIDTH = 0.01


class FaceVotes:
    """The area that candidates have of each face, with the order in which the candidates merge.

    Parameters
    ----------
    owner : (r,) int64
        Face that each vote is for, 0..n_faces-1.
    label : (r,) int64
        Candidate that each vote names.
    weight : (r,) float64
        Area of the face that lies in the candidate, above 0.
    n_faces : int
    hierarchy : Hierarchy
        Over the candidates; in the end all are one part.
    """

    def __init__(
        self, owner: np.ndarray, label: np.ndarray, weight: np.ndarray, n_faces: int, hierarchy: Hierarchy
    ) -> None:
        self._tree = hierarchy.dendrogram
        self._place = self._tree.place
        self.n_faces = n_faces
        # One cell for each face and candidate in it, those of one face in the order of the tree.
        cells, cell = distinct_pairs(owner, self._place[label])
        self._cells = cells
        self._weight = sums_by(cell, weight, len(cells))

    def winners(self) -> np.ndarray:
        """Choose a candidate for each face, from the last merge down.

        Returns
        -------
        winner : (n_faces,) int64
            -1 for a face without a vote. Of sides that have equally much of a face the first of the merge wins.

        Notes
        -----
        O(r) for each of as many rounds as there are merges within one face, at most.
        """
        tree, (face, place), weight = self._tree, self._cells.T, self._weight
        winner = full(self.n_faces, -1)
        while len(face):
            first = run_starts(face)
            count = np.diff(np.append(first, len(face)))
            # What brings the outermost two candidates together brings all together that lie between them.
            low, high = tree.order[place[first]], tree.order[place[first + count - 1]]
            winner[face[first]] = low  # for good where low and high are one
            row = np.repeat(arange(len(first)), count)
            divided = (low != high)[row]
            face, place, weight, row = (x[divided] for x in (face, place, weight, row))
            right = place >= self._joins(low, high)[row, 1]
            surplus = np.bincount(row, np.where(right, weight, -weight), len(first))
            to_right = surplus > 1e-9 * np.bincount(row, weight, len(first))  # not by rounding alone
            kept = right == to_right[row]
            face, place, weight = face[kept], place[kept], weight[kept]
        return winner

    def loss(self, face: np.ndarray, own: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Area of faces that their parts lose when the faces change candidate.

        Parameters
        ----------
        face : (k,) int64
        own, other : (k,) int64
            Candidate of each face, and another one.

        Returns
        -------
        loss : (k,) float64
            Before two candidates merge, their parts are the two sides of this merge: how much more of the face the
            side of ``own`` has. Negative where it has less.
        """
        total = np.append(0.0, np.cumsum(self._weight))
        n = np.int64(len(self._place) + 1)
        key = self._cells[:, 0] * n + self._cells[:, 1]
        joins = self._joins(own, other)
        start, middle, end = (total[np.searchsorted(key, face * n + at)] for at in joins.T)
        more_on_left = 2 * middle - start - end
        return np.where(self._place[own] < joins[:, 1], more_on_left, -more_on_left)

    def _joins(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Row of the tree's joins, (k, 3), that brings each two candidates together; any for one and the same."""
        row = np.searchsorted(self._tree.rows, self._tree.row_of(a, b))
        return np.append(self._tree.joins, [[0, 0, 0]], axis=0)[np.minimum(row, len(self._tree.joins))]
