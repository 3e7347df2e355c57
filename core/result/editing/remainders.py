# SPDX-License-Identifier: GPL-3.0-or-later
"""What a change by hand cuts off from the parts that it takes faces from: small pieces go along with what was taken."""

from __future__ import annotations

import numpy as np

from ...arrays.indexing import largest_of_each
from ...arrays.pairs import both_ways
from ...arrays.ties import TIE
from ...mesh.face_graph import FaceGraph
from ...mesh.labels import majority
from .mirrored import Sides, are_beyond

#: A piece goes along if it is smaller than this share of the largest that is left of its part ...
BESIDE_LARGEST = 1 / 3
#: ... or than this share of what the part was.
BESIDE_WHOLE = 0.1


def with_small_pieces(
    graph: FaceGraph, before: np.ndarray, after: np.ndarray, beside_taken: float = 1.0
) -> np.ndarray:
    """Have small pieces that a change cuts off go along with it, so that no part crumbles.

    Where a part is left in several pieces, the largest stays. Of the others, those that are small go to the part that
    took most of what was around them. Pieces that were apart before are parts of their own in this.

    Parameters
    ----------
    graph : FaceGraph
        Of n faces, or candidates.
    before, after : (n,) int64
        Number of the part of each before and after the change.
    beside_taken : float
        A piece is not small if it is larger than this share of what was taken from its part.

    Returns
    -------
    after : (n,) int64
        What changed is as given. Images of each other are treated alike, but for pieces that lie between two images.
    """
    moved = after != before
    count, piece = graph.regions(np.where(moved, -1, before))
    n_wholes, whole = graph.regions(before)
    of = np.empty(count, np.int64)
    of[piece] = whole
    area = np.bincount(piece, graph.area, count)
    left = np.bincount(piece, ~moved, count) > 0
    taken = np.bincount(whole, np.where(moved, graph.area, 0.0), n_wholes)[of]
    largest = largest_of_each(of[left], area[left], n_wholes)[of]
    limit = np.maximum(BESIDE_LARGEST * largest, BESIDE_WHOLE * np.bincount(whole, graph.area, n_wholes)[of])
    # Areas of images differ by rounding, and so may sizes that are as large as each other.
    small = left & (area < (1 - TIE) * np.minimum(np.minimum(limit, largest), beside_taken * taken))
    inner, outer = both_ways(graph.pairs).T
    around = small[piece[inner]] & moved[outer] & (whole[inner] == whole[outer])
    taker = majority(piece[inner[around]], after[outer[around]], np.tile(graph.length, 2)[around], count)[piece]
    return np.where(taker >= 0, taker, after)


def halved_between_images(
    graph: FaceGraph, without: np.ndarray, after: np.ndarray, sides: Sides, image: np.ndarray
) -> np.ndarray:
    """Divide what lies between a part and its image, touches both alike and went along with one of them.

    Parameters
    ----------
    graph : FaceGraph
        Of n faces.
    without, after : (n,) int64
        Number of the part of each face without what went along, and with it.
    sides : Sides
    image : (k,) int64
        Number of the image of the part of each number.

    Returns
    -------
    after : (n,) int64
        Each part has what is on its side, and what is across the plane stays; as given if that leaves more pieces.
    """
    between = are_beyond(without, after, sides)
    if not between.any():
        return after
    halved = np.where(between, image[after], after)
    return after if graph.regions(halved)[0] > graph.regions(after)[0] else halved
