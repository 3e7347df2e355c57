# SPDX-License-Identifier: GPL-3.0-or-later
"""The Princeton Segmentation Benchmark as meshes with what people drew on them.

    python3 benchmarks/princeton.py FOLDER OUT

FOLDER is MeshsegBenchmark-1.0 of X. Chen, A. Golovinskiy and T. Funkhouser, "A benchmark for 3D mesh segmentation"
(SIGGRAPH 2009), from http://segeval.cs.princeton.edu: ``data/off/N.off`` are the meshes,
``data/seg/Benchmark/N/N_P.seg`` what person P drew, a line with the number of the part for each face. Each mesh becomes
N.npz with ``vertices`` (n, 3), ``faces`` (m, 3) and ``human`` (people, m). OUT/half gets those that the models were
learned from and that docs/quality.md speaks of, OUT/rest the others: nothing was learned from them or chosen by them.
"""

from __future__ import annotations

from pathlib import Path

import packages

packages.need("numpy", "trimesh", "tqdm")

import numpy as np
from meshes import load_mesh, some, source_and_target, write_labelled
from tqdm import tqdm

#: Ten meshes of each of 15 categories.
HALF = frozenset({
    4, 5, 7, 8, 10, 11, 13, 14, 15, 18, 21, 25, 27, 29, 30, 31, 32, 33, 35, 39, 41, 42, 43, 44, 48, 51, 54, 56, 57,
    58, 61, 63, 65, 67, 68, 69, 71, 77, 78, 80, 82, 83, 84, 87, 88, 90, 91, 94, 95, 100, 121, 122, 126, 129, 131, 133,
    134, 135, 139, 140, 143, 144, 146, 147, 149, 152, 153, 154, 155, 157, 181, 182, 183, 184, 185, 190, 192, 196, 197,
    198, 201, 202, 203, 205, 206, 207, 210, 212, 213, 220, 221, 222, 223, 225, 232, 234, 235, 236, 237, 238, 281, 282,
    284, 287, 290, 294, 295, 296, 299, 300, 301, 305, 307, 313, 315, 316, 317, 318, 319, 320, 322, 323, 327, 328, 329,
    332, 334, 335, 337, 340, 361, 362, 363, 364, 365, 369, 371, 375, 379, 380, 384, 385, 386, 387, 390, 392, 393, 394,
    396, 400})


def people(folder: Path, n_faces: int) -> np.ndarray:
    """What each person drew, (people, n_faces) int64, by the numbers of the files in a folder of N_P.seg."""
    paths = sorted(folder.glob("*_*.seg"), key=lambda path: int(path.stem.split("_")[1]))
    labels = [np.loadtxt(path, np.int64, ndmin=1) for path in some(paths, folder)]
    for path, label in zip(paths, labels, strict=True):
        if len(label) != n_faces:
            raise SystemExit(f"{path} has {len(label)} lines, but its mesh {n_faces} faces")
    return np.stack(labels)


def main() -> None:
    source, out = source_and_target(__doc__)
    for path in tqdm(some(sorted((source / "data" / "off").glob("*.off")), source)):
        vertices, faces = load_mesh(path)
        human = people(source / "data" / "seg" / "Benchmark" / path.stem, len(faces))
        goal = out / ("half" if int(path.stem) in HALF else "rest")
        goal.mkdir(exist_ok=True)
        write_labelled(goal / f"{path.stem}.npz", vertices, faces, human=human)


if __name__ == "__main__":
    main()
