# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions that Blender calls when something happens, which other scripts may have taken off its lists."""

from __future__ import annotations

from collections.abc import Callable


def remove(handlers: list[Callable], function: Callable) -> None:
    """Take a function off one of the lists of bpy.app.handlers, if it is still there: some scripts clear these."""
    if function in handlers:
        handlers.remove(function)
