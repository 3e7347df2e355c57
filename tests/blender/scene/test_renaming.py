# SPDX-License-Identifier: GPL-3.0-or-later
"""Thousands of data blocks get names and go again in a time in proportion to their number."""

import time

import bpy

COUNT = 8000


def materials():
    """Many materials, each a copy of the first."""
    first = bpy.data.materials.new("Part")
    return [first, *(first.copy() for _ in range(COUNT - 1))]


def seconds(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def test_names(scene_module):
    rename = scene_module("renaming").rename
    first, second = bpy.data.materials.new("first"), bpy.data.materials.new("second")
    rename(first, "head")
    rename(second, "head")
    assert (first.name, second.name) == ("head", "head.001")


def test_many_that_are_discarded_go_as_fast_as_others(scene_module):
    """Blender kept a message for each that was renamed, and went through all of them for each that was removed."""
    transaction, times = scene_module("transaction"), {"plain": [], "discarded": []}
    for _ in range(2):
        plain = materials()
        times["plain"].append(seconds(lambda plain=plain: bpy.data.batch_remove(plain)))
        discarded = materials()
        with transaction.transaction():
            transaction.discard(*discarded)
            start = time.process_time()
        times["discarded"].append(time.process_time() - start)
        assert len(bpy.data.materials) == 0
    # Blender 4.2 has no other way to rename.
    assert min(times["discarded"]) < (1.4 if bpy.app.version >= (4, 5) else 20.0) * min(times["plain"]), times


def test_many_parts_get_their_materials_faster_than_blender_makes_them(scene_module):
    """For each that it makes from nothing Blender goes through the node trees of all."""
    new, made = scene_module("outputs.materials")._new, []
    names = [f"part {number}" for number in range(COUNT // 2)]

    def one_after_the_other():
        made.clear()
        for name in names:
            made.append(new(name, made[-1] if made else None))

    def from_nothing():
        made.extend(bpy.data.materials.new(name) for name in names)
        assert all(material.node_tree for material in made)

    def fastest(make):
        times = []
        for _ in range(2):
            bpy.data.batch_remove(made)
            made.clear()
            times.append(seconds(make))
        return min(times)

    ours = fastest(one_after_the_other)
    assert [material.name for material in made] == names
    assert all(material["reeb_parts_material"] == material.name and material.users == 0 for material in made)
    assert {tuple(material.node_tree.nodes.keys()) for material in made} == {tuple(made[0].node_tree.nodes.keys())}
    if bpy.app.version >= (5, 0):  # before, a new material had no nodes
        alone = fastest(from_nothing)
        assert ours < 0.8 * alone, (ours, alone)
