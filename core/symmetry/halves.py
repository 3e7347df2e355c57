# SPDX-License-Identifier: GPL-3.0-or-later
"""Half models: one side of a symmetric shape, whose other side is its mirror image, as of a Mirror modifier."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays.int64 import arange
from ..arrays.pairs import distinct_pairs
from ..arrays.vectors import box_diagonal
from ..errors import MeshError
from ..mesh.arguments import numbers
from ..mesh.corners import CornerTable, next_of_owner
from ..mesh.interior import FLAT
from ..mesh.polygons import PolygonMesh
from ..sentence import Sentence
from .plane import MirrorPlane

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

WELD = 5e-4  # of the size of the mesh: how near to the plane its border meets its own image


@dataclass(frozen=True, eq=False)
class Completed:
    """A half model and its mirror image as one mesh: first what was given, then the images.

    Attributes
    ----------
    vertices : (n', 3) float64
        The caller's n vertices and the images of those that are not on the plane.
    triangles : (2 m, 3) int64
    polygon : (2 m,) int64
        The image of polygon k is k + p.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    polygon: np.ndarray


def plane_of(mirror: ArrayLike) -> np.ndarray:
    """The normal of a plane, of length 1, and its distance from the origin along it, (4,) float64.

    mirror : (4,) array_like, a normal of any length but 0, and the distance. Raises MeshError if it is no plane.
    """
    plane = numbers(mirror)
    if plane is not None and plane.shape == (4,) and np.isfinite(plane).all() and plane[:3].any():
        normal = plane[:3] / np.abs(plane[:3]).max()
        return np.append(normal / np.linalg.norm(normal), plane[3])
    raise MeshError(Sentence("A mirror plane is four numbers: its normal, and its distance from the origin."))


def completed(half: PolygonMesh, plane: np.ndarray) -> Completed:
    """Add its mirror image to a half model; borders at the plane are closed.

    Parameters
    ----------
    half : PolygonMesh
        n vertices, m triangles, p polygons.
    plane : (4,) float64
        Normal of length 1 and distance from the origin, in the unit of the vertices of ``half``.

    Returns
    -------
    whole : Completed
        A vertex of a border nearer to the plane than WELD is on it.
    """
    mesh = half.triangles
    border = mesh.edges.vertices[mesh.edges.n_faces == 1]
    vertices, image = _with_images(mesh.vertices, mesh.used, border, MirrorPlane.of(plane))
    return Completed(vertices, np.concatenate([mesh.faces, image[mesh.faces[:, ::-1]]]),
                     np.concatenate([half.polygon, half.polygon + half.n_polygons]))


def completed_table(half: CornerTable, mirror: MirrorPlane) -> tuple[CornerTable, np.ndarray]:
    """Add its mirror image to a half model given corner by corner; borders at the plane are closed.

    Parameters
    ----------
    half : CornerTable
        n vertices, p faces.
    mirror : MirrorPlane

    Returns
    -------
    whole : CornerTable
        2 p faces; face k + p is the mirror image of face k. The n vertices come first.
    image : (n,) int64
        Vertex of the whole that is the mirror image of each; on the plane, itself.
    """
    border = half.edges[half.corner_edge[open_sides(half, mirror)]]
    vertices, image = _with_images(half.vertices, half.corner_vertex, border, mirror)
    first = np.searchsorted(half.corner_face, half.corner_face)
    last = np.searchsorted(half.corner_face, half.corner_face, side="right") - 1
    back = image[half.corner_vertex[first + last - arange(len(first))]]  # the corners of each face in reverse
    start = np.concatenate([half.corner_vertex, back])
    face = np.concatenate([half.corner_face, half.corner_face + half.n_faces]).astype(np.int64)
    end = start[next_of_owner(face)]
    edges, corner_edge = distinct_pairs(np.minimum(start, end), np.maximum(start, end))
    return CornerTable(vertices, edges, start, corner_edge, face, 2 * half.n_faces), image


def open_sides(half: CornerTable, mirror: MirrorPlane) -> np.ndarray:
    """Which sides of faces are alone at their edge, (c,) bool, if faces in the plane, within the whole, do not count.

    half : CornerTable of c corners, at each of which a side begins. mirror : MirrorPlane.
    """
    off = np.abs(mirror.heights(half.vertices)) > FLAT * box_diagonal(half.vertices[half.corner_vertex])
    beside = np.bincount(half.corner_face, off[half.corner_vertex], half.n_faces) > 0
    counts = (beside | ~beside.any())[half.corner_face]  # all of them, if there is nothing but a figure in the plane
    return counts & (np.bincount(half.corner_edge, counts, len(half.edges)) == 1)[half.corner_edge]


def _with_images(vertices: np.ndarray, used: np.ndarray, border: np.ndarray,
                 mirror: MirrorPlane) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and, behind them, the images of those that are not on the plane; and the image of each, (n,) int64.

    used : vertices of faces, as mask or indices. border : (b, 2) int64, the edges of one face. A vertex of a border
    that is near to the plane is moved onto it.
    """
    height = mirror.heights(vertices)
    at_border = np.zeros(len(vertices), bool)
    at_border[border] = True
    on_plane = at_border & (np.abs(height) <= WELD * box_diagonal(vertices[used]))
    vertices = np.where(on_plane[:, None], vertices - height[:, None] * mirror.normal, vertices)
    beside = np.flatnonzero(~on_plane)
    image = arange(len(vertices))
    image[beside] = len(vertices) + arange(len(beside))
    return np.concatenate([vertices, mirror.mirrored(vertices[beside])]), image


def is_one_side(vertices: np.ndarray, plane: np.ndarray) -> bool:
    """Whether a mesh lies on one side of a plane.

    vertices : (n, 3) float64. plane : (4,) float64, normal of length 1 and distance from the origin.
    """
    if not len(vertices):
        return False
    height = MirrorPlane.of(plane).heights(vertices)
    return bool(min(height.max(), -height.min()) <= WELD * box_diagonal(vertices))
