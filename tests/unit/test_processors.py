# SPDX-License-Identifier: GPL-3.0-or-later
"""How many processors a run may keep busy."""

import os

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
