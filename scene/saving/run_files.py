# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that a run writes: none is put in place before all are complete, and nothing that is read is written over.

Each is written under another name beside its place, or in a hidden folder there, read back, and moved to its place at
the very end together with the others.
"""

from __future__ import annotations

import errno
import os
import re
import shutil
import stat
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.atomic_files import HIDDEN, hidden_place, put_in_place, sync
from ...core.file_names import LONGEST_IN_BLENDER, is_too_long_for_blender, kind_of
from ...core.options import may_be_answer
from ..errors import SceneError


class RunFiles:
    """The files of one run; ``together`` makes it and puts them in place."""

    def __init__(self) -> None:
        self._read: set[object] = set()
        self._claimed: dict[Path, Path] = {}  # what is written, with its name as the user gave it
        self._moves: dict[Path, Path] = {}  # from where it is written to where it belongs
        self._made: list[Path] = []  # folders, and what is in them under other names
        self._outdated: dict[Path, None] = {}  # what an earlier run left, as a set in order

    def protect(self, paths: Iterable[Path | int]) -> None:
        """Remember files that the run reads. paths : names or open file descriptors.

        Raises
        ------
        SceneError
            One of them is a file that was claimed before.
        """
        for path in paths:
            self._read |= _identity(path)
        for target, name in self._claimed.items():
            self._check_not_read(target, name)

    def claim(self, path: Path, by_blender: bool = False) -> Path:
        """Say that a file will be written; returns where it really is.

        by_blender : bool, whether Blender writes it, which takes no name of any length.

        Raises
        ------
        SceneError
            It is none that can be replaced, the run reads it, it was claimed before, or its name is too long.
        """
        target = Path(os.path.realpath(path))
        try:
            kind = kind_of(path) or stat.S_IFREG
        except OSError as error:
            raise _unwritten(path, error) from error
        if not stat.S_ISREG(kind) or path.name in {"", ".", ".."}:
            raise SceneError(rpt_("{path} is no file but a folder or a device. Choose another name.").format(path=path))
        self._check_not_read(target, path)
        self._check_apart(target, path)
        if by_blender:
            _check_length(target, path)
            _check_length(_beside(target), path)
        self._claimed[target] = path
        return target

    def claim_folder(self, path: Path) -> None:
        """Say that files will be written in a folder, which may not be there yet; raises SceneError as ``claim``."""
        self._check_apart(Path(os.path.realpath(path)), path, folder=True)
        if os.path.lexists(path) and not os.path.isdir(path):
            raise _unwritten(path, NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR)))

    def withdraw_on_failure(self, path: Path) -> None:
        """Remove what an earlier run left under a claimed name, should this one fail."""
        self._outdated[Path(os.path.realpath(path))] = None

    def _check_not_read(self, target: Path, name: Path) -> None:
        if self._read & _identity(target):
            raise SceneError(
                rpt_("{path} is read, and would be written over. Choose another name.").format(path=name))

    def _check_apart(self, target: Path, name: Path, folder: bool = False) -> None:
        """Raise SceneError unless a file, or a folder, can be there beside all that was claimed."""
        for other, known in self._claimed.items():
            over = _identity(other) & _identity(target) or other in target.parents
            if over or (not folder and target in other.parents):
                self._outdated.pop(other, None)  # it may be meant as something else
                raise SceneError(
                    rpt_("{path} would be written over {other}. Give each file a name of its own.").format(
                        path=name, other=known))

    def folder(self, path: Path) -> None:
        """Make a folder and those that it is in, unless they are there; raises SceneError if that is not possible."""
        # What nobody can look at counts as missing here: to make it says why that is not possible.
        missing = [folder for folder in (path, *path.parents) if not os.path.exists(folder)]
        for folder in reversed(missing):
            self._made.append(folder)  # before it is there: an interruption may come between
            try:
                folder.mkdir()
            except OSError as error:
                self._made.pop()
                raise _unwritten(path, error) from error
        if not os.path.isdir(path):
            raise _unwritten(path, NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR)))

    @contextmanager
    def writing(self, path: Path, complete: Callable[[Path], bool], alone: bool = False) -> Iterator[Path]:
        """Write a file.

        Parameters
        ----------
        path : Path
            Its name; claimed now unless it was before.
        complete : callable(path) -> bool
            Whether all of the file is there; see ``file_checks``.
        alone : bool
            Write it under its own name in a folder of its own, with what comes beside it. Otherwise it is written in
            the folder that it belongs to, under another name.

        Yields
        ------
        path : Path
            Where to write.

        Raises
        ------
        SceneError
            It could not be written, or not all of it.
        """
        target = Path(os.path.realpath(path))
        if target not in self._claimed:
            self.claim(path)
        self.folder(target.parent)
        try:
            place = self._place(target, alone)
            yield place
            for file in sorted(place.parent.iterdir()) if alone else [place]:
                sync(file)
                if file != place:
                    self.claim(path.with_name(file.name))
                self._moves[file] = target.with_name(target.name if file == place else file.name)
            if not complete(place):
                raise SceneError(rpt_("{path} could not be written whole. Is the disk full?").format(path=path))
        except (OSError, RuntimeError) as error:  # what Blender's operators report arrives as RuntimeError
            raise _unwritten(path, error) from error

    def _place(self, target: Path, alone: bool) -> Path:
        """Where to write what belongs to a target."""
        if alone:
            made = hidden_place(target)
            self._made.append(made)  # before it is there: an interruption may come between
            _check_length(made / target.name, self._claimed[target])  # Blender's exporters write what is alone
            made.mkdir(mode=0o700)
            return made / target.name
        place = _beside(target)
        self._made.append(place)
        return place

    def move(self) -> None:
        """Put all files in their places, or none: raises SceneError."""
        put_in_place(self._moves, self._moving)
        self._made = [path for path in self._made if path.name.startswith(HIDDEN)]

    @contextmanager
    def _moving(self, target: Path) -> Iterator[None]:
        """Raise SceneError, by the user's name for a file, in place of any OSError."""
        try:
            yield
        except OSError as error:
            raise _unwritten(self._claimed.get(target, target), error) from error

    def withdraw(self) -> None:
        """Remove the files of ``withdraw_on_failure``, unless the run reads them or they are something else."""
        for target in self._outdated:
            if not self._read & _identity(target):
                with suppress(OSError):
                    if may_be_answer(target):
                        target.unlink()

    def clean(self) -> None:
        """Remove what is left: files that were not put in place, and folders made for them."""
        for path in reversed(self._made):
            if path.name.startswith(HIDDEN):
                shutil.rmtree(path, ignore_errors=True)
                with suppress(OSError):
                    path.unlink(missing_ok=True)
            else:
                with suppress(OSError):  # somebody else has put something into it
                    path.rmdir()


@contextmanager
def together() -> Iterator[RunFiles]:
    """Files that appear when the block ends, all of them; none if it raises. What the open scene reads is protected."""
    files = RunFiles()
    files.protect(scene_files())
    try:
        yield files
        files.move()
    except BaseException:
        files.withdraw()
        raise
    finally:
        files.clean()


def scene_files() -> list[Path]:
    """What the open scene was read from, and all files that it names: images, libraries, sounds ..."""
    opened = [bpy.data.filepath] if bpy.data.filepath else []
    return [Path(path) for path in (*opened, *bpy.utils.blend_paths(absolute=True))]


def _identity(path: Path | int) -> set[object]:
    """What a file is known by: its place, and its number if it is there."""
    known: set[object] = set() if isinstance(path, int) else {os.path.normcase(os.path.realpath(path))}
    with suppress(OSError):
        found = os.stat(path)
        if stat.S_ISREG(found.st_mode) and found.st_ino:
            known.add((found.st_dev, found.st_ino))
    return known


def _beside(target: Path) -> Path:
    """Where to write a file: in its own folder, as a scene's paths to its pictures are relative to where it is."""
    return hidden_place(target, target.suffix[:20])


def _check_length(place: Path, name: Path) -> None:
    """Raise SceneError if Blender would cut the name of a file short. name : as the user gave it."""
    if is_too_long_for_blender(place):
        raise SceneError(rpt_("{path} could not be written: Blender takes names of up to {n} bytes, with all folders."
                              ).format(path=name, n=LONGEST_IN_BLENDER))


def _unwritten(path: Path, error: Exception) -> SceneError:
    """The sentence that a file could not be written, by the user's name for it."""
    return SceneError(rpt_("{path} could not be written: {reason}").format(path=path, reason=reason(error)))


def reason(error: Exception) -> str:
    """Why something failed, without the names of temporary files and of places in the code."""
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Location: ")]
    # Operators in Python report their whole traceback.
    last = lines[-1].strip() if lines else type(error).__name__
    return re.sub(r"^(Error|\w+Error): (\[Errno \d+\] )?", "", last)
