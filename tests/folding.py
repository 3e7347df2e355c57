# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons that a fan of triangles would fold: concave ones, and quads that are bent."""

import numpy as np

LETTER_H = [(0, 0), (1, 0), (1, 2), (3, 2), (3, 0), (4, 0), (4, 5), (3, 5), (3, 3), (1, 3), (1, 5), (0, 5)]


def extruded(corners, first=0, height=1.0):
    """A solid between two copies of an outline, as vertices and polygons; the caps begin with another corner."""
    n = len(corners)
    flat = np.array(corners, float)
    vertices = np.vstack([np.c_[flat, np.zeros(n)], np.c_[flat, np.full(n, height)]])
    cap = np.roll(np.arange(n), -first).tolist()
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return vertices, [cap[::-1], [n + i for i in cap], *sides]


def bumps(n=22):
    """A sheet of quads with bumps so steep that many are folded whichever way they are cut into a fan."""
    x, y = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    height = np.abs(np.random.default_rng(5).normal(size=x.shape)) ** 6
    corner = (n * np.arange(n - 1)[:, None] + np.arange(n - 1)).ravel()
    return (np.stack([x, y, height], axis=-1).reshape(-1, 3),
            np.stack([corner, corner + n, corner + n + 1, corner + 1], axis=1))
