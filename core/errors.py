# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong, as exceptions whose message is the sentence the user reads.

The message says what is wrong, how much of it, and what to do; it is a ``Sentence``, so that an
operator can translate it. The indices of the offending elements ride on the exception, so that an
operator can select them.
"""

from __future__ import annotations

import numpy as np


class ReebError(Exception):
    """Base of every error that Reeb Parts raises on purpose."""


class Cancelled(ReebError):  # noqa: N818 - it is not an error to the user
    """The caller's progress function asked to stop; nothing was computed to the end."""

    def __init__(self, message: str = "Cancelled."):
        super().__init__(message)


class ParameterError(ReebError, ValueError):
    """A parameter is outside its range; ``name`` says which."""

    def __init__(self, message: str, name: str = ""):
        super().__init__(message)
        self.name = name


class MeshError(ReebError, ValueError):
    """The mesh cannot be decomposed; ``vertices`` and ``faces`` say where."""

    def __init__(self, message: str, vertices=(), faces=()):
        super().__init__(message)
        self.vertices = np.asarray(vertices, dtype=np.int64)
        self.faces = np.asarray(faces, dtype=np.int64)


class EmptyMeshError(MeshError):
    """No faces, too few of them, or no area."""


class DisconnectedMeshError(MeshError):
    """Some vertices cannot be reached from others where one component was promised."""
