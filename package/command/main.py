# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the command begins: it hears signals from then on, while NumPy and SciPy take a second to be imported."""

from __future__ import annotations

import atexit
import io
import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from types import FrameType
from typing import Any

from ..core.interruptions import is_ending
from ..core.memory import lacks_memory
from .words import FAILED, INTERRUPTED, say


def main(arguments: list[str] | None = None) -> int:
    """The command; returns the exit status: 0 only if all went well, 130 after Ctrl+C."""
    # The last before Python gives signals back to the system, which would end the process with a status of its own.
    atexit.register(_hear_signals, signal.SIG_IGN)
    _hear_signals(_end)
    _open_standard_streams()
    try:
        from . import commands

        options = commands.parse(arguments)
        commands.import_readers()
    except (MemoryError, ImportError) as error:
        if not lacks_memory(f"{type(error).__name__}: {error}"):
            raise
        say("There is not enough memory.")
        return FAILED
    try:
        _hear_signals(_interrupt)
        return commands.run(options)
    except KeyboardInterrupt:
        say("Interrupted.")
        return INTERRUPTED
    finally:
        _hear_signals(_end)  # all is written, and what is left, such as Dask's end, need not be waited for


def _hear_signals(heard: Callable[[int, FrameType | None], object] | signal.Handlers) -> None:
    """Hear Ctrl+C, the request of the system to end, and the end of the terminal."""
    signal.signal(signal.SIGTERM, heard)
    for name in ("SIGINT", "SIGHUP"):
        number = getattr(signal, name, None)
        # As is Ctrl+C in the background of a script, and the end of the terminal after nohup.
        if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, heard)


def _open_standard_streams() -> None:
    """Have something in the places of standard streams that are closed, or the next files would get their numbers.

    What is said on standard error is lost where that cannot be written, and nothing else.
    """
    while (handle := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(handle, True)
    os.close(handle)
    if sys.stderr is sys.__stderr__:  # which is None where it was closed
        sys.stderr = io.TextIOWrapper(_Errors(2, "w", closefd=False), getattr(sys.stderr, "encoding", "utf-8"),
                                      "backslashreplace", line_buffering=True)


class _Errors(io.FileIO):
    """Standard error that takes what is written in any case, as to a full disk or a terminal that was closed."""

    def write(self, data: Any) -> int:
        with suppress(OSError):
            super().write(data)
        return len(data)


def _interrupt(number: int, frame: FrameType | None) -> None:
    """Raise KeyboardInterrupt; what it breaks off in the middle has nothing to say when it is collected."""
    sys.unraisablehook = lambda _: None
    if not is_ending():
        raise KeyboardInterrupt


def _end(number: int, frame: FrameType | None) -> None:
    """End the process at once: nothing is begun, or all is done, and modules half imported may take any exception."""
    _hear_signals(signal.SIG_IGN)  # Python cannot begin a line on standard error in the middle of another
    say("Interrupted.")
    os._exit(INTERRUPTED)
