# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature with a bone for each part, as a start for a rig; the parts' vertex groups are its weights."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..core.result.decomposition import Decomposition
from ..core.result.numbering import NumberedParts
from . import bridge, mesh_arrays, modifiers, outputs, part_names, piece_objects, quiet, store, targets, transaction
from .modes import set_mode
from .selection import nothing_selected
from .store import Stored
from .temporary import remove_object

if TYPE_CHECKING:
    from ..core.uses.bones import Bones

NAME = "Reeb Parts Armature"
ROLE = "reeb_parts_role"  # on the armature, "armature"
MADE = "reeb_parts_looks"  # on the armature: what it was like when it was made


def remove_modifier(obj: bpy.types.Object) -> None:
    """Take our modifier off an object; the armature stays."""
    modifier = _modifier(obj)
    if modifier is not None:
        modifiers.remove(obj, modifier)


def _modifier(obj: bpy.types.Object) -> bpy.types.ArmatureModifier | None:
    """Our modifier on an object, or None."""
    modifier = obj.modifiers.get(NAME)
    return modifier if modifier is not None and modifier.type == "ARMATURE" else None


def make(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, deform: bool) -> bpy.types.Object:
    """Make an armature in place of an earlier one, unless the user has worked on that one; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : Stored
    deform : bool
        Give the object a modifier, so that the bones move it.

    Returns
    -------
    rig : bpy.types.Object
    """
    numbered = stored.shown_parts()
    place, bones = _bones(obj, stored.decomposition, numbered)
    names = [part_names.part_name(obj.data, number) for number in numbered.numbers.tolist()]
    _write_groups(obj, numbered)
    collection = piece_objects.make_collection(context, obj)
    _remove_earlier(collection)
    data = bpy.data.armatures.new(f"{NAME} {obj.name}")
    rig = bpy.data.objects.new(data.name, data)
    rig.matrix_world = place
    rig.show_in_front = True
    rig[ROLE] = "armature"
    collection.objects.link(rig)
    _add_bones(context, rig, bones, [part.group for part in obj.data.reeb_parts.parts] or names)
    rig[MADE] = _looks(rig)
    if deform:
        modifier = _modifier(obj) or modifiers.new(obj, NAME, "ARMATURE")
        transaction.keep(modifier, "object")
        modifier.object = rig
    else:
        remove_modifier(obj)
    return rig


def _bones(obj: bpy.types.Object, decomposition: Decomposition, numbered: NumberedParts) -> tuple[Matrix, Bones]:
    """Where the armature is in the world, and the bones in its coordinates."""
    from ..core.uses.bones import part_bones  # imports SciPy

    mesh, parts = obj.data, numbered.parts
    world = obj.matrix_world
    place = Matrix.LocRotScale(world.to_translation(), world.to_quaternion(), None)
    turn = np.array(place.inverted() @ world, np.float64)
    points = mesh_arrays.shown_points(obj) @ turn[:3, :3].T + turn[:3, 3]
    back = turn[:3, :3] @ bridge.unstretch(store.stretch_of(mesh))
    line = decomposition.graph.point_position @ back.T + turn[:3, 3]
    nodes = decomposition.graph.node_position @ back.T + turn[:3, 3]
    bones = part_bones(
        mesh_arrays.corner_table(mesh, points), parts.labels, bridge.face_graph(obj)[0].area,
        np.nan_to_num(decomposition.field), np.concatenate([line, nodes]),
        np.concatenate([parts.point_part, parts.node_part]))
    return place, bones


def _write_groups(obj: bpy.types.Object, numbered: NumberedParts) -> None:
    """The bones find their vertices by the names of groups: make these unless they are there."""
    result = obj.data.reeb_parts
    if not result.has_groups:
        transaction.keep_mesh(obj.data)
        result.has_groups = True
        with quiet.quiet():
            outputs.update_outputs(targets.users(obj.data)[0], numbered)


def _remove_earlier(collection: bpy.types.Collection) -> None:
    for rig in list(collection.objects):
        if rig.get(ROLE) != "armature":
            continue
        if not rig.children and _looks(rig) == rig.get(MADE):
            remove_object(rig)
        else:
            transaction.keep_keys(rig, ROLE, MADE)
            del rig[ROLE], rig[MADE]


def _add_bones(context: bpy.types.Context, rig: bpy.types.Object, bones: Bones, names: list[str]) -> None:
    """Write the bones, in the Edit Mode that they can only be written in."""
    layer = context.view_layer
    with nothing_selected(layer):
        layer.objects.active = rig
        set_mode(rig, "EDIT")
        made = [rig.data.edit_bones.new(name) for name in names]
        for index, bone in enumerate(made):
            bone.head, bone.tail = Vector(bones.head[index]), Vector(bones.tail[index])
        for index, bone in enumerate(made):
            if bones.parent[index] >= 0:
                bone.parent = made[bones.parent[index]]
                bone.use_connect = bool(bones.connected[index])
        set_mode(rig, "OBJECT")


def _looks(rig: bpy.types.Object) -> str:
    """A text that differs once the user has worked on the armature."""
    bones = [(bone.name, bone.parent.name if bone.parent else "",
              [round(x, 5) for x in (*bone.head_local, *bone.tail_local)]) for bone in rig.data.bones]
    place = [round(value, 5) for row in rig.matrix_basis for value in row]
    animated = rig.animation_data is not None
    posed = [bone.name for bone in rig.pose.bones if len(bone.constraints) or bone.matrix_basis != Matrix()] \
        if rig.pose else []
    return str([rig.name, place, animated, posed, bones])
