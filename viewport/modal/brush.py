# SPDX-License-Identifier: GPL-3.0-or-later
"""A round brush that paints faces into a part, over the surface."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from numpy.typing import ArrayLike

from ...core.arrays.components import components
from ...core.arrays.indexing import expanded
from ...core.arrays.int64 import arange, cumsum, full
from ...core.arrays.pairs import both_ways
from ...core.sentence import Count
from ...scene import store
from ...scene.changes import face_edits, pins
from ...scene.errors import SceneError
from ...scene.reading import mesh_arrays
from ...scene.result import part_names
from ..pointing import Model

# What a stroke leaves of a part between itself and others goes along if it is smaller than this share of what it took;
# a hand beyond a painted bracelet does not.
_SPECK = 0.1

START_SIZE = 0.04  # radius of the brush, as a share of the object's size


class Brush:
    """Which faces a dab of the brush covers; read once.

    Attributes
    ----------
    number : int
        The part that is painted.
    chosen : (p,) bool
        Faces painted so far.
    n_locked : int
        How many faces under the brush stay, since their parts are locked.
    """

    def __init__(self, obj: bpy.types.Object, model: Model, number: int) -> None:
        self.model, self.number = model, number
        model.look(bpy.context, obj)
        count = len(model.face_value)
        pairs, _ = mesh_arrays.joined_table(obj.data).face_pairs()
        first, second = both_ways(pairs).T
        self.neighbors = second[np.argsort(first, kind="stable")]  # of each face, one face after the other
        self.start = np.append(0, cumsum(np.bincount(first, minlength=count)))
        self.place = full(count, -1)
        self.chosen = np.zeros(count, bool)
        self._locked = np.zeros(count, bool)
        self.free = ~np.isin(model.numbers, pins.locked_others(obj.data, number))

    def dab(self, location: ArrayLike, radius: float, first: int) -> None:
        """Paint faces around a location, (3,), in coordinates of the mesh, as far as the surface goes there.

        first : the face that the location lies on.
        """
        near = np.array(self.model.tree.query_ball_point(location, radius), np.int64)
        if first not in near:  # faces larger than the brush are painted one by one
            near = np.append(near, first)
        self.place[near] = arange(len(near))
        owner, row = expanded(self.start[near], self.start[near + 1] - self.start[near])
        beside = self.place[self.neighbors[row]]
        _, piece = components(len(near), owner[beside >= 0], beside[beside >= 0])
        hit = near[piece == piece[self.place[first]]]
        self.place[near] = -1
        self.chosen[hit[self.free[hit]]] = True
        self._locked[hit[~self.free[hit]]] = True

    @property
    def n_locked(self) -> int:
        return int(self._locked.sum())

    def numbers(self) -> np.ndarray:
        """The part of each face once it is painted, (p,) int64."""
        return np.where(self.chosen, self.number, self.model.numbers)


def paint(context: bpy.types.Context, obj: bpy.types.Object, brush: Brush) -> str:
    """Give the painted faces to the part; what became of the stroke, in a sentence. Raises SceneError if none were."""
    moved = brush.numbers() != brush.model.numbers
    name = part_names.part_name(obj.data, brush.number)
    if not moved.any():
        raise SceneError(_why_nothing(brush).format(name=name))
    before = brush.model.numbers
    names = part_names.all_names(obj.data)
    givers = ", ".join(part_names.part_name(obj.data, number) for number in np.unique(before[moved]).tolist())
    wanted = face_edits.assign_faces(context, obj, brush.model.stored, brush.numbers(), beside_taken=_SPECK)
    after = store.load(obj.data).face_numbers
    joined = int((after[moved] == brush.number).sum())
    apart = int(moved.sum()) - joined
    if joined:
        told = [rpt_("{n} {n:face|faces} of {givers} {n:is|are} {name} now").format(
            n=Count(joined), givers=givers, name=name), face_edits.told_of_apart(apart)]
    else:
        told = [rpt_("{n} {n:face|faces} of {givers} {n:does|do} not touch {name}: a part apart").format(
            n=Count(apart), givers=givers, name=name)]
    told += [face_edits.told_of_rest(obj.data, before, wanted), face_edits.told_of_ended(obj.data, names)]
    if brush.n_locked:
        told.append(rpt_("{n} {n:is locked and stays|are locked and stay}").format(n=Count(brush.n_locked)))
    return "; ".join(filter(None, told))


def _why_nothing(brush: Brush) -> str:
    """Why a stroke changes nothing."""
    if brush.chosen.any():
        return rpt_("All that was painted is {name} already.")
    if brush.n_locked:
        return rpt_("All that was painted is locked. Unlock it in the list first.")
    return rpt_("No faces were painted.")


class ReebDab(bpy.types.PropertyGroup):
    """A dab of the brush, in coordinates of the mesh."""

    location: bpy.props.FloatVectorProperty(name="Location", size=3, subtype="XYZ")
    radius: bpy.props.FloatProperty(name="Radius", min=0.0, subtype="DISTANCE")


register, unregister = bpy.utils.register_classes_factory((ReebDab,))
