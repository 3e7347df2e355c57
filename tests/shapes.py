# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made by formula, for the tests and the documentation; numpy only.

Each function returns a ``Shape``: ``vertices`` (n, 3) float64 and ``faces`` (m, 3) int64, turned
outwards where there is an outside. ``TriMesh(*shape)`` and ``decompose(*shape)`` take it as it is.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np


class Shape(NamedTuple):
    """Vertices (n, 3) float64 and triangles (m, 3) int64."""

    vertices: np.ndarray
    faces: np.ndarray


# By formula ------------------------------------------------------------------------------------


def tetrahedron() -> Shape:
    """Four faces, the smallest solid."""
    vertices = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], float)
    return Shape(vertices, np.array([(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]))


def octahedron() -> Shape:
    """Eight faces, corners on the axes: 0 and 1 on x, 2 and 3 on y, 4 (top) and 5 on z."""
    vertices = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    return Shape(vertices, np.array(faces))


def icosphere(subdivisions: int = 3, radius: float = 1.0) -> Shape:
    """A sphere of 20 * 4**subdivisions nearly equal faces."""
    golden = (1 + np.sqrt(5)) / 2
    vertices = np.array([(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0),
                         (0, -1, golden), (0, 1, golden), (0, -1, -golden), (0, 1, -golden),
                         (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)])
    faces = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9),
                      (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2),
                      (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
                      (8, 6, 7), (9, 8, 1)])
    shape = Shape(vertices, faces)
    for _ in range(subdivisions):
        shape = subdivide(shape)
        shape = Shape(shape.vertices / np.linalg.norm(shape.vertices, axis=1)[:, None], shape.faces)
    return Shape(radius * shape.vertices / np.linalg.norm(shape.vertices, axis=1)[:, None], shape.faces)


def flat_grid(n_x: int, n_y: int, step: float = 1.0) -> Shape:
    """n_x by n_y square cells in the plane z = 0, each cut along its rising diagonal.

    Vertex (i, j) has index i * (n_y + 1) + j and lies at (i, j) * step.
    """
    i, j = np.meshgrid(np.arange(n_x + 1), np.arange(n_y + 1), indexing="ij")
    vertices = step * np.stack([i.ravel(), j.ravel(), 0 * i.ravel()], axis=1).astype(float)
    return Shape(vertices, split_quads(grid_quads(n_x, n_y, n_y + 1)))


def flat_cells(cells) -> Shape:
    """Unit squares of the plane z = 0, each given by its lower corner (x, y)."""
    corners = sorted({(x + a, y + b) for x, y in cells for a in (0, 1) for b in (0, 1)})
    index = {corner: i for i, corner in enumerate(corners)}
    quads = [[index[x, y], index[x + 1, y], index[x + 1, y + 1], index[x, y + 1]] for x, y in cells]
    return Shape(np.array([(x, y, 0) for x, y in corners], float), split_quads(np.array(quads)))


def blocks(solid: np.ndarray, step: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and quads of the surface of cubes: those of a grid, (a, b, c), that are solid; its middle is at 0."""
    solid = np.pad(solid, 1)
    corners = []
    for axis in range(3):
        after = np.roll(solid, -1, axis)
        across = np.roll(np.eye(3, dtype=int), -axis - 1, axis=0)  # the two other axes, and this one
        square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) @ across[:2]
        for outside, order in ((solid & ~after, 1), (after & ~solid, -1)):
            corners.append((np.argwhere(outside) + across[2])[:, None] + square[::order])
    vertices, quads = np.unique(np.concatenate(corners).reshape(-1, 3), axis=0, return_inverse=True)
    return step * (vertices - np.array(solid.shape) / 2), quads.reshape(-1, 4)


def table_of_blocks() -> tuple[np.ndarray, np.ndarray]:
    """A top on four legs, its own mirror image in the planes x = 0 and y = 0."""
    solid = np.zeros((12, 8, 7), bool)
    solid[:, :, 6] = True
    solid[np.ix_([0, 11], [0, 7])] = True
    return blocks(solid)


def cross_of_blocks(long: int, short: int) -> tuple[np.ndarray, np.ndarray]:
    """Two bars across each other, long and short cubes to either side: its own mirror image in three planes."""
    solid = np.zeros((2 * long, 2 * long, 2), bool)
    solid[:, long - 1 : long + 1] = True
    solid[long - 1 : long + 1, long - short : long + short] = True
    return blocks(solid)


def torus(n_ring: int = 48, n_tube: int = 16, ring: float = 1.0, tube: float = 0.35) -> Shape:
    """A ring around the z axis."""
    u = 2 * np.pi * np.arange(n_ring) / n_ring
    v = 2 * np.pi * np.arange(n_tube) / n_tube
    u, v = np.meshgrid(u, v, indexing="ij")
    far = ring + tube * np.cos(v)
    vertices = np.stack([far * np.cos(u), far * np.sin(u), tube * np.sin(v)], axis=-1)
    i, j = np.meshgrid(np.arange(n_ring), np.arange(n_tube), indexing="ij")
    corner = [((i + a) % n_ring * n_tube + (j + b) % n_tube).ravel()
              for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return Shape(vertices.reshape(-1, 3), split_quads(np.stack(corner, axis=1)))


def lathe(radius, height, n_around: int = 24) -> Shape:
    """A closed surface of revolution around z, tips on the axis.

    ``radius`` and ``height`` (k,) describe the profile from the lower tip to the upper, both
    tips with radius 0.
    """
    radius, height = np.asarray(radius, float)[1:-1], np.asarray(height, float)
    k = len(radius)
    angle = 2 * np.pi * np.arange(n_around) / n_around
    rings = np.stack([radius[:, None] * np.cos(angle), radius[:, None] * np.sin(angle),
                      np.broadcast_to(height[1:-1, None], (k, n_around))], axis=-1).reshape(-1, 3)
    vertices = np.concatenate([rings, [(0, 0, height[0]), (0, 0, height[-1])]])
    this, following = np.arange(n_around), (np.arange(n_around) + 1) % n_around
    sides = [np.stack([r * n_around + this, r * n_around + following,
                       (r + 1) * n_around + following, (r + 1) * n_around + this], axis=1)
             for r in range(k - 1)]
    bottom = np.stack([following, this, np.full(n_around, k * n_around)], axis=1)
    top = (k - 1) * n_around + np.stack([this, following, np.full(n_around, n_around + 1)], axis=1)
    return Shape(vertices, np.concatenate([split_quads(np.concatenate(sides)), bottom, top]))


def dumbbell(n_along: int = 80, n_around: int = 24, neck: float = 0.25) -> Shape:
    """Two balls of unit radius with a neck at z = 0, six lengths from tip to tip."""
    t = np.linspace(-1, 1, n_along)
    z = 3 * np.sin(0.5 * np.pi * t)
    ball = np.sqrt(np.maximum(1 - (np.abs(z) / 1.5 - 1) ** 2, 0))  # two lobes that meet at 0
    return lathe(np.hypot(ball, neck * np.cos(0.5 * np.pi * t)), z, n_around)


def cylinder(n_along: int, n_around: int, radius: float = 1.0, length: float = 4.0,
             capped: bool = True) -> Shape:
    """A cylinder around z from 0 to ``length``, with fans for caps or open."""
    z = np.linspace(0, length, n_along + 1)
    closed = lathe(np.concatenate([[0], np.full(n_along + 1, radius), [0]]),
                   np.concatenate([[0], z, [length]]), n_around)
    if capped:
        return closed
    return Shape(closed.vertices[:-2], closed.faces[: 2 * n_along * n_around])


def monkey_saddle(n: int = 6) -> Shape:
    """A disc of 6 n triangles around vertex 0, with height r**3 cos(3 angle): three ways down."""
    angle = np.pi / 3 * np.arange(6)
    rings = [np.stack([r * np.cos(angle), r * np.sin(angle), r**3 * np.cos(3 * angle)], axis=1)
             for r in np.arange(1, n + 1) / n]
    vertices = np.concatenate([np.zeros((1, 3)), *rings])
    this, following = np.arange(6), (np.arange(6) + 1) % 6
    faces = [np.stack([np.zeros(6, int), 1 + this, 1 + following], axis=1)]
    for ring in range(n - 1):
        low, high = 1 + 6 * ring, 7 + 6 * ring
        faces.append(split_quads(np.stack([low + this, high + this, high + following, low + following], 1)))
    return Shape(vertices, np.concatenate(faces))


def box(size=(1.0, 1.0, 1.0)) -> Shape:
    """Twelve triangles."""
    vertices, quads = box_quads(size)
    return Shape(vertices, split_quads(quads))


def box_quads(size=(1.0, 1.0, 1.0)) -> tuple[np.ndarray, np.ndarray]:
    """Eight vertices and six quads."""
    corner = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corner * size, np.array(quads)


def prism(n_sides: int = 8, radius: float = 0.5, length: float = 6.0):
    """A cylinder as artists draw it: one long quad per side and two n-gons.

    Returns (2 n, 3) vertices and a list of polygons.
    """
    angle = 2 * np.pi * np.arange(n_sides) / n_sides
    ring = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)
    vertices = np.concatenate([ring, ring + (0, 0, length)])
    n = n_sides
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return vertices, [*sides, list(range(n))[::-1], list(range(n, 2 * n))]


# Level surfaces --------------------------------------------------------------------------------


def level_surface(distance: Callable[[np.ndarray], np.ndarray], low, high, step: float) -> Shape:
    """The surface where a function of (n, 3) points is zero; it is negative inside.

    Surface nets: a vertex in each grid cell the surface passes, a quad across each grid edge that
    it crosses; then a few steps of Newton's method on to the surface.
    """
    axes = [np.arange(a, b + step, step) for a, b in zip(low, high, strict=True)]
    nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    value = distance(nodes.reshape(-1, 3)).reshape(nodes.shape[:3])
    sums, count, quads = np.zeros((value.size, 3)), np.zeros(value.size), []
    for axis in range(3):
        near, far = np.moveaxis(value, axis, 0)[:-1], np.moveaxis(value, axis, 0)[1:]
        crossed = np.moveaxis((near < 0) != (far < 0), 0, axis)
        index = np.stack(np.nonzero(crossed), axis=1)
        unit = np.eye(3, dtype=int)
        start, stop = value[tuple(index.T)], value[tuple((index + unit[axis]).T)]
        point = nodes[tuple(index.T)] + step * (start / (start - stop))[:, None] * unit[axis]
        u, v = unit[(axis + 1) % 3], unit[(axis + 2) % 3]
        cells = np.stack([np.ravel_multi_index(tuple((index - a * u - b * v).T), value.shape)
                          for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))], axis=1)
        for column in cells.T:
            np.add.at(sums, column, point)
            np.add.at(count, column, 1)
        quads.append(np.where((start < 0)[:, None], cells, cells[:, ::-1]))
    used, quads = np.unique(np.concatenate(quads), return_inverse=True)
    vertices = _onto(distance, sums[used] / count[used][:, None], step)
    return Shape(vertices, split_quads(quads.reshape(-1, 4), vertices))


def _onto(distance, points: np.ndarray, step: float) -> np.ndarray:
    """Move points on to the zero set, at most a fraction of a grid step at a time."""
    small = 1e-3 * step
    for _ in range(4):
        value = distance(points)
        gradient = np.stack([distance(points + small * e) - value for e in np.eye(3)], axis=1) / small
        move = -(value / np.maximum((gradient**2).sum(axis=1), 1e-9))[:, None] * gradient
        length = np.linalg.norm(move, axis=1, keepdims=True)
        points = points + move * np.minimum(1.0, 0.25 * step / np.maximum(length, 1e-12))
    return points


def _capsule(points, start, end, radius):
    """Signed distance from a rod with round ends; ``radius`` may be a pair, one per end."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    along = np.clip((points - start) @ (end - start) / ((end - start) @ (end - start)), 0, 1)
    thick = np.broadcast_to(radius, 2)
    nearest = start + along[:, None] * (end - start)
    return np.linalg.norm(points - nearest, axis=1) - (thick[0] + along * (thick[1] - thick[0]))


def _ring(points, center, axis: int, ring: float, tube: float):
    """Signed distance from a torus around a coordinate axis."""
    offset = points - np.asarray(center, float)
    flat = np.delete(offset, axis, axis=1)
    return np.hypot(np.linalg.norm(flat, axis=1) - ring, offset[:, axis]) - tube


def _blend(a, b, width: float):
    """Union with a rounded seam of about ``width``."""
    near = np.maximum(width - np.abs(a - b), 0) / width
    return np.minimum(a, b) - 0.25 * width * near**2


def surface_of_genus(genus: int, step: float = 0.12) -> Shape:
    """A closed orientable surface: a chain of ``genus`` rings along x, or a bar."""
    def distance(points):
        solid = _capsule(points, (-1.6, 0, 0), (-0.9, 0, 0), 0.35)
        for k in range(genus):
            solid = _blend(solid, _ring(points, (2.1 * k, 0, 0), 2, 0.8, 0.35), 0.3)
        return solid

    high = max(2.1 * (genus - 1) + 1.5, 0.0)
    # No grid line on an axis of symmetry: ambiguous cells lie there.
    return level_surface(distance, (-2.317, -1.513, -0.711), (high, 1.6, 0.8), step)


TREE_TIPS = np.array([(2.0, 0.2, 0.1), (-1.6, 0.9, 0.0), (-0.6, -1.9, 0.3), (0.1, 0.4, 1.5)])


def tube_tree(n_branches: int = 4, step: float = 0.11) -> Shape:
    """Tubes of radius 0.25 from the origin to the first of TREE_TIPS, blended."""
    def distance(points):
        solid = np.linalg.norm(points, axis=1) - 0.4
        for tip in TREE_TIPS[:n_branches]:
            solid = _blend(solid, _capsule(points, (0, 0, 0), tip, 0.25), 0.15)
        return solid

    return level_surface(distance, (-2.217, -2.413, -0.811), (2.5, 1.5, 2.1), step)


def horse(step: float = 0.06) -> Shape:
    """A horse that looks along x and stands along z: body, legs, neck, head, ears and a tail, blended."""
    def distance(points):
        solid = _capsule(points, (-0.9, 0, 0), (0.8, 0, 0.05), (0.45, 0.42))
        for x, y in ((-0.9, 0.25), (-0.9, -0.25), (0.75, 0.22), (0.75, -0.22)):
            solid = _blend(solid, _capsule(points, (x, y, -0.1), (x, y, -1.4), (0.2, 0.11)), 0.12)
        solid = _blend(solid, _capsule(points, (0.85, 0, 0.2), (1.45, 0, 0.95), (0.3, 0.2)), 0.15)
        solid = _blend(solid, _capsule(points, (1.4, 0, 1.05), (2.0, 0, 0.75), (0.21, 0.13)), 0.1)
        for y in (0.1, -0.1):
            solid = _blend(solid, _capsule(points, (1.35, y, 1.15), (1.3, 1.6 * y, 1.5), (0.07, 0.04)), 0.04)
        return _blend(solid, _capsule(points, (-1.3, 0, 0.15), (-1.6, 0, -0.9), (0.12, 0.07)), 0.08)

    return level_surface(distance, (-2.017, -1.013, -1.711), (2.4, 1.0, 1.7), step)


def insect(step: float = 0.09) -> Shape:
    """A head, a chest on six legs and an abdomen that is larger than both, along y; z is up."""

    def distance(points):
        head, abdomen = ((0.0, -1.1, 1.2), (0.0, -1.2, 1.2), 0.3), ((0.0, 1.4, 1.3), (0.0, 1.9, 1.2), 0.6)
        chest, waist = ((0.0, -0.4, 1.2), (0.0, 0.3, 1.2), 0.3), ((0.0, -1.0, 1.2), (0.0, 1.5, 1.2), 0.14)
        found = _capsule(points, *waist)
        for part in (head, chest, abdomen):
            found = _blend(found, _capsule(points, *part), 0.05)
        for side in (-1.0, 1.0):
            for place in (-1.0, 0.0, 1.0):
                knee, foot = (1.1 * side, 0.9 * place, 1.0), (1.5 * side, 1.1 * place, 0.1)
                leg = np.minimum(_capsule(points, (0.2 * side, 0.3 * place, 1.2), knee, 0.12),
                                 _capsule(points, knee, foot, 0.12))
                found = _blend(found, leg, 0.05)
        return found

    return level_surface(distance, (-1.8, -1.8, -0.2), (1.8, 2.8, 2.1), step)


def genus_two(step: float = 0.045) -> Shape:
    """An amphora: body, foot, neck with a lip, and two handles. Our own model of genus 2."""
    def distance(points):
        x, y, z = points.T
        # An egg, slender below.
        body = np.linalg.norm(points / (0.8, 0.8, 1.05), axis=1) - 1.0
        body = 0.8 * body * (1.0 - 0.12 * np.clip(z, -1, 1))
        solid = _blend(body, _capsule(points, (0, 0, -0.9), (0, 0, -1.35), 0.22), 0.25)
        foot = np.hypot(np.maximum(np.hypot(x, y) - 0.36, 0), np.maximum(np.abs(z + 1.5) - 0.02, 0)) - 0.1
        solid = _blend(solid, foot, 0.2)
        solid = _blend(solid, _capsule(points, (0, 0, 0.8), (0, 0, 1.75), 0.27), 0.25)
        lip = np.hypot(np.maximum(np.hypot(x, y) - 0.34, 0), np.maximum(np.abs(z - 1.85) - 0.02, 0)) - 0.1
        solid = _blend(solid, lip, 0.15)
        for side in (-1, 1):
            path = [(0.2, 1.5), (0.62, 1.55), (0.92, 1.3), (0.95, 0.9), (0.8, 0.55), (0.6, 0.4)]
            handle = np.full(len(points), np.inf)
            for (xa, za), (xb, zb) in zip(path, path[1:], strict=False):
                rod = _capsule(points, (side * xa, 0, za), (side * xb, 0, zb), 0.11)
                handle = rod if np.isinf(handle).all() else _blend(handle, rod, 0.08)
            solid = _blend(solid, handle, 0.12)
        return solid

    return level_surface(distance, (-1.2137, -1.0131, -1.7119), (1.25, 1.05, 2.1), step)


# Made from others ------------------------------------------------------------------------------


def split_quads(quads: np.ndarray, vertices: np.ndarray | None = None) -> np.ndarray:
    """Two triangles per quad, along the diagonal 0-2, or the shorter one of ``vertices``."""
    a, b, c, d = quads.T
    first = np.ones(len(quads), bool)
    if vertices is not None:
        first = (np.linalg.norm(vertices[a] - vertices[c], axis=1)
                 <= np.linalg.norm(vertices[b] - vertices[d], axis=1))
    one = np.where(first[:, None], np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    two = np.where(first[:, None], np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return np.stack([one, two], axis=1).reshape(-1, 3)


def grid_quads(n_x: int, n_y: int, stride: int) -> np.ndarray:
    """n_x by n_y quads between vertices (i, j) of the indices i * stride + j."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n_x), np.arange(n_y), indexing="ij"))
    corner = i * stride + j
    return np.stack([corner, corner + stride, corner + stride + 1, corner + 1], axis=1)


def subdivide(shape: Shape) -> Shape:
    """Every triangle to four, on the same surface."""
    start, end = shape.faces, np.roll(shape.faces, -1, axis=1)
    edges, index = np.unique(np.sort(np.stack([start, end], axis=-1).reshape(-1, 2), axis=1),
                             axis=0, return_inverse=True)
    ab, bc, ca = (len(shape.vertices) + index.reshape(-1, 3)).T
    a, b, c = shape.faces.T
    faces = np.stack([(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]).transpose(2, 0, 1)
    return Shape(np.concatenate([shape.vertices, shape.vertices[edges].mean(axis=1)]),
                 faces.reshape(-1, 3))


def together(*shapes: Shape) -> Shape:
    """Several shapes as loose parts of one mesh, in order."""
    offsets = np.cumsum([0] + [len(s.vertices) for s in shapes])
    return Shape(np.concatenate([s.vertices for s in shapes]),
                 np.concatenate([s.faces + o for s, o in zip(shapes, offsets, strict=False)]))


def finer_in(shape: Shape, chosen: np.ndarray, rounds: int = 1) -> tuple[Shape, np.ndarray]:
    """The chosen faces, (m,) bool, cut to four so often, the others not; and the face in which each lies, (m',)."""
    fine, source = Shape(shape.vertices, shape.faces[chosen]), np.flatnonzero(chosen)
    for _ in range(rounds):
        fine, source = subdivide(fine), np.repeat(source, 4)
    both = together(Shape(shape.vertices, shape.faces[~chosen]), fine)
    return both, np.concatenate([np.flatnonzero(~chosen), source])


def split_on_one_side(shape: Shape, chosen: np.ndarray) -> tuple[Shape, np.ndarray]:
    """The chosen faces, (k,), split at the middle of an edge, their neighbors not; and the face in which each lies."""
    a, b, c = shape.faces[chosen].T
    middle = len(shape.vertices) + np.arange(len(chosen))
    faces = shape.faces.copy()
    faces[chosen] = np.stack([a, middle, c], axis=1)
    vertices = np.concatenate([shape.vertices, (shape.vertices[a] + shape.vertices[b]) / 2])
    return (Shape(vertices, np.concatenate([faces, np.stack([middle, b, c], axis=1)])),
            np.concatenate([np.arange(len(shape.faces)), chosen]))


def in_patches(shape: Shape, patch: np.ndarray, gap: float, rng: np.random.Generator) -> Shape:
    """Every face with vertices of its own, those of each patch, (m,), moved by a share of the diagonal."""
    way = rng.normal(size=(int(patch.max(initial=0)) + 1, 3))
    way *= gap * np.linalg.norm(np.ptp(shape.vertices, axis=0)) / np.linalg.norm(way, axis=1, keepdims=True)
    apart = unjoined(shape)
    return Shape(apart.vertices + np.repeat(way[patch], 3, axis=0), apart.faces)


def moved(shape: Shape, offset) -> Shape:
    return Shape(shape.vertices + np.asarray(offset, float), shape.faces)


def two_spheres(subdivisions: int = 2) -> Shape:
    """Two loose parts, the second of half the radius."""
    return together(icosphere(subdivisions), moved(icosphere(subdivisions, 0.5), (3, 0, 0)))


def cassini(n: int, waist: float, axis: int = 0) -> Shape:
    """Two lobes, an oval of Cassini turned around an axis, on an even spiral of points; a waist of 1 has no width.

    No plane mirrors its triangles, but several mirror its shape.
    """
    from scipy.spatial import ConvexHull

    height = 1 - (2 * np.arange(n) + 1) / n
    turn = np.pi * (1 + 5**0.5) * np.arange(n)
    beside = np.sqrt(1 - height**2)
    directions = np.stack([beside * np.cos(turn), beside * np.sin(turn), height], axis=1)
    faces = ConvexHull(directions).simplices.astype(np.int64)
    inward = np.einsum("ij,ij->i", np.cross(*(directions[faces[:, k]] - directions[faces[:, 0]] for k in (1, 2))),
                       directions[faces].mean(axis=1)) < 0
    faces[inward] = faces[inward, ::-1]
    cosine = 2 * directions[:, axis] ** 2 - 1
    radius = np.sqrt(cosine + np.sqrt(waist**4 - (1 - cosine**2)))
    return Shape(directions * radius[:, None], faces)


def inside_out(shape: Shape) -> Shape:
    """Every face turned the other way."""
    return Shape(shape.vertices, shape.faces[:, ::-1])


def thickened(shape: Shape, thickness: float) -> Shape:
    """A wall so thick below an open surface: its m faces, as many that look the other way, and a rim at its borders."""
    vertices, faces = shape
    corner, normal = vertices[faces], np.zeros_like(vertices)
    np.add.at(normal, faces, np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])[:, None])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    side = np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)
    _, edge, count = np.unique(np.sort(side, axis=1), axis=0, return_inverse=True, return_counts=True)
    start, end = side[count[edge.reshape(-1)] == 1].T
    n = len(vertices)
    rim = np.stack([end, start, start + n, end, start + n, end + n], axis=1).reshape(-1, 3)
    return Shape(np.concatenate([vertices, vertices - thickness * normal]),
                 np.concatenate([faces, faces[:, ::-1] + n, rim]))


def unjoined(shape: Shape) -> Shape:
    """Every face with three vertices of its own, as in an STL file."""
    return Shape(shape.vertices[shape.faces.ravel()], np.arange(3 * len(shape.faces)).reshape(-1, 3))


def with_fin(shape: Shape) -> Shape:
    """A triangle more, standing on the first edge of face 0: three faces meet there."""
    a, b, _ = shape.faces[0]
    tip = 1.5 * (shape.vertices[a] + shape.vertices[b]) / 2 + (0, 0, 0.1)
    return Shape(np.concatenate([shape.vertices, [tip]]),
                 np.concatenate([shape.faces, [(a, b, len(shape.vertices))]]))


def bowtie(shape: Shape) -> Shape:
    """The shape and its mirror image through vertex 0, which the two share and nothing else."""
    mirror = 2 * shape.vertices[0] - shape.vertices
    other = np.concatenate([[0], len(shape.vertices) + np.arange(len(shape.vertices) - 1)])
    return Shape(np.concatenate([shape.vertices, mirror[1:]]),
                 np.concatenate([shape.faces, other[shape.faces][:, ::-1]]))


def with_unused_vertices(shape: Shape, count: int = 3) -> Shape:
    """Vertices of no face before, between and after the others."""
    half = len(shape.vertices) // 2
    place = np.arange(len(shape.vertices)) + np.where(np.arange(len(shape.vertices)) < half, count, 2 * count)
    vertices = np.full((len(shape.vertices) + 3 * count, 3), 7.0)
    vertices[place] = shape.vertices
    return Shape(vertices, place[shape.faces])


def with_flat_faces(shape: Shape, count: int = 5) -> Shape:
    """Faces without area more: a repeated corner, or three corners on a line."""
    v = np.concatenate([shape.vertices, shape.vertices[shape.faces[:count, :2]].mean(axis=1)])
    a, b, _ = shape.faces[:count].T
    needle = np.stack([a, b, len(shape.vertices) + np.arange(count)], axis=1)
    return Shape(v, np.concatenate([shape.faces, needle, np.stack([a, a, b], axis=1)]))


def crumbs(count: int = 2000, seed: int = 0) -> Shape:
    """Small loose triangles scattered in a ball."""
    rng = np.random.default_rng(seed)
    corners = rng.normal(size=(count, 1, 3)) + 0.02 * rng.normal(size=(count, 3, 3))
    return Shape(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def shuffled(shape: Shape, rng: np.random.Generator) -> tuple[Shape, np.ndarray, np.ndarray]:
    """The same mesh with vertices and faces in another order.

    Returns it, and the old index of each new vertex and of each new face.
    """
    vertex = rng.permutation(len(shape.vertices))
    face = rng.permutation(len(shape.faces))
    place = np.empty_like(vertex)
    place[vertex] = np.arange(len(vertex))
    return Shape(shape.vertices[vertex], place[shape.faces[face]]), vertex, face


def rotation(rng: np.random.Generator) -> np.ndarray:
    """A random rotation matrix, (3, 3)."""
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q * np.linalg.det(q)


def _figure(points):
    """Signed distance from a trunk with a head, two arms and two legs, on both sides of the plane x = 0."""
    right = np.abs(points * (1, 0, 0)) + points * (0, 1, 1)
    solid = _capsule(right, (0, 0, 0.2), (0, 0, 1.2), 0.34)
    for limb in (((0, 0, 1.2), (0, 0, 1.9), 0.3), ((0, 0, 1.0), (1.3, 0.1, 1.0), 0.2),
                 ((0.2, 0, 0.2), (0.55, 0, -1.5), 0.24)):
        solid = _blend(solid, _capsule(right, *limb), 0.12)
    return solid


def figure_on_ground(width: float, hills: float = 0.0, deep: float | None = None, step: float = 0.13) -> Shape:
    """The figure, its feet in a square of ground that goes up and down by ``hills`` at z = -1.5, as one surface.

    The ground is open below, or so deep.
    """
    half = width / 2

    def above(points):
        x, y, z = points.T
        return z + 1.5 - hills * np.sin(1.3 * x) * np.cos(1.1 * y)

    def distance(points):
        x, y, _ = points.T
        ground = np.maximum.reduce([above(points), -above(points) - (deep or 1.0), np.abs(x) - half, np.abs(y) - half])
        return np.minimum(_figure(points), ground)

    out = half + 2 * step
    vertices, faces = level_surface(distance, (-out, -out, -3.0 - hills), (out, out, 2.4), step)
    if deep is None:
        faces = faces[(above(vertices) > -0.5)[faces].all(axis=1) & (np.abs(vertices[:, :2]).max(axis=1) < half - step)[
            faces].all(axis=1)]
    used, faces = np.unique(faces, return_inverse=True)
    return Shape(vertices[used], faces.reshape(-1, 3))


def mirrored_figure(step: float = 0.13) -> Shape:
    """A trunk with a head, two arms and two legs: its own mirror image, face by face, in the plane x = 0."""
    # One layer of cells has its middles in the plane, and there, by symmetry, its vertices.
    vertices, faces = level_surface(_figure, (-12.5 * step, -0.6, -1.9), (12.5 * step, 0.6, 2.4), step)
    half = faces[(vertices[faces][:, :, 0] > -1e-3 * step).all(axis=1)]
    return _with_mirror_image(np.where(np.abs(vertices) < 1e-3 * step, 0.0, vertices), half)


def bent(shape: Shape) -> Shape:
    """A shape without any symmetry."""
    x, y, z = shape.vertices.T
    return Shape(np.stack([x + 0.3 * z**2 + 0.1 * y, 1.3 * y + 0.2 * x * z, z + 0.15 * x**2], axis=1), shape.faces)


def posed(vertices: np.ndarray) -> np.ndarray:
    """The figure's vertices in a pose that no plane mirrors: one arm up, the other one forward, a leg to the back."""
    x, _, z = vertices.T
    arm, leg = np.clip((np.abs(x) - 0.45) / 0.6, 0, 1) * (z > 0.5), np.clip((-0.2 - z) / 0.6, 0, 1)
    found = _turned(vertices, (0.45, 0.0, 1.0), (0, 2), 0.9 * arm * (x > 0))
    found = _turned(found, (-0.45, 0.0, 1.0), (0, 1), 0.8 * arm * (x < 0))
    return _turned(found, (0.3, 0.0, -0.2), (1, 2), 0.5 * leg * (x > 0))


def _turned(points: np.ndarray, joint, axes: tuple[int, int], angle: np.ndarray) -> np.ndarray:
    """Points turned about a joint in the plane of two axes, each by an angle of its own."""
    a, b = axes
    turned, offset = points.copy(), points - joint
    turned[:, a] = joint[a] + np.cos(angle) * offset[:, a] - np.sin(angle) * offset[:, b]
    turned[:, b] = joint[b] + np.sin(angle) * offset[:, a] + np.cos(angle) * offset[:, b]
    return turned


def prism_of_rays(n_rays):
    """A star, 1 thick, in quads: a plane through each ray and its middle, and one between its two faces."""
    n = 2 * n_rays
    angle, far = np.arange(n) * np.pi / n_rays, np.where(np.arange(n) % 2, 0.7, 2.0)
    outline = np.append(far[:, None] * np.stack([np.sin(angle), np.cos(angle)], axis=1), np.zeros((1, 2)), axis=0)
    vertices = np.concatenate([np.column_stack([outline, np.full(n + 1, z)]) for z in (-0.5, 0.5)])
    low, tip = np.arange(n), np.arange(0, n, 2)
    sides = np.stack([low, np.roll(low, -1), np.roll(low, -1) + n + 1, low + n + 1], axis=1)
    kites = np.stack([np.full(n_rays, n), tip - 1, tip, tip + 1], axis=1)
    kites[0, 1] = n - 1
    return vertices, np.concatenate([sides[:, ::-1], kites, kites[:, ::-1] + n + 1])


def half_of(shape: Shape) -> Shape:
    """The faces of a shape on the positive side of the plane x = 0, with their vertices only."""
    kept = shape.faces[(shape.vertices[shape.faces, 0] >= -1e-9).all(axis=1)]
    used, faces = np.unique(kept, return_inverse=True)
    return Shape(shape.vertices[used], faces.reshape(-1, 3))


def _with_mirror_image(vertices: np.ndarray, faces: np.ndarray) -> Shape:
    """A half and its image in the plane x = 0, joined there."""
    image = np.where(vertices[:, 0] == 0.0, np.arange(len(vertices)), np.arange(len(vertices)) + len(vertices))
    both = np.concatenate([vertices, vertices * (-1, 1, 1)])
    every = np.concatenate([faces, image[faces][:, ::-1]])
    used, index = np.unique(every, return_inverse=True)
    return Shape(both[used], index.reshape(-1, 3))


def pipe(n: int = 24, levels: int = 7, inner: float = 0.6, bend: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """A closed pipe of triangles, of height 2 along z and a wall from a radius to 1, bent by a parabola."""
    angle = 2 * np.pi * np.arange(n) / n
    heights = np.linspace(-1.0, 1.0, levels)
    # Up outside, down inside: each ring of vertices is joined with the next one, the last with the first.
    profile = [(1.0, z) for z in heights] + [(inner, z) for z in heights[::-1]]
    vertices = np.array([[r * np.cos(a), r * np.sin(a), z] for r, z in profile for a in angle])
    vertices[:, 0] += bend * vertices[:, 2] ** 2
    faces = []
    for ring in range(len(profile)):
        for i in range(n):
            a, b = ring * n + i, ring * n + (i + 1) % n
            c, d = ((ring + 1) % len(profile) * n + j % n for j in (i, i + 1))
            faces += [(a, b, d), (a, d, c)]
    return vertices, np.array(faces)


def volume(vertices: np.ndarray, triangles: np.ndarray) -> float:
    """What a closed surface encloses, wherever it is; less than 0 if it is inside out."""
    a, b, c = (vertices - vertices.mean(axis=0))[triangles].transpose(1, 0, 2)
    return float((a * np.cross(b, c)).sum()) / 6
