# SPDX-License-Identifier: GPL-3.0-or-later
"""The models of a batch: files in folders, by patterns or in lists, each with a name by which its results are found."""

from __future__ import annotations

import errno
import glob
import os
import stat
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ..core.errors import ReebError
from ..core.file_names import kind_of, readable, spelled
from ..core.sentence import Sentence
from ..polygons_in_files import plain_text
from .records import RECORD, read_record

FOLDERS = "models"  # where the folders of all models are, in that of the results


class SourceError(ReebError):
    """There are no models where the user said; the message says where."""


@dataclass(frozen=True)
class Source:
    """A model of a batch.

    Attributes
    ----------
    path : Path
        Absolute.
    name : str
        Its path below the root of the batch, with slashes: what its results are called; see ``readable``.
    """

    path: Path
    name: str


def find_sources(places: Iterable[str], kinds: tuple[str, ...], out: Path, root: Path | None = None,
                 unread: Callable[[OSError], object] | None = None, gone: Iterable[str] = ()) -> list[Source]:
    """Find all models.

    Parameters
    ----------
    places : iterable of str
        Folders, which are searched with all that is in them, patterns such as ``"*.obj"`` and ``"**/*.ply"``, files.
    kinds : tuple of str
        Suffixes of models in folders, small letters. A file that is named or fits a pattern may have any.
    out : Path
        Folder of the results. It may have models in it; what runs made, there and elsewhere, is none.
    root : Path, optional
        What names begin below; without it the folder that is a place, or the innermost one that holds all places.
    unread : callable(error), optional
        Told of each folder below a place, or on the way of a pattern, in which nobody can look, and of each model
        that is left out as another one has its name.
    gone : iterable of str, optional
        Files that are not there, but were or will be: the others have the names that they have beside these.

    Returns
    -------
    sources : list of Source
        Each file once, sorted by name.

    Raises
    ------
    SourceError
        A place is none, there is no model anywhere, places are on several drives, a model lies outside the root, or
        where its results belong.
    """
    out = Path(os.path.abspath(out))
    places = list(places)
    paths = {path for place in places for path in _paths(place, kinds, unread)}
    if not paths:
        raise SourceError(Sentence("There is no model to decompose."))
    if root is None:
        # Not that of the models: all would have other names, and be done again, when one comes or goes.
        root = _common_folder([*places, *gone])
    root = Path(os.path.abspath(root))
    outside = sorted(path for path in paths if not path.is_relative_to(root))
    if outside:
        raise SourceError(Sentence("{n} {n:model is|models are} not in {root} (first: {first}).", n=len(outside),
                                   root=root, first=outside[0]))
    named = (Source(path, readable(path.relative_to(root).as_posix())) for path in paths)
    sources = _without_namesakes(sorted(named, key=lambda source: (source.name, source.path)), unread)
    _check_folders(sources, out)
    return sources


def is_gone(place: str, kinds: tuple[str, ...]) -> bool:
    """Whether a place is named as a model is, but there is none, or none that anybody can reach.

    place : str. kinds : tuple of str, as ``find_sources`` takes them.
    """
    try:
        there = kind_of(place) or glob.has_magic(place)
    except OSError:
        there = False
    return not there and os.path.splitext(place)[1].lower() in kinds


def folder_of(out: Path, name: str) -> Path:
    """Where the results of the model of a name are."""
    return out / FOLDERS / spelled(name)


def _without_namesakes(sources: list[Source], unread: Callable[[OSError], object] | None) -> list[Source]:
    """Leave out models that have the name of one before them: a byte that is no UTF-8 is named by letters, as \\xdf."""
    kept: dict[str, Source] = {}
    for source in sources:
        if kept.setdefault(source.name, source) is not source and unread is not None:
            unread(FileExistsError(errno.EEXIST, "another model has its name", str(source.path)))
    return list(kept.values())


def _check_folders(sources: list[Source], out: Path) -> None:
    """Raise SourceError if the results of a model would take the place of one."""
    folders = {folder_of(out, source.name) for source in sources}
    lost = [source.path for source in sources if not folders.isdisjoint((source.path, *source.path.parents))]
    if lost:
        raise SourceError(Sentence("Results would take the place of {n} {n:model|models} (first: {first}). Choose "
                                   "another folder for --out.", n=len(lost), first=lost[0]))


def _common_folder(places: list[str]) -> Path:
    """The innermost folder that holds all places; raises SourceError if there is none."""
    try:
        return Path(os.path.commonpath([_folder_of(place) for place in places]))
    except ValueError as error:  # on Windows
        raise SourceError(Sentence("Models are on several drives: give each drive a run, and an --out, of its own.")
                          ) from error


def _folder_of(place: str) -> str:
    """The folder that a place is, in which it is, or in which its pattern begins; absolute."""
    if os.path.isdir(place):
        return os.path.abspath(place)
    if not os.path.isfile(place):
        while glob.has_magic(place):
            place = os.path.dirname(place)
        return os.path.abspath(place)
    return os.path.dirname(os.path.abspath(place))


def _look_into(pattern: str, unread: Callable[[OSError], object] | None) -> None:
    """Tell of folders in which a pattern looks for names, or for one, and nobody can: it would find nothing there."""
    folder, name = os.path.split(pattern)
    if unread is None or not glob.has_magic(pattern):
        return
    if folder != pattern:
        _look_into(folder, unread)
    for found in glob.iglob(os.path.join(folder, ""), recursive=True) if glob.has_magic(folder) else [folder or "."]:
        try:
            if glob.has_magic(name):
                os.scandir(found).close()
            else:
                os.stat(os.path.join(found, name))
        except OSError as error:
            error.filename = os.path.abspath(found)
            unread(error)


def _paths(place: str, kinds: tuple[str, ...], unread: Callable[[OSError], object] | None) -> Iterator[Path]:
    """Absolute paths of the models of one place: a folder, a file or a pattern. Raises SourceError."""
    path = Path(place)
    try:
        kind = kind_of(path)
    except OSError as error:  # such as a folder that one may not enter
        raise SourceError(Sentence("{path} could not be read: {reason}", path=path,
                                   reason=error.strerror or error)) from error
    if stat.S_ISDIR(kind):
        yield from _in_folder(path, kinds, unread)
    elif stat.S_ISREG(kind):
        yield Path(os.path.abspath(path))
    elif glob.has_magic(place):
        yield from _of_pattern(place, unread)
    else:
        raise SourceError(Sentence("There is no file and no folder {place}.", place=place))


def _in_folder(path: Path, kinds: tuple[str, ...], unread: Callable[[OSError], object] | None) -> Iterator[Path]:
    """Absolute paths of the models in a folder and those in it, without what is hidden or was made by a run."""
    for base, folders, files in os.walk(path, onerror=unread):
        if _is_of_a_run(base):
            folders.clear()
            continue
        folders[:] = [name for name in folders if not name.startswith(".")]
        for name in files:
            if os.path.splitext(name)[1].lower() in kinds and not name.startswith("."):
                yield Path(os.path.abspath(os.path.join(base, name)))


def _of_pattern(pattern: str, unread: Callable[[OSError], object] | None) -> Iterator[Path]:
    """Absolute paths of the files of a pattern, of any kind, without what was made by a run."""
    _look_into(os.path.join(pattern, "*") if pattern.endswith("**") else pattern, unread)
    for found in glob.iglob(pattern, recursive=True):
        if os.path.isfile(found) and not any(map(_is_of_a_run, Path(os.path.abspath(found)).parents)):
            yield Path(os.path.abspath(found))


@cache
def _is_of_a_run(folder: str | Path) -> bool:
    """Whether a folder holds what a run, this or an earlier one, made of a model."""
    return os.path.isfile(os.path.join(folder, RECORD)) and read_record(Path(folder)) is not None


def read_list(path: Path) -> list[str]:
    """Places of a list, one a line; empty lines and those that begin with # are none. Raises SourceError.

    Names are the bytes of the list, which need not be UTF-8 where the system allows others.
    """
    try:
        lines = [os.fsdecode(line.strip()) for line in plain_text(path.read_bytes()).splitlines()]
    except (OSError, UnicodeDecodeError) as error:
        raise SourceError(Sentence("{path} could not be read: {reason}", path=path,
                                   reason=getattr(error, "strerror", None) or error)) from error
    return [line for line in lines if line and not line.startswith("#")]
