# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as objects of their own: pieces.

Pieces are copies of the object, as Blender's own Separate makes them: with its materials, modifiers,
constraints and parent.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Matrix, Vector

from ..core.steps import Steps, finished, stretched
from ..core.uses.colors import linear
from . import (
    beds,
    bridge,
    by_extent,
    cap_looks,
    cut_list,
    element_layers,
    explode,
    graph_visibility,
    hidden,
    joints,
    made,
    mesh_arrays,
    modified,
    modifiers,
    part_names,
    piece_checks,
    rigid_bodies,
    targets,
    transaction,
)
from .errors import SceneError
from .part_meshes import making_pieces
from .selection import in_layer
from .settings import SeparateProperties, closes_holes
from .store import Stored
from .temporary import remove_object, removed
from .units import millimeters

COLLECTION_OF = "reeb_parts_pieces_of"  # on the collection: the object that the pieces come from; once it was its name
NUMBER = "reeb_parts_number"  # on a piece: of its part
DOWEL = "reeb_parts_dowel"  # on a loose dowel: the numbers of the two parts that it joins; once it was 1

# Modifiers that do the same to a mesh wherever the origin of its object is. Others, such as Mirror and Array, work
# about the origin, and a piece with another one would change its shape.
_ANYWHERE = {
    "ARMATURE", "BEVEL", "BOOLEAN", "CORRECTIVE_SMOOTH", "CURVE", "DATA_TRANSFER", "DECIMATE", "EDGE_SPLIT",
    "LAPLACIANSMOOTH", "LATTICE", "MASK", "SHRINKWRAP", "SMOOTH", "SOLIDIFY", "SUBSURF", "TRIANGULATE",
    "WEIGHTED_NORMAL", "WELD", "WIREFRAME",
}  # fmt: skip


def collection_of(obj: bpy.types.Object) -> bpy.types.Collection | None:
    """The collection with the pieces of an object, or None."""
    if not obj.is_property_set("reeb_parts_made"):  # to read it would set it
        return None
    collection = obj.reeb_parts_made.pieces
    # A copy of the object has this too, but the pieces are not its own.
    return collection if collection is not None and collection.get(COLLECTION_OF) in (obj, obj.name) else None


def piece_objects(obj: bpy.types.Object) -> list:
    """What was separated from an object and is still there, in the order of the part numbers."""
    collection = collection_of(obj)
    found = [piece for piece in collection.objects if NUMBER in piece] if collection else []
    return sorted(found, key=lambda piece: piece[NUMBER])


def dowels(obj: bpy.types.Object) -> list:
    """The loose dowels between the pieces of an object."""
    collection = collection_of(obj)
    return [dowel for dowel in collection.objects if DOWEL in dowel] if collection else []


def is_of(item: bpy.types.Object, numbers: Collection[int]) -> bool:
    """Whether a piece is that of one of some parts, or a dowel goes into one of them."""
    if DOWEL not in item:
        return item[NUMBER] in numbers
    joined = item[DOWEL]
    return isinstance(joined, int) or not set(numbers).isdisjoint(joined)


def original(piece: bpy.types.Object) -> bpy.types.Object | None:
    """The object that a piece was separated from, or None if it is gone."""
    for collection in piece.users_collection:
        obj = collection.get(COLLECTION_OF)
        if isinstance(obj, str):
            obj = bpy.data.objects.get((obj, None))
        if obj is not None and obj.users_scene and collection_of(obj) == collection and NUMBER in piece:
            return obj
    return None


def left_behind() -> Iterator[bpy.types.Collection]:
    """Collections of pieces whose original is gone from all scenes; it would stay in the file for them."""
    for collection in bpy.data.collections:
        source = collection.get(COLLECTION_OF)
        if isinstance(source, bpy.types.Object) and not source.users_scene and collection.is_editable:
            yield collection


def forget_original(collection: bpy.types.Collection) -> None:
    """Let pieces be the user's alone, as their original is gone."""
    transaction.keep_keys(collection, COLLECTION_OF)
    del collection[COLLECTION_OF]


@dataclass(frozen=True, eq=False)
class Separated:
    """What was made of an object.

    Attributes
    ----------
    pieces : list of bpy.types.Object
    loose : list of bpy.types.Object
        Dowels.
    left_open : int
        Edges of holes that could not be filled.
    along_faces : int
        Borders that were to be smooth and still run along faces.
    kept : int
        Earlier pieces that were left alone.
    cuts : list of joints.CutJoints
        What became of each cut that was to have joints.
    names : dict of int -> str
        What pieces are called, by the keys that the cuts have for them.
    part : dict of int -> int
        The number of the part that a piece comes from, by its key, where that is another one.
    more : int
        How many more pieces there are, so that all fit the bed.
    too_long : list of int
        Keys of pieces that do not fit the bed and could not be cut.
    n_apart : int
        Border vertices that lie on others and could not be made one with them, along which pieces stay open.
    by_extent : list of str
        Names of modifiers that shape the pieces otherwise than the whole, as these have another extent.
    made_for_all : list of str
        Names of those that do so as they know the vertices of the whole, or need a closed mesh.
    """

    pieces: list[bpy.types.Object]
    loose: list[bpy.types.Object]
    left_open: int
    along_faces: int
    kept: int
    cuts: list[joints.CutJoints]
    names: dict[int, str]
    part: dict[int, int]
    more: int
    too_long: list[int]
    n_apart: int
    by_extent: list[str]
    made_for_all: list[str]

    def cut_name(self, cut: joints.CutJoints) -> str:
        """What a cut is called: by its two pieces."""
        return " - ".join(self.names[key] for key in cut.keys)


def separate(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, numbers: list[int],
             style: SeparateProperties) -> Separated:
    """Make an object of each of some parts; Object Mode.

    Pieces that an earlier run made of these parts are replaced. A piece that the user has edited, moved or
    renamed since stays, and belongs to the user from now on.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    stored : Stored
    numbers : list of int
    style
        Has the values of settings.SeparateProperties.

    Returns
    -------
    separated : Separated
    """
    return finished(separating(context, obj, stored, numbers, style))


def separating(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, numbers: list[int],
               style: SeparateProperties) -> Steps[Separated]:
    """What ``separate`` does, in steps."""
    show_pieces(context, obj, True)  # those that stay, too
    face_numbers = stored.shown_parts().face_numbers
    seen = modified.seen_mesh(context, obj, face_numbers) if style.seen and modified.has_modifiers(obj) else None
    mesh, face_numbers = seen or (obj.data, face_numbers)
    sides = modified.both_sides(obj, mesh, face_numbers) if seen else modified.BothSides(face_numbers, {}, {})
    wanted = [*numbers, *(key for key, number in sides.part.items() if number in numbers)]
    stretch = bridge.world_stretch(obj)
    close = closes_holes(style)
    with removed(bpy.data.meshes, *([mesh] if seen else [])):
        # Before anything new is made: then that has the names of what goes.
        coming = _coming(obj, wanted, sides, style)
        earlier = yield from stretched(_removing_earlier(obj, numbers, coming), 0.0, 0.1)
        found = yield from stretched(
            making_pieces(mesh, sides.face_numbers, wanted, close, None if style.cut == "FACES" else stretch,
                          style.cut == "PLANAR"), 0.1, 0.7)
    fitted = beds.Fitted(found.meshes, {}, [])
    if style.fit_bed:
        fitted = beds.fitted(found.meshes, stretch, np.array(style.bed[:]) / millimeters())
    for mesh in fitted.meshes.values():
        cap_looks.map_caps(mesh)
    if style.cap_material:
        cap_looks.own_material(list(fitted.meshes.values()))
    origin = {key: fitted.part.get(key, key) for key in sorted(fitted.meshes)}
    names = _names(obj, origin, sides)
    part = {key: sides.part.get(own, own) for key, own in origin.items() if sides.part.get(own, own) != key}
    joined = joints.Joined(fitted.meshes, [], [])
    if style.joints != "NONE":
        joined = yield from stretched(
            joints.joining(context, fitted.meshes, stretch, joints.wanted_joints(style), cut_list.chosen(obj, part),
                           stored.decomposition.graph), 0.7, 0.8)
        cut_list.write(obj, joined.cuts, part, numbers)
    pieces = _objects(context, obj, joined.meshes, names, part, style)
    loose = [_dowel(context, obj, dowel, part, style) for dowel in joined.loose]
    for index, piece in enumerate((*pieces, *loose)):
        yield 0.8 + 0.1 * index / (len(pieces) + len(loose))
        made.mark(piece)
    made.hand_on(earlier.gone, [(_stands_for(piece), piece) for piece in (*pieces, *loose)])
    for index, piece in enumerate(pieces if close else ()):
        yield 0.9 + 0.1 * index / len(pieces)
        check_pieces([piece], stretch)
    return Separated(pieces, loose, found.left_open, found.along_faces, earlier.kept, joined.cuts, names, part,
                     len(fitted.part), fitted.left, found.n_apart,
                     by_extent.others(obj) if _keeps_modifiers(style) else [],
                     by_extent.made_for_all(obj, close) if _keeps_modifiers(style) else [])


def _coming(obj: bpy.types.Object, wanted: list[int], sides: modified.BothSides, style: SeparateProperties) -> set[str]:
    """What the new pieces stand for, and dowels, of which nobody knows yet where there is room for them."""
    parts = {sides.part.get(key, key) for key in np.intersect1d(wanted, sides.face_numbers).tolist()}
    return {*map(_name, parts), *(_stands_for(dowel) for dowel in dowels(obj) if style.joints == "DOWEL")}


def _names(obj: bpy.types.Object, origin: dict[int, int], sides: modified.BothSides) -> dict[int, str]:
    """What pieces are called without the name of the object: as their parts, with a number if one comes in several.

    origin : for the key of each piece, that of the piece it was cut from. sides : what is behind a mirror has keys of
    its own, and its name the other side's ending.
    """
    count, names, place = Counter(origin.values()), {}, Counter()
    called = part_names.all_names(obj.data)
    for key, own in origin.items():
        place[own] += 1
        name = part_names.of_side(called[sides.part.get(own, own)], sides.side.get(own, 0), own in sides.part)
        names[key] = name if count[own] == 1 else f"{name} {place[own]}"
    return names


def _objects(context: bpy.types.Context, obj: bpy.types.Object, meshes: dict[int, bpy.types.Mesh],
             names: dict[int, str], part: dict[int, int], style: SeparateProperties) -> list[bpy.types.Object]:
    """An object for each piece, in the collection of the pieces, with the color of its part."""
    collection = make_collection(context, obj)
    colors = {listed.number: listed.color[:] for listed in obj.data.reeb_parts.parts}
    offsets = by_extent.array_offsets(context, obj) if _keeps_modifiers(style) else {}
    pieces = []
    for key, mesh in meshes.items():
        number = part.get(key, key)
        piece = _piece(obj, mesh, part_names.with_object(obj, names[key]), style)
        by_extent.set_offsets(piece, offsets)
        piece.color = (*linear(colors[number]), 1.0)
        piece[NUMBER] = number
        collection.objects.link(piece)
        pieces.append(piece)
    return pieces


def _dowel(context: bpy.types.Context, obj: bpy.types.Object, dowel: joints.Dowel, part: dict[int, int],
           style: SeparateProperties) -> bpy.types.Object:
    """An object for a loose dowel, beside the pieces."""
    item = _piece(obj, dowel.mesh, f"{obj.name} Dowel", style)
    item.modifiers.clear()
    item[DOWEL] = sorted(part.get(key, key) for key in dowel.keys)
    make_collection(context, obj).objects.link(item)
    return item


def _stands_for(item: bpy.types.Object) -> str:
    """The part of a piece, or the parts that a dowel joins; see made.StandsFor."""
    if DOWEL not in item:
        return _name(item[NUMBER])
    joined = item[DOWEL]
    return f"dowel of {joined if isinstance(joined, int) else list(joined)}"


def _name(number: int) -> str:
    """What a piece stands for."""
    return f"part {number}"


def active_piece(context: bpy.types.Context) -> bpy.types.Object:
    """The active object, in Object Mode; raises SceneError unless it is a piece that was separated."""
    piece = targets.active_object(context)
    if piece is None or original(piece) is None:
        raise SceneError(rpt_("The active object is not a part that was separated from another one"))
    if context.mode != "OBJECT":
        raise SceneError(rpt_("Go to Object Mode first"))
    return piece


def whole(obj: bpy.types.Object) -> bpy.types.Object:
    """The object that a piece was separated from, or the object itself if it has pieces; raises SceneError if not."""
    found = original(obj) or obj
    if not piece_objects(found):
        raise SceneError(rpt_("There are no separated parts of {name}. Separate them first.").format(name=found.name))
    return found


def make_bodies(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored,
                kind: str) -> rigid_bodies.Joined:
    """Make rigid bodies of an object's pieces, with joints of a kind, see rigid_bodies.make; Object Mode."""
    context.view_layer.update()  # pieces made just now do not know where they are
    pieces: dict[int, list[bpy.types.Object]] = {}
    for piece in piece_objects(obj):
        pieces.setdefault(piece[NUMBER], []).append(piece)
    untouched = [piece for some in pieces.values() for piece in some if made.is_as_made(piece, former_looks)]
    joined = rigid_bodies.make(context, obj, stored, pieces, make_collection(context, obj), kind)
    for piece in untouched:  # that they are bodies now is no work of the user's
        transaction.keep_keys(piece, made.MADE)
        made.mark(piece)
    return joined


def check_pieces(pieces: list[bpy.types.Object], stretch: np.ndarray | None = None) -> None:
    """Check pieces and keep with each what was found; Object Mode.

    stretch : (3, 3) float64, what the objects do to their meshes, see bridge.world_stretch; found out without it.
    """
    for piece in pieces:
        own = bridge.world_stretch(piece) if stretch is None else stretch
        piece_checks.keep(piece, piece_checks.check(piece.data, own)[0])


def make_collection(context: bpy.types.Context, obj: bpy.types.Object) -> bpy.types.Collection:
    """The collection with what is made from an object's parts; made if it is not there."""
    collection = collection_of(obj)
    if collection is None:
        collection = bpy.data.collections.new(f"Parts of {obj.name}")
        collection[COLLECTION_OF] = obj
        transaction.keep_group(obj, "reeb_parts_made")
        obj.reeb_parts_made.pieces = collection
    if collection not in context.scene.collection.children_recursive:
        if not transaction.is_new(collection):
            transaction.on_failure(context.scene.collection.children.unlink, collection)
        context.scene.collection.children.link(collection)
    _include(context, collection)
    return collection


def _include(context: bpy.types.Context, collection: bpy.types.Collection) -> None:
    """Have a collection of ours shown by the view layer: what is made in it is to be seen."""
    transaction.keep(collection, "hide_viewport")
    collection.hide_viewport = False
    open_ = [context.view_layer.layer_collection]
    while open_:
        layer = open_.pop()
        for name in ("exclude", "hide_viewport") if layer.collection == collection else ():
            if getattr(layer, name):
                transaction.on_failure(setattr, layer, name, True)
                setattr(layer, name, False)
        open_ += layer.children


def _removing_earlier(obj: bpy.types.Object, numbers: list[int], coming: Collection[str]) -> Steps[made.Earlier]:
    """Remove pieces of these parts, and dowels in them, unless the user has worked on them or needs them.

    coming : what the new ones stand for, see made.needed.
    """
    every = len(numbers) == len(obj.data.reeb_parts.parts)
    there = [piece for piece in (*piece_objects(obj), *dowels(obj)) if every or is_of(piece, numbers)]
    needed = made.needed(there, _stands_for, coming)
    gone = []
    for index, piece in enumerate(there):
        yield index / len(there)
        if piece not in needed and made.is_untouched(piece, former_looks):
            gone.append((_stands_for(piece), piece))
        else:
            made.hand_over(piece, NUMBER, made.MADE, DOWEL)
    earlier = [piece for _, piece in gone]
    if earlier:
        rigid_bodies.remove_joints(collection_of(obj), earlier)
    for piece in earlier:
        remove_object(piece)
    return made.Earlier(gone, len(there) - len(gone))


def former_looks(piece: bpy.types.Object) -> str:
    """What earlier versions kept of a piece; see made.Former."""
    place = [round(value, 6) for row in piece.matrix_basis for value in row]
    materials = [slot.material.name if slot.material else "" for slot in piece.material_slots]
    parent = piece.parent.name if piece.parent else ""
    contents = element_layers.contents(piece.data, len(piece.vertex_groups))
    return str([piece.name, mesh_arrays.fingerprint(piece.data), contents, place, parent, piece.modifiers.keys(),
                piece.vertex_groups.keys(), materials])


def _piece(obj: bpy.types.Object, mesh: bpy.types.Mesh, name: str, style: SeparateProperties) -> bpy.types.Object:
    """An object like the given one with another mesh."""
    piece = obj.copy()
    explode.forget(piece)
    hidden.forget(piece)
    piece.name = mesh.name = name
    piece.data = mesh
    piece.hide_viewport = piece.hide_render = False
    if not _keeps_modifiers(style):
        piece.modifiers.clear()
    if style.parent:
        # What moved the object moves its child already.
        piece.animation_data_clear()
        piece.constraints.clear()
    # The origin of an object that something holds, or that something works about, cannot be moved.
    free = not piece.animation_data and not piece.constraints and all(map(_works_anywhere, piece.modifiers))
    middle = _center(mesh) if style.center and free else Vector()
    if style.parent:
        piece.parent, piece.parent_type = obj, "OBJECT"
        piece.matrix_parent_inverse = Matrix()
        piece.matrix_basis = Matrix.Translation(middle)
    else:
        piece.location += piece.matrix_basis.to_3x3() @ middle
    return piece


def _keeps_modifiers(style: SeparateProperties) -> bool:
    """Whether pieces have the modifiers of the object."""
    return style.modifiers and not style.seen


def _works_anywhere(modifier: bpy.types.Modifier) -> bool:
    """Whether a modifier does the same wherever the origin is."""
    return (modifier.type in _ANYWHERE or modifiers.only_shades(modifier)
            or (modifier.type == "MIRROR" and modifier.mirror_object is not None))


def _center(mesh: bpy.types.Mesh) -> Vector:
    """Move a mesh so that the middle of its surface is its origin; where that was."""
    area = mesh_arrays.read(mesh.polygons, "area", np.float32)
    center = mesh_arrays.read(mesh.polygons, "center", np.float32, 3).astype(np.float64)
    weight = area if area.any() else np.ones_like(area)
    middle = Vector(np.average(center, axis=0, weights=weight).tolist())
    mesh.transform(Matrix.Translation(-middle), shape_keys=True)
    return middle


def show_original(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Show the object that pieces come from, with its graph if that was seen before, and hide its pieces in the view.

    They are in the same place, where both at once would be speckled.
    """
    show_pieces(context, obj, False)
    _set_hidden(context, obj, False)
    graph_visibility.show(context, obj)


def hide_original(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Hide the object that pieces come from, with its graph, in the viewport and in renders."""
    _set_hidden(context, obj, True)
    graph_visibility.hide(context, obj)


def hides_pieces(context: bpy.types.Context, obj: bpy.types.Object) -> bool:
    """Whether a piece of an object is hidden in the viewport."""
    return any(piece.hide_get(view_layer=context.view_layer) for piece in piece_objects(obj))


def show_pieces(context: bpy.types.Context, obj: bpy.types.Object, shown: bool) -> None:
    """Show the pieces and dowels of an object in the viewport, or hide them."""
    for piece in (*piece_objects(obj), *dowels(obj)):
        if in_layer(context, piece) and piece.hide_get() == shown:
            transaction.on_failure(piece.hide_set, shown)
            piece.hide_set(not shown)


def _set_hidden(context: bpy.types.Context, obj: bpy.types.Object, hidden: bool) -> None:
    transaction.keep(obj, "hide_render")
    if in_layer(context, obj):
        transaction.on_failure(obj.hide_set, obj.hide_get())
        obj.hide_set(hidden)
    obj.hide_render = hidden
