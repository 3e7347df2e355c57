# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature with a bone for each part, and the weights with which it moves the mesh."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Matrix, Vector

from ...core.result.numbering import NumberedParts
from .. import outputs, property_updates, targets, transaction
from ..errors import SceneError
from ..modes import call_with, set_mode
from ..ours import made_objects, modifiers
from ..ours.surroundings import Surroundings
from ..pieces import origins, part_meshes
from ..reading import mesh_arrays, mesh_groups, placing
from ..result import part_names
from ..showing.selection import nothing_selected
from ..store import Stored
from ..temporary import removed
from .skeleton import Skeleton, skeleton

if TYPE_CHECKING:
    from ...core.uses.moving.bones import Bones
    from ...core.uses.moving.skinning import Weights

NAME = "Reeb Parts Armature"
_ROLE = "armature"  # which is all that it stands for, see made_objects.StandsFor
DEFORM = "DEF-"  # how their names begin, as Rigify's do; after that comes the name of the part


class Made(NamedTuple):
    """An armature, how many parts have no bone of their own, and how many earlier armatures were left alone."""

    rig: bpy.types.Object
    n_stiff: int
    kept: int


def remove_modifier(obj: bpy.types.Object) -> None:
    """Take our modifier off an object; the armature stays."""
    modifier = _modifier(obj)
    if modifier is not None:
        modifiers.remove(obj, modifier)


def _modifier(obj: bpy.types.Object) -> bpy.types.ArmatureModifier | None:
    """Our modifier on an object, or None: one that the user has given another armature is the user's."""
    return next((modifier for modifier in obj.modifiers
                 if modifier.type == "ARMATURE" and part_names.without_number(modifier.name) == NAME
                 and (modifier.object is None or made_objects.ROLE in modifier.object)), None)


def clear(mesh: bpy.types.Mesh) -> bool:
    """Take our modifier off the objects of a mesh, and our weights off the mesh; the armature stays.

    Where weights were changed by hand, all of it stays, and is the user's: then True.
    """
    if _hand_over_weights(mesh):
        return True
    for obj in targets.users(mesh):
        remove_modifier(obj)
    _remove_weights(mesh)
    return False


def _hand_over_weights(mesh: bpy.types.Mesh) -> bool:
    """Let weights that the user has changed be the user's, with the armature that they are for; whether they were.

    Where vertices have come or gone, only if the user has worked on that, too: else weights would stay, under names
    that new ones should have, after each edit of the mesh.
    """
    rigs = {modifier.object for obj in targets.users(mesh) if (modifier := _modifier(obj)) is not None
            and modifier.object is not None}
    around = Surroundings.now()
    worked_on = not all(made_objects.is_as_made(rig, _former_looks, around) for rig in rigs)
    if not mesh_groups.weights_were_changed(mesh, worked_on):
        return False
    made_objects.hand_over(mesh, mesh_groups.WEIGHTS, mesh_groups.MADE)
    for rig in rigs:
        made_objects.hand_over(rig, made_objects.ROLE, made_objects.MADE)
    return True


def _remove_weights(mesh: bpy.types.Mesh) -> None:
    """Remove the vertex groups that hold our weights."""
    transaction.keep_mesh(mesh)
    names = mesh_groups.of_weights(mesh)
    for obj in targets.users(mesh)[:1] if names else ():
        for name in names:
            outputs.vertex_groups.remove_one(obj, name)
    made_objects.hand_over(mesh, mesh_groups.WEIGHTS, mesh_groups.MADE)


def make(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, deform: bool,
         weights: str = "SMOOTH") -> Made:
    """Make an armature in place of an earlier one, unless the user has worked on that one, or its weights; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : Stored
    deform : bool
        Give the object a modifier, so that the bones move it.
    weights : str
        "SMOOTH" for weights that change smoothly across cuts and "AUTOMATIC" for Blender's, both in vertex groups of
        their own; "PARTS" for the parts' vertex groups, so that each part moves as a whole. A half model has groups of
        its own for that, too.

    Returns
    -------
    made : Made

    Raises
    ------
    SceneError
        Blender finds no weights, or an armature of ours moves another object of the same mesh.
    """
    check_alone(obj)
    numbered = stored.shown_parts()
    found = skeleton(obj, numbered, limbs=weights != "PARTS")
    # The parts' own groups have no sides, by which the mirrored half of a half model would follow other bones.
    own_groups = weights != "PARTS" or found.is_half
    modifier = _modifier(obj)
    n_kept = int(_hand_over_weights(obj.data))
    _remove_weights(obj.data)
    groups = _new_groups(obj, found) if own_groups else _groups_of_parts(obj, numbered)
    collection = origins.make_collection(context, obj)
    there = origins.made_of(obj, made_objects.ROLE)
    earlier = made_objects.remove_untouched(there, _ROLE, _former_looks, lambda _: _ROLE, {_ROLE})
    rig = _new_rig(context, obj, collection, found, groups)
    if own_groups:
        _write_weights(obj, groups, found.of_mesh(_weights(context, obj, rig, groups, found, weights)))
        mesh_groups.mark_weights(obj.data)
    if deform:
        modifier = modifier or modifiers.new(obj, NAME, "ARMATURE")
        transaction.keep(modifier, "object")
        modifier.object = rig
    elif modifier is not None:
        modifiers.remove(obj, modifier)
    origins.hand_on(obj, earlier.gone, [(_ROLE, rig)])
    return Made(rig, found.n_stiff, earlier.kept + n_kept)


def _new_rig(context: bpy.types.Context, obj: bpy.types.Object, collection: bpy.types.Collection, found: Skeleton,
             groups: list[str]) -> bpy.types.Object:
    """An armature of an object, in a collection, with a bone for each group, by its name."""
    data = bpy.data.armatures.new(f"{NAME} {obj.name}")
    rig = bpy.data.objects.new(data.name, data)
    rig.matrix_world = found.place
    rig.show_in_front = True
    rig[made_objects.ROLE] = _ROLE
    collection.objects.link(rig)
    origins.claim(rig, obj)
    _add_bones(context, rig, found.bones, groups)
    made_objects.mark([rig])
    return rig


def other_rig(obj: bpy.types.Object) -> bpy.types.Object | None:
    """An armature of the user's that moves an object, if there is one."""
    ours = _modifier(obj)
    return next((modifier.object for modifier in obj.modifiers if modifier.type == "ARMATURE"
                 and modifier != ours and modifier.show_viewport and modifier.object is not None), None)


def check_alone(obj: bpy.types.Object) -> None:
    """Raise SceneError where new weights, which belong to the mesh, would take those of another object's armature."""
    for other in targets.users(obj.data):
        if other != obj and _modifier(other) is not None:
            raise SceneError(rpt_(
                "{name} shares its mesh, and so its weights, with {other}, which has an armature of its parts. Give "
                "{name} a mesh of its own (Object > Relations > Make Single User > Object & Data) and try "
                "again.").format(name=obj.name, other=other.name))


def _new_groups(obj: bpy.types.Object, found: Skeleton) -> list[str]:
    """A vertex group for the weights of each bone; their names."""
    mesh = obj.data
    transaction.keep_mesh(mesh)
    transaction.keep_keys(mesh, mesh_groups.WEIGHTS, mesh_groups.MADE)
    active = obj.vertex_groups.active_index
    attributes = set(mesh.attributes.keys())  # which a group of the same name would replace in Edit Mode
    wanted = _sided_names(obj, found, attributes) if found.is_half else [
        part_names.distinct(DEFORM + name, attributes) for name in found.names]
    names = [obj.vertex_groups.new(name=name).name for name in wanted]
    obj.vertex_groups.active_index = max(active, 0)
    mesh[mesh_groups.WEIGHTS] = json.dumps(names)
    return names


def _sided_names(obj: bpy.types.Object, found: Skeleton, others: set[str]) -> list[str]:
    """Names of groups for a half model: those of images are each other's flipped, as the Mirror modifier flips them.

    It does so only if both groups are there, be they empty. others : names that none of them gets.
    """
    taken, names = set(), list(found.names)
    for name in {*obj.vertex_groups.keys(), *others}:
        taken |= {name, bpy.utils.flip_name(name)}
    for bone, image in enumerate(found.twin.tolist()):
        if image < bone:
            names[bone] = bpy.utils.flip_name(names[image])
            continue
        stem, side = (names[bone][:-2], names[bone][-2:]) if image != bone else (names[bone], "")
        names[bone] = part_names.distinct(part_names.fitted(DEFORM + stem, side), taken)
        taken |= {names[bone], bpy.utils.flip_name(names[bone])}
    return names


def _weights(context: bpy.types.Context, obj: bpy.types.Object, rig: bpy.types.Object, groups: list[str],
             found: Skeleton, kind: str) -> Weights:
    """The weights of a skeleton's surface. kind : see ``make``."""
    from ...core.uses.moving.skinning import smooth_weights, stiff_weights  # imports SciPy

    if kind == "PARTS":
        return stiff_weights(found.table, found.labels)
    smooth = smooth_weights(found.table, found.labels, found.bones)
    return smooth if kind == "SMOOTH" else _automatic(context, obj, rig, groups, found, smooth)


def _automatic(context: bpy.types.Context, obj: bpy.types.Object, rig: bpy.types.Object, groups: list[str],
               found: Skeleton, smooth: Weights) -> Weights:
    """Blender's own weights, found on a copy; where it finds none, and on grounds, the smooth ones.

    To Blender all that is near a bone hangs on it: legs would move the floor on which they stand.
    """
    from ...core.uses.moving.skinning import Weights, limited

    copy = mesh_arrays.mesh_of(found.table, NAME) if found.is_half else part_meshes.plain_copy(obj.data)
    twin = bpy.data.objects.new(copy.name, copy)
    with removed(bpy.data.meshes, copy), removed(bpy.data.objects, twin):
        twin.vertex_groups.clear()
        placing.put(twin, rig.matrix_world if found.is_half else placing.world_matrix(obj))
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
    mass = mass[: len(found.on_ground)]  # behind these are second corners of slivers, see mesh_arrays.mesh_of
    mass[:, found.ground] = 0.0
    mass[found.on_ground] = 0.0
    own, known = limited(mass), mass.any(axis=1, keepdims=True)
    return Weights(np.where(known, own.bone, smooth.bone), np.where(known, own.weight, smooth.weight))


def _write_weights(obj: bpy.types.Object, names: list[str], weights: Weights) -> None:
    """Write weights into the groups of their bones, by name."""
    vertex, place = np.nonzero(weights.bone >= 0)
    groups = [obj.vertex_groups[name] for name in names]
    mesh_groups.give_weights(groups, vertex, weights.bone[vertex, place], weights.weight[vertex, place])


def _groups_of_parts(obj: bpy.types.Object, numbered: NumberedParts) -> list[str]:
    """The names of the parts' own groups, by which the bones find their vertices; made unless they are there."""
    result = obj.data.reeb_parts
    if not result.has_groups:
        transaction.keep_mesh(obj.data)
        result.has_groups = True
        with property_updates.quiet():
            outputs.update_outputs(targets.users(obj.data)[0], numbered)
    return [part.group for part in result.parts]


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


def _former_looks(rig: bpy.types.Object) -> str:
    """What earlier versions kept of such an object; see made_objects.Former."""
    bones = [(bone.name, bone.parent.name if bone.parent else "",
              [round(x, 5) for x in (*bone.head_local, *bone.tail_local)]) for bone in rig.data.bones]
    place = [round(value, 5) for row in rig.matrix_basis for value in row]
    animated = rig.animation_data is not None
    posed = [bone.name for bone in rig.pose.bones if len(bone.constraints) or bone.matrix_basis != Matrix()] \
        if rig.pose else []
    return str([rig.name, place, animated, posed, bones])
