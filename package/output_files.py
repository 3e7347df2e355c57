# SPDX-License-Identifier: GPL-3.0-or-later
"""Files and folders that appear whole or not at all."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from types import TracebackType

from .core.atomic_files import FORMER, HIDDEN, hidden_place, put_in_place, restore_former
from .core.errors import ReebError
from .core.file_names import spelled
from .core.sentence import Sentence

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]


TRIES = 5  # how often a folder is put in its place, if others do the same
#: What is said of a folder that has just come or gone.
MOMENTARY = (errno.ENOENT, errno.ENOTEMPTY, errno.EEXIST)


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


def write_files(files: dict[Path, bytes], read: Path) -> None:
    """Write files beside their places, all of them, then put each in its place.

    Parameters
    ----------
    files : dict of Path -> bytes
        Folders are made where they are missing. Where a name is a link, the file that it leads to is replaced.
    read : Path
        What the run reads; it is not written over.

    Raises
    ------
    OutputFileError
        A file is what the run reads, a folder, or cannot be written. Then none is put in place.
    """
    names: dict[Path, Path] = {}  # of the user for what is written
    moves: dict[Path, Path] = {}
    try:
        for path, data in files.items():
            check_file(path, read)
            with as_output_error(path):
                target = Path(os.path.realpath(path))
                target.parent.mkdir(parents=True, exist_ok=True)
                place = hidden_place(target)
                moves[place], names[target] = target, path
                _write(place, data)
        put_in_place(moves, lambda target: as_output_error(names[target]))
    finally:
        for place in moves:
            with suppress(OSError):
                place.unlink(missing_ok=True)


def check_file(path: Path, read: Path) -> None:
    """Raise OutputFileError where ``write_files`` could not write a file: it is what the run reads, or a folder."""
    with as_output_error(path):
        if path.exists() and (not path.is_file() or _is_same(path, read)):
            raise OutputFileError(Sentence("{path} is read, or is no file. Choose another name.", path=path))


def check_folder(path: Path) -> None:
    """Raise OutputFileError where files cannot be written in a folder, as it is a file."""
    with as_output_error(path):
        if path.exists() and not path.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR))


def write_folder(folder: Path, files: dict[str, bytes]) -> None:
    """Write a folder with files in it, in place of one that is there: a moment between the two there is none.

    Parameters
    ----------
    folder : Path
        Where it is a link, the folder that it leads to is replaced.
    files : dict of str -> bytes
        By names in the folder, which may have folders in them.

    Raises
    ------
    OSError
        The folder cannot be written; what was there is there still.
    """
    folder = Path(os.path.realpath(folder))
    folder.parent.mkdir(parents=True, exist_ok=True)
    place = hidden_place(folder)
    place.mkdir()
    try:
        for name, data in files.items():
            path = place / spelled(name)
            path.parent.mkdir(parents=True, exist_ok=True)
            _write(path, data)
        _put_in_place(place, folder)
    finally:
        shutil.rmtree(place, ignore_errors=True)


def _put_in_place(place: Path, folder: Path) -> None:
    """``put_in_place`` of a folder, again where another run puts its own there in the same moment; raises OSError."""
    for left in reversed(range(TRIES)):
        try:
            put_in_place({place: folder}, nullcontext)
            return
        except OSError as error:
            if not left or error.errno not in MOMENTARY:
                raise


def remove_leftovers(folder: Path) -> None:
    """Remove what runs that were killed have left below a folder under hidden names, and bring back what they moved."""
    for base, folders, files in os.walk(folder):
        for name in [name for name in folders if name.startswith(HIDDEN)]:
            if name.startswith(FORMER):
                restore_former(Path(base) / name)
            else:
                shutil.rmtree(Path(base) / name, ignore_errors=True)
            folders.remove(name)
        for name in files:
            if name.startswith(HIDDEN):
                with suppress(OSError):
                    (Path(base) / name).unlink()


class SharedFolder:
    """A folder in which this run is while it lasts, as others may be: none removes what another one is writing.

    That is known by a lock on the folder, which ends with the process however that ends. On Windows, and on file
    systems without locks, a run takes itself to be alone.

    Parameters
    ----------
    folder : Path
        Which is there; raises OSError otherwise.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._handle = os.open(folder, os.O_RDONLY) if fcntl else -1

    def __enter__(self) -> SharedFolder:
        self._enter()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 place: TracebackType | None) -> None:
        if fcntl:
            os.close(self._handle)

    def remove_leftovers(self) -> bool:
        """``remove_leftovers``, unless another run is there as well; this one must not be writing.

        Returns whether this run is alone.
        """
        if fcntl:
            try:
                fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                self._enter()  # a lock that does not become another one may be lost
                return False
            except OSError:  # there are no locks here
                pass
        remove_leftovers(self.folder)
        self._enter()
        return True

    def _enter(self) -> None:
        """Let others know that this run is there."""
        if fcntl:
            with suppress(OSError):
                fcntl.flock(self._handle, fcntl.LOCK_SH)


def _write(path: Path, data: bytes) -> None:
    """Write a new file through to the disk."""
    with path.open("xb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _is_same(path: Path, other: Path) -> bool:
    """Whether two names are those of one file, which is there."""
    with suppress(OSError):
        return path.samefile(other)
    return False
