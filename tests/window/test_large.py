# SPDX-License-Identifier: GPL-3.0-or-later
"""Detail of a larger mesh in Blender's real window; large.py says how.

The pictures stay in out/large, to be looked at.
"""

import pytest


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw after each step."""
    return drive("large.py", "large")


def test_colours_and_groups_are_those_of_the_parts_after_each_step(seen):
    for step in seen.values():
        assert step["corners"] > 200_000
        assert step["wrong color"] < 0.51 / 255
        assert step["groups"] == step["names"]
        assert step["active"] == ["Reeb Parts", "Reeb Parts"]
        assert step["attributes"] == seen["decomposed"]["attributes"]


def test_progress_moves_while_the_mesh_is_read_and_goes_on_from_there(seen):
    shares = [share for share in seen["decomposed"]["shares"] if share is not None]
    reading = shares[:next(i for i, share in enumerate(shares) if share >= 0.05)]
    assert len(set(reading)) >= 3
    # Writing begins anew, where it takes long enough to be seen.
    writing = next((i for i, (a, b) in enumerate(zip(shares, shares[1:], strict=False)) if b < a), len(shares))
    assert shares[:writing] == sorted(shares[:writing])


def test_each_is_one_exact_step_of_undo(seen):
    assert seen["typed"]["detail"] == 0.9
    assert seen["typed"]["parts"] > seen["decomposed"]["parts"]
    assert {**seen["undone"], "shares": seen["decomposed"]["shares"]} == seen["decomposed"]
    assert seen["redone"] == seen["typed"]
    assert seen["dragged"]["detail"] != 0.9
    assert seen["drag undone"] == seen["typed"]


def test_separate_shows_how_far_it_is_and_esc_ends_it_with_nothing_changed(seen):
    ended, separated = seen["ended"], seen["separated"]
    assert len(ended["shares"]) < len(separated["shares"])
    assert ended["objects"] == seen["separation undone"]["objects"]
    assert ended["meshes"] == seen["separation undone"]["meshes"]
    for name in ("ended", "separated", "separation undone"):
        assert seen[name]["digest"] == seen["drag undone"]["digest"]
    assert len(separated["objects"]) == len(ended["objects"]) + separated["parts"]
