# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work in steps: a generator that yields how far it is, 0..1, and returns what comes of it.

A script runs through it at once. In Blender's window a step is taken whenever there is time, see scene/stepped.py and
viewport/idle.py; to close the generator ends the work, and a transaction around it takes back what was done.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

Result = TypeVar("Result")
Steps = Generator[float, None, Result]


def finished(steps: Steps[Result]) -> Result:
    """Run through all steps; what comes of them."""
    try:
        while True:
            next(steps)
    except StopIteration as end:
        return end.value
    finally:
        steps.close()  # at once, before whoever called takes back what was done


def stretched(steps: Steps[Result], start: float, end: float) -> Steps[Result]:
    """Go through steps as a stretch, from one share to another, of something longer."""
    try:
        while True:
            share = next(steps)
            yield start + share * (end - start)
    except StopIteration as last:
        return last.value
    finally:
        steps.close()
