# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's own Python in a process of its own, which computes on arrays in a private folder."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

import bpy

from ...core import handover
from ...core.memory import lacks_memory
from ...core.parameters import Parameters
from ..bridge import Shape
from ..errors import load_core

# What the process executes: where the extension is and the folder it works in come first, then where its libraries
# are. Nothing else is looked for anywhere but in Python's standard library.
_START = """import sys
own, folder, *libraries = sys.argv[1:]
sys.path = [own, *sys.path, *libraries]
import pathlib
from core.worker import run
run(pathlib.Path(folder))
"""
# For Windows: no console, and Blender's window goes first, see core.worker.NICE.
_FLAGS = getattr(subprocess, "CREATE_NO_WINDOW", 0) | getattr(subprocess, "BELOW_NORMAL_PRIORITY_CLASS", 0)
# Exit statuses of Windows where there is no memory left: STATUS_NO_MEMORY, STATUS_COMMITMENT_LIMIT.
_NO_MEMORY = {0xC0000017, 0xC000012D}


def interpreter() -> str | None:
    """Blender's Python, or that which Blender is a module of; None where another program is around it."""
    path = sys.executable
    if not path or not os.path.basename(path).lower().startswith("python") or not os.access(path, os.X_OK):
        return None
    return path


class Worker:
    """A process that decomposes shapes.

    Parameters
    ----------
    shapes : list of Shape
    parameters : Parameters
    threads : int
        How many its libraries may use, 0 for as many as there are processors.

    Attributes
    ----------
    folder : Path
        Where arrays and results are handed over; removed by ``close``.
    pid : int
        Number of the process.

    Raises
    ------
    OSError
        There is no interpreter, or the folder or the process cannot be made.
    """

    def __init__(self, shapes: list[Shape], parameters: Parameters, threads: int = 0) -> None:
        python = interpreter()
        if python is None:
            raise FileNotFoundError("python")
        # Only its owner can open it.
        self.folder = Path(tempfile.mkdtemp(prefix="reeb_parts_", dir=bpy.app.tempdir or None))
        try:
            handover.write_request(self.folder, [shape.arrays for shape in shapes], parameters)
            self._process = self._start(python, threads)
        except BaseException:
            handover.remove(self.folder)
            raise
        self._messages = open(self.folder / "messages", "rb")  # noqa: SIM115 - read until the process has ended
        self._partial = b""

    def _start(self, python: str, threads: int) -> subprocess.Popen:
        """Start Python, without the user's own packages and settings, and without a window."""
        own = os.path.dirname(load_core().__path__[0])
        options = dict.fromkeys(["-I", "-S", *bpy.app.python_args, *(["-B"] if sys.dont_write_bytecode else [])])
        command = [python, *options, "-c", _START, own, str(self.folder), *_libraries()]
        around = os.environ | {"OMP_NUM_THREADS": str(threads)} if threads else None
        with open(self.folder / "messages", "wb") as out, open(self.folder / "errors", "wb") as errors:
            return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=out, stderr=errors, creationflags=_FLAGS,
                                    env=around)

    @property
    def pid(self) -> int:
        return self._process.pid

    @property
    def ended(self) -> bool:
        """Whether the process has ended, however it did."""
        return self._process.poll() is not None

    def messages(self) -> list[dict[str, Any]]:
        """What it has said since the last time, see core.worker.run; does not wait."""
        *lines, self._partial = (self._partial + self._messages.read()).split(b"\n")
        found = []
        for line in lines:
            with suppress(ValueError):  # a library may print something
                message = json.loads(line)
                found += [message] if isinstance(message, dict) else []
        return found

    def complaints(self) -> str:
        """What it has written about errors."""
        with suppress(OSError):
            return (self.folder / "errors").read_text(encoding="utf-8", errors="replace")
        return ""

    def pass_on_complaints(self) -> None:
        """Write them where Blender writes its own, for whoever looks for the cause."""
        if sys.stderr is not None:  # as it is for programs without a console on Windows
            sys.stderr.write(self.complaints())

    def lacked_memory(self) -> bool:
        """Whether it has ended because there was no memory left, as far as that can be told."""
        status = self._process.poll()
        # Where memory runs out, Linux and macOS end a process by this signal.
        return status == -9 or status in _NO_MEMORY or lacks_memory(self.complaints())

    def reason(self) -> str:
        """Why it has ended, in a few words."""
        status = self._process.poll()
        if status is not None and status < 0:
            return f"signal {-status}"
        lines = [line for line in self.complaints().splitlines() if line.strip()]
        return lines[-1].strip()[:200] if lines else f"exit status {status}"

    def close(self) -> None:
        """End the process now, if it still runs, and remove the folder."""
        with suppress(OSError):
            self._process.kill()
        self._process.wait()
        if self._process.stdin:
            self._process.stdin.close()
        self._messages.close()
        handover.remove(self.folder)


def _libraries() -> list[str]:
    """Folders in which this process found NumPy and SciPy, in the order in which it looks for modules."""
    found = {os.path.dirname(importlib.import_module(name).__path__[0]) for name in ("numpy", "scipy")}
    return sorted(found, key=lambda folder: sys.path.index(folder) if folder in sys.path else len(sys.path))
