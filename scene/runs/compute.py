# SPDX-License-Identifier: GPL-3.0-or-later
"""From shapes to decompositions; no Blender data is touched.

The last few decompositions are kept, so that the redo panel need not compute them again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bpy.app.translations import pgettext_rpt as rpt_

from ...core.errors import Cancelled, ReebError
from ...core.handover import arguments
from ...core.parameters import Parameters
from ..bridge import Shape
from ..errors import SceneError, load_core

if TYPE_CHECKING:
    from ...core.result.decomposition import Decomposition


# The last few decompositions, by what they depend on.
_done: dict[tuple, Decomposition] = {}
_KEEP = 3


@dataclass(frozen=True, eq=False)
class Outcome:
    """What became of one object: a decomposition, or the sentence why there is none.

    seconds : how long it was computed, 0 where it was known.
    """

    object_name: str
    shape: Shape
    decomposition: Decomposition | None = None
    problem: str = ""  # a core.sentence.Sentence
    seconds: float = 0.0

    @classmethod
    def of(cls, name: str, shape: Shape, found: Decomposition | ReebError, was_known: bool) -> Outcome:
        """The outcome for an object, from what core returned or raised, or from what was known before."""
        if isinstance(found, ReebError):
            return cls(name, shape, problem=shape.problem or found.args[0])
        return cls(name, shape, found, seconds=0.0 if was_known else sum(found.seconds.values()))


def compute_all(shapes: list[tuple[str, Shape]], parameters: Parameters,
                progress: Callable[..., None], received: Mapping[int, Outcome] | None = None) -> list[Outcome]:
    """Decompose shapes one after the other; no Blender data is touched.

    Parameters
    ----------
    shapes : list of (object name, Shape)
    parameters : Parameters
    progress : callable(stage, share, name of the object if there are several)
        What it raises ends everything.
    received : mapping of int -> Outcome, optional
        What need not be computed, by the place of its shape.

    Raises
    ------
    SceneError
        There is not enough memory.
    """
    outcomes = []
    for index, (name, shape) in enumerate(shapes):
        if received and index in received:
            outcomes.append(received[index])
            continue
        told = (name,) if len(shapes) > 1 else ()

        def step(stage: str, share: float, index: int = index, told: tuple[str, ...] = told) -> None:
            progress(stage, (index + share) / len(shapes), *told)

        found: Decomposition | ReebError
        was_known = key_of(shape, parameters) in _done
        try:
            found = decomposition(shape, parameters, step)
        except Cancelled:
            raise
        except ReebError as error:
            found = error
        except MemoryError as error:
            raise lacking_memory(name, shape) from error
        outcomes.append(Outcome.of(name, shape, found, was_known))
    return outcomes


def lacking_memory(name: str, shape: Shape) -> SceneError:
    """The sentence that an object could not be computed for lack of memory."""
    return SceneError(
        rpt_("There is not enough memory to decompose {name} ({n} vertices); nothing was changed. Close other "
             "programs, or decimate a copy and decompose that.").format(name=name, n=len(shape.vertices)))


def decomposition(shape: Shape, parameters: Parameters,
                  progress: Callable[[str, float], None] | None = None) -> Decomposition:
    """The decomposition of a shape; detail and number of parts can differ without computing again.

    Raises
    ------
    ReebError
        The mesh cannot be decomposed, or ``progress`` cancelled.
    """
    core = load_core()
    found = known(shape, parameters)
    if found is None:
        found = core.decompose(**arguments(shape.arrays), parameters=parameters, progress=progress)
        remember(shape, parameters, found)
    return found


def key_of(shape: Shape, parameters: Parameters) -> tuple:
    """What a decomposition depends on."""
    return shape.digest, shape.mirror.tobytes(), shape.hints.tobytes(), replace(parameters, detail=0.5, n_parts=0)


def known(shape: Shape, parameters: Parameters) -> Decomposition | None:
    """The decomposition of a shape if it is among the last few."""
    found = _done.get(key_of(shape, parameters))
    return found and found.asked(parameters)


def remember(shape: Shape, parameters: Parameters, found: Decomposition) -> None:
    """Keep a decomposition, and forget the oldest but a few."""
    _done[key_of(shape, parameters)] = found
    while len(_done) > _KEEP:
        del _done[next(iter(_done))]


def forget() -> None:
    """Free what is kept in memory."""
    _done.clear()
