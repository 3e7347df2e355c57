# SPDX-License-Identifier: GPL-3.0-or-later
"""What is kept of the memory that arrays give back."""

import subprocess
import sys
from pathlib import Path

import pytest

import core
from core.memory import lacks_memory

OWN = Path(core.__path__[0]).parent
FAULTS = """
import resource, sys
sys.path.insert(0, sys.argv[1])
import numpy as np
from core.memory import keep_freed_memory
if sys.argv[2] == "kept" and not keep_freed_memory():
    sys.exit(0)
np.ones(10_000_000)
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
np.ones(10_000_000)
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only the GNU C library is told anything")
def test_an_array_takes_the_place_of_one_that_was_freed():
    new, kept = (subprocess.run([sys.executable, "-c", FAULTS, str(OWN), case], check=True, capture_output=True,
                                text=True).stdout for case in ("new", "kept"))
    if not kept:
        pytest.skip("another C library than GNU's")
    assert int(kept) <= 1 < 20 < int(new)  # pages that the system had to give, of 4 kB or 2 MB


@pytest.mark.parametrize(("words", "lacks"), [
    ("RuntimeError: can't start new thread", True), ("[Errno 12] Cannot allocate memory", True),
    ("OpenBLAS error: Memory allocation still failed after 10 retries, giving up.", True),
    ("numpy._core._exceptions._ArrayMemoryError: Unable to allocate 3 GiB", True),
    ("ImportError: libgfortran.so.5: failed to map segment from shared object", True),
    ("ImportError: _reordering.so: cannot map zero-fill pages", True),
    ("SystemError: error return without exception set", True),
    ("Calloc returns null: len=32000000 in from_value, total 58597540", True),
    ("lost sys.stderr", True), ("Fatal Python error: Segmentation fault", False), ("", False),
])
def test_a_lack_of_memory_has_many_words(words, lacks):
    assert lacks_memory(words) == lacks
