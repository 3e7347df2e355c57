# SPDX-License-Identifier: GPL-3.0-or-later
"""What a caller gives as arrays, taken where its meaning is plain and refused with a MeshError elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any

import numpy as np

from ..arrays.int64 import full
from ..errors import MeshError
from ..sentence import Sentence

_EXACT = 2.0**53  # up to here every whole number is a float64
_LAST = np.uint64(2**63 - 1)  # the last number of int64


def check_is_mesh(mesh: Any) -> None:
    """Raise MeshError unless it has vertices and faces, as what other libraries call a mesh has."""
    if not (hasattr(mesh, "vertices") and hasattr(mesh, "faces")):
        raise MeshError(Sentence("{type} is no mesh: give vertices and faces.", type=type(mesh).__name__))


def numbers(values: Any, truth: bool = False) -> np.ndarray | None:
    """Values as an array of float64, whole numbers as they are; None if they are no numbers.

    values : anything. Texts of numbers are numbers, and what is missing among them is nan; truth values are not, unless
    ``truth`` says that they are taken as they are; nor are complex numbers, dates, rows of different lengths, and what
    is masked.
    """
    try:
        if np.ma.is_masked(values):
            return None
        array = np.asarray(values)
        if array.dtype.kind in "iu" or (truth and array.dtype.kind == "b"):
            return array
        if array.dtype.kind == "O":
            # Truth values and texts in between would become numbers.
            if any(isinstance(value, (bool, np.bool_)) for value in array.flat):
                return None
        elif array.dtype.kind not in "fUS":
            return None
        with np.errstate(all="ignore"):
            return array.astype(np.float64)
    except (TypeError, ValueError, OverflowError):
        return None


def positions(values: Any) -> np.ndarray:
    """Positions of vertices, of any shape; raises MeshError if they are no numbers."""
    _check_masks(values)
    array = numbers(values)
    if array is None:
        raise MeshError(Sentence("Vertices must be rows of three numbers."))
    return array


def _check_masks(values: Any) -> None:
    """Raise MeshError where an array has values that are masked: what lies under the mask stands for nothing."""
    if np.ma.is_masked(values):
        raise MeshError(Sentence(
            "{n} {n:number is|numbers are} masked. Leave out the vertices and faces that have them.",
            n=int(np.ma.count_masked(values))))


def whole_numbers(values: Any) -> np.ndarray | None:
    """Values as an array of int64, of any shape; None if they are no whole numbers, or larger than any index."""
    array = numbers(values)
    if array is None or array.dtype.kind == "i":
        return array if array is None else array.astype(np.int64)
    if array.dtype.kind == "u":
        return array.astype(np.int64) if (array <= _LAST).all() else None
    if not (np.abs(array) < _EXACT).all() or (array % 1).any():
        return None
    return array.astype(np.int64)


def _indices(values: Any) -> np.ndarray | None:
    """As ``whole_numbers``; of unsigned numbers beyond int64 the last of int64, an index that no vertex has either."""
    array = numbers(values)
    if array is not None and array.dtype == np.uint64:
        return np.minimum(array, _LAST).astype(np.int64)
    return None if array is None else whole_numbers(array)


def corners(faces: Any) -> tuple[np.ndarray, np.ndarray]:
    """Corners of all faces one after the other, (c,) int64, and how many each face has, (p,) int64.

    faces : (p, k) array_like of whole numbers, or a sequence of p such sequences. Raises MeshError.
    """
    _check_masks(faces)
    array = _indices(faces)
    if array is not None and array.size == 0 and array.ndim < 3:
        array = array.reshape(0, 3)
    if array is not None and array.ndim == 2:
        return array.ravel(), full(len(array), array.shape[1])
    if isinstance(faces, np.ndarray) and faces.dtype.kind == "O" and faces.ndim == 1:
        faces = faces.tolist()
    if array is None and isinstance(faces, Sequence) and not isinstance(faces, (str, bytes)):
        return _rows(faces)
    if array is None and isinstance(faces, np.ndarray):
        raise MeshError(Sentence("Face indices must be whole numbers, not {type}.", type=faces.dtype))
    shape = type(faces).__name__ if array is None else array.shape
    raise MeshError(Sentence("Faces must have shape (m, corners), not {shape}.", shape=shape))


def _rows(faces: Sequence) -> tuple[np.ndarray, np.ndarray]:
    """As ``corners``, of faces with different numbers of corners."""
    if all(type(face) in (list, tuple) for face in faces):
        flat = _indices(list(chain.from_iterable(faces)))
        if flat is not None and flat.ndim == 1:
            return flat, np.array(list(map(len, faces)), np.int64)
    # One by one, which is slower and can tell where it is wrong.
    read = [_indices(face) for face in faces]
    rows = [row for row in read if row is not None and row.ndim == 1]
    if len(rows) < len(read):
        wrong = [index for index, row in enumerate(read) if row is None or row.ndim != 1]
        raise MeshError(
            Sentence("{n} {n:face is no row|faces are no rows} of whole numbers (first: face {first}).",
                     n=len(wrong), first=wrong[0]),
            faces=wrong)
    return np.concatenate(rows), np.array([len(row) for row in rows], np.int64)


def hints_of(hints: Any, n_faces: int) -> np.ndarray:
    """Labels of faces that the caller has, numbered from 0, (n_faces,) int64; MeshError if they are anything else.

    hints : (n_faces,) array_like of whole numbers, of any size if their type has them, or of truth values.
    """
    array = numbers(hints, truth=True)
    if array is not None and array.dtype.kind == "f":
        array = whole_numbers(array)
    if array is None or array.shape != (n_faces,):
        raise MeshError(Sentence("Hints must be one whole number for each of the {n} faces.", n=n_faces))
    return np.unique(array, return_inverse=True)[1].astype(np.int64)
