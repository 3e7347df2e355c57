# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut a part where somebody points: along the contour of the field through a place of the graph or surface."""

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Vector

from ..scene import bridge, mesh_arrays, store
from ..scene.errors import SceneError
from ..viewport import pointing
from ..viewport.view_tool import ViewTool
from . import edit
from .parts import PartOperator, make_active


class Knife:
    """The contours of an object's field, ready to be asked for; read once."""

    def __init__(self, obj, model):
        mesh = obj.data
        self.model = model
        self.edges = mesh_arrays.edge_ends(mesh)
        self.corner_edge, (_, self.corner_face) = mesh_arrays.corner_edges(mesh), mesh_arrays.face_corners(mesh)
        self.vertices = mesh_arrays.shown_points(obj).astype(np.float64)

    def contour(self, target):
        """The contour that a target asks for: all contours of its level in its part, and which one it is.

        Returns
        -------
        contours : core.contours.Contours
        chosen : int
            -1 if there is none.
        """
        from ..core.graph.contours import contours

        inside = self.model.numbers == self.model.number(target)
        found = contours(self.model.stored.decomposition.field, target.level, self.vertices, self.edges,
                         self.corner_edge, self.corner_face, inside)
        return found, found.around(target.location) if target.on_graph else found.through(target.face)

    def ring(self, target) -> np.ndarray:
        """The lines of the contour, (s, 2, 3) float64 in coordinates of the mesh."""
        found, chosen = self.contour(target)
        return found.segments[found.label == chosen]

    def sides(self, target, face_graph):
        """The smaller of the two sides of the cut, (p,) bool; None if nothing would be cut off.

        face_graph : core.surface.labels.FaceGraph
        """
        from ..core.graph.contours import contour_sides

        found, chosen = self.contour(target)
        if chosen < 0:
            return None
        area = face_graph.area
        inside = self.model.numbers == self.model.number(target)
        crossed = np.zeros(len(inside), bool)
        crossed[found.face[found.label == chosen]] = True
        side = contour_sides(face_graph, inside, self.model.face_value >= target.level, crossed)
        if side is not None and area[side].sum() > area[inside & ~side].sum():
            side = inside & ~side
        return side


def cut_at(context, obj, model, target) -> str:
    """Cut the part that a target lies in; what happened, in a sentence.

    Raises
    ------
    SceneError
        The part is locked, or nothing would be cut off.
    """
    number = model.number(target)
    name = store.part_name(obj.data, number)
    edit.check_unlocked(obj, [number])
    graph = bridge.face_graph(obj)
    side = Knife(obj, model).sides(target, graph)
    if side is None:
        raise SceneError(rpt_("Nothing of {name} would be cut off there. Point at another place.").format(name=name))
    new = edit.free_number(obj.data, model.stored)
    edit.assign_faces(context, obj, model.stored, np.where(side, new, model.numbers), graph)
    make_active(obj.data, new)
    return rpt_("{new} was cut from {name}").format(new=store.part_name(obj.data, new), name=name)


class REEB_PARTS_OT_cut(ViewTool, PartOperator, bpy.types.Operator):
    """Cut a part where you click, on the graph or on the surface; a ring shows where the cut will be"""

    bl_idname = "reeb_parts.cut"
    bl_label = "Cut Part at Point"
    cursor = "KNIFE"

    location: bpy.props.FloatVectorProperty(
        name="Location", size=3, subtype="XYZ", description="Where to cut, in the world",
    )
    on_graph: bpy.props.BoolProperty(
        name="On the graph", default=True,
        description="The location is on an arc of the graph; without it, on the surface",
    )

    def work(self, context, obj, stored):
        model = pointing.Model(obj)
        return cut_at(context, obj, model, model.at(obj, self.location, self.on_graph))

    def hint(self):
        return rpt_("Click the graph or the surface to cut the part there    Enter, Esc: end")

    def begin(self, context, obj):
        self.knife = Knife(obj, self.model)

    def hover(self, context, target, event):
        self.preview.lines = None if target is None else self.knife.ring(target)

    def press(self, context, target, event):
        obj = context.view_layer.objects.active
        self.location, self.on_graph = obj.matrix_world @ Vector(target.location), target.on_graph
        self.report({"INFO"}, cut_at(context, obj, self.model, target))
        return {"FINISHED"}


CLASSES = (REEB_PARTS_OT_cut,)
