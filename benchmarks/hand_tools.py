# SPDX-License-Identifier: GPL-3.0-or-later
"""Time what happens at each move of the pointer: hover and the tools that are used over the model.

    blender --background --python-exit-code 1 --python benchmarks/hand_tools.py -- [--check] [--faces N ...]
    python3 benchmarks/hand_tools.py [--check] [--faces N ...]         with Blender as a module

The bundled model is refined to each size, decomposed with all that is written by default, and looked at from the side.
Then the pointer goes to 60 places of it, and each tool answers as it does in a window, Blender's own evaluation of what
was written included; only drawing is not. Milliseconds are of the processor, so that other programs do not count.
"start" is what a tool reads before its first answer, once; "slow" is the slowest but three of its answers. --check
fails when that means fewer than 20 answers per second at 200,000 faces.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "benchmarks")]

import packages

packages.need("bpy")

import bpy
import checkout
import numpy as np
from detail import make, spot
from mathutils import Matrix
from meshes import refined

LIMITS = {200_000: 50.0}  # faces: ms
N_PLACES = 60
SIZE = (1280, 800)  # of the view, in pixels


def main() -> int:
    """Time all sizes; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--faces", type=int, nargs="+", default=[20_000, *LIMITS], metavar="N")
    parser.add_argument("--check", action="store_true", help="fail when a limit is missed")
    arguments = parser.parse_args(checkout.arguments())
    met = True
    with tempfile.TemporaryDirectory() as folder:
        package = checkout.enable(Path(folder))
        print("| faces | tool | start ms | median ms | slow ms | per second | limit ms |\n" + "| --- " * 7 + "|")
        for size in arguments.faces:
            limit = LIMITS.get(size, float("nan"))
            met &= not max(measure(package, size, limit)) > limit
    return 1 if arguments.check and not met else 0


def measure(package: str, size: int, limit: float):
    """Print the rows of one size; the slow time of each tool."""
    bpy.ops.wm.read_homefile(use_empty=True)
    obj = make(*refined(*spot(), size // 2))
    bpy.ops.reeb_parts.decompose(symmetry=False)
    view = View(package, obj)
    for name, start in (("hover", hover), ("cut", cut), ("slide", slide), ("grow", grow), ("paint", paint)):
        begin = time.process_time()
        answer = start(view)
        started = time.process_time() - begin
        times = []
        for place in view.places:
            begin = time.process_time()
            answer(place)
            bpy.context.view_layer.update()
            times.append(1e3 * (time.process_time() - begin))
        slow = float(np.sort(times)[-4])
        print(f"| {len(obj.data.polygons):,} | {name} | {1e3 * started:.0f} | {np.median(times):.1f} | {slow:.1f} | "
              f"{1e3 / slow:.0f} | {limit:.0f} |", flush=True)
        yield slow


class View:
    """The model as a window shows it, where there is none, and the places on it that the pointer goes to."""

    def __init__(self, package: str, obj: bpy.types.Object) -> None:
        self.obj = obj
        for folder, several in {"viewport": ("hover", "pointing"),
                                "viewport.modal": ("knife", "boundary", "brush", "colored_tool", "ring_tool")}.items():
            for name in several:
                setattr(self, name, importlib.import_module(f"{package}.{folder}.{name}"))
        self.part_list = importlib.import_module(f"{package}.scene.result.part_list")
        looking = Matrix(((0, 0, 1, 0), (1, 0, 0, 0), (0, 1, 0, -4), (0, 0, 0, 1)))  # along x, from 4 away
        lens = Matrix(((2, 0, 0, 0), (0, 2 * SIZE[0] / SIZE[1], 0, 0), (0, 0, -1, -0.02), (0, 0, -1, 0)))
        data = SimpleNamespace(view_matrix=looking, window_matrix=lens, perspective_matrix=lens @ looking,
                               is_perspective=True, view_perspective="PERSP", view_location=None)
        self.region = SimpleNamespace(width=SIZE[0], height=SIZE[1], data=data)
        self.context = SimpleNamespace(
            view_layer=bpy.context.view_layer, preferences=bpy.context.preferences, region=self.region,
            evaluated_depsgraph_get=bpy.context.evaluated_depsgraph_get)
        self.model = self.pointing.Model(obj)
        rng = np.random.default_rng(0)
        self.places = []
        while len(self.places) < N_PLACES:
            place = tuple((rng.random(2) * SIZE).tolist())
            if self.target(place) is not None:
                self.places.append(place)

    def target(self, place: tuple[float, float]) -> Any:
        return self.model.under(self.context, self.obj, self.region, place, graph=False)

    def show(self) -> Callable[[np.ndarray], None]:
        """What colors the model as if its faces were in other parts."""
        tool = SimpleNamespace(_shown=self.model.numbers)
        return lambda numbers: self.colored_tool.ColoredTool.show(tool, self.obj, numbers)


def hover(view: View) -> Callable:
    view.hover.forget()
    view.pointing.forget()
    view.hover.point(view.context, view.places[0])
    return lambda place: view.hover.point(view.context, place)


def cut(view: View) -> Callable:
    model = view.pointing.Model(view.obj)
    knife = view.knife.Knife(view.obj, model)
    return lambda place: knife.ring(view.target(place))


def slide(view: View) -> Callable:
    boundary = view.boundary.Boundary(view.obj, view.model.stored, view.part_list.active_number(view.obj.data))
    show = view.show()
    return lambda place: show(boundary.slid(boundary.reach[1] * place[0] / SIZE[0]))


def grow(view: View) -> Callable:
    tool = view.ring_tool.RingTool()
    tool.model, tool._shown = view.model, view.model.numbers
    tool.read(view.obj)
    return lambda place: tool.go_to(view.obj, int(tool.limits[1] * place[0] / SIZE[0]))


def paint(view: View) -> Callable:
    brush = view.brush.Brush(view.obj, view.pointing.Model(view.obj), view.part_list.active_number(view.obj.data))
    radius = view.brush.START_SIZE * float(np.linalg.norm(np.ptp(view.model.face_center, axis=0)))
    show = view.show()

    def dab(place: tuple[float, float]) -> None:
        target = view.target(place)
        brush.dab(target.location, radius, target.face)
        show(brush.numbers())

    return dab


if __name__ == "__main__":
    checkout.leave(main())
