# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies made at random whose parts are known: what train.py learns from beside meshes that people labelled.

People labelled animals, cups and glasses. Of balls, boxes and tubes, of which models are built, and of shapes that are
one part and nothing else, they said little. Where people would not agree - a tube that goes on nearly as thick, a waist
that is hardly narrower - a body has several labellings, with a cut and without.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import packages

sys.path.append(str(packages.ROOT / "tests"))

import shapes
from shapes import Shape

from core.mesh.triangles import TriMesh

COUNTS = {"plain": 60, "limbs": 80, "tubes": 40, "turned": 50, "blocks": 50}
N_PEOPLE = 4
MIN_FACES, MAX_FACES = 300, 6000

#: Signed distance of (n, 3) points from a surface, (n,); negative inside.
Distance = Callable[[np.ndarray], np.ndarray]


class Part(NamedTuple):
    """One part of a body.

    Attributes
    ----------
    distance : callable
    parent : int
        The part it grows from, an index; -1 of the first.
    certainty : float
        Share of people who cut it off from its parent, 0..1.
    """

    distance: Distance
    parent: int = -1
    certainty: float = 1.0


def known_solids(seed: int = 1) -> dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Bodies of one part and of several, in any pose, density and order.

    Returns
    -------
    solids : dict by name, KIND.NUMBER, of (vertices (n, 3), faces (m, 3), part of each face (people, m))
    """
    rng = np.random.default_rng(seed)
    makers = {"plain": plain, "limbs": body_with_limbs, "tubes": tree_of_tubes, "turned": turned, "blocks": built}
    made = {}
    for kind, count in COUNTS.items():
        for number in range(count):
            shape, people = makers[kind](rng)
            shape, _, face = shapes.shuffled(Shape(shape.vertices @ shapes.rotation(rng), shape.faces), rng)
            made[f"{kind}.{number}"] = *shape, people[:, face]
    return made


# Surfaces by their distance -------------------------------------------------------------------------


def rod(start, end, radius) -> Distance:
    """A rod with round ends; ``radius`` is that of either end."""
    start, along = np.asarray(start, float), np.subtract(end, start)

    def distance(points):
        t = np.clip((points - start) @ along / max(along @ along, 1e-12), 0, 1)
        return np.linalg.norm(points - start - t[:, None] * along, axis=1) - (radius[0] + t * (radius[1] - radius[0]))

    return distance


def arc(center, x, y, ring: float, angle: float, radius) -> Distance:
    """A rod bent around a center from the direction x through an angle towards y; x and y are unit vectors."""

    def distance(points):
        p = points - center
        t = np.arctan2(p @ y, p @ x)
        t = np.clip(np.where(t < angle / 2 - np.pi, t + 2 * np.pi, t), 0, angle)
        nearest = ring * (np.cos(t)[:, None] * x + np.sin(t)[:, None] * y)
        return np.linalg.norm(p - nearest, axis=1) - (radius[0] + t / angle * (radius[1] - radius[0]))

    return distance


def ellipsoid(center, half) -> Distance:
    """Nearly its distance."""

    def distance(points):
        p = (points - center) / half
        length = np.linalg.norm(p, axis=1)
        return length * (length - 1) / np.maximum(np.linalg.norm(p / half, axis=1), 1e-9)

    return distance


def cuboid(center, half, rounding: float) -> Distance:
    """A box, its edges rounded by a radius."""

    def distance(points):
        p = np.abs(points - center) - (np.asarray(half) - rounding)
        return np.linalg.norm(np.maximum(p, 0), axis=1) + np.minimum(p.max(axis=1), 0) - rounding

    return distance


def tin(center, radius: float, half: float, rounding: float) -> Distance:
    """A cylinder along z, its edges rounded by a radius."""

    def distance(points):
        p = points - center
        p = np.stack([np.hypot(p[:, 0], p[:, 1]) - radius + rounding, np.abs(p[:, 2]) - half + rounding], axis=1)
        return np.linalg.norm(np.maximum(p, 0), axis=1) + np.minimum(p.max(axis=1), 0) - rounding

    return distance


def united(distances: list[Distance], width: float) -> Distance:
    """The union, its seams rounded by about a width."""

    def distance(points):
        solid = distances[0](points)
        for other in distances[1:]:
            value = other(points)
            near = np.maximum(width - np.abs(solid - value), 0) / max(width, 1e-12)
            solid = np.minimum(solid, value) - 0.25 * width * near**2
        return solid

    return distance


def meshed(distance: Distance, size: float, thinnest: float, rng: np.random.Generator) -> Shape:
    """The zero set in a cube of ``size`` around 0: triangles of a grid, one time of two, or decimated ones."""
    step = np.clip(thinnest * np.exp(rng.uniform(*np.log([0.4, 0.9]))), size / 70, size / 16)
    low = np.full(3, -size / 2) - step * rng.uniform(0, 1, 3)
    shape = largest_piece(shapes.level_surface(distance, low, np.full(3, size / 2), step))
    return largest_piece(decimated(shape, rng)) if rng.random() < 1 / 2 else shape


def largest_piece(shape: Shape) -> Shape:
    """Without what is not connected with most of the faces."""
    _, piece = TriMesh(*shape).face_components
    used, faces = np.unique(shape.faces[piece == np.bincount(piece).argmax()], return_inverse=True)
    return Shape(shape.vertices[used], faces.reshape(-1, 3))


def decimated(shape: Shape, rng: np.random.Generator) -> Shape:
    """Fewer triangles, of any form."""
    count = int(np.exp(rng.uniform(*np.log([MIN_FACES, MAX_FACES]))))
    if count >= len(shape.faces):
        return shape
    import fast_simplification  # where nothing is decimated, as in tests, it is not needed

    vertices, faces = fast_simplification.simplify(
        shape.vertices.astype(np.float32), shape.faces.astype(np.int32), target_count=count)
    return Shape(vertices.astype(float), faces.astype(np.int64))


def labels_of(shape: Shape, parts: list[Part], width: float, rng: np.random.Generator) -> np.ndarray:
    """(people, m) part of each face: the nearest, or what it grows from where somebody does not cut it off.

    Rounded seams belong to what a part grows from, and everybody cuts somewhere else.
    """
    center = shape.vertices[shape.faces].mean(axis=1)
    distance = np.stack([part.distance(center) for part in parts])
    people = []
    for person in range(N_PEOPLE):
        owner = np.arange(len(parts))
        for i, part in enumerate(parts):  # parents come first
            if part.parent >= 0 and part.certainty < (person + 0.5) / N_PEOPLE:
                owner[i] = owner[part.parent]
        move = width * (rng.uniform(-0.25, 0.25, len(parts)) + [float(part.parent >= 0) for part in parts])
        people.append(owner[(distance + move[:, None]).argmin(axis=0)])
    return np.array(people)


def certainty(value: float, none: float, sure: float) -> float:
    """0 at ``none`` and beyond, 1 at ``sure`` and beyond."""
    return float(np.clip((value - none) / (sure - none), 0.0, 1.0))


# One part -----------------------------------------------------------------------------------------


def plain(rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """A ball, box, cylinder, cone, ring or bent tube: smooth or wrinkled, whole or open."""
    long, wide = np.exp(rng.uniform(0, 1.2)), np.exp(rng.uniform(0, 0.7))
    half = np.array([1.0, wide, wide * long])
    rounding = rng.choice([0.02, rng.uniform(0.05, 0.6)])
    kind = rng.choice(["ball", "box", "tin", "cone", "ring", "bent", "rod"])
    if kind == "ball":
        distance, thin = ellipsoid(0, half), 1.0
    elif kind == "box":
        half[0] *= rng.choice([1.0, rng.uniform(0.2, 1.0)])
        distance, thin = cuboid(0, half, rounding * half[0]), half[0]
    elif kind == "tin":
        tall = np.exp(rng.uniform(-1.5, 1.5))
        distance, thin = tin(0, 1.0, tall, rounding * min(1.0, tall)), min(1.0, tall)
    elif kind == "cone":
        distance, thin = rod((0, 0, -long), (0, 0, long), (1.0, rng.uniform(0.1, 0.7))), 0.6
    elif kind == "rod":
        distance, thin = rod((0, 0, -2 * long), (0, 0, 2 * long), (1.0, rng.uniform(0.8, 1.0))), 1.0
    else:
        ring, angle = rng.uniform(1.6, 4), 2 * np.pi if kind == "ring" else rng.uniform(0.5, 4)
        distance, thin = arc(0, np.eye(3)[0], np.eye(3)[1], ring, angle, (1.0, 1.0)), 1.0
        half = np.full(3, ring + 1.0)
    reach = 2.2 * max(half.max(), 2 * long + 1.0 if kind in ("rod", "cone") else 0.0, 4.6 if kind == "tin" else 0.0)
    shape = meshed(distance, reach, 0.7 * thin, rng)
    if rng.random() < 0.4:
        shape = wrinkled(shape, thin * rng.choice([0.01, 0.03, 0.06]), rng)
    if rng.random() < 0.15:
        shape = opened(shape, rng)
    return shape, np.zeros((1, len(shape.faces)), np.int64)


def wrinkled(shape: Shape, height: float, rng: np.random.Generator) -> Shape:
    """Moved by a few waves."""
    size = np.ptp(shape.vertices, axis=0).max()
    frequency = rng.normal(scale=rng.uniform(2, 9) / size, size=(4, 3, 3))
    wave = np.sin(shape.vertices @ frequency + rng.uniform(0, 6, (4, 1, 3))).sum(axis=0)
    return Shape(shape.vertices + height * wave, shape.faces)


def opened(shape: Shape, rng: np.random.Generator) -> Shape:
    """Without what lies beyond a plane; the largest connected piece."""
    normal = rng.normal(size=3)
    height = shape.vertices[shape.faces].mean(axis=1) @ normal
    used, faces = np.unique(shape.faces[height < np.quantile(height, rng.uniform(0.7, 0.95))], return_inverse=True)
    return largest_piece(Shape(shape.vertices[used], faces.reshape(-1, 3)))


# Limbs --------------------------------------------------------------------------------------------


class Limb(NamedTuple):
    """A rod, straight or bent: its distance, points along its middle, the direction of its end, how thick it is."""

    distance: Distance
    middle: np.ndarray
    direction: np.ndarray
    radius: tuple
    is_handle: bool = False


def limb(start: np.ndarray, direction: np.ndarray, length: float, radius, rng: np.random.Generator) -> Limb:
    """A limb that leaves a point in a direction, a third of them bent."""
    if rng.random() < 2 / 3:
        end = start + length * direction
        return Limb(rod(start, end, radius), start + np.linspace(0, 1, 12)[:, None] * (end - start), direction, radius)
    across = np.cross(direction, rng.normal(size=3))
    across /= np.linalg.norm(across)
    angle = rng.uniform(0.4, min(2.2, length / (1.5 * max(radius))))
    ring = length / angle
    center = start + ring * across
    t = np.linspace(0, angle, 12)[:, None]
    middle = center + ring * (np.sin(t) * direction - np.cos(t) * across)
    end = np.cos(angle) * direction + np.sin(angle) * across
    return Limb(arc(center, -across, direction, ring, angle, radius), middle, end, radius)


def body_with_limbs(rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """A ball, box, cylinder or rod with limbs, in pairs or all around, which may have heads or fingers."""
    while True:
        parts, radii = [Part(_trunk(rng))], []
        limbs: list[Limb] = []
        inner = -parts[0].distance(np.full((1, 3), 1e-6))[0]
        for _ in range(int(rng.integers(1, 5))):
            found = _limbs(parts[0].distance, inner, rng)
            if all(_is_free(one, parts[0].distance, [*limbs, *(o for o in found if o is not one)]) for one in found):
                limbs += found
                end = rng.choice(["none", "none", "head", "fork"]) if not found[0].is_handle else "none"
                state = rng.integers(1 << 32)
                for one in found:
                    length = np.linalg.norm(np.diff(one.middle, axis=0), axis=1).sum()
                    sure = certainty(max(one.radius) / inner, 1.0, 0.6) * certainty(length / one.radius[0], 1.0, 2.5)
                    parts.append(Part(one.distance, 0, sure))
                    parts += _end(end, one, len(parts) - 1, np.random.default_rng(state))
                    radii.append(min(one.radius))
        if limbs:
            break
    width = min(radii) * rng.choice([0.0, rng.uniform(0.2, 1.2)])
    return _of_parts(parts, width, min(radii), rng)


def _of_parts(parts: list[Part], width: float, thinnest: float, rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """The union of parts, meshed, and what people say of it."""
    distance = united([part.distance for part in parts], width)
    size = 4.0
    while True:  # until the surface of the cube is outside
        t = np.linspace(-size / 2, size / 2, 24)
        grid = np.stack(np.meshgrid(t, t, indexing="ij"), axis=-1).reshape(-1, 2)
        sides = [np.insert(grid, axis, side, axis=1) for axis in range(3) for side in (-size / 2, size / 2)]
        if distance(np.concatenate(sides)).min() > 0.1 * size / 24 + size / 24:
            break
        size *= 1.2
    shape = meshed(distance, size, thinnest, rng)
    return shape, labels_of(shape, parts, width, rng)


def _trunk(rng: np.random.Generator) -> Distance:
    half = np.exp(rng.uniform(-0.5, 0.5, 3))
    kind = rng.choice(["ball", "box", "tin", "rod"])
    if kind == "ball":
        return ellipsoid(0, half)
    if kind == "box":
        return cuboid(0, half, half.min() * rng.choice([0.05, rng.uniform(0.1, 0.9)]))
    if kind == "tin":
        return tin(0, half[0], half[2], half[[0, 2]].min() * rng.uniform(0.05, 0.6))
    return rod((0, 0, -1.5 * half[2]), (0, 0, 1.5 * half[2]), half[0] * rng.uniform(0.7, 1, 2))


def _limbs(trunk: Distance, inner: float, rng: np.random.Generator) -> list[Limb]:
    """One limb, a pair of mirror images, or three to six around an axis."""
    outward = rng.normal(size=3)
    outward /= np.linalg.norm(outward)
    slant = 0.5 * rng.normal(size=3)
    thick = inner * rng.uniform(0.12, 0.75)
    radius = thick * np.array([1.0, rng.choice([1.0, rng.uniform(0.4, 1.0)])])
    length = thick * np.exp(rng.uniform(*np.log([2, 12])))
    is_handle, share = rng.random() < 0.15, rng.uniform(0.15, 0.35)
    kind = rng.choice(["one", "pair"] if is_handle else ["one", "pair", "around"])
    state = rng.integers(1 << 32)
    images = [np.eye(3)]
    if kind == "pair":
        images.append(np.diag([-1.0, 1.0, 1.0]))
    elif kind == "around":
        count = int(rng.integers(3, 7))
        angles = 2 * np.pi * np.arange(count) / count
        images = [np.array([(np.cos(a), -np.sin(a), 0), (np.sin(a), np.cos(a), 0), (0, 0, 1)]) for a in angles]
    made = []
    for image in images:
        # A surface all around which the trunk is not is no harm: each limb begins where the trunk ends.
        out = image @ outward
        t = _way_out(trunk, out)
        normal = _normal(trunk, t * out)
        direction = normal + image @ slant
        direction /= np.linalg.norm(direction)
        if is_handle:
            made.append(_handle(t * out, normal, np.cross(normal, image @ slant), thick, thick * share))
            continue
        start = t * out - 0.7 * radius[0] * normal
        made.append(limb(start, direction, length + 0.7 * radius[0], tuple(radius), np.random.default_rng(state)))
    return made


def _handle(place: np.ndarray, normal: np.ndarray, along: np.ndarray, ring: float, radius: float) -> Limb:
    """Half a ring, and a little more, that stands on a surface."""
    along = along / np.linalg.norm(along)
    angle = np.pi + 0.9
    x = np.cos(0.45) * along - np.sin(0.45) * normal
    y = np.sin(0.45) * along + np.cos(0.45) * normal
    t = np.linspace(0, angle, 12)[:, None]
    middle = place + ring * (np.cos(t) * x + np.sin(t) * y)
    return Limb(arc(place, x, y, ring, angle, (radius, radius)), middle, normal, (radius, radius), True)


def _way_out(distance: Distance, direction: np.ndarray) -> float:
    """How far it is from 0 to the surface."""
    low, high = 0.0, 10.0
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if distance(middle * direction[None])[0] < 0 else (low, middle)
    return low


def _normal(distance: Distance, point: np.ndarray) -> np.ndarray:
    gradient = np.array([distance((point + 1e-4 * e)[None])[0] - distance((point - 1e-4 * e)[None])[0]
                         for e in np.eye(3)])
    return gradient / np.linalg.norm(gradient)


def _is_free(one: Limb, trunk: Distance, others: list[Limb]) -> bool:
    """Whether neither the trunk nor another limb comes near, but where it begins."""
    middle = one.middle[4:-4] if one.is_handle else one.middle[3:]
    return all(other(middle).min() > 1.4 * max(one.radius) for other in (trunk, *(limb.distance for limb in others)))


def _end(kind: str, one: Limb, parent: int, rng: np.random.Generator) -> list[Part]:
    """A head at the end of a limb, or fingers."""
    tip, radius = one.middle[-1], one.radius[1]
    if kind == "head":
        half = radius * rng.uniform(1.2, 2.6) * np.exp(rng.uniform(-0.2, 0.2, 3))
        sure = certainty(half.min() / radius, 1.1, 1.5)
        return [Part(ellipsoid(tip + 0.8 * half.min() * one.direction, half), parent, sure)]
    if kind == "fork":
        count, thick = int(rng.integers(2, 5)), radius * rng.uniform(0.35, 0.6)
        across = np.cross(one.direction, rng.normal(size=3))
        across /= np.linalg.norm(across)
        angles = np.linspace(-1, 1, count) * rng.uniform(0.6, 1.1)
        length = radius + thick * rng.uniform(3, 7)
        return [Part(rod(tip, tip + length * (np.cos(a) * one.direction + np.sin(a) * across), (thick, thick)), parent)
                for a in angles]
    return []


def tree_of_tubes(rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """Three to six tubes, nearly as thick as each other, from one place; some have a knot there, some have twigs."""
    thick = rng.uniform(0.15, 0.35)
    directions: list[np.ndarray] = []
    count = int(rng.integers(3, 7))
    while len(directions) < count:
        new = rng.normal(size=3)
        new /= np.linalg.norm(new)
        if all(new @ old < 0.6 for old in directions):
            directions.append(new)
    knot = thick * rng.uniform(1.3, 2.2)
    has_knot = rng.random() < 0.6
    parts = [Part(ellipsoid(0, np.full(3, knot)), -1)] if has_knot else []
    for place, direction in enumerate(directions):
        radius = thick * rng.uniform(0.8, 1.0, 2)
        one = limb(np.zeros(3), direction, rng.uniform(5, 9) * thick + 0.5, tuple(radius), rng)
        if has_knot:
            parts.append(Part(one.distance, 0, 1.0))
        else:  # the first two are one tube for some
            parts.append(Part(one.distance, 0 if place == 1 else -1,
                              certainty(directions[0] @ direction, -0.95, -0.5) if place == 1 else 1.0))
        if rng.random() < 0.3:
            across = np.cross(one.direction, rng.normal(size=3))
            across = across / np.linalg.norm(across) + 0.3 * one.direction
            twig = thick * rng.uniform(0.5, 0.8)
            start = one.middle[7]
            parts.append(Part(rod(start, start + across * (thick + twig * rng.uniform(4, 8)), (twig, twig)),
                              len(parts) - 1, certainty(twig / thick, 1.0, 0.7)))
    return _of_parts(parts, thick * rng.choice([0.0, rng.uniform(0.2, 1.0)]), 0.6 * thick, rng)


# Turned -------------------------------------------------------------------------------------------


def turned(rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """Two to four balls, cylinders and cones in a row, some with thin necks between them."""
    radii, lengths = [float(np.exp(rng.uniform(-0.4, 0.4)))], []
    for _ in range(int(rng.integers(1, 4))):
        last = radii[-1]
        radii.append(last * rng.choice([rng.uniform(0.15, 0.55), rng.uniform(0.6, 1.0), 1.0]) if last > 0.5
                     else float(np.exp(rng.uniform(-0.4, 0.4))))
    if rng.random() < 0.3:  # both ends are alike
        radii = [*radii[:2], radii[0]]
    parts, z, z_last = [], 0.0, 0.0
    thinnest = min(radii)
    for i, radius in enumerate(radii):
        is_ball = radius > 0.5 and rng.random() < 0.6
        half = radius * (np.exp(rng.uniform(-0.3, 0.5)) if is_ball else np.exp(rng.uniform(-0.7, 1.0)))
        if radius <= 0.5:
            half = radius * rng.uniform(1.5, 5)
        lengths.append(half)
        z = 0.0 if i == 0 else z_last + half * (rng.uniform(0.75, 0.95) if is_ball else 1.0)
        center = np.array([0, 0, z])
        if is_ball:
            distance = ellipsoid(center, np.array([radius, radius, half]))
        else:
            distance = tin(center - (0, 0, 0.05 * half), radius, 1.05 * half + 0.02, 0.05 * min(radius, half))
        sure = 1.0
        if i:
            sure = certainty(_waist(parts[-1].distance, distance, z_last, radii[i - 1], radius), 0.9, 0.6)
        parts.append(Part(distance, i - 1, sure))
        z_last = z + half * (rng.uniform(0.75, 0.95) if is_ball else 1.0)
    middle = z_last / 2 - lengths[0] / 2
    moved = [Part(_moved(part.distance, middle), part.parent, part.certainty) for part in parts]
    return _of_parts(moved, 0.5 * thinnest * rng.choice([0.0, rng.uniform(0.1, 1.0)]), thinnest, rng)


def _moved(distance: Distance, z: float) -> Distance:
    return lambda points: distance(points + (0, 0, z))


def _waist(first: Distance, second: Distance, z: float, radius: float, other: float) -> float:
    """How thick the union is where both meet, at its thinnest between, over the thinner or, of a step, the thicker."""
    heights = np.linspace(z - 0.5 * radius, z + 0.5 * other, 25)
    outer = []
    for height in heights:
        line = np.stack([np.linspace(0, 3, 150), np.zeros(150), np.full(150, height)], axis=1)
        inside = np.minimum(first(line), second(line)) < 0
        outer.append(line[inside, 0].max() if inside.any() else 0.0)
    narrow = min(outer) / min(radius, other)
    return min(narrow, min(radius, other) / max(radius, other) + 0.15)


# Blocks -------------------------------------------------------------------------------------------


def built(rng: np.random.Generator) -> tuple[Shape, np.ndarray]:
    """Blocks of cubes: a table, bars across each other, a base with towers, a comb, an angle; unevenly stretched."""
    kind = rng.choice(["table", "cross", "towers", "comb", "angle", "one"])
    boxes, people = {"table": _table, "cross": _cross, "towers": _towers, "comb": _comb, "angle": _angle,
                     "one": _one}[kind](rng)
    size = np.max([high for _, high in boxes], axis=0)
    voxel = np.full(size, -1)
    for index, (low, high) in enumerate(boxes):  # later ones do not take from earlier ones
        view = voxel[tuple(slice(a, b) for a, b in zip(low, high, strict=True))]
        view[view < 0] = index
    vertices, quads = shapes.blocks(voxel >= 0)
    corners = vertices[quads]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    cube = np.floor(corners.mean(axis=1) - normal / 2 + (size + 2) / 2).astype(int) - 1
    box = voxel[tuple(cube.T)]
    stretched = np.empty_like(vertices)
    stretch = np.exp(rng.uniform(-0.5, 0.5, 3))
    for axis, column in enumerate(vertices.T):
        lines = np.unique(column)
        widths = np.exp(rng.uniform(0, rng.choice([0.0, 0.8])) * rng.uniform(-0.5, 0.5, len(lines)))
        stretched[:, axis] = stretch[axis] * np.interp(column, lines, np.cumsum(widths))
    shape = Shape(stretched, shapes.split_quads(quads))
    labels = np.array(people)[:, np.repeat(box, 2)]
    while len(shape.faces) < 250:
        shape, labels = shapes.subdivide(shape), np.repeat(labels, 4, axis=1)
    return shape, labels


def _table(rng):
    x, y, top, leg = rng.integers(6, 13), rng.integers(5, 11), rng.integers(1, 3), rng.integers(1, 3)
    tall = int(rng.integers(3, 9))
    boxes = [((0, 0, tall), (x, y, tall + top))]
    for a in (0, x - leg):
        places = [(y - leg) // 2] if rng.random() < 0.25 else [0, y - leg]
        boxes += [((a, b, 0), (a + leg, b + leg, tall)) for b in places]
    if rng.random() < 0.3:  # a back
        boxes.append(((0, 0, tall + top), (1, y, tall + top + int(rng.integers(3, 8)))))
    return boxes, [np.arange(len(boxes))]


def _cross(rng):
    """Two bars: the middle is a part, or the longer bar goes through."""
    wide, deep, arms = int(rng.integers(1, 4)), int(rng.integers(1, 4)), rng.integers(3, 10, 4)
    if rng.random() < 0.5:
        arms[1:] = arms[0]
    a, b, c, d = (int(n) + wide for n in arms)
    low, high = np.array([a, c]), np.array([a + wide, c + wide])
    boxes = [((*low, 0), (*high, deep)), ((0, low[1], 0), (low[0], high[1], deep)),
             ((high[0], low[1], 0), (high[0] + b, high[1], deep)), ((low[0], 0, 0), (high[0], low[1], deep)),
             ((low[0], high[1], 0), (high[0], high[1] + d, deep))]
    if rng.random() < 0.3:
        boxes.pop()
        return boxes, [[0, 1, 2, 3], [0, 0, 0, 3]]
    apart, first, second = [0, 1, 2, 3, 4], [0, 0, 0, 3, 4], [0, 1, 2, 0, 0]
    if len(set(arms)) == 1:
        return boxes, [apart]
    return boxes, [apart, apart, first if a + b > c + d else second]


def _towers(rng):
    x, y, z = (int(n) for n in rng.integers(4, 11, 3))
    boxes = [((0, 0, 0), (x, y, z))]
    p, q = (int(n) for n in rng.integers(1, np.maximum([x, y], 3) // 2 + 1))
    a, b = int(rng.integers(0, x - p + 1)), int(rng.integers(0, y - q + 1))
    boxes.append(((a, b, z), (a + p, b + q, z + int(rng.integers(max(p, q), 4 * max(p, q) + 1)))))
    return boxes, [[0, 1]]


def _comb(rng):
    n, wide, gap, deep, long, back = (int(rng.integers(*ends)) for ends in ((2, 5), (1, 3), (1, 4), (1, 4), (4, 10),
                                                                            (1, 3)))
    total = n * wide + (n - 1) * gap
    boxes = [((0, 0, 0), (total, back, deep))]
    boxes += [((k * (wide + gap), back, 0), (k * (wide + gap) + wide, back + long, deep)) for k in range(n)]
    return boxes, [np.arange(n + 1)]


def _angle(rng):
    """Two bars at a corner, which is a cut to some, or belongs to either bar, or to none."""
    wide, deep, a, b = (int(rng.integers(*ends)) for ends in ((1, 4), (1, 4), (4, 10), (4, 10)))
    boxes = [((0, 0, 0), (wide, wide, deep)), ((wide, 0, 0), (wide + a, wide, deep)),
             ((0, wide, 0), (wide, wide + b, deep))]
    return boxes, [[0, 0, 0], [0, 0, 0], [0, 0, 1], [0, 1, 0]]


def _one(rng):
    return [((0, 0, 0), tuple(int(n) for n in rng.integers(1, 9, 3)))], [[0]]
