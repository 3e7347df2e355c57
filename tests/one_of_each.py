# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects with all kinds of settings that an object can have, none of them changed: for what is told of objects."""

import bpy

TRIANGLE = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)]
# A set of axes is there in Blender 4.2 what three switches are later; a way to layers of attributes came later; a
# folder is each process's own.
OTHER_IN_EACH_BLENDER = {"MESH_CACHE", "MESH_SEQUENCE_CACHE", "OCEAN"}


def add_one_of_each() -> list[bpy.types.Object]:
    """Add an object for each modifier, constraint and kind of physics, and an armature with all constraints."""
    mesh = bpy.data.meshes.new("Triangle")
    mesh.from_pydata(*TRIANGLE)
    added = [_with_modifier(mesh, kind) for kind in _kinds(bpy.types.Modifier) if kind not in OTHER_IN_EACH_BLENDER]
    added += [_with_constraint(mesh, kind) for kind in _kinds(bpy.types.Constraint)]
    for kind in _kinds(bpy.types.RigidBodyObject):
        added.append(_new(f"Body {kind}", mesh))
        bpy.ops.rigidbody.object_add(type=kind)
    for kind in _kinds(bpy.types.RigidBodyConstraint):
        added.append(_new(f"Joint {kind}", None))
        bpy.ops.rigidbody.constraint_add(type=kind)
    return [item for item in added if item] + [_rig()]


def _kinds(struct):
    return [item.identifier for item in struct.bl_rna.properties["type"].enum_items]


def _new(name, data):
    item = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(item)
    bpy.ops.object.select_all(action="DESELECT")
    item.select_set(True)
    bpy.context.view_layer.objects.active = item
    return item


def _with_modifier(mesh, kind):
    item = _new(f"Modifier {kind}", mesh)
    if item.modifiers.new(kind, kind):
        return item
    bpy.data.objects.remove(item)  # of another type of object
    return None


def _with_constraint(mesh, kind):
    item = _new(f"Constraint {kind}", mesh)
    try:
        item.constraints.new(kind)
    except RuntimeError:  # of bones alone
        bpy.data.objects.remove(item)
        return None
    return item


def _rig():
    """Three bones, one connected; the last has each constraint that Blender 4.2 knows."""
    rig = _new("Rig", bpy.data.armatures.new("Rig"))
    bpy.ops.object.mode_set(mode="EDIT")
    bones = [rig.data.edit_bones.new(name) for name in "abc"]
    bones[0].tail = bones[1].head = (0, 0, 1)
    bones[1].parent = bones[2].parent = bones[0]
    bones[1].use_connect = True
    for bone in bones:  # which are others in each Blender
        bone.head_radius = bone.tail_radius = 0.25
    bones[1].tail, bones[2].head, bones[2].tail = (0, 1, 1), (0, 0, 2), (0, 1, 2)
    bpy.ops.object.mode_set(mode="OBJECT")
    for kind in _kinds(bpy.types.Constraint):
        if kind != "GEOMETRY_ATTRIBUTE":
            rig.pose.bones["c"].constraints.new(kind)
    return rig
