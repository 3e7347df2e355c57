# SPDX-License-Identifier: GPL-3.0-or-later
"""Level sets that run on across bridges between loose parts of a surface.

Two loose parts that lie on each other touch in many slabs, in some by chance and in some not, as an eye in its socket
does. Were they joined wherever they touch, every slab between in which they do not would make a loop that the shape
has not. So two loose parts are joined in one run of slabs, the one with the most bridges, and loose parts along a
spanning forest of such runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import expanded, last_of_each, place_among, ranges
from ..arrays.int64 import arange, cumsum
from ..arrays.pairs import distinct_pairs

MAX_LINKS = 100_000  # pairs of slab pieces that are looked at at once, of which each takes some 300 bytes


@dataclass(frozen=True, eq=False)
class FaceBridges:
    """Bridges between faces of different loose parts, each of which runs through several slabs.

    Attributes
    ----------
    elements : (l, 2) int64
        Elements of the two faces in the lowest slab that both have, that in the lower loose part first; the elements in
        the next slabs follow them.
    n_slabs : (l,) int64
        Number of slabs that both have, 1 or more.
    """

    elements: np.ndarray
    n_slabs: np.ndarray

    def pieces(self, element_piece: np.ndarray, chosen: np.ndarray) -> np.ndarray:
        """Slab pieces that some of the bridges link, (r, 2) int64, once for every slab. chosen : (k,) int64."""
        row, step = expanded(np.zeros(len(chosen), np.int64), self.n_slabs[chosen])
        return element_piece[self.elements[chosen[row]] + step[:, None]]


def joined_by_faces(
    bridges: FaceBridges, element_piece: np.ndarray, contour_pieces: np.ndarray, loose_part: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find which slab pieces and which contours of different loose parts are joined.

    Parameters
    ----------
    bridges : FaceBridges
    element_piece : (E,) int64
        Slab piece of each element.
    contour_pieces, loose_part
        As in ``joined_runs``.

    Returns
    -------
    pieces, contours
        What ``joined_runs`` returns for all slabs of all bridges, in another order.

    Notes
    -----
    Where thousands of loose parts cross, nearly every two of them have bridges, in nearly every slab. At most
    MAX_LINKS slab pieces are linked at once, beside those of two loose parts, and two loose parts that are joined by
    others with more bridges are not looked at.
    """
    cells, cell = distinct_pairs(*loose_part[element_piece[bridges.elements]].T)
    n_links = np.bincount(cell, bridges.n_slabs, len(cells)).astype(np.int64)
    order = np.argsort(cell, kind="stable")
    count = np.bincount(cell, minlength=len(cells))
    first = cumsum(count) - count

    def pieces(some: np.ndarray) -> np.ndarray:
        return bridges.pieces(element_piece, order[ranges(first[some], count[some])])

    chosen = arange(len(cells))
    if n_links.sum() > MAX_LINKS:
        chosen = _heaviest_forest(
            cells, n_links, lambda some: _Runs.of(pieces(some), contour_pieces, loose_part).weight)
    found = [joined_runs(pieces(some), contour_pieces, loose_part) for some in _blocks(chosen, n_links)]
    none = np.empty((0, 2), np.int64)
    return np.concatenate([none, *(p for p, _ in found)]), np.concatenate([none, *(c for _, c in found)])


def joined_runs(
    bridges: np.ndarray, contour_pieces: np.ndarray, loose_part: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find which slab pieces and which contours of different loose parts are joined.

    Parameters
    ----------
    bridges : (l, 2) int64
        Slab pieces of one slab, in two loose parts, that of the lower loose part first; a pair once for every bridge
        there.
    contour_pieces : (C, 2) int64
        Slab piece below and above each contour.
    loose_part : (P,) int64
        Loose part of each slab piece.

    Returns
    -------
    pieces : (j, 2) int64
        Slab pieces that are one.
    contours : (i, 2) int64
        Contours that are one: between slab pieces that are one below and above. The graph of slab pieces and contours
        has then no loop that the loose parts have not.
    """
    runs = _Runs.of(bridges, contour_pieces, loose_part)
    chosen = np.zeros(len(runs.pairs), bool)
    chosen[runs.best[_forest(runs.cells, runs.weight)]] = True
    return runs.pairs[chosen[runs.run]], runs.contours[chosen[runs.run[runs.below]]]


@dataclass(frozen=True, eq=False)
class _Runs:
    """Runs of slabs in which two loose parts touch.

    pairs, run : (k, 2) and (k,), slab pieces with a bridge between them, and the run of each pair. contours,
    below : (i, 2) and (i,), contours between pairs of one run, and the pair below. cells : (c, 2), the two loose parts
    of some run, each two once. best, weight : (c,), their run with the most bridges, and how many it has.
    """

    pairs: np.ndarray
    run: np.ndarray
    contours: np.ndarray
    below: np.ndarray
    cells: np.ndarray
    best: np.ndarray
    weight: np.ndarray

    @classmethod
    def of(cls, bridges: np.ndarray, contour_pieces: np.ndarray, loose_part: np.ndarray) -> _Runs:
        """Find the runs; see ``joined_runs``."""
        pairs, pair = distinct_pairs(*bridges.T)
        n_bridges = np.bincount(pair, minlength=len(pairs))
        contours, between = _side_by_side(pairs, contour_pieces)
        n_runs, run = components(len(pairs), *between.T)
        weight = np.bincount(run, n_bridges, n_runs)
        ends = np.empty((n_runs, 2), np.int64)
        ends[run] = loose_part[pairs]
        cells, cell = distinct_pairs(*ends.T)
        best = last_of_each(cell, weight, -arange(n_runs), count=len(cells))
        return cls(pairs, run, contours, between[:, 0], cells, best, weight[best])


def _forest(cells: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Which pairs of loose parts are in the spanning forest of most weight, (c,) bool; of equal ones the first.

    cells : (c, 2) int64, the lower loose part first, in order. weight : (c,) float64.
    """
    # Imported here, because Blender's panel reads stored parts also where SciPy is missing, to say that it is.
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import minimum_spanning_tree

    # Distinct ranks, so that the tree does not depend on how ties are broken.
    rank = np.empty(len(cells))
    rank[np.argsort(-weight, kind="stable")] = arange(1, len(cells) + 1)
    n_parts = int(cells.max(initial=-1)) + 1
    tree = minimum_spanning_tree(
        coo_array((rank, tuple(cells.T.astype(np.int32))), shape=(n_parts, n_parts)).tocsr())
    return np.isin(rank, tree.data)


def _heaviest_forest(
    cells: np.ndarray, most: np.ndarray, weigh: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """Rows of the ``_forest`` of pairs of loose parts, (f,) int64, without weighing them all.

    cells : (c, 2), in order. most : (c,), what each weighs at the most. weigh : the weights of some rows, rising.
    """
    n_parts = int(cells.max()) + 1
    weight, chosen = np.zeros(len(cells)), np.empty(0, np.int64)
    waiting = np.argsort(-most, kind="stable")
    while len(waiting):
        block = next(_blocks(waiting, most))
        waiting = waiting[len(block):]
        rows = np.sort(block)
        weight[rows] = weigh(rows)
        rows = np.sort(np.concatenate([chosen, rows]))
        chosen = rows[_forest(cells[rows], weight[rows])]
        if len(waiting):
            # Those that weigh more than any that waits are in the forest for good: what they join needs no others.
            least, next_one = most[waiting[0]], waiting[0]
            sure = chosen[(weight[chosen] > least) | ((weight[chosen] == least) & (chosen < next_one))]
            body = components(n_parts, *cells[sure].T)[1][cells[waiting]]
            waiting = waiting[body[:, 0] != body[:, 1]]
    return chosen


def _blocks(rows: np.ndarray, size: np.ndarray) -> Iterator[np.ndarray]:
    """Divide rows, (c,) int64, into blocks of MAX_LINKS at the most, or of one row. size : (n,) int64, of each row."""
    total, begin = np.append(0, cumsum(size[rows])), 0
    while begin < len(rows):
        end = max(begin + 1, int(np.searchsorted(total, total[begin] + MAX_LINKS, side="right")) - 1)
        yield rows[begin:end]
        begin = end


def _side_by_side(pairs: np.ndarray, contour_pieces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Contours of different loose parts between pairs of slab pieces below and pairs above.

    pairs : (k, 2), of one slab. Returns (i, 2) the contours, and (i, 2) the pair below and the pair above.
    """
    order = np.argsort(contour_pieces[:, 0], kind="stable")
    lower = contour_pieces[order, 0]
    first, end = np.searchsorted(lower, pairs), np.searchsorted(lower, pairs, side="right")
    count = end - first
    below, step = expanded(np.zeros(len(pairs), np.int64), count.prod(axis=1))
    contours = order[first[below] + np.stack([step // count[below, 1], step % count[below, 1]], axis=1)]
    upper = contour_pieces[contours, 1]
    # ``pairs`` is in order, and every pair in it once: a pair above is looked up by its place among both.
    known, place = distinct_pairs(*np.concatenate([pairs, upper]).T)
    at = place_among(place[:len(pairs)], len(known))
    above = at[place[len(pairs):]]
    return contours[above >= 0], np.stack([below, above], axis=1)[above >= 0]
