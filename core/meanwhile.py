# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that is done in a second thread while the caller goes on."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import ParamSpec, TypeVar

Result = TypeVar("Result")
Arguments = ParamSpec("Arguments")


def meanwhile(
    function: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs
) -> Future[Result]:
    """Call a function in a second thread.

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
        ``future.result()`` waits, and returns what the function returns, or raises what it raises. Where no thread is
        to be had, the function has been called when this returns.
    """
    future: Future[Result] = Future()

    def work() -> None:
        try:
            future.set_result(function(*args, **kwargs))
        except BaseException as error:  # noqa: BLE001 - whatever it is, it is the caller's
            future.set_exception(error)

    try:
        Thread(target=work, name=function.__name__).start()
    except RuntimeError:
        work()
    return future
