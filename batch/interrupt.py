# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl+C, the request of the system to end and the end of the terminal: what is being written is taken back first."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from ..core.interruptions import is_ending

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Interrupted(KeyboardInterrupt):
    """The run was asked to end; ``status`` is what the command returns, 130 for Ctrl+C as shells have it."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.status = 128 + number


class Interrupts:
    """Turns signals into ``Interrupted`` where that is allowed, and keeps them until then elsewhere.

    Blender's own handler only counts them, and its operators in Python swallow exceptions.
    """

    def __init__(self) -> None:
        self._number = 0
        self._allowed = False

    @contextmanager
    def heard(self) -> Iterator[None]:
        """Listen to signals meanwhile."""
        former = {number: signal.signal(number, self._on_signal) for number in _signals()}
        try:
            yield
        finally:
            for number, handler in former.items():
                # None stands for a handler that is not Python's and cannot be set again. After a signal the process is
                # about to end: another one would only change its status, and leave Blender's temporary files.
                signal.signal(number, signal.SIG_IGN if self._number else handler or signal.SIG_DFL)

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        self._number = self._number or number
        if self._allowed and not is_ending():
            raise Interrupted(number)

    def check(self) -> None:
        """Raise Interrupted if a signal has come."""
        if self._number:
            raise Interrupted(self._number)

    @contextmanager
    def allowed(self) -> Iterator[None]:
        """Let signals end what is done meanwhile at once."""
        self.check()
        self._allowed = True
        try:
            yield
        finally:
            self._allowed = False
            # Whatever came of it: the signal was the cause, or will be reason enough.
            self.check()


def _signals() -> tuple[signal.Signals, ...]:
    """What is listened to: the end of the terminal only where there is that signal, and nohup has it not ignored."""
    hangup = getattr(signal, "SIGHUP", None)
    return SIGNALS if hangup is None or signal.getsignal(hangup) is signal.SIG_IGN else (*SIGNALS, hangup)
