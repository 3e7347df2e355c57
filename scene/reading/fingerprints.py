# SPDX-License-Identifier: GPL-3.0-or-later
"""What tells that a mesh was edited since it was decomposed, or moved as a whole."""

from __future__ import annotations

import hashlib

import bpy
import numpy as np

from . import mesh_arrays

_digested: list[tuple[tuple[np.ndarray, ...], str]] = []  # the mesh that was asked for last, and its fingerprint
# By fingerprint, of meshes as they were decomposed: positions, and a digest of the faces.
_shapes: dict[str, tuple[np.ndarray, str]] = {}
_MOST_KEPT = 4_000_000  # vertices of these together, but for the last one
_FITTED = 1000  # vertices that tell how a mesh was moved
_ROUNDING = 1e-6  # of single precision, as a share of the largest coordinate


def forget() -> None:
    """Free what is kept in memory."""
    _digested.clear()
    _shapes.clear()


def fingerprint(mesh: bpy.types.Mesh) -> str:
    """Changes when the mesh is edited: its basis positions or its faces. Not in Edit Mode."""
    arrays = (*_arrays_of(mesh), _count(len(mesh.polygons)))
    # While a slider is dragged, all is as it was a moment ago; to compare is faster than to digest.
    for known, made in _digested:
        if all(np.array_equal(a.view(np.int32), b.view(np.int32)) for a, b in zip(arrays, known, strict=True)):
            return made
    fresh = digest(*arrays)
    _digested[:] = [(arrays, fresh)]
    return fresh


def _arrays_of(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Basis positions, and the vertex and the edge of each corner."""
    # The edges of the corners tell where a face ends, and can be read much faster than that.
    return mesh_arrays.basis_points(mesh), mesh_arrays.corner_vertices(mesh), mesh_arrays.corner_edges(mesh)


def _count(n_faces: int) -> np.ndarray:
    """How many faces there are, as it goes into a fingerprint."""
    return np.array([n_faces], np.int64)


def begins_as(mesh: bpy.types.Mesh, known: str, n_vertices: int, n_faces: int) -> bool:
    """Whether the first vertices and faces of a mesh are what it was when it had a fingerprint. Not in Edit Mode."""
    points, *corners = _arrays_of(mesh)
    end = int(mesh_arrays.face_sizes(mesh)[:n_faces].sum())
    return digest(points[:n_vertices], *(corner[:end] for corner in corners), _count(n_faces)) == known


def keep_shape(fingerprint: str) -> None:
    """Remember the mesh whose fingerprint was made last, or found to be the same, for ``motion_since``."""
    if fingerprint in _shapes:
        _shapes[fingerprint] = _shapes.pop(fingerprint)
    for arrays, made in _digested if fingerprint not in _shapes else ():
        if made == fingerprint:
            _shapes[fingerprint] = arrays[0], digest(*arrays[1:])
    while len(_shapes) > 1 and sum(len(points) for points, _ in _shapes.values()) > _MOST_KEPT:
        del _shapes[next(iter(_shapes))]


def motion_since(mesh: bpy.types.Mesh, known: str) -> tuple[np.ndarray, np.ndarray] | None:
    """How a mesh was moved as a whole since it had a fingerprint: a matrix (3, 3) and then an offset (3,); float64.

    None if it was edited in any other way, if it is a line, or if nothing is known of it as it was. Not in Edit Mode.
    """
    fingerprint(mesh)
    (after, *faces), _ = _digested[0]
    before, faces_before = _shapes.get(known, (None, ""))
    if before is None or before.shape != after.shape or len(after) < 4:
        return None
    # Some vertices tell of most edits that they are none of these, before all are looked at.
    some = np.linspace(0, len(after) - 1, min(len(after), _FITTED)).astype(np.int64)
    some = np.unique(np.concatenate([some, before.argmin(axis=0), before.argmax(axis=0)]))
    found = _affine(before[some].astype(np.float64), after[some].astype(np.float64))
    if found is None:
        return None
    matrix, offset = found
    largest = max(np.abs(after).max(), np.abs(before).max() * np.linalg.norm(matrix, 2))
    for part in (some, slice(None)):
        if not np.abs(before[part] @ matrix.T + offset - after[part]).max() <= _ROUNDING * largest:
            return None
    return found if digest(*faces) == faces_before else None


def _affine(old: np.ndarray, new: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """The matrix and the offset that take points, (k, 3), nearest to others; None if these are flatter, or mirrored."""
    middle, now = old.mean(axis=0), new.mean(axis=0)
    if not (np.isfinite(middle).all() and np.isfinite(now).all()):
        return None
    # Far from the origin what is flat is so within the rounding of its coordinates.
    flat = max(1e-6, 4.0 * np.finfo(np.float32).eps * np.abs(old).max() / max(np.ptp(old), np.finfo(np.float64).tiny))
    transposed, _, rank, _ = np.linalg.lstsq(old - middle, new - now, rcond=flat)
    if rank == 2:
        transposed = _off_the_plane(transposed, flat)
    if rank < 2 or np.linalg.det(transposed) <= 0:
        return None
    return transposed.T, now - middle @ transposed


def _off_the_plane(transposed: np.ndarray, flat: float) -> np.ndarray:
    """A map of a plane, (3, 3), that also takes what lies off it there, without mirroring; zeros if it is none."""
    before, scales, after = np.linalg.svd(transposed)
    if scales[1] <= flat * scales[0]:
        return np.zeros((3, 3))
    scales[2] = np.sqrt(scales[0] * scales[1])  # as large as the plane becomes
    after[2] *= np.linalg.det(before) * np.linalg.det(after)
    return before * scales @ after


def digest(*arrays: np.ndarray) -> str:
    """Equal for arrays of equal shapes and bytes."""
    whole = hashlib.blake2b(digest_size=16)
    for array in arrays:
        part = hashlib.blake2b(np.ascontiguousarray(array).data, digest_size=16).digest()
        whole.update(str(array.shape).encode() + part)
    return whole.hexdigest()
