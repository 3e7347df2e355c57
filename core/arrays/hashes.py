# SPDX-License-Identifier: GPL-3.0-or-later
"""Hashes: whole numbers that are equal for equal things, and hardly ever for others."""

from __future__ import annotations

import numpy as np

_MIX = 0x9E3779B97F4A7C1, 0x2545F4914F6CDD1D, 0x5851F42D4C957F2D  # odd factors that mix the bits of three coordinates
#: 2**64 over the golden ratio, made odd: products with it wrap around, and differ in all bits where numbers differ.
GOLDEN = np.uint64(0x9E3779B97F4A7C15)


def hashed_rows(points: np.ndarray) -> np.ndarray:
    """Numbers, (n,) uint64, that are equal for equal points, (n, 3) float64, and hardly ever for others."""
    x, y, z = (_mixed(column, factor) for column, factor in zip(points.T, _MIX, strict=True))
    return x ^ y ^ z


def hashed_sets(owner: np.ndarray, member: np.ndarray, count: int) -> np.ndarray:
    """Numbers, (count,) uint64, that are equal for owners of the same members in any order, and hardly ever for others.

    owner, member : (n,) int64, 0..count-1, and 0 or more.
    """
    scattered = np.random.default_rng(0).integers(0, 1 << 63, int(member.max(initial=-1)) + 1, dtype=np.uint64)
    total = np.zeros(count, np.uint64)
    np.add.at(total, owner, scattered[member])  # sums wrap around
    return total


def rehashed(number: np.ndarray) -> np.ndarray:
    """Other numbers, (n,) uint64, for numbers, (n,) uint64: equal for equal ones, in no proportion to them."""
    return (number ^ number >> np.uint64(32)) * GOLDEN


def _mixed(values: np.ndarray, factor: int) -> np.ndarray:
    """Numbers, (n,) uint64, that differ in all bits where values, (n,) float64, differ.

    A whole number has nothing but zeros in most of its digits, and a product alone would leave them there.
    """
    bits = (values + 0.0).view(np.uint64)  # -0.0 is 0.0
    bits = (bits ^ bits >> np.uint64(32)) * np.uint64(factor)
    return bits ^ bits >> np.uint64(29)
