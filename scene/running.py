# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that go on in the window, as tools do: they end before the extension is switched off or updated.

Blender drops them then without a word to them: their progress, their cursor and what they draw would stay for good.
Nor does it tell them of undo in another window, which removes from under them what they write.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

import bpy
from bpy.app.handlers import persistent

from . import handlers

_running: list[tuple[Any, int]] = []  # each with the address of its window


def begun(operator: Any, context: bpy.types.Context) -> None:
    """An operator goes on in a window. operator : its ``cancel`` ends it, and calls ``ended``."""
    if all(known is not operator for known, _ in _running):
        _running.append((operator, context.window.as_pointer()))


def ended(operator: Any) -> None:
    """An operator has ended, however it did."""
    _running[:] = [entry for entry in _running if entry[0] is not operator]


def end_all() -> None:
    """End them all now, each in its own window."""
    for operator, address in reversed(_running.copy()):
        with _in_window(address):
            operator.cancel(bpy.context)


@contextmanager
def _in_window(address: int) -> Iterator[None]:
    """Do something with an operator in the window of an address."""
    window = next((found for found in bpy.context.window_manager.windows if found.as_pointer() == address), None)
    # Blender has freed an operator of which ``modal`` has raised something.
    with bpy.context.temp_override(window=window), suppress(ReferenceError):
        yield


@persistent
def _undoing(*_: object) -> None:
    """Undo or redo is about to begin: what reads or writes in steps takes back what it has written."""
    for operator, address in reversed(_running.copy()):
        with _in_window(address):
            getattr(operator, "interrupt", lambda: None)()


def register() -> None:
    for those in (bpy.app.handlers.undo_pre, bpy.app.handlers.redo_pre):
        those.append(_undoing)


def unregister() -> None:
    for those in (bpy.app.handlers.undo_pre, bpy.app.handlers.redo_pre):
        handlers.remove(those, _undoing)
