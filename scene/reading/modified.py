# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh of an object as it is seen: with its modifiers applied, and the part of each face that they make."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.arrays.int64 import arange
from ...core.arrays.pairs import distinct_pairs
from ...core.sentence import Count
from ...core.symmetry.plane import MirrorPlane
from .. import bridge, property_updates
from ..errors import SceneError
from ..showing import explode, hidden
from ..snapshots import set_values, values_of
from ..temporary import removed
from . import mesh_arrays

_NUMBER = "reeb_parts_face_number"  # face attribute of the copy that is evaluated


@dataclass(frozen=True, eq=False)
class BothSides:
    """The parts of a mesh that is seen mirrored, where what lies beside the plane is two.

    Attributes
    ----------
    face_numbers : (q,) int64
        Of each face; behind the plane another one, for a part that does not reach over it.
    part : dict of int -> int
        The number of the part, for each of these other numbers.
    side : dict of int -> int
        For both numbers of such a part, 1 or -1: that of positive and that of negative coordinates.
    """

    face_numbers: np.ndarray
    part: dict[int, int]
    side: dict[int, int]


def has_modifiers(obj: bpy.types.Object) -> bool:
    """Whether modifiers other than ours, or a parent that deforms it, change what is seen of an object."""
    ours = explode.find(obj), hidden.find(obj)
    return deforming_kind(obj) is not None or any(
        modifier.show_viewport and modifier not in ours for modifier in obj.modifiers)


def deforming_kind(obj: bpy.types.Object) -> str | None:
    """The type of the modifier that its parent is to an object without being one of its modifiers, or None.

    So it is where *Parent Type* is Armature or Lattice.
    """
    deforms = obj.parent is not None and obj.parent_type == obj.parent.type  # no other types have names in both
    return obj.parent_type if deforms else None


def seen_mesh(context: bpy.types.Context, obj: bpy.types.Object,
              face_numbers: np.ndarray) -> tuple[bpy.types.Mesh, np.ndarray]:
    """The mesh of an object with its modifiers and shape keys applied; Object Mode.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
        Stays as it is.
    face_numbers : (p,) int64
        Number of the part of each face before the modifiers, 1 or more.

    Returns
    -------
    mesh : bpy.types.Mesh
        New, for the caller to remove. What a modifier makes of a face is in the part of the face.
    seen_numbers : (q,) int64
        Number of the part of each of its faces.

    Raises
    ------
    SceneError
        The modifiers make faces that come from no face of the mesh, as Remesh does.
    """
    twin = obj.copy()
    twin.data = obj.data.copy()
    with removed(bpy.data.meshes, twin.data), removed(bpy.data.objects, twin):
        explode.forget(twin)
        hidden.forget(twin)
        twin.data.attributes.new(_NUMBER, "INT", "FACE").data.foreach_set("value", face_numbers.astype(np.int32))
        twin.hide_viewport = False  # or Blender would not evaluate it
        context.scene.collection.objects.link(twin)
        mesh = evaluated_mesh(context, twin)
        # What is ours on the new mesh is told by the result, which does not come along.
        with property_updates.quiet():
            set_values(mesh.reeb_parts, values_of(obj.data.reeb_parts))
    if not len(mesh.polygons):
        bpy.data.meshes.remove(mesh)
        raise SceneError(rpt_("The modifiers of {name} leave no faces, though perhaps instances. Apply them as a mesh "
                              "and decompose again.").format(name=obj.name))
    numbers = _numbers(mesh)
    lost = int((numbers == 0).sum())
    if lost:
        bpy.data.meshes.remove(mesh)
        raise SceneError(
            rpt_("The modifiers of {name} make {n} {n:face that belongs|faces that belong} to no part. Apply the "
                 "modifiers and decompose again.").format(name=obj.name, n=Count(lost)))
    return mesh, numbers


def evaluated_mesh(context: bpy.types.Context, obj: bpy.types.Object) -> bpy.types.Mesh:
    """A new mesh, for the caller to remove: what the modifiers of an object in the scene make of its own."""
    context.view_layer.update()
    depsgraph = context.evaluated_depsgraph_get()
    return bpy.data.meshes.new_from_object(obj.evaluated_get(depsgraph), preserve_all_data_layers=True,
                                           depsgraph=depsgraph)


def both_sides(obj: bpy.types.Object, seen: bpy.types.Mesh, face_numbers: np.ndarray) -> BothSides:
    """Tell the two images of parts apart that a Mirror modifier shows twice.

    Parameters
    ----------
    obj : bpy.types.Object
    seen : bpy.types.Mesh
        The object's mesh with its modifiers applied, q faces.
    face_numbers : (q,) int64
        Number of the part of each face.

    Returns
    -------
    sides : BothSides
        Of a part whose two images share an edge the image has no number of its own, and neither has any part of an
        object that is no half model.
    """
    shape = bridge.read_shape(obj)
    if not len(shape.mirror):
        return BothSides(face_numbers, {}, {})
    plane = MirrorPlane.of(shape.mirror)
    own = 1 if plane.heights(shape.vertices).sum() > 0 else -1
    centers = mesh_arrays.read(seen.polygons, "center", np.float32, 3) @ shape.stretch.T
    image = plane.heights(centers) * own < 0
    corners = mesh_arrays.face_sizes(seen)
    edge, number = mesh_arrays.read(seen.loops, "edge_index", np.int32), np.repeat(face_numbers, corners)
    found, place = distinct_pairs(edge, number)
    behind = np.repeat(image, corners)
    reached = [np.bincount(place, side, len(found)) > 0 for side in (behind, ~behind)]
    over = found[reached[0] & reached[1], 1]
    twice = np.setdiff1d(np.intersect1d(face_numbers[image], face_numbers[~image]), over)
    another = int(face_numbers.max()) + 1 + arange(len(twice))
    numbers = face_numbers.copy()
    mirrored = image & np.isin(face_numbers, twice)
    numbers[mirrored] = another[np.searchsorted(twice, face_numbers[mirrored])]
    positive = own if plane.normal[np.abs(plane.normal).argmax()] > 0 else -own
    return BothSides(numbers, dict(zip(another.tolist(), twice.tolist(), strict=True)),
                     dict.fromkeys(twice.tolist(), positive) | dict.fromkeys(another.tolist(), -positive))


def _numbers(mesh: bpy.types.Mesh) -> np.ndarray:
    """Take the numbers of the parts off a mesh, (q,) int64; 0 where there is none."""
    attribute = mesh.attributes.get(_NUMBER)
    if attribute is None or attribute.domain != "FACE":
        return np.zeros(len(mesh.polygons), np.int64)
    numbers = mesh_arrays.read(attribute.data, "value", np.int32).astype(np.int64)
    mesh.attributes.remove(attribute)
    return numbers
