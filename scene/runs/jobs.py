# SPDX-License-Identifier: GPL-3.0-or-later
"""A computation in a process of its own, watched from Blender's.

Blender stays alive meanwhile, whatever becomes of that process; where there can be none, it computes itself.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bpy.app.translations import pgettext_rpt as rpt_

from ...core import handover
from ...core.parameters import Parameters
from ..bridge import Shape
from ..errors import SceneError
from . import compute
from .compute import Outcome
from .processes import Worker


class Job:
    """The decomposition of some shapes.

    Parameters
    ----------
    shapes : list of (object name, Shape)
    parameters : Parameters
    begin : float
        How far all is when it starts, 0..1.

    Attributes
    ----------
    stage : str
        What core calls what it is doing.
    of : str
        Name of the object it is doing it to, "" if there is only one.
    share : float
        How far it is, 0..1.
    in_blender : bool
        Whether Blender itself has to compute, which ``poll`` then does.
    cancelled : bool
    result : list of Outcome or None
        In the order of the shapes; None until all is done.
    error : Exception or None
        Why there will be no result.
    """

    def __init__(self, shapes: list[tuple[str, Shape]], parameters: Parameters, begin: float = 0.0) -> None:
        self.stage, self.of, self.share, self._begin = "", "", begin, begin
        self.in_blender = self.cancelled = False
        self.result: list[Outcome] | None = None
        self.error: Exception | None = None
        self._shapes, self._parameters = shapes, parameters
        self._found: dict[tuple, Any] = {}  # a Decomposition or an error of core, by compute.key_of
        self._missing: list[int] = []  # shapes that are computed
        self._worker: Worker | None = None
        self._ready = False

    def start(self) -> None:
        """Start the process, unless all has been computed before."""
        for index, (_, shape) in enumerate(self._shapes):
            key = compute.key_of(shape, self._parameters)
            if key not in self._found:
                self._found[key] = compute.known(shape, self._parameters)
                self._missing += [index] if self._found[key] is None else []
        if not self._missing:
            self._finish()
            return
        try:
            self._worker = Worker([self._shapes[index][1] for index in self._missing], self._parameters)
        except OSError:  # no interpreter, no room for the arrays, no right to start it
            self.in_blender = True

    def cancel(self) -> None:
        """End it now."""
        self.cancelled = True
        self._close()

    @property
    def running(self) -> bool:
        return self.result is None and self.error is None and not self.cancelled

    @property
    def text(self) -> str:
        """What it is doing, in the language of the interface."""
        stage = rpt_(self.stage) if self.stage else rpt_("starting")
        return f"{self.of}: {stage}" if self.of else stage

    @property
    def pid(self) -> int | None:
        """Number of the process, while there is one."""
        return None if self._worker is None else self._worker.pid

    def poll(self, show: Callable[[], None] = lambda: None) -> None:
        """See how far it is.

        show : called when there is something to show while Blender itself computes, which is all done in this call.
        """
        if not self.running:
            return
        try:
            if self.in_blender:
                self._compute_here(show)
            else:
                self._listen()
        except Exception as error:  # noqa: BLE001 - whoever asks for the result raises it, when all is closed
            self.error = error
        if not self.running:
            self._close()

    def _compute_here(self, show: Callable[[], None]) -> None:
        def progress(stage: str, share: float, of: str = "") -> None:
            self.stage, self.share, self.of = stage, self._of_all(share), of
            show()

        self.result = compute.compute_all(self._shapes, self._parameters, progress)

    def _listen(self) -> None:
        """Take what the process has said; raises SceneError if it has ended before its time."""
        assert self._worker is not None
        ended = self._worker.ended  # asked first: what it says last is not missed
        for message in self._worker.messages():
            self._take(message)
        if self.result is not None or not ended:
            return
        if self._ready or self._worker.lacked_memory():
            raise self._failure()
        # Python could not be started properly: it cannot load NumPy, say, because the system does not let it.
        self._worker.pass_on_complaints()
        self._close()
        self.in_blender = True

    def _take(self, message: dict[str, Any]) -> None:
        """Understand one message; see core.worker.run."""
        self._ready = True
        if "stage" in message:
            self._at(message["shape"])
            share = self._of_all((self._index + message["share"]) / len(self._shapes))
            self.stage, self.share = message["stage"], max(self.share, share)
        elif "error" in message or "done" in message:
            self._at(message["shape"])
            self._receive(message)
        elif "failed" in message:
            raise self._failure(memory=True)
        elif "end" in message:
            self._finish()

    def _of_all(self, share: float) -> float:
        """How far all is, by how far the computation is."""
        return self._begin + share * (1.0 - self._begin)

    def _at(self, number: int) -> None:
        """The process is at a shape of those that it was given."""
        self._index = self._missing[number]
        self.of = self._shapes[self._index][0] if len(self._shapes) > 1 else ""

    _index = 0

    def _receive(self, message: dict[str, Any]) -> None:
        """Take over what became of a shape."""
        assert self._worker is not None
        shape = self._shapes[self._index][1]
        found: Any
        if "error" in message:
            found = handover.error_of(message["error"])
        else:
            try:
                found = handover.read_result(self._worker.folder, message["shape"])
            except OSError as error:
                raise self._failure(reason=str(error)) from error
            except MemoryError as error:
                raise self._failure(memory=True) from error
            compute.remember(shape, self._parameters, found)
        self._found[compute.key_of(shape, self._parameters)] = found

    def _failure(self, memory: bool = False, reason: str = "") -> SceneError:
        """Why the process has ended before its time, as the sentence for the user."""
        assert self._worker is not None
        name, shape = self._shapes[self._index if self._ready else self._missing[0]]
        self._worker.pass_on_complaints()
        if memory or self._worker.lacked_memory():
            return compute.lacking_memory(name, shape)
        return SceneError(
            rpt_("The process that decomposed {name} ended unexpectedly ({reason}); nothing was changed. Try again, "
                 "and report it if that happens again.").format(name=name, reason=reason or self._worker.reason()))

    def _finish(self) -> None:
        keys = [compute.key_of(shape, self._parameters) for _, shape in self._shapes]
        computed = {keys[index] for index in self._missing}
        self.result = [Outcome.of(name, shape, self._found[key], key not in computed)
                       for (name, shape), key in zip(self._shapes, keys, strict=True)]

    def _close(self) -> None:
        """End the process and remove what it has worked with."""
        if self._worker is not None:
            self._worker.close()
            self._worker = None


class Progress:
    """Work that Blender itself does in steps, see stepped.SteppedOperator; the window shows it as it shows a job.

    Parameters
    ----------
    stage : str
        What it is doing.
    """

    def __init__(self, stage: str) -> None:
        self.stage, self.share, self.cancelled = stage, 0.0, False

    @property
    def text(self) -> str:
        """What it is doing, in the language of the interface."""
        return rpt_(self.stage)

    def cancel(self) -> None:
        """End it at the next step."""
        self.cancelled = True


# What the window shows, if anything.
current: Job | Progress | None = None


def cancel() -> None:
    """End what the window shows, if there is anything."""
    if current is not None:
        current.cancel()
