# SPDX-License-Identifier: GPL-3.0-or-later
"""The bones of an object's parts, and the surface that they move; of a half model with its mirror image."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ...core.arrays.int64 import arange
from ...core.mesh.corners import CornerTable
from ...core.mesh.grounds import grounds_among
from ...core.result.numbering import NumberedParts
from ...core.result.whole import Whole, whole_of
from .. import bridge, store
from ..reading import mesh_arrays, placing
from ..result import part_names

if TYPE_CHECKING:
    from ...core.result.parts import Parts
    from ...core.uses.moving.bones import Bones, BoneSurface
    from ...core.uses.moving.skinning import Weights


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Bones and the surface that they move, in the coordinates of their armature.

    Attributes
    ----------
    place : Matrix
        Where the armature is in the world.
    bones : Bones
    names : list of str
        What the part of each bone is called; of a half model those beside the plane with the endings of their sides.
    table : CornerTable
        The object's mesh; of a half model the whole, whose first vertices are those of the mesh.
    labels : (p,) int64
        Bone of each face of the table.
    ground : (count,) bool
        Which bones are those of grounds, such as a floor.
    twin : (count,) int64
        Bone that is the mirror image of each bone of a half model, itself if it is in the plane; empty for others.
    on_plane : (n,) bool
        Which vertices of a half model are on the plane; empty for others.
    n_stiff : int
        How many parts have no bone of their own.
    """

    place: Matrix
    bones: Bones
    names: list[str]
    table: CornerTable
    labels: np.ndarray
    ground: np.ndarray
    twin: np.ndarray
    on_plane: np.ndarray
    n_stiff: int

    @property
    def on_ground(self) -> np.ndarray:
        """(n,) bool, the vertices of the table that belong to a ground."""
        found = np.zeros(len(self.table.vertices), bool)
        found[self.table.corner_vertex[self.ground[self.labels[self.table.corner_face]]]] = True
        return found

    @property
    def is_half(self) -> bool:
        """Whether the object is a half model."""
        return len(self.twin) > 0

    def of_mesh(self, weights: Weights) -> Weights:
        """The weights of the object's vertices, from those of the table's."""
        from ...core.uses.moving.skinning import of_half  # imports SciPy

        return of_half(weights, self.on_plane, self.twin) if self.is_half else weights


def whole_model(obj: bpy.types.Object, shape: bridge.Shape, numbered: NumberedParts) -> Whole | None:
    """The parts of a half model with their images, in the coordinates of its shape; None for any other object."""
    if not len(shape.mirror):
        return None
    graph, turn = numbered.parts.decomposition.graph, shape.stretch @ bridge.unstretch(store.stretch_of(obj.data))
    return whole_of(numbered.parts, mesh_arrays.corner_table(obj.data, shape.vertices), shape.face_area, shape.mirror,
                    graph.node_position @ turn.T, graph.point_position @ turn.T)


def skeleton(obj: bpy.types.Object, numbered: NumberedParts, limbs: bool) -> Skeleton:
    """Find the bones of an object's parts; Object Mode.

    limbs : bool, only bones of parts that can be bent where they are cut.
    """
    from ...core.uses.moving.bones import part_bones  # imports SciPy
    from ...core.uses.moving.limbs import limb_bones

    world, shape = placing.world_matrix(obj), bridge.read_shape(obj)
    place = Matrix.LocRotScale(world.to_translation(), world.to_quaternion(), None)
    whole = whole_model(obj, shape, numbered)
    parts = numbered.parts if whole is None else whole.parts
    surface = _surface(obj, shape, parts, whole, np.array(place.inverted() @ world, np.float64))
    bone_part = part_bone = arange(parts.count)
    if limbs:
        bones, bone_part, part_bone = limb_bones(surface)
    else:
        bones = part_bones(surface)
    twin = np.empty(0, np.int64) if whole is None else part_bone[parts.twin[bone_part]]
    on_plane = np.empty(0, bool) if whole is None else whole.on_plane
    n_stiff = int((~np.isin(arange(numbered.parts.count), bone_part)).sum())
    return Skeleton(place, bones, _names(obj.data, numbered, whole, bone_part), surface.table, part_bone[parts.labels],
                    surface.grounds[bone_part], twin, on_plane, n_stiff)


def _surface(obj: bpy.types.Object, shape: bridge.Shape, parts: Parts, whole: Whole | None,
             turn: np.ndarray) -> BoneSurface:
    """What bones are found by, in the coordinates of the armature. parts : of the whole, if there is one.

    turn : (4, 4) float64, takes the mesh's coordinates there.
    """
    from ...core.uses.moving.bones import BoneSurface  # imports SciPy
    from ...core.uses.moving.part_images import PartImages

    graph, plane, area = parts.decomposition.graph, parts.decomposition.plane, shape.face_area
    ground = grounds_among(parts.labels, shape.is_ground if whole is None else np.tile(shape.is_ground, 2))
    back = turn[:3, :3] @ bridge.unstretch(store.stretch_of(obj.data))  # from the coordinates of the result
    line = np.concatenate([graph.point_position, graph.node_position]) @ back.T + turn[:3, 3]
    on_line = line, np.concatenate([parts.point_part, parts.node_part])
    height = np.nan_to_num(parts.decomposition.field)
    if whole is None:
        table = mesh_arrays.corner_table(obj.data, placing.transformed(mesh_arrays.shown_points(obj), turn))
        surface = BoneSurface(table, parts.labels, area, height, *on_line, ground=ground)
        return surface.with_images(parts.twin, None if plane is None else plane.moved(back, turn[:3, 3]))
    rigid = turn[:3, :3] @ bridge.unstretch(shape.stretch)
    table = replace(whole.table, vertices=whole.table.vertices @ rigid.T + turn[:3, 3])
    images = PartImages(parts.twin, whole.mirror.moved(rigid, turn[:3, 3]))
    return BoneSurface(table, parts.labels, np.tile(area, 2), height, *on_line, images, ground)


def _names(mesh: bpy.types.Mesh, numbered: NumberedParts, whole: Whole | None, bone_part: np.ndarray) -> list[str]:
    """What the part of each bone is called. bone_part : of the whole, if there is one."""
    names = [part_names.part_name(mesh, number) for number in numbered.numbers.tolist()]
    if whole is None:
        return [names[part] for part in bone_part.tolist()]
    first, side = np.minimum(whole.parts.twin, arange(whole.parts.count)), whole.parts.side
    return [part_names.of_side(names[first[part]], int(side[part]), first[part] != part)
            for part in bone_part.tolist()]
