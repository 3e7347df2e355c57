# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of labeled meshes without a renderer: points of the faces, the nearest of each pixel."""

from __future__ import annotations

import struct
import zlib

import numpy as np

from core.surface.arrays import expanded, sums_by
from core.surface.mesh import TriMesh
from core.uses.colors import PALETTE

DENSITY = 14  # points per pixel of the picture, spread over the whole surface
LIGHT = np.array([-0.4, 0.5, 0.76])  # direction to the light, in the picture's axes: right, up, to the viewer
TILT = np.radians([25.0, 20.0])  # turn around the upright axis, then around the horizontal one


def picture(mesh: TriMesh, color: np.ndarray, size: int = 112) -> np.ndarray:
    """Draw a mesh from the side from which it is widest.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    color : (m, 3) float64
        sRGB, 0..1.
    size : int
        Width and height in pixels.

    Returns
    -------
    image : (size, size, 3) uint8
        On white.
    """
    face, point = _points(mesh, DENSITY * size * size)
    axes = _view(mesh)
    place = point @ axes.T
    normal = mesh.face_normals @ axes.T
    low, high = place.min(axis=0), place.max(axis=0)
    scale = 0.94 * size / max(float((high - low)[:2].max()), 1e-300)
    x, y = ((place - (low + high) / 2) * scale + size / 2).T[:2].astype(int).clip(0, size - 1)
    pixel = (size - 1 - y) * size + x
    order = np.argsort(place[:, 2], kind="stable")
    light = 0.45 + 0.55 * np.abs(normal[face] @ (LIGHT / np.linalg.norm(LIGHT)))
    image = np.ones((size * size, 3))
    image[pixel[order]] = (color[face] * light[:, None])[order]  # NumPy keeps the last: the nearest
    return (255 * image.reshape(size, size, 3)).round().astype(np.uint8)


def _points(mesh: TriMesh, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points spread over the faces by area: the face of each, (k,), and its position, (k, 3)."""
    share = mesh.face_area / mesh.area * count
    number = np.maximum(np.ceil(share), 1).astype(np.int64)
    face, place = expanded(np.zeros(mesh.n_faces, np.int64), number)
    # Two irrational steps fill every triangle evenly; folded, as a square is twice a triangle.
    u, v = (place + 0.5) * 0.7548776662466927 % 1.0, (place + 0.5) * 0.5698402909980532 % 1.0
    over = u + v > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    a, b, c = mesh.corners[face].transpose(1, 0, 2)
    return face, a + u[:, None] * (b - a) + v[:, None] * (c - a)


def _view(mesh: TriMesh) -> np.ndarray:
    """Right, up and towards the viewer, (3, 3): along the principal axes, a little from the side and from above."""
    middle = mesh.face_area @ mesh.face_centroids / mesh.area
    offset = mesh.face_centroids - middle
    _, axes = np.linalg.eigh((mesh.face_area[:, None] * offset).T @ offset)
    axes = axes.T[::-1]  # the longest first
    # The side on which there is more of the surface far out is up; it is always the same.
    axes = axes * np.where((mesh.face_area @ (offset @ axes.T) ** 3) < 0, -1.0, 1.0)[:, None]
    axes[2] = np.cross(axes[0], axes[1])
    (c, s), (d, t) = ((np.cos(angle), np.sin(angle)) for angle in TILT)
    around = np.array([(c, 0, s), (0, 1, 0), (-s, 0, c)])
    over = np.array([(1, 0, 0), (0, d, -t), (0, t, d)])
    return over @ around @ axes


def like_colors(labels: np.ndarray, reference: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Colors of faces, (m, 3): a part has the color of the reference's part that it shares most with, if it is free.

    labels, reference : (m,) int64, from 0. area : (m,) float64.
    """
    count, other = int(labels.max()) + 1, int(reference.max()) + 1
    rank = np.argsort(np.argsort(-np.bincount(reference, area), kind="stable"), kind="stable")
    shared = sums_by(labels, np.eye(other)[reference] * area[:, None], count)
    color, used = np.full(count, -1), set()
    for cell in np.argsort(-shared, axis=None, kind="stable").tolist():
        part, its = divmod(cell, other)
        if color[part] < 0 and rank[its] not in used and shared[part, its] > 0:
            color[part] = rank[its]
            used.add(int(rank[its]))
    free = iter(k for k in range(count + other) if k not in used)
    for part in np.flatnonzero(color < 0).tolist():
        color[part] = next(free)
    faded = np.where(color < len(PALETTE), 1.0, 0.6)[:, None]  # palettes are shorter than some lists of parts
    return (1 - faded * (1 - PALETTE[color % len(PALETTE)]))[labels]


def png(image: np.ndarray) -> bytes:
    """Encode an image, (h, w, 3) uint8, as PNG."""
    height, width, _ = image.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, -1)], axis=1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(
        b"IEND", b"")
