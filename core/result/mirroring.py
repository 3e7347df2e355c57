# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes by hand made on both sides of a plane of symmetry."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..surface.arrays import components
from ..surface.labels import FaceGraph, connect
from .numbering import NumberedParts

CRUMB = 0.02  # share of its part's area below which a region that the image of a change leaves alone is no part


def twin_numbers(numbered: NumberedParts) -> dict[int, int]:
    """Number of the mirror image of each part that has one; a part may be its own.

    numbered : NumberedParts. Returns dict of int -> int.
    """
    twin = numbered.parts.twin
    has = np.flatnonzero(twin >= 0)
    return dict(zip(numbered.numbers[has].tolist(), numbered.numbers[twin[has]].tolist(), strict=True))


def without_crumbs(graph: FaceGraph, before: np.ndarray, asked: np.ndarray, both: np.ndarray) -> np.ndarray:
    """Give what the mirror image of a change cut off by chance to the part around it.

    Where faces have no exact images, the image of a cut may leave a few of them alone that the cut itself did not.

    Parameters
    ----------
    graph : FaceGraph
        Of p faces.
    before, asked, both : (p,) int64
        Number of the part of each face before a change, after it, and after its mirror image, too.

    Returns
    -------
    both : (p,) int64
        Regions in which a face was changed stay.
    """
    extra = both != asked
    first, second = graph.pairs.T
    same = np.flatnonzero(both[first] == both[second])
    region = components(graph.n_faces, first[same], second[same])[1]
    small = np.bincount(region, graph.area)[region] < CRUMB * np.bincount(both, graph.area)[both]
    concerned = np.isin(both, np.concatenate([asked[extra], both[extra]]))
    left = np.bincount(region, both != before)[region] == 0
    return np.where(small & concerned & left, connect(graph, both), both)


def on_both_sides(
    before: np.ndarray, after: np.ndarray, twin: np.ndarray, twin_number: dict[int, int], new: Callable[[], int]
) -> np.ndarray:
    """Make the mirror image of a change as well.

    Parameters
    ----------
    before, after : (n,) int64
        Number of the part of each face or candidate before and after the change.
    twin : (n,) int64
        Mirror image of each; -1 for none.
    twin_number : dict of int -> int
        Mirror image of each part there was; see ``twin_numbers``.
    new : callable
        Returns a number that no part has, another one each time.

    Returns
    -------
    after : (n,) int64
        As given where the image of a change meets the change itself, or parts that are no images of each other, or
        where a part would have nothing left.
    """
    result = after.copy()
    moved = after != before
    of_new: dict[int, int] = {}
    image_of = np.full(int(max(before.max(), *twin_number)) + 1, -1)
    image_of[list(twin_number)] = list(twin_number.values())
    for number in np.unique(after[moved & (twin >= 0)]).tolist():
        mine = np.flatnonzero(moved & (twin >= 0) & (after == number))
        image = twin[mine]
        known = number in twin_number
        target = twin_number.get(number, 0)
        if not known and not (before == number).any():
            # A new part that reaches over the plane, or a half of which the other half is left, is its own image.
            itself = moved[image] & (after[image] == number)
            target = number if itself.mean() > 0.5 else of_new.setdefault(number, new())
        if not target:
            continue
        right = ~moved[image] & (image_of[before[mine]] == before[image])
        result[image[right]] = target
    gone = np.setdiff1d(after, result)
    image_stays = np.isin([twin_number.get(number, number) for number in gone.tolist()], after)
    return after.copy() if image_stays.any() else result
