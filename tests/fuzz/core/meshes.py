# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes for the harness: shapes, and damage of every kind that is done to them.

A case is plain data - a shape, damages with an amount and a seed each, parameters - from which the same mesh is built
each time. So it can be stored, and Hypothesis can make it smaller.
"""

import numpy as np
import shapes

SHAPES = {
    "tetrahedron": lambda rng: shapes.tetrahedron(),
    "octahedron": lambda rng: shapes.octahedron(),
    "ball": lambda rng: shapes.icosphere(int(rng.integers(0, 3))),
    "grid": lambda rng: shapes.flat_grid(*rng.integers(1, 12, 2).tolist()),
    "cells": lambda rng: shapes.flat_cells([(0, 0), *np.argwhere(rng.random((6, 6)) < 0.6).tolist()]),
    "torus": lambda rng: shapes.torus(*rng.integers(3, 16, 2).tolist()),
    "tree": lambda rng: shapes.tube_tree(int(rng.integers(1, 5)), 0.3),
    "dumbbell": lambda rng: shapes.dumbbell(20, 8),
    "tube": lambda rng: shapes.cylinder(*rng.integers(3, 12, 2).tolist(), capped=bool(rng.integers(2))),
    "saddle": lambda rng: shapes.monkey_saddle(int(rng.integers(1, 6))),
    "box": lambda rng: shapes.box(tuple(10.0 ** rng.uniform(-2, 2, 3))),
    "prism": lambda rng: shapes.cylinder(1, int(rng.integers(3, 60)), 1.0, 10.0 ** rng.uniform(-2, 2)),
    "crumbs": lambda rng: shapes.crumbs(int(rng.integers(1, 80)), int(rng.integers(100))),
    "soup": lambda rng: _soup(rng),
    "figure": lambda rng: shapes.mirrored_figure(0.4),
    "scan": lambda rng: shapes.figure_on_ground(float(rng.uniform(3, 9)), float(rng.choice([0.0, 0.3])), step=0.4),
    "floor": lambda rng: shapes.together(shapes.tube_tree(2, 0.4), shapes.moved(shapes.flat_grid(
        *rng.integers(1, 8, 2).tolist(), float(rng.uniform(0.5, 3))), (-4, -4, -0.4))),
    "fan": lambda rng: _fan(rng),
    "pages": lambda rng: _pages(rng),
    "tetrahedra": lambda rng: _tetrahedra(rng),
    "two": lambda rng: shapes.together(shapes.icosphere(1), shapes.moved(shapes.box(), rng.normal(size=3))),
}


def _soup(rng):
    n = int(rng.integers(4, 40))
    return shapes.Shape(rng.normal(size=(n, 3)), rng.integers(0, n, (int(rng.integers(4, 120)), 3)))


def _fan(rng):
    n = int(rng.integers(3, 200))
    angle = 2 * np.pi * np.arange(n) / n
    rim = np.stack([np.cos(angle), np.sin(angle), np.zeros(n)], axis=1)
    return shapes.Shape(np.concatenate([[(0, 0, 10.0 ** rng.uniform(-3, 2))], rim]),
                        np.stack([np.zeros(n, int), 1 + np.arange(n), 1 + (np.arange(n) + 1) % n], axis=1))


def _pages(rng):
    """Faces around one edge."""
    n = int(rng.integers(4, 40))
    angle = 2 * np.pi * np.arange(n) / n
    tips = np.stack([np.cos(angle), np.sin(angle), np.full(n, 0.5)], axis=1)
    return shapes.Shape(np.concatenate([[(0, 0, 0), (0, 0, 1)], tips]),
                        np.stack([np.zeros(n, int), np.ones(n, int), 2 + np.arange(n)], axis=1))


def _tetrahedra(rng):
    one, n = shapes.tetrahedron(), int(rng.integers(2, 60))
    centers = rng.random((n, 1, 3)) * rng.uniform(0.5, 8)
    return shapes.Shape((centers + one.vertices).reshape(-1, 3),
                        (len(one.vertices) * np.arange(n)[:, None, None] + one.faces).reshape(-1, 3))


def drop(vertices, faces, amount, rng):
    """Holes."""
    return vertices, faces[rng.random(len(faces)) >= amount]


def duplicate(vertices, faces, amount, rng):
    return vertices, np.concatenate([faces, faces[rng.random(len(faces)) < amount]])


def flip(vertices, faces, amount, rng):
    chosen = rng.random(len(faces)) < amount
    return vertices, np.where(chosen[:, None], faces[:, ::-1], faces)


def collapse(vertices, faces, amount, rng):
    """Faces with a corner twice."""
    faces = faces.copy()
    chosen = rng.random(len(faces)) < amount
    faces[chosen, 0] = faces[chosen, 1]
    return vertices, faces


def weld(vertices, faces, amount, rng):
    """Vertices joined that are not beside each other: non-manifold."""
    target = np.arange(len(vertices))
    chosen = rng.random(len(vertices)) < 0.3 * amount
    target[chosen] = rng.integers(0, len(vertices), chosen.sum())
    return vertices, target[faces]


def coincide(vertices, faces, amount, rng):
    """Vertices at the places of others: edges of no length, faces of no area."""
    chosen = rng.random(len(vertices)) < 0.5 * amount
    vertices = vertices.copy()
    vertices[chosen] = vertices[rng.integers(0, len(vertices), chosen.sum())]
    return vertices, faces


def noise(vertices, faces, amount, rng):
    return vertices + amount * np.ptp(vertices, axis=0).max() * rng.normal(size=vertices.shape), faces


def spike(vertices, faces, amount, rng):
    vertices = vertices.copy()
    vertices[rng.integers(len(vertices))] *= 10.0 ** (9 * amount)
    return vertices, faces


def squash(vertices, faces, amount, rng):
    scale = np.ones(3)
    scale[rng.integers(3)] = 10.0 ** (-12 * amount)
    return vertices * scale, faces


def unused(vertices, faces, amount, rng):
    return np.concatenate([vertices, rng.normal(size=(1 + int(20 * amount), 3))]), faces


def crumb(vertices, faces, amount, rng):
    """A small piece beside the others."""
    one = shapes.icosphere(int(rng.integers(2)))
    size = np.ptp(vertices, axis=0).max() * 10.0 ** (-12 * amount)
    return (np.concatenate([vertices, vertices[0] + rng.normal(size=3) + size * one.vertices]),
            np.concatenate([faces, len(vertices) + one.faces]))


def fin(vertices, faces, amount, rng):
    """Third and fourth faces at edges."""
    chosen = faces[rng.random(len(faces)) < 0.5 * amount]
    tips = len(vertices) + np.arange(len(chosen))
    top = vertices[chosen[:, 0]] + rng.normal(size=(len(chosen), 3))
    return np.concatenate([vertices, top]), np.concatenate([faces, np.column_stack([chosen[:, :2], tips])])


def unjoin(vertices, faces, amount, rng):
    """Each face has vertices of its own."""
    return vertices[faces.ravel()], np.arange(faces.size).reshape(-1, 3)


def finer(vertices, faces, amount, rng):
    """Faces cut to four, those beside them not: vertices within edges."""
    return shapes.finer_in(shapes.Shape(vertices, faces), rng.random(len(faces)) < amount)[0]


def tear(vertices, faces, amount, rng):
    """Edges split for one of their faces."""
    return shapes.split_on_one_side(shapes.Shape(vertices, faces), np.flatnonzero(rng.random(len(faces)) < amount))[0]


def part(vertices, faces, amount, rng):
    """Patches with narrow gaps between them, or wide ones."""
    return shapes.in_patches(shapes.Shape(vertices, faces), rng.integers(0, 4, len(faces)), 10.0 ** (-6 + 4 * amount),
                             rng)


def wall(vertices, faces, amount, rng):
    """A wall around it, open somewhere, thin or thick."""
    open_ = faces[np.argsort(vertices[faces].mean(axis=1)[:, 2], kind="stable")[1 + len(faces) // 20:]]
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    return shapes.thickened(shapes.Shape(vertices, open_), size * 10.0 ** (-3 + 2.5 * amount))


def mirror(vertices, faces, amount, rng):
    """What is beyond a plane pressed flat into it, and the mirror image: interior faces."""
    x = np.maximum(vertices[:, 0], np.quantile(vertices[:, 0], amount))
    half = np.column_stack([x - x.min(), vertices[:, 1:]])
    both, image = np.concatenate([half, half * (-1, 1, 1)]), np.arange(len(half)) + len(half)
    if rng.random() < 0.5:
        image = np.where(half[:, 0] == 0, np.arange(len(half)), image)
    return both, np.concatenate([faces, image[faces][:, ::-1]])


def shuffle(vertices, faces, amount, rng):
    place = rng.permutation(len(vertices))
    moved = np.empty_like(vertices)
    moved[place] = vertices
    return moved, place[faces][rng.permutation(len(faces))]


def scale(vertices, faces, amount, rng):
    return vertices * 10.0 ** rng.uniform(-140 * amount, 140 * amount), faces


def move(vertices, faces, amount, rng):
    return vertices + 10.0 ** (9 * amount) * rng.normal(size=3), faces


def refine(vertices, faces, amount, rng):
    """One face again and again: a dense spot."""
    for _ in range(int(30 * amount)):
        (a, b, c), middle = faces[0], len(vertices)
        vertices = np.concatenate([vertices, vertices[[a, b, c]].mean(axis=0, keepdims=True)])
        faces = np.concatenate([[(a, b, middle)], faces[1:], [(b, c, middle), (c, a, middle)]])
    return vertices, faces


def not_a_number(vertices, faces, amount, rng):
    vertices = vertices.copy()
    vertices[rng.integers(len(vertices)), rng.integers(3)] = rng.choice([np.nan, np.inf, -np.inf])
    return vertices, faces


def no_vertex(vertices, faces, amount, rng):
    faces = faces.copy()
    faces[rng.integers(len(faces)), rng.integers(3)] = rng.choice([-1, len(vertices), 2**40])
    return vertices, faces


DAMAGES = {function.__name__: function for function in (
    drop, duplicate, flip, collapse, weld, coincide, noise, spike, squash, unused, crumb, fin, unjoin, finer,
    tear, part, wall, mirror, shuffle, scale, move, refine, not_a_number, no_vertex)}
#: What makes a mesh that has to be refused.
REFUSED = {"not_a_number", "no_vertex"}


def build(case):
    """Vertices, faces and polygons of a case; polygons may be None."""
    shape = SHAPES[case["shape"]](np.random.default_rng(case["seed"]))
    vertices, faces = np.asarray(shape.vertices, float), np.asarray(shape.faces, np.int64)
    # What is refused comes last: nothing more can be done to faces whose vertices are not there.
    for name, amount, seed in sorted(case["damages"], key=lambda damage: damage[0] in REFUSED):
        if len(vertices) and len(faces):
            with np.errstate(all="ignore"):
                vertices, faces = DAMAGES[name](vertices, faces, amount, np.random.default_rng(seed))
    polygon = None
    if case["polygons"] and len(faces):
        # Some neighbors in the list are one polygon.
        new = np.random.default_rng(case["seed"]).random(len(faces)) < 0.6
        polygon = np.cumsum(new) - new[0]
    return vertices, faces, polygon


def hints_of(case, faces, polygon):
    """A label for each face, or polygon, some below 0: at random, or alike along the list; None for most cases."""
    kind, count = case.get("hints", ""), len(faces) if polygon is None else int(polygon.max(initial=-1)) + 1
    if not kind:
        return None
    labels = np.random.default_rng(case["seed"]).integers(-2, 3, count)
    return labels if kind == "grains" else labels[np.arange(count) // 7 * 7]
