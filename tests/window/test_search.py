# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command by its plain name in Blender's real window, with undo and redo; search.py says how."""

import re

import pytest

# What must have changed (a path in the snapshot), or been said. Undo and redo are looked at for all.
DOES = {
    "Pick Parts, OBJECT": "/meshes/spot/result",
    "Select Faces of Parts, OBJECT": "/flags/polygons select",
    "Isolate Parts, OBJECT": "/flags/polygons hide",
    "Show All Parts, OBJECT": "/flags/polygons hide",
    "Reeb Parts Invert, OBJECT": "/meshes/spot/result",
    "Merge Parts, OBJECT": "INFO: 2 parts are Part 06 now",
    "Merge into Neighbor, OBJECT": "/attributes/reeb_part",
    "Split Parts, OBJECT": "/attributes/reeb_part",
    "Cut Part at Point, OBJECT": "INFO: Part [0-9]+ was cut from Part 01",
    "Grow Parts, OBJECT": "/attributes/reeb_part",
    "Shrink Parts, OBJECT": "/attributes/reeb_part",
    "Slide Boundary, OBJECT": "/attributes/reeb_part",
    "Paint into Part, OBJECT": "INFO: [0-9]+ faces of .*Part 06.* are Part 01 now",
    "Assign Faces to Part, EDIT_MESH": "INFO: [0-9]+ faces are Part 01 now",
    "New Part of Selected Faces, EDIT_MESH": "INFO: [0-9]+ faces are Part [0-9]+ now",
    "Parts from Face Sets, OBJECT": "INFO: 40 faces are in other parts now",
    "Release Parts, OBJECT": "/meshes/spot/result",
    "Release All Parts, OBJECT": "/attributes/reeb_part",
    "Nodes of Chosen Parts, OBJECT": "/selected",
    "Parts of Selected Nodes, OBJECT": "/active",
    "Split at Graph Node, OBJECT": "INFO: Part [0-9]+ was cut from Part 06",
    "Mark Seams between Parts, OBJECT": "/meshes/spot/seams",
    "Make Face Sets of Parts, OBJECT": "/attributes/.sculpt_face_set",
    "Give Each Part a Material, OBJECT": "/data/materials",
    "Unwrap along Cuts, OBJECT": "/attributes/Reeb Parts UV",
    "Make Armature from Parts, OBJECT": "/data/armatures",
    "Make Collision Hulls of Parts, OBJECT": "INFO: [0-9]+ hulls",
    "Separate Parts into Objects, OBJECT": "INFO: spot: [0-9]+ parts are objects now",
    "Show Original of Part, OBJECT": "/objects/spot/hidden",
    "Show Separated Parts, OBJECT": "/objects/spot/hidden",
    "Use Preferences in This Scene, OBJECT": "/settings",
    "Reset Parameters to Preset, OBJECT": "/settings",
    "More Parts, OBJECT": "/attributes/reeb_part",
    "Clear Parts, OBJECT": "/data/collections",
    "Decompose into Parts, EDIT_MESH": "INFO: [0-9]+ parts in ",
    "Decompose into Parts, SCULPT": "INFO: [0-9]+ parts in ",
    "Decompose into Parts, PAINT_WEIGHT": "INFO: [0-9]+ parts in ",
    "Decompose into Parts, PAINT_VERTEX": "INFO: [0-9]+ parts in ",
}
REFUSES = {
    "Cut Part at Point, EDIT_MESH": "ERROR: This works in Object Mode, where the parts can be seen.",
    "Paint into Part, SCULPT": "ERROR: This works in Object Mode, where the parts can be seen.",
    "Slide Boundary, PAINT_WEIGHT": "ERROR: This works in Object Mode, where the parts can be seen.",
    "Pick Parts, PAINT_VERTEX": "ERROR: This works in Object Mode, where the parts can be seen.",
}
FILES = "Export Parts to Files, OBJECT"


@pytest.fixture(scope="module")
def seen(drive):
    """What the driver saw of each command."""
    return drive("search.py", "search", size="1000x640", seconds=300)


def test_every_command_was_tried(seen):
    assert set(seen) == {*DOES, *REFUSES, FILES}


@pytest.mark.parametrize("name", DOES)
def test_search_finds_it_and_it_does_its_work(seen, name):
    assert any(re.match(f".*{DOES[name]}", line) for line in seen[name]["changed"] + seen[name]["said"])


@pytest.mark.parametrize("name", DOES)
def test_undo_takes_it_back_and_redo_brings_it_again(seen, name):
    assert seen[name]["undone"] == []
    assert seen[name]["redone"] == []


@pytest.mark.parametrize("name", REFUSES)
def test_it_says_why_not_and_changes_nothing(seen, name):
    assert seen[name]["changed"] == []
    assert [line for line in seen[name]["said"] if not line.startswith("OPERATOR")] == [REFUSES[name]]


def test_export_writes_a_file_for_each_part(seen):
    assert any(line.startswith("INFO: 11 files in ") for line in seen[FILES]["said"])
