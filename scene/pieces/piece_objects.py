# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as objects of their own, called pieces: which there are, and whether they are seen.

``separation`` makes them, ``origins`` knows whose they are.
"""

from __future__ import annotations

import hashlib
from collections.abc import Collection

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.steps import Steps
from .. import bridge, store, targets, transaction
from ..errors import SceneError
from ..graph import graph_visibility
from ..modes import is_object_mode
from ..moving import rigid_bodies
from ..ours import made_objects
from ..ours.surroundings import Surroundings
from ..reading import element_layers, fingerprints
from ..showing import visibility
from ..showing.selection import in_layer
from ..store import Stored
from ..temporary import remove_object
from . import origins, piece_checks
from .origins import DOWEL, NUMBER, collection_of, original

FACES = "reeb_parts_faces"  # on a piece: which faces of the original were its part, as a short text


def piece_objects(obj: bpy.types.Object) -> list:
    """What was separated from an object and is still there, in the order of the part numbers."""
    return sorted(origins.made_of(obj, NUMBER), key=lambda piece: piece[NUMBER])


def has_pieces(obj: bpy.types.Object) -> bool:
    """Whether ``piece_objects`` finds any, which is sooner known."""
    return origins.has_any(obj, NUMBER)


def dowels(obj: bpy.types.Object) -> list:
    """The loose dowels between the pieces of an object."""
    return origins.made_of(obj, DOWEL)


def is_of(item: bpy.types.Object, numbers: Collection[int]) -> bool:
    """Whether a piece is that of one of some parts, or a dowel goes into one of them."""
    if DOWEL not in item:
        return item[NUMBER] in numbers
    joined = item[DOWEL]
    return isinstance(joined, int) or not set(numbers).isdisjoint(joined)


def hidden_for_nothing(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Objects of the scene that were hidden for their pieces, all of which are deleted now."""
    hidden = [obj for obj in context.scene.objects if obj.hide_render and obj.is_editable and NUMBER not in obj
              and store.has_parts(obj) and visibility.is_known(obj)]
    return origins.without_pieces(hidden) if hidden else []


def stands_for(item: bpy.types.Object) -> str:
    """The part of a piece, or the parts that a dowel joins; see made_objects.StandsFor."""
    if DOWEL not in item:
        return part_stands_for(item[NUMBER])
    joined = item[DOWEL]
    return f"dowel of {joined if isinstance(joined, int) else list(joined)}"


def part_stands_for(number: int) -> str:
    """What every piece of a part stands for."""
    return f"part {number}"


def faces_of(face_numbers: np.ndarray, number: int) -> str:
    """A short text that tells which faces are a part's. face_numbers : (p,) int64, the part of each face."""
    return hashlib.blake2b(np.packbits(face_numbers == number).tobytes(), digest_size=8).hexdigest()


def active_piece(context: bpy.types.Context) -> bpy.types.Object:
    """The active object, in Object Mode; raises SceneError unless it is a piece that was separated.

    Linked from another file, say, it is one without its original.
    """
    piece = targets.active_object(context)
    if piece is None or NUMBER not in piece:
        raise SceneError(rpt_("The active object is not a part that was separated from another one"))
    if not is_object_mode(context):
        raise SceneError(rpt_("Go to Object Mode first"))
    return piece


def original_of(piece: bpy.types.Object) -> bpy.types.Object:
    """The object that a piece was separated from; raises SceneError if it is gone, or never was in this file."""
    obj = original(piece)
    if obj is None:
        raise SceneError(rpt_("The object that {name} was separated from is not in this file.").format(
            name=piece.name))
    return obj


def separated(obj: bpy.types.Object) -> bpy.types.Object:
    """The object itself if it has parts and pieces of its own, else that from which it was separated, if any."""
    own = store.has_parts(obj) and has_pieces(obj)
    return obj if own else original(obj) or obj


def whole(obj: bpy.types.Object) -> bpy.types.Object:
    """The object that was separated, see ``separated``; raises SceneError if it has no pieces."""
    found = separated(obj)
    if not has_pieces(found):
        if NUMBER in found:
            original_of(found)
        raise SceneError(rpt_("There are no separated parts of {name}. Separate them first.").format(name=found.name))
    return found


def make_bodies(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored,
                kind: str) -> rigid_bodies.RigidBodies:
    """Make rigid bodies of an object's pieces, with joints of a kind, see rigid_bodies.make; Object Mode.

    A piece that the user has made something else than a mesh of is left out.

    Raises
    ------
    SceneError
        Pieces are of other parts than are shown now.
    """
    check_current(obj, stored)
    context.view_layer.update()  # pieces made just now do not know where they are
    pieces: dict[int, list[bpy.types.Object]] = {}
    for piece in piece_objects(obj):
        if piece.type == "MESH":
            pieces.setdefault(piece[NUMBER], []).append(piece)
    around = Surroundings.now()
    untouched = [piece for some in pieces.values() for piece in some
                 if made_objects.is_as_made(piece, former_looks, around)]
    joined = rigid_bodies.make(context, obj, stored, pieces, kind)
    for piece in untouched:  # that they are bodies now is no work of the user's
        transaction.keep_keys(piece, made_objects.MADE)
    made_objects.mark(untouched)
    return joined


def check_current(obj: bpy.types.Object, stored: Stored) -> None:
    """Raise SceneError if a piece is of a part that is not shown now, or has other faces now.

    Of pieces that earlier versions made the numbers are known alone.
    """
    face_numbers = stored.face_numbers
    now = {number: faces_of(face_numbers, number) for number in np.unique(face_numbers).tolist()}
    for piece in piece_objects(obj):
        number = piece[NUMBER]
        if number not in now or piece.get(FACES, now[number]) != now[number]:
            raise SceneError(rpt_("The pieces of {name} are of other parts than are shown now: separate them again."
                                  ).format(name=obj.name))


def check_pieces(pieces: list[bpy.types.Object], stretch: np.ndarray | None = None) -> None:
    """Check pieces and keep with each what was found; Object Mode.

    stretch : (3, 3) float64, what the objects do to their meshes, see bridge.world_stretch; found out without it.
    """
    for piece in pieces:
        own = bridge.world_stretch(piece) if stretch is None else stretch
        piece_checks.keep(piece, piece_checks.check(piece.data, own)[0])


def removing_earlier(obj: bpy.types.Object, numbers: list[int], coming: Collection[str]) -> Steps[made_objects.Earlier]:
    """Remove pieces of these parts, and dowels in them, unless the user has worked on them or needs them.

    coming : what the new ones stand for, see made_objects.needed.
    """
    every = len(numbers) == len(obj.data.reeb_parts.parts)
    there = [piece for piece in (*piece_objects(obj), *dowels(obj)) if every or is_of(piece, numbers)]
    needed = made_objects.needed(there, stands_for, coming)
    gone, around = [], Surroundings.now()
    for index, piece in enumerate(there):
        yield index / len(there)
        if piece not in needed and made_objects.is_untouched(piece, former_looks, around):
            gone.append((stands_for(piece), piece))
        else:
            made_objects.hand_over(piece, NUMBER, FACES, made_objects.MADE, DOWEL)
    earlier = [piece for _, piece in gone]
    if earlier:
        rigid_bodies.remove_joints(obj, earlier)
    for piece in earlier:
        remove_object(piece)
    return made_objects.Earlier(gone, len(there) - len(gone))


def former_looks(piece: bpy.types.Object) -> str:
    """What earlier versions kept of a piece; see made_objects.Former."""
    place = [round(value, 6) for row in piece.matrix_basis for value in row]
    materials = [slot.material.name if slot.material else "" for slot in piece.material_slots]
    parent = piece.parent.name if piece.parent else ""
    contents = element_layers.contents(piece.data, len(piece.vertex_groups))
    return str([piece.name, fingerprints.fingerprint(piece.data), contents, place, parent, piece.modifiers.keys(),
                piece.vertex_groups.keys(), materials])


def show_original(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Show the object that pieces come from, with its graph if that was seen before, and hide its pieces.

    They are in the same place, where both at once would be speckled.
    """
    show_pieces(context, obj, False)
    visibility.show(context, {obj: is_rendered(context, obj)})
    graph_visibility.show(context, obj)


def hide_original(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Hide the object that pieces come from, with its graph, in the viewport and in renders."""
    visibility.hide(context, {obj: is_rendered(context, obj)})
    graph_visibility.hide(context, obj)


def is_rendered(context: bpy.types.Context, obj: bpy.types.Object) -> bool:
    """Whether an object is rendered, or would be if its pieces were not shown in its place."""
    if visibility.is_known(obj) or not in_layer(context.view_layer, obj):
        return visibility.is_rendered(obj)
    # Earlier versions hid it without a note of what it was before.
    return not obj.hide_render or (obj.hide_get() and collection_of(obj) is not None)


def instances(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Objects that show a collection in which an object is: they render it only if it is rendered itself."""
    return [other for other in bpy.data.objects if other.instance_type == "COLLECTION" and other.users_scene
            and other.instance_collection is not None and obj in other.instance_collection.all_objects[:]]


def other_scenes(obj: bpy.types.Object) -> list[bpy.types.Scene]:
    """Scenes that an object is in and its pieces are not: they render it only if it is rendered where these are."""
    collection = collection_of(obj)
    return [scene for scene in obj.users_scene if collection not in scene.collection.children_recursive]


def hides_pieces(context: bpy.types.Context, obj: bpy.types.Object) -> bool:
    """Whether a piece of an object is hidden in the viewport."""
    return any(piece.hide_get(view_layer=context.view_layer) for piece in piece_objects(obj))


def show_pieces(context: bpy.types.Context, obj: bpy.types.Object, shown: bool) -> None:
    """Show the pieces and dowels of an object, or hide them, in renders, too."""
    rendered = {piece: visibility.is_rendered(piece) for piece in (*piece_objects(obj), *dowels(obj))}
    (visibility.show if shown else visibility.hide)(context, rendered)
