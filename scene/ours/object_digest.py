# SPDX-License-Identifier: GPL-3.0-or-later
"""What an object has, as a short text that differs once somebody has worked on it.

The text covers the settings of the object and of its modifiers, constraints and whatever else it has, the mesh or the
bones with all that they carry, their name, whether they are an asset, custom properties, and what other extensions keep
there. A setting counts only where it differs from its default, so that a later Blender with more settings gives the
same text. Left out are what changes only the view - whether something is selected, hidden in the viewport or unfolded
in a panel -, what an animation or a driver sets, and our own marks.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from typing import Any

import bpy

from ..reading import element_layers, fingerprints
from ..showing import visibility

_OURS = "reeb_parts"  # how the names of our custom properties begin
_DIGEST = "looks "  # how a digest begins; what earlier versions kept is a list as text

# What is no work, follows from something else, or would lead elsewhere. The ends of a joint are pieces, which may be
# made anew under other names. The last two get another value as soon as a later Blender opens the file.
_PASSING = {
    "rna_type", "data", "hide_viewport", "hide", "select", "select_head", "select_tail", "tag", "mode", "dimensions",
    "matrix_world", "matrix_local", "matrix_basis", "matrix", "active", "is_active", "active_material",
    "active_material_index", "active_shape_key_index", "show_expanded", "show_group_selector", "show_manage_panel",
    "open_warnings_panel", "motion_path", "point_cache", "bone", "child", "object1", "object2",
    "bake_target", "fuzzy", "ShapeKey.points",
}
# Of an object, what has settings of its own, of which there are several, and of which there is one.
_PARTS = "modifiers", "constraints", "vertex_groups", "material_slots"
_SINGLE = "display", "light_linking", "lineart", "field"
_ITEMS = {"targets", "curves", "points"}  # what there are several of, deeper inside
# Told by name where pointed at.
_NAMED = bpy.types.ID, bpy.types.Bone, bpy.types.PoseBone, bpy.types.BoneCollection, bpy.types.ShapeKey
_DEEPEST = 5

# Settings whose default is another in some Blenders from 4.2 to 5.3, or wrong there, or that some lack, with what they
# are from the start. One of these names that means something else elsewhere is told there in every Blender alike.
_ON = {
    "visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission", "visible_volume_scatter",
    "visible_shadow", "show_empty_image_perspective", "show_empty_image_orthographic", "enabled",
    "use_deform", "use_inherit_rotation", "use_local_location", "use_cyclic_offset", "use_custom_shape_bone_size",
    "use_location_x", "use_location_y", "use_location_z", "use_rotation_x", "use_rotation_y", "use_rotation_z",
    "use_scale_x", "use_scale_y", "use_scale_z", "use_relative_location", "use_curve_radius", "lock_location_x",
    "lock_location_y", "lock_location_z", "lock_rotation_x", "lock_rotation_y", "lock_rotation_z",
    "use_clamp_overlap", "loop_slide", "use_limit_surface", "use_mirror_merge",
}
_FROM_THE_START: dict[str, Any] = dict.fromkeys(_ON, 1) | {
    "use_add": 0, "use_axis": [1, 0, 0], "delimit": [], "data_types_verts": [], "data_types_edges": [],
    "data_types_loops": [], "data_types_polys": [], "rotation_range": "NX", "up_axis": "UP_Y",
    "display_type": "ARMATURE_DEFINED", "edge_weight": "bevel_weight_edge", "vertex_weight": "bevel_weight_vert",
    "read_data": ["ATTRIBUTES", "COLOR", "POLY", "UV", "VERT"],
}
# Blender 5.3 tells the true defaults of constraints and bones. What all Blenders before it told, most of it nothing, is
# what counts, also for names that mean something else elsewhere.
_NOTHING = {
    "bbone_x", "bbone_z", "bulge", "bulge_max", "bulge_min", "influence", "orient_weight",
    *(f"ik_{bound}_{axis}" for bound in ("min", "max") for axis in "xyz"),
    *(f"{side}_{bound}_{axis}_scale" for side in ("from", "to") for bound in ("min", "max") for axis in "xyz"),
    "use_active_clip", "use_location", "use_original_scale", "use_stretch", "use_tail",
    "KinematicConstraint.weight", "KinematicConstraint.iterations", "MaintainVolumeConstraint.volume",
    *(f"Copy{what}Constraint.use_{axis}" for what in ("Location", "Rotation", "Scale") for axis in "xyz"),
}
_FROM_THE_START |= dict.fromkeys(_NOTHING, 0) | {
    "transform_channel": "ROTATION_X", "floor_location": "FLOOR_X", "lock_axis": "LOCK_X", "free_axis": "SAMEVOL_X",
    "project_axis": "POS_X", "project_axis_space": "WORLD", "y_scale_mode": "NONE", "keep_axis": "PLANE_X",
    "map_to_y_from": "X", "map_to_z_from": "X", "Object.track_axis": "POS_X", "TrackToConstraint.track_axis": "TRACK_X",
    "DampedTrackConstraint.track_axis": "TRACK_X", "LockedTrackConstraint.track_axis": "TRACK_X",
    "FollowPathConstraint.forward_axis": "FORWARD_X", "ObjectLineArt.crease_threshold": 2.4434609413146973,
}


def digest(item: bpy.types.Object, n_collections: int) -> str:
    """A text of some 40 letters that differs once somebody has worked on an object; not in Edit Mode.

    n_collections : how many the object is in.
    """
    moving = set(_moving_paths(item.animation_data))
    told: list[Any] = [_told(item, "", moving)]
    for name in _PARTS:
        told += _told_each(getattr(item, name), name, moving)
    told += [_told(body, "", moving) for body in (item.rigid_body, item.rigid_body_constraint) if body]
    told += [n_collections, item.asset_data is not None, *_animation(item.animation_data)]
    if item.type == "MESH":
        told += [fingerprints.fingerprint(item.data), element_layers.contents(item.data, len(item.vertex_groups))]
    elif item.type == "ARMATURE":
        told += _bones(item, moving)
    if item.data is not None:
        told += [item.data.name, item.data.asset_data is not None, *_custom(item.data)]
    told += _beside(item)
    return _DIGEST + hashlib.blake2b(repr(told).encode(errors="replace"), digest_size=16).hexdigest()


def _beside(item: bpy.types.Object) -> list[Any]:
    """What few objects have; nothing for all others, whose texts are those of before it counted."""
    found: list[Any] = []
    for name in _SINGLE:
        single = getattr(item, name)
        # Not every object has a force field, and one of a collision is of no kind.
        if single is not None and getattr(single, "type", "") != "NONE" and (told := _told(single, "", set())):
            found.append((name, told))
    holds = item.rigid_body_constraint
    if holds is not None:
        # What was made from parts may be made anew, under another name.
        ends = [end for end in (holds.object1, holds.object2) if end is not None]
        found += [end.name for end in ends if not any(key.startswith(_OURS) for key in end.keys())]
    found += _of_extensions(item)
    if item.data is not None:
        found += [*_of_extensions(item.data), *_animation(item.data.animation_data)]
    if item.type == "MESH" and item.data.shape_keys:
        found += _keys(item.data.shape_keys)
    return found


def _keys(keys: bpy.types.Key) -> list[Any]:
    """The shape keys of a mesh, but for their points, which are told with what the vertices carry."""
    moving = set(_moving_paths(keys.animation_data))
    whole = [(name, getattr(keys, name)) for name in ("use_relative", "eval_time") if name not in moving]
    return [whole, *_told_each(keys.key_blocks, "key_blocks", moving), *_animation(keys.animation_data), *_custom(keys)]


def _of_extensions(block: bpy.types.ID) -> list[tuple[str, Any]]:
    """What other extensions keep with a data block in groups of properties; one is not set until it is used."""
    found = []
    for prop in block.bl_rna.properties:
        name = prop.identifier
        if prop.is_runtime and prop.is_readonly and not name.startswith(_OURS) and block.is_property_set(name):
            value = getattr(block, name)
            told: list = [_told(item, "", set()) for item in value] if prop.type == "COLLECTION" else \
                _told(value, "", set())
            found += [(name, told)] if told else []
    return found


def is_digest(text: object) -> bool:
    """Whether a text is one of ``digest``, and not what earlier versions kept."""
    return isinstance(text, str) and text.startswith(_DIGEST)


def _told(struct: bpy.types.bpy_struct, path: str, moving: set[str], depth: int = 0) -> list[tuple[str, Any]]:
    """Names and values of what differs from its default. path : of the struct, as in animations."""
    found, kind = [], struct.bl_rna.identifier
    for prop in struct.bl_rna.properties:
        name = prop.identifier
        if name in _PASSING or f"{kind}.{name}" in _PASSING or path + name in moving:
            continue
        if prop.type in ("POINTER", "COLLECTION"):
            told = _told_inside(struct, prop, path, moving, depth)
            if told:
                found.append((name, told))
        elif not prop.is_readonly:
            value = _plain(_value(struct, name))
            if value != _default(kind, prop):
                found.append((name, value))
    return [*found, *_custom(struct)]


def _told_each(parts: Iterable[bpy.types.bpy_struct], path: str, moving: set[str]) -> list[list[tuple[str, Any]]]:
    """What is told of each modifier, constraint or such; path : of where they are."""
    # What a later Blender has made and this one does not know has not even a name.
    names = [bpy.utils.escape_identifier(getattr(part, "name", "")) for part in parts]
    return [_told(part, f'{path}["{name}"].', moving) for name, part in zip(names, parts, strict=True)]


def _told_inside(struct: bpy.types.bpy_struct, prop: bpy.types.Property, path: str, moving: set[str],
                 depth: int) -> Any:
    """What is told of what a struct points at, or of what it has several of; nothing where that is not looked at."""
    name, is_block = prop.identifier, isinstance(struct, bpy.types.ID)
    if prop.type == "COLLECTION":
        if name == "collections":  # of a bone
            return sorted(item.name for item in getattr(struct, name))
        if is_block or not (name in _ITEMS or isinstance(struct, bpy.types.PropertyGroup)):
            return None
        return [_told(item, f"{path}{name}[{index}].", moving, depth + 1)
                for index, item in enumerate(getattr(struct, name))]
    if is_block and prop.is_readonly:  # groups of extensions, and what is made when it is asked for
        return None
    value = getattr(struct, name)
    if value is None or isinstance(value, _NAMED):
        return value and value.name
    return _told(value, f"{path}{name}.", moving, depth + 1) if depth < _DEEPEST and not is_block else None


def _value(struct: bpy.types.bpy_struct, name: str) -> Any:
    """A value of a property: of what we hide for a while, that of before."""
    if name == "hide_render" and isinstance(struct, bpy.types.Object):
        return not visibility.is_rendered(struct)
    return getattr(struct, name)


def _plain(value: Any) -> Any:
    """A value of a property in types whose text is always the same."""
    if isinstance(value, set):
        return sorted(value)
    if isinstance(value, bool):  # which Blender 4.2 reads from files as 0 or 1
        return int(value)
    if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
        return value
    return [number for row in value for number in (row if hasattr(row, "__iter__") else [row])]


def _default(kind: str, prop: bpy.types.Property) -> Any:
    """The default of a property, in such types: the same in every Blender, since files go from one to the other.

    kind : which struct has it, as ``Object``.
    """
    for name in (prop.identifier, f"{kind}.{prop.identifier}"):
        if name in _FROM_THE_START:
            return _FROM_THE_START[name]
    if getattr(prop, "is_array", False):
        return list(prop.default_array)
    return sorted(prop.default_flag) if getattr(prop, "is_enum_flag", False) else prop.default


def _custom(struct: bpy.types.bpy_struct) -> list[tuple[str, str]]:
    """Custom properties, but for ours and for groups, which other extensions keep there."""
    try:
        items = sorted(struct.items())
    except TypeError:  # it can have none
        return []
    return [(key, repr(_plain(value))) for key, value in items
            if not key.startswith(_OURS) and not hasattr(value, "to_dict") and key not in struct.bl_rna.properties]


def _animation(data: bpy.types.AnimData | None) -> list[Any]:
    """The action, drivers and tracks of an object."""
    if data is None:
        return []
    drivers = [(curve.data_path, curve.array_index, curve.driver.type, curve.driver.expression)
               for curve in data.drivers]
    return [data.action.name if data.action else "", drivers, data.nla_tracks.keys()]


def _moving_paths(data: bpy.types.AnimData | None) -> Iterator[str]:
    """The properties that an animation or a driver sets."""
    if data is None:
        return
    actions = [data.action, *(strip.action for track in data.nla_tracks for strip in track.strips)]
    for curves in (data.drivers, *map(_curves, filter(None, actions))):
        for curve in curves:
            yield curve.data_path


def _curves(action: bpy.types.Action) -> list[bpy.types.FCurve]:
    """All curves of an action, for whatever it animates."""
    if bpy.app.version < (4, 4):
        return list(action.fcurves)
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
            for curve in bag.fcurves]


def _bones(rig: bpy.types.Object, moving: set[str]) -> list[Any]:
    """The bones of an armature, their rest and their pose."""
    told: list[Any] = [rig.data.collections.keys()]
    for bone in rig.data.bones:
        rest = [round(value, 5) for value in (*bone.head_local, *bone.tail_local)]
        # The head of a connected bone is its parent's tail, and some Blenders say its own radius, which nothing shows.
        told.append((rest, _told(bone, "", {"head_radius"} if bone.use_connect else set())))
    for bone in rig.pose.bones if rig.pose else ():
        path = f'pose.bones["{bpy.utils.escape_identifier(bone.name)}"].'
        told.append(_told(bone, path, moving))
        told += _told_each(bone.constraints, f"{path}constraints", moving)
    return told
