# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a part is cut: the contours of the field through a place of the graph or of the surface."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.mesh.corners import CornerTable
from ...core.mesh.face_graph import FaceGraph
from ...core.sentence import Count
from ...core.steps import Steps, stretched
from ...scene import bridge, store
from ...scene.changes import face_edits, pins
from ...scene.errors import SceneError
from ...scene.pieces import cut_curves
from ...scene.reading import mesh_arrays
from ...scene.reading.seen_points import seen_points
from ...scene.result import part_list, part_names
from ..pointing import Model, Target

if TYPE_CHECKING:
    from ...core.result.editing.contour_cut import Contours


class Knife:
    """The contours of an object's field, ready to be asked for; read once."""

    def __init__(self, obj: bpy.types.Object, model: Model) -> None:
        self.model = model
        self.table = mesh_arrays.joined_table(obj.data, mesh_arrays.shown_points(obj))
        self.seen = seen_points(bpy.context, obj).astype(np.float64)  # where the vertices are drawn
        self._parts: dict[int, CornerTable] = {}  # corners of the parts that were asked for
        self._surface: tuple[FaceGraph, CornerTable, np.ndarray] | None = None  # for curves

    def contour(self, target: Target) -> tuple[Contours, int]:
        """The contour that a target asks for: all contours of its level in its part, and which one it is.

        Returns
        -------
        contours : Contours
        chosen : int
            -1 if there is none.
        """
        from ...core.result.editing.contour_cut import contours

        number = self.model.number(target)
        if number not in self._parts:
            self._parts[number] = self.table.within(self.model.numbers == number)
        found = contours(self.model.stored.decomposition.field, target.level, self._parts[number])
        return found, found.around(target.location) if target.on_graph else found.through(target.face)

    def ring(self, target: Target) -> np.ndarray:
        """The lines of the contour, (s, 2, 3) float64 in coordinates of the mesh, where they are seen."""
        found, chosen = self.contour(target)
        return found.moved(self.seen)[found.label == chosen]

    def finding_curve(self, obj: bpy.types.Object, target: Target, planar: bool,
                      along_faces: bool = False) -> Steps[np.ndarray]:
        """Find the lines that Separate would cut along there, in steps; as those of ``ring``.

        None where nothing would be cut off; where faces stay whole, those of the ring. The object, which has to be the
        one that was read, is not touched any more.
        """
        if self._surface is None:
            self._surface = bridge.face_graph(obj)[0], *cut_curves.read(obj)
        return self._finding_curve(*self._surface, target, planar, along_faces)

    def _finding_curve(self, face_graph: FaceGraph, table: CornerTable, points: np.ndarray, target: Target,
                       planar: bool, along_faces: bool) -> Steps[np.ndarray]:
        yield 0.0
        side = self.sides(target, face_graph)
        if side is None:
            return np.empty((0, 2, 3))
        if along_faces:
            return self.ring(target)
        yield 0.1
        old, new = self.model.number(target), int(self.model.numbers.max()) + 1
        numbers = np.where(side, new, self.model.numbers)
        curves = yield from stretched(cut_curves.finding_curves(table, points, numbers, planar), 0.1, 1.0)
        here = (curves.pair == (old, new)).all(axis=1)
        if not here.any():  # whole pieces border on nothing
            return self.ring(target)
        return curves.points(self.seen)[curves.segments[here]]

    def sides(self, target: Target, face_graph: FaceGraph) -> np.ndarray | None:
        """The smaller of the two sides of the cut, (p,) bool; None if nothing would be cut off.

        face_graph : core.mesh.face_graph.FaceGraph
        """
        from ...core.result.editing.changes import smaller_side, two_sides
        from ...core.result.editing.contour_cut import contour_sides

        found, chosen = self.contour(target)
        if chosen < 0:
            return None
        inside = self.model.numbers == self.model.number(target)
        crossed = np.zeros(len(inside), bool)
        crossed[found.face[found.label == chosen]] = True
        side = contour_sides(face_graph, inside, self.model.face_value >= target.level, crossed)
        if side is None:
            return None
        side, other = two_sides(face_graph, self.model.stored.decomposition.contacts, inside, side)
        return smaller_side(side, side | other, face_graph.area)


def cut_at(context: bpy.types.Context, obj: bpy.types.Object, model: Model, target: Target) -> str:
    """Cut the part that a target lies in; what happened, in a sentence.

    Raises
    ------
    SceneError
        The part is locked, or nothing would be cut off.
    """
    number = model.number(target)
    name = part_names.part_name(obj.data, number)
    pins.check_unlocked(obj.data, [number])
    tables = bridge.face_graph(obj)
    side = Knife(obj, model).sides(target, tables[0])
    if side is None:
        raise SceneError(nothing_there(obj, number))
    new = pins.free_number(obj.data, model.stored)
    face_edits.assign_faces(context, obj, model.stored, np.where(side, new, model.numbers), tables)
    part_list.make_active(obj.data, new)
    told = rpt_("{new} was cut from {name}").format(new=part_names.part_name(obj.data, new), name=name)
    more = _parts_beside(model, store.load(obj.data), new)
    if not more:
        return told
    return told + "; " + rpt_("what is left is in {n} {n:part|parts} more").format(n=Count(more))


def nothing_there(obj: bpy.types.Object, number: int) -> str:
    """What is said where nothing of a part would be cut off."""
    return rpt_("Nothing of {name} would be cut off there. Point at another place.").format(
        name=part_names.part_name(obj.data, number))


def _parts_beside(before: Model, after: store.Stored, new: int) -> int:
    """How many parts have come about beside a new one and its mirror image."""
    from ...core.result.editing.mirrored import twin_numbers

    made = np.setdiff1d(after.shown, before.numbers)
    return len(np.setdiff1d(made, [new, twin_numbers(after.shown_parts()).get(new, new)]))
