# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts made objects of their own: pieces, and what goes between them.

Pieces are copies of the object, as Blender's own Separate makes them: with its materials, modifiers, constraints and
parent.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...core.steps import Steps, finished, stretched
from ...core.uses.colors import linear
from .. import bridge, joints
from ..ours import made_objects, modifiers
from ..properties import SeparateProperties, closes_holes
from ..reading import mesh_arrays, modified
from ..reading.placing import millimeters
from ..renaming import rename
from ..result import part_names
from ..showing import explode, hidden
from ..store import Stored
from ..temporary import removed
from . import box_fitting, by_extent, cut_list, origins
from .closing import cap_looks
from .origins import DOWEL, NUMBER, make_collection
from .part_meshes import making_pieces
from .piece_objects import (
    FACES,
    check_pieces,
    dowels,
    faces_of,
    is_rendered,
    part_stands_for,
    removing_earlier,
    show_pieces,
    stands_for,
)

# Modifiers that do the same to a mesh wherever the origin of its object is. Others, such as Mirror and Array, work
# about the origin, and a piece with another one would change its shape.
_ANYWHERE = {
    "ARMATURE", "BEVEL", "BOOLEAN", "CORRECTIVE_SMOOTH", "CURVE", "DATA_TRANSFER", "DECIMATE", "EDGE_SPLIT",
    "LAPLACIANSMOOTH", "LATTICE", "MASK", "SHRINKWRAP", "SMOOTH", "SOLIDIFY", "SUBSURF", "TRIANGULATE",
    "WEIGHTED_NORMAL", "WELD", "WIREFRAME",
}


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


@dataclass(frozen=True, eq=False)
class _Run:
    """What all steps of one separation need; stretch : (3, 3) float64, what the object does to its mesh."""

    context: bpy.types.Context
    obj: bpy.types.Object
    stored: Stored
    numbers: list[int]
    style: SeparateProperties
    stretch: np.ndarray


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
        Has the values of properties.SeparateProperties.

    Returns
    -------
    separated : Separated
    """
    return finished(separating(context, obj, stored, numbers, style))


def separating(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored, numbers: list[int],
               style: SeparateProperties) -> Steps[Separated]:
    """What ``separate`` does, in steps."""
    show_pieces(context, obj, True)  # those that stay, too
    mesh, sides = _source(context, obj, stored, style)
    wanted = [*numbers, *(key for key, number in sides.part.items() if number in numbers)]
    run = _Run(context, obj, stored, numbers, style, bridge.world_stretch(obj))
    with removed(bpy.data.meshes, *([mesh] if mesh != obj.data else [])):
        # Before anything new is made: then that has the names of what goes.
        coming = _coming(obj, wanted, sides, style)
        earlier = yield from stretched(removing_earlier(obj, numbers, coming), 0.0, 0.1)
        found = yield from stretched(
            making_pieces(mesh, sides.face_numbers, wanted, closes_holes(style),
                          None if style.cut == "FACES" else run.stretch, style.cut == "PLANAR"), 0.1, 0.7)
    fitted = _fitted(run, found.meshes)
    origin = {key: fitted.part.get(key, key) for key in sorted(fitted.meshes)}
    names = _names(obj, origin, sides)
    part = {key: sides.part.get(own, own) for key, own in origin.items() if sides.part.get(own, own) != key}
    joined = yield from stretched(_joining(run, fitted.meshes, part), 0.7, 0.8)
    pieces = _objects(run, joined.meshes, names, part)
    loose = [_dowel(run, dowel, part) for dowel in joined.loose]
    yield from stretched(_finishing(run, pieces, loose, earlier), 0.8, 1.0)
    others, made_for_all = _shaped_otherwise(run)
    return Separated(pieces, loose, found.left_open, found.along_faces, earlier.kept, joined.cuts, names, part,
                     len(fitted.part), fitted.left, found.n_apart, others, made_for_all)


def _source(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored,
            style: SeparateProperties) -> tuple[bpy.types.Mesh, modified.BothSides]:
    """The mesh that is cut, a new one with the modifiers applied if it is to be so, and the piece of each face."""
    face_numbers = stored.shown_parts().face_numbers
    if not (style.seen and modified.has_modifiers(obj)):
        return obj.data, modified.BothSides(face_numbers, {}, {})
    mesh, face_numbers = modified.seen_mesh(context, obj, face_numbers)
    return mesh, modified.both_sides(obj, mesh, face_numbers)


def _fitted(run: _Run, meshes: dict[int, bpy.types.Mesh]) -> box_fitting.Fitted:
    """Pieces as they fit the bed, if they are to; their caps with the look that is wanted."""
    fitted = box_fitting.Fitted(meshes, {}, [])
    if run.style.fit_bed:
        fitted = box_fitting.fitted(meshes, run.stretch, np.array(run.style.bed[:]) / millimeters())
    for mesh in fitted.meshes.values():
        cap_looks.map_caps(mesh)
    if run.style.cap_material:
        cap_looks.own_material(list(fitted.meshes.values()))
    return fitted


def _joining(run: _Run, meshes: dict[int, bpy.types.Mesh], part: dict[int, int]) -> Steps[joints.JointedPieces]:
    """Give pieces the joints that are wanted, and list the cuts. part : see ``Separated``."""
    if run.style.joints == "NONE":
        return joints.JointedPieces(meshes, [], [])
    joined = yield from joints.joining(
        run.context, meshes, run.stretch, joints.wanted_joints(run.style), cut_list.chosen(run.obj, part),
        run.stored.decomposition.graph)
    cut_list.write(run.obj, joined.cuts, part, run.numbers)
    return joined


def _finishing(run: _Run, pieces: list[bpy.types.Object], loose: list[bpy.types.Object],
               earlier: made_objects.Earlier) -> Steps[None]:
    """Remember what the new objects are like, have them take the places of earlier ones, and check closed pieces."""
    new = [*pieces, *loose]
    yield from stretched(made_objects.marking(new), 0.0, 0.5)
    origins.hand_on(run.obj, earlier.gone, [(stands_for(item), item) for item in new])
    for index, piece in enumerate(pieces if closes_holes(run.style) else ()):
        yield 0.5 + 0.5 * index / len(pieces)
        check_pieces([piece], run.stretch)


def _shaped_otherwise(run: _Run) -> tuple[list[str], list[str]]:
    """Names of modifiers that shape pieces otherwise than the whole; see ``Separated``."""
    if not _keeps_modifiers(run.style):
        return [], []
    return by_extent.others(run.obj), by_extent.made_for_all(run.obj, closes_holes(run.style))


def _coming(obj: bpy.types.Object, wanted: list[int], sides: modified.BothSides, style: SeparateProperties) -> set[str]:
    """What the new pieces and dowels will stand for.

    Of dowels all that are there are taken to come again, as it is not known yet where there is room for new ones.
    """
    parts = {sides.part.get(key, key) for key in np.intersect1d(wanted, sides.face_numbers).tolist()}
    return {*map(part_stands_for, parts), *(stands_for(dowel) for dowel in dowels(obj) if style.joints == "DOWEL")}


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


def _objects(run: _Run, meshes: dict[int, bpy.types.Mesh], names: dict[int, str],
             part: dict[int, int]) -> list[bpy.types.Object]:
    """An object for each piece, in the collection of the pieces, with the color of its part."""
    obj, style = run.obj, run.style
    collection = make_collection(run.context, obj)
    colors = {listed.number: listed.color[:] for listed in obj.data.reeb_parts.parts}
    offsets = by_extent.array_offsets(run.context, obj) if _keeps_modifiers(style) else {}
    face_numbers = run.stored.face_numbers
    pieces = []
    for key, mesh in meshes.items():
        number = part.get(key, key)
        piece = _piece(run, mesh, part_names.with_object(obj, names[key], names.values()))
        by_extent.set_offsets(piece, offsets)
        piece.color = (*linear(colors[number]), 1.0)
        piece[NUMBER], piece[FACES] = number, faces_of(face_numbers, number)
        origins.claim(piece, obj)
        collection.objects.link(piece)
        pieces.append(piece)
    return pieces


def _dowel(run: _Run, dowel: joints.Dowel, part: dict[int, int]) -> bpy.types.Object:
    """An object for a loose dowel, beside the pieces."""
    item = _piece(run, dowel.mesh, f"{run.obj.name} Dowel")
    item.modifiers.clear()
    item[DOWEL] = sorted(part.get(key, key) for key in dowel.keys)
    make_collection(run.context, run.obj).objects.link(item)
    origins.claim(item, run.obj)
    return item


def _piece(run: _Run, mesh: bpy.types.Mesh, name: str) -> bpy.types.Object:
    """An object like the one that is separated, with another mesh."""
    obj, style = run.obj, run.style
    piece = obj.copy()
    explode.forget(piece)
    hidden.forget(piece)
    for block in (piece, mesh):
        rename(block, name)
    piece.data = mesh
    piece.hide_viewport, piece.hide_render = False, not is_rendered(run.context, obj)
    if not _keeps_modifiers(style):
        piece.modifiers.clear()
    if style.seen or style.parent:
        _free_from_parent(piece, style)
    if style.parent:
        # What moved the object moves its child already.
        piece.animation_data_clear()
        piece.constraints.clear()
    # The origin of an object that something holds, or that something works about, cannot be moved.
    free = (not piece.animation_data and not piece.constraints and all(map(_works_anywhere, piece.modifiers))
            and modified.deforming_kind(piece) in {None, "ARMATURE"})
    middle = _center(mesh) if style.center and free else Vector()
    if style.parent:
        piece.parent, piece.parent_type = obj, "OBJECT"
        piece.matrix_parent_inverse = Matrix()
        piece.matrix_basis = Matrix.Translation(middle)
    else:
        piece.location += piece.matrix_basis.to_3x3() @ middle
    return piece


def _free_from_parent(piece: bpy.types.Object, style: SeparateProperties) -> None:
    """Have a parent that deforms only move a piece, with a modifier in its place where pieces have modifiers.

    What is seen is deformed already, and another parent would not deform.
    """
    kind = modified.deforming_kind(piece)
    if kind is None:
        return
    piece.parent_type = "OBJECT"
    if _keeps_modifiers(style):
        modifier = piece.modifiers.new(kind.title(), kind)
        modifier.object = piece.parent
        piece.modifiers.move(len(piece.modifiers) - 1, 0)  # the parent comes first


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
