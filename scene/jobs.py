# SPDX-License-Identifier: GPL-3.0-or-later
"""A computation in a thread of its own, watched from Blender's.

The thread works on arrays and never touches Blender's data; Blender's thread asks how far it is.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from bpy.app.translations import pgettext_rpt as rpt_

from .errors import load_core


class Job:
    """Runs ``work(progress)`` in a thread.

    Attributes
    ----------
    stage : str
        What core calls what it is doing.
    of : str
        Name of the object it is doing it to, "" if there is only one.
    share : float
        How far it is, 0..1.
    result
        What ``work`` returned; None until then.
    error : Exception or None
        What it raised instead.
    """

    def __init__(self, work: Callable[[Callable[..., None]], object]) -> None:
        self.stage, self.of, self.share = "", "", 0.0
        self.result: Any = None
        self.error: BaseException | None = None
        self._cancelled_error = load_core().Cancelled
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, args=(work,), name="Reeb Parts", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def cancel(self) -> None:
        """Ask it to stop at the next step."""
        self._stop.set()

    @property
    def cancelled(self) -> bool:
        return self._stop.is_set()

    @property
    def running(self) -> bool:
        return self._thread.is_alive()

    @property
    def text(self) -> str:
        """What it is doing, in the language of the interface; for Blender's thread."""
        stage = rpt_(self.stage)
        return f"{self.of}: {stage}" if self.of else stage

    def _run(self, work: Callable[[Callable[..., None]], object]) -> None:
        try:
            self.result = work(self._progress)
        except BaseException as error:  # noqa: BLE001 - carried to the thread that asked, raised there
            self.error = error

    def _progress(self, stage: str, share: float, of: str = "") -> None:
        self.stage, self.share, self.of = stage, share, of
        if self._stop.is_set():
            raise self._cancelled_error


# The job that the window shows, if any.
current: Job | None = None


def cancel() -> None:
    """Ask the job that the window shows to stop, if there is one."""
    if current is not None:
        current.cancel()
