# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl+C and other requests to end, of which commands make a KeyboardInterrupt."""

from __future__ import annotations

import sys


def is_ending() -> bool:
    """Whether a KeyboardInterrupt is being handled already, for who would raise another one.

    What is cleaned up because of the first must not be broken off by the second, as of somebody impatient or of a
    terminal that is closed after Ctrl+C. One that something has swallowed is handled no more, and the next is heard.
    """
    error = sys.exception()
    # What is raised and caught meanwhile, such as that a file is gone by now, comes on top.
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__context__
    return error is not None
