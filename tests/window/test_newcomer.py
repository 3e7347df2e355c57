# SPDX-License-Identifier: GPL-3.0-or-later
"""The newcomer's path in Blender's real window, with the real pointer; newcomer.py says how.

The pictures stay in out/newcomer, to be looked at.
"""

from pathlib import Path

import pytest

OUT = Path(__file__).resolve().parents[2] / "out" / "newcomer"
SHAPE = ("points", "faces", "matrix")


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("newcomer.py", "newcomer")


def test_suzanne_is_selected_and_not_decomposed_yet(seen):
    assert seen["added"]["selected"] == ["Suzanne"]
    assert seen["added"]["parts"] == []
    assert seen["added"]["pieces"] == {}


def test_three_clicks_are_enough(seen):
    assert seen["tab"] == "Reeb Parts"
    assert len(seen["decomposed"]["parts"]) > 1
    assert len(seen["separated"]["pieces"]) > 1
    assert seen["clicks"] == ["the tab", "Decompose", "Separate"]


def test_every_part_is_an_object_that_is_seen(seen):
    separated = seen["separated"]
    assert sorted(separated["pieces"]) == separated["shown"]
    assert separated["shown"] == sorted(f"Suzanne {name}" for name in seen["decomposed"]["parts"])
    # Faces are divided where a smooth cut runs; those of Suzanne are bent a little.
    assert sum(separated["pieces"].values()) == pytest.approx(seen["added"]["area"], rel=1e-3)


def test_the_original_is_hidden_and_as_it_was(seen):
    assert not seen["added"]["hidden"]
    assert seen["separated"]["hidden"]
    assert [seen["separated"][key] for key in SHAPE] == [seen["added"][key] for key in SHAPE]


def test_pictures_are_left(seen):
    assert [path.name for path in sorted(OUT.glob("*.png"))] == [
        "1_add.png", "2_added.png", "3_tab.png", "4_decomposed.png", "5_separated.png",
    ]  # fmt: skip
