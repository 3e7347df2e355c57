# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices and faces of .obj files. Normals, texture coordinates, materials, names, curves and points do not matter."""

from __future__ import annotations

import re

import numpy as np

from .core.arrays.int64 import cumsum
from .polygons_in_files import cut_polygons, indices, places, plain_text

_COMMENT = re.compile(rb"#[^\n]*")
# A line that goes on in the next one, if there is one.
_CONTINUED = re.compile(rb"\\[ \t]*(?:\n|\Z)")
_VERTEX, _FACE, _EITHER = (re.compile(rb"^[ \t]*" + line, re.MULTILINE)
                           for line in (rb"v[ \t]([^\n]*)", rb"f[ \t]([^\n]*)", rb"([vf])[ \t]"))
# What follows the vertex in a corner: its texture coordinate and its normal.
_MORE = re.compile(rb"/\S*")


def parse_obj(text: bytes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Read the text of an .obj.

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
        Something that should be a number is none, a vertex has less than three, or a face has a vertex that is not
        there.
    """
    text = plain_text(text).replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    # Comments go first: a backslash at the end of one, as in the name of a folder, does not take the next line away.
    text = _CONTINUED.sub(b" ", _COMMENT.sub(b"", text))
    # A weight or a color may follow a position.
    return cut_polygons(places(_VERTEX.findall(text)), *_corners(text))


def _corners(text: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Vertex of each corner of all faces, (c,), from 0, -1 for none, and how many corners each has, (p,)."""
    rows = _MORE.sub(b"", b"\n".join(_FACE.findall(text))).split(b"\n")
    sizes = np.array([len(row.split()) for row in rows])
    corner = indices(b" ".join(rows).split())
    vertex = np.where(corner >= 0, corner - 1, corner)  # counted from 1: there is no vertex 0
    counted_back = corner < 0
    if counted_back.any():
        vertex[counted_back] += np.repeat(_n_before(text), sizes)[counted_back]
    return vertex, sizes


def _n_before(text: bytes) -> np.ndarray:
    """How many vertices stand before each face, (f,): a face counts back from there, where its indices are negative."""
    is_vertex = np.frombuffer(b"".join(_EITHER.findall(text)), np.uint8) == ord("v")
    return cumsum(is_vertex)[~is_vertex]
