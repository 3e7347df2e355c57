# SPDX-License-Identifier: GPL-3.0-or-later
"""How files and folders that were written under hidden names get to their places: all or none."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager, suppress
from pathlib import Path

HIDDEN = ".reeb_parts_"  # how names begin under which files and folders are written
FORMER = f"{HIDDEN}former_"  # how those of folders begin that keep what was in a place before


def hidden_place(target: Path, suffix: str = "", beginning: str = HIDDEN) -> Path:
    """A name beside a file or a folder that nobody can guess, and put a link to somewhere else there."""
    return target.with_name(f"{beginning}{secrets.token_hex(8)}{suffix}")


def put_in_place(moves: Mapping[Path, Path], about: Callable[[Path], AbstractContextManager[object]]) -> None:
    """Move files or folders from where they were written to where they belong, all of them or none.

    Parameters
    ----------
    moves : mapping of Path -> Path
        Each is moved within its folder. What is in a place is replaced: a file by a file, a folder by a folder.
    about : callable(target) -> context manager
        Makes of an OSError that comes with a target the error that is raised.

    Notes
    -----
    A single file is replaced at once. Of several files a second name of each former one is kept until all are there,
    and where the file system has no second names, as for folders, there is a moment without one. A process that is
    killed meanwhile leaves what was there as ``FORMER``, see ``restore_former``.
    """
    formers: dict[Path, Path] = {}
    for place, target in moves.items():
        with about(target):
            os.lstat(place)  # what is not there later has been moved
    try:
        for place, target in moves.items():
            with about(target):
                if _is_kept(place, target, len(moves)):
                    formers[target] = hidden_place(target, beginning=FORMER)  # before it is there
                    _keep(target, formers[target])
                os.replace(place, target)
        for folder in {target.parent for target in moves.values()}:
            with suppress(OSError):  # not every system can write a folder through to the disk
                sync(folder)
    except BaseException:
        for place, target in moves.items():
            with suppress(OSError):
                _take_back(place, target, formers.get(target))
        raise
    finally:
        try:
            _restore(formers.values())
        except BaseException:  # such as Ctrl+C
            _restore(formers.values())
            raise


def _is_kept(place: Path, target: Path, count: int) -> bool:
    """Whether what is in a place has to be kept until all have moved; what cannot be replaced stays where it is."""
    if not os.path.lexists(target) or target.is_dir() != place.is_dir():
        return False
    return count > 1 or target.is_dir()


def _keep(target: Path, former: Path) -> None:
    """Give what is in a place a second name in a folder, or another one where it cannot have two; raises OSError."""
    former.mkdir(mode=0o700)
    kept = former / target.name
    if not target.is_dir():
        with suppress(OSError):
            os.link(target, kept)
            return
    os.replace(target, kept)


def _take_back(place: Path, target: Path, former: Path | None) -> None:
    """Undo a move, if there was one, and bring back what was there before; raises OSError."""
    if not os.path.lexists(place):
        os.replace(target, place)
    if former is not None and os.path.lexists(former / target.name):
        os.replace(former / target.name, target)


def _restore(formers: Iterable[Path]) -> None:
    for former in formers:
        restore_former(former)


def restore_former(former: Path) -> None:
    """Remove a folder of ``FORMER``, but bring back first what was kept in it and has no other place any more."""
    with suppress(OSError):
        for kept in former.iterdir():
            target = former.with_name(kept.name)
            if not os.path.lexists(target):
                os.replace(kept, target)
        shutil.rmtree(former)


def sync(path: Path) -> None:
    """Have a file or a folder written to the disk; raises OSError if there is no room."""
    # Windows takes a file that it opens as text for one that ends before a last Ctrl+Z, and cuts off this byte.
    handle = os.open(path, os.O_RDONLY if os.name == "posix" else os.O_RDWR | getattr(os, "O_BINARY", 0))
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
