# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files: such as every file system takes, and such as JSON and tables can hold."""

from __future__ import annotations

import os
import re
import stat
import unicodedata
from pathlib import Path

#: Names that stand for devices on Windows, whatever follows a first dot.
DEVICES = re.compile(r"(con|prn|aux|nul|(com|lpt)[0-9¹²³])\s*(\.|$)", re.IGNORECASE)

LONGEST_IN_BLENDER = 1023  # bytes of a path


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


def spelled(name: str) -> str:
    """A text as the name of a file here: where the locale lacks its letters, as LC_ALL=C, by the bytes of its UTF-8.

    Names that come from the system are spelled so already; those that are made of texts are not.
    """
    try:
        os.fsencode(name)
    except UnicodeEncodeError:
        return os.fsdecode(name.encode(errors="surrogateescape"))
    return name


def kind_of(path: str | Path) -> int:
    """What is behind a name: ``stat.S_IFREG``, ``stat.S_IFDIR`` and such, 0 if nothing is.

    Raises OSError where nobody can say, as in a folder that one may not enter; ``Path.exists`` does so, or not, by the
    version of Python.
    """
    try:
        return stat.S_IFMT(os.stat(path).st_mode)
    except (FileNotFoundError, NotADirectoryError, ValueError):  # the last of a name with a zero in it
        return 0


def is_too_long_for_blender(path: Path) -> bool:
    """Whether Blender cuts the absolute name of a file short, and would then look for another one."""
    return len(os.fsencode(path.resolve())) > LONGEST_IN_BLENDER


def file_name(text: str, default: str) -> str:
    """A text without what a file system might not like, with room for a suffix; ``default`` where nothing is left."""
    plain = re.sub(r"[^\w .()+-]", "_", unicodedata.normalize("NFC", text))
    plain = plain.encode()[:200].decode(errors="ignore").strip(" .") or default
    return f"_{plain}" if DEVICES.match(plain) else plain
