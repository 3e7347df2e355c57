# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat figures with the parts that a person would give them: silhouettes to be rigged, a leaf, a letter.

A ``Figure`` is a plane cut into polygons, each of which belongs to one limb, finger, ray or stroke. From it meshes are
made at any density, flat or bent, as a sheet or as a plate of some thickness.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import Delaunay
from shapes import Shape


class Figure(NamedTuple):
    """Corners (n, 2) float64, polygons that share them, counter-clockwise, and the part of each polygon."""

    corners: np.ndarray
    polygons: list
    part: np.ndarray

    @property
    def outline(self) -> np.ndarray:
        """(e, 2) int64, the sides that only one polygon has, with the figure on their left."""
        sides = {(a, b) for p in self.polygons for a, b in zip(p, p[1:] + p[:1], strict=True)}
        return np.array(sorted((a, b) for a, b in sides if (b, a) not in sides))

    @property
    def n_parts(self) -> int:
        return int(self.part.max()) + 1

    def polygons_at(self, points: np.ndarray) -> np.ndarray:
        """(k, polygons) bool, whether each of (k, 2) points lies in each polygon."""
        return np.stack([_inside(points, self.corners[polygon]) for polygon in self.polygons], axis=1)

    def part_at(self, points: np.ndarray) -> np.ndarray:
        """(k,) int64, part in which each of (k, 2) points lies; -1 outside."""
        inside = self.polygons_at(points)
        return np.where(inside.any(axis=1), self.part[inside.argmax(axis=1)], -1)


def _inside(points: np.ndarray, polygon: np.ndarray) -> np.ndarray:
    """Whether (k, 2) points lie in a polygon, (c, 2)."""
    x, y = points.T[:, :, None]
    (ax, ay), (bx, by) = polygon.T, np.roll(polygon, -1, axis=0).T
    across = (ay > y) != (by > y)
    return (across & (x < ax + (y - ay) * (bx - ax) / np.where(by == ay, 1, by - ay))).sum(axis=1) % 2 == 1


def figure_of(parts: list[list]) -> Figure:
    """A figure of parts, each a list of polygons of (x, y) corners; equal corners are one."""
    names = sorted({tuple(c) for part in parts for polygon in part for c in polygon})
    index = {name: i for i, name in enumerate(names)}
    polygons = [[index[tuple(c)] for c in polygon] for part in parts for polygon in part]
    part = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return Figure(np.array(names, float), polygons, part)


def _mirrored(polygon: list) -> list:
    return [(-x, y) for x, y in polygon[::-1]]


def person() -> Figure:
    """Torso, head, two arms, two legs."""
    torso = [(0.0, 0.74), (0.3, 0.8), (0.23, 1.0), (0.28, 1.22), (0.34, 1.45), (0.08, 1.5)]
    torso = torso + _mirrored(torso[1:])
    head = [(0.08, 1.5), (0.17, 1.62), (0.2, 1.8), (0.12, 1.98)]
    arm = [(0.28, 1.22), (0.9, 0.92), (0.97, 1.08), (0.34, 1.45)]
    leg = [(0.0, 0.74), (0.17, 0.0), (0.37, 0.0), (0.3, 0.8)]
    return figure_of([[torso], [head + _mirrored(head)], [arm], [_mirrored(arm)], [leg], [_mirrored(leg)]])


def hand() -> Figure:
    """Palm and five fingers."""
    base = [(0.44, 0.88), (0.23, 1.0), (0.0, 1.03), (-0.22, 0.99), (-0.4, 0.88)]
    palm = [(-0.28, 0.0), (0.28, 0.0), (0.4, 0.28), (0.46, 0.52), *base]
    tips = [(0.62, 1.42, 0.07), (0.2, 1.78, 0.075), (-0.16, 1.76, 0.075), (-0.52, 1.5, 0.065)]
    fingers = [[right, (round(x + w, 4), y), (round(x - w, 4), y), left]
               for right, left, (x, y, w) in zip(base, base[1:], tips, strict=False)]
    thumb = [(0.4, 0.28), (0.92, 0.62), (0.82, 0.76), (0.46, 0.52)]
    return figure_of([[palm], [thumb], *([finger] for finger in fingers)])


def circle(radius: float, count: int, turn: float = 0.0) -> list:
    angle = turn + 2 * np.pi * np.arange(count) / count
    return [(round(radius * np.cos(a), 9), round(radius * np.sin(a), 9)) for a in angle]


def star(n_rays: int = 5) -> Figure:
    """Rays that meet in the middle."""
    inner = circle(0.42, n_rays, np.pi / n_rays)
    return figure_of([[[(0.0, 0.0), inner[k - 1], tip, inner[k]]] for k, tip in enumerate(circle(1.0, n_rays))])


def key() -> Figure:
    """Bow, which is a ring, shaft and two teeth."""
    n, turn = 12, np.pi / 12
    outer, inner = circle(0.5, n, turn), circle(0.26, n, turn)
    ring = [[inner[k - 1], outer[k - 1], outer[k], inner[k]] for k in range(n)]
    (x, top), low = outer[0], outer[-1][1]
    ends = [1.45, 1.6, 1.75, 1.9]
    shaft = [(x, low), *((e, low) for e in ends), (ends[-1], top), (x, top)]
    teeth = [[(a, low - 0.3), (b, low - 0.3), (b, low), (a, low)] for a, b in (ends[:2], ends[2:])]
    return figure_of([ring, [shaft], *([tooth] for tooth in teeth)])


def leaf() -> Figure:
    """A lobed leaf: core, five lobes, stalk."""
    angle = np.deg2rad([-70, -20, 30, 90, 150, 200, 250])
    notch = [(-40, 0.36), (5, 0.4), (60, 0.42), (120, 0.42), (175, 0.4), (220, 0.36)]
    notch = [(round(r * np.cos(np.deg2rad(a)), 6), round(r * np.sin(np.deg2rad(a)), 6)) for a, r in notch]
    stalk = [(-0.05, -0.3), (-0.05, -0.95), (0.05, -0.95), (0.05, -0.3)]
    core = [*notch, stalk[0], stalk[3]]
    lobes = []
    for (right, left), middle, length in zip(
            zip(notch, notch[1:], strict=False), angle[1:6], (0.8, 1.05, 1.2, 1.05, 0.8), strict=True):
        along, across = np.array([np.cos(middle), np.sin(middle)]), np.array([-np.sin(middle), np.cos(middle)])
        sides = [length * (0.62 * along + s * 0.2 * across) for s in (-1, 1)]
        tip = length * along
        lobes.append([right, *(tuple(np.round(c, 6)) for c in (sides[0], tip, sides[1])), left])
    return figure_of([[core], *([lobe] for lobe in lobes), [stalk]])


def letter_e() -> Figure:
    """Stem and three bars."""
    heights = [(0.0, 0.25), (0.7, 0.92), (1.4, 1.65)]
    bars = [[(0.3, a), (length, a), (length, b), (0.3, b)]
            for (a, b), length in zip(heights, (1.1, 0.95, 1.1), strict=True)]
    stem = [(0.0, 0.0), *((0.3, y) for pair in heights for y in pair), (0.0, 1.65)]
    return figure_of([[stem], *([bar] for bar in bars)])


FIGURES = {"person": person, "hand": hand, "star": star, "key": key, "leaf": leaf, "letter_e": letter_e}


def polygon_mesh(figure: Figure) -> tuple[np.ndarray, list, np.ndarray]:
    """The figure's polygons as they are: vertices (n, 3), a list of polygons, and the part of each."""
    return np.column_stack([figure.corners, np.zeros(len(figure.corners))]), figure.polygons, figure.part


def sheet(figure: Figure, step: float) -> tuple[Shape, np.ndarray]:
    """Triangles with edges of about ``step`` in the plane z = 0, and the part of each triangle.

    Only the outline has vertices and edges where the polygons have; the cuts between parts run across the triangles.
    """
    start, end = figure.corners[figure.outline].transpose(1, 0, 2)
    count = np.maximum(np.ceil(np.linalg.norm(end - start, axis=1) / step), 1).astype(int)
    border = np.concatenate([a + np.arange(n)[:, None] / n * (b - a)
                             for a, b, n in zip(start, end, count, strict=True)])
    low, high = figure.corners.min(axis=0), figure.corners.max(axis=0)
    x, y = np.meshgrid(np.arange(low[0], high[0], step), np.arange(low[1], high[1], step * np.sqrt(0.75)))
    x[1::2] += step / 2
    inner = np.stack([x.ravel(), y.ravel()], axis=1)
    inner = inner[figure.part_at(inner) >= 0]
    apart = np.linalg.norm(inner[:, None] - border[None], axis=2).min(axis=1)
    points = np.concatenate([border, inner[apart > 0.6 * step]])
    faces = Delaunay(points).simplices
    p, q, r = points[faces].transpose(1, 0, 2)
    area = ((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0]) / 2
    faces = np.where((area < 0)[:, None], faces[:, ::-1], faces)
    part = figure.part_at((p + q + r) / 3)
    kept = (part >= 0) & (np.abs(area) > 1e-9 * step**2)
    used, faces = np.unique(faces[kept], return_inverse=True)
    vertices = np.column_stack([points[used], np.zeros(len(used))])
    return Shape(vertices, faces.reshape(-1, 3)), part[kept]


def bent(vertices: np.ndarray, radius: float, turn: float = 0.0) -> np.ndarray:
    """Points of the plane z = 0 rolled on a cylinder whose axis is turned by ``turn`` radians from y."""
    along = np.array([np.cos(turn), np.sin(turn), 0.0])
    middle = vertices.mean(axis=0)
    x = (vertices - middle) @ along
    angle = x / radius
    lift = radius * (1 - np.cos(angle))
    return vertices + (radius * np.sin(angle) - x)[:, None] * along + lift[:, None] * (0.0, 0.0, 1.0)


def plate(shape: Shape, thickness: float) -> Shape:
    """A flat sheet and its copy below, with walls between their borders."""
    n = len(shape.vertices)
    start, end = shape.faces.ravel(), np.roll(shape.faces, -1, axis=1).ravel()
    both = set(zip(start.tolist(), end.tolist(), strict=True))
    rim = np.array([(a, b) for a, b in zip(start.tolist(), end.tolist(), strict=True) if (b, a) not in both])
    a, b = rim.T
    walls = np.concatenate([np.stack([a, a + n, b], axis=1), np.stack([b, a + n, b + n], axis=1)])
    below = shape.vertices - (0.0, 0.0, thickness)
    return Shape(np.concatenate([shape.vertices, below]),
                 np.concatenate([shape.faces, n + shape.faces[:, ::-1], walls]))
