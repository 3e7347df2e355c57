# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices and faces of .off files. Colors, normals and texture coordinates do not matter.

trimesh puts quads behind all triangles, and reads no larger polygons.
"""

from __future__ import annotations

import re

import numpy as np

from .core.arrays.int64 import cumsum
from .core.sentence import Sentence
from .damaged_files import DamagedFileError
from .polygons_in_files import cut_polygons, indices, places, plain_text

# Letters before the word tell what follows the position of a vertex; with 4 and n it has other than three coordinates.
_HEAD = re.compile(rb"\s*(?:ST)?C?N?(4?n?)OFF\b|\s*(4?n?)OFF(?=\d)|(?=\s*\d)", re.IGNORECASE)
_COMMENT = re.compile(rb"#[^\r\n]*")
# How many vertices and faces there are; edges may follow.
_COUNTS = re.compile(rb"\s*(-?\d+)\s+(-?\d+)\b[^\r\n]*")


def parse_off(text: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Read the text of an .off.

    Parameters
    ----------
    text : bytes
        As the file has it, with any ends of lines.

    Returns
    -------
    vertices, triangles, polygon
        As of ``cut_polygons``.

    Raises
    ------
    DamagedFileError
        It is none, ends before its last face, or a face has a vertex that is not there.
    """
    head = _HEAD.match(_COMMENT.sub(b"", plain_text(text)))
    if head is None or head[1] or head[2] or re.match(rb"[ \t]*BINARY", head.string[head.end():]):
        raise DamagedFileError(Sentence("it does not begin as an .off of words in three dimensions"))
    counts = _COUNTS.match(head.string, head.end())
    if counts is None:
        raise DamagedFileError(Sentence("it does not say how many vertices and faces it has"))
    n_vertices, n_faces = int(counts[1]), int(counts[2])
    lines = [line for line in map(bytes.strip, re.split(rb"[\r\n]+", head.string[counts.end():])) if line]
    rows = lines[n_vertices : n_vertices + n_faces]
    if n_vertices < 0 or n_faces < 0 or len(rows) < n_faces:
        raise DamagedFileError(Sentence("it ends before its last face"))
    return cut_polygons(places(lines[:n_vertices]), *_corners(rows))


def _corners(rows: list[bytes]) -> tuple[np.ndarray, np.ndarray]:
    """Vertex of each corner of all faces, (c,), and how many corners each has, (p,); a color may follow them."""
    sizes = indices([row.split(None, 1)[0] for row in rows])
    words = b" ".join(rows).split()
    if len(words) != len(sizes) + sizes.sum():
        faces = [row.split(None, size + 1)[: size + 1] for row, size in zip(rows, sizes.tolist(), strict=True)]
        words = [word for face in faces for word in face]
    # Each face begins with its size. One that lacks a corner moves all that follow it.
    starts = cumsum(sizes + 1) - sizes - 1
    numbers = indices(words)
    if len(numbers) != len(sizes) + sizes.sum() or (numbers[starts] != sizes).any() or (sizes < 0).any():
        raise DamagedFileError(Sentence("a face has fewer corners than it says"))
    return np.delete(numbers, starts), sizes
