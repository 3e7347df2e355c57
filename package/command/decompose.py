# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut one model into parts.

    reeb-parts decompose model.glb --json parts.json --labels labels.npy --colored parts.ply --picture parts.png

One JSON object goes to standard output, the one that Blender's command writes, and progress to standard error. All
meshes of a model are decomposed together. Files appear when all of them are complete, or not at all.
"""

from __future__ import annotations

import argparse
import logging
import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..core.file_names import readable, spelled
from ..core.memory import keep_freed_memory
from ..core.options import add_parameters, chosen_parameters, may_be_answer, named_file, named_folder, number
from ..core.progress import said_in_steps
from ..core.result.decomposition import Decomposition
from ..core.sentence import Sentence
from ..meshes import decompose
from ..model_files import BY_BLENDER, Model, read_model
from ..output_files import OutputFileError, check_file, check_folder, write_files
from ..outputs import (
    COLORED,
    LABELS,
    LARGEST_PICTURE,
    PARTS,
    colored_bytes,
    json_bytes,
    labels_bytes,
    model_document,
    part_files,
    picture_bytes,
)
from ..rounding import Rounding
from .words import print_answer, say


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options to a parser."""
    parser.add_argument("model", type=Path, help="a model: .obj, .ply, .stl, .glb, .gltf, .off, .npz and what else "
                        "trimesh reads; with --blender " + ", ".join(BY_BLENDER))
    parser.add_argument("--blender", metavar="PATH", help="the Blender that reads " + ", ".join(BY_BLENDER))
    files = parser.add_argument_group("files to write")
    files.add_argument("--json", type=named_file, metavar="OUT.json",
                       help="the JSON that also goes to standard output")
    files.add_argument("--labels", type=file_of(LABELS), metavar="OUT.npy",
                       help=f"the part of each face, from 0 ({', '.join(LABELS)})")
    files.add_argument("--colored", type=file_of(COLORED), metavar="OUT.ply",
                       help=f"the model in the colors of its parts ({', '.join(COLORED)})")
    files.add_argument("--parts", type=named_folder, metavar="DIR", help="a file for each part, in a folder")
    files.add_argument("--parts-format", choices=PARTS, default="obj",
                       help="format of those files (default: %(default)s)")
    files.add_argument("--picture", type=file_of((".png",)), metavar="OUT.png",
                       help="a picture of the parts with the graph")
    files.add_argument("--picture-size", type=number(16, LARGEST_PICTURE, int), default=640, metavar="N",
                       help=f"its width and height in pixels, 16 to {LARGEST_PICTURE} (default: %(default)s)")
    add_parameters(parser.add_argument_group("parameters"))


def run(options: argparse.Namespace) -> int:
    """Do what the options ask for; returns the exit status. Raises ReebError."""
    try:
        answer = _run(options)
    except BaseException:
        _withdraw(options)
        raise
    print_answer(answer)
    return 0


def _withdraw(options: argparse.Namespace) -> None:
    """Remove the JSON of an earlier run, which would be taken for the answer of this one.

    It stays if it is the model, or something else than a JSON: another model, where an option was mistaken.
    """
    path, model = options.json, options.model
    with suppress(OSError):
        is_model = path and model.exists() and path.samefile(model)
        if path and not is_model and path.is_file() and may_be_answer(path):
            path.unlink()


def _run(options: argparse.Namespace) -> str:
    """Decompose the model and write the files; returns the JSON."""
    parameters, notes = chosen_parameters(options)
    for note in notes:
        say(note)
    _check_places(options)
    keep_freed_memory()
    with _unheard():
        model = read_model(options.model, options.blender)
    result = decompose(model, parameters=parameters, progress=said_in_steps(say))
    files = _Files()
    answer = _made(options, model, result, files)
    write_files(files.data, options.model)
    return answer.decode()


def _check_places(options: argparse.Namespace) -> None:
    """Raise OutputFileError where a file cannot be written, before a large model is decomposed for nothing."""
    files = _Files()
    for path in (options.labels, options.colored, options.picture, options.json):
        if path:
            check_file(path, options.model)
            files.add(path, b"")
    if options.parts:
        check_folder(options.parts)


class _Files:
    """The bytes of each file to write, none of which takes the place of another."""

    def __init__(self) -> None:
        self.data: dict[Path, bytes] = {}
        self._places: set[str] = set()

    def add(self, path: Path, data: bytes) -> str:
        """Add a file; returns its name for the JSON. Raises OutputFileError if there is one in its place."""
        place = os.path.realpath(path)
        if place in self._places:
            raise OutputFileError(
                Sentence("{path} would be written twice. Give each file a name of its own.", path=path))
        self._places.add(place)
        self.data[path] = data
        return readable(path)


def _made(options: argparse.Namespace, model: Model, result: Decomposition, files: _Files) -> bytes:
    """Make the files that the options ask for; returns the JSON, which names them."""
    parts = result.parts()
    written: dict[str, str | list[str]] = {}
    if options.labels:
        written["labels"] = files.add(options.labels, labels_bytes(parts, options.labels.suffix.lower()))
    if options.colored:
        written["colored"] = files.add(options.colored, colored_bytes(model, parts, options.colored.suffix.lower()))
    if options.picture:
        written["picture"] = files.add(options.picture, picture_bytes(model, result, parts, options.picture_size))
    if options.parts:
        for note in Rounding.of(model).notes(options.parts_format):
            say(note)
        made = part_files(model, parts, options.parts_format)
        written["parts"] = [files.add(options.parts / spelled(name), data) for name, data in made.items()]
    if options.json:
        written["json"] = readable(options.json)
    answer = json_bytes(model_document(model, result, parts, files=written))
    if options.json:
        files.add(options.json, answer)
    return answer


@contextmanager
def _unheard() -> Iterator[None]:
    """Keep from standard error what readers log and warn of: it is about lines of theirs, not of the file."""
    handler = logging.NullHandler()
    logging.getLogger().addHandler(handler)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.getLogger().removeHandler(handler)


def file_of(kinds: tuple[str, ...]) -> Callable[[str], Path]:
    """What reads the name of a file of some kinds; argparse turns the error into a sentence."""

    def file(text: str) -> Path:
        path = named_file(text)
        if path.suffix.lower() not in kinds:
            raise argparse.ArgumentTypeError(f"{text} must end in {' or '.join(kinds)}")
        return path

    return file
