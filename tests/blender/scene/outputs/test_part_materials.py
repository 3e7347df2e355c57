# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of parts: the slots of an object that had none, and the names of those of a copy."""

import bpy
from snapshot import activate


def test_an_object_without_materials_has_no_slot_afterwards(obj):
    """Popping the last material of a mesh leaves an empty slot on its objects."""
    bpy.ops.reeb_parts.decompose(materials=True)
    assert len(obj.material_slots) == len(obj.data.reeb_parts.parts)
    bpy.ops.reeb_parts.clear()
    assert (len(obj.material_slots), len(obj.data.materials)) == (0, 0)


def test_a_copys_material_that_was_recolored_takes_the_name_of_its_part(obj):
    bpy.ops.reeb_parts.decompose(materials=True)
    copy = obj.copy()
    copy.data = obj.data.copy()
    bpy.context.scene.collection.objects.link(copy)
    activate(copy)
    part, model = copy.data.reeb_parts.parts[0], obj.data.reeb_parts.parts[0]
    assert part.material == model.material
    part.color = (0.1, 0.2, 0.3)
    assert part.material != model.material
    part.name = "Handle"
    assert part.material.name == "Handle"
    assert model.material.name == model.name == "Part 01"
