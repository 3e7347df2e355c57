# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as meshes and objects of their own.

Pieces are copies of the object, as Blender's own Separate makes them: with its materials, modifiers,
constraints and parent. Their meshes carry what the user's mesh carries, and nothing that Reeb Parts wrote
to it but the materials of the parts, if these were asked for.
"""

import bmesh
import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Matrix, Vector

from ..core.errors import ReebError
from ..operators import parts
from ..viewport import shading
from . import caps, explode, graph_objects, mesh_arrays, outputs, store, targets
from .errors import SceneError, translated
from .modes import object_mode
from .outputs.colors import linear
from .panel_settings import use_panel_settings, wanted
from .use_properties import SeparateProperties

SOURCE = "reeb_parts_pieces_of"  # on the collection: name of the object that the pieces come from
NUMBER = "reeb_parts_number"  # on a piece: of its part
MADE = "reeb_parts_looks"  # on a piece: what it was like when it was made

_FORMER = ".reeb_former"  # how the attributes begin in which attributes.py keeps what was there before


def plain_copy(mesh):
    """A copy of a mesh without anything of ours but the parts' materials; Object Mode."""
    copy = mesh.copy()
    result = copy.reeb_parts
    twin = bpy.data.objects.new(copy.name, copy)
    try:
        with store.quiet():
            result.has_materials = False
            for part in result.parts:
                part.material = None
            outputs.remove_outputs(twin)
            copy.property_unset("reeb_parts")
    finally:
        bpy.data.objects.remove(twin)
    for key in [key for key in copy.keys() if key.startswith("reeb_parts")]:  # noqa: SIM118
        del copy[key]
    for name in [a.name for a in copy.attributes if a.name.startswith(_FORMER)]:
        copy.attributes.remove(copy.attributes[name])
    return copy


def part_meshes(mesh, face_numbers: np.ndarray, wanted, close=False):
    """A mesh for each of some parts, with all that its faces carry.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        In Object Mode; stays as it is.
    face_numbers : (p,) int64
        Number of each face's part.
    wanted : iterable of int
        Numbers of the parts; loose edges and vertices belong to none.
    close : bool
        Fill the holes that the cuts leave.

    Returns
    -------
    meshes : dict of int -> bpy.types.Mesh
        UVs, colours, vertex groups, shape keys, normals and materials are kept.
    left_open : int
        Edges of holes that could not be filled.
    """
    plain = plain_copy(mesh)
    normals = _custom_normals(plain)
    edge, (vertex, face) = mesh_arrays.corner_edges(plain), mesh_arrays.face_corners(plain)
    cut = mesh_arrays.cut_edges(plain, face_numbers)
    meeting, joined = _around_cuts(plain, cut)
    wanted = [number for number in wanted if (face_numbers == number).any()]
    made, left_open = {}, 0
    for number, piece in _divide(plain, face_numbers, wanted, _has_loose(plain)):
        corner = (face_numbers == number)[face]
        if close:
            # Elements keep their order, so that those of the piece are those of its faces, rising.
            mine = np.unique(vertex[corner])
            here = np.searchsorted(mine, joined[np.isin(joined, mine).all(axis=1)])
            left_open += caps.close_cuts(piece, cut[np.unique(edge[corner])], meeting[mine], here)[1]
        if normals is not None:
            _set_normals(piece, normals[corner])
        _drop_materials(piece, [p.material for p in mesh.reeb_parts.parts if p.number != number])
        made[number] = piece
    bpy.data.meshes.remove(plain)
    return made, left_open


def _around_cuts(mesh, cut):
    """Vertices where more than two edges of cuts meet, (v,) bool, and edges from cut to cut, (k, 2).

    cut : (e,) bool.
    """
    ends = mesh_arrays.edge_ends(mesh)
    count = np.bincount(ends[cut].ravel(), minlength=len(mesh.vertices))
    return count > 2, ends[(count[ends] > 0).all(axis=1)]


def _divide(mesh, face_numbers, wanted, loose):
    """Number and mesh of each part, by halves: every face is copied log(number of parts) times."""
    for half in (wanted[: len(wanted) // 2], wanted[len(wanted) // 2 :]):
        if not half:
            continue
        mask = np.isin(face_numbers, half)
        some = _with_faces(mesh, mask, loose)
        if len(half) == 1:
            yield half[0], some
        else:
            yield from _divide(some, face_numbers[mask], half, False)
            bpy.data.meshes.remove(some)


def _with_faces(mesh, mask, loose):
    """A copy of a mesh with some of its faces only; elements keep their order.

    mask : (p,) bool. loose : whether there are edges and vertices of no face, which are left out.
    """
    copy = mesh.copy()
    bm = bmesh.new()
    try:
        bm.from_mesh(copy, face_normals=False, vertex_normals=False)
        bm.faces.ensure_lookup_table()
        bmesh.ops.delete(bm, geom=[bm.faces[i] for i in np.flatnonzero(~mask).tolist()], context="FACES")
        if loose:
            bmesh.ops.delete(bm, geom=[edge for edge in bm.edges if edge.is_wire], context="EDGES")
            bmesh.ops.delete(bm, geom=[v for v in bm.verts if not v.link_faces], context="VERTS")
        bm.to_mesh(copy)
    finally:
        bm.free()
    return copy


def _has_loose(mesh):
    """Whether there are edges or vertices of no face."""
    vertex, _ = mesh_arrays.face_corners(mesh)
    return any(
        np.bincount(corner, minlength=len(items)).min(initial=1) == 0
        for corner, items in ((mesh_arrays.corner_edges(mesh), mesh.edges), (vertex, mesh.vertices))
    )


def _custom_normals(mesh):
    """The normal of each corner, (c, 3) float32, where somebody set them; None otherwise.

    Blender keeps them relative to the faces around the vertex, of which a cut takes some away.
    """
    if not mesh.has_custom_normals:
        return None
    kept = mesh.attributes.get("custom_normal")
    if kept is not None and kept.data_type == "FLOAT_VECTOR":
        return None  # Blender 4.5 and later can keep them as they are
    normals = np.empty(3 * len(mesh.loops), np.float32)
    mesh.corner_normals.foreach_get("vector", normals)
    return normals.reshape(-1, 3)


def _set_normals(mesh, normals):
    """Set custom normals; corners of caps, which come last, keep those of their faces."""
    every = np.zeros((len(mesh.loops), 3), np.float32)
    every[: len(normals)] = normals
    mesh.normals_split_custom_set(every)


def _drop_materials(mesh, others):
    """Remove the slots of other parts' materials."""
    others = [material for material in others if material is not None]
    for index in reversed(range(len(mesh.materials))):
        if mesh.materials[index] in others:
            mesh.materials.pop(index=index)


# Objects


def collection_of(obj):
    """The collection with the pieces of an object, or None."""
    collection = obj.reeb_parts_made.pieces
    # A copy of the object has this too, but another name.
    return collection if collection is not None and collection.get(SOURCE) == obj.name else None


def pieces(obj) -> list:
    """What was separated from an object and is still there, in the order of the part numbers."""
    collection = collection_of(obj)
    found = [piece for piece in collection.objects if NUMBER in piece] if collection else []
    return sorted(found, key=lambda piece: piece[NUMBER])


def original(piece):
    """The object in the scene that a piece was separated from, or None."""
    for collection in piece.users_collection:
        obj = bpy.context.view_layer.objects.get(collection.get(SOURCE, ""))
        if obj is not None and collection_of(obj) == collection and NUMBER in piece:
            return obj
    return None


def separate(context, obj, stored, numbers, style):
    """Make an object of each of some parts; Object Mode.

    Pieces of these parts that an earlier run made are replaced. Such that somebody has edited, moved or
    renamed are somebody's work: they stay, and are no longer ours.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : store.Stored
    numbers : list of int
    style
        Has the values of ui.use_properties.SeparateProperties.

    Returns
    -------
    made : list of bpy.types.Object
    left_open : int
        Edges of holes that could not be filled.
    kept : int
        Earlier pieces that were left alone.
    """
    kept = _remove_earlier(obj, numbers)
    meshes, left_open = part_meshes(obj.data, stored.shown_parts().face_numbers, numbers, style.caps)
    collection = make_collection(context, obj)
    colors = {part.number: part.color[:] for part in obj.data.reeb_parts.parts}
    made = []
    for number, mesh in meshes.items():
        piece = _piece(obj, mesh, store.part_name(obj.data, number), style)
        piece.color = (*linear(colors[number]), 1.0)
        piece[NUMBER] = number
        collection.objects.link(piece)
        made.append(piece)
    for piece in made:
        piece[MADE] = _looks(piece)
    return made, left_open, kept


def make_collection(context, obj):
    """The collection with what is made from an object's parts; made if it is not there."""
    collection = collection_of(obj)
    if collection is None:
        collection = bpy.data.collections.new(f"Parts of {obj.name}")
        collection[SOURCE] = obj.name
        obj.reeb_parts_made.pieces = collection
    if collection not in context.scene.collection.children_recursive:
        context.scene.collection.children.link(collection)
    return collection


def _remove_earlier(obj, numbers):
    """Remove pieces of these parts unless somebody has worked on them; how many stay."""
    kept = 0
    for piece in pieces(obj):
        if piece[NUMBER] not in numbers and len(numbers) < len(obj.data.reeb_parts.parts):
            continue
        if piece.mode == "OBJECT" and not piece.children and _looks(piece) == piece[MADE]:
            mesh = piece.data
            bpy.data.objects.remove(piece)
            if mesh.users == 0:
                bpy.data.meshes.remove(mesh)
            continue
        del piece[NUMBER], piece[MADE]
        kept += 1
    return kept


def _looks(piece) -> str:
    """Differs once somebody has edited, moved or renamed the piece, or given it something."""
    place = [round(value, 6) for row in piece.matrix_basis for value in row]
    materials = [slot.material.name if slot.material else "" for slot in piece.material_slots]
    parent = piece.parent.name if piece.parent else ""
    return str([piece.name, mesh_arrays.fingerprint(piece.data), place, parent, piece.modifiers.keys(), materials])


def _piece(obj, mesh, name, style):
    """An object like the given one with another mesh."""
    piece = obj.copy()
    explode.forget(piece)
    piece.name = mesh.name = name
    piece.data = mesh
    piece.hide_viewport = piece.hide_render = False
    if not style.modifiers:
        piece.modifiers.clear()
    if style.parent:
        # What moved the object moves its child already.
        piece.animation_data_clear()
        piece.constraints.clear()
    # The origin of an object that something holds cannot be moved.
    free = not piece.animation_data and not piece.constraints
    middle = _center(mesh) if style.center and free else Vector()
    if style.parent:
        piece.parent, piece.parent_type = obj, "OBJECT"
        piece.matrix_parent_inverse = Matrix()
        piece.matrix_basis = Matrix.Translation(middle)
    else:
        piece.location += piece.matrix_basis.to_3x3() @ middle
    return piece


def _center(mesh):
    """Move a mesh so that the middle of its surface is its origin; where that was."""
    area = np.empty(len(mesh.polygons), np.float32)
    center = np.empty(3 * len(mesh.polygons), np.float32)
    mesh.polygons.foreach_get("area", area)
    mesh.polygons.foreach_get("center", center)
    weight = area if area.any() else np.ones_like(area)
    middle = Vector(np.average(center.reshape(-1, 3).astype(np.float64), axis=0, weights=weight).tolist())
    mesh.transform(Matrix.Translation(-middle), shape_keys=True)
    return middle


# Operators


class REEB_PARTS_OT_separate(bpy.types.Operator, SeparateProperties):
    """Make separate objects of the parts, with all that the mesh carries; the original stays as it is"""

    bl_idname = "reeb_parts.separate"
    bl_label = "Separate Parts into Objects"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return parts.has_parts(cls, context)

    def invoke(self, context, event):
        use_panel_settings(self, SeparateProperties, context)
        return self.execute(context)

    def execute(self, context):
        try:
            objects = [obj for obj in targets.chosen_objects(context) if store.has_result(obj.data)]
            with object_mode(context):
                found = [(obj, store.load(obj.data)) for obj in objects]
                made = [(obj, *separate(context, obj, stored, wanted(obj.data, self.which), self))
                        for obj, stored in found]
        except (SceneError, ReebError) as error:
            self.report({"ERROR"}, translated(error))
            return {"CANCELLED"}
        self._show(context, made)
        for obj, separated, left_open, kept in made:
            self._report(obj, separated, left_open, kept)
        return {"FINISHED"}

    def _show(self, context, made):
        """Hide the originals; leave the pieces selected, unless somebody is at work in another mode."""
        if self.hide:
            if context.mode != "OBJECT":
                bpy.ops.object.mode_set(mode="OBJECT")
            for obj, *_ in made:
                obj.hide_set(True)
                obj.hide_render = True
                graph_objects.set_hidden(context, obj, True)
            shading.show_pieces(context)
        space = context.space_data
        if space is not None and space.type == "VIEW_3D" and space.local_view:
            for _, separated, *_ in made:
                for piece in separated:
                    piece.local_view_set(space, True)
        if context.mode == "OBJECT":
            for other in context.view_layer.objects.selected:
                other.select_set(False)
            for _, separated, *_ in made:
                for piece in separated:
                    piece.select_set(True)
            if self.hide and made[0][1]:
                context.view_layer.objects.active = made[0][1][0]

    def _report(self, obj, separated, left_open, kept):
        self.report({"INFO"}, rpt_("{name}: {n} parts are objects now").format(name=obj.name, n=len(separated)))
        if kept:
            self.report(
                {"INFO"}, rpt_("{n} earlier pieces that were edited since are left as they are").format(n=kept))
        if left_open:
            self.report(
                {"WARNING"}, rpt_("{n} edges stay open: more than two faces meet beside them").format(n=left_open))


class REEB_PARTS_OT_show_original(bpy.types.Operator):
    """Show and select the object that this piece was separated from"""

    bl_idname = "reeb_parts.show_original"
    bl_label = "Show Original of Part"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        piece = context.view_layer.objects.active
        if piece is None or original(piece) is None:
            cls.poll_message_set(rpt_("The active object is not a part that was separated from another one"))
            return False
        if context.mode != "OBJECT":
            cls.poll_message_set(rpt_("Go to Object Mode first"))
            return False
        try:
            targets.check_object(original(piece))
        except SceneError as error:
            cls.poll_message_set(str(error))
            return False
        return True

    def execute(self, context):
        obj = original(context.view_layer.objects.active)
        obj.hide_set(False)
        obj.hide_render = False
        graph_objects.set_hidden(context, obj, not context.scene.reeb_parts.graph)
        shading.show_colors(context)
        for other in context.view_layer.objects.selected:
            other.select_set(False)
        obj.select_set(True)
        context.view_layer.objects.active = obj
        return {"FINISHED"}


CLASSES = (REEB_PARTS_OT_separate, REEB_PARTS_OT_show_original)
