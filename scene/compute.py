# SPDX-License-Identifier: GPL-3.0-or-later
"""From a shape to its decomposition, kept so that the redo panel need not compute it again."""

from dataclasses import replace

from .bridge import Shape
from .errors import load_core

# The last few decompositions, by what they depend on.
_done: dict[tuple, object] = {}
_KEEP = 3


def decomposition(shape: Shape, parameters, progress=None):
    """The decomposition of a shape; detail and number of parts can differ without computing again.

    Raises
    ------
    core.ReebError
        The mesh cannot be decomposed, or ``progress`` cancelled.
    """
    core = load_core()
    key = (shape.digest, replace(parameters, detail=0.5, n_parts=0))
    if key in _done:
        return replace(_done[key], parameters=parameters)
    result = core.decompose(shape.vertices, shape.triangles, parameters, shape.polygon, progress)
    _done[key] = result
    while len(_done) > _KEEP:
        del _done[next(iter(_done))]
    return result


def forget():
    """Free what is kept in memory."""
    _done.clear()
