# SPDX-License-Identifier: GPL-3.0-or-later
"""What a process that does nothing but decompose tells the allocator of its memory, and how a lack of it shows."""

from __future__ import annotations

import ctypes
import re
import sys

# Of the GNU C library's malloc.h: how many blocks come from the system one by one, and how much memory that is free at
# the end of the heap stays there.
_M_MMAP_MAX, _M_TRIM_THRESHOLD = -4, -1


def keep_freed_memory() -> bool:
    """Have this process keep the memory that its arrays gave back, for those that come next.

    Without it, every array of some 30 MB and more is new memory of the system, which fills it with zeros first: a
    sixth of the time of a million vertices. The process then holds the most it ever needed until it
    ends, so that this is for processes that do one thing, and not for the caller's, such as Blender.

    Returns
    -------
    done : bool
        False where the C library is another than GNU's; nothing is changed then.
    """
    if not sys.platform.startswith("linux"):
        return False
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    return mallopt is not None and bool(mallopt(_M_MMAP_MAX, 0)) and bool(mallopt(_M_TRIM_THRESHOLD, 2**31 - 1))


def lacks_memory(words: str) -> bool:
    """Whether the words of an error, or the last ones of a process, mean that there was no memory left.

    Not everything says so by a MemoryError: a thread gets no stack, a library is not mapped, C++ and OpenBLAS end the
    process, an extension module fails without a word, Blender says which array is not there before it crashes, and
    Python loses its standard error where it has no room for the words of a MemoryError.
    """
    return re.search("can't start new thread|MemoryError|Memory allocation|Cannot allocate memory|bad_alloc|"
                     "failed to map segment|cannot map zero-fill pages|error return without exception set|"
                     "alloc returns null|lost sys.stderr", words) is not None
