# SPDX-License-Identifier: GPL-3.0-or-later
"""How many processors a run may keep busy."""

from __future__ import annotations

import os
import sys

if sys.platform != "win32":
    import resource


def n_processors() -> int:
    """Count the processors that the process may run on; OMP_NUM_THREADS counts if it asks for fewer.

    NumPy's libraries heed that variable, too; many runs at a time, as in a batch, set it to 1.
    """
    if _is_memory_limited():
        return 1
    # Windows and macOS do not say on which a process may run.
    own = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    asked = os.environ.get("OMP_NUM_THREADS", "")
    return min(own, int(asked)) if asked.isdecimal() and int(asked) else own


def _is_memory_limited() -> bool:
    """Whether the system refuses memory to this process at some size, as after ``ulimit -v``.

    Each thread takes some 70 MB of that. One that is refused more memory ends, and what SciPy's searches have not found
    by then is taken for found: there would be any result, or a crash.
    """
    if sys.platform == "win32":
        return False
    limits = [resource.getrlimit(kind)[0] for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA)]
    return any(limit != resource.RLIM_INFINITY for limit in limits)
