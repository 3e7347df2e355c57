# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors for parts: told apart by color-blind people, and never alike at a cut."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ..result.numbering import NumberedParts, NumberGraph
from ..surface.arrays import frozen

# Okabe & Ito's palette without black, then Paul Tol's muted scheme, as sRGB bytes: both made
# to stay distinct under the common kinds of color blindness. Tol's colors are in the order in which
# each differs most from those before it, so that a model of ten parts has no two that look alike.
PALETTE = np.array([
    (86, 180, 233), (230, 159, 0), (0, 158, 115), (204, 121, 167), (240, 228, 66),
    (0, 114, 178), (213, 94, 0), (51, 34, 136), (136, 34, 85), (153, 153, 51), (221, 204, 119),
    (17, 119, 51), (136, 204, 238), (170, 68, 153), (68, 170, 153), (204, 102, 119),
]) / 255.0

# Kelly (1965), colors of maximum contrast, without black, white and grey; bright, but not all of
# them are told apart by color-blind people.
_KELLY = np.array([
    (0, 103, 165), (243, 195, 0), (190, 0, 50), (141, 182, 0), (135, 86, 146), (243, 132, 0),
    (161, 202, 241), (0, 136, 86), (230, 143, 172), (136, 45, 23), (220, 211, 0), (96, 78, 151),
    (249, 147, 121), (179, 68, 108), (101, 69, 34), (194, 178, 128),
]) / 255.0

#: What parts can be colored with: a name, and (c, 3) sRGB, 0..1.
PALETTES = {
    "Colour-blind safe": PALETTE,
    "Pastel": 0.5 + 0.5 * PALETTE,
    "Bright": _KELLY,
}

# Viewing with a missing cone type (Vienot et al. 1999), on linear RGB.
_DEFICIENCIES = np.array([
    [[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]],
    [[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]],
])


def distance_matrix(colors: np.ndarray = PALETTE) -> np.ndarray:
    """(c, c) smallest difference of two colors over normal, protan and deutan vision."""
    linear = np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)
    views = [linear] + [linear @ m.T for m in _DEFICIENCIES]
    views = [np.cbrt(np.clip(view, 0.0, 1.0)) for view in views]  # about even to the eye
    return np.min([np.linalg.norm(v[:, None] - v[None], axis=2) for v in views], axis=0)


def part_colors(count: int, neighbors: np.ndarray, palette: np.ndarray = PALETTE) -> np.ndarray:
    """One color per part; each new part takes what differs most from its neighbors.

    Parameters
    ----------
    count : int
    neighbors : (e, 2) int64
        Pairs of parts that touch.
    palette : (c, 3) float64
        Colors to choose from.

    Returns
    -------
    colors : (count, 3) float64
        sRGB, 0..1. The first c parts differ all; later ones repeat, but not beside each other.
    """
    return palette[chosen_colors(count, neighbors, palette)]


def chosen_colors(
    count: int, neighbors: np.ndarray, palette: np.ndarray, wanted: np.ndarray | None = None
) -> np.ndarray:
    """Which color of the palette each part has; see ``part_colors``.

    Parameters
    ----------
    count, neighbors, palette
        As in ``part_colors``.
    wanted : (count,) int64, optional
        Which color each part is to have unless a neighbor has it; -1 for any.

    Returns
    -------
    chosen : (count,) int64
    """
    apart = distance_matrix(palette)
    chosen = np.full(count, -1)
    used = np.zeros(len(palette), np.int64)
    around = [[] for _ in range(count)]
    for a, b in neighbors.tolist():
        around[a].append(b)
        around[b].append(a)
    for part in range(count):
        beside = [chosen[other] for other in around[part] if chosen[other] >= 0]
        room = apart[beside].min(axis=0) if beside else np.ones(len(palette))
        if wanted is not None and wanted[part] >= 0 and room[wanted[part]] > 0:
            chosen[part] = wanted[part]
        else:
            # Least used first, then clearly unlike the neighbors, then palette order.
            rank = np.lexsort((np.arange(len(palette)), -np.minimum(room, 0.25), used + 99 * (room == 0)))
            chosen[part] = rank[0]
        used[chosen[part]] += 1
    return chosen


def number_colors(numbered: NumberedParts, palette: np.ndarray = PALETTE) -> np.ndarray:
    """One color per part, the same at every level of detail, and never that of a part it touches at some level.

    Changes by hand change no other part's color unless they make two parts of one color touch.

    Parameters
    ----------
    numbered : NumberedParts
    palette : (c, 3) float64
        Colors to choose from.

    Returns
    -------
    colors : (count, 3) float64
        sRGB, 0..1.
    """
    chosen = _chosen_by_number(numbered.graph, palette.tobytes())
    return palette[chosen[np.searchsorted(numbered.graph.numbers, numbered.numbers)]]


@lru_cache(16)
def _chosen_by_number(graph: NumberGraph, palette_bytes: bytes) -> np.ndarray:
    """(k,) int64, place in the palette of each number; kept, as all levels of detail share one graph."""
    palette = np.frombuffer(palette_bytes).reshape(-1, 3)
    wanted = None
    if graph.unpinned is not None and graph.unpinned_index is not None:
        before = _chosen_by_number(graph.unpinned, palette_bytes)
        wanted = np.where(graph.unpinned_index >= 0, before[graph.unpinned_index], -1)
    return frozen(chosen_colors(len(graph.numbers), graph.pairs, palette, wanted), np.int64)
