# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertex groups of parts: what changes hands, what stays of the user's, and which one is active."""

import bpy
import numpy as np
import pytest


@pytest.mark.parametrize("seed", range(8))
def test_what_comes_and_goes_is_the_difference_of_what_parts_have(scene_module, seed):
    """A vertex is in each part that has a corner there; faces of number 0 are in none."""
    rng = np.random.default_rng(seed)
    n_vertices, n_candidates = 30, 7
    vertex, candidate = rng.integers(0, n_vertices, 60), rng.integers(0, n_candidates, 60).astype(np.int32)
    before, after = rng.integers(0, 4, (2, n_candidates))
    grains = scene_module("outputs.vertex_groups").Grains.of(vertex, candidate)
    come, gone = ({number: sorted(there.tolist()) for number, there in every.items() if len(there)}
                  for every in grains.changes(before, after))

    def members(numbers):
        return {number: set(vertex[numbers[candidate] == number].tolist()) for number in range(1, 4)}

    def more(many, few):
        return {number: sorted(many[number] - few[number]) for number in many if many[number] - few[number]}

    assert come == more(members(after), members(before))
    assert gone == more(members(before), members(after))


def weight_of(obj, group, vertex):
    """The weight of a vertex in a group."""
    return obj.vertex_groups[group].weight(vertex)


def test_weights_by_hand_stay_where_another_group_was_deleted(obj):
    bpy.ops.reeb_parts.decompose(n_parts=3)
    result = obj.data.reeb_parts
    numbers = np.array([item.value for item in obj.data.attributes["reeb_part"].data])
    own = {tuple(entry.group for entry in vertex.groups): vertex.index for vertex in obj.data.vertices}
    inner = {part.number: own[obj.vertex_groups[part.group].index,] for part in result.parts}
    for part in result.parts:
        obj.vertex_groups[part.group].add([inner[part.number]], 0.5, "REPLACE")
    deleted = result.parts[0].number
    obj.vertex_groups.remove(obj.vertex_groups[result.parts[0].group])
    result.n_parts = 4
    after = np.array([item.value for item in obj.data.attributes["reeb_part"].data])
    stay = [part for part in result.parts if part.number in inner and part.number != deleted
            and (after[numbers == part.number] == part.number).all()]
    assert stay
    assert [weight_of(obj, part.group, inner[part.number]) for part in stay] == [0.5] * len(stay)


def test_a_group_of_the_users_stays_active_when_those_of_parts_go(obj):
    bpy.ops.reeb_parts.decompose(n_parts=5)
    for name in ("Mine", "Another"):  # Blender keeps the last one active by itself
        obj.vertex_groups.new(name=name)
    obj.vertex_groups.active_index = obj.vertex_groups["Mine"].index
    obj.data.reeb_parts.n_parts = 2
    assert obj.vertex_groups.active.name == "Mine"
    bpy.ops.reeb_parts.clear()
    assert [group.name for group in obj.vertex_groups] == ["Mine", "Another"]
    assert obj.vertex_groups.active.name == "Mine"


def test_the_group_of_the_active_part_is_active_after_another_run(obj):
    bpy.ops.reeb_parts.decompose(n_parts=4)
    result = obj.data.reeb_parts
    result.active = 2
    bpy.ops.reeb_parts.decompose(n_parts=4)
    assert result.active == 2
    assert obj.vertex_groups.active.name == result.parts[2].group


def test_no_group_has_the_name_of_a_bone_of_an_armature_that_is_the_parent(obj):
    """It deforms the object without a modifier, by groups called as its bones."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    rig.data.edit_bones.new("Part 01").tail = (0.0, 0.0, 1.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.objects.active = obj
    obj.parent, obj.parent_type = rig, "ARMATURE"
    bpy.ops.reeb_parts.decompose()
    assert obj.data.reeb_parts.parts[0].group == "Part 01.001"
