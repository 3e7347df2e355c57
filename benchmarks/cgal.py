# SPDX-License-Identifier: GPL-3.0-or-later
"""CGAL's shape-diameter segmentation and ours, mesh by mesh in turns: seconds, error and number of parts of each.

    python3 benchmarks/cgal.py MESHES [--meshes N ...]

MESHES holds N.npz with ``vertices`` (n, 3), ``faces`` (m, 3) and ``human`` (people, m): one label per face and person.
Needed are a C++ compiler and CGAL's headers, from 5.0 on. CGAL runs as its documentation has it by default: 25 rays in
a cone of 2/3 pi, post-processing on, 5 clusters, smoothing 0.26; on the faster of its two usual kernels; compiled once
as packages are and once for the processor that is there. Ours is the default preset in a process that keeps freed
memory, as the extension's own does. Both use one thread, and do the first mesh once before anything is measured.
Seconds are the processor's, of the two calls of CGAL and of the one of ours; reading is not in them.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# One thread, as CGAL has. Set before NumPy is loaded.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import packages

packages.need("numpy", "scipy", "tqdm")

import numpy as np
from people import mesh_numbers
from scores import mean, median_parts
from tqdm import tqdm

from core import decompose
from core.memory import keep_freed_memory
from core.metrics import rand_index_error

SOURCE = Path(__file__).with_name("cgal_sdf.cpp")
NEEDED = ("a C++ compiler and CGAL's headers are needed; on Debian and Ubuntu: "
          "apt-get install --no-install-recommends g++ libcgal-dev")
# Builds by name, with what is added to the compiler's options.
BUILDS = {"CGAL": (), "CGAL, compiled for this processor": ("-march=native",)}
OURS = "Reeb Parts"


def main() -> int:
    """Run both over all meshes and print the tables; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="MESHES")
    parser.add_argument("--meshes", nargs="+", type=int, metavar="N", help="only these")
    arguments = parser.parse_args()
    there = mesh_numbers(arguments.folder)
    numbers = [number for number in arguments.meshes or there if number in there]
    if not numbers:
        parser.error(f"no such N.npz in {arguments.folder}")
    keep_freed_memory()
    with tempfile.TemporaryDirectory() as folder:
        try:
            programs = {name: Program(build(Path(folder), *options)) for name, options in BUILDS.items()}
        except RuntimeError as error:
            print(f"cgal: {error}", file=sys.stderr)
            return 1
        methods = {OURS: ours, **{name: program.segment for name, program in programs.items()}}
        rows = []
        for turn, number in enumerate(tqdm([numbers[0], *numbers], unit="mesh", disable=None)):
            rows.append(measure(arguments.folder / f"{number}.npz", methods, first=turn % len(methods)))
        for program in programs.values():
            program.close()
    return report(rows[1:])


def build(folder: Path, *options: str) -> Path:
    """Compile the program; RuntimeError with what to install if that fails."""
    compiler = os.environ.get("CXX", "g++")
    if shutil.which(compiler) is None:
        raise RuntimeError(NEEDED)
    program = folder / f"cgal_sdf{len(list(folder.iterdir()))}"
    command = [compiler, "-std=c++17", "-O3", "-DNDEBUG", *options, str(SOURCE), "-o", str(program), "-lgmp", "-lmpfr"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{NEEDED}\n{done.stderr}".strip())
    return program


class Program:
    """CGAL in a process of its own, which does one mesh after the other."""

    def __init__(self, path: Path):
        self._process = subprocess.Popen([path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def segment(self, vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, tuple[float, ...]] | None:
        """Segment of each face, and seconds of the shape diameters and of the segmentation; None if refused."""
        to, answer = self._process.stdin, self._process.stdout
        to.write(f"{len(vertices)} {len(faces)}\n")
        for array in (vertices, faces):
            to.writelines(" ".join(map(repr, row)) + "\n" for row in array.tolist())
        to.flush()
        first = answer.readline()
        if not first:
            raise RuntimeError(f"{self._process.args[0]} ended with {self._process.wait()}")
        if first == "refused\n":
            return None
        return np.array(answer.readline().split(), np.int64), tuple(map(float, first.split()))

    def close(self) -> None:
        """End the process."""
        self._process.stdin.close()
        self._process.wait()


def ours(vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, tuple[float, ...]]:
    """Part of each face, and seconds."""
    start = time.process_time()
    labels = decompose(vertices, faces).parts().labels
    return labels, (time.process_time() - start,)


def measure(path: Path, methods: dict, first: int) -> dict:
    """Seconds, error and number of parts of all methods on one mesh, beginning with another one each time."""
    with np.load(path) as stored:
        vertices, faces = stored["vertices"].astype(np.float64), stored["faces"].astype(np.int64)
        people = stored["human"].astype(np.int64)
    row = {"mesh": path.stem, "people": median_parts(people)}
    names = list(methods)
    for name in names[first:] + names[:first]:
        if (found := methods[name](vertices, faces)) is None:
            row[name] = None
            continue
        labels, seconds = found
        error = mean(rand_index_error(labels, person) for person in people)
        row[name] = {"seconds": seconds, "error": error, "parts": len(np.unique(labels))}
    return row


def report(rows: list[dict]) -> int:
    """Print the table and what CGAL refused; returns the exit status."""
    refused = [row["mesh"] for row in rows if None in row.values()]
    rows = [row for row in rows if row["mesh"] not in refused]
    if refused:
        print(f"CGAL takes these for no surfaces: {', '.join(refused)}", file=sys.stderr)
    if not rows:
        return 1
    taken = {name: np.array([sum(row[name]["seconds"]) for row in rows]) for name in (OURS, *BUILDS)}
    print(f"{len(rows)} meshes; people's median number of parts: {mean(row['people'] for row in rows):.1f}\n")
    print("| | seconds, mean | median | ours / it: sums | median | Rand index error | parts |\n" + "| --- " * 7 + "|")
    for name, seconds in taken.items():
        ratios = ("", "") if name == OURS else (
            f"{taken[OURS].sum() / seconds.sum():.2f}", f"{np.median(taken[OURS] / seconds):.2f}")
        cells = [name, f"{seconds.mean():.2f}", f"{np.median(seconds):.2f}", *ratios,
                 f"{mean(row[name]['error'] for row in rows):.3f}", f"{mean(row[name]['parts'] for row in rows):.1f}"]
        print(f"| {' | '.join(cells)} |")
    diameters = np.array([row[next(iter(BUILDS))]["seconds"] for row in rows]).sum(axis=0)
    print(f"\nOf CGAL's seconds, {diameters[0] / diameters.sum():.0%} are for the shape diameters.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
