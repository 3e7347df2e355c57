# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure ``reeb-parts batch``: how much two workers do more than one, and what a scheduler holds over many models.

    python3 benchmarks/batch.py [--models N] [--simulate N]

The package is built from the checkout and installed into a folder of its own. Models are small trees of tubes, each a
little different. The overhead of a run is the share of its workers' time, from the first model to the end, in which
none of them was at a model. Simulated models are jobs that do nothing: the time of each is what Dask takes for it.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import packages

ROOT = packages.ROOT
sys.path.insert(0, str(ROOT / "tools"))
sys.path.insert(0, str(ROOT / "tests"))
import environments

SIMULATED = """
import sys, time
import psutil
from reeb_parts.batch import cluster
total = int(sys.argv[1])
memory = psutil.Process().memory_info
with cluster.connected(None, 2, "127.0.0.1:0") as client:
    start = time.perf_counter()
    for number, _ in enumerate(cluster.spread(client, abs, range(total)), 1):
        if number % (total // 10) == 0:
            held = len(client.cluster.scheduler.tasks)
            print(f"{number:>8} {1000 * (time.perf_counter() - start) / (total // 10):6.2f} ms each "
                  f"{memory().rss / 2**20:7.1f} MiB, {held} jobs held", flush=True)
            start = time.perf_counter()
"""


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=int, default=2000, metavar="N", help="small models (default: %(default)s)")
    parser.add_argument("--simulate", type=int, default=0, metavar="N", help="jobs that do nothing")
    arguments = parser.parse_args()
    python = str(environments.prepare(environments.package()))
    with tempfile.TemporaryDirectory() as folder:
        variables = _installed(python, Path(folder))
        if arguments.models:
            compare(python, variables, arguments.models, Path(folder))
        if arguments.simulate:
            subprocess.run([python, "-c", SIMULATED, str(arguments.simulate)], env=variables, check=True)


def _installed(python: str, folder: Path) -> dict[str, str]:
    """Build and install the package; returns the variables of a process that has it."""
    pip = [python, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", folder, ROOT], check=True)
    subprocess.run([*pip, "install", "--no-deps", "--target", folder / "site", *folder.glob("*.whl")], check=True)
    return {**os.environ, "PYTHONPATH": str(folder / "site"), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def compare(python: str, variables: dict[str, str], count: int, folder: Path) -> None:
    """One worker and two, half of the models at a time and in turns, since others use the machine, too."""
    subprocess.run([python, "-c", MODELS, str(count), str(folder / "models"), str(ROOT / "tests")], check=True)
    lists = [folder / f"list_{half}.txt" for half in range(2)]
    paths = sorted(map(str, (folder / "models").iterdir()))
    for half, path in enumerate(lists):
        path.write_text("\n".join(paths[half::2]))
    walls = {1: 0.0, 2: 0.0}
    busy = {1: 0.0, 2: 0.0}
    for half, order in enumerate(((1, 2), (2, 1))):
        for workers in order:
            out = folder / f"out_{half}_{workers}"
            command = [python, str(folder / "site" / "bin" / "reeb-parts"), "batch", "--list", str(lists[half]),
                       "--out", str(out), "--workers", str(workers), "--dashboard", "127.0.0.1:0"]
            done = subprocess.run(command, env=variables, check=True, capture_output=True, text=True)
            records = list(out.rglob("record.json"))
            ended = [path.stat().st_mtime for path in records]
            seconds = [json.loads(path.read_text())["model"]["seconds"] for path in records]
            first = min(end - taken for end, taken in zip(ended, seconds, strict=True))
            walls[workers] += max(ended) - first
            busy[workers] += sum(seconds)
            print(f"{len(records)} models, {workers} workers: {json.loads(done.stdout)['seconds']:.1f} s in all, "
                  f"{max(ended) - first:.1f} s from the first model on, {sum(seconds):.1f} s at models", flush=True)
    for workers, wall in walls.items():
        print(f"{workers} workers: overhead {1 - busy[workers] / (workers * wall):.1%}")
    print(f"two workers do {walls[1] / walls[2]:.2f} times what one does")


MODELS = """
import sys
from pathlib import Path
import numpy as np
sys.path.insert(0, sys.argv[3])
import shapes
shape = shapes.tube_tree(step=0.25)
out = Path(sys.argv[2]); out.mkdir()
rng = np.random.default_rng(0)
for number in range(int(sys.argv[1])):
    np.savez(out / f"{number:05d}.npz", vertices=shape.vertices * rng.uniform(0.8, 1.2, 3), faces=shape.faces)
"""

if __name__ == "__main__":
    start = time.perf_counter()
    main()
    print(f"{time.perf_counter() - start:.0f} s")
