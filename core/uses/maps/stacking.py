# SPDX-License-Identifier: GPL-3.0-or-later
"""Which corners can share their place in a map: those of mirror images, and of faces that lie on each other."""

from __future__ import annotations

import numpy as np

from ...arrays.hashes import hashed_sets
from ...arrays.int64 import arange, full
from ...arrays.vectors import box_diagonal
from ...mesh.corners import CornerTable
from ...symmetry.plane import MirrorPlane

# How far the image of a corner may be from a corner, as a share of the diagonal of the bounding box.
_EXACT = 1e-4


def image_corners(
    table: CornerTable, labels: np.ndarray, side: np.ndarray, plane: MirrorPlane, face_twin: np.ndarray
) -> np.ndarray:
    """Find the mirror images of corners, for parts whose mesh is the exact image of that of another part.

    Parameters
    ----------
    table : CornerTable
        p faces with c corners.
    labels : (p,) int64
        Part of each face.
    side : (parts,) int64
        Of each part: 1 or -1 for the two sides of the plane, 0 for a part without a twin, as in ``Parts.side``.
    plane : MirrorPlane
        In the coordinates of the table.
    face_twin : (p,) int64
        Mirror image of each face, -1 for none.

    Returns
    -------
    image : (c,) int64
        For each corner of a part on the side of -1 all of whose faces have an exact image, the corner that it is the
        image of; -1 for all other corners.
    """
    faces, corner_face = arange(table.n_faces), table.corner_face
    total = np.bincount(corner_face, minlength=table.n_faces)
    first = np.searchsorted(corner_face, faces)
    points = table.vertices[table.corner_vertex]
    image = full(len(points), -1)
    fits = (side[labels] == -1) & (face_twin >= 0) & (total == total[face_twin])
    corner = np.flatnonzero(fits[corner_face])
    wanted, twin = plane.mirrored(points[corner]), face_twin[corner_face[corner]]
    nearest = np.full(len(corner), _EXACT * box_diagonal(points) if len(points) else 0.0)
    for step in range(int(total[fits].max(initial=0))):
        there = np.flatnonzero(step < total[twin])
        other = first[twin[there]] + step
        distance = np.linalg.norm(points[other] - wanted[there], axis=1)
        closer = distance < nearest[there]
        image[corner[there[closer]]] = other[closer]
        nearest[there[closer]] = distance[closer]
    incomplete = np.zeros(len(side), bool)
    incomplete[labels[corner_face[image < 0]]] = True
    image[incomplete[labels[corner_face]]] = -1
    return image


def double_corners(table: CornerTable, among: np.ndarray) -> np.ndarray:
    """Find the faces that lie on earlier ones: they have the same vertices, in any order.

    Parameters
    ----------
    table : CornerTable
        p faces with c corners, all of whose faces have corners.
    among : (p,) bool
        Faces that count.

    Returns
    -------
    first : (c,) int64
        For each corner of a face with the vertices of an earlier one, the corner of the first such face that has the
        same vertex; -1 for all other corners.
    """
    owner = table.corner_face
    faces = np.flatnonzero(among)
    _, earliest, group = np.unique(hashed_sets(owner, table.corner_vertex, table.n_faces)[faces], return_index=True,
                                   return_inverse=True)
    original = arange(table.n_faces)
    original[faces] = faces[earliest[group.ravel()]]
    # By vertex, the corners of both faces are in the same order.
    order = np.lexsort((table.corner_vertex, owner))
    start = np.searchsorted(owner, arange(table.n_faces))
    corner = np.flatnonzero((original != arange(table.n_faces))[owner])
    first = full(len(owner), -1)
    first[order[corner]] = order[corner - start[owner[corner]] + start[original[owner[corner]]]]
    return first
