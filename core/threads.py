# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads: how many a run may have, and work that is done in a second one while the caller goes on."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import ParamSpec, TypeVar

Result = TypeVar("Result")
Arguments = ParamSpec("Arguments")


def n_processors() -> int:
    """How many processors a run may keep busy: those the process may run on, or OMP_NUM_THREADS if that is fewer.

    The variable is what NumPy's libraries heed, too; many runs at a time, as in a batch, set it to 1.
    """
    # Windows and macOS do not say on which a process may run.
    own = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    asked = os.environ.get("OMP_NUM_THREADS", "")
    return min(own, int(asked)) if asked.isdecimal() and int(asked) else own


def meanwhile(
    function: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs
) -> Future[Result]:
    """Call a function in a second thread, if there is a second processor for it.

    A thread of its own and no pool: a pool takes no work while the interpreter ends, when other threads may still run,
    and waits for its work where the caller has been cancelled.

    Parameters
    ----------
    function : callable
        Changes nothing that the caller uses in the meantime.
    *args, **kwargs
        Its arguments.

    Returns
    -------
    future : concurrent.futures.Future
        ``future.result()`` waits, and returns what the function returns, or raises what it raises. Without a
        second thread the function has been called when this returns.
    """
    future: Future[Result] = Future()

    def work() -> None:
        try:
            future.set_result(function(*args, **kwargs))
        except BaseException as error:  # noqa: BLE001 - whatever it is, it is the caller's
            future.set_exception(error)

    if n_processors() < 2:
        work()
        return future
    try:
        Thread(target=work, name=function.__name__).start()
    except RuntimeError:  # no thread is to be had, as while the interpreter ends
        work()
    return future
