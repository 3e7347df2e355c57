# SPDX-License-Identifier: GPL-3.0-or-later
"""A process that does one model after the other, with a limit of memory and of time.

What goes wrong there - a crash, an endless loop, all memory taken - ends that process and costs the model that it
was at; the next model gets a new one. It ends, too, when the process that started it has ended, however that did.
"""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from ..core.memory import lacks_memory
from .records import CRASH, MEMORY, TIME, Settings, digest_of, failure, write_record

LOOK = 0.5  # seconds between two looks at the memory of the process
START = 120.0  # seconds that the process may take to import everything, on a busy machine
LEAST = 2**24  # bytes without which no model can be done
GLANCE = 0.02  # seconds between two looks at what has come in, on Windows
STARTS = 2  # how often it is started for a model, if it ends before it is ready
KILLED = "it was killed"  # why it did not start, when the system or somebody ended it
ENDED: dict[str, Any] = {}  # in place of a message: there will be none any more


class ModelProcess:
    """The process, as the one that asks sees it. Not to be used by two threads at a time.

    Parameters
    ----------
    memory_limit : int
        Bytes; 0 for no limit.
    """

    def __init__(self, memory_limit: int = 0) -> None:
        self.memory_limit = memory_limit
        self._process: subprocess.Popen[bytes] | None = None
        self._messages: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
        self._errors: IO[bytes] | None = None

    def run(self, job: dict[str, Any], seconds: float) -> dict[str, Any]:
        """Have a model done.

        Parameters
        ----------
        job : dict
            As ``work.do_model`` takes it.
        seconds : float
            Limit of time; 0 for none.

        Returns
        -------
        answer : dict
            As ``work.do_model`` returns it. If the process had to be ended or ended itself, the record in the folder of
            the model says why.
        """
        start = time.monotonic()
        answer = self._attempt(job, seconds)
        if isinstance(answer, dict):
            return answer
        status, reason = answer
        self.close()
        with suppress(OSError):  # such as a full disk: it will be tried again
            settings = Settings.from_dict(job["settings"]).digest
            write_record(job, failure(job["name"], status, reason, settings, digest_of(Path(job["path"]))))
        return {"status": status, "reason": reason, "seconds": round(time.monotonic() - start, 4)}

    def _attempt(self, job: dict[str, Any], seconds: float) -> dict[str, Any] | tuple[str, str]:
        """Wait for the answer; what went wrong and why in place of it, if something did."""
        if self._process is None and (why := self._start_surely()):
            return self._crash("The process could not start: ", why)
        assert self._process is not None
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):  # it has ended meanwhile, as the next message says
            self._process.stdin.write(json.dumps(job).encode() + b"\n")
            self._process.stdin.flush()
        until = time.monotonic() + seconds
        while True:
            try:
                answer = self._messages.get(timeout=min(LOOK, max(until - time.monotonic(), 0.01))
                                            if seconds else LOOK)
                break
            except queue.Empty:
                if seconds and time.monotonic() > until:
                    return TIME, f"It took longer than {seconds:g} s."
                if self.memory_limit and self._memory(job["blender"] is not None) > self.memory_limit:
                    return MEMORY, self._too_much()
        if answer is ENDED:
            return self._end_of_process()
        if answer.get("memory"):
            return MEMORY, self._too_much()
        return answer

    def _start_surely(self) -> str:
        """Start the process, once more if it ends before it is ready; "" if it is ready, else why it is not."""
        why = ""
        for _ in range(STARTS):
            if self._start():
                return ""
            assert self._process is not None
            try:
                status = self._process.wait(LOOK)
            except subprocess.TimeoutExpired:  # it still runs, and has had all its time
                return f"it was not ready after {START:g} s"
            why = KILLED if status == -9 else self._last_words()
            self.close()
        return why

    def _start(self) -> bool:
        """Start the process; whether it is ready."""
        variables = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PYTHONUNBUFFERED": "1"}
        self._messages = queue.SimpleQueue()
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - it is closed with the process
        # It finds modules where this process does; "-m" would look into the working folder first.
        paths = ascii([path for path in sys.path if isinstance(path, str)])
        begin = f"import sys; sys.path[:] = {paths}; from {__name__} import main; main({self.memory_limit})"
        self._process = subprocess.Popen(  # the last word is for those who look at the list of processes
            [sys.executable, "-P", "-c", begin, __name__], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=self._errors, env=variables, start_new_session=True)
        threading.Thread(target=_listen, args=(self._process.stdout, self._messages), daemon=True).start()
        try:
            return bool(self._messages.get(timeout=START).get("ready"))
        except queue.Empty:
            return False

    def _memory(self, with_children: bool) -> int:
        """Bytes that the process, and a Blender that it started, have in memory."""
        import psutil

        assert self._process is not None
        total = 0
        with suppress(psutil.Error):
            own = psutil.Process(self._process.pid)
            # A look for children is one at all processes of the machine.
            for process in (own, *(own.children(recursive=True) if with_children else ())):
                with suppress(psutil.Error):
                    total += process.memory_info().rss
        return total

    def _too_much(self) -> str:
        limit = f" than {self.memory_limit / 2**30:.3g} GiB" if self.memory_limit else " than there is"
        return f"It needed more memory{limit}."

    def _end_of_process(self) -> tuple[str, str]:
        """What an end that nobody asked for means."""
        assert self._process is not None
        status = self._process.wait()
        if status == -9:
            return CRASH, "The process was killed, perhaps for lack of memory."
        cause = signal.Signals(-status).name if status < 0 else f"exit status {status}"
        return self._crash(f"The process crashed ({cause}): ", self._last_words())

    def _crash(self, what: str, words: str) -> tuple[str, str]:
        """What the end of a process means that said some words."""
        return (MEMORY, self._too_much()) if lacks_memory(words) else (CRASH, what + words)

    def _last_words(self) -> str:
        """The first line of what the process printed last."""
        if self._errors is None:
            return ""
        self._errors.seek(0)
        lines = [line for line in self._errors.read().decode(errors="replace").splitlines() if line.strip()]
        fatal = [line for line in lines if line.startswith("Fatal Python error")]
        return (fatal or lines[-1:] or ["it said nothing"])[0][:300]

    def close(self) -> None:
        """End the process, and all that it started."""
        if self._process is None:
            return
        with suppress(OSError):
            if hasattr(os, "killpg"):
                os.killpg(self._process.pid, signal.SIGKILL)
            else:
                self._process.kill()
        self._process.wait()
        assert self._process.stdin is not None
        with suppress(OSError):
            self._process.stdin.close()
        if self._errors is not None:
            self._errors.close()
        self._process = None


def _listen(pipe: IO[bytes], messages: queue.SimpleQueue[dict[str, Any]]) -> None:
    """Put each message of a pipe, a line with an object of JSON, into a queue, and in the end ENDED."""
    try:
        with pipe:
            for message in filter(None, map(_message, pipe)):
                messages.put(message)
    finally:
        messages.put(ENDED)


def _message(line: bytes) -> dict[str, Any] | None:
    """A message; None where it is something else, as what a Python prints when it starts."""
    try:
        message = json.loads(line)
    except ValueError:
        return None
    return message if isinstance(message, dict) else None


# In the process itself -----------------------------------------------------------------------


def main(memory_limit: int) -> None:
    """Do what comes in, a job a line, and answer a line for each."""
    import faulthandler

    # Whatever a reader prints goes to the errors; only answers go out.
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    faulthandler.enable()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it is for the process that asked
    jobs: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
    threading.Thread(target=_read_jobs, args=(jobs,), daemon=True).start()
    from .work import do_model

    _limit_memory(memory_limit)

    def say(**message: Any) -> None:
        answers.write(json.dumps(message) + "\n")
        answers.flush()

    say(ready=True)
    for job in iter(jobs.get, None):
        try:
            say(**do_model(job))
        except MemoryError:
            say(memory=True)


def _read_jobs(jobs: queue.SimpleQueue[dict[str, Any]]) -> None:
    """Put what comes in into a queue; end the process at once, whatever it does, when the one that asked has ended."""
    for line in _lines(0):
        jobs.put(json.loads(line))
    os._exit(1)


def _lines(descriptor: int) -> Iterator[bytes]:
    """Lines of a pipe as they come."""
    partial = b""
    while some := _next_bytes(descriptor):
        *lines, partial = (partial + some).split(b"\n")
        yield from lines


def _next_bytes(descriptor: int) -> bytes:
    """What comes through a pipe next; nothing at its end.

    While a thread waits in standard input, Windows loads no libraries that ask what standard input is: OpenBLAS would
    never be there. So the pipe is looked at now and then.
    """
    if sys.platform == "win32":
        import _winapi
        import msvcrt

        try:
            while not _winapi.PeekNamedPipe(msvcrt.get_osfhandle(descriptor), 0)[0]:
                time.sleep(GLANCE)
        except BrokenPipeError:
            return b""
    return os.read(descriptor, 1 << 16)


def _limit_memory(limit: int) -> None:
    """Have the system refuse more memory than this, where it can: that is an error, not an end.

    Not before everything is imported: OpenBLAS, refused the memory with which it starts, asks for it again and again
    for ever. Raises MemoryError where that has left no room for a model.
    """
    if limit and sys.platform == "linux":
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))
        bytearray(LEAST)
