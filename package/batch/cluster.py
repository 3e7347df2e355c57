# SPDX-License-Identifier: GPL-3.0-or-later
"""Work spread over the workers of a Dask cluster: the one that is there, or one that is made on this machine."""

from __future__ import annotations

import contextlib
import logging
import os
import signal
import threading
import time
from collections.abc import Callable, Generator, Iterable, Iterator
from itertools import islice
from multiprocessing import resource_tracker
from typing import Any

import dask
import dask.utils
from dask.system import cpu_count
from distributed import Client, LocalCluster, as_completed
from distributed.comm.addressing import parse_address, parse_host_port
from distributed.comm.registry import get_backend
from distributed.security import Security
from distributed.system import memory_limit

from ..core.errors import ReebError
from ..core.sentence import Sentence
from ..core.version import VERSION
from .model_process import ModelProcess

#: Jobs that are with the scheduler per thread of the workers. The rest wait here: the scheduler knows of no more jobs,
#: however many there are.
AHEAD = 4
PATIENCE = 20.0  # seconds that a scheduler may take to answer
ENCRYPTED = ("tls", "wss")
LOOK = 5.0  # seconds between two looks at how many workers there are
#: What a terminal sends to all processes that run in it: Ctrl+C, and that it was closed.
OWN_SIGNALS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name))

#: Dask's own bookkeeping, on a cluster of our own. Its workers only wait for the processes of the models: a profile of
#: them would show nothing, and many looks at them take processor time from the models. The history of jobs that the
#: dashboard shows grows with the number of models.
QUIET = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "500ms",
    "distributed.admin.system-monitor.interval": "2s",
    "distributed.scheduler.dashboard.tasks.task-stream-length": 1000,
}

#: Seconds after which a process of models that nobody needs any more ends: the workers of a cluster outlast the run.
IDLE = 60.0
_LOST = Sentence("The scheduler does not answer any more; what is done is kept.")


class ClusterError(ReebError):
    """There is no cluster at an address, or none can be made."""


class SchedulerLostError(ClusterError):
    """The scheduler does not answer any more."""


@contextlib.contextmanager
def connected(scheduler: str | None, workers: int, dashboard: str) -> Iterator[Client]:
    """Connect to a cluster.

    Parameters
    ----------
    scheduler : str or None
        Address of one that is there; None makes one on this machine, which ends with the block.
    workers : int
        Processes of that one.
    dashboard : str
        Address of its dashboard.

    Yields
    ------
    client : distributed.Client

    Raises
    ------
    ClusterError
        Nobody answers at the address, its workers have another version of this package, or no workers can be started,
        as where too few files may be open.
    """
    # The client has a level of its own; what Dask's tasks raise when workers are ended at their start is asyncio's.
    for name in ("distributed", "distributed.client", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    if scheduler is None:
        with _safe_path(), _own_cluster(workers, dashboard) as client:
            yield client
        return
    _check_address(scheduler)
    try:
        client = Client(scheduler, timeout=PATIENCE)
    except (OSError, ValueError, ImportError) as error:
        raise ClusterError(Sentence("No scheduler answers at {address}: {reason}", address=scheduler,
                                    reason=error)) from error
    with client:
        _check_versions(client)
        yield client


def _check_address(address: str) -> None:
    """Raise ClusterError for what is no address of a scheduler; a client of one is left half made in this process."""
    try:
        scheme, place = parse_address(address)
        get_backend(scheme).get_connector()
        if not scheme.startswith("ws"):  # web sockets may have a path, and no port
            parse_host_port(place)
    except (TypeError, ValueError) as error:  # the former of UCX, which is an empty class in Dask by now
        raise ClusterError(Sentence("{address} is no address of a scheduler, such as tcp://host:8786.",
                                    address=address or "An empty word")) from error
    if not _has_certificates() and scheme in ENCRYPTED:
        raise ClusterError(Sentence(
            "{address} needs certificates: say in Dask's configuration, at distributed.comm.tls, where they are.",
            address=address))


def _has_certificates() -> bool:
    """Whether Dask is configured with certificates; raises ClusterError if they cannot be read."""
    try:
        return Security().get_connection_args("client").get("ssl_context") is not None
    except (OSError, TypeError, ValueError) as error:  # such as a file that is not there, or is no certificate
        raise ClusterError(Sentence("The certificates in Dask's configuration could not be read: {reason}",
                                    reason=error)) from error


def _check_versions(client: Client) -> None:
    """Raise ClusterError for workers without this very version: their results would be those of another one."""
    # By a function that every worker has, whatever its version.
    module = __name__.partition(".")[0] + ".core.version"
    found = client.run(eval, f"__import__({module!r}, fromlist=['VERSION']).VERSION", on_error="return")
    others = {worker: theirs for worker, theirs in sorted(found.items()) if theirs != VERSION}
    if others:
        worker, theirs = next(iter(others.items()))
        raise ClusterError(Sentence(
            "{n} {n:worker does|workers do} not have Reeb Parts {version} (first: {worker}, {theirs}). Install it "
            "there, too.", n=len(others), version=VERSION, worker=worker, theirs=theirs))


@contextlib.contextmanager
def _safe_path() -> Iterator[None]:
    """Keep the Pythons that are started from looking for modules in the working folder before all others."""
    former = os.environ.get("PYTHONSAFEPATH")
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        yield
    finally:
        del os.environ["PYTHONSAFEPATH"]
        if former is not None:
            os.environ["PYTHONSAFEPATH"] = former


@contextlib.contextmanager
def _own_cluster(workers: int, dashboard: str) -> Iterator[Client]:
    """A cluster on this machine, see ``connected``; it ends with the block."""
    with contextlib.ExitStack() as stack:
        try:
            # What needs memory are the processes of the models, which have limits of their own.
            with _signals_held_back(), dask.config.set(QUIET):
                cluster = stack.enter_context(LocalCluster(
                    n_workers=workers, threads_per_worker=1, processes=True, memory_limit=0,
                    dashboard_address=dashboard, silence_logs=logging.CRITICAL))
                client = stack.enter_context(Client(cluster))
        except (OSError, RuntimeError) as error:
            raise ClusterError(Sentence("No workers could be started: {reason}",
                                        reason=_first_cause(error))) from error
        yield client


@contextlib.contextmanager
def _signals_held_back() -> Iterator[None]:
    """Hear what a terminal sends when the block ends; the workers that it starts never do: this process ends them."""
    heard: list[int] = []
    former = [signal.signal(number, lambda number, _: heard.append(number)) for number in OWN_SIGNALS]
    mask = None
    # What is started inherits which signals wait, where the system has that; it would not inherit a handler.
    if hasattr(signal, "pthread_sigmask"):
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, OWN_SIGNALS)
        # Python starts this first, and nothing waits any more. It ignores Ctrl+C, but would end with the terminal.
        resource_tracker.ensure_running()
        signal.pthread_sigmask(signal.SIG_BLOCK, OWN_SIGNALS)
    try:
        yield
    finally:
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for number, handler in zip(OWN_SIGNALS, former, strict=True):
            signal.signal(number, handler)
        for number in heard:
            signal.raise_signal(number)


def _first_cause(error: BaseException) -> BaseException:
    """The first error of the system that led to an exception, or itself."""
    first, cause = error, error.__cause__ or error.__context__
    while cause is not None:
        if isinstance(cause, OSError):
            first = cause
        cause = cause.__cause__ or cause.__context__
    return first


def spread(client: Client, function: Callable[[Any], Any], jobs: Iterable[Any]) -> Generator[tuple[Any, Any]]:
    """Have the workers do jobs, a bounded number at a time.

    Parameters
    ----------
    client : distributed.Client
    function : callable(job) -> answer
        Can be imported by the workers.
    jobs : iterable
        Taken when there is room for them.

    Yields
    ------
    job, answer : object
        As they end. The answer is the exception if the worker that had the job ended, again and again.

    Raises
    ------
    SchedulerLostError
        The scheduler has gone: of what the workers are at nobody hears any more.

    Notes
    -----
    What the scheduler and this process hold is in proportion to the number of workers, not to that of jobs.
    """
    waiting = iter(jobs)
    running: dict[Any, Any] = {}
    ended = as_completed(with_results=True, raise_errors=False)
    room, looked = 0, float("-inf")
    while True:
        if time.monotonic() > looked + LOOK:
            # Dask keeps the names of the last 100,000 jobs, half a kilobyte each.
            dask.utils.key_split.cache_clear()
            room, looked = AHEAD * max(n_threads(client), 1), time.monotonic()
        for job in islice(waiting, max(room - len(running), 0)):
            future = client.submit(function, job, pure=False)
            running[future.key] = job
            ended.add(future)
        if not running:
            return
        future, answer = next(ended)
        if client.status != "running":  # then Dask has cancelled all jobs, those that are done by now, too
            raise SchedulerLostError(_LOST)
        yield running.pop(future.key), _failure(answer) if future.status != "finished" else answer


def n_threads(client: Client) -> int:
    """How many jobs the workers do at a time; raises SchedulerLostError."""
    try:
        return sum(client.nthreads().values())
    except (OSError, AttributeError) as error:  # the latter from within Dask, after it has given up
        raise SchedulerLostError(_LOST) from error


def _failure(answer: Any) -> BaseException:
    """The exception of a job that did not end well."""
    return answer[1] if isinstance(answer, tuple) else answer if isinstance(answer, BaseException) else RuntimeError(
        str(answer))


class _IdleProcesses:
    """Processes of models, kept for the next model of this worker; those that it does not need soon are ended."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: dict[ModelProcess, threading.Timer] = {}

    def take(self, limit: int) -> ModelProcess:
        """One of them, or a new one, with a limit of memory in bytes; one that had another limit is ended."""
        with self._lock:
            process, timer = self._waiting.popitem() if self._waiting else (None, None)
        if timer is not None:
            timer.cancel()
        if process is not None and process.memory_limit == limit:
            return process
        if process is not None:
            process.close()
        return ModelProcess(limit)

    def put_by(self, process: ModelProcess) -> None:
        """Keep one for the next model."""
        timer = threading.Timer(IDLE, self._end, (process,))
        timer.daemon = True  # the worker need not wait for it: the process ends with the worker
        with self._lock:
            self._waiting[process] = timer
        timer.start()

    def _end(self, process: ModelProcess) -> None:
        """End one, unless a model has it by now, or has had it since."""
        with self._lock:
            if self._waiting.get(process) is not threading.current_thread():
                return
            del self._waiting[process]
        process.close()


_idle = _IdleProcesses()


def do_job(job: dict[str, Any]) -> dict[str, Any]:
    """What a worker does with a model: have it done by a process that is not the worker's own.

    job : dict, see ``work.do_model``, with ``memory_limit`` in bytes, 0 for the memory that the worker may use divided
    by its processors, and ``time_limit`` in seconds. Returns the answer of ``ModelProcess.run``.
    """
    process = _idle.take(job["memory_limit"] or memory_limit() // cpu_count())
    try:
        return process.run(job, job["time_limit"])
    finally:
        _idle.put_by(process)
