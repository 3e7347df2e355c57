# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command says on standard error, and what is wrong with an object or a model."""

from __future__ import annotations

import sys
from contextlib import suppress

from ..core.file_names import readable


def say(text: str) -> None:
    """Print a line."""
    with suppress(OSError):  # such as a terminal that was closed
        print(f"reeb_parts: {text}", file=sys.stderr, flush=True)


def problem(name: str, error: Exception) -> dict:
    """What the JSON says of an object or a model that could not be decomposed or read; said at once, too."""
    words = readable(str(error) or "There is not enough memory.")
    say(words if name in words else f"{name}: {words}")
    return {"name": name, "problem": words}
