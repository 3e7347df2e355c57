# SPDX-License-Identifier: GPL-3.0-or-later
"""What other objects have of ours - targets, modifiers, drivers, properties - they keep when it is made anew."""

import importlib

import bpy
import pytest
from roles import with_role
from snapshot import activate, changes, check_undo, snapshot

KEEP = {"hide": False}


def add(name, data=None):
    item = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(item)
    return item


def refer(item):
    """An object of the user's that refers to another one in many ways."""
    holder = add("Holder", bpy.data.meshes.new("Holder"))
    holder.constraints.new("COPY_LOCATION").target = item
    holder.modifiers.new("About", "CAST").object = item
    if item.type == "ARMATURE":
        holder.modifiers.new("Rig", "ARMATURE").object = item
    if item.type == "MESH":
        holder.modifiers.new("Cut", "BOOLEAN").object = item
    variable = holder.driver_add("location", 0).driver.variables.new()
    variable.type = "TRANSFORMS"
    variable.targets[0].id = item
    holder["mine"] = item
    bpy.context.view_layer.update()


def held():
    """What the holder refers to now; None where it has lost it."""
    holder = bpy.data.objects["Holder"]
    driver = holder.animation_data.drivers[0].driver
    return {holder.constraints[0].target, *(modifier.object for modifier in holder.modifiers),
            driver.variables[0].targets[0].id, holder["mine"]}


def made(obj):
    return obj.reeb_parts_made.pieces.objects[:]


WAYS = {
    "separate": (lambda obj: bpy.ops.reeb_parts.separate(**KEEP), made, lambda item: item["reeb_parts_number"]),
    "armature": (lambda obj: bpy.ops.reeb_parts.armature(), lambda obj: with_role("armature"), lambda item: 0),
    "hulls": (lambda obj: bpy.ops.reeb_parts.hulls(), lambda obj: with_role("hull"), lambda item: item.name),
    "decompose": (lambda obj: bpy.ops.reeb_parts.decompose(), lambda obj: with_role("node"), lambda item: item.name),
    "arcs": (lambda obj: bpy.ops.reeb_parts.decompose(), lambda obj: with_role("arcs"), lambda item: 0),
}


def again(obj, way):
    activate(obj)
    assert WAYS[way][0](obj) == {"FINISHED"}


def prepared(obj, way, place=1):
    """One of the objects that a way makes, and what it stands for."""
    bpy.ops.reeb_parts.decompose()
    again(obj, way)
    _, found, stands_for = WAYS[way]
    item = found(obj)[min(place, len(found(obj)) - 1)]
    refer(item)
    return item, stands_for(item)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("place", [0, 2])
def test_what_refers_to_an_object_refers_to_the_one_in_its_place(obj, way, place):
    item, stood_for = prepared(obj, way, place)
    former, n_made = item.session_uid, len(WAYS[way][1](obj))
    again(obj, way)
    (new,) = held()
    assert new.session_uid != former
    assert WAYS[way][2](new) == stood_for
    assert former not in {left.session_uid for left in bpy.data.objects}
    assert len(WAYS[way][1](obj)) == n_made
    assert new in WAYS[way][1](obj)
    (collection,) = new.users_collection
    assert collection.objects[:].count(new) == 1
    assert not new.children


@pytest.mark.parametrize("way", WAYS)
def test_again_and_again_changes_nothing(obj, way):
    prepared(obj, way)
    again(obj, way)
    once = snapshot()
    again(obj, way)
    assert changes(once, snapshot()) == []


@pytest.mark.parametrize("way", WAYS)
def test_undo(obj, way):
    item, _ = prepared(obj, way)
    name, names = obj.name, {item.name}

    def work():
        again(bpy.data.objects[name], way)
        add("Beside")  # else all would look as before

    check_undo(work)
    assert {item.name for item in held()} == names
    bpy.ops.ed.undo()
    assert {item.name for item in held()} == names


@pytest.mark.parametrize("way", WAYS)
def test_an_error_leaves_all_as_it_was(package, obj, way, monkeypatch):
    item, _ = prepared(obj, way)
    activate(obj)
    before = snapshot()
    module = importlib.import_module(f"{package}.scene.ours.made_objects")
    hand_on = module.hand_on

    def broken(*arguments):
        hand_on(*arguments)
        raise MemoryError

    monkeypatch.setattr(module, "hand_on", broken)
    with pytest.raises((RuntimeError, MemoryError)):
        WAYS[way][0](obj)
    assert changes(before, snapshot()) == []
    assert held() == {item}


@pytest.mark.parametrize("way", ["separate", "hulls"])
def test_what_others_need_stays_where_nothing_takes_its_place(obj, way):
    bpy.ops.reeb_parts.decompose()
    again(obj, way)
    found = WAYS[way][1](obj)
    needed = found[-1]
    refer(needed)
    n_made = len(found)
    obj.data.reeb_parts.n_parts = 1
    again(obj, way)
    assert held() == {needed}
    assert len(WAYS[way][1](obj)) == (2 if way == "separate" else 1) < n_made
    assert "reeb_parts_number" not in needed
    assert "reeb_parts_role" not in needed


def test_a_node_that_others_need_stays_where_nothing_takes_its_place(obj):
    bpy.ops.reeb_parts.decompose()
    needed = with_role("node")[0]
    refer(needed)
    needed["kind"] = "none that there is"
    bpy.ops.reeb_parts.decompose()
    assert held() == {needed}
    assert needed not in with_role("node")
    assert needed.parent == obj


def test_clear_removes_the_graph_all_the_same(obj):
    bpy.ops.reeb_parts.decompose()
    refer(with_role("node")[0])
    bpy.ops.reeb_parts.clear()
    assert held() == {None}
    assert with_role("node") == []


def test_pieces_of_one_part_take_the_places_of_each_other_in_order(obj):
    bpy.ops.reeb_parts.decompose(n_parts=1)
    bpy.context.view_layer.update()
    obj.dimensions = (0.1, 0.1, 0.4)
    bed = {"fit_bed": True, "bed": (150.0, 150.0, 150.0), **KEEP}
    bpy.ops.reeb_parts.separate(**bed)
    last = made(obj)[-1]
    assert len(made(obj)) > 2
    refer(last)
    name = last.name
    activate(obj)
    bpy.ops.reeb_parts.separate(**bed)
    assert [item.name for item in held()] == [name]
    activate(obj)
    bpy.ops.reeb_parts.separate(**KEEP)
    (whole,) = made(obj)
    assert held() == {whole}


def test_the_own_modifier_and_those_of_pieces_follow_the_new_armature(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.armature()
    bpy.ops.reeb_parts.separate(**KEEP)
    activate(obj)
    bpy.ops.reeb_parts.armature()
    (rig,) = with_role("armature")
    pieces = [item for item in made(obj) if item.type == "MESH"]
    assert {item.modifiers["Reeb Parts Armature"].object for item in (obj, *pieces)} == {rig}
    again(obj, "separate")
    assert len([item for item in made(obj) if item.type == "MESH"]) == len(pieces)  # they count as untouched


def test_a_property_of_the_scene_counts(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.hulls()
    hull = with_role("hull")[0]
    bpy.context.scene["mine"] = hull
    name = hull.name
    again(obj, "hulls")
    assert bpy.context.scene["mine"].name == name


def test_joints_of_bodies_are_handed_on(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    bpy.ops.reeb_parts.rigid_bodies()
    joint = with_role("joint")[0]
    name = joint.name
    refer(joint)
    bpy.ops.reeb_parts.rigid_bodies()
    assert [item.name for item in held()] == [name]


@pytest.mark.parametrize("way", ["separate", "bodies"])
def test_a_joint_that_others_need_stays_where_nothing_takes_its_place(obj, way):
    """Its pieces were made anew, or one was deleted: a camera that looked at it looked at nothing."""
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    bpy.ops.reeb_parts.rigid_bodies()
    joint = with_role("joint")[0]
    refer(joint)
    if way == "separate":
        again(obj, "separate")
    else:
        activate(joint.rigid_body_constraint.object1)
        bpy.ops.object.delete()
        activate(obj)
        bpy.ops.reeb_parts.rigid_bodies()
    assert held() == {joint}
    assert "reeb_parts_role" not in joint


def test_of_joints_of_one_name_each_is_handed_on(obj):
    bpy.ops.reeb_parts.decompose(n_parts=1)
    bpy.context.view_layer.update()
    obj.dimensions = (0.1, 0.1, 0.4)
    bpy.ops.reeb_parts.separate(fit_bed=True, bed=(150.0, 150.0, 150.0), **KEEP)
    for number, piece in enumerate(made(obj)):
        piece["reeb_parts_number"], piece.name = made(obj)[0]["reeb_parts_number"], f"Piece.{number:03d}"
    bpy.ops.reeb_parts.rigid_bodies()
    joints = with_role("joint")
    assert len(joints) > 1
    refer(joints[-1])
    n_made, name = len(joints), joints[-1].name
    bpy.ops.reeb_parts.rigid_bodies()
    assert [item.name for item in held()] == [name]
    assert len(with_role("joint")) == n_made


def test_a_body_that_others_need_is_replaced_by_a_piece_that_is_none(obj):
    bpy.ops.reeb_parts.decompose()
    bpy.ops.reeb_parts.separate(**KEEP)
    bpy.ops.reeb_parts.rigid_bodies()
    piece = made(obj)[0]
    refer(piece)
    number = piece["reeb_parts_number"]
    again(obj, "separate")
    (new,) = held()
    assert new["reeb_parts_number"] == number
    assert new.rigid_body is None
    assert bpy.context.scene.rigidbody_world.collection.objects[:] == []
