# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the command begins: it hears signals from then on, while NumPy and SciPy take a second to be imported."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from types import FrameType

from .words import say

INTERRUPTED = 130


def main(arguments: list[str] | None = None) -> int:
    """The command; returns the exit status: 0 only if all went well, 130 after Ctrl+C."""
    _hear_signals(_end)
    from . import commands

    options = commands.parse(arguments)
    commands.import_readers()
    try:
        _hear_signals(signal.default_int_handler)
        return commands.run(options)
    except KeyboardInterrupt:
        say("Interrupted.")
        return INTERRUPTED


def _hear_signals(heard: Callable[[int, FrameType | None], object]) -> None:
    """Hear Ctrl+C, the request of the system to end, and the end of the terminal."""
    signal.signal(signal.SIGTERM, heard)
    for name in ("SIGINT", "SIGHUP"):
        number = getattr(signal, name, None)
        # As is Ctrl+C in the background of a script, and the end of the terminal after nohup.
        if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, heard)


def _end(number: int, frame: FrameType | None) -> None:
    """End the process at once: nothing has been begun, and modules that are half imported may take any exception."""
    say("Interrupted.")
    os._exit(INTERRUPTED)
