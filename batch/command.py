# SPDX-License-Identifier: GPL-3.0-or-later
"""Decompose meshes without a window.

    blender -b scene.blend --command reeb_parts --object NAME --save OUT.blend --json OUT.json
    blender --command reeb_parts model.glb --parts FOLDER
    blender --command reeb_parts chair.obj table.obj lamp.obj --json OUT.json

One JSON object goes to standard output, progress and Blender's own messages to standard error. Files appear when all
of them are complete, or not at all, and none is written over that is read. An object that cannot be decomposed, or
one of several models that cannot be read, is named in the JSON, and costs only itself. Objects that share a mesh have
the same parts, those of the first. With -b, Blender prints its version to standard output first; "blender -q -b ..."
leaves that out where something reads from a pipe, and --json OUT.json has the JSON alone.

The exit status is 0 only if every object was decomposed and every file written, 2 where an option is wrong, and 130
after Ctrl+C; an OUT.json of an earlier run does not outlast one that failed.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from typing import Any, TextIO

import bpy

from ..core.errors import ParameterError, ReebError
from ..core.file_names import readable
from ..core.options import FAILED, WRONG_OPTION, answer_text, chosen_parameters, in_working_folder
from ..scene import store, targets
from ..scene.errors import SceneError, load_core
from ..scene.graph import graph_finding
from ..scene.modes import leave_edit_mode
from ..scene.moving import armature, hulls
from ..scene.outputs import uv_map
from ..scene.pieces import piece_objects, separation
from ..scene.properties import closes_holes
from ..scene.runs import results
from ..scene.saving import export, file_checks
from ..scene.saving.run_files import RunFiles, reason, scene_files, together
from ..scene.transaction import transaction
from .computing import Computations, in_its_scene
from .interrupt import Interrupted, Interrupts
from .messages import problem, say
from .models import find_objects
from .options import parser, separate_style


def main(arguments: list[str]) -> int:
    """The command; returns the exit status."""
    try:
        options = parser(__doc__).parse_args(arguments)
    except SystemExit as end:  # argparse has said why, or has shown the help
        return int(end.code or 0)
    interrupts = Interrupts()
    with _standard_output() as answer, interrupts.heard():
        try:
            with in_working_folder():
                result = run(options, interrupts)
        except Interrupted as end:
            say("Interrupted; nothing was written.")
            return end.status
        except (SceneError, ReebError) as error:
            say(str(error))
            return WRONG_OPTION if isinstance(error, ParameterError) else FAILED
        except MemoryError:
            say("There is not enough memory; nothing was written.")
            return FAILED
        if answer is None:
            say("Standard output is closed.")
            return FAILED
        try:
            answer.write(answer_text(result))
            answer.flush()
        except OSError as error:
            say(f"Standard output could not be written: {reason(error)}")
            return FAILED
    return FAILED if result["problems"] else 0


def run(options: argparse.Namespace, interrupts: Interrupts) -> dict:
    """Do all that the options ask for; returns the JSON."""
    with together() as files:
        _claim(options, files)
        parameters, notes = chosen_parameters(options)
        for note in notes:
            say(note)
        with interrupts.allowed():
            load_core()
            objects, problems, sources = find_objects(options)
        files.protect(scene_files())
        computations = Computations(objects, parameters, options.hints.upper())
        with interrupts.allowed():
            reports, failed = decompose_objects(objects, computations, options)
        if not reports:
            raise SceneError("Nothing was decomposed.")
        said = [report | sources.get(obj, {}) for obj, report in reports.items()]
        with interrupts.allowed():
            return write_files(options, files, list(reports), said, problems + failed)


def _claim(options: argparse.Namespace, files: RunFiles) -> None:
    """Say which files will be written; raises SceneError where one cannot be."""
    # The standard streams may lead to files, too.
    files.protect([1, 2])
    for model in options.models:
        # What belongs to a model: the materials of an .obj, the numbers of a .gltf. A folder such as "." has no name.
        files.protect([model, *(model.with_suffix(suffix) for suffix in (".mtl", ".bin") if model.name)])
    if options.json is not None:
        files.claim(options.json)
        # Who reads an old one would take it for the answer of this run.
        files.withdraw_on_failure(options.json)
    for path in (options.save, options.picture, options.threemf):
        if path is not None:
            files.claim(path, by_blender=path != options.threemf)
    if options.parts is not None:
        files.claim_folder(options.parts)
    _check_kinds(options)
    if options.parts is not None:
        files.folder(options.parts)  # now, as nothing else tells whether it can be made


def _check_kinds(options: argparse.Namespace) -> None:
    """Raise SceneError if the name of a file says that it is something else."""
    for option, kind in (("save", ".blend"), ("picture", ".png"), ("threemf", ".3mf")):
        path = getattr(options, option)
        if path is not None and path.suffix.lower() != kind:
            raise SceneError(f"--{option} {path} must end in {kind}.")


def decompose_objects(objects: list[bpy.types.Object], computations: Computations, options: argparse.Namespace
                      ) -> tuple[dict[bpy.types.Object, dict], list[dict[str, str]]]:
    """Decompose one object after the other: the entry in the JSON of each, and the problems of those that failed."""
    reports: dict[bpy.types.Object, dict] = {}
    problems = []
    for obj in objects:
        # What is written to a mesh is written to all objects that share it.
        twin = next((other for other in reports if other.data == obj.data), None)
        try:
            with in_its_scene(obj):
                leave_edit_mode(bpy.context)
                reports[obj] = decompose_object(obj, computations, options, twin)
        except (SceneError, ReebError, MemoryError) as error:
            problems.append(problem(obj.name, error))
    return reports, problems


def decompose_object(obj: bpy.types.Object, computations: Computations, options: argparse.Namespace,
                     twin: bpy.types.Object | None) -> dict:
    """Read, compute and write one object, all that is asked for or nothing; its entry in the JSON.

    twin : an object that shares its mesh and was decomposed before; then the parts are those that are there.

    Raises what the user should hear.
    """
    from ..scene.saving.object_report import object_report  # imports SciPy

    targets.check_object(obj)
    outcome = None if twin else computations.outcome(obj)
    with transaction():
        if outcome is not None:
            results.write_result(bpy.context, obj, outcome, options)
        elif options.graph:
            results.draw_graph(bpy.context, obj, store.load(obj.data).shown_parts(), options)
        made = make_uses(obj, options, with_armature=options.armature and twin is None)
        found = object_report(obj, options.labels, options.check)
        if twin:
            found["notes"].append(f"It shares the mesh of {twin.name}, and so its parts"
                                  f"{'; only that one has an armature' if options.armature else ''}.")
        return found | made


def make_uses(obj: bpy.types.Object, options: argparse.Namespace, with_armature: bool) -> dict:
    """Make of the parts of an object what the options ask for; what its entry in the JSON says of that.

    with_armature : an object that shares its mesh with one that has an armature gets none, as weights are the mesh's.
    """
    stored = store.load(obj.data)
    said: dict[str, Any] = {}
    if is_separated(options):
        style = separate_style(options)
        numbers = stored.shown_parts().numbers.tolist()
        separated = separation.separate(bpy.context, obj, stored, numbers, style)
        piece_objects.hide_original(bpy.context, obj)
        if closes_holes(style):
            said["unjoined"] = separated.n_apart
        if style.joints != "NONE":
            said["joints"] = [
                {"parts": sorted(numbers.index(separated.part.get(key, key)) for key in cut.keys), "count": cut.count,
                 "width": cut.width, "reason": cut.why.lower() or None} for cut in separated.cuts]
    if options.rigid_bodies:
        piece_objects.make_bodies(bpy.context, obj, stored, options.rigid_bodies.upper())
    if options.unwrap:
        uv_map.unwrap(bpy.context, obj, stored, open_parts=True, method="MINIMUM_STRETCH", stack=False)
    if with_armature:
        armature.make(bpy.context, obj, stored, deform=True)
    if options.hulls:
        hulls.make(bpy.context, obj, stored, options.hulls.upper(), options.hulls_per_part)
    return said


def is_separated(options: argparse.Namespace) -> bool:
    """Whether the parts become objects; files of parts then hold these."""
    return bool(options.separate or options.rigid_bodies or closes_holes(separate_style(options)))


def write_files(options: argparse.Namespace, files: RunFiles, objects: list[bpy.types.Object], reports: list[dict],
                problems: list[dict]) -> dict:
    """Write what is asked for; returns the JSON with what was written."""
    from ..core.uses.report import document

    written: dict[str, str | list[str]] = {}
    separated, cut = is_separated(options), (options.cuts or "faces").upper()
    if options.parts:
        style = export.ExportStyle(options.parts_format, separated=separated, cut=cut)
        paths = export.export_parts(files, [(obj, None) for obj in objects], options.parts, style)
        written["parts"] = [readable(path) for path in paths]
    if options.threemf:
        export.write_assemblies(files, objects, options.threemf, separated, cut)
        written["threemf"] = readable(options.threemf)
    if options.save:
        with files.writing(options.save, file_checks.blend) as path:
            bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True, check_existing=False)
        written["save"] = readable(options.save)
    if options.picture:
        from .picture import render_parts, view_from

        with files.writing(options.picture, file_checks.png) as path:
            shown = [(obj, graph_finding.find(obj)) for obj in objects]
            render_parts(shown, path, view=view_from(options.picture_turn), size=options.picture_size)
        written["picture"] = readable(options.picture)
    if options.json:
        written["json"] = readable(options.json)
    result = document(reports, blender=bpy.app.version_string, files=written, problems=problems)
    if options.json:
        text = answer_text(result)
        with files.writing(options.json, file_checks.text(text)) as path:
            path.write_bytes(text.encode())
    return result


@contextmanager
def _standard_output() -> Iterator[TextIO | None]:
    """Standard output for the answer alone, None where it is closed: all that Blender prints goes to standard error.

    That stays so to the end of the process, which has more to print.
    """
    answer = None
    if _is_given(1):
        sys.stdout.flush()
        answer = os.fdopen(os.dup(1), "w", encoding="utf-8", newline="\n")  # the bytes of --json on Windows, too
    if not _is_given(2):
        _throw_away(2)
    # Before anything is written that could be aimed at it.
    os.dup2(2, 1)
    try:
        with redirect_stdout(sys.stderr):
            yield answer
    finally:
        if answer is not None:
            with suppress(OSError):  # the command has said so
                answer.close()


def _is_given(stream: int) -> bool:
    """Whether a standard stream was given to this process, and not closed.

    A library, as that for sound, has the number of one that was closed for a pipe of its own, which it hands on to no
    other process. What a process was given can be handed on.
    """
    if os.name == "nt":  # where nothing is handed on unless one says so
        return True
    try:
        return os.get_inheritable(stream)
    except OSError:  # nothing has its number
        return False


def _throw_away(stream: int) -> None:
    """Have nothing read what is written to a standard stream."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream)
    os.close(nowhere)
