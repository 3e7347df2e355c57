# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices and faces of .ply files, of words or binary, by plyfile. Colors, normals and other elements do not matter.

trimesh takes all faces of a binary file to have as many corners as the first, cuts quads apart so that their second
halves stand behind all others, and splits vertices where a texture has a seam.
"""

from __future__ import annotations

import re
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import takewhile
from pathlib import Path
from typing import IO, TYPE_CHECKING

import numpy as np

from .core.arrays.int64 import arange, cumsum, full
from .damaged_files import DamagedFileError, read_by
from .polygons_in_files import NO_PLACES, cut_polygons

if TYPE_CHECKING:
    from plyfile import PlyData, PlyElement

#: What programs call the list of a face's vertices.
_CORNERS = ("vertex_indices", "vertex_index")
_BINARY = re.compile(rb"[\r\n]format[ \t]+binary")
#: Bytes by which to translate those of a text: question marks for what is not ASCII.
ASCII = bytes(range(128)) + b"?" * 128


def read_ply(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Read a .ply.

    Parameters
    ----------
    path : Path

    Returns
    -------
    vertices, triangles, polygon
        As of ``cut_polygons``.

    Raises
    ------
    plyfile.PlyHeaderParseError
        The header is damaged, or has a type of numbers that plyfile does not know.
    DamagedFileError
        The rest is damaged, or a part of it is missing; a vertex has no position, or a face has a vertex that is not
        there.
    OSError
        The file cannot be read.
    """
    from plyfile import PlyHeaderParseError

    with read_by("plyfile", PlyHeaderParseError):
        data = _data(path)
    if "vertex" not in data:
        return np.empty((0, 3)), np.empty((0, 3), np.int64), np.empty(0, np.int64)
    vertices = _places(data["vertex"])
    corner, sizes = _corners(data["face"]) if "face" in data else (np.empty(0, np.int64), np.empty(0, np.int64))
    triangles = _of_strips(data["tristrips"]) if "tristrips" in data else np.empty((0, 3), np.int64)
    return cut_polygons(vertices, np.append(corner, triangles), np.append(sizes, full(len(triangles), 3)))


def _data(path: Path) -> PlyData:
    """All elements of a file."""
    from plyfile import PlyData, PlyElementParseError

    header = _header(path)
    if not _BINARY.search(header):
        # What is not ASCII is in names and comments.
        with path.open(encoding="ascii", errors="ignore") as text, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of lists without numbers
            return PlyData.read(text)
    with _with_ascii(path, header) as file:
        # plyfile reads faces of equal sizes at once, if it is told the size, and others one by one.
        for size in (3, 4):
            try:
                return PlyData.read(file, known_list_len={
                    "face": {**dict.fromkeys(_CORNERS, size), "texcoord": 2 * size}})
            except PlyElementParseError:
                file.seek(0)
        return PlyData.read(file)


def _header(path: Path) -> bytes:
    """The header of a file, all of the file if it has no end."""
    with path.open("rb") as file:
        lines = takewhile(lambda line: not line.startswith(b"end_header"), file)
        return b"".join(lines).partition(b"end_header")[0]  # of old Macs' files all is one line


@contextmanager
def _with_ascii(path: Path, header: bytes) -> Iterator[IO[bytes]]:
    """A binary file with question marks for what is not ASCII in its header, open."""
    with path.open("rb") as file:
        if header.isascii():
            yield file
            return
        data = file.read()
    with tempfile.TemporaryFile() as copy:  # plyfile maps it into memory
        copy.write(header.translate(ASCII) + data[len(header):])
        copy.seek(0)
        yield copy


def _places(vertex: PlyElement) -> np.ndarray:
    """Positions of all vertices, (n, 3) float64; raises DamagedFileError where they have none."""
    from plyfile import PlyListProperty

    numbers = {entry.name for entry in vertex.properties if not isinstance(entry, PlyListProperty)}
    if not numbers.issuperset("xyz"):
        raise DamagedFileError(NO_PLACES)
    return np.stack([vertex[axis] for axis in "xyz"], axis=1).astype(np.float64)


def _of_strips(strips: PlyElement) -> np.ndarray:
    """Triangles of strips, (m, 3): every three vertices that follow each other, every second time turned around.

    -1 ends a strip within a row, as the 3D scans of Stanford have it; a vertex that comes twice joins two strips.
    """
    corner, sizes = _rows(strips)
    place = arange(len(corner))
    begins = np.zeros(len(corner), bool)
    begins[(cumsum(sizes) - sizes)[sizes > 0]] = True
    begins[1:] |= corner[:-1] == -1
    in_strip = place - np.maximum.accumulate(np.where(begins, place, 0))
    last = np.flatnonzero((in_strip >= 2) & (corner != -1))
    turned = in_strip[last] % 2
    triangles = np.stack([corner[last - 2 + turned], corner[last - 1 - turned], corner[last]], axis=1)
    return triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]


def _corners(face: PlyElement) -> tuple[np.ndarray, np.ndarray]:
    """Vertex of each corner of all polygons, (c,), and how many corners each polygon has, (p,), 3 or more."""
    corner, sizes = _rows(face)
    is_polygon = sizes > 2
    return corner[np.repeat(is_polygon, sizes)], sizes[is_polygon]


def _rows(element: PlyElement) -> tuple[np.ndarray, np.ndarray]:
    """All vertices that an element lists, (c,) int64, and how many there are in each of its rows, (p,)."""
    from plyfile import PlyListProperty

    lists = [entry.name for entry in element.properties if isinstance(entry, PlyListProperty)]
    name = next((name for name in (*_CORNERS, *lists) if name in lists), None)
    rows = element[name] if name and len(element) else np.empty((0, 3), np.int64)
    if rows.ndim == 2:
        return rows.ravel().astype(np.int64), full(len(rows), rows.shape[1])
    return np.concatenate(rows).astype(np.int64), np.array([len(row) for row in rows])
