# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets made at random whose parts are known: what train.py learns from beside meshes that people labelled.

People labelled closed surfaces of two parts and more. Of flat figures, and of sheets that are one part and nothing
else, they said nothing.
"""

from __future__ import annotations

import sys

import numpy as np
import packages

sys.path.append(str(packages.ROOT / "tests"))

import shapes
from figures import Figure, bent, circle, figure_of, sheet
from shapes import Shape

COUNTS = {"plain": 60, "figure": 120}
MIN_FACES_OF_PART, MAX_FACES = 20, 2500


def known_sheets(seed: int = 1) -> dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Sheets of one part, and flat figures of several, in any pose and order.

    Returns
    -------
    sheets : dict by name, KIND.NUMBER, of (vertices (n, 3), faces (m, 3), part of each face (1, m))
    """
    rng = np.random.default_rng(seed)
    makers = {"plain": plain_sheet, "figure": branching_figure}
    made = {}
    for kind, count in COUNTS.items():
        for number in range(count):
            shape, part = makers[kind](rng)
            shape, _, face = shapes.shuffled(Shape(shape.vertices @ shapes.rotation(rng), shape.faces), rng)
            made[f"{kind}.{number}"] = *shape, part[None, face]
    return made


# One part -----------------------------------------------------------------------------------------


def plain_sheet(rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """A polygon, rectangle or ellipse: flat, wrinkled or bent."""
    kind = rng.choice(["polygon", "rectangle", "ellipse"])
    if kind == "polygon":
        outline = _ring(int(rng.integers(3, 9)), rng)
    elif kind == "rectangle":
        outline = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    else:
        outline = np.array(circle(1.0, int(rng.integers(16, 60))))
    outline = outline * (np.exp(rng.uniform(0, 2 if kind == "rectangle" else 1)), 1)
    shape, part = _meshed(figure_of([[_corners(outline)]]), rng)
    return _uneven(shape, rng, (0.004, 0.008, 0.015, 0.03)), part


# Flat figures -------------------------------------------------------------------------------------


def branching_figure(rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """A body or a ring with limbs, two times of three, or a stem with bars: flat, wrinkled or bent."""
    shape, part = _meshed(_with_limbs(rng) if rng.random() < 2 / 3 else _with_bars(rng), rng)
    return _uneven(shape, rng, (0.002, 0.005, 0.01)), part


def _with_limbs(rng: np.random.Generator) -> Figure:
    """A body or a ring, and up to five limbs at its sides, which may have limbs of their own; none cross."""
    while True:
        is_ring = rng.random() < 1 / 3
        n = int(rng.integers(8, 17) if is_ring else rng.integers(4, 10))
        outer = np.array(circle(1.0, n, rng.uniform(0, 1))) if is_ring else _ring(n, rng)
        outer = outer * (rng.uniform(1, 1.6), 1)
        inner = outer * rng.uniform(0.3, 0.7)
        sides = [_corners([inner[k - 1], outer[k - 1], outer[k], inner[k]]) for k in range(n)]
        parts = [sides if is_ring else [_corners(outer)]]
        for k in rng.permutation(n)[:rng.integers(1, min(6, n))]:
            parts += [[_corners(limb)] for limb in _limb(outer[k - 1], outer[k], rng)]
        figure = figure_of(parts)
        low, high = figure.corners.min(axis=0), figure.corners.max(axis=0)
        if figure.polygons_at(rng.uniform(low, high, (3000, 2))).sum(axis=1).max() == 1:
            return figure


def _limb(p: np.ndarray, q: np.ndarray, rng: np.random.Generator, is_bud: bool = False) -> list[np.ndarray]:
    """Outlines of a limb on the right of p -> q, and of those that bud from it."""
    width, middle = np.linalg.norm(q - p), (p + q) / 2
    along = np.array([(q - p)[1], (p - q)[0]]) / width + rng.uniform(-0.4, 0.4) * (q - p) / width
    along *= width * rng.uniform(1, 2.5 if is_bud else 4.5) / np.linalg.norm(along)
    tip, half = middle + along, (q - p) / 2 * rng.uniform(0.4, 1)
    if rng.random() < 0.3:  # like a head: wider than its neck
        wide = (q - p) / 2 * rng.uniform(1.2, 2)
        return [np.array([p, middle + along / 2 - wide, tip - half, tip + half, middle + along / 2 + wide, q])]
    left, left_buds = _budding(p, tip - half, rng, is_bud)
    right, right_buds = _budding(tip + half, q, rng, is_bud)
    return [np.array([*left, *right]), *left_buds, *right_buds]


def _budding(p: np.ndarray, q: np.ndarray, rng: np.random.Generator, is_bud: bool) -> tuple[list, list]:
    """A side of a limb with the ends of what buds from it, up to two, and outlines of these."""
    ends = np.sort(rng.uniform(0.15, 0.95, 2 * rng.integers(1, 3)))
    if is_bud or rng.random() < 0.5 or np.diff(ends).min() < 0.12:
        return [p, q], []
    ends = p + ends[:, None] * (q - p)
    buds = [bud for a, b in ends.reshape(-1, 2, 2) for bud in _limb(a, b, rng, is_bud=True)]
    return [p, *ends, q], buds


def _with_bars(rng: np.random.Generator) -> Figure:
    """A stem with two to five bars on one side, like the letters E and F and combs."""
    n, width = int(rng.integers(2, 6)), rng.uniform(0.25, 0.45)
    thick, gap = rng.uniform(0.15, 0.35, n), rng.uniform(0.25, 0.6, n)
    start = np.cumsum(thick + gap) - thick - gap
    bars = [[(width, a), (width + length, a), (width + length, a + t), (width, a + t)]
            for a, t, length in zip(start, thick, rng.uniform(0.6, 1.5, n), strict=True)]
    beyond = rng.uniform(0.2, 0.5) if rng.random() < 0.5 else 0.0
    low, high = -beyond, start[-1] + thick[-1] + beyond
    side = [corner for bar in bars for corner in (bar[0], bar[3])]
    ends = ([(width, low)], [(width, high)]) if beyond else ([], [])
    stem = [(0.0, low), *ends[0], *side, *ends[1], (0.0, high)]
    return figure_of([[_corners(stem)], *([_corners(bar)] for bar in bars)])


# Common -------------------------------------------------------------------------------------------


def _ring(n: int, rng: np.random.Generator) -> np.ndarray:
    """(n, 2) corners around the origin, at uneven angles and distances."""
    angle = 2 * np.pi * (np.arange(n) + rng.uniform(-0.2, 0.2, n)) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1) * rng.uniform(0.75, 1, (n, 1))


def _corners(outline) -> list[tuple[float, float]]:
    """Rounded, so that corners that polygons share are equal."""
    return [(round(float(x), 6), round(float(y), 6)) for x, y in outline]


def _meshed(figure: Figure, rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """Triangles, about MAX_FACES of them at most, and the part of each."""
    x, y = figure.corners[figure.outline].transpose(2, 1, 0)
    area = (x[0] * y[1] - x[1] * y[0]).sum() / 2
    count = np.exp(rng.uniform(*np.log([MIN_FACES_OF_PART * figure.n_parts, MAX_FACES])))
    return sheet(figure, np.sqrt(4 / np.sqrt(3) * area / count))


def _uneven(shape: Shape, rng: np.random.Generator, heights: tuple) -> Shape:
    """A flat sheet as it is, one time of three; wrinkled by one of some heights; or bent."""
    vertices, faces = shape
    size = np.ptp(vertices, axis=0).max()
    kind = rng.choice(["flat", "wrinkled", "bent"])
    if kind == "bent":
        vertices = bent(vertices, size * rng.uniform(0.4, 2), rng.uniform(0, 3))
    elif kind == "wrinkled":
        frequency = rng.normal(scale=rng.uniform(3, 12) / size, size=(int(rng.integers(2, 6)), 2))
        wave = np.sin(vertices[:, :2] @ frequency.T + rng.uniform(0, 6, len(frequency))).sum(axis=1)
        vertices = vertices + size * rng.choice(heights) * wave[:, None] * (0, 0, 1)
    return Shape(vertices, faces)
