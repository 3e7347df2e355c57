# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands on parts with several objects selected: each is done, in one step of undo, or none is."""

import contextlib

import bpy
import pytest
from snapshot import activate, changes, check_undo, snapshot

DONE = {
    "armature": lambda obj: "Reeb Parts Armature" in obj.modifiers,
    "hulls": lambda obj: any(item.name.startswith(f"UCX_{obj.name}_") for item in bpy.data.objects),
    "unwrap": lambda obj: "Reeb Parts UV" in obj.data.uv_layers,
    "seams": lambda obj: obj.data.reeb_parts.has_seams,
    "face_sets": lambda obj: obj.data.reeb_parts.has_face_sets,
    "materials": lambda obj: obj.data.reeb_parts.has_materials,
    "rigid_bodies": lambda obj: any(item.name.startswith(obj.name) and item.rigid_body for item in bpy.data.objects),
}


def select(*objects):
    """Select some objects; the first is the active one."""
    activate(objects[0])
    for obj in objects:
        obj.select_set(True)


@pytest.fixture
def three(make, tree):
    """Three objects with parts, selected, and separated where that is asked for; a fourth that has none."""
    found = [make((tree[0] * size, tree[1]), name) for name, size in (("One", 1), ("Two", 2), ("Three", 3))]
    bare = make(tree, "Bare")
    select(*found)
    bpy.ops.reeb_parts.decompose(n_parts=3)

    def prepared(name):
        select(*found)
        if name == "rigid_bodies":
            bpy.ops.reeb_parts.separate(hide=False)
        select(*found, bare)
        return found

    return prepared


@pytest.mark.parametrize("name", DONE)
def test_all_selected_objects_are_worked_on(three, name, capfd):
    """Only the active one was, without a word."""
    objects = three(name)
    capfd.readouterr()
    check_undo(lambda: getattr(bpy.ops.reeb_parts, name)())
    assert all(DONE[name](bpy.data.objects[each]) for each in ("One", "Two", "Three"))
    assert not DONE[name](bpy.data.objects["Bare"])
    said = capfd.readouterr().out
    assert "Warning" not in said
    assert name == "rigid_bodies" or all(f"{obj}: " in said for obj in ("One", "Two", "Three"))
    assert name != "rigid_bodies" or "9 rigid bodies" in said
    assert len(objects) == 3


def test_with_pieces_selected_all_originals_are_worked_on(three):
    select(*three("rigid_bodies"))
    bpy.ops.reeb_parts.separate()
    assert bpy.ops.reeb_parts.rigid_bodies() == {"FINISHED"}
    assert sum(item.rigid_body is not None for item in bpy.data.objects) == 9


@pytest.mark.parametrize("name", DONE)
def test_one_that_is_out_of_date_is_left_out_and_named(three, name, capfd):
    one, two, last = three(name)
    two.data.vertices[0].co.x += 0.1
    capfd.readouterr()
    assert getattr(bpy.ops.reeb_parts, name)() == {"FINISHED"}
    assert [DONE[name](obj) for obj in (one, two, last)] == [True, False, True]
    assert "Warning: Two was edited" in capfd.readouterr().out
    activate(two)
    one.select_set(True)
    with pytest.raises(RuntimeError, match="Two was edited"):
        getattr(bpy.ops.reeb_parts, name)()


def test_each_sentence_names_the_object_that_it_is_of(three, capfd):
    """How many parts move with others, what was kept and which cuts have joints was said without."""
    three("hulls")
    bpy.ops.reeb_parts.hulls()
    next(item for item in bpy.data.objects if item.name.startswith("UCX_Two_")).data.vertices[0].co.x += 0.1
    capfd.readouterr()
    for name, more in (("hulls", {}), ("unwrap", {}), ("armature", {}), ("separate", {"joints": "ROUND"})):
        three(name)
        getattr(bpy.ops.reeb_parts, name)(**more)
    said = [line for line in capfd.readouterr().out.splitlines() if line.startswith(("Info: ", "Warning: "))]
    for words in ("Two: 1 earlier object", "One: 2 of 2 cuts have joints", "Three: 2 of 2 cuts have joints"):
        assert any(words in line for line in said), words
    assert [line for line in said if not any(name in line for name in ("One", "Two", "Three"))] == []


def test_where_one_fails_nothing_is_done_and_it_is_named(three):
    objects = three("unwrap")
    while len(objects[1].data.uv_layers) < 8:
        objects[1].data.uv_layers.new()
    before = snapshot()
    with pytest.raises(RuntimeError, match="Two has as many UV maps"):
        bpy.ops.reeb_parts.unwrap()
    assert changes(before, snapshot()) == []
    objects[1].data.name = "Mesh"
    with pytest.raises(RuntimeError, match="Two: Mesh has as many UV maps"):
        bpy.ops.reeb_parts.unwrap()


def test_pieces_of_other_parts_are_left_out_and_named(three, capfd):
    one, two, last = three("rigid_bodies")
    last.data.reeb_parts.n_parts = 2
    capfd.readouterr()
    assert bpy.ops.reeb_parts.rigid_bodies() == {"FINISHED"}
    assert [DONE["rigid_bodies"](obj) for obj in (one, two, last)] == [True, True, False]
    assert "Warning: The pieces of Three are of other parts" in capfd.readouterr().out


def test_of_linked_duplicates_one_gets_the_armature(obj, capfd):
    other = bpy.data.objects.new("Other", obj.data)
    bpy.context.scene.collection.objects.link(other)
    bpy.ops.reeb_parts.decompose()
    select(other, obj)
    assert bpy.ops.reeb_parts.armature() == {"FINISHED"}
    assert [DONE["armature"](each) for each in (obj, other)] == [False, True]
    assert "Warning: Tree shares its mesh" in capfd.readouterr().out
    assert bpy.ops.reeb_parts.hulls() == {"FINISHED"}
    assert DONE["hulls"](obj)
    assert DONE["hulls"](other)
    assert bpy.ops.reeb_parts.unwrap() == {"FINISHED"}
    assert "Tree: Unwrapped" not in capfd.readouterr().out


@pytest.mark.parametrize("change", [
    bpy.ops.reeb_parts.split,
    bpy.ops.reeb_parts.seams,
    lambda: setattr(bpy.context.object.data.reeb_parts, "detail", 0.9),
    lambda: bpy.ops.reeb_parts.names_from_active(),  # refuses: no part has a name
    lambda: setattr(bpy.context.object.data.reeb_parts.parts[0], "locked", True),
], ids=["split", "seams", "detail", "refused", "locked"])
def test_the_objects_that_are_edited_stay_those_that_are_edited(three, change):
    """In the Outliner, objects are selected and deselected while others are edited; Blender edits what is selected."""
    one, two, three_ = three("edited")
    select(one, two)
    bpy.ops.object.mode_set(mode="EDIT")
    two.select_set(False)
    three_.select_set(True)

    def situation():
        return [(obj.mode, obj.select_get()) for obj in (one, two, three_)]

    before = situation()
    assert before == [("EDIT", True), ("EDIT", False), ("OBJECT", True)]
    with contextlib.suppress(RuntimeError):
        change()
    assert situation() == before
