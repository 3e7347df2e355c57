# SPDX-License-Identifier: GPL-3.0-or-later
"""Time a drag of Detail, from the slider's value to attributes, list and graph, at growing sizes.

    blender --background --python-exit-code 1 --python benchmarks/detail.py -- [--check] [--size N ...]
    python3 benchmarks/detail.py [--check] [--size N ...]            with Blender as a module

The bundled model is refined to each size and decomposed with all that is written by default; then Detail is
set to 30 values from 0 to 1 and back, and the number of parts to 30 from 1. Milliseconds are from setting the property
to its return. Drawing and Blender's own evaluation of the changed mesh are not in them; "evaluated" is the
median with that. They depend on the machine, so each size comes with a yardstick: writing the colors of all
corners, which is the least that a change of all parts has to do. --check fails when 50,000 vertices take more
than 60 ms or 1,000,000 more than 500 ms, in the worst case.
"""

from __future__ import annotations

import argparse
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
import numpy as np
from meshes import refined
from snapshot import activate

LIMITS = {50_000: 60.0, 1_000_000: 500.0}  # vertices: ms
N_VALUES = 30


def main() -> int:
    """Time all sizes; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, nargs="+", default=list(LIMITS), metavar="N", help="vertices")
    parser.add_argument("--check", action="store_true", help="fail when a limit is missed")
    arguments = parser.parse_args(checkout.arguments())
    met = True
    with tempfile.TemporaryDirectory() as folder:
        checkout.enable(Path(folder))
        print("| vertices | what | parts | median ms | worst ms | evaluated ms | yardstick ms | limit ms |\n"
              + "| --- " * 8 + "|")
        for size in arguments.size:
            limit = LIMITS.get(size, float("nan"))
            met &= not max(measure(size, limit)) > limit
    return 1 if arguments.check and not met else 0


def measure(size: int, limit: float):
    """Print the rows of one size; the worst time of each."""
    bpy.ops.wm.read_homefile(use_empty=True)
    obj = make(*refined(*spot(), size))
    bpy.ops.reeb_parts.decompose()
    result = obj.data.reeb_parts
    result.detail = 1.0
    most = len(result.parts)
    yardstick = write_colors(obj.data)
    rising = np.linspace(0, 1, N_VALUES).tolist()
    for what, name, values in (("Detail, rising", "detail", rising), ("Detail, falling", "detail", rising[::-1]),
                               ("number of parts", "n_parts", list(range(1, min(N_VALUES, most) + 1)))):
        setattr(result, name, values[0])
        bpy.context.view_layer.update()
        returned, evaluated = np.array([drag(result, name, value) for value in values]).T
        print(f"| {size:,} | {what} | 1 to {most if name == 'detail' else values[-1]} | {np.median(returned):.0f} | "
              f"{returned.max():.0f} | {np.median(evaluated):.0f} | {yardstick:.0f} | {limit:.0f} |", flush=True)
        yield returned.max()


def drag(result, name, value) -> tuple[float, float]:
    """Milliseconds until the property is set, and until Blender has evaluated what changed."""
    start = time.perf_counter()
    setattr(result, name, value)
    returned = time.perf_counter()
    bpy.context.view_layer.update()
    return 1e3 * (returned - start), 1e3 * (time.perf_counter() - start)


def write_colors(mesh) -> float:
    """Milliseconds to write the color of every corner, the fastest of five."""
    data = mesh.attributes[mesh.reeb_parts.color_attribute].data
    colors = np.ones(4 * len(data), np.float32)
    data.foreach_get("color_srgb", colors)
    seconds = []
    for _ in range(5):
        start = time.perf_counter()
        data.foreach_set("color_srgb", colors)
        mesh.update()
        seconds.append(time.perf_counter() - start)
    return 1e3 * min(seconds)


def spot():
    """Vertices (n, 3) and triangles (m, 3) of the bundled model."""
    bpy.ops.wm.obj_import(filepath=str(ROOT / "models" / "spot.obj"))
    mesh = bpy.context.selected_objects[0].data
    vertices, faces = np.empty(3 * len(mesh.vertices)), np.empty(len(mesh.loops), np.int32)
    mesh.vertices.foreach_get("co", vertices)
    mesh.loops.foreach_get("vertex_index", faces)
    bpy.ops.wm.read_homefile(use_empty=True)
    return vertices.reshape(-1, 3), faces.reshape(-1, 3).astype(np.int64)


def make(vertices, faces):
    """An object of triangles."""
    mesh = bpy.data.meshes.new("Spot")
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", vertices.astype(np.float32).ravel())
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", faces.astype(np.int32).ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    obj = bpy.data.objects.new("Spot", mesh)
    bpy.context.scene.collection.objects.link(obj)
    activate(obj)
    return obj


if __name__ == "__main__":
    checkout.leave(main())
