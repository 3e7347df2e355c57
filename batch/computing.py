# SPDX-License-Identifier: GPL-3.0-or-later
"""The decompositions of the objects of a run: several small ones are computed side by side, ahead of their turn."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext

import bpy

from ..core.errors import ReebError
from ..core.parameters import Parameters
from ..core.processors import n_processors
from ..core.progress import said_in_steps
from ..scene import bridge, targets
from ..scene.errors import SceneError
from ..scene.modes import leave_edit_mode
from ..scene.runs.compute import Outcome
from ..scene.runs.jobs import computed
from ..scene.runs.spreading import MOST_AT_A_TIME
from .messages import say


class Computations:
    """The decompositions of some objects, each when it is asked for.

    Parameters
    ----------
    objects : list of bpy.types.Object
        In the order in which they will be asked for; some of them may never be.
    parameters : Parameters
    hints : str
        As ``bridge.read_shape`` takes it.
    """

    def __init__(self, objects: list[bpy.types.Object], parameters: Parameters, hints: str) -> None:
        self._parameters, self._hints = parameters, hints
        self._found: dict[bpy.types.Object, Outcome] = {}
        first: dict[bpy.types.ID | None, bpy.types.Object] = {}  # of those that share a mesh
        for obj in objects:
            first.setdefault(obj.data, obj)
        self._ahead = list(first.values())

    def outcome(self, obj: bpy.types.Object) -> Outcome:
        """The decomposition of an object that can be decomposed, in its scene; raises what the user should hear."""
        if obj not in self._found:
            self._found = self._side_by_side(self._group(obj))
        outcome = self._found.pop(obj, None) or self._alone(obj)
        if outcome.decomposition is None:
            raise SceneError(f"{obj.name}: {outcome.problem}")
        return outcome

    def _group(self, obj: bpy.types.Object) -> list[bpy.types.Object]:
        """An object and those that follow, as many as are computed and kept in memory at a time."""
        if obj not in self._ahead:  # such as the second of two that share a mesh, the first of which went wrong
            return []
        del self._ahead[:self._ahead.index(obj)]
        size, group = 0, []
        while self._ahead and (size := size + _size(self._ahead[0])) <= MOST_AT_A_TIME:
            group.append(self._ahead.pop(0))
        return group

    def _side_by_side(self, group: list[bpy.types.Object]) -> dict[bpy.types.Object, Outcome]:
        """What becomes of several objects; of those that are left out, nothing is known.

        Whatever goes wrong with one is said when its turn comes: it is then computed alone.
        """
        if len(group) < 2 or n_processors() < 2:
            return {}
        read = {}
        for obj in group:
            try:
                with in_its_scene(obj):
                    leave_edit_mode(bpy.context)
                    targets.check_object(obj)
                    read[obj] = bridge.read_shape(obj, self._hints)
            except (SceneError, ReebError, MemoryError):
                continue
        tell = said_in_steps(say)
        try:
            outcomes = computed([(obj.name, shape) for obj, shape in read.items()], self._parameters,
                                lambda stage, share: tell(f"{len(read)} objects:", share))
        except SceneError:
            return {}
        return dict(zip(read, outcomes, strict=True))

    def _alone(self, obj: bpy.types.Object) -> Outcome:
        """What becomes of one object in this process."""
        shape = bridge.read_shape(obj, self._hints)
        progress = said_in_steps(lambda line: say(f"{obj.name}: {line}"))
        return computed([(obj.name, shape)], self._parameters, progress)[0]


def _size(obj: bpy.types.Object) -> int:
    """Number of vertices of an object before its modifiers."""
    return len(obj.data.vertices) if obj.type == "MESH" else 0


def in_its_scene(obj: bpy.types.Object) -> AbstractContextManager:
    """A context with the scene of an object that is not in the one that is open: what is made of it goes there."""
    scenes = obj.users_scene
    if not scenes or bpy.context.scene in scenes:
        return nullcontext()
    layers = scenes[0].view_layers
    for layer in layers:
        layer.update()  # one that nobody has looked at does not know its objects
    layer = next((layer for layer in layers if obj in layer.objects.values()), layers[0])
    return bpy.context.temp_override(scene=scenes[0], view_layer=layer)
