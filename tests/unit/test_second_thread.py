# SPDX-License-Identifier: GPL-3.0-or-later
"""Work in a second thread: its result, its errors, and runs in which no thread is to be had."""

import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import shapes

from core import decompose
from core.second_thread import meanwhile

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(autouse=True)
def _two_processors(monkeypatch):
    monkeypatch.setattr("core.second_thread.n_processors", lambda: 2)


def test_on_one_processor_there_is_no_second_thread(monkeypatch):
    monkeypatch.setattr("core.second_thread.n_processors", lambda: 1)
    assert meanwhile(threading.get_ident)() == threading.get_ident()


def test_the_caller_goes_on_and_gets_the_result():
    begun, goes_on = threading.Event(), threading.Event()

    def work(of, *, by):
        begun.set()
        assert goes_on.wait(10)
        return of * by

    result = meanwhile(work, 6, by=7)
    assert begun.wait(10)
    goes_on.set()
    assert result() == 42


def test_an_error_reaches_the_caller():
    def work():
        raise MemoryError("no room")

    with pytest.raises(MemoryError, match="no room"):
        meanwhile(work)()


def test_the_same_parts_where_no_thread_is_to_be_had(monkeypatch):
    monkeypatch.setattr("core.arrays.nearest.n_processors", lambda: 2)
    shape = shapes.mirrored_figure()
    found = decompose(*shape)

    def start(self):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Thread, "start", start)
    alone = decompose(*shape)
    np.testing.assert_array_equal(alone.candidates, found.candidates)
    np.testing.assert_array_equal(alone.face_twin, found.face_twin)
    assert len(found.mirror)


def test_the_same_parts_without_the_module_as_in_blender():
    program = """
import sys
sys.path[:0] = sys.argv[1:3]
if sys.argv[3] == "without":
    sys.modules["core.second_thread"] = None
import shapes, threading
from core import decompose, pipeline
assert (pipeline.meanwhile.__module__ == "functools") == (sys.argv[3] == "without")
print(decompose(*shapes.mirrored_figure()).candidates.tolist())
"""
    found = [subprocess.run([sys.executable, "-c", program, str(ROOT), str(ROOT / "tests"), way], capture_output=True,
                            text=True, timeout=60, check=True).stdout for way in ("with", "without")]
    assert found[0] == found[1]


def test_a_cancelled_run_does_not_wait_for_the_planes(monkeypatch):
    goes_on = threading.Event()
    monkeypatch.setattr("core.pipeline.find_mirrors", lambda *args: goes_on.wait(10) and [])

    def progress(stage, share):
        if stage == "cuts":
            raise KeyboardInterrupt

    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        decompose(*shapes.icosphere(2), progress=progress)
    goes_on.set()
    assert time.monotonic() - begin < 5


def test_a_thread_that_outlives_the_main_one_can_decompose():
    program = """
import sys, threading
sys.path[:0] = sys.argv[1:]
import shapes
from core import decompose

def work():
    threading.main_thread().join()
    print(decompose(*shapes.mirrored_figure()).n_candidates > 1)

threading.Thread(target=work).start()
"""
    done = subprocess.run([sys.executable, "-c", program, str(ROOT), str(ROOT / "tests")], capture_output=True,
                          text=True, timeout=60, check=True)
    assert done.stdout == "True\n", done.stderr
