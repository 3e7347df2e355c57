# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a driver in Blender's real window; driver.py says how.

The pictures that it takes stay in out/, to be looked at.
"""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
OUT = HERE.parents[1] / "out"


@pytest.fixture(scope="session")
def drive():
    """Runs a driver; what it has seen after each step."""

    def run(driver, folder, size="1280x800", seconds=180, smooth=False) -> dict:
        # smooth : drawn as a person sees it, for pictures; takes twice as long.
        out = OUT / folder
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        command = [os.environ["BLENDER_GUI"], "--size", size, "--seconds", str(seconds), "--driver",
                   str(HERE / driver)]
        variables = {**os.environ, "GUI_OUT": str(out), **({} if smooth else {"GUI_QUICK": "1"})}
        done = subprocess.run(command, env=variables, stdin=subprocess.DEVNULL, check=False)
        assert done.returncode == 0
        return json.loads((out / "seen.json").read_text())

    return run
