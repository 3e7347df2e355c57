# SPDX-License-Identifier: GPL-3.0-or-later
"""What is left of a model's parts when something else comes with it in one mesh: a floor, a box, an outline.

    python3 benchmarks/surroundings.py MESHES... [--up AXIS] [--only WORD ...]

Meshes are NAME.npz with ``vertices`` (n, 3), ``faces`` (m, 3) and labels by people, ``human`` (k, m). Prints, for each
of the things below, the Rand index error of the model's own faces against these labels, in the mean over the meshes,
and how many parts they have; beside it those of the whole mesh, and how many meshes there are: only closed ones become
one surface with a ground. "alone" is the model as it is.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import packages

packages.need("numpy", "scipy", "tqdm", "trimesh", "fast_simplification", "skimage", "manifold3d")

import numpy as np
import trimesh
from manifold3d import Error, Manifold, Mesh64
from scipy.spatial import cKDTree
from skimage.measure import marching_cubes
from tqdm import tqdm

from core import decompose
from core.metrics import rand_index_error

FLOOR_SIDE = 3.0  # of a floor, in units of the largest extent of the model across
CELLS = 48  # of the grid on which the inner wall of a hollow body is found, along its largest extent
DUST = 200
SCAN_NOISE = 0.1  # of a scan, in mean edges

Shape = tuple[np.ndarray, np.ndarray]
Scene = tuple[np.ndarray, np.ndarray, np.ndarray]  # vertices, faces, and the model's face that each is; -1 for others


class Model:
    """A model, up along one of the axes: its vertices, faces, and the box around it."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray, up: int):
        self.vertices, self.faces, self.up = vertices, faces, up
        self.across = [axis for axis in range(3) if axis != up]
        self.low, self.high = vertices.min(axis=0), vertices.max(axis=0)
        self.extent, self.middle = self.high - self.low, (self.low + self.high) / 2
        self.diagonal = float(np.linalg.norm(self.extent))

    @property
    def closed(self) -> trimesh.Trimesh:
        """The same, with vertices at one place joined."""
        mesh = trimesh.Trimesh(self.vertices, self.faces, process=False)
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
        return mesh

    def placed(self, flat: np.ndarray, height: np.ndarray | float = 0.0) -> np.ndarray:
        """Points above or below the lowest one of the model; flat : (k, 2), from its middle."""
        points = np.empty((len(flat), 3))
        points[:, self.across] = self.middle[self.across] + flat
        points[:, self.up] = self.low[self.up] + height
        return points


def in_box(model: Model, share: float) -> Shape:
    """A box around it, larger by a share of its diagonal on each side."""
    box = trimesh.creation.box(extents=model.extent + 2 * share * model.diagonal)
    return box.vertices + model.middle, box.faces


def in_ball(model: Model) -> Shape:
    """A ball stretched around it."""
    ball = trimesh.creation.icosphere(subdivisions=1)
    radius = 1.15 * np.linalg.norm((model.vertices - model.middle) / model.extent, axis=1).max()
    return ball.vertices * model.extent * radius + model.middle, ball.faces


def in_hull(model: Model) -> Shape:
    """Its convex hull, a fiftieth larger."""
    hull = trimesh.convex.convex_hull(model.vertices)
    middle = hull.vertices.mean(axis=0)
    return 1.02 * (hull.vertices - middle) + middle, hull.faces


def second_skin(model: Model, share: float) -> Shape:
    """Itself, turned inside out and moved along its normals by a share of its diagonal."""
    closed = model.closed
    nearest = cKDTree(closed.vertices).query(model.vertices)[1]
    return model.vertices + share * model.diagonal * closed.vertex_normals[nearest], model.faces[:, ::-1]


def inner_wall(model: Model, share: float) -> Shape:
    """The wall of a cavity so far below its surface, of faces of its own, as in a hollow print."""
    step, far = model.extent.max() / CELLS, share * model.diagonal
    grid = np.stack(np.meshgrid(*[np.arange(low - 3 * step, high + 3 * step, step)
                                  for low, high in zip(model.low, model.high, strict=True)], indexing="ij"), axis=-1)
    surface = trimesh.sample.sample_surface(model.closed, 200_000, seed=0)[0]
    distance = cKDTree(surface).query(grid.reshape(-1, 3))[0].reshape(grid.shape[:3])
    points, faces, _, _ = marching_cubes(distance, far, spacing=(step,) * 3)
    shells = trimesh.Trimesh(points + grid[0, 0, 0], faces).split(only_watertight=True)
    inner = [shell for shell in shells
             if (shell.bounds[0] > model.low).all() and (shell.bounds[1] < model.high).all()]
    if not inner:
        return np.empty((0, 3)), np.empty((0, 3), np.int64)
    for shell in inner:
        if shell.volume > 0:
            shell.invert()
    wall = trimesh.util.concatenate(inner)
    return wall.vertices, wall.faces


def coarse(model: Model, share: float) -> Shape:
    """Itself, decimated to a share of its faces."""
    closed = model.closed
    closed = closed.simplify_quadric_decimation(face_count=int(share * len(model.faces)))
    return closed.vertices, closed.faces


def floor(model: Model, n: int, bumps: float = 0.0, side: float = FLOOR_SIDE) -> Shape:
    """A square of n times n squares, hilly by a share of its side."""
    side *= model.extent[model.across].max()
    at = np.linspace(-0.5, 0.5, n + 1)
    flat = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
    height = bumps * np.sin(9 * flat[:, 0] + 1) * np.cos(7 * flat[:, 1])
    return model.placed(side * flat, side * (height - height.max())), squares(n, n)


def tiles(model: Model, n: int) -> Shape:
    """The same floor of n times n tiles that share no vertices."""
    vertices, faces = floor(model, n)
    corners = np.concatenate([faces[:len(faces) // 2], faces[len(faces) // 2:, 2:]], axis=1)
    return vertices[corners].reshape(-1, 3), np.concatenate(
        [4 * np.arange(len(corners))[:, None] + part for part in ((0, 1, 2), (0, 2, 3))])


def cyclorama(model: Model) -> Shape:
    """A floor that bends up to a wall."""
    side = FLOOR_SIDE * model.extent.max()
    turn = np.linspace(0, np.pi / 2, 11)
    flat = np.concatenate([np.linspace(0.5, -0.25, 11)[:-1], -0.25 - 0.25 * np.sin(turn), np.full(10, -0.5)])
    height = np.concatenate([np.zeros(10), 0.25 - 0.25 * np.cos(turn), np.linspace(0.25, 0.85, 11)[1:]])
    across = np.linspace(-0.5, 0.5, 21)
    points = np.stack([np.repeat(flat, 21), np.tile(across, len(flat))], axis=1)
    return model.placed(side * points, side * np.repeat(height, 21)), squares(len(flat) - 1, 20)


def room(model: Model, n: int) -> Shape:
    """A floor, a wall behind and one on each side, of n times n squares each, with corners of their own."""
    side = FLOOR_SIDE * model.extent.max()
    at = np.linspace(-0.5, 0.5, n + 1)
    a, b = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2).T
    half = np.full(len(a), 0.5)
    walls = ((a, b, 0 * half), (-half, -b, a + 0.5), (-a, -half, b + 0.5), (a, half, b + 0.5))
    points = [model.placed(side * np.stack([x, y], axis=1), side * height) for x, y, height in walls]
    return np.concatenate(points), np.concatenate([squares(n, n) + len(a) * k for k in range(4)])


def block(model: Model, wide: float, high: float) -> Shape:
    """A block below it, so wide and high in units of the model."""
    size = wide * model.extent
    size[model.up] = high * model.extent[model.up]
    box = trimesh.creation.box(extents=size)
    return box.vertices + model.placed(np.zeros((1, 2)), -size[model.up] / 2), box.faces


def dust(model: Model) -> Shape:
    """Motes around it, each a three-hundredth of its diagonal."""
    mote, rng = trimesh.creation.icosahedron(), np.random.default_rng(0)
    middle = model.middle + (rng.random((DUST, 1, 3)) - 0.5) * 2 * model.extent
    points = middle + 0.003 * model.diagonal * mote.vertices
    return points.reshape(-1, 3), np.concatenate([mote.faces + len(mote.vertices) * k for k in range(DUST)])


def beside(model: Model, shape: Shape, place: int) -> Shape:
    """Something moved so many times 1.3 widths of the model to its side."""
    step = np.zeros(3)
    step[model.across[0]] = 1.3 * place * model.extent[model.across[0]]
    return shape[0] + step, shape[1]


def squares(n: int, m: int) -> np.ndarray:
    """Triangles of a grid of n times m squares: (2 n m, 3), one of each square after the other."""
    number = np.arange((n + 1) * (m + 1)).reshape(n + 1, m + 1)
    a, b, c, d = (part.ravel() for part in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def in_one_mesh(model: Model, others: list[Shape]) -> Scene:
    """The model and other things."""
    vertices, faces = [model.vertices], [model.faces]
    for points, triangles in others:
        faces.append(triangles + sum(map(len, vertices)))
        vertices.append(points)
    source = np.full(sum(map(len, faces)), -1)
    source[:len(model.faces)] = np.arange(len(model.faces))
    return np.concatenate(vertices), np.concatenate(faces), source


def slab(model: Model, thick: float) -> Shape:
    """A floor so thick, as a share of its side; the model goes a hundredth into it."""
    side = FLOOR_SIDE * model.extent[model.across].max()
    size = np.full(3, side)
    size[model.up] = thick * side
    box = trimesh.creation.box(extents=size)
    return box.vertices + model.placed(np.zeros((1, 2)), 0.01 * model.extent[model.up] - size[model.up] / 2), box.faces


def terrain(model: Model, bumps: float) -> Shape:
    """Hills to the depth of their side, closed; the model goes a twentieth into them."""
    top, faces = floor(model, 40, bumps)
    top[:, model.up] += 0.05 * model.extent[model.up]
    below = top.copy()
    below[:, model.up] = top[:, model.up].min() - np.ptp(top[:, model.across[0]])
    number = np.arange(41 * 41).reshape(41, 41)
    ring = np.concatenate([number[0, :-1], number[:-1, -1], number[-1, :0:-1], number[:0:-1, 0]])
    a, b = ring, np.roll(ring, -1)
    n = len(top)
    walls = np.concatenate([np.stack([a, a + n, b + n], axis=1), np.stack([a, b + n, b], axis=1)])
    return np.concatenate([top, below]), np.concatenate([faces, faces[:, ::-1] + n, walls[:, ::-1]])


def one_surface(model: Model, ground: Shape) -> Scene | None:
    """The surface of the model and what it stands on together, without what looks down or aside of a deep ground.

    None if the model is not closed.
    """
    solids = []
    for vertices, faces in ((model.vertices, model.faces), ground):
        faces = faces if trimesh.Trimesh(vertices, faces, process=False).volume > 0 else faces[:, ::-1]
        solids.append(Manifold(Mesh64(vertices, np.ascontiguousarray(faces, np.uint64))).as_original())
    if any(solid.status() != Error.NoError for solid in solids):
        return None
    found = (solids[0] + solids[1]).to_mesh64()
    vertices, faces = np.asarray(found.vert_properties), np.asarray(found.tri_verts).astype(np.int64)
    runs = np.diff(np.asarray(found.run_index).astype(np.int64)) // 3
    mine = np.repeat(np.asarray(found.run_original_id) == solids[0].original_id(), runs)
    middle = model.vertices[model.faces].mean(axis=1)
    source = np.where(mine, cKDTree(middle).query(vertices[faces].mean(axis=1))[1], -1)
    if np.ptp(ground[0][:, model.up]) < FLOOR_SIDE * model.extent[model.across].max():
        return vertices, faces, source
    normal = trimesh.Trimesh(vertices, faces, process=False).face_normals
    kept = mine | (normal[:, model.up] > 0.1)
    return vertices, faces[kept], source[kept]


def noisy(scene: Scene | None) -> Scene | None:
    """The same with vertices moved at random."""
    if scene is None:
        return None
    vertices, faces, source = scene
    edge = np.linalg.norm(vertices[faces] - vertices[np.roll(faces, 1, axis=1)], axis=2).mean()
    return vertices + SCAN_NOISE * edge * np.random.default_rng(0).normal(size=vertices.shape), faces, source


SURROUNDINGS = {
    "alone": lambda model: [],
    "box, as small as can be": lambda model: [in_box(model, 0.0)],
    "box, larger by 0.01": lambda model: [in_box(model, 0.01)],
    "ball": lambda model: [in_ball(model)],
    "convex hull": lambda model: [in_hull(model)],
    "outline at 0.002": lambda model: [second_skin(model, 0.002)],
    "outline at 0.005": lambda model: [second_skin(model, 0.005)],
    "outline at 0.015": lambda model: [second_skin(model, 0.015)],
    "inner skin at 0.01": lambda model: [second_skin(model, -0.01)],
    "cavity at 0.02": lambda model: [inner_wall(model, 0.02)],
    "decimated to 0.3": lambda model: [coarse(model, 0.3)],
    "three levels of detail beside it": lambda model: [
        beside(model, coarse(model, share), k) for k, share in enumerate((0.5, 0.25, 0.1), 1)],
    "two more beside it": lambda model: [beside(model, (model.vertices, model.faces), k) for k in (1, 2)],
    "floor of two triangles": lambda model: [floor(model, 1)],
    "floor of 3,200": lambda model: [floor(model, 40)],
    "floor of 64 tiles": lambda model: [tiles(model, 8)],
    "hills": lambda model: [floor(model, 40, 0.05)],
    "cyclorama": lambda model: [cyclorama(model)],
    "room, open in front": lambda model: [room(model, 12)],
    "block": lambda model: [block(model, 1.0, 0.5)],
    "dust": lambda model: [dust(model)],
}
ONE_SURFACE = {
    "one surface with a slab": lambda model: one_surface(model, slab(model, 0.03)),
    "one surface with hills": lambda model: one_surface(model, terrain(model, 0.03)),
    "the same with noise": lambda model: noisy(one_surface(model, terrain(model, 0.03))),
}


def measure(human: np.ndarray, scene: Scene) -> tuple[float, int, int]:
    """Error of the model's faces, how many parts they have, and how many the whole has."""
    vertices, faces, source = scene
    labels, mine = decompose(vertices, faces).parts().labels, source >= 0
    own = np.unique(labels[mine], return_inverse=True)[1]
    error = np.mean([rand_index_error(own, np.unique(person[source[mine]], return_inverse=True)[1])
                     for person in human])
    return float(error), int(own.max()) + 1, int(labels.max()) + 1


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--up", type=int, default=1, choices=range(3), metavar="AXIS", help="0, 1 or 2; 1 without it")
    parser.add_argument("--only", nargs="*", default=[], metavar="WORD", help="what has one of these words in its name")
    options = parser.parse_args()
    models = []
    for path in options.meshes:
        with np.load(path, allow_pickle=False) as data:
            models.append((Model(data["vertices"].astype(float), data["faces"].astype(np.int64), options.up),
                           data["human"]))
    print(f"{len(models)} models{'':24} error  parts  of all  models")
    scenes = {name: lambda model, around=around: in_one_mesh(model, around(model))
              for name, around in SURROUNDINGS.items()} | ONE_SURFACE
    for name, scene_of in scenes.items():
        if options.only and not any(word in name for word in options.only):
            continue
        rows = [measure(human, scene) for model, human in tqdm(models, desc=name, leave=False)
                if (scene := scene_of(model)) is not None]
        if rows:
            error, own, whole = np.mean(rows, axis=0)
            print(f"{name:32} {error:8.3f} {own:6.1f} {whole:7.1f} {len(rows):7}", flush=True)


if __name__ == "__main__":
    main()
