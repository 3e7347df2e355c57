# SPDX-License-Identifier: GPL-3.0-or-later
"""Decompose meshes without a window.

    blender -b scene.blend --command reeb_parts --object NAME --save OUT.blend --json OUT.json
    blender --command reeb_parts model.glb --parts FOLDER

One JSON object goes to standard output, progress and Blender's own messages to standard error. The exit
status is 0 only if every object was decomposed and every file written. Files appear whole or not at all.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields, replace
from pathlib import Path
from typing import TextIO

import bpy

from ..core.errors import ReebError
from ..core.parameters import PRESETS, RENAMED, Parameters, present_names
from ..scene import bridge, export, graph_objects, results, targets
from ..scene.compute import Outcome, compute_all
from ..scene.errors import SceneError, load_core
from ..scene.settings import OutputProperties, OverlayProperties

IMPORTERS = {
    ".obj": lambda path: bpy.ops.wm.obj_import(filepath=path),
    ".ply": lambda path: bpy.ops.wm.ply_import(filepath=path),
    ".stl": lambda path: bpy.ops.wm.stl_import(filepath=path),
    ".glb": lambda path: bpy.ops.import_scene.gltf(filepath=path),
    ".gltf": lambda path: bpy.ops.import_scene.gltf(filepath=path),
    ".fbx": lambda path: bpy.ops.import_scene.fbx(filepath=path),
}

FAILED = 1


def main(arguments: list[str]) -> int:
    """The command; returns the exit status."""
    try:
        options = parser().parse_args(arguments)
    except SystemExit as end:  # argparse has said why, or has shown the help
        return int(end.code or 0)
    with _standard_output() as answer:
        try:
            result = run(options)
        except (SceneError, ReebError, OSError, RuntimeError) as error:
            # What Blender's own operators report arrives as RuntimeError.
            _say(str(error).removeprefix("Error: ").strip())
            return FAILED
        answer.write(json.dumps(result, indent=2, allow_nan=False) + "\n")
    return 0


def parser() -> argparse.ArgumentParser:
    """All options; parameters and switches are made from their definitions."""
    made = argparse.ArgumentParser(
        prog="blender --command reeb_parts", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument("model", nargs="?", type=Path,
                      help=f"a scene (.blend) or a model ({', '.join(IMPORTERS)}); without it, the scene "
                      "that Blender has open")
    made.add_argument("--object", action="append", default=[], metavar="NAME",
                      help="object to decompose, can be given several times; the active object of a scene "
                      "and every mesh of a model file without")
    files = made.add_argument_group("files to write")
    files.add_argument("--save", type=Path, metavar="OUT.blend", help="the scene with the parts in it")
    files.add_argument("--json", type=Path, metavar="OUT.json", help="the JSON that also goes to standard output")
    files.add_argument("--labels", action="store_true", help="also list the part of every face in the JSON")
    files.add_argument("--parts", type=Path, metavar="DIR", help="a file for each part, in a folder")
    files.add_argument("--parts-format", choices=("obj", "ply", "stl", "glb"), default="obj",
                       help="format of those files (default: %(default)s)")
    files.add_argument("--picture", type=Path, metavar="OUT.png", help="a picture of the parts with the graph")
    files.add_argument("--picture-turn", type=float, default=0.0, metavar="DEGREES",
                       help="turn its camera, which looks at the front, around the objects")
    files.add_argument("--picture-size", type=_size, default=(960, 540), metavar="WxH",
                       help="its width and height in pixels (default: 960x540)")
    _add_parameters(made.add_argument_group("parameters"))
    outputs = made.add_argument_group("what is written to the objects")
    for name, prop in (OutputProperties.__annotations__ | OverlayProperties.__annotations__).items():
        words = {"default": prop.keywords.get("default"), "help": prop.keywords["description"].replace("%", "%%")}
        if isinstance(words["default"], bool):
            words["action"] = argparse.BooleanOptionalAction
        elif "items" in prop.keywords:
            words["choices"] = [item[0] for item in prop.keywords["items"]]
            words["default"] = words["choices"][0]
        else:
            words |= {"type": float, "metavar": "N"}
        outputs.add_argument(f"--{_dashed(name)}", **words)
    return made


def _add_parameters(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--preset", choices=list(PRESETS), help="start from the parameters of a preset")
    for field in fields(Parameters):
        meta = field.metadata
        words = {"dest": field.name, "default": None, "help": meta["description"].replace("%", "%%")}
        name = f"--{_dashed(field.name)}"
        if "choices" in meta:
            group.add_argument(name, choices=meta["choices"], **words)
        elif "range" in meta:
            low, high = meta["range"]
            words["help"] += f" ({low} to {high}; default {field.default})"
            group.add_argument(name, type=int if field.type == "int" else float, metavar="N", **words)
        else:
            group.add_argument(name, action=argparse.BooleanOptionalAction, **words)
    for old in RENAMED:  # scripts of version 0.1.0
        kind = {"action": argparse.BooleanOptionalAction} if old == "equalise" else {"type": float}
        group.add_argument(f"--{old}", help=argparse.SUPPRESS, **kind)


def _size(text: str) -> tuple[int, int]:
    """Width and height out of "960x540"; argparse turns the error into a sentence."""
    width, height = (int(number) for number in text.split("x"))
    if not (16 <= width <= 8192 and 16 <= height <= 8192):
        raise ValueError
    return width, height


def _dashed(name: str) -> str:
    return name.replace("_", "-")


def run(options: argparse.Namespace) -> dict:
    """Do all that the options ask for; returns the JSON."""
    load_core()
    from ..scene.object_report import object_report  # imports SciPy

    names = (*RENAMED, *(field.name for field in fields(Parameters)))
    values, notes = present_names(
        {name: value for name in names if (value := getattr(options, name)) is not None})
    for note in notes:
        _say(note)
    parameters = replace(PRESETS[options.preset] if options.preset else Parameters(), **values)
    objects = find_objects(options)
    reports = []
    for obj in objects:
        outcome = decompose_object(obj, parameters)
        results.write_result(bpy.context, obj, outcome, options)
        reports.append(object_report(obj, options.labels))
    return write_files(options, objects, reports)


def find_objects(options: argparse.Namespace) -> list:
    """Open what is asked for; the objects to decompose."""
    meshes = [] if options.model is None else _open(options.model)
    if options.object:
        missing = [name for name in options.object if name not in bpy.data.objects]
        if missing:
            raise SceneError(f"There is no object {', '.join(missing)} in the scene.")
        return [bpy.data.objects[name] for name in dict.fromkeys(options.object)]
    return meshes or [bpy.context.view_layer.objects.active]


def _open(path: Path) -> list:
    """Open a scene, or import a model into an empty one; returns the meshes of a model."""
    if not path.is_file():
        raise SceneError(f"There is no file {path}.")
    kind = path.suffix.lower()
    if kind == ".blend":
        bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), load_ui=False)
        return []
    if kind not in IMPORTERS:
        raise SceneError(f"{path} is none of .blend, {', '.join(IMPORTERS)}.")
    bpy.ops.wm.read_homefile(use_empty=True)
    IMPORTERS[kind](str(path.resolve()))
    meshes = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
    if not meshes:
        raise SceneError(f"There is no mesh in {path}.")
    return meshes


def decompose_object(obj: bpy.types.Object, parameters: Parameters) -> Outcome:
    """Read and compute one object; raises what the user should hear."""
    targets.check_object(obj)
    shape = bridge.read_shape(obj)
    last = [-1]

    def progress(stage: str, share: float) -> None:
        if round(20 * share) > last[0]:  # twenty lines at most
            last[0] = round(20 * share)
            _say(f"{obj.name}: {stage} {share:.0%}")

    (outcome,) = compute_all([(obj.name, shape)], parameters, progress)
    if outcome.decomposition is None:
        raise SceneError(f"{obj.name}: {outcome.problem}")
    return outcome


def write_files(options: argparse.Namespace, objects: list[bpy.types.Object], reports: list[dict]) -> dict:
    """Write what is asked for; returns the JSON with what was written."""
    from ..core.uses.report import document

    written: dict[str, str | list[str]] = {}
    if options.parts:
        options.parts.mkdir(parents=True, exist_ok=True)
        written["parts"] = [str(path) for obj in objects
                            for path in export.export_parts(obj, options.parts, options.parts_format)]
    if options.save:
        with _whole(options.save) as path:
            bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True, check_existing=False)
        written["save"] = str(options.save)
    if options.picture:
        from .picture import render_parts, view_from

        with _whole(options.picture) as path:
            shown = [(obj, graph_objects.find(obj)) for obj in objects]
            render_parts(shown, path, view=view_from(options.picture_turn), size=options.picture_size)
        written["picture"] = str(options.picture)
    if options.json:
        written["json"] = str(options.json)
    result = document(reports, blender=bpy.app.version_string, files=written)
    if options.json:
        with _whole(options.json) as path:
            path.write_text(json.dumps(result, indent=2, allow_nan=False) + "\n")
    return result


@contextmanager
def _whole(path: Path) -> Iterator[Path]:
    """A name to write to beside the path; the file is moved to the path when it is complete."""
    path = path.resolve()
    path.parent.mkdir(parents=True, exist_ok=True)
    # In the same folder: a scene's paths to its pictures are relative to where it is saved.
    part = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def _standard_output() -> Iterator[TextIO]:
    """Standard output for the answer alone: all that Blender prints goes to standard error.

    That stays so to the end of the process, which has more to print.
    """
    sys.stdout.flush()
    answer = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    with answer:
        yield answer


def _say(text: str) -> None:
    print(f"reeb_parts: {text}", file=sys.stderr, flush=True)
