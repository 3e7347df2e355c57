# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as objects of their own, called pieces: which there are, whose they are, and whether they are seen.

``separation`` makes them.
"""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Iterator

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ...core.steps import Steps
from .. import bridge, store, targets, transaction
from ..errors import SceneError
from ..graph import graph_visibility
from ..moving import rigid_bodies
from ..ours import made_objects
from ..ours.surroundings import Surroundings
from ..reading import element_layers, fingerprints
from ..result.part_names import fitted, without_number
from ..showing import visibility
from ..showing.selection import in_layer
from ..store import Stored
from ..temporary import remove_object
from . import piece_checks

COLLECTION_OF = "reeb_parts_pieces_of"  # on the collection: the object that the pieces come from; once it was its name
_PARTS_OF = "Parts of "  # how its name begins
NUMBER = "reeb_parts_number"  # on a piece: of its part
FACES = "reeb_parts_faces"  # on a piece: which faces of the original were its part, as a short text
DOWEL = "reeb_parts_dowel"  # on a loose dowel: the numbers of the two parts that it joins; once it was 1


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
    for collection in piece.users_collection if NUMBER in piece else ():
        obj = _source(collection)
        if obj is not None:
            return obj
    return None


def originals(objects: Iterable[bpy.types.Object]) -> list[bpy.types.Object]:
    """The objects that the pieces among some objects were separated from, each once."""
    source = {piece: found for collection in reversed(bpy.data.collections[:])
              if COLLECTION_OF in collection and (found := _source(collection)) is not None
              for piece in collection.objects if NUMBER in piece}
    return list(dict.fromkeys(source[obj] for obj in objects if obj in source))


def _source(collection: bpy.types.Collection) -> bpy.types.Object | None:
    """The object whose pieces a collection holds, or None: none are, or it is gone."""
    obj = collection.get(COLLECTION_OF)
    if isinstance(obj, str):
        obj = bpy.data.objects.get((obj, None))
    return obj if obj is not None and obj.users_scene and collection_of(obj) == collection else None


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


def hidden_for_nothing(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Objects of the scene that were hidden for their pieces, all of which are deleted now."""
    empty = [obj for obj in context.scene.objects if obj.hide_render and obj.is_editable and NUMBER not in obj
             and store.has_parts(obj) and visibility.is_known(obj) and not _has_pieces(obj)]
    # Pieces that were moved to another collection do not say whose they are.
    moved = empty and any(NUMBER in item and item.users_scene and original(item) is None for item in bpy.data.objects)
    return [] if moved else empty


def _has_pieces(obj: bpy.types.Object) -> bool:
    """Whether a piece of an object is left, be it the user's own by now; hulls and joints are none."""
    collection = collection_of(obj)
    return collection is not None and any(item.type == "MESH" and made_objects.ROLE not in item
                                          for item in collection.objects)


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
    """The active object, in Object Mode; raises SceneError unless it is a piece that was separated."""
    piece = targets.active_object(context)
    if piece is None or original(piece) is None:
        raise SceneError(rpt_("The active object is not a part that was separated from another one"))
    if context.mode != "OBJECT":
        raise SceneError(rpt_("Go to Object Mode first"))
    return piece


def separated(obj: bpy.types.Object) -> bpy.types.Object:
    """The object itself if it has parts and pieces of its own, else that from which it was separated, if any."""
    own = store.has_parts(obj) and piece_objects(obj)
    return obj if own else original(obj) or obj


def whole(obj: bpy.types.Object) -> bpy.types.Object:
    """The object that was separated, see ``separated``; raises SceneError if it has no pieces."""
    found = separated(obj)
    if not piece_objects(found):
        raise SceneError(rpt_("There are no separated parts of {name}. Separate them first.").format(name=found.name))
    return found


def make_bodies(context: bpy.types.Context, obj: bpy.types.Object, stored: Stored,
                kind: str) -> rigid_bodies.RigidBodies:
    """Make rigid bodies of an object's pieces, with joints of a kind, see rigid_bodies.make; Object Mode.

    Raises
    ------
    SceneError
        Pieces are of other parts than are shown now.
    """
    check_current(obj, stored)
    context.view_layer.update()  # pieces made just now do not know where they are
    pieces: dict[int, list[bpy.types.Object]] = {}
    for piece in piece_objects(obj):
        pieces.setdefault(piece[NUMBER], []).append(piece)
    around = Surroundings.now()
    untouched = [piece for some in pieces.values() for piece in some
                 if made_objects.is_as_made(piece, former_looks, around)]
    joined = rigid_bodies.make(context, obj, stored, pieces, make_collection(context, obj), kind)
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


def make_collection(context: bpy.types.Context, obj: bpy.types.Object) -> bpy.types.Collection:
    """The collection with what is made from an object's parts; made if it is not there."""
    collection, name = collection_of(obj), fitted(_PARTS_OF + obj.name)
    if collection is None:
        collection = bpy.data.collections.new(name)
        collection[COLLECTION_OF] = obj
        transaction.keep_group(obj, "reeb_parts_made")
        obj.reeb_parts_made.pieces = collection
    elif collection.name.startswith(_PARTS_OF) and name not in (collection.name, without_number(collection.name)):
        transaction.keep(collection, "name")
        collection.name = name  # the object was renamed
    visibility.include(context, collection)
    return collection


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
        rigid_bodies.remove_joints(collection_of(obj), earlier)
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
