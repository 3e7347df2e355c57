# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of curves, taken apart where few curves go across."""

from __future__ import annotations

import numpy as np

from ...arrays.int64 import arange, cumsum
from ...arrays.ties import rounded
from ...arrays.vectors import lengths

# Of larger networks, not all ways to divide them are looked at. So many curves may go from one side to the other: each
# face between curves then goes across twice or not at all, and a line across is met by every face once on each side.
MOST_PLACES, MOST_ACROSS = 12, 3


def nested_sides(places: np.ndarray, curves: np.ndarray) -> np.ndarray:
    """Divide the places where the curves of a network meet, again and again.

    Parameters
    ----------
    places : (n, 3) float64
    curves : (k, 2) int64
        The two places that each curve connects, 0..n-1.

    Returns
    -------
    sides : (s, n) bool
        The places on one side of each division. Smaller sides come first; of two sides, one is within the other or
        both have no place in common. Each has two places or more that no smaller one has, and as many are in none.
        (0, n) for fewer than 4 or more than MOST_PLACES places.
    """
    n = len(places)
    none = np.zeros((0, n), bool)
    if not 4 <= n <= MOST_PLACES:
        return none
    # No side has the place in the middle, so that no two of them are the two sides of one division.
    middle = int(rounded(lengths(places - places.mean(axis=0))).argmin())
    inside = (arange(1 << (n - 1))[:, None] >> arange(n - 1)) & 1 == 1
    inside = np.insert(inside, middle, False, axis=1)
    size = inside.sum(axis=1)
    inside = inside[(size >= 2) & (size <= n - 2)]
    across = (inside[:, curves[:, 0]] != inside[:, curves[:, 1]]).sum(axis=1)
    inside, across = inside[across <= MOST_ACROSS], across[across <= MOST_ACROSS]
    uneven = np.abs(n - 2 * inside.sum(axis=1))
    order = np.lexsort((rounded(_spread(places, inside) + _spread(places, ~inside)), uneven, across))
    sides = none
    for side in inside[order]:
        both, only = (sides & side).any(axis=1), (sides & ~side).any(axis=1)
        if (both & only & (side & ~sides).any(axis=1)).any():
            continue
        more = np.append(sides, side[None], axis=0)
        more = more[np.argsort(more.sum(axis=1), kind="stable")]
        if (own_places(more).sum(axis=1) > 1).all():
            sides = more
    return sides


def own_places(sides: np.ndarray) -> np.ndarray:
    """The places of each side that no smaller one has, and last those that are in none: (s + 1, n) bool."""
    before = cumsum(sides, axis=0) - sides
    return np.concatenate([sides & (before == 0), ~sides.any(axis=0, keepdims=True)])


def _spread(places: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Sum of the squared distances of some places from their mean, for each choice, (c, n) bool: (c,) float64."""
    count = np.maximum(chosen.sum(axis=1), 1)
    return chosen @ (places**2).sum(axis=1) - ((chosen @ places) ** 2).sum(axis=1) / count
