# SPDX-License-Identifier: GPL-3.0-or-later
"""NumPy's functions of these names for whole numbers, which they make of 64 bits on every system.

Without a dtype, NumPy 1 makes them of 32 bits on Windows - in Blender 4.2 and 4.5, that is. Two numbers packed into
one, such as the ends of an edge, do not fit into 32 bits, and equal arrays of other widths have other bytes.
"""

from __future__ import annotations

from operator import index
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def arange(start: int, stop: int | None = None, step: int = 1) -> np.ndarray:
    """The numbers of ``range`` with these arguments, (n,) int64."""
    first, end = (0, index(start)) if stop is None else (index(start), index(stop))
    return np.arange(first, end, index(step), dtype=np.int64)


def full(shape: int | tuple[int, ...], value: int) -> np.ndarray:
    """An array of this shape of one whole number, int64."""
    return np.full(shape, index(value), np.int64)


def cumsum(values: ArrayLike, axis: int | None = None) -> np.ndarray:
    """Running sums of whole numbers or truth values, along an axis or of all: int64."""
    return np.cumsum(values, axis, np.int64)
