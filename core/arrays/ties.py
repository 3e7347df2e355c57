# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that are equal but for rounding: which is the first of them, and numbers without their last digits."""

from __future__ import annotations

import numpy as np

from .int64 import cumsum

# Numbers whose difference is less, in units of the larger, are equal but for rounding: models come in single precision,
# or with six digits, and a model that is moved or scaled comes with others. They are compared with the largest, or the
# least, and not rounded one by one: two lengths that differ in the last digit would be equal at one scale and not at
# another.
TIE = 2.0**-17
DENSE = 30_000  # number of values from which on it takes too long to find out which are equal


def first_largest(values: np.ndarray) -> int:
    """Find the largest value; of values that differ from it by rounding only, the first.

    On a symmetric shape two points are equally far from its middle. The last bit of the two distances depends on
    the processor and on the position of the shape, but the order of the vertices does not.

    Parameters
    ----------
    values : (n,) float64
        At least one, none negative.

    Returns
    -------
    index : int
    """
    return int((values >= (1 - TIE) * values.max()).argmax())


def first_least(rows: np.ndarray) -> np.ndarray:
    """The column of the least value of each row, (n,) int64; of those that differ by rounding only, the first.

    rows : (n, k) float64, none negative.
    """
    return (rows <= (1 + TIE) * rows.min(axis=1)[:, None]).argmax(axis=1)


def rounded(values: np.ndarray, digits: int = 18) -> np.ndarray:
    """Numbers without their last digits, so that rounding errors do not decide which of two equal ones is larger.

    values : array of float64. digits : int, binary ones that stay; 18 are TIE. Returns float64.
    """
    mantissa, exponent = np.frexp(values)
    return np.ldexp(np.rint(mantissa * 2.0**digits), exponent - digits)


def ranks(values: np.ndarray, unit: float) -> np.ndarray:
    """Number values in their order, those that differ by rounding only alike.

    Parameters
    ----------
    values : (n,) float64
    unit : float
        Values are equal if none between them is farther from the next than TIE of this. A long row of such, as a dense
        mesh has them, is divided evenly.

    Returns
    -------
    rank : (n,) int64
    """
    same = TIE * max(unit, 1e-300)
    if len(values) > DENSE:
        return np.rint(values / same).astype(np.int64)
    order = np.argsort(values, kind="stable")
    ranked = values[order]
    begins = np.append(True, np.diff(ranked) > same)[: len(values)]
    row = cumsum(begins) - 1
    part = ((ranked - ranked[begins][row]) / (8 * same)).astype(np.int64)
    begins[1:] |= part[1:] != part[:-1]
    rank = np.empty(len(values), np.int64)
    rank[order] = cumsum(begins) - 1
    return rank


def on_grid(values: np.ndarray) -> np.ndarray:
    """Numbers of about 1 in whole steps of 2**-40: logarithms and such, whose last digits differ between versions."""
    return np.rint(values * 2.0**40) / 2.0**40


def in_steps(values: np.ndarray) -> np.ndarray:
    """Features in whole steps of 2**-14: what is 0 or 1, or equal, but for rounding, is exactly that."""
    return np.rint(values * 2.0**14) / 2.0**14


def square_roots(values: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Square roots of differences that would not be negative but for rounding.

    values : array of float64. scale : array of float64, size of what they are differences of. What is below 1e-12 of
    it is 0: the root would be a thousand times as large as the rounding error that it comes from.
    """
    return np.sqrt(np.where(values > 1e-12 * scale, values, 0.0))


def whole_steps(length: np.ndarray, step: float = 2.0**-22) -> np.ndarray:
    """Lengths of ways in whole steps, one or more: their sums are exact.

    Of two ways that are equally long, rounding must not choose; of those through elements that lie in one place, that
    through the fewest is the shortest.
    length : array of float64, in units of about the size of the surface.
    """
    return np.maximum(np.rint(length / step), 1.0)
