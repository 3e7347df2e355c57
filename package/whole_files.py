# SPDX-License-Identifier: GPL-3.0-or-later
"""Files and folders that appear whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from .core.errors import ReebError
from .core.sentence import Sentence

HIDDEN = ".reeb_parts_"  # how names begin under which files and folders are written


class OutputFileError(ReebError, OSError):
    """A file cannot be written; the message says why."""


@contextmanager
def as_output_error(path: Path) -> Iterator[None]:
    """Raise OutputFileError, which names a path, in place of any OSError."""
    try:
        yield
    except OutputFileError:
        raise
    except OSError as error:
        raise OutputFileError(Sentence("{path} could not be written: {reason}", path=path,
                                       reason=error.strerror or error)) from error


def readable(name: str | Path) -> str:
    """A name of a file as a text for JSON and tables: the same if it can be, else with its strange bytes as \\xdf.

    Systems other than Windows allow names that are no UTF-8, such as those that old archives bring along.
    """
    text = str(name)
    try:
        text.encode()
    except UnicodeEncodeError:
        return os.fsencode(text).decode(errors="backslashreplace")
    return text


def write_files(files: dict[Path, bytes], read: Path) -> None:
    """Write files beside their places, all of them, then put each in its place.

    Parameters
    ----------
    files : dict of Path -> bytes
        Folders are made where they are missing.
    read : Path
        What the run reads; it is not written over.

    Raises
    ------
    OutputFileError
        A file is what the run reads, a folder, or cannot be written. Then none is put in place; only if a file that is
        written cannot be moved, those before it are.
    """
    moves: dict[Path, Path] = {}
    try:
        for path, data in files.items():
            with as_output_error(path):
                if path.exists() and (not path.is_file() or path.samefile(read)):
                    raise OutputFileError(Sentence("{path} is read, or is no file. Choose another name.", path=path))
                path.parent.mkdir(parents=True, exist_ok=True)
                place = path.with_name(f"{HIDDEN}{os.getpid()}_{len(moves)}")
                moves[place] = path
                _write(place, data)
        for place, path in moves.items():
            with as_output_error(path):
                place.replace(path)
    finally:
        for place in moves:
            with suppress(OSError):
                place.unlink(missing_ok=True)


def write_folder(folder: Path, files: dict[str, bytes]) -> None:
    """Write a folder with files in it, in place of one that is there: a moment between the two there is none.

    Parameters
    ----------
    folder : Path
    files : dict of str -> bytes
        By names in the folder, which may have folders in them.

    Raises
    ------
    OSError
        The folder cannot be written; what was there is there still, unless its place was taken meanwhile.
    """
    folder.parent.mkdir(parents=True, exist_ok=True)
    place = Path(tempfile.mkdtemp(prefix=HIDDEN, dir=folder.parent))
    try:
        place.chmod(0o777 & ~_UMASK)
        for name, data in files.items():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            (place / name).write_bytes(data)
        if folder.exists():
            former = Path(tempfile.mkdtemp(prefix=HIDDEN, dir=folder.parent))
            folder.replace(former / folder.name)
            place.replace(folder)
            shutil.rmtree(former, ignore_errors=True)
        else:
            place.replace(folder)
    finally:
        shutil.rmtree(place, ignore_errors=True)


def remove_leftovers(folder: Path) -> None:
    """Remove what runs that were killed have left below a folder under hidden names."""
    for base, folders, files in os.walk(folder):
        for name in [name for name in folders if name.startswith(HIDDEN)]:
            shutil.rmtree(Path(base) / name, ignore_errors=True)
            folders.remove(name)
        for name in files:
            if name.startswith(HIDDEN):
                with suppress(OSError):
                    (Path(base) / name).unlink()


def _write(path: Path, data: bytes) -> None:
    """Write a file through to the disk."""
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _umask() -> int:
    """The mask of permissions that the process has."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


_UMASK = _umask()
