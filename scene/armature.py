# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature with a bone for each part, and the weights with which it moves the mesh."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Matrix, Vector

from ..core.result.decomposition import Decomposition
from ..core.result.numbering import NumberedParts
from . import (
    bridge,
    made,
    mesh_arrays,
    modifiers,
    outputs,
    part_meshes,
    part_names,
    piece_objects,
    quiet,
    store,
    targets,
    transaction,
)
from .errors import SceneError
from .modes import call_with, set_mode
from .selection import nothing_selected
from .store import Stored
from .temporary import removed

if TYPE_CHECKING:
    from ..core.uses.bones import Bones
    from ..core.uses.skinning import Weights

NAME = "Reeb Parts Armature"
WEIGHTS = "reeb_parts_weights"  # on the mesh: the names of the vertex groups that hold its weights, as JSON
DEFORM = "DEF-"  # how their names begin, as Rigify's do; after that comes the name of the part


def remove_modifier(obj: bpy.types.Object) -> None:
    """Take our modifier off an object; the armature stays."""
    modifier = _modifier(obj)
    if modifier is not None:
        modifiers.remove(obj, modifier)


def _modifier(obj: bpy.types.Object) -> bpy.types.ArmatureModifier | None:
    """Our modifier on an object, or None."""
    modifier = obj.modifiers.get(NAME)
    return modifier if modifier is not None and modifier.type == "ARMATURE" else None


def remove_weights(mesh: bpy.types.Mesh) -> None:
    """Remove the vertex groups that hold our weights."""
    transaction.keep_mesh(mesh)
    transaction.keep_keys(mesh, WEIGHTS)
    obj = targets.users(mesh)[0]
    for name in _weight_groups(mesh):
        outputs.vertex_groups.remove_one(obj, name)
    if WEIGHTS in mesh:
        del mesh[WEIGHTS]


def _weight_groups(mesh: bpy.types.Mesh) -> list[str]:
    try:
        return [str(name) for name in json.loads(mesh.get(WEIGHTS, "[]"))]
    except (ValueError, TypeError):  # not written by us
        return []


def make(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, deform: bool,
         weights: str = "SMOOTH") -> bpy.types.Object:
    """Make an armature in place of an earlier one, unless the user has worked on that one; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : Stored
    deform : bool
        Give the object a modifier, so that the bones move it.
    weights : str
        "SMOOTH" for weights that change smoothly across cuts and "AUTOMATIC" for Blender's, both in vertex groups of
        their own; "PARTS" for the parts' vertex groups, so that each part moves as a whole.

    Returns
    -------
    rig : bpy.types.Object

    Raises
    ------
    SceneError
        Blender finds no weights.
    """
    numbered = stored.shown_parts()
    place, bones, bone_part, part_bone = _bones(obj, stored.decomposition, numbered, weights != "PARTS")
    remove_weights(obj.data)
    if weights == "PARTS":
        _write_groups(obj, numbered)
        groups = [part.group for part in obj.data.reeb_parts.parts]
    else:
        numbers = numbered.numbers[bone_part].tolist()
        groups = _new_groups(obj, [part_names.part_name(obj.data, number) for number in numbers])
    collection = piece_objects.make_collection(context, obj)
    made.remove_untouched(collection.objects, "armature", _looks)
    data = bpy.data.armatures.new(f"{NAME} {obj.name}")
    rig = bpy.data.objects.new(data.name, data)
    rig.matrix_world = place
    rig.show_in_front = True
    rig[made.ROLE] = "armature"
    collection.objects.link(rig)
    _add_bones(context, rig, bones, groups)
    made.mark(rig, _looks)
    if weights != "PARTS":
        found = _smooth_weights(obj, place, part_bone[numbered.parts.labels], bones)
        _write_weights(obj, groups, found if weights == "SMOOTH" else _automatic(context, obj, rig, groups, found))
    if deform:
        modifier = _modifier(obj) or modifiers.new(obj, NAME, "ARMATURE")
        transaction.keep(modifier, "object")
        modifier.object = rig
    else:
        remove_modifier(obj)
    return rig


def _new_groups(obj: bpy.types.Object, parts: list[str]) -> list[str]:
    """A vertex group for the weights of each part; their names."""
    mesh = obj.data
    transaction.keep_mesh(mesh)
    active = obj.vertex_groups.active_index
    names = [obj.vertex_groups.new(name=f"{DEFORM}{name}").name for name in parts]
    obj.vertex_groups.active_index = max(active, 0)
    mesh[WEIGHTS] = json.dumps(names)
    return names


def _smooth_weights(obj: bpy.types.Object, place: Matrix, labels: np.ndarray, bones: Bones) -> Weights:
    """Weights that change smoothly across cuts. labels : (p,) int64, bone of each face."""
    from ..core.uses.skinning import smooth_weights  # imports SciPy

    turn = np.array(place.inverted() @ obj.matrix_world, np.float64)
    points = mesh_arrays.shown_points(obj) @ turn[:3, :3].T + turn[:3, 3]
    return smooth_weights(mesh_arrays.corner_table(obj.data, points), labels, bones)


def _automatic(context: bpy.types.Context, obj: bpy.types.Object, rig: bpy.types.Object, groups: list[str],
               smooth: Weights) -> Weights:
    """Blender's own weights, found on a copy; where it finds none, the smooth ones."""
    from ..core.uses.skinning import Weights, limited

    copy = part_meshes.plain_copy(obj.data)
    twin = bpy.data.objects.new(copy.name, copy)
    with removed(bpy.data.meshes, copy), removed(bpy.data.objects, twin):
        twin.vertex_groups.clear()
        bridge.put(twin, bridge.world_matrix(obj))
        context.scene.collection.objects.link(twin)
        with nothing_selected(context.view_layer):
            for each in (twin, rig):
                each.select_set(True)
            context.view_layer.objects.active = rig
            try:
                call_with(bpy.ops.object.parent_set, rig, type="ARMATURE_AUTO")
            except RuntimeError as error:
                raise SceneError(rpt_(
                    "Blender finds no automatic weights for {name}. Choose smooth weights.").format(
                        name=obj.name)) from error
            finally:
                rig.select_set(False)
        mass = np.zeros((len(copy.vertices), len(groups)))
        column = {twin.vertex_groups[name].index: i for i, name in enumerate(groups) if name in twin.vertex_groups}
        for vertex in copy.vertices:  # groups cannot be read in bulk
            for entry in vertex.groups:
                mass[vertex.index, column[entry.group]] = entry.weight
    found, known = limited(mass), mass.any(axis=1)[:, None]
    return Weights(np.where(known, found.bone, smooth.bone), np.where(known, found.weight, smooth.weight))


def _write_weights(obj: bpy.types.Object, groups: list[str], weights: Weights) -> None:
    """Write weights into their groups, all vertices of one weight at once."""
    for index, name in enumerate(groups):
        vertex, place = np.nonzero(weights.bone == index)
        weight = weights.weight[vertex, place]
        order = np.argsort(weight, kind="stable")
        vertex, weight = vertex[order], weight[order]
        starts = np.flatnonzero(np.diff(weight, prepend=-1.0))
        for value, some in zip(weight[starts].tolist(), np.split(vertex, starts)[1:], strict=True):
            obj.vertex_groups[name].add(some.tolist(), value, "REPLACE")


def _bones(obj: bpy.types.Object, decomposition: Decomposition, numbered: NumberedParts,
           limbs: bool) -> tuple[Matrix, Bones, np.ndarray, np.ndarray]:
    """Where the armature is in the world, the bones in its coordinates, the part of each, and the bone of each part.

    limbs : bool, only bones of parts that can be bent where they are cut.
    """
    from ..core.uses.bones import limb_bones, part_bones  # imports SciPy

    mesh, parts = obj.data, numbered.parts
    world = obj.matrix_world
    place = Matrix.LocRotScale(world.to_translation(), world.to_quaternion(), None)
    turn = np.array(place.inverted() @ world, np.float64)
    points = mesh_arrays.shown_points(obj) @ turn[:3, :3].T + turn[:3, 3]
    back = turn[:3, :3] @ bridge.unstretch(store.stretch_of(mesh))
    line = decomposition.graph.point_position @ back.T + turn[:3, 3]
    nodes = decomposition.graph.node_position @ back.T + turn[:3, 3]
    surface = (
        mesh_arrays.corner_table(mesh, points), parts.labels, bridge.face_graph(obj)[0].area,
        np.nan_to_num(decomposition.field), np.concatenate([line, nodes]),
        np.concatenate([parts.point_part, parts.node_part]))
    if limbs:
        return place, *limb_bones(*surface)
    every = np.arange(parts.count)
    return place, part_bones(*surface), every, every


def _write_groups(obj: bpy.types.Object, numbered: NumberedParts) -> None:
    """The bones find their vertices by the names of groups: make these unless they are there."""
    result = obj.data.reeb_parts
    if not result.has_groups:
        transaction.keep_mesh(obj.data)
        result.has_groups = True
        with quiet.quiet():
            outputs.update_outputs(targets.users(obj.data)[0], numbered)


def _add_bones(context: bpy.types.Context, rig: bpy.types.Object, bones: Bones, names: list[str]) -> None:
    """Write the bones, in the Edit Mode that they can only be written in."""
    layer = context.view_layer
    with nothing_selected(layer):
        layer.objects.active = rig
        set_mode(rig, "EDIT")
        edited = [rig.data.edit_bones.new(name) for name in names]
        for index, bone in enumerate(edited):
            bone.head, bone.tail = Vector(bones.head[index]), Vector(bones.tail[index])
        for index, bone in enumerate(edited):
            if bones.parent[index] >= 0:
                bone.parent = edited[bones.parent[index]]
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
