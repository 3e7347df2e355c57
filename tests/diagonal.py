# SPDX-License-Identifier: GPL-3.0-or-later
"""What every Blender tries of a table, and what the newest tries alone.

The environment variable REEB_PARTS_DIAGONAL, a number, is set for all Blenders but the newest, another one for each:
of what is long and hardly depends on the version, each tries another part. Without it, all is tried.

REEB_PARTS_SIXTHS, such as 12, leaves the second and the third sixth of all tests, always the same ones: where time is
short, each Blender tries others. REEB_PARTS_HALF leaves half of the cases of long tables, always the same ones, too.
"""

import os
import zlib
from collections import Counter

#: A table with more cases than this is long.
LONG_TABLE = 3


def diagonal() -> int | None:
    """The number, or None where all is to be tried."""
    number = os.environ.get("REEB_PARTS_DIAGONAL")
    return None if number is None else int(number)


def some(*every):
    """All of some values for pytest.mark.parametrize, or one of them."""
    number = diagonal()
    return every if number is None else every[number % len(every) :][:1]


def in_sixths(name):
    """Whether the test of a name is in the sixths that are asked for."""
    return str(zlib.crc32(name.encode()) % 6) in os.environ.get("REEB_PARTS_SIXTHS", "012345")


def in_tables(names):
    """Those of all names of tests that are tried: where half of a long table is asked for, one case of it at least."""
    if not os.environ.get("REEB_PARTS_HALF"):
        return set(names)
    lengths = Counter(_table(name) for name in names)
    short = {name for name in names if lengths[_table(name)] <= LONG_TABLE}
    first = {_table(name): name for name in reversed(names)}
    # Another bit of the sum than in_sixths looks at: the two have nothing to do with each other.
    return short | set(first.values()) | {name for name in names if zlib.crc32(name.encode()) // 6 % 2}


def _table(name):
    """The name of a test without that of its case."""
    return name.partition("[")[0]
