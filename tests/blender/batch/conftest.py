# SPDX-License-Identifier: GPL-3.0-or-later
"""The command, run in this process."""

import json
import os
from dataclasses import dataclass
from importlib import import_module

import process
import pytest


@dataclass
class Ended:
    """What a run of the command leaves: exit status, and what it wrote to the two streams."""

    status: int
    out: str
    err: str

    @property
    def answer(self):
        """The JSON, which is all of standard output."""
        return json.loads(self.out)


@pytest.fixture
def run(package, capfd):
    """A function that runs the command with some arguments."""
    main = import_module(f"{package}.batch.command").main

    def run_command(*arguments):
        capfd.readouterr()
        kept = os.dup(1)
        try:
            status = main([str(argument) for argument in arguments])
        finally:
            os.dup2(kept, 1)  # the command leaves it to the messages of Blender
            os.close(kept)
        return Ended(status, *capfd.readouterr())

    return run_command


@pytest.fixture
def model(tree, tmp_path):
    """The tree as a model file."""
    return process.write_obj(tmp_path / "own.obj", tree)
