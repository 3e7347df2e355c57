# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether properties are written by the program, or by the user, whom they answer by showing other parts."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

# Set while properties are written that would otherwise act as if the user had changed them.
_writing = False


@contextmanager
def quiet() -> Iterator[None]:
    """Write properties without their update functions doing anything."""
    global _writing
    before = _writing
    try:
        _writing = True
        yield
    finally:
        _writing = before


def is_quiet() -> bool:
    """Whether the program and not the user writes the properties."""
    return _writing


def restore(writing: bool) -> None:
    """Let it be as it was, when something has gone wrong in between."""
    global _writing
    _writing = writing
