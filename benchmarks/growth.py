# SPDX-License-Identifier: GPL-3.0-or-later
"""How seconds and memory of each stage grow with the mesh, beside peers; writes docs/performance.md and its plots.

    python3 benchmarks/growth.py [--sizes N ...] [--repeat N] [--page FILE]

The bundled model is refined to each number of vertices and decomposed in a process of its own, the fastest of so many
runs, on one processor and then on two. Beside it, in the same run, on the same mesh: SciPy's Dijkstra search along the
edges from 140 vertices, the cost of the field if it were made without coarse copies; and, where the package vtk is
installed, VTK's Reeb graph of the same field, in C++. Seconds depend on the machine, ratios hardly.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import packages

packages.need("numpy", "scipy", "trimesh", "matplotlib")

import matplotlib.pyplot as plt
import numpy as np
from meshes import load_mesh, refined
from report_page import svg

from core import PRESETS, Parameters, decompose

SIZES = (3_000, 10_000, 36_000, 100_000, 250_000, 1_000_000, 4_000_000)
STAGES = ("mesh", "distances", "reeb graph", "cuts", "parts")
# Vertices from which on the largest exponent of growth is read.
LARGE = 30_000
SEVERAL = 100_000  # number of vertices up to which runs are repeated, and peers measured


def main() -> int:
    """Measure all sizes and write the page; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, metavar="N")
    parser.add_argument("--repeat", type=int, default=3, metavar="N", help="runs of meshes up to 100,000 vertices")
    parser.add_argument("--page", type=Path, default=packages.ROOT / "docs" / "performance.md", metavar="FILE")
    parser.add_argument("--peer", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.peer:
        print(json.dumps(peer_seconds(arguments.peer)))
        return 0
    rows = []
    for size in arguments.sizes:
        repeat = arguments.repeat if size <= SEVERAL else 1
        options = "--size", str(size), "--repeat", str(repeat)
        row = _run("timing.py", *options)
        row["on two"] = _run("timing.py", *options, processors=2)["seconds"]
        rows.append(row | (_run("growth.py", "--peer", str(size)) if size <= SEVERAL else {"vtk": None}))
        print(f"{size:,} vertices: {row['seconds']:.2f} s", flush=True)
    _write_plots(rows, arguments.page.parent / "images")
    _write_page(rows, arguments.page)
    return 0


def _run(program: str, *options: str, processors: int = 1) -> dict:
    """What one of the benchmarks prints, of a process of its own that keeps so many processors busy."""
    command = [sys.executable, str(Path(__file__).parent / program), *options]
    environment = {**os.environ, "OMP_NUM_THREADS": str(processors)}
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, env=environment).stdout)


def peer_seconds(size: int) -> dict:
    """Seconds of VTK's Reeb graph of the field at one size; None without vtk."""
    try:
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    except ImportError:
        return {"vtk": None}
    vertices, faces = refined(*load_mesh(packages.ROOT / "models" / "spot.obj"), size)
    field = decompose(vertices, faces, Parameters.preset(next(iter(PRESETS)))).field
    mesh, points, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(vertices, deep=True))
    cells.SetData(3, numpy_to_vtkIdTypeArray(faces.ravel().astype(np.int64), deep=True))
    scalars = numpy_to_vtk(field, deep=True)
    scalars.SetName("field")
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    mesh.GetPointData().SetScalars(scalars)
    graph = vtk.vtkPolyDataToReebGraphFilter()
    graph.SetInputData(mesh)
    start = time.perf_counter()
    graph.Update()
    return {"vtk": time.perf_counter() - start}


def _write_plots(rows: list[dict], folder: Path) -> None:
    """Seconds of each stage and of the peers, and memory, over the vertices."""
    vertices = [row["vertices"] for row in rows]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained", width_ratios=(3, 2))
    for stage in STAGES:
        left.plot(vertices, [row[f"s {stage}"] for row in rows], "o-", markersize=3, label=stage)
    left.plot(vertices, [row["seconds"] for row in rows], "k-", linewidth=2, label="all")
    left.plot(vertices, [row["yardstick"] for row in rows], "k:", label="SciPy's Dijkstra, 140 sources")
    if measured := [row for row in rows if row["vtk"]]:
        left.plot([row["vertices"] for row in measured], [row["vtk"] for row in measured], "k--",
                  label="VTK's Reeb graph")
    left.set(xlabel="vertices", ylabel="seconds", xscale="log", yscale="log")
    left.legend(frameon=False, fontsize="small", ncols=2)
    right.plot(vertices, [1e3 * row["peak GB"] for row in rows], "ko-", markersize=3)
    right.set(xlabel="vertices", ylabel="peak memory, MB", xscale="log", yscale="log")
    folder.mkdir(exist_ok=True)
    (folder / "performance.svg").write_text(svg(figure), encoding="utf-8")


def _write_page(rows: list[dict], page: Path) -> None:
    """The table between the two marks of the page; what is written by hand around it stays."""
    begin, end = "<!-- table -->\n", "<!-- end of table -->\n"
    head = ("vertices", "all, s", "on two processors, s", *(f"{stage}, s" for stage in STAGES), "peak, MB",
            "of Dijkstra", "VTK's Reeb graph, s", "of it, ours")
    lines = [f"| {' | '.join(head)} |", "| --- " * len(head) + "|"]
    for row in rows:
        ours = f"{row['s reeb graph'] / row['vtk']:.2f}" if row["vtk"] else ""
        cells = [f"{row['vertices']:,}", f"{row['seconds']:.2f}", f"{row['on two']:.2f}",
                 *(f"{row[f's {stage}']:.2f}" for stage in STAGES),
                 f"{1e3 * row['peak GB']:.0f}", f"{row['of yardstick']:.2f}",
                 f"{row['vtk']:.2f}" if row["vtk"] else "", ours]
        lines.append(f"| {' | '.join(cells)} |")
    large = [row for row in rows if row["vertices"] >= LARGE]
    if len(large) > 1:
        x, y = (np.log([row[name] for row in large]) for name in ("vertices", "seconds"))
        over, last = np.polyfit(x, y, 1)[0], (y[-1] - y[-2]) / (x[-1] - x[-2])
        first, second, third = (f"{large[at]['vertices']:,}" for at in (0, -2, -1))
        lines += ["", f"From {first} vertices on, seconds grow as the vertices to the power of {over:.2f}; "
                  f"from {second} to {third}, to that of {last:.2f}."]
    before, _, rest = page.read_text(encoding="utf-8").partition(begin)
    after = rest.partition(end)[2]
    page.write_text(before + begin + "\n" + "\n".join(lines) + "\n\n" + end + after, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
