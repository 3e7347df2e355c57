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
    # Faces are divided where a smooth cut runs. Those of Suzanne are bent a little, and Blender's area of a bent face
    # is that of its shadow: what it is divided into has no less, and no more than its triangles.
    least, most = seen["added"]["area"], seen["added"]["area of triangles"]
    assert least * (1 - 1e-6) <= sum(separated["pieces"].values()) <= most * (1 + 1e-6)


def test_the_original_is_hidden_and_as_it_was(seen):
    assert not seen["added"]["hidden"]
    assert seen["separated"]["hidden"]
    assert [seen["separated"][key] for key in SHAPE] == [seen["added"][key] for key in SHAPE]


def test_a_horse_becomes_named_pieces_in_at_most_twelve_actions(seen):
    named = {f"Horse {name}" for name in ("head", "neck", "body", "tail", "front leg.L", "front leg.R", "back leg.L",
                                          "back leg.R")}
    assert named <= set(seen["pieces"])
    assert len(seen["pieces"]) == len(seen["ten"]) == 10
    assert len(seen["named_pieces, actions"]) == 5 <= 12


def test_undo_of_separate_shows_the_colors_of_the_parts_again(seen):
    assert seen["shown after undo"] == "VERTEX"


def test_two_parts_are_merged_and_one_is_cut_in_five_actions(seen):
    before, merged, cut = seen["before"], seen["merged"], seen["cut"]
    assert before.keys() - merged.keys() == {"tail"}
    assert merged["body"] == pytest.approx(before["body"] + before["tail"], abs=2e-4)
    new = cut.keys() - merged.keys()
    assert {name[-2:] for name in new} == {".L", ".R"}
    for name in new:  # each twin of what was cut off
        leg = f"front leg{name[-2:]}"
        assert cut[leg] + cut[name] == pytest.approx(before[leg], abs=2e-4)
        assert min(cut[leg], cut[name]) > 0.01
    assert len(seen["merged_and_cut, actions"]) == 5


def test_of_65_parts_the_ten_that_matter_are_left_in_four_actions(seen):
    assert seen["65"] == 65
    assert sorted(seen["few"].values()) == pytest.approx(sorted(seen["ten"].values()), abs=2e-4)
    assert len(seen["few_of_many, actions"]) == 3 <= 4


def test_pictures_are_left(seen):
    assert {path.name for path in OUT.glob("*.png")} == {
        "1_add.png", "2_added.png", "3_tab.png", "4_decomposed.png", "5_separated.png", "6_horse_named.png",
        "7_horse_pieces.png", "8_horse_cut.png", "9_horse_65.png", "10_horse_10.png",
    }
