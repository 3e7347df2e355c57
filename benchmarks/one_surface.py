# SPDX-License-Identifier: GPL-3.0-or-later
"""Labelled models of many pieces as one closed surface around them, as scans and generated models are.

    python3 benchmarks/one_surface.py MODELS OUT [--cells N] [--faces M]

MODELS holds PACK.NAME.npz with ``vertices``, ``faces`` and ``human`` (k, m), as game_models.py and others write them.
OUT gets the same of the surface that keeps 1.3 cells from the model, the longest side of which has N cells; what it
encloses is filled. It is smoothed, decimated to M faces, and each face has the labels of the nearest one of the model.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import packages

packages.need("numpy", "scipy", "skimage", "trimesh", "fast_simplification", "tqdm")

import fast_simplification
import numpy as np
import trimesh
from meshes import write_labelled
from scipy import ndimage
from scipy.spatial import cKDTree
from skimage.measure import marching_cubes
from tqdm import tqdm

AWAY = 1.3  # of the surface from the model, in cells
N_POINTS = 400_000  # at which distances to the model are taken
LEAST = 0.002  # share of the area from which on a piece of the surface is kept


def main() -> None:
    """Write all surfaces."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, metavar="MODELS")
    parser.add_argument("out", type=Path, metavar="OUT")
    parser.add_argument("--cells", type=int, default=160, metavar="N")
    parser.add_argument("--faces", type=int, default=20_000, metavar="M")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for path in tqdm(sorted(options.models.glob("*.npz")), unit="model", disable=None):
        with np.load(path) as stored:
            model, human = trimesh.Trimesh(stored["vertices"], stored["faces"], process=False), stored["human"]
        points, source = trimesh.sample.sample_surface(model, N_POINTS, seed=0)
        tree = cKDTree(points)
        surface = around(points, tree, options.cells, options.faces)
        nearest = source[tree.query(surface.triangles_center)[1]]
        write_labelled(options.out / path.name, surface.vertices, surface.faces, human=human[:, nearest])


def around(points: np.ndarray, tree: cKDTree, n_cells: int, n_faces: int) -> trimesh.Trimesh:
    """The closed surface around points, (k, 3), that tree holds, on a grid of ``n_cells`` along their longest side."""
    cell, pad = np.ptp(points, axis=0).max() / n_cells, 6
    origin = points.min(axis=0) - pad * cell
    filled = np.zeros(np.ceil(np.ptp(points, axis=0) / cell).astype(int) + 2 * pad, bool)
    filled[tuple(np.round((points - origin) / cell).astype(int).T)] = True
    distance = ndimage.distance_transform_edt(~filled)
    near = np.argwhere(distance < 5)
    distance[tuple(near.T)] = tree.query(near * cell + origin)[0] / cell
    free = ndimage.label(distance > AWAY)[0]
    outside = free == free[0, 0, 0]
    height = np.where(outside, distance - AWAY, -1.0)
    rim = ndimage.binary_dilation(outside, iterations=3) & (distance <= AWAY)
    height[rim] = distance[rim] - AWAY
    vertices, faces, _, _ = marching_cubes(height.astype(np.float32), 0.0)
    surface = trimesh.Trimesh(vertices * cell + origin, faces)
    trimesh.smoothing.filter_taubin(surface, iterations=6)
    if len(surface.faces) > n_faces:
        surface = trimesh.Trimesh(*fast_simplification.simplify(
            surface.vertices.astype(np.float32), surface.faces.astype(np.int32), target_count=n_faces))
    kept = [piece for piece in surface.split(only_watertight=False) if piece.area > LEAST * surface.area]
    return trimesh.util.concatenate(kept)


if __name__ == "__main__":
    main()
