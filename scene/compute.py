# SPDX-License-Identifier: GPL-3.0-or-later
"""From shapes to decompositions; no Blender data is touched, so this can run in a thread.

The last few decompositions are kept, so that the redo panel need not compute them again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ..core.errors import Cancelled, ReebError
from ..core.parameters import Parameters
from .bridge import Shape
from .errors import load_core

if TYPE_CHECKING:
    from ..core.result.decomposition import Decomposition


# The last few decompositions, by what they depend on.
_done: dict[tuple, Decomposition] = {}
_KEEP = 3


@dataclass(frozen=True, eq=False)
class Outcome:
    """What became of one object: a decomposition, or the sentence why there is none."""

    object_name: str
    shape: Shape
    decomposition: Decomposition | None = None
    problem: str = ""  # a core.sentence.Sentence
    seconds: float = 0.0


def compute_all(shapes: list[tuple[str, Shape]], parameters: Parameters,
                progress: Callable[..., None]) -> list[Outcome]:
    """Decompose shapes one after the other; no Blender data is touched.

    Parameters
    ----------
    shapes : list of (object name, Shape)
    parameters : Parameters
    progress : callable(stage, share, name of the object if there are several)
        What it raises ends everything.
    """
    outcomes = []
    for index, (name, shape) in enumerate(shapes):
        told = (name,) if len(shapes) > 1 else ()

        def step(stage: str, share: float, index: int = index, told: tuple[str, ...] = told) -> None:
            progress(stage, (index + share) / len(shapes), *told)

        try:
            result = decomposition(shape, parameters, step)
        except Cancelled:
            raise
        except ReebError as error:
            outcomes.append(Outcome(name, shape, problem=error.args[0]))
        else:
            outcomes.append(Outcome(name, shape, result, seconds=sum(result.seconds.values())))
    return outcomes


def decomposition(shape: Shape, parameters: Parameters,
                  progress: Callable[[str, float], None] | None = None) -> Decomposition:
    """The decomposition of a shape; detail and number of parts can differ without computing again.

    Raises
    ------
    ReebError
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


def forget() -> None:
    """Free what is kept in memory."""
    _done.clear()
