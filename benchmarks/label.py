# SPDX-License-Identifier: GPL-3.0-or-later
"""Label the faces of many meshes, to score the parts or to use them.

    python3 benchmarks/label.py MESHES [MESHES ...] OUT [--preset NAME] [--detail D] [--jobs N]

MESHES are folders or single files: .npz with the arrays `vertices` (n, 3) and `faces` (m, 3), .obj, .ply
or .stl. For each N.npz, N.npy is written into the folder OUT: one part number per face, int32, in the
order of the faces. OUT/times.csv has a row per mesh: vertices, faces, parts and seconds per stage. A mesh
that fails is reported at the end, and the exit status is 1 then; the others are done all the same.
"""

from __future__ import annotations

import argparse
import csv
import os
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from pathlib import Path

# One thread per process: the meshes are what is done in parallel. Set before NumPy is loaded.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import packages

packages.need("numpy", "scipy", "tqdm", "trimesh")

import numpy as np
from meshes import load_mesh
from tqdm import tqdm

from core import PRESETS, Parameters, decompose

SUFFIXES = (".npz", ".obj", ".ply", ".stl")


def main() -> int:
    """Label all meshes; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path, metavar="MESHES")
    parser.add_argument("out", type=Path, metavar="OUT")
    parser.add_argument("--preset", choices=list(PRESETS), default=next(iter(PRESETS)), metavar="NAME",
                        help=f"one of: {', '.join(PRESETS)}; default: %(default)s")
    parser.add_argument("--detail", type=float, metavar="D", help="0..1, instead of the preset's")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="meshes at a time, default 1")
    arguments = parser.parse_args()
    changes = {} if arguments.detail is None else {"detail": arguments.detail}
    parameters = Parameters.preset(arguments.preset, **changes)

    paths = find_meshes(arguments.meshes)
    if not paths:
        parser.error(f"no {', '.join(SUFFIXES)} in {', '.join(map(str, arguments.meshes))}")
    names = [path.stem for path in paths]
    if twice := {name for name in names if names.count(name) > 1}:
        parser.error(f"several meshes would be written to the same file: {', '.join(sorted(twice))}")
    arguments.out.mkdir(parents=True, exist_ok=True)

    rows, failures = [], []
    with ProcessPoolExecutor(arguments.jobs) as pool:
        futures = {pool.submit(label_mesh, path, arguments.out, parameters): path for path in paths}
        for future in tqdm(as_completed(futures), total=len(futures), unit="mesh", disable=None):
            # Whatever went wrong with one mesh, the others are worth having.
            if future.exception() is None:
                rows.append(future.result())
            else:
                failures.append((futures[future], future.exception()))
    write_times(arguments.out / "times.csv", sorted(rows, key=lambda row: _natural(row["mesh"])))
    for path, error in sorted(failures, key=lambda failure: failure[0]):
        print(f"label: {path}: {type(error).__name__}: {error}", file=sys.stderr)
    print(f"label: {len(rows)} meshes labelled, {len(failures)} failed", file=sys.stderr)
    return 1 if failures else 0


def find_meshes(sources: list[Path]) -> list[Path]:
    """Mesh files among files and in folders, numbered ones in the order of their numbers."""
    paths = []
    for source in sources:
        found = source.iterdir() if source.is_dir() else [source]
        paths += [path for path in found if path.suffix.lower() in SUFFIXES]
        if not source.exists():
            sys.exit(f"label: {source} does not exist")
    return sorted(paths, key=lambda path: _natural(path.stem))


def _natural(name: str) -> tuple[int, int, str]:
    """Sorting key: numbers by value, then names."""
    return (0, int(name), "") if name.isdigit() else (1, 0, name)


def label_mesh(path: Path, out: Path, parameters: Parameters) -> dict:
    """Label one mesh, write its labels and return its row of the table."""
    vertices, faces = load_mesh(path)
    result = decompose(vertices, faces, parameters)
    labels = result.parts().labels.astype(np.int32)
    with _replacing(out / f"{path.stem}.npy", "wb") as file:
        np.save(file, labels)
    seconds = {f"{stage} seconds": round(value, 4) for stage, value in result.seconds.items()}
    return {
        "mesh": path.stem, "vertices": len(vertices), "faces": len(faces), "parts": int(labels.max()) + 1,
        "total seconds": round(sum(result.seconds.values()), 4), **seconds,
    }


def write_times(path: Path, rows: list[dict]) -> None:
    """Write the table; a stage that a mesh did not need is left empty."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with _replacing(path, "w") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(rows)


@contextmanager
def _replacing(path: Path, mode: str):
    """A file that takes the place of ``path`` once it is complete, so that no half a file is ever seen."""
    partial = path.with_name(f".{path.name}.partial")
    try:
        with partial.open(mode, newline=None if "b" in mode else "") as file:
            yield file
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


if __name__ == "__main__":
    sys.exit(main())
