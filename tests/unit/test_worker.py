# SPDX-License-Identifier: GPL-3.0-or-later
"""The process that computes: what it says, and that it never outlives the one that asked."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import scipy
import shapes
from systems import unix

from core import Parameters, decompose, handover

ROOT = Path(__file__).resolve().parents[2]
# As the installed files are: next to core's own folder.
OWN = Path(sys.modules["core"].__path__[0]).parent


def start(folder, *given, parameters=None):
    """The process for some shapes, with its standard input and output."""
    arrays = [(s.vertices, s.faces, np.arange(len(s.faces)), np.empty(0), np.empty(0, np.int64)) for s in given]
    handover.write_request(folder, arrays, parameters or Parameters())
    libraries = sorted({str(Path(module.__path__[0]).parent) for module in (np, scipy)})
    code = f"import sys; sys.path[:] = [{str(OWN)!r}, *sys.path, *{libraries}]; import pathlib; " \
           f"from core.worker import run; run(pathlib.Path({str(folder)!r}))"
    return subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)


def test_what_it_says(tmp_path):
    tree, triangle = shapes.tube_tree(step=0.13), shapes.Shape(np.eye(3), np.array([[0, 1, 2]]))
    process = start(tmp_path, tree, triangle)
    said = [json.loads(line) for line in process.stdout]
    assert process.wait(60) == 0
    process.communicate()
    assert said[0] == {"ready": True}
    assert said[-1] == {"end": True}
    assert {"shape": 0, "done": True} in said
    (error,) = (message for message in said if "error" in message)
    assert (error["shape"], error["error"]["kind"]) == (1, "EmptyMeshError")
    shares = [message["share"] for message in said if message.get("shape") == 0 and "share" in message]
    assert shares == sorted(shares)
    stages = [message["stage"] for message in said if message.get("shape") == 0 and "stage" in message]
    assert list(dict.fromkeys(stages)) == ["mesh", "distances", "reeb graph", "cuts", "parts", "done"]
    read = handover.read_result(tmp_path, 0)
    made = decompose(tree.vertices, tree.faces)
    assert read.to_arrays().keys() == made.to_arrays().keys()
    for name, array in made.to_arrays().items():
        assert np.array_equal(read.to_arrays()[name], array, equal_nan=True)


@pytest.mark.parametrize("when", ["before", "while it computes"])
def test_it_ends_and_clears_up_when_the_other_end_is_closed(when, tmp_path):
    folder = tmp_path / "job"
    folder.mkdir()
    process = start(folder, shapes.subdivide(shapes.tube_tree()), parameters=Parameters(base_spacing=0.0005))
    while when != "before" and b'"distances"' not in process.stdout.readline():
        assert process.poll() is None
    process.stdin.close()
    begin = time.monotonic()
    assert process.wait(10) == 1
    assert when == "before" or time.monotonic() < begin + 1.0
    assert not folder.exists()
    process.stdin = None
    process.communicate()


@unix
def test_it_is_for_the_other_process_to_heed_ctrl_c(tmp_path):
    process = start(tmp_path, shapes.tube_tree(step=0.13))
    process.stdout.readline()
    os.kill(process.pid, 2)
    out = process.stdout.read()
    assert process.wait(60) == 0
    process.communicate()
    assert json.loads(out.splitlines()[-1]) == {"end": True}
