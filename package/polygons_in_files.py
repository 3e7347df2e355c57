# SPDX-License-Identifier: GPL-3.0-or-later
"""What the readers of .obj, .off and .ply have in common, and those of lists."""

from __future__ import annotations

from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE
from typing import Any

import numpy as np

from .core.mesh.ears import triangulated
from .core.sentence import Sentence
from .damaged_files import DamagedFileError

#: What is wrong with many a damaged file.
NOT_THERE = Sentence("a face has a vertex that is not there")
NO_PLACES = Sentence("its vertices have no x, y and z")
_SHOWN = 40  # letters of a word that is no number


def plain_text(data: bytes) -> bytes:
    """The bytes of a text, without the mark with which some editors begin it; in UTF-8 if it is in UTF-16.

    PowerShell writes UTF-16 where the output of a program is sent to a file.
    """
    if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        data = data.decode("utf-16", errors="replace").encode()
    return data.removeprefix(BOM_UTF8)


def places(rows: list[bytes]) -> np.ndarray:
    """The first three numbers of each row of words, (n, 3) float64; raises DamagedFileError where there are less."""
    words = [row.split(None, 3)[:3] for row in rows]
    if min(map(len, words), default=3) < 3:
        raise DamagedFileError(Sentence("a vertex has fewer than three coordinates"))
    try:
        return np.array(words, np.bytes_).astype(np.float64) if words else np.empty((0, 3))
    except ValueError as error:
        wrong = _first_refused([word for row in words for word in row], np.float64)
        raise DamagedFileError(Sentence("{word} is no coordinate", word=wrong)) from error


def indices(words: list[bytes]) -> np.ndarray:
    """Words as the numbers of vertices, or of corners, (k,) int64; raises DamagedFileError where one is none."""
    try:
        return np.array(words, np.bytes_).astype(np.int64) if words else np.empty(0, np.int64)
    except (ValueError, OverflowError) as error:
        wrong = _first_refused(words, np.int64)
        raise DamagedFileError(Sentence("{word} stands where a face has the number of a vertex or of its corners",
                                        word=wrong)) from error


def _first_refused(words: list[bytes], kind: type[np.number[Any]]) -> str:
    """The first word that is no number of a kind, as it can be shown; empty if all are."""
    for word in words:
        try:
            np.array(word, np.bytes_).astype(kind)
        except (ValueError, OverflowError):
            return repr(word)[2:-1][:_SHOWN]
    return ""


def cut_polygons(
    vertices: np.ndarray, corner: np.ndarray, sizes: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cut the polygons of a file into triangles.

    Parameters
    ----------
    vertices : (n, 3) float64
        All of the file, also those of no face.
    corner : (c,) int64
        Vertex of each corner of all faces, one face after the other.
    sizes : (p,) int64
        Number of corners of each face; those of less than three are no polygons.

    Returns
    -------
    vertices : (n, 3) float64
        As they were given.
    triangles : (m, 3) int64
        In the order of the faces; of a polygon its fan, or other triangles where that is folded.
    polygon : (m,) int64
        Polygon of each triangle, from 0.

    Raises
    ------
    DamagedFileError
        A face has a vertex that is not there.
    """
    if ((corner < 0) | (corner >= len(vertices))).any():
        raise DamagedFileError(NOT_THERE)
    is_polygon = sizes > 2
    return vertices, *triangulated(vertices, corner[np.repeat(is_polygon, sizes)], sizes[is_polygon])
