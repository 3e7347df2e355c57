# SPDX-License-Identifier: GPL-3.0-or-later
"""What a command says: its answer on standard output, all else on standard error."""

from __future__ import annotations

import os
import sys
from contextlib import suppress

from ..core.file_names import readable
from ..core.sentence import Sentence

FAILED, INTERRUPTED = 1, 130  # exit statuses, the latter after Ctrl+C; those of core.options come with NumPy


def say(text: str) -> None:
    """A line on standard error, if there is one."""
    if sys.stderr is not None:
        with suppress(OSError):  # such as a terminal that was closed
            print(f"reeb-parts: {readable(text)}", file=sys.stderr, flush=True)


def print_answer(text: str) -> None:
    """Write to standard output; raises OutputFileError if that is closed or full."""
    # Not above: it needs NumPy, and the command speaks before that is there.
    from ..output_files import OutputFileError

    if sys.stdout is None:
        raise OutputFileError(Sentence("Standard output is closed."))
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except OSError as error:
        # Python would write the rest when it ends, and fail again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise OutputFileError(Sentence("Standard output could not be written: {reason}",
                                       reason=error.strerror or error)) from error
