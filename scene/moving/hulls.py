# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls of parts as objects, named as game engines find them."""

from __future__ import annotations

from typing import NamedTuple

import bpy
import numpy as np
from mathutils import Matrix

from ..ours import made_objects
from ..pieces import origins
from ..reading import fingerprints, mesh_arrays, placing
from ..result import part_names
from ..store import Stored

PART = "reeb_parts_hull_of"  # on a hull: the number of its part
_LONGEST = 59  # bytes of a name, with room for a number that Blender adds


class Made(NamedTuple):
    """Hulls, and how many earlier ones were left alone."""

    hulls: list[bpy.types.Object]
    kept: int


def make(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, engine: str,
         per_part: int = 1) -> Made:
    """Make convex hulls of each part, in place of earlier ones that the user has not worked on; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : Stored
    engine : str
        "UNREAL": UCX_ and the object, then a number. "GODOT": the part, with a number if it has several, then
        -convcolonly.
    per_part : int
        How many hulls a part has at most.

    Returns
    -------
    made : Made
    """
    from ...core.uses.moving.hulls import part_hulls  # imports SciPy

    numbered = stored.shown_parts()
    table = mesh_arrays.joined_table(obj.data, mesh_arrays.shown_points(obj))
    hulls = part_hulls(table, numbered.parts.labels, per_part)
    collection = origins.make_collection(context, obj)
    coming = set(map(str, numbered.numbers.tolist()))
    there = origins.made_of(obj, made_objects.ROLE)
    earlier = made_objects.remove_untouched(there, "hull", _former_looks, _stands_for, coming)
    found: list[bpy.types.Object] = []
    names, place_of = part_names.all_names(obj.data), placing.world_matrix(obj)
    for number, several in zip(numbered.numbers.tolist(), hulls, strict=True):
        part = part_names.with_object(obj, names[number], names.values())
        for place, hull in enumerate(several, 1):
            after = f"_{place:02d}-convcolonly" if len(several) > 1 else "-convcolonly"
            name = _fitting("", part, after) if engine == "GODOT" else _fitting("UCX_", obj.name,
                                                                                f"_{len(found) + 1:02d}")
            mesh = bpy.data.meshes.new(name)
            mesh.from_pydata(hull.vertices.tolist(), [], hull.triangles.tolist())
            found.append(_placed(bpy.data.objects.new(name, mesh), place_of))
            found[-1][PART] = number
            collection.objects.link(found[-1])
            origins.claim(found[-1], obj)
    made_objects.mark(found)
    origins.hand_on(obj, earlier.gone, [(_stands_for(hull), hull) for hull in found])
    return Made(found, earlier.kept)


def _stands_for(hull: bpy.types.Object) -> str:
    """The part; see made_objects.StandsFor."""
    return str(hull.get(PART))


def _fitting(before: str, name: str, after: str) -> str:
    """A name with what stands before and after it, short enough for Blender to keep its end."""
    return before + name.encode()[: _LONGEST - len(before) - len(after)].decode(errors="ignore") + after


def _placed(hull: bpy.types.Object, place: Matrix) -> bpy.types.Object:
    """A hull where its object is, shown as lines and not rendered."""
    placing.put(hull, place)
    hull.display_type = "WIRE"
    hull.hide_render = True
    hull[made_objects.ROLE] = "hull"
    return hull


def _former_looks(hull: bpy.types.Object) -> str:
    """What earlier versions kept of such an object; see made_objects.Former."""
    place = np.round(np.array(hull.matrix_basis), 5).tolist()
    return str([hull.name, place, hull.parent is not None, hull.modifiers.keys(), hull.rigid_body is not None,
                fingerprints.fingerprint(hull.data)])
