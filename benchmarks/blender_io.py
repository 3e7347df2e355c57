# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender's side of a run costs: reading a large mesh and writing all default outputs, besides the core.

    blender --background --python-exit-code 1 --python benchmarks/blender_io.py -- [--check] [--size N ...]
    python3 benchmarks/blender_io.py [--check] [--size N ...]            with Blender as a module

The bundled model is refined to each size and decomposed by the operator, as scripts call it: everything is done in
one process. Seconds are the processor's, of all threads; those within the core are taken off, and the rest is divided
by what a profile says of the functions that do the work. "again" is a second run of the same mesh, whose
decomposition is still known: it reads, takes over numbers and writes in place of what is there. "window" is what comes
on top where a process of its own computes: arrays and result go through files, both ways, and the mesh is read once
more to see that it is the same. --check fails when 1,000,000 vertices take more than 3 s beyond the core without that.
"""

from __future__ import annotations

import argparse
import cProfile
import importlib
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "benchmarks")]

import packages

packages.need("bpy")

import bpy
import checkout
from detail import make, spot
from meshes import refined

LIMITS = {1_000_000: 3.0}  # vertices: s
CORE = "core.pipeline.decompose"
# Functions that do the work, none of which calls another of them.
WORK = {
    "reading": ("scene.bridge.reading_shape",),
    "storing": ("scene.runs.succession.succeed", "scene.store.save"),
    "groups": ("scene.outputs.vertex_groups.write", "scene.outputs.vertex_groups.remove"),
    "colors": ("scene.outputs.colors.write", "scene.outputs.colors.add", "scene.outputs.colors.remove"),
    "attribute": ("scene.outputs.face_attribute.write", "scene.outputs.face_attribute.add"),
    "list": ("scene.outputs.write._list_parts",),
    "graph": ("scene.graph.graph_objects.draw_graph", "scene.graph.graph_removal.remove",
              "scene.graph.graph_objects.set_hidden"),
}


def main() -> int:
    """Time all sizes; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, nargs="+", default=list(LIMITS), metavar="N", help="vertices")
    parser.add_argument("--check", action="store_true", help="fail when the limit is missed")
    arguments = parser.parse_args(checkout.arguments())
    met = True
    with tempfile.TemporaryDirectory() as folder:
        package = checkout.enable(Path(folder))
        decomposed(make(*spot()))  # once before, so that modules are loaded
        columns = ("vertices", "run", "parts", "all, s", "core, s", "beyond it, s", *(f"{name}, s" for name in WORK))
        print(f"| {' | '.join(columns)} | rest, s |\n" + "| --- " * (len(columns) + 1) + "|")
        for size in arguments.size:
            obj = make(*refined(*spot(), size))
            for run in ("first", "again"):
                met &= not measure(package, obj, run) > LIMITS.get(size, float("inf"))
            more = in_the_window(package, obj)
            print(f"| {size:,} | window | | | | {more:.2f} |" + " |" * (len(WORK) + 1), flush=True)
    return 1 if arguments.check and not met else 0


def decomposed(obj) -> tuple[float, cProfile.Profile]:
    """Run the operator on the active object; seconds, and the profile."""
    profile = cProfile.Profile(time.process_time)
    start = time.process_time()
    profile.enable()
    bpy.ops.reeb_parts.decompose()
    bpy.context.view_layer.update()
    profile.disable()
    return time.process_time() - start, profile


def measure(package: str, obj, run: str) -> float:
    """Decompose and print the row; seconds beyond the core."""
    seconds, profile = decomposed(obj)
    profile.create_stats()
    core = within(profile, package, CORE)
    shares = {name: within(profile, package, *functions) for name, functions in WORK.items()}
    rest = seconds - core - sum(shares.values())
    cells = [f"{len(obj.data.vertices):,}", run, len(obj.data.reeb_parts.parts), *(
        f"{value:.2f}" for value in (seconds, core, seconds - core, *shares.values(), rest))]
    print(f"| {' | '.join(map(str, cells))} |", flush=True)
    return seconds - core


def in_the_window(package: str, obj) -> float:
    """Seconds of what the window does more than a script: files between two processes, and one more reading."""
    bridge, store, handover = (importlib.import_module(f"{package}.{name}")
                               for name in ("scene.bridge", "scene.store", "core.handover"))
    result, shape = store.last(obj.data).decomposition, bridge.read_shape(obj)
    with tempfile.TemporaryDirectory() as name:
        folder, start = Path(name), time.process_time()
        handover.write_request(folder, [shape.arrays], result.parameters)
        handover.read_shape(folder, 0)
        handover.write_result(folder, 0, result)
        handover.read_result(folder, 0)
        bridge.read_shape(obj)
        return time.process_time() - start


def within(profile: cProfile.Profile, package: str, *functions: str) -> float:
    """Seconds within some functions of the package, with all that they call."""
    codes = []
    for path in functions:
        module, name = path.rsplit(".", 1)
        codes.append(getattr(importlib.import_module(f"{package}.{module}"), name).__code__)
    keys = [(code.co_filename, code.co_firstlineno, code.co_name) for code in codes]
    return sum(profile.stats[key][3] for key in keys if key in profile.stats)


if __name__ == "__main__":
    checkout.leave(main())
