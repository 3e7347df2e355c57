# SPDX-License-Identifier: GPL-3.0-or-later
"""Time the stages on one model at growing sizes, and compare with the table of the paper.

    python3 benchmarks/timing.py [--out FILE.csv] [--repeat N] [--check]

The bundled model is refined to exactly 10,000, 36,000, 40,000 and 160,000 vertices. Every size runs in a
process of its own, so that the peak memory is that of one decomposition, NumPy and SciPy included, and which keeps
freed memory as the extension's own process does. Seconds
depend on the machine, so each comes with a yardstick measured in the same process: SciPy's Dijkstra search
over all the edges from 140 vertices. The number of parts is there because a fast wrong answer is worth
nothing. --check fails when 36,000 vertices take 2.5 s (the paper's Table 1: 142 s) or 1 GB.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import platform
import subprocess
import sys
import time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import packages

packages.need("numpy", "scipy", "trimesh")

import numpy as np
import scipy
from meshes import load_mesh, refined
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from core import PRESETS, Parameters, decompose
from core.memory import keep_freed_memory

ROOT = packages.ROOT
SIZES = (10_000, 36_000, 40_000, 160_000)
TARGET_VERTICES, TARGET_SECONDS, TARGET_GIGABYTES = 36_000, 2.5, 1.0
N_SOURCES = 140
MANY_VERTICES = 500_000  # from which on a tenth of the searches is measured, as each takes seconds


def main() -> int:
    """Time all sizes; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, metavar="FILE", help="also write the table as CSV")
    parser.add_argument("--preset", choices=list(PRESETS), default=next(iter(PRESETS)))
    parser.add_argument("--repeat", type=int, default=3, metavar="N", help="the fastest of N runs counts")
    parser.add_argument("--check", action="store_true", help="fail when the target is missed")
    parser.add_argument("--size", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.size:
        print(json.dumps(measure(arguments.size, arguments.preset, arguments.repeat)))
        return 0

    rows = []
    for size in SIZES:
        command = [sys.executable, __file__, "--size", str(size), "--repeat", str(arguments.repeat),
                   "--preset", arguments.preset]
        rows.append(json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout))
        _print_row(rows[-1], header=len(rows) == 1)
    if arguments.out:
        _write(arguments.out, rows)
    target = next(row for row in rows if row["vertices"] == TARGET_VERTICES)
    met = target["seconds"] < TARGET_SECONDS and target["peak GB"] < TARGET_GIGABYTES
    print(f"{TARGET_VERTICES:,} vertices: {target['seconds']:.2f} s and {target['peak GB']:.2f} GB, "
          f"target {TARGET_SECONDS} s and {TARGET_GIGABYTES} GB: {'met' if met else 'missed'}")
    return 1 if arguments.check and not met else 0


def measure(size: int, preset: str, repeat: int) -> dict:
    """Decompose the model at one size; seconds of the fastest run."""
    keep_freed_memory()
    vertices, faces = refined(*load_mesh(ROOT / "models" / "spot.obj"), size)
    runs = [decompose(vertices, faces, Parameters.preset(preset)) for _ in range(repeat)]
    peak = _peak_gigabytes()  # before the yardstick takes memory of its own
    fastest = min(runs, key=lambda run: sum(run.seconds.values()))
    yardstick = dijkstra_seconds(vertices, faces)
    total = sum(fastest.seconds.values())
    return {
        "vertices": len(vertices), "faces": len(faces), "parts": fastest.parts().count, "seconds": total,
        **{f"s {stage}": seconds for stage, seconds in fastest.seconds.items()},
        "us per face": 1e6 * total / len(faces), "yardstick": yardstick, "of yardstick": total / yardstick,
        "peak GB": peak,
    }


def dijkstra_seconds(vertices: np.ndarray, faces: np.ndarray) -> float:
    """Seconds for shortest paths along edges from N_SOURCES vertices to all; of MANY_VERTICES, ten times a tenth."""
    tenths = 10 if len(vertices) < MANY_VERTICES else 1
    pairs = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    length = np.linalg.norm(vertices[pairs[:, 0]] - vertices[pairs[:, 1]], axis=1)
    graph = coo_matrix((length, pairs.T), shape=(len(vertices), len(vertices))).tocsr()
    start = time.perf_counter()
    for source in np.linspace(0, len(vertices) - 1, N_SOURCES * tenths // 10).astype(int):
        dijkstra(graph, indices=source)
    return (time.perf_counter() - start) * 10 / tenths


def _peak_gigabytes() -> float:
    """Most memory that this process has had; not known on Windows."""
    if platform.system() == "Windows":
        return float("nan")
    import resource

    unit = 1 if platform.system() == "Darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit / 1e9


def _print_row(row: dict, header: bool) -> None:
    """One line of the table on the terminal."""
    if header:
        print(" ".join(f"{column:>{max(9, len(column))}}" for column in row))
    cells = (f"{value:,}" if isinstance(value, int) else f"{value:.3f}" for value in row.values())
    print(" ".join(f"{cell:>{max(9, len(column))}}" for cell, column in zip(cells, row, strict=True)), flush=True)


def _write(path: Path, rows: list[dict]) -> None:
    """Write the table with the commit and the machine it was measured on."""
    git = ["git", "-C", str(ROOT), "describe", "--always", "--dirty"]
    commit = subprocess.run(git, capture_output=True, text=True, check=False).stdout.strip()
    where = {
        "commit": commit, "machine": platform.machine(), "cores": os.cpu_count(),
        "python": platform.python_version(), "numpy": np.__version__, "scipy": scipy.__version__,
    }
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, [*rows[0], *where])
        table.writeheader()
        table.writerows(row | where for row in rows)


if __name__ == "__main__":
    sys.exit(main())
