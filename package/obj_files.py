# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices and faces of .obj files. Normals, texture coordinates, materials, names, curves and points do not matter."""

from __future__ import annotations

import re

import numpy as np

from .core.surface.ears import triangulated

_MARK = b"\xef\xbb\xbf"  # some editors begin files in UTF-8 with it
_COMMENT = re.compile(rb"#[^\n]*")
# A line that goes on in the next one.
_CONTINUED = re.compile(rb"\\[ \t]*\n")
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
    vertices : (n, 3) float64
        All of the file, also those of no face.
    triangles : (m, 3) int64
        In the order of the faces; of a polygon its fan, or other triangles where that is folded.
    polygon : (m,) int64
        Face of each triangle, from 0; lines with less than three corners are no faces.

    Raises
    ------
    ValueError
        Something that should be a number is none, a vertex has less than three, or a face has a vertex that is not
        there.
    """
    text = text.removeprefix(_MARK).replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    # Comments go first: a backslash at the end of one, as in the name of a folder, does not take the next line away.
    text = _CONTINUED.sub(b" ", _COMMENT.sub(b"", text))
    vertices = _vertices(text)
    corner, sizes = _corners(text, len(vertices))
    return vertices, *triangulated(vertices, corner, sizes)


def _vertices(text: bytes) -> np.ndarray:
    """Positions, (n, 3); a weight or a color may follow them."""
    rows = [row.split(None, 3)[:3] for row in _VERTEX.findall(text)]
    return np.array(rows, np.bytes_).astype(np.float64) if rows else np.empty((0, 3))


def _corners(text: bytes, n_vertices: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertex of each corner of all polygons, (c,), from 0, and how many corners each polygon has, (p,), 3 or more."""
    rows = _MORE.sub(b"", b"\n".join(_FACE.findall(text))).split(b"\n")
    sizes = np.array([len(row.split()) for row in rows])
    names = b" ".join(rows).split()
    corner = np.array(names, np.bytes_).astype(np.int64) if names else np.empty(0, np.int64)
    vertex = np.where(corner > 0, corner - 1, corner)
    counted_back = corner < 0
    if counted_back.any():
        vertex[counted_back] += np.repeat(_n_before(text), sizes)[counted_back]
    if ((corner == 0) | (vertex < 0) | (vertex >= n_vertices)).any():
        raise ValueError("a face has a vertex that is not there")
    is_polygon = sizes > 2
    return vertex[np.repeat(is_polygon, sizes)], sizes[is_polygon]


def _n_before(text: bytes) -> np.ndarray:
    """How many vertices stand before each face, (f,): a face counts back from there, where its indices are negative."""
    is_vertex = np.frombuffer(b"".join(_EITHER.findall(text)), np.uint8) == ord("v")
    return np.cumsum(is_vertex)[~is_vertex]
