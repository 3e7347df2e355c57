# SPDX-License-Identifier: GPL-3.0-or-later
"""The same models again: how much of a model has another part when it is moved, scaled, turned, shuffled or mirrored.

    python3 benchmarks/again.py MESHES [MESHES ...] [--most FACES] [--jobs N] [--single]

MESHES are .npz with `vertices` and `faces`, .obj, .ply or .stl. Prints, for each change, how many models have
another part on more than 1 % of their area, and the mean of that area; then the models that do. With --single all
coordinates have single precision, before and after, as Blender and most files keep them.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import packages

packages.need("numpy", "scipy", "trimesh", "tqdm", "joblib")

import numpy as np
from joblib import Parallel, delayed
from meshes import load_mesh
from scipy.optimize import linear_sum_assignment
from scipy.sparse import csr_array
from tqdm import tqdm

from core import ReebError, TriMesh, decompose
from core.metrics import Overlap

MUCH = 0.01


def moved(vertices: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """By three times its size in any direction."""
    return vertices + 3 * np.ptp(vertices, axis=0).max() * rng.normal(size=3), faces


def scaled(vertices: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """By a factor of 0.01 to 100."""
    return vertices * 10 ** rng.uniform(-2, 2), faces


def upright(vertices: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """By a quarter, from y up to z up."""
    return vertices[:, [0, 2, 1]] * (1, -1, 1), faces


def turned(vertices: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """In any way."""
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return vertices @ (turn * np.sign(np.linalg.det(turn))), faces


def shuffled(vertices: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Vertices in any order, faces from the last to the first."""
    order = rng.permutation(len(vertices))
    return vertices[order], np.argsort(order)[faces][::-1]


def mirrored(vertices: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Across x."""
    return vertices * (-1, 1, 1), faces[:, ::-1]


CHANGES = {change.__name__: change for change in (moved, scaled, upright, turned, shuffled, mirrored)}


def apart(one: np.ndarray, other: np.ndarray, area: np.ndarray) -> float:
    """Share of the area whose part is another, parts being paired so that it is least."""
    overlap = Overlap.of(one, other, area)
    common = csr_array((overlap.weight, tuple(overlap.pair.T))).toarray()
    return 1.0 - common[linear_sum_assignment(-common)].sum() / area.sum()


def differences(path: Path, most: int, single: bool) -> list[float] | None:
    """What each change does to the parts of a model; None for one that has more faces, or cannot be cut."""
    kept = np.float32 if single else float
    vertices, faces = load_mesh(path)
    vertices = vertices.astype(kept).astype(float)
    if len(faces) > most:
        return None
    try:
        labels = decompose(vertices, faces).parts().labels
    except ReebError:
        return None
    area = TriMesh(vertices, faces).face_area + 1e-300
    found = {}
    for name, change in CHANGES.items():
        places, corners = change(vertices, faces, np.random.default_rng(0))
        other = decompose(places.astype(kept).astype(float), corners).parts().labels
        found[name] = apart(labels, other[::-1] if name == "shuffled" else other, area)
    return list(found.values())


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path, metavar="MESHES")
    parser.add_argument("--most", type=int, default=10_000, metavar="FACES", help="larger models are left out")
    parser.add_argument("--jobs", type=int, default=1, metavar="N")
    parser.add_argument("--single", action="store_true", help="round coordinates to single precision")
    arguments = parser.parse_args()
    found = list(tqdm(
        Parallel(arguments.jobs, return_as="generator")(
            delayed(differences)(path, arguments.most, arguments.single) for path in arguments.meshes),
        total=len(arguments.meshes), unit="mesh", disable=None))
    known = {path: row for path, row in zip(arguments.meshes, found, strict=True) if row is not None}
    table = np.reshape(list(known.values()), (-1, len(CHANGES)))
    print(f"| {len(known)} models | above {MUCH:.0%} of the area | mean |\n| --- | --- | --- |")
    for name, column in zip(CHANGES, table.T, strict=True):
        print(f"| {name} | {(column > MUCH).sum()} | {column.mean():.4f} |")
    for path, row in known.items():
        if max(row) > MUCH:
            print(path.name, *(f"{name} {value:.3f}" for name, value in zip(CHANGES, row, strict=True) if value > MUCH))
    return 0


if __name__ == "__main__":
    sys.exit(main())
