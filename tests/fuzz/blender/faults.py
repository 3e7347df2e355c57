# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults put in before a line of the product: an exception is raised there, as a bug or a lack of memory would."""

import sys
from collections.abc import Callable


class InjectedError(Exception):
    """What is raised."""


class Injector:
    """Counts the lines of some files that are executed, and raises before one of them.

    Parameters
    ----------
    folders : tuple of str
        How the paths of these files begin.
    at : int
        Before which line, counted from 0; none if negative.

    Attributes
    ----------
    lines : list of (file, line)
        What was executed, in order, up to the fault.
    """

    def __init__(self, folders: tuple[str, ...], at: int = -1):
        self.folders, self.at = folders, at
        self.lines = []
        self.done = False

    def run(self, work: Callable[[], object]):
        """Do something with the fault in it; what is raised goes on."""
        before = sys.gettrace()
        sys.settrace(self._call)
        try:
            return work()
        finally:
            sys.settrace(before)

    def _call(self, frame, event, argument):
        return self._line if not self.done and frame.f_code.co_filename.startswith(self.folders) else None

    def _line(self, frame, event, argument):
        if event == "line" and not self.done:
            self.lines.append((frame.f_code.co_filename, frame.f_lineno))
            if len(self.lines) - 1 == self.at:
                self.done = True
                raise InjectedError(f"before line {frame.f_lineno} of {frame.f_code.co_filename}")
        return self._line


def places(lines: list) -> list[int]:
    """The first and the last time that each line was executed, as numbers in the order of execution."""
    first, last = {}, {}
    for index, line in enumerate(lines):
        first.setdefault(line, index)
        last[line] = index
    return sorted({*first.values(), *last.values()})
