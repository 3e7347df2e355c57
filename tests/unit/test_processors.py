# SPDX-License-Identifier: GPL-3.0-or-later
"""How many processors a run may keep busy."""

import os
import subprocess
import sys

import pytest

from core.processors import n_processors


@pytest.mark.parametrize(("asked", "found"), [("1", 1), ("", None), ("0", None), ("4,2", None), ("100000", None)])
def test_a_run_keeps_no_more_processors_busy_than_asked(monkeypatch, asked, found):
    monkeypatch.setenv("OMP_NUM_THREADS", asked)
    own = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    assert n_processors() == (found or own)


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="processes are not bound to processors here")
def test_a_process_bound_to_one_processor_has_one(monkeypatch):
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    try:
        assert n_processors() == 1
    finally:
        os.sched_setaffinity(0, before)


@pytest.mark.skipif(sys.platform != "linux", reason="systems differ in what they can limit")
@pytest.mark.parametrize("kind", ["RLIMIT_AS", "RLIMIT_DATA"])
def test_where_memory_is_limited_there_are_no_more_threads(kind):
    """A thread without memory ended without a word, and a search of SciPy's crashed on what it had not found."""
    code = f"""import resource; from core.processors import n_processors
_, hard = resource.getrlimit(resource.{kind}); resource.setrlimit(resource.{kind}, (2**40, hard)); print(n_processors())
"""
    root = os.path.dirname(os.path.dirname(sys.modules[n_processors.__module__].__file__))
    done = subprocess.run([sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=True)
    assert done.stdout == "1\n"
