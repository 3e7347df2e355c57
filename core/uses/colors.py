# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors for parts: color-blind people can tell them apart, and parts that touch never have one color."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from ..arrays.indexing import frozen
from ..arrays.int64 import full
from ..arrays.pairs import partners_of
from ..errors import ParameterError, wrong_kind
from ..mesh.arguments import whole_numbers
from ..result.numbering import NumberedParts, NumberGraph
from ..sentence import Sentence

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

# The palette of Okabe and Ito without black, then the muted scheme of Paul Tol, in sRGB, 0..1. Both were made to stay
# distinct under the common kinds of color blindness. Each of the later colors is the one that differs most from all
# before it, so that the first colors, which most models use, differ clearly. Seven of them are moved a little, so that
# each two colors of a palette are 25 or more apart in CIELAB, where people just notice 2.3.
PALETTE = np.array([
    (86, 180, 233), (230, 159, 0), (0, 158, 115), (204, 121, 167), (240, 228, 66),
    (0, 114, 178), (213, 94, 0), (51, 34, 136), (228, 209, 125), (136, 34, 85), (152, 152, 50),
    (167, 223, 242), (20, 114, 41), (170, 68, 153), (70, 154, 147), (186, 85, 98),
]) / 255.0

# Light colors, after those above, as far apart from each other as they must be.
_PASTEL = np.array([
    (157, 211, 242), (240, 199, 107), (107, 199, 174), (227, 190, 210), (248, 255, 153), (92, 165, 230),
    (230, 156, 107), (132, 121, 180), (169, 116, 135), (173, 221, 151), (235, 224, 176), (117, 153, 104),
    (198, 191, 255), (221, 148, 205), (144, 167, 161), (246, 158, 158),
]) / 255.0

# The colors of maximum contrast of [Kelly1965] without black, white and gray, in sRGB, 0..1, two of them moved a
# little as above. Color-blind people cannot tell all of them apart.
_KELLY = np.array([
    (0, 103, 165), (243, 195, 0), (190, 0, 50), (141, 182, 0), (135, 86, 146), (243, 132, 0),
    (161, 202, 241), (0, 136, 86), (230, 143, 172), (136, 45, 23), (216, 222, 0), (62, 70, 153),
    (249, 147, 121), (179, 68, 108), (101, 69, 34), (194, 178, 128),
]) / 255.0

#: Palettes by the name that the user sees; each is (c, 3) float64, sRGB, 0..1.
PALETTES = {
    "Colour-blind safe": PALETTE,
    "Pastel": _PASTEL,
    "Bright": _KELLY,
}

CLEAR = 0.25  # difference of two colors, see ``distance_matrix``, that is clear to the eye: more counts as much

#: What the user sees in place of a name, which is that of files and scripts.
LABELS = {"Colour-blind safe": "Color-Blind Safe"}

# Matrices that turn linear RGB into what people without one type of cones see: protanopes, then deuteranopes
# (Vienot, Brettel and Mollon 1999).
_DEFICIENCIES = np.array([
    [[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]],
    [[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]],
])


def linear(colors: ArrayLike) -> np.ndarray:
    """Turn sRGB, which people choose and files of faces use, into the linear RGB of light, materials and objects.

    colors : array_like of float, 0..1. Returns float64 of the same shape.
    """
    colors = np.asarray(colors, np.float64)
    return np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)


def distance_matrix(colors: np.ndarray = PALETTE) -> np.ndarray:
    """Measure how much each two colors differ for those who can tell them apart least.

    Parameters
    ----------
    colors : (c, 3) float64
        sRGB, 0..1.

    Returns
    -------
    distance : (c, c) float64
        Smallest distance of two colors over normal, protanopic and deuteranopic vision: Euclidean, of the cube roots of
        linear RGB.
    """
    light = linear(colors)
    views = [light] + [light @ m.T for m in _DEFICIENCIES]
    views = [np.cbrt(np.clip(view, 0.0, 1.0)) for view in views]  # equal steps of these look about equally large
    return np.min([np.linalg.norm(v[:, None] - v[None], axis=2) for v in views], axis=0)


def part_colors(count: int, neighbors: np.ndarray) -> np.ndarray:
    """Choose a color of PALETTE for each part, in the order of the parts.

    Parameters
    ----------
    count : int
        Number of parts.
    neighbors : (e, 2) int64
        Pairs of parts that touch.

    Returns
    -------
    colors : (count, 3) float64
        sRGB, 0..1.

    Raises
    ------
    ParameterError
        There are no such parts; ``error.name`` says which argument is wrong.
    """
    n_parts, pairs = whole_numbers(count), whole_numbers(neighbors)
    if n_parts is None or n_parts.ndim or n_parts < 0:
        raise wrong_kind("count", "a whole number from 0", count)
    if pairs is not None and not pairs.size:
        pairs = pairs.reshape(0, 2)
    if pairs is None or pairs.shape[1:] != (2,) or not ((pairs >= 0) & (pairs < n_parts)).all():
        raise ParameterError(Sentence("Neighbors must be pairs of whole numbers from 0 to {last}.",
                                      last=int(n_parts) - 1), "neighbors")
    return PALETTE[chosen_colors(int(n_parts), pairs, PALETTE)]


def chosen_colors(
    count: int, neighbors: np.ndarray, palette: np.ndarray, wanted: np.ndarray | None = None
) -> np.ndarray:
    """Choose a place in the palette for each part, in the order of the parts.

    A part gets the color that is wanted for it, or, of the colors that no neighbor has, the one used least so far; of
    several such colors, one that differs clearly from those of the neighbors, or else most; then the first of the
    palette. If its neighbors have all colors, one or a few of them get another, where they can.

    Parameters
    ----------
    count : int
        Number of parts.
    neighbors : (e, 2) int64
        Pairs of parts that touch.
    palette : (c, 3) float64
        Colors to choose from, sRGB, 0..1.
    wanted : (count,) int64, optional
        Place in the palette of the color that each part gets unless a neighbor has it already; -1 for any color.

    Returns
    -------
    chosen : (count,) int64
        Place in the palette, 0..c-1. The first c parts have c different colors unless a later part touches all of them.
        Later parts repeat them, but parts that touch have different colors unless more than c of them touch each other,
        or nearly.
    """
    apart = distance_matrix(palette)
    chosen = full(count, -1)
    used = np.zeros(len(palette), np.int64)
    around = partners_of(neighbors, count)
    for part in range(count):
        beside = [chosen[other] for other in around[part] if chosen[other] >= 0]
        room = apart[beside].min(axis=0) if beside else np.ones(len(palette))
        if wanted is not None and wanted[part] >= 0 and room[wanted[part]] > 0:
            chosen[part] = wanted[part]
        else:
            rank = np.lexsort((-np.minimum(room, CLEAR), used, room == 0))
            chosen[part] = rank[0]
            if not room.any():
                _make_room(part, around, chosen, len(palette))
                used = np.bincount(chosen[:part], minlength=len(palette))
        used[chosen[part]] += 1
    return chosen


def _make_room(part: int, around: list[list[int]], chosen: np.ndarray, n_colors: int) -> None:
    """Give a part whose neighbors have all colors that of a few of them, which get others; nothing if none can move.

    around : (count,) lists of the neighbors of each part. chosen : (count,) int64, written to; -1 for none so far.
    """
    holders = {color: [other for other in around[part] if chosen[other] == color] for color in range(n_colors)}
    for color in sorted(holders, key=lambda color: len(holders[color])):
        taken = [{color, *chosen[around[other]].tolist()} for other in holders[color]]
        free = [next((other for other in range(n_colors) if other not in colors), -1) for colors in taken]
        if -1 not in free:
            chosen[holders[color]] = free
            chosen[part] = color
            return


def number_colors(
    numbered: NumberedParts, palette: np.ndarray = PALETTE, former: tuple[tuple[int, int], ...] = ()
) -> np.ndarray:
    """Choose a color for each part by its number, which keeps its color at every level of detail.

    Parts that touch at some level have different colors unless the palette is too small. A change by hand changes the
    color of no other part, unless it makes two parts of one color touch.

    Parameters
    ----------
    numbered : NumberedParts
    palette : (c, 3) float64
        Colors to choose from, sRGB, 0..1.
    former : tuple of (int, int)
        Numbers of parts, and the place in the palette of the color that each had in an earlier result.

    Returns
    -------
    colors : (count, 3) float64
        sRGB, 0..1.
    """
    chosen = _chosen_by_number(numbered.graph, palette.tobytes(), former)
    return palette[chosen[np.searchsorted(numbered.graph.numbers, numbered.numbers)]]


def number_places(
    numbered: NumberedParts, palette: np.ndarray = PALETTE, former: tuple[tuple[int, int], ...] = ()
) -> tuple[tuple[int, int], ...]:
    """Tell the colors of the parts of all levels of detail, for a later result of the same mesh.

    Returns the numbers of parts, and the place in the palette of each one's color; parameters as of ``number_colors``.
    """
    chosen = _chosen_by_number(numbered.graph, palette.tobytes(), former)
    return tuple(zip(numbered.graph.numbers.tolist(), chosen.tolist(), strict=True))


@lru_cache(16)
def _chosen_by_number(graph: NumberGraph, palette_bytes: bytes, former: tuple[tuple[int, int], ...]) -> np.ndarray:
    """Place in the palette of each number of a graph, (k,) int64; kept, since all levels of detail share one graph."""
    palette = np.frombuffer(palette_bytes).reshape(-1, 3)
    places = dict(former)
    wanted = np.array([places.get(number, -1) for number in graph.numbers.tolist()], np.int64)
    if graph.unpinned is not None and graph.unpinned_index is not None:
        before = _chosen_by_number(graph.unpinned, palette_bytes, former)
        wanted = np.where(graph.unpinned_index >= 0, before[graph.unpinned_index], wanted)
    return frozen(chosen_colors(len(graph.numbers), graph.pairs, palette, wanted), np.int64)
