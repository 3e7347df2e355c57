# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of .stl files, of words or binary. Normals, colors and names do not matter.

trimesh looks for words in names, too, finds nothing in a text without its last line, and drops faces with coordinates
that are no numbers where a text has several solids, so that labels were for others.
"""

from __future__ import annotations

import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE

import numpy as np

from .core.arrays.int64 import arange
from .core.sentence import Sentence
from .damaged_files import DamagedFileError
from .polygons_in_files import places, plain_text

_FACET = re.compile(rb"\bfacet\s+normal", re.IGNORECASE)
_FACET_END = re.compile(rb"\bendfacet\b", re.IGNORECASE)
_VERTEX = re.compile(rb"\bvertex\s+(\S+\s+\S+\s+\S+)", re.IGNORECASE)
# The name of a solid, in which there may be any words, with what stands before it: a face, in one line.
_NAME = re.compile(rb"\b(?:end)?solid\b[^\n]*?(?=\bfacet\s+normal(?:\s+[-+.\w]+){3}\s+outer\b|\n|\Z)", re.IGNORECASE)
_HEAD, _FACE = 84, 50  # bytes before the first face of a binary file, and of each
_ENDS = Sentence("it ends before its last face")


def parse_stl(data: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Read an .stl.

    Parameters
    ----------
    data : bytes
        As the file has it.

    Returns
    -------
    vertices : (3 m, 3) float64
        Three of each face, as the file has them.
    triangles : (m, 3) int64
        In the order of the file, of all its solids.
    polygon : (m,) int64
        Each triangle is one.

    Raises
    ------
    DamagedFileError
        It ends before its last face, has the size of more faces behind it, or something that should be a number is
        none.
    """
    corners = _of_numbers(data) if _is_binary(data) else _of_words(plain_text(data).replace(b"\r", b"\n"))
    return corners, arange(len(corners)).reshape(-1, 3), arange(len(corners) // 3)


def _is_binary(data: bytes) -> bool:
    """Whether a file has numbers, not words, behind its head, which may begin as a text does."""
    if len(data) == _end(data):
        return True
    is_text = data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) or _FACET.search(data)
    return not is_text and b"\0" in data[_HEAD - 4:]


def _end(data: bytes) -> int:
    """Where the last face of a binary file ends, as its head says."""
    return _HEAD + _FACE * int.from_bytes(data[_HEAD - 4:_HEAD], "little")


def _of_numbers(data: bytes) -> np.ndarray:
    """Corners of all faces, (3 m, 3) float64, of a binary file; some programs write more behind the last one.

    Raises DamagedFileError where faces are missing, or where what is behind the last one has the size of more faces.
    """
    end = _end(data)
    if len(data) < end:
        raise DamagedFileError(_ENDS)
    behind = data[end:]
    if len(behind) % _FACE == 0 and any(behind):
        raise DamagedFileError(Sentence(
            "its head counts {n} {n:face|faces}, and as many bytes as {more} more have follow",
            n=(end - _HEAD) // _FACE, more=len(behind) // _FACE))
    faces = np.frombuffer(data[_HEAD:end], [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("color", "<u2")])
    return faces["corners"].reshape(-1, 3).astype(np.float64)


def _of_words(text: bytes) -> np.ndarray:
    """Corners of all faces, (3 m, 3) float64, of a text; its last line may be missing."""
    text = _NAME.sub(b"", text)
    n_faces, rows = len(_FACET.findall(text)), _VERTEX.findall(text)
    if len(_FACET_END.findall(text)) < n_faces:
        raise DamagedFileError(_ENDS)
    if len(rows) != 3 * n_faces:
        raise DamagedFileError(Sentence("a face has other than three corners"))
    return places(rows)
