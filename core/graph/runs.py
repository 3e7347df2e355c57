# SPDX-License-Identifier: GPL-3.0-or-later
"""Level sets that run on across bridges between loose parts of a surface.

Two loose parts that lie on each other touch in many slabs, in some by chance and in some not, as an eye in its socket
does. Were they joined wherever they touch, every slab between in which they do not would make a loop that the shape
has not. So two loose parts are joined in one run of slabs, the one with the most bridges, and loose parts along a
spanning forest of such runs.
"""

from __future__ import annotations

import numpy as np

from ..surface.arrays import components, distinct_pairs, expanded, last_of_each


def joined_runs(
    bridges: np.ndarray, contour_pieces: np.ndarray, loose_part: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find which pieces and which contours of different loose parts are joined.

    Parameters
    ----------
    bridges : (l, 2) int64
        Pieces of one slab in two loose parts, that of the lower loose part first; a pair once for every bridge there.
    contour_pieces : (C, 2) int64
        Piece below and piece above each contour.
    loose_part : (P,) int64
        Loose part of each piece.

    Returns
    -------
    pieces : (j, 2) int64
        Pieces that are one.
    contours : (i, 2) int64
        Contours that are one: between pieces that are one below and above. The graph of pieces and contours has then
        no loop that the loose parts have not.
    """
    # Imported here, because Blender's panel reads stored parts also where SciPy is missing, to say that it is.
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import minimum_spanning_tree

    pairs, pair = distinct_pairs(*bridges.T)
    n_bridges = np.bincount(pair, minlength=len(pairs))
    contours, between = _side_by_side(pairs, contour_pieces)
    n_runs, run = components(len(pairs), *between.T)
    weight = np.bincount(run, n_bridges, n_runs)
    ends = np.empty((n_runs, 2), np.int64)
    ends[run] = loose_part[pairs]
    cells, cell = distinct_pairs(*ends.T)
    best = last_of_each(cell, weight, -np.arange(n_runs), count=len(cells))
    # Distinct ranks, so that the tree does not depend on how ties are broken.
    rank = np.empty(len(cells))
    rank[np.lexsort((np.arange(len(cells)), -weight[best]))] = np.arange(1, len(cells) + 1)
    n_parts = int(loose_part.max()) + 1
    tree = minimum_spanning_tree(
        coo_array((rank, tuple(cells.T.astype(np.int32))), shape=(n_parts, n_parts)).tocsr())
    chosen = np.zeros(n_runs, bool)
    chosen[best[np.isin(rank, tree.data)]] = True
    return pairs[chosen[run]], contours[chosen[run[between[:, 0]]]]


def _side_by_side(pairs: np.ndarray, contour_pieces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Contours of different loose parts between pairs of pieces below and pairs above.

    pairs : (k, 2), pieces of one slab. Returns (i, 2) the contours, and (i, 2) the pair below and the pair above.
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
    at = np.full(len(known), -1)
    at[place[:len(pairs)]] = np.arange(len(pairs))
    above = at[place[len(pairs):]]
    return contours[above >= 0], np.stack([below, above], axis=1)[above >= 0]
