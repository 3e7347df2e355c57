# SPDX-License-Identifier: GPL-3.0-or-later
"""The cuts between pieces: caps that two of them have in common."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...core.arrays.components import components
from ...core.arrays.hashes import hashed_sets
from ...core.arrays.int64 import arange, cumsum
from ...core.arrays.pairs import distinct_pairs
from ...core.arrays.vectors import box_diagonal
from ...core.mesh.triangles import EdgeTable
from ..pieces.closing import caps
from ..reading import mesh_arrays

if TYPE_CHECKING:
    from ...core.uses.joints.cap import Cap


@dataclass(frozen=True, eq=False)
class Cut:
    """A cap that two pieces share.

    Attributes
    ----------
    keys : (int, int)
        Of the pieces.
    cap : Cap
        In units of the world, looking from the first piece to the second.
    faces : ((k,), (k,)) int64
        In the two pieces.
    """

    keys: tuple[int, int]
    cap: Cap
    faces: tuple[np.ndarray, np.ndarray]


def shared_cuts(meshes: dict[int, bpy.types.Mesh], stretch: np.ndarray) -> list[Cut]:
    """What the pieces have in common: connected faces of caps with the same corners in two of them."""
    from ...core.uses.joints.cap import Cap

    @cache  # a piece has several cuts
    def surface(key: int) -> tuple[np.ndarray, ...]:
        """Pairs of faces, points, triangles and their faces of a piece."""
        mesh = meshes[key]
        points = mesh_arrays.basis_points(mesh).astype(np.float64) @ stretch.T
        return mesh_arrays.corner_table(mesh).face_pairs()[0], points, *mesh_arrays.triangles(mesh)

    cuts = []
    for keys, one, other in _shared_faces(meshes):
        pairs, points, triangles, polygon = surface(keys[0])
        pairs = pairs[np.isin(pairs, one).all(axis=1)]
        count, label = components(len(one), *np.searchsorted(one, pairs).T)
        rims = points[_rims(triangles[np.isin(polygon, one)])]
        for index in range(count):
            mine = one[label == index]
            cap = Cap(points, triangles[np.isin(polygon, mine)], rims)
            cuts.append(Cut(keys, cap, (mine, np.sort(other[label == index]))))
    return cuts


def _shared_faces(
    meshes: dict[int, bpy.types.Mesh],
) -> Iterator[tuple[tuple[int, int], np.ndarray, np.ndarray]]:
    """The keys of each two pieces that have faces of caps in common, and these faces in both, (k,) int64 each.

    Those of the first piece rise; those of the second are in the same order.
    """
    keys = sorted(meshes)
    found = [_cap_faces(meshes[key]) for key in keys]
    corners = np.concatenate([points for _, points, _ in found]) if found else np.empty((0, 3), np.float32)
    if not len(corners):
        return
    name = _names(corners, [place for _, _, place in found])
    piece = np.repeat(arange(len(keys)), [len(faces) for faces, _, _ in found])
    face = np.concatenate([faces for faces, _, _ in found])
    order = np.lexsort((piece, name))
    twice = np.flatnonzero((name[order][1:] == name[order][:-1]) & (piece[order][1:] != piece[order][:-1]))
    low, high = order[twice], order[twice + 1]
    for a, b in distinct_pairs(piece[low], piece[high])[0].tolist():
        these = np.flatnonzero((piece[low] == a) & (piece[high] == b))
        these = these[np.argsort(face[low[these]])]
        yield (keys[a], keys[b]), face[low[these]], face[high[these]]


def _rims(triangles: np.ndarray) -> np.ndarray:
    """The edges of some triangles that one of them has, (s, 2)."""
    table = EdgeTable.of(triangles)
    return table.vertices[table.n_faces == 1]


def _cap_faces(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The faces of caps, the places of their corners, (c, 3) float32, and the face of each corner, from 0."""
    is_cap = caps.is_cap(mesh)
    vertex, face = mesh_arrays.face_corners(mesh)
    here = is_cap[face]
    return np.flatnonzero(is_cap), mesh_arrays.basis_points(mesh)[vertex[here]], (cumsum(is_cap) - 1)[face[here]]


def _names(corners: np.ndarray, faces: list[np.ndarray]) -> np.ndarray:
    """A number for each face that faces with corners at the same places share, (f,) uint64."""
    place = _places(corners.astype(np.float64))
    count = [int(some.max(initial=-1)) + 1 for some in faces]
    start = cumsum([0, *count])
    face = np.concatenate([some + first for some, first in zip(faces, start, strict=False)])
    return hashed_sets(face, place, int(start[-1]))


def _places(points: np.ndarray) -> np.ndarray:
    """A number for each place; points, (n, 3), that differ by rounding are at one."""
    from scipy.spatial import cKDTree

    own, place = np.unique(points, axis=0, return_inverse=True)
    near = cKDTree(own).query_pairs(2e-6 * box_diagonal(own), output_type="ndarray")
    return components(len(own), *near.T)[1][place.ravel()]
