# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a run is, told to its caller, and how long each stage took."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

#: Called with the name of the stage and the share of the whole that is done, 0..1.
Progress = Callable[[str, float], None]


class Stopwatch:
    """Times the stages of a run and tells its caller about them.

    Parameters
    ----------
    progress : callable, optional
        Called as progress(stage, share).

    Attributes
    ----------
    seconds : dict of str -> float
        Time of each stage so far.
    share : float
        What is done of the whole, 0..1.
    """

    def __init__(self, progress: Progress | None):
        self.progress = progress or (lambda stage, share: None)
        self.seconds: dict[str, float] = {}
        self.share = 0.0

    @contextmanager
    def stage(self, name: str, until: float) -> Iterator[Callable[[float], None]]:
        """Time a stage that ends at a share of the whole; gives a function to tell how much of it is done."""
        self.progress(name, self.share)
        begin, start = time.perf_counter(), self.share
        yield lambda done: self.progress(name, start + done * (until - start))
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - begin
        self.share = until
