# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions whose message is the sentence that the user reads.

The message says what is wrong, how much of it, and what to do; it is a ``Sentence``, so that an operator can translate
it. The exception also carries the indices of the vertices and faces concerned, for callers in Python.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .sentence import Sentence

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class ReebError(Exception):
    """Base of every error that Reeb Parts raises on purpose."""


class Cancelled(ReebError):  # noqa: N818 - it is not an error to the user
    """The caller's progress function asked to stop, and there is no result.

    Parameters
    ----------
    message : str
    """

    def __init__(self, message: str = "Cancelled.") -> None:
        super().__init__(message)


class ParameterError(ReebError, ValueError):
    """A parameter is outside its range.

    Parameters
    ----------
    message : str
    name : str
        Name of the parameter; also an attribute of the exception.
    """

    def __init__(self, message: str, name: str = "") -> None:
        super().__init__(message)
        self.name = name


def wrong_kind(name: str, wanted: str, value: object) -> ParameterError:
    """The error for an argument of another kind than is wanted, such as "a function"."""
    return ParameterError(Sentence("{name} must be {wanted}, not {type}.", name=name, wanted=wanted,
                                   type=type(value).__name__), name)


class UnknownParameterError(ParameterError, TypeError):
    """There is no parameter of a name."""


class MeshError(ReebError, ValueError):
    """The mesh cannot be decomposed.

    Parameters
    ----------
    message : str
    vertices, faces : array_like of int
        Vertices and faces concerned; also attributes of the exception, (k,) int64.
    """

    def __init__(self, message: str, vertices: ArrayLike = (), faces: ArrayLike = ()) -> None:
        super().__init__(message)
        self.vertices = np.asarray(vertices, dtype=np.int64)
        self.faces = np.asarray(faces, dtype=np.int64)


class EmptyMeshError(MeshError):
    """The mesh has no faces, too few faces, or no area."""


class DisconnectedMeshError(MeshError):
    """Some vertices cannot be reached from others, although the mesh should be one connected component."""
