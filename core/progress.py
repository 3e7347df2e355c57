# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of a run, reported to its caller, and the time that each stage takes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .errors import wrong_kind

#: Called with the name of the stage and the share of the whole run that is done, 0..1.
Progress = Callable[[str, float], None]


class Stopwatch:
    """Measures the time of the stages of a run, and reports them to the caller of the run.

    Parameters
    ----------
    progress : callable or None
        Called as progress(stage, share). ParameterError for what cannot be called.

    Attributes
    ----------
    seconds : dict of str -> float
        Seconds that each stage has taken so far.
    share : float
        Share of the whole run that is done, 0..1.
    """

    def __init__(self, progress: Progress | None) -> None:
        if progress is not None and not callable(progress):
            raise wrong_kind("progress", "a function", progress)
        self.progress = progress or (lambda stage, share: None)
        self.seconds: dict[str, float] = {}
        self.share = 0.0

    @contextmanager
    def stage(self, name: str, until: float) -> Iterator[Callable[[float], None]]:
        """Measure the time of a stage: a context manager.

        Parameters
        ----------
        name : str
            Name of the stage. The times of stages of one name are added.
        until : float
            Share of the whole run that is done when the stage ends, 0..1.

        Yields
        ------
        progress : callable
            To be called with the share of the stage that is done, 0..1.
        """
        self.progress(name, self.share)
        begin, start = time.perf_counter(), self.share
        yield lambda done: self.progress(name, start + done * (until - start))
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - begin
        self.share = until


def said_in_steps(say: Callable[[str], object]) -> Progress:
    """Make a progress that says how far a run is, about every twentieth of it.

    say : callable, given a line such as "cuts 55%". Returns a Progress for one run.
    """
    last = -1

    def progress(stage: str, share: float) -> None:
        nonlocal last
        if round(20 * share) > last:
            last = round(20 * share)
            say(f"{stage} {share:.0%}")

    return progress
