# SPDX-License-Identifier: GPL-3.0-or-later
"""Half models: one side of a symmetric shape, whose other side is its mirror image, as of a Mirror modifier."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..errors import MeshError
from ..sentence import Sentence
from .arguments import numbers
from .mirror_plane import MirrorPlane
from .polygons import PolygonMesh

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
    mirror = MirrorPlane(plane[:3], float(plane[3]))
    height = mirror.heights(mesh.vertices)
    size = np.linalg.norm(np.ptp(mesh.vertices[mesh.used], axis=0))
    border = np.zeros(mesh.n_vertices, bool)
    border[mesh.edges.vertices[np.bincount(mesh.edges.face_edges.ravel()) == 1]] = True
    on_plane = border & (np.abs(height) <= WELD * size)
    vertices = np.where(on_plane[:, None], mesh.vertices - height[:, None] * plane[:3], mesh.vertices)
    beside = np.flatnonzero(~on_plane)
    image = np.arange(mesh.n_vertices)
    image[beside] = mesh.n_vertices + np.arange(len(beside))
    return Completed(np.concatenate([vertices, mirror.mirrored(vertices[beside])]),
                     np.concatenate([mesh.faces, image[mesh.faces[:, ::-1]]]),
                     np.concatenate([half.polygon, half.polygon + half.n_polygons]))


def is_one_side(vertices: np.ndarray, plane: np.ndarray) -> bool:
    """Whether a mesh lies on one side of a plane.

    vertices : (n, 3) float64. plane : (4,) float64, normal of length 1 and distance from the origin.
    """
    if not len(vertices):
        return False
    height = MirrorPlane(plane[:3], float(plane[3])).heights(vertices)
    return bool(min(height.max(), -height.min()) <= WELD * np.linalg.norm(np.ptp(vertices, axis=0)))
