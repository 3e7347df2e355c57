# SPDX-License-Identifier: GPL-3.0-or-later
"""What the readers of .obj, .off and .ply have in common, and those of lists."""

from __future__ import annotations

from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE

import numpy as np

from .core.mesh.ears import triangulated

#: What is wrong with many a damaged file.
NOT_THERE = "a face has a vertex that is not there"


def plain_text(data: bytes) -> bytes:
    """The bytes of a text, without the mark with which some editors begin it; in UTF-8 if it is in UTF-16.

    PowerShell writes UTF-16 where the output of a program is sent to a file.
    """
    if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        data = data.decode("utf-16", errors="replace").encode()
    return data.removeprefix(BOM_UTF8)


def places(rows: list[bytes]) -> np.ndarray:
    """The first three numbers of each row of words, (n, 3) float64; raises ValueError where there are less."""
    words = [row.split(None, 3)[:3] for row in rows]
    if min(map(len, words), default=3) < 3:
        raise ValueError("a vertex has fewer than three coordinates")
    return np.array(words, np.bytes_).astype(np.float64) if words else np.empty((0, 3))


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
    ValueError
        A face has a vertex that is not there.
    """
    if ((corner < 0) | (corner >= len(vertices))).any():
        raise ValueError(NOT_THERE)
    is_polygon = sizes > 2
    return vertices, *triangulated(vertices, corner[np.repeat(is_polygon, sizes)], sizes[is_polygon])
