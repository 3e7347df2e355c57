# SPDX-License-Identifier: GPL-3.0-or-later
"""What a process of its own does: decompose the shapes in a folder, put the results there, and say how far it is.

It says so on its standard output, a line of JSON for each message, see ``run``. Its standard input is a pipe from the
process that asked, which never writes to it: when the pipe is closed, that process has ended, however it did. This one
then removes the folder and ends, too.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
import traceback
from contextlib import suppress
from pathlib import Path
from typing import Any

from .errors import ReebError
from .handover import arguments, plain_error, read_request, read_shape, remove, write_result
from .memory import keep_freed_memory
from .parameters import Parameters
from .pipeline import decompose

# Seconds between two messages about progress; nobody looks more often.
INTERVAL = 0.02
# How far the window of the process that asked goes first where both want a processor, as of Unix's ``nice``. On two
# busy cores the window was drawn 0.6 times as often as before without it, and as often as before with it.
NICE = 10


def run(folder: Path) -> None:
    """Decompose all shapes of a request.

    Parameters
    ----------
    folder : Path
        With what ``handover.write_request`` wrote; results go there, too.

    Notes
    -----
    The messages are {"ready": true}, then for each shape {"shape", "stage", "share"} many times and one of
    {"shape", "done": true} and {"shape", "error"}, and in the end {"end": true}. If that does not come, the run has
    failed, and standard error has the reason. If memory runs out, {"failed": "memory"} says so before the process ends.
    """
    if sys.platform != "win32":  # there, who starts the process says so
        os.nice(NICE)
    keep_freed_memory()
    _end_with_parent(folder)
    say(ready=True)
    try:
        count, parameters = read_request(folder)
        for number in range(count):
            try:
                result = decompose(**_arguments(folder, number, parameters))
            except ReebError as error:
                say(shape=number, error=plain_error(error))
            else:
                write_result(folder, number, result)
                del result
                say(shape=number, done=True)
    except MemoryError:
        traceback.print_exc()
        say(failed="memory")
        sys.exit(1)
    say(end=True)


def say(**message: Any) -> None:
    """Write a message for the process that asked."""
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


def _arguments(folder: Path, number: int, parameters: Parameters) -> dict[str, Any]:
    """What ``decompose`` is called with for a shape."""
    said: list[Any] = ["", 0.0]  # the last stage, and when

    def progress(stage: str, share: float) -> None:
        _end_if_alone(folder)
        now = time.monotonic()
        if stage != said[0] or now >= said[1] + INTERVAL:
            said[:] = stage, now
            say(shape=number, stage=stage, share=float(share))

    return {**arguments(read_shape(folder, number)), "parameters": parameters, "progress": progress}


def _end_with_parent(folder: Path) -> None:
    """Have this process look whether it is alone when something happens to the pipe, as far as the system tells.

    Where the system does not, as on Windows, it is seen at the next step of the progress.
    """
    # Ctrl+C in the console is for the process that asked; that one decides what becomes of this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform != "win32":
        import fcntl

        os.set_blocking(0, False)
        signal.signal(signal.SIGIO, lambda *_: _end_if_alone(folder))
        with suppress(OSError):  # of a system that sends no signals for pipes
            fcntl.fcntl(0, fcntl.F_SETOWN, os.getpid())
            fcntl.fcntl(0, fcntl.F_SETFL, fcntl.fcntl(0, fcntl.F_GETFL) | os.O_ASYNC)
    _end_if_alone(folder)


def _end_if_alone(folder: Path) -> None:
    """Remove the folder and end at once if the process that asked has ended."""
    if not _is_alone():
        return
    os.close(1)  # files in the folder, which some systems do not remove while they are open
    os.close(2)
    remove(folder)
    os._exit(1)


def _is_alone() -> bool:
    """Whether the other end of the pipe is closed."""
    if sys.platform == "win32":
        import _winapi
        import msvcrt

        try:
            _winapi.PeekNamedPipe(msvcrt.get_osfhandle(0), 0)
        except BrokenPipeError:
            return True
        return False
    try:
        return os.read(0, 1) == b""
    except BlockingIOError:
        return False
