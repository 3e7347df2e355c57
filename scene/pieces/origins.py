# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose pieces objects are, and what else was made from an object's parts: hulls, joints, an armature.

They lie in a collection that points at the object. Those that are elsewhere - moved, pasted, or their collection was
deleted - know it by a text, its key. A pointer would not do: Blender copies what it points at with every copy that is
pasted, and appends it with every piece.
"""

from __future__ import annotations

import secrets
from collections.abc import Iterable, Iterator

import bpy

from .. import transaction
from ..ours import made_objects
from ..ours.made_objects import KEY  # earlier versions had none
from ..ours.surroundings import Surroundings
from ..result.part_names import fitted, without_number
from ..showing import visibility

COLLECTION_OF = "reeb_parts_pieces_of"  # on the collection: the object that the pieces come from; once it was its name
_PARTS_OF = "Parts of "  # how its name begins
NUMBER = "reeb_parts_number"  # on a piece: of its part
DOWEL = "reeb_parts_dowel"  # on a loose dowel: the numbers of the two parts that it joins; once it was 1


def collection_of(obj: bpy.types.Object) -> bpy.types.Collection | None:
    """The collection with the pieces of an object, or None."""
    if not obj.is_property_set("reeb_parts_made"):  # to read it would set it
        return None
    collection = obj.reeb_parts_made.pieces
    # A copy of the object has this too, but the pieces are not its own.
    return collection if collection is not None and collection.get(COLLECTION_OF) in (obj, obj.name) else None


def make_collection(context: bpy.types.Context, obj: bpy.types.Object) -> bpy.types.Collection:
    """The collection with what is made from an object's parts; made if it is not there."""
    collection, name = collection_of(obj), fitted(_PARTS_OF + obj.name)
    owned = _has_own_key(obj)
    if collection is None:
        collection = bpy.data.collections.new(name)
        collection[COLLECTION_OF] = obj
        transaction.keep_group(obj, "reeb_parts_made")
        obj.reeb_parts_made.pieces = collection
    elif collection.name.startswith(_PARTS_OF) and name not in (collection.name, without_number(collection.name)):
        transaction.keep(collection, "name")
        collection.name = name  # the object was renamed
    if not owned:
        transaction.keep_group(obj, "reeb_parts_made")
        obj.reeb_parts_made.key = secrets.token_hex(8)
    visibility.include(context, collection)
    return collection


def claim(item: bpy.types.Object, obj: bpy.types.Object) -> None:
    """Have what was made from an object's parts, and is in no file yet, know the object."""
    item[KEY] = _key(obj)


def hand_on(obj: bpy.types.Object, gone: list[tuple[str, bpy.types.Object]],
            new: list[tuple[str, bpy.types.Object]]) -> None:
    """As made_objects.hand_on; what was made anew goes where the user moved, or linked, what was there."""
    made_objects.hand_on(gone, new)
    around, own = Surroundings.now(), collection_of(obj)
    # What takes the places of several goes where the first of them is.
    first = {heir: item for item, heir in reversed(made_objects.heirs(gone, new))}
    for heir, item in first.items():
        where = [place for place in around.collections[item] if place not in around.physics]
        if own is not None and where and all(place.is_editable for place in where):
            for place in where:
                if place != own:
                    place.objects.link(heir)
            if own not in where:
                own.objects.unlink(heir)


def include(context: bpy.types.Context, items: Iterable[bpy.types.Object]) -> None:
    """Have the view layer show the collections, be they the user's, that objects lie in.

    Of an object that is linked to some of the user's, and still lies in that of the pieces, only this one.
    """
    around = Surroundings.now()
    found = [around.collections[item] for item in items]
    shown = [[place for place in places if COLLECTION_OF in place] or places for places in found]
    for place in dict.fromkeys(place for places in shown for place in places):
        if place not in around.physics and not place.is_embedded_data:  # which is that of a scene
            visibility.include(context, place)


def made_of(obj: bpy.types.Object, kind: str) -> list[bpy.types.Object]:
    """What was made from an object's parts and is still there. kind : a custom property that it has, such as NUMBER."""
    return [item for item in _made(obj) if kind in item]


def has_any(obj: bpy.types.Object, kind: str) -> bool:
    """Whether ``made_of`` finds anything; most are found at once."""
    return any(kind in item for item in _made(obj))


def is_made(item: bpy.types.Object) -> bool:
    """Whether something was made of an object's parts, by whatever version."""
    return any(mark in item for mark in (KEY, NUMBER, made_objects.ROLE))


def original(piece: bpy.types.Object) -> bpy.types.Object | None:
    """The object that a piece was separated from, or None if it is gone."""
    if NUMBER not in piece:
        return None
    for collection in piece.users_collection:
        obj = _source(collection)
        if obj is not None and _is_claimed(piece, obj):
            return obj
    return _owners().get(piece[KEY]) if KEY in piece else None


def originals(objects: Iterable[bpy.types.Object]) -> dict[bpy.types.Object, bpy.types.Object]:
    """The object that each piece among some objects was separated from, by the piece, as far as they are there."""
    pieces = [item for item in objects if item is not None and NUMBER in item]
    if not pieces:
        return {}
    inside = {item: obj for obj, collection in _held() for item in collection.objects if _is_claimed(item, obj)}
    owners = _owners()
    found = {item: inside.get(item) or owners.get(item.get(KEY)) for item in pieces}
    return {item: obj for item, obj in found.items() if obj is not None}


def without_pieces(objects: list[bpy.types.Object]) -> list[bpy.types.Object]:
    """Those of some objects of which no piece is in a scene, be it the user's own by now; hulls and joints are none."""
    shown = {collection for scene in bpy.data.scenes for collection in scene.collection.children_recursive}
    empty = [obj for obj in objects if collection_of(obj) not in shown or not any(map(_is_solid, _inside(obj)))]
    if not empty:
        return []
    away = {item for scene in bpy.data.scenes for item in scene.objects
            if (KEY in item or NUMBER in item) and _is_solid(item)}
    # Earlier versions' pieces that were moved to another collection do not say whose they are.
    if any(KEY not in item and original(item) is None for item in away):
        return []
    keys = {item.get(KEY) for item in away}
    return [obj for obj in empty if _key(obj) not in keys]


def left_behind() -> Iterator[bpy.types.Collection]:
    """Collections of pieces whose original is gone from all scenes; it would stay in the file for them."""
    for collection in bpy.data.collections:
        source = collection.get(COLLECTION_OF)
        if isinstance(source, bpy.types.Object) and not source.users_scene and collection.is_editable:
            yield collection


def forget_original(collection: bpy.types.Collection) -> None:
    """Let pieces be the user's alone, as their original is gone."""
    key = _key(collection[COLLECTION_OF])
    for item in bpy.data.objects:
        if key and item.get(KEY) == key:
            made_objects.hand_over(item, KEY)
    made_objects.hand_over(collection, COLLECTION_OF)


def _key(obj: bpy.types.Object) -> str:
    """What pieces know an object by; "" for one that has none yet."""
    return obj.reeb_parts_made.key if obj.is_property_set("reeb_parts_made") else ""


def _is_solid(item: bpy.types.Object) -> bool:
    """Whether something that was made is a piece, or was one, or is a dowel."""
    return item.type == "MESH" and made_objects.ROLE not in item


def _owners() -> dict[str, bpy.types.Object]:
    """The object of each key; of those that are copies of each other, the one with the collection."""
    found: dict[str, bpy.types.Object] = {}
    for obj in bpy.data.objects:
        key = _key(obj)
        first = found.get(key)
        if key and obj.users_scene and (first is None or (collection_of(first) is None and collection_of(obj))):
            found[key] = obj
    return found


def _has_own_key(obj: bpy.types.Object) -> bool:
    """Whether an object has a key that it did not get as a copy of another object."""
    key = _key(obj)
    return bool(key) and (collection_of(obj) is not None or _owners().get(key) == obj)


def _source(collection: bpy.types.Collection) -> bpy.types.Object | None:
    """The object whose pieces a collection holds, or None: none are, or it is gone."""
    obj = collection.get(COLLECTION_OF)
    if isinstance(obj, str):
        obj = bpy.data.objects.get((obj, None))
    known = isinstance(obj, bpy.types.Object) and obj.users_scene and collection_of(obj) == collection
    return obj if known else None


def _held() -> list[tuple[bpy.types.Object, bpy.types.Collection]]:
    """The objects that have a collection with pieces, and these."""
    return [(obj, collection) for collection in reversed(bpy.data.collections[:])
            if COLLECTION_OF in collection and (obj := _source(collection)) is not None]


def _is_claimed(item: bpy.types.Object, obj: bpy.types.Object) -> bool:
    """Whether what lies in the collection of an object was made from it, not moved there from another one's."""
    return KEY not in item or item[KEY] == _key(obj)


def _made(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """What was made from an object's parts, and the user's own beside it; not what has been replaced just now."""
    for found in (_inside, _away):
        yield from (item for item in found(obj) if not transaction.is_discarded(item))


def _inside(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """What was made from an object's parts and lies in its collection, and the user's own there."""
    collection = collection_of(obj)
    return [item for item in collection.objects if _is_claimed(item, obj)] if collection is not None else []


def _away(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """What was made from an object's parts and lies elsewhere."""
    key, collection = _key(obj), collection_of(obj)
    if not key:
        return []
    inside = set(collection.objects) if collection is not None else set()
    found = [item for item in bpy.data.objects if item.get(KEY) == key and item not in inside
             and item.library == obj.library and item.override_library is None]
    if not found or _owners().get(key) != obj:
        return []
    everywhere = (*bpy.data.collections, *(scene.collection for scene in bpy.data.scenes))
    # What was deleted and is still referred to lies nowhere. An object that was pasted brings pieces with the same key.
    placed = {item for collection in everywhere for item in collection.objects}
    others = {item for other, collection in _held() if other != obj for item in collection.objects
              if _is_claimed(item, other)}
    return [item for item in found if item in placed and item not in others]
