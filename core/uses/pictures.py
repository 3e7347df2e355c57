# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of colored meshes without a renderer, and of the Reeb graph over them: the nearest face of each pixel."""

from __future__ import annotations

import base64
import struct
import zlib
from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import expanded
from ..arrays.int64 import arange, cumsum, full
from ..graph.reeb import ReebGraph
from ..mesh.triangles import TriMesh

CHUNK = 2_000_000  # pixels, of the picture, of faces or of discs, that are looked at together
LIGHT = np.array([-0.4, 0.5, 0.76])  # direction to the light, in the picture's axes: right, up, to the viewer
TILT = np.radians([25.0, 20.0])  # turn around the upright axis, then around the horizontal one
#: Right, up and towards the viewer of a model that stands upright, by the name of its upward axis.
UPRIGHT = {"y": np.array([(1.0, 0, 0), (0, 1, 0), (0, 0, 1)]), "z": np.array([(1.0, 0, 0), (0, 0, 1), (0, -1, 0)])}
ARC_COLOR = (0.1, 0.1, 0.12)
NODE_COLORS = np.array([(0.1, 0.1, 0.12), (1.0, 0.8, 0.1), (1.0, 1.0, 1.0)])  # minimum, saddle, maximum
ARC_WIDTH, NODE_WIDTH = 1 / 120, 1 / 45  # in units of the picture's width


@dataclass(frozen=True, eq=False)
class _Camera:
    """Where points of space are in a picture.

    Attributes
    ----------
    axes : (3, 3) float64
        Right, up and towards the viewer.
    middle : (3,) float64
        Along these axes; in the middle of the picture.
    scale : float
        Pixels per unit.
    size : int
        Width and height in pixels.
    """

    axes: np.ndarray
    middle: np.ndarray
    scale: float
    size: int

    @classmethod
    def of(cls, points: np.ndarray, axes: np.ndarray, size: int) -> _Camera:
        """The camera that sees all points, (k, 3)."""
        place = points @ axes.T
        low, high = place.min(axis=0), place.max(axis=0)
        return cls(axes, (low + high) / 2, 0.94 * size / max(float((high - low)[:2].max()), 1e-300), size)

    def pixels(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Column and row, (k, 2) float64, and nearness, (k,), of points, (k, 3)."""
        place = (points @ self.axes.T - self.middle) * self.scale
        return np.stack([place[:, 0] + self.size / 2, self.size - 1 - (place[:, 1] + self.size / 2)], 1), place[:, 2]


def picture(
    mesh: TriMesh, color: np.ndarray, size: int = 112, up: str = "", graph: ReebGraph | None = None, fine: int = 1
) -> np.ndarray:
    """Draw a mesh, and the Reeb graph over it.

    Parameters
    ----------
    mesh : TriMesh
        m faces.
    color : (m, 3) float64
        sRGB, 0..1.
    size : int
        Width and height in pixels.
    up : str
        "y" or "z", the axis that is up in the picture; the front is then seen from a little to the side. Without it,
        the model is seen from the side from which it is widest.
    graph : ReebGraph, optional
        Drawn over the model.
    fine : int
        Pixels along each side of a pixel of the picture, of which it is the mean.

    Returns
    -------
    image : (size, size, 3) uint8
        On white.
    """
    axes = _tilted(UPRIGHT[up], -1.0) if up else _tilted(_principal_view(mesh))
    points, corner = mesh.vertices[mesh.used], (cumsum(mesh.used) - 1)[mesh.faces]
    camera = _Camera.of(points, axes, size * fine)
    place, height = (values[corner] for values in camera.pixels(points))
    discs = [] if graph is None else _graph_discs(camera, graph)
    light = 0.45 + 0.55 * np.abs(mesh.face_normals @ axes.T @ (LIGHT / np.linalg.norm(LIGHT)))
    shown = np.vstack([color * light[:, None], np.ones((1, 3))])  # the last is the background
    image = np.empty((size, size, 3), np.uint8)
    n_rows = max(CHUNK // (camera.size * fine), 1)
    for top in range(0, size, n_rows):  # bands, so that a large picture needs little memory
        rows = range(top * fine, min(top + n_rows, size) * fine)
        band = shown[_nearest_faces(place, height, rows, camera.size)].reshape(len(rows), camera.size, 3)
        for centers, disc_color, radius in discs:
            _draw_discs(band, centers - (0, rows.start), disc_color, radius)
        mean = band.reshape(-1, fine, size, fine, 3).mean(axis=(1, 3))
        image[top:top + n_rows] = (255 * mean).round().astype(np.uint8)
    return image


def _nearest_faces(place: np.ndarray, height: np.ndarray, rows: range, size: int) -> np.ndarray:
    """Face that is seen at each pixel of some rows, row by row, (r * size,) int64; -1 for none.

    place : (m, 3, 2) float64, column and row of each corner. height : (m, 3) float64, nearness. size : int, pixels in
    a row.
    """
    low, high = np.array([0, rows.start]), np.array([size, rows.stop])
    first = np.ceil(place.min(axis=1)).astype(np.int64).clip(low, high)
    count = ((np.floor(place.max(axis=1)).astype(np.int64) + 1).clip(low, high) - first).clip(0)
    (origin, slope), farthest, closest = _planes(place, height), height.min(axis=1), height.max(axis=1)
    seen, nearest = full(len(rows) * size, -1), np.full(len(rows) * size, -np.inf)
    n_pixels = cumsum(count.prod(axis=1))  # of the boxes around the faces: more than these have
    bounds = np.searchsorted(n_pixels, arange(0, n_pixels[-1] + CHUNK, CHUNK))
    for begin, end in zip(bounds, np.append(bounds[1:], len(place)), strict=True):
        face, row = expanded(first[begin:end, 1], count[begin:end, 1])
        face = face + begin
        span, column = expanded(*_spans(place[face], row, size))
        face, row = face[span], row[span]
        depth = origin[face] + slope[face, 0] * column + slope[face, 1] * row
        # Beyond the corners, that of a face that is seen from its edge is out of bounds.
        depth = np.clip(depth, farthest[face], closest[face])
        pixel = (row - rows.start) * size + column
        there = depth > nearest[pixel]
        pixel, depth, face = pixel[there], depth[there], face[there]
        np.maximum.at(nearest, pixel, depth)
        front = depth == nearest[pixel]
        seen[pixel[front]] = face[front]
    return seen


def _planes(place: np.ndarray, height: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nearness of each face at column and row 0, (m,) float64, and what a column and a row add, (m, 2) float64.

    place : (m, 3, 2) float64. height : (m, 3) float64. Of faces without area, which are not seen, -infinity.
    """
    (ax, ay), (bx, by) = (place[:, k].T - place[:, 0].T for k in (1, 2))
    a, b = height[:, 1] - height[:, 0], height[:, 2] - height[:, 0]
    double_area = ax * by - ay * bx
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.stack([a * by - b * ay, b * ax - a * bx], axis=1) / double_area[:, None]
        origin = height[:, 0] - (slope * place[:, 0]).sum(axis=1)
    has_area = np.isfinite(origin)
    return np.where(has_area, origin, -np.inf), np.where(has_area[:, None], slope, 0.0)


def _spans(corners: np.ndarray, row: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Columns of a row of pixels that lie in a triangle: the first of them and how many, (s,) int64.

    corners : (s, 3, 2) float64. row : (s,) int64.
    """
    others = np.roll(corners, -1, axis=1)
    falls = (corners[..., 1] > others[..., 1])[..., None]
    low, high = np.where(falls, others, corners), np.where(falls, corners, others)  # alike in both faces of an edge
    rise, above = high[..., 1] - low[..., 1], row[:, None] - low[..., 1]
    share = np.divide(above, rise, out=np.zeros_like(rise), where=rise > 0)
    column = low[..., 0] + share * (high[..., 0] - low[..., 0])
    crossed = (above >= 0) & (row[:, None] <= high[..., 1])
    first = np.ceil(np.where(crossed, column, np.inf).min(axis=1)).clip(0, size).astype(np.int64)
    last = np.floor(np.where(crossed, column, -np.inf).max(axis=1)).clip(-1, size - 1).astype(np.int64)
    return first, (last + 1 - first).clip(0)


def _principal_view(mesh: TriMesh) -> np.ndarray:
    """Right, up and towards the viewer, (3, 3), along the principal axes."""
    middle = mesh.face_area @ mesh.face_centroids / mesh.area
    offset = mesh.face_centroids - middle
    _, axes = np.linalg.eigh((mesh.face_area[:, None] * offset).T @ offset)
    axes = axes.T[::-1]  # the longest first
    # The side on which there is more of the surface far out is up; it is always the same.
    axes = axes * np.where((mesh.face_area @ (offset @ axes.T) ** 3) < 0, -1.0, 1.0)[:, None]
    axes[2] = np.cross(axes[0], axes[1])
    return axes


def _tilted(axes: np.ndarray, side: float = 1.0) -> np.ndarray:
    """The view a little from above, and from one side or, with -1, from the other."""
    (c, s), (d, t) = ((np.cos(angle), np.sin(angle)) for angle in (side * TILT[0], TILT[1]))
    around = np.array([(c, 0, s), (0, 1, 0), (-s, 0, c)])
    over = np.array([(1, 0, 0), (0, d, -t), (0, t, d)])
    return over @ around @ axes


def _graph_discs(camera: _Camera, graph: ReebGraph) -> list[tuple[np.ndarray, np.ndarray, float]]:
    """Discs that draw arcs as lines and nodes, the nearest last: centers, (k, 2) int64, color, (3,), and radius."""
    ends = graph.node_position[graph.arcs]
    lines = [camera.pixels(np.vstack([
        ends[arc, :1], graph.point_position[graph.arc_points[arc]:graph.arc_points[arc + 1]], ends[arc, 1:]]))[0]
        for arc in range(graph.n_arcs)]
    segments = np.concatenate([np.hstack([line[:-1], line[1:]]) for line in lines] or [np.empty((0, 4))])
    count = np.ceil(np.linalg.norm(segments[:, 2:] - segments[:, :2], axis=1)).astype(np.int64) + 1
    which, step = expanded(np.zeros(len(segments), np.int64), count)
    share = (step / np.maximum(count[which] - 1, 1))[:, None]
    discs = [(segments[which, :2] * (1 - share) + segments[which, 2:] * share, np.array(ARC_COLOR), ARC_WIDTH / 2)]
    pixel, nearness = camera.pixels(graph.node_position)
    order = np.argsort(nearness, kind="stable")
    for place, kind in zip(pixel[order, None], graph.node_kind[order], strict=True):
        discs += [(place, np.array(ARC_COLOR), NODE_WIDTH / 2), (place, NODE_COLORS[kind], NODE_WIDTH / 3)]
    return [(np.unique(np.round(centers).astype(np.int64), axis=0), color, camera.size * radius)
            for centers, color, radius in discs]


def _draw_discs(image: np.ndarray, centers: np.ndarray, color: np.ndarray, radius: float) -> None:
    """Fill discs of one color around centers, (k, 2) int64, columns and rows, which may lie outside."""
    reach = arange(-int(radius) - 1, int(radius) + 2)
    offset = np.stack(np.meshgrid(reach, reach), -1).reshape(-1, 2)
    offset = offset[(offset**2).sum(axis=1) <= radius**2]
    centers = centers[(centers[:, 1] >= reach[0]) & (centers[:, 1] < len(image) - reach[0])]
    several = max(CHUNK // len(offset), 1)
    for begin in range(0, len(centers), several):
        pixel = (centers[begin:begin + several, None] + offset).reshape(-1, 2)
        pixel = pixel[((pixel >= 0) & (pixel < image.shape[1::-1])).all(axis=1)]
        image[pixel[:, 1], pixel[:, 0]] = color


def png(image: np.ndarray) -> bytes:
    """Encode an image, (h, w, 3) uint8, as PNG."""
    height, width, _ = image.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, -1)], axis=1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(
        b"IEND", b"")


def png_address(data: bytes) -> str:
    """An image, encoded as PNG, as an address that a page in HTML holds it by."""
    return f"data:image/png;base64,{base64.b64encode(data).decode()}"
