# SPDX-License-Identifier: GPL-3.0-or-later
"""The models and objects of a run: scenes are opened, models imported."""

from __future__ import annotations

import argparse
import stat
import sys
from fnmatch import fnmatchcase
from itertools import takewhile
from pathlib import Path

import bpy

from ..core.file_names import LONGEST_IN_BLENDER, is_too_long_for_blender, kind_of, readable
from ..scene.errors import SceneError
from ..scene.pieces import origins
from ..scene.saving.run_files import reason
from .importers import IMPORTERS, WITHOUT_UNIT, all_or_nothing, import_model
from .messages import problem

#: Lengths of units in meters, with what Blender calls them.
UNITS = {"m": (1.0, "METERS"), "cm": (0.01, "CENTIMETERS"), "mm": (0.001, "MILLIMETERS")}


def find_objects(options: argparse.Namespace) -> tuple[list, list[dict], dict]:
    """Open what is asked for.

    Returns the objects to decompose, the problems with those that are not there, and what the JSON says of where an
    object comes from, if there are several models.
    """
    meshes, problems, sources = _open(options.models, options.unit)
    if not options.object:
        return meshes or ([] if problems else [_active()]), problems, sources
    found: dict = {}  # a set in the order in which they are named
    for name in options.object:
        try:
            found |= dict.fromkeys(_named(name))
        except SceneError as error:
            problems.append(problem(name, error))
    return list(found), problems, sources


def _active() -> bpy.types.Object:
    """The active object. Raises SceneError if there is none or it is no mesh; a missing one says more itself."""
    active = bpy.context.view_layer.objects.active
    if active is None or (active.type != "MESH" and not active.is_missing):
        why = "The scene has no active object" if active is None else f"{active.name}, the active object, is no mesh"
        raise SceneError(f'{why}: name a mesh with --object NAME, or all meshes with --object "*".')
    return active


def _named(name: str) -> list[bpy.types.Object]:
    """The object of that name, or the meshes of the file's scenes whose names are like it. Raises SceneError if none.

    What was made of parts, such as pieces and hulls, has to be named itself: it is not decomposed with the rest.
    """
    if name in bpy.data.objects:
        return [bpy.data.objects[name]]
    if not any(sign in name for sign in "*?["):
        raise SceneError(f"There is no object {name} in the scene.")
    found = [obj for obj in bpy.data.objects
             if obj.type == "MESH" and fnmatchcase(obj.name, name) and obj.users_scene and not origins.is_made(obj)]
    if not found:
        raise SceneError(f"There is no mesh with a name like {name} in the scene.")
    return found


def _open(models: list[Path], unit: str | None) -> tuple[list, list[dict], dict]:
    """Open a scene, or import models into an empty one; the meshes of models and, of several, problems and sources."""
    if len(models) == 1:
        _check_model(models[0], (".blend", *IMPORTERS))
    is_scene = len(models) == 1 and models[0].suffix.lower() == ".blend"
    if unit:
        _check_unit([] if is_scene else models)
    if not models:
        _check_opened(sys.argv)
        return [], [], {}
    if is_scene:
        _open_scene(models[0])
        return [], [], {}
    bpy.ops.wm.read_homefile(use_empty=True)
    if unit:
        units = bpy.context.scene.unit_settings
        units.system, (units.scale_length, units.length_unit) = "METRIC", UNITS[unit]
    return _import_all(models)


def _check_unit(models: list[Path]) -> None:
    """Raise SceneError unless there are models, and none of them says itself what unit it is in."""
    if not models:
        raise SceneError("--unit is for models; a scene has its own.")
    if own := [path for path in models if path.suffix.lower() not in WITHOUT_UNIT]:
        raise SceneError(f"--unit is for {', '.join(WITHOUT_UNIT)}; {own[0]} has its own.")


def _open_scene(path: Path) -> None:
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), load_ui=False)
    except RuntimeError as error:  # what Blender's own operators report
        raise SceneError(f"{path} could not be read: {reason(error)}") from error


def _import_all(models: list[Path]) -> tuple[list, list[dict], dict]:
    """Import models; their meshes and, of several, the problems with those that cannot be read, and the sources."""
    meshes, problems, sources = [], [], {}
    for path in models:
        try:
            found = _imported(path)
        except SceneError as error:
            if len(models) == 1:
                raise
            problems.append(problem(readable(path), error))
            continue
        meshes += found
        sources |= {obj: {"model": readable(path)} for obj in found if len(models) > 1}
    return meshes, problems, sources


def _check_opened(words: list[str]) -> None:
    """Raise SceneError if Blender's own command line names a scene that it could not open: another one is open then."""
    before = list(takewhile(lambda word: word not in ("-c", "--command"), words))
    named = [Path(word) for word in before[1:] if word.lower().endswith(".blend")]
    if len(before) == len(words) or not named:
        return
    _check_model(named[-1], (".blend",))
    if not bpy.data.filepath:
        raise SceneError(f"{named[-1]} could not be read.")


def _check_model(path: Path, kinds: tuple[str, ...]) -> None:
    """Raise SceneError if there is no file of that kind there."""
    try:
        kind = kind_of(path)
    except OSError as error:  # such as a folder that one may not enter
        raise SceneError(f"{path} could not be read: {reason(error)}") from error
    if stat.S_ISDIR(kind):
        raise SceneError(f"{path} is a folder, not a model.")
    if not kind:
        raise SceneError(f"There is no file {path}.")
    if not stat.S_ISREG(kind):
        raise SceneError(f"{path} is no file but a pipe or a device: write the model to a file first.")
    if is_too_long_for_blender(path):
        raise SceneError(f"{path} could not be read: Blender takes names of up to {LONGEST_IN_BLENDER} bytes, with "
                         "all folders.")
    if path.suffix.lower() not in kinds:
        raise SceneError(f"{path} is none of {', '.join(kinds)}.")


def _imported(path: Path) -> list:
    """Import a model into the scene; returns its meshes. Raises SceneError."""
    _check_model(path, tuple(IMPORTERS))
    with all_or_nothing():
        try:
            meshes = import_model(path)
        except (RuntimeError, OSError) as error:  # the former is what Blender's own operators report
            raise SceneError(f"{path} could not be read: {reason(error)}") from error
        if not meshes:
            raise SceneError(f"There is no mesh in {path}.")
    return meshes
