# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare methods over a folder of meshes that people have cut: a table and one page to look at.

    python3 benchmarks/report.py DATA [--methods NAME ...] [--meshes N ...] [--jobs N] [--out DIR]

DATA holds N.npz with ``vertices`` (n, 3), ``faces`` (m, 3) and ``human`` (people, m): one label per face and person.
A method is the name of a preset (default: all), or NAME=FOLDER for the labels of another program, FOLDER/N.npy with
one number per face. Each mesh is decomposed with every method; the same hierarchy is read twice, at the preset's own
level of detail and told people's median number of parts.

Written into DIR (default: report): report.csv with a row per mesh and method, report.html with tables, plots and a
row of pictures per mesh that can be sorted, and a folder per method with what was found, so that an interrupted run
goes on where it stopped. A mesh that fails is reported at the end, and the exit status is 1 then.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import sys
import time
from dataclasses import asdict
from pathlib import Path

# One thread per process: the meshes are what is done in parallel. Set before NumPy is loaded.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import packages

packages.need("numpy", "scipy", "tqdm", "joblib", "matplotlib")

import numpy as np
from joblib import Parallel, delayed
from people import category_of, mesh_numbers
from report_page import page
from scores import MEASURES, labels_path, median_parts, score
from tqdm import tqdm

from core import PRESETS, Parameters, TriMesh, decompose
from core.version import VERSION


def main() -> int:
    """Run what is missing and write table and page; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=Path, metavar="DATA")
    parser.add_argument("--methods", nargs="+", default=list(PRESETS), metavar="NAME")
    parser.add_argument("--meshes", nargs="+", type=int, metavar="N", help="only these")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="meshes at a time")
    parser.add_argument("--out", type=Path, default=Path("report"), metavar="DIR")
    arguments = parser.parse_args()
    for name in arguments.methods:
        if name not in PRESETS and "=" not in name:
            parser.error(f"no preset {name!r}: choose of {', '.join(PRESETS)}, or give NAME=FOLDER")
    numbers = arguments.meshes or mesh_numbers(arguments.data)
    if not numbers:
        parser.error(f"no N.npz in {arguments.data}")
    arguments.out.mkdir(parents=True, exist_ok=True)
    rows, failures = run(arguments.data, arguments.methods, numbers, arguments.jobs, arguments.out)
    if rows:
        write_table(arguments.out / "report.csv", rows)
        (arguments.out / "report.html").write_text(page(arguments.data, arguments.out, rows), encoding="utf-8")
    for number, method, error in failures:
        print(f"report: {number}, {method}: {error}", file=sys.stderr)
    print(f"report: {len(rows)} rows in {arguments.out / 'report.html'}, {len(failures)} failed", file=sys.stderr)
    return 1 if failures else 0


def run(data: Path, methods: list[str], numbers: list[int], jobs: int, out: Path) -> tuple[list[dict], list[tuple]]:
    """Rows of all meshes and methods, by mesh, and what failed; rows that are there already are read."""
    tasks = [(number, method) for number in numbers for method in methods]
    work = (delayed(_attempt)(data, number, method, out) for number, method in tasks)
    done = Parallel(n_jobs=jobs, return_as="generator_unordered")(work)
    rows, failures = {}, []
    for number, method, row, error in tqdm(done, total=len(tasks), unit="run", disable=None):
        if error is None:
            rows[number, method] = row
        else:
            failures.append((number, method, error))
    return [rows[task] for task in tasks if task in rows], sorted(failures)


def _attempt(data: Path, number: int, method: str, out: Path) -> tuple[int, str, dict | None, str | None]:
    """One row, or what went wrong: the other meshes are worth having."""
    try:
        return number, method, one_row(data, number, method, out), None
    except Exception as error:  # noqa: BLE001
        return number, method, None, f"{type(error).__name__}: {error}"


def one_row(data: Path, number: int, method: str, out: Path) -> dict:
    """Scores of one method on one mesh; read if they are there, else found and written with the labels."""
    path = labels_path(out, method, number).with_suffix(".json")
    made_with = {"version": VERSION, "method": method}
    if method in PRESETS:
        made_with["parameters"] = asdict(Parameters.preset(method))
    if path.is_file():
        stored = json.loads(path.read_text(encoding="utf-8"))
        if stored["made_with"] == made_with:
            return stored["row"]
    with np.load(data / f"{number}.npz") as stored:
        mesh, people = TriMesh(stored["vertices"], stored["faces"]), stored["human"].astype(np.int64)
    told = median_parts(people)
    start = time.process_time()
    if method in PRESETS:
        result = decompose(mesh.vertices, mesh.faces, Parameters.preset(method))
        seconds = time.process_time() - start
        labels, by_number = result.parts().labels, result.parts(n_parts=told).labels
        loops, candidates = result.graph.n_loops, result.n_candidates
    else:
        labels = by_number = np.load(Path(method.partition("=")[2]) / f"{number}.npy").astype(np.int64)
        seconds = loops = candidates = None
    row = {
        "mesh": number, "category": category_of(number), "method": method.partition("=")[0],
        "vertices": mesh.n_vertices, "people": told, "parts": len(np.unique(labels)), "candidates": candidates,
        "loops": loops, "seconds": seconds, **score(mesh, labels, people),
        **{f"told_{name}": value for name, value in score(mesh, by_number, people).items()},
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    np.save(path.with_suffix(".npy"), np.unique(labels, return_inverse=True)[1].reshape(-1).astype(np.int32))
    # The row is written last: where it is, the labels are.
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps({"made_with": made_with, "row": row}), encoding="utf-8")
    partial.replace(path)
    return row


def write_table(path: Path, rows: list[dict]) -> None:
    """Write all rows as CSV."""
    columns = [*(name for name in rows[0] if name not in MEASURES and not name.startswith("told_")), *MEASURES,
               *(f"told_{name}" for name in MEASURES)]
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    sys.exit(main())
