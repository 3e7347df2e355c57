# SPDX-License-Identifier: GPL-3.0-or-later
"""Separate models into closed pieces, and check that nothing is lost.

    blender --background --python-exit-code 1 --python benchmarks/separate.py -- [MODELS ...] [--preset NAME]
    python3 benchmarks/separate.py [MODELS ...] [--preset NAME]      with Blender as a module

MODELS are .obj files or folders with such. Spot, Suzanne as she is and subdivided twice, and the jug with two
handles of tests/shapes.py are always done. Each mesh gets a UV map, two color attributes, an attribute of
faces, a vertex group, two shape keys, custom normals, seams, creases, sharp edges and two materials, is
decomposed and separated with caps. The exit status is 1 if

- a piece has a border, or an edge of three or more faces, that the mesh did not have;
- a face is lost or doubled, or the area without caps differs by more than one part in 100,000;
- anything that an element carries differs by more than 0.001 from what it was, normals by more than 0.014:
  Blender keeps custom normals as two angles relative to the faces around, and takes one that is smaller than
  that for none.

Voids are what lies between the caps of neighbors, and are only shown. For that, cuts run along faces, all of which
stay whole. With --sound, models are separated as by default instead, with smooth cuts, and the table tells how many
pieces are closed and cross nothing, by how much their volume together differs from the model's, by how many degrees
rims turn from edge to edge, along faces and smoothly, and by how much per length, the diagonal of the model being 1;
MODELS may then be .npz files with vertices and faces, too. With --joints KIND, closed models are separated with such
joints, and the table tells how many cuts got them, why the others did not, how many pieces are sound without and with
them, and by how much the volume of the pieces together differs, with no clearance, from the model's. docs/separate.md
has the figures.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from dataclasses import asdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "benchmarks")]

import packages

packages.need("bpy")

import bpy
import checkout
import numpy as np
import pieces
import shapes
from snapshot import activate

AREA, CARRIED, NORMALS = 1e-5, 1e-3, 0.014


def main() -> int:
    """Check all models; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", type=Path, metavar="MODELS")
    parser.add_argument("--preset", default="Perceptual", metavar="NAME")
    parser.add_argument("--detail", type=float, metavar="D", help="0..1, instead of the preset's")
    parser.add_argument("--sound", action="store_true", help="how good pieces are, as they are made by default")
    parser.add_argument("--joints", metavar="KIND", help="how many cuts get joints")
    arguments = parser.parse_args(checkout.arguments())
    with tempfile.TemporaryDirectory() as folder:
        checkout.enable(Path(folder))
        if arguments.sound or arguments.joints:
            return sound(arguments)
        print("| model | faces | parts | caps | new borders | edges of 3 faces | lost | area | normals | all else |"
              " volume | voids | s |\n" + "| --- " * 13 + "|")
        wrong = [name for name, make in models(arguments.models)
                 if not check(name, make, arguments.preset, arguments.detail)]
    if wrong:
        print(f"These do not hold what is claimed: {', '.join(wrong)}", file=sys.stderr)
    return 1 if wrong else 0


def models(paths):
    """Name and maker of each model."""
    paths = [ROOT / "models" / "spot.obj", *paths]
    files = [file for path in paths for file in (sorted(path.glob("*.obj")) if path.is_dir() else [path])]
    for file in {file.stem: file for file in reversed(files)}.values():
        yield file.stem, lambda file=file: imported(file)
    yield "Suzanne", bpy.ops.mesh.primitive_monkey_add
    yield "Suzanne, subdivided", subdivided_monkey
    yield "Jug of genus 2", jug


def imported(file):
    """A model from a file."""
    if file.suffix == ".npz":
        with np.load(file) as data:
            add(file.stem, data["vertices"], data["faces"])
    else:
        bpy.ops.wm.obj_import(filepath=str(file))


def subdivided_monkey():
    """Suzanne with sixteen times as many faces."""
    bpy.ops.mesh.primitive_monkey_add()
    bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.ops.object.modifier_apply(modifier="Subdivision")


def jug():
    """The one of tests/shapes.py."""
    add("Jug", *shapes.genus_two())


def add(name, vertices, faces):
    """An object of arrays, which is the active one."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    activate(obj)


def sound(arguments) -> int:
    """Say of each model how good its pieces are; returns the exit status."""
    if arguments.joints:
        print("| model | faces | cuts | with joints | no room | bent | not closed | unsound result | pieces | sound "
              "without | sound with | volume | s without | s with |\n" + "| --- " * 14 + "|")
    else:
        print("| model | faces | closed | pieces | sound | volume | degrees along faces | smooth | turning along "
              "faces | smooth | s |\n" + "| --- " * 11 + "|")
    for name, make in models(arguments.models):
        bpy.ops.wm.read_homefile(use_empty=True)
        make()
        obj = bpy.context.selected_objects[0]
        activate(obj)
        bpy.context.scene.reeb_parts.preset = arguments.preset
        values = asdict(bpy.context.scene.reeb_parts.parameters())
        bpy.ops.reeb_parts.decompose(**values if arguments.detail is None else {**values, "detail": arguments.detail})
        if arguments.joints and pieces.closed_volume(obj.data) is None:
            continue
        print(joints_row(name, obj, arguments.joints) if arguments.joints else sound_row(name, obj), flush=True)
    return 0


def joints_row(name, obj, kind) -> str:
    """A row of the table for a closed model that has parts."""
    fine, seconds = [], []
    for more in ({"caps": True}, {"joints": kind.upper(), "joint_clearance": 0.0}):
        start = time.perf_counter()
        bpy.ops.reeb_parts.separate(hide=False, center=False, **more)
        seconds.append(time.perf_counter() - start)
        checks = [json.loads(piece["reeb_parts_check"]) for piece in bpy.data.objects if "reeb_parts_number" in piece]
        fine.append(sum(is_sound(found) for found in checks))
        activate(obj)
    cuts = obj.reeb_parts_made.cuts
    why = [sum(cut.why == reason for cut in cuts) for reason in ("ROOM", "BENT", "BODY", "RESULT")]
    joined = sum(cut.count > 0 for cut in cuts)
    volume = sum(found["volume"] or 0.0 for found in checks) / pieces.closed_volume(obj.data) - 1
    return (f"| {name} | {len(obj.data.polygons):,} | {joined + sum(why)} | {joined} | {' | '.join(map(str, why))} | "
            f"{len(checks)} | {fine[0]} | {fine[1]} | {volume:.1e} | {seconds[0]:.2f} | {seconds[1]:.2f} |")


def is_sound(found) -> bool:
    """Whether a check has found nothing."""
    return not (found["open_edges"] or found["branching_edges"] or found["contrary_edges"] or found["crossing_faces"]
                or found["inside_out"])


def sound_row(name, obj) -> str:
    """A row of the table for a model that has parts."""
    size = max(np.linalg.norm(np.ptp([v.co for v in obj.data.vertices], axis=0)), 1e-30)
    rims = []
    for cut in ("FACES", "SMOOTH"):
        start = time.perf_counter()
        bpy.ops.reeb_parts.separate(cut=cut, caps=True, hide=False, center=False)
        seconds = time.perf_counter() - start
        made = [piece for piece in bpy.data.objects if "reeb_parts_number" in piece]
        rims.append(pieces.rims([piece.data for piece in made], size))
        activate(obj)
    checks = [json.loads(piece["reeb_parts_check"]) for piece in made]
    fine = sum(map(is_sound, checks))
    whole = pieces.closed_volume(obj.data)
    volume = "" if whole is None or not all(found["volume"] for found in checks) else (
        f"{sum(found['volume'] for found in checks) / whole - 1:.1e}")
    (before, turn), (after, smooth) = rims
    return (f"| {name} | {len(obj.data.polygons):,} | {'yes' if whole is not None else ''} | {len(made)} | {fine} | "
            f"{volume} | {before:.0f} | {after:.0f} | {turn:.0f} | {smooth:.0f} | {seconds:.2f} |")


def check(name, make, preset, detail) -> bool:
    """Separate one model and print how it went; whether all that is claimed holds."""
    bpy.ops.wm.read_homefile(use_empty=True)
    make()
    obj = bpy.context.selected_objects[0]
    activate(obj)
    pieces.furnish(obj)
    bpy.context.scene.reeb_parts.preset = preset
    values = asdict(bpy.context.scene.reeb_parts.parameters())
    bpy.ops.reeb_parts.decompose(**values if detail is None else {**values, "detail": detail})
    start = time.perf_counter()
    bpy.ops.reeb_parts.separate(caps=True, hide=False, center=False, cut="FACES")
    seconds = time.perf_counter() - start
    made = [piece for piece in bpy.data.objects if "reeb_parts_number" in piece]
    found = pieces.compare(obj, made)
    normals = found.differences.pop("normals")
    other = max(found.differences.values())
    print(f"| {name} | {found.faces:,} | {len(made)} | {found.caps} | {found.new_borders} | {found.new_branches} | "
          f"{found.lost} | {found.area:.0e} | {normals:.1e} | {other:.0e} | {found.volume:.1e} | "
          f"{found.voids:.1e} | {seconds:.1f} |", flush=True)
    return (not found.new_borders and not found.new_branches and not found.lost and abs(found.area) < AREA
            and normals < NORMALS and other < CARRIED)


if __name__ == "__main__":
    checkout.leave(main())
