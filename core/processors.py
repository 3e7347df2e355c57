# SPDX-License-Identifier: GPL-3.0-or-later
"""How many processors a run may keep busy."""

from __future__ import annotations

import os


def n_processors() -> int:
    """Count the processors that the process may run on; OMP_NUM_THREADS counts if it asks for fewer.

    NumPy's libraries heed that variable, too; many runs at a time, as in a batch, set it to 1.
    """
    # Windows and macOS do not say on which a process may run.
    own = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    asked = os.environ.get("OMP_NUM_THREADS", "")
    return min(own, int(asked)) if asked.isdecimal() and int(asked) else own
