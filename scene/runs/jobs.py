# SPDX-License-Identifier: GPL-3.0-or-later
"""A computation in processes of its own, watched from Blender's.

Blender stays alive meanwhile, whatever becomes of these processes; where there can be none, it computes itself.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from bpy.app.translations import pgettext_rpt as rpt_

from ...core import handover
from ...core.parameters import Parameters
from ...core.processors import n_processors
from ..bridge import Shape
from ..errors import SceneError
from . import compute
from .compute import Outcome
from .processes import Worker
from .spreading import spread

INTERVAL = 0.02  # seconds between two looks at the processes where nothing is drawn meanwhile


@dataclass(eq=False)
class _Task:
    """One of the processes of a job.

    Attributes
    ----------
    worker : Worker
    numbers : list of int
        Which shapes of the job it was given, in order.
    at : int
        The shape of the job that it is at.
    ready, over : bool
        Whether it has said anything, and whether it has done everything.
    """

    worker: Worker
    numbers: list[int]
    at: int
    ready: bool = False
    over: bool = False


class Job:
    """The decomposition of some shapes; several small ones are computed side by side.

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
    n_vertices : int
        Of all shapes.
    """

    def __init__(self, shapes: list[tuple[str, Shape]], parameters: Parameters, begin: float = 0.0) -> None:
        self.stage, self.of, self.share, self._begin = "", "", begin, begin
        self.in_blender = self.cancelled = False
        self.result: list[Outcome] | None = None
        self.error: Exception | None = None
        self.n_vertices = sum(len(shape.vertices) for _, shape in shapes)
        self._shapes, self._parameters = shapes, parameters
        self._found: dict[tuple, Any] = {}  # a Decomposition or an error of core, by compute.key_of
        self._missing: dict[int, float] = {}  # shapes that are computed, and how far each of them is, 0..1
        self._tasks: list[_Task] = []

    def start(self) -> None:
        """Start the processes, unless all has been computed before."""
        for index, (_, shape) in enumerate(self._shapes):
            key = compute.key_of(shape, self._parameters)
            if key not in self._found:
                self._found[key] = compute.known(shape, self._parameters)
                if self._found[key] is None:
                    self._missing[index] = 0.0
        if not self._missing:
            self._finish()
            return
        missing = list(self._missing)
        groups = spread([len(self._shapes[index][1].vertices) for index in missing], n_processors())
        try:
            for group in groups:
                self._start([missing[place] for place in group], len(groups))
        except BaseException as error:
            self._close()
            if not isinstance(error, OSError):  # no interpreter, no room for the arrays, no right to start it
                raise
            self.in_blender = True

    def _start(self, numbers: list[int], count: int) -> None:
        """Start one of ``count`` processes, for some of the shapes."""
        threads = max(n_processors() // count, 1) if count > 1 else 0
        shapes = [self._shapes[index][1] for index in numbers]
        self._tasks.append(_Task(Worker(shapes, self._parameters, threads), numbers, numbers[0]))

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
        """Number of the process, of the first if there are several, while there is one."""
        return self._tasks[0].worker.pid if self._tasks else None

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

        self.result = compute.compute_all(self._shapes, self._parameters, progress, self.outcomes)

    def _listen(self) -> None:
        """Take what the processes have said; raises SceneError if one has ended before its time."""
        ended = [task.worker.ended for task in self._tasks]  # asked first: what they say last is not missed
        for task in self._tasks:
            for message in task.worker.messages():
                self._take(task, message)
        for task in [task for task, has_ended in zip(self._tasks, ended, strict=True) if has_ended]:
            if task.over:
                continue
            if task.ready or task.worker.lacked_memory():
                raise self._failure(task)
            # Python could not be started properly: it cannot load NumPy, say, because the system does not let it.
            task.worker.pass_on_complaints()
            self._close()
            self.in_blender = True
            return
        if all(task.over for task in self._tasks):
            self._finish()

    def _take(self, task: _Task, message: dict[str, Any]) -> None:
        """Understand one message of a process; see core.worker.run."""
        task.ready = True
        if "shape" in message:
            task.at = task.numbers[message["shape"]]
        if "stage" in message:
            self._show(task, message["stage"], message["share"])
        elif "error" in message or "done" in message:
            self._receive(task, message)
        elif "failed" in message:
            raise self._failure(task, memory=True)
        elif "end" in message:
            task.over = True

    def _show(self, task: _Task, stage: str, share: float) -> None:
        """A process is at a stage of a shape. Of several, what the first does that is not done is what is shown."""
        self._missing[task.at] = share
        known = len(self._shapes) - len(self._missing)
        self.share = max(self.share, self._of_all((known + sum(self._missing.values())) / len(self._shapes)))
        if task is next(other for other in self._tasks if not other.over):
            self.stage, self.of = stage, self._shapes[task.at][0] if len(self._shapes) > 1 else ""

    def _of_all(self, share: float) -> float:
        """How far all is, by how far the computation is."""
        return self._begin + share * (1.0 - self._begin)

    def _receive(self, task: _Task, message: dict[str, Any]) -> None:
        """Take over what became of a shape."""
        shape = self._shapes[task.at][1]
        found: Any
        if "error" in message:
            found = handover.error_of(message["error"])
        else:
            try:
                found = handover.read_result(task.worker.folder, message["shape"])
            except OSError as error:
                raise self._failure(task, reason=str(error)) from error
            except MemoryError as error:
                raise self._failure(task, memory=True) from error
            compute.remember(shape, self._parameters, found)
        self._missing[task.at] = 1.0
        self._found[compute.key_of(shape, self._parameters)] = found

    def _failure(self, task: _Task, memory: bool = False, reason: str = "") -> SceneError:
        """Why a process has ended before its time, as the sentence for the user."""
        name, shape = self._shapes[task.at]
        task.worker.pass_on_complaints()
        if memory or task.worker.lacked_memory():
            return compute.lacking_memory(name, shape)
        return SceneError(
            rpt_("The process that decomposed {name} ended unexpectedly ({reason}); nothing was changed. Try again, "
                 "and report it if that happens again.").format(name=name, reason=reason or task.worker.reason()))

    @property
    def outcomes(self) -> dict[int, Outcome]:
        """What is there by now, whatever has gone wrong, by the place of its shape."""
        keys = [compute.key_of(shape, self._parameters) for _, shape in self._shapes]
        computed = {keys[index] for index in self._missing}
        return {index: Outcome.of(name, shape, self._found[key], key not in computed)
                for index, ((name, shape), key) in enumerate(zip(self._shapes, keys, strict=True))
                if self._found.get(key) is not None}

    def _finish(self) -> None:
        self.result = list(self.outcomes.values())

    def _close(self) -> None:
        """End the processes and remove what they have worked with."""
        while self._tasks:
            self._tasks.pop().worker.close()


def computed(shapes: list[tuple[str, Shape]], parameters: Parameters,
             progress: Callable[[str, float], None] = lambda stage, share: None) -> list[Outcome]:
    """Decompose shapes while the caller waits, several of them side by side.

    Parameters
    ----------
    shapes : list of (object name, Shape)
    parameters : Parameters
    progress : callable(stage, share)
        What it raises ends everything.

    Raises
    ------
    SceneError
        There is not enough memory.
    """
    received = {}
    if len(shapes) > 1 and n_processors() > 1:
        job = Job(shapes, parameters)
        try:
            job.start()
            while job.running:
                job.poll(lambda: progress(job.stage, job.share))
                progress(job.stage, job.share)
                time.sleep(INTERVAL)
        finally:
            job.cancel()
        if job.result is not None:
            return job.result
        received = job.outcomes
    # Alone, or after something went wrong with a process: whatever is computed here needs memory for one at a time.
    return compute.compute_all(shapes, parameters, lambda stage, share, of="": progress(stage, share), received)


class Progress:
    """Work that Blender itself does in steps, see stepped.SteppedOperator; the window shows it as it shows a job.

    Parameters
    ----------
    stage : str
        What it is doing.
    """

    def __init__(self, stage: str) -> None:
        self.stage, self.of, self.share, self.cancelled = stage, "", 0.0, False

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
