# SPDX-License-Identifier: GPL-3.0-or-later
"""NumPy's functions of these names where what they make are whole numbers: of 64 bits on every system.

Where nobody says how many, NumPy 1 makes them of 32 bits on Windows - in Blender 4.2 and 4.5, that is. Two numbers
packed into one, as of the ends of an edge, do not fit there, and equal numbers of other widths are not the same bytes.
"""

from __future__ import annotations

from operator import index
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def arange(start: int, stop: int | None = None, step: int = 1) -> np.ndarray:
    """Whole numbers at equal steps from ``start`` on, or from 0, to before ``stop``, or ``start``: (n,) int64."""
    first, end = (0, index(start)) if stop is None else (index(start), index(stop))
    return np.arange(first, end, index(step), dtype=np.int64)


def full(shape: int | tuple[int, ...], value: int) -> np.ndarray:
    """An array of this shape of one whole number, int64."""
    return np.full(shape, index(value), np.int64)


def cumsum(values: ArrayLike, axis: int | None = None) -> np.ndarray:
    """Sums of the first, the first two, ... of some whole numbers or truth values, int64."""
    return np.cumsum(values, axis, np.int64)
