# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that is done in a second thread while the caller goes on.

Blender's extension comes without this module: its site refuses what imports ``threading``.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from threading import Thread
from typing import ParamSpec, TypeVar

from .processors import n_processors

Result = TypeVar("Result")
Arguments = ParamSpec("Arguments")


def meanwhile(
    function: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs
) -> Callable[[], Result]:
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
    result : callable
        ``result()`` waits, and returns what the function returns, or raises what it raises. Without a second thread
        it calls the function.
    """
    alone = partial(function, *args, **kwargs)
    if n_processors() < 2:
        return alone
    future: Future[Result] = Future()

    def work() -> None:
        try:
            future.set_result(alone())
        except BaseException as error:  # noqa: BLE001 - whatever it is, it is the caller's
            future.set_exception(error)

    try:
        Thread(target=work, name=function.__name__).start()
    except RuntimeError:  # no thread is to be had, as while the interpreter ends
        return alone
    return future.result
