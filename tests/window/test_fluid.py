# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's window while a million vertices are decomposed; fluid.py says how.

What is compared is the same window before and meanwhile: how fast it draws at all depends on the machine.
"""

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("fluid.py", "fluid", seconds=300, smooth="FLUID_ALL" in os.environ)


def test_the_window_is_drawn_as_before(seen):
    assert seen["vertices"] > 1_000_000
    assert seen["watched"] > 10.0
    idle, computing = seen["idle"], seen["computing"]
    assert computing["per second"] > 0.7 * idle["per second"]
    assert computing["longest"] < idle["longest"] + 0.5


def test_escape_ends_it_at_once_and_leaves_nothing(seen):
    assert seen["files"]
    assert seen["ended after"] < 0.5
    assert seen["process"] is False
    assert seen["cancelled"] == NOTHING


def test_a_crash_leaves_nothing(seen):
    assert seen["crashed"] == NOTHING


def test_nothing_is_left_when_blender_quits_meanwhile(seen):
    assert not Path(seen["last"]["folder"]).exists()
    assert not Path(f"/proc/{seen['last']['pid']}").exists()


NOTHING = {"folders": [], "parts": 0, "attributes": [], "objects": ["spot"]}
