# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects are those of a model's graph: what we made, not what the user has copied or converted since.

They are recognized by custom properties, never by name, in the graph's own collection and wherever the user has them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import bpy

from .. import store, transaction
from ..ours.made_objects import ROLE

SOURCE = "reeb_parts_source"  # on the collection: the decomposed object
SHOWN_BEFORE = "reeb_parts_shown_before"  # on that of a model that is hidden: 1 if the graph was seen before, else 0
ROLES = NODE, ARCS = "node", "arcs"  # of the empties, and of the curve
_TYPES = {NODE: "EMPTY", ARCS: "CURVE"}
_known: dict[int, tuple[int, float]] = {}  # by _uid of graphs: session_uid of the mesh, and how long its run took
_ON_NODE = {"node": int, "part": int, "kind": str}  # custom properties, which the user may have deleted or changed


def source_of(collection: bpy.types.Collection) -> bpy.types.Object | None:
    """The object whose graph a collection is for, or None."""
    source = collection.get(SOURCE)
    return source if isinstance(source, bpy.types.Object) else None


def is_node(item: bpy.types.Object) -> bool:
    """Whether an object is a node of a graph, and has on it what nodes have."""
    return item.get(ROLE) == NODE and all(isinstance(item.get(name), kind) for name, kind in _ON_NODE.items())


def find(obj: bpy.types.Object) -> bpy.types.Collection | None:
    """The graph's collection of an object, or None."""
    return next((collection for collection in bpy.data.collections if collection.get(SOURCE) == obj), None)


def left_behind() -> Iterator[bpy.types.Object]:
    """Objects that have a graph and are in no scene any more, or got another mesh, without parts or with other ones."""
    return (source for source, uid in _sources() if not (source.users_scene and _is_of_mesh(source, uid)))


def of_other_meshes() -> Iterator[bpy.types.Object]:
    """Objects that have a graph and got another mesh, without parts or with other ones, as by Link Object Data."""
    return (source for source, uid in _sources() if not _is_of_mesh(source, uid))


def know(obj: bpy.types.Object) -> None:
    """The graph of an object that has parts is that of the mesh that it has now."""
    collection = find(obj)
    if collection is not None:
        _known[_uid(collection, obj)] = obj.data.session_uid, obj.data.reeb_parts.seconds


def know_all() -> None:
    """So are all graphs, after a file was opened."""
    _known.clear()
    know_more()


def know_more() -> None:
    """So are those graphs, after a step was undone, of which nothing is known: others may be of a former mesh again."""
    for source, uid in _sources():
        if store.has_parts(source) and (uid not in _known or uid == source.session_uid):
            _known[uid] = source.data.session_uid, source.data.reeb_parts.seconds


def _is_of_mesh(source: bpy.types.Object, uid: int) -> bool:
    """Whether an object has the parts that its graph, by _uid, is of; a copy of the mesh has them, too."""
    if not store.has_parts(source):
        return False
    mesh, seconds = _known.get(uid, (source.data.session_uid, 0.0))
    return mesh == source.data.session_uid or seconds == source.data.reeb_parts.seconds


def of_removed() -> Iterator[bpy.types.Collection]:
    """Collections of graphs whose objects were removed from the file, as in the Outliner."""
    return (collection for collection in bpy.data.collections
            if collection.library is None and collection.get(SOURCE, collection) is None)


def _sources() -> Iterator[tuple[bpy.types.Object, int]]:
    """The objects that graphs are of, and the _uid of each graph."""
    for collection in bpy.data.collections:
        source = source_of(collection) if collection.library is None else None
        if source is not None:
            yield source, _uid(collection, source)


def _uid(collection: bpy.types.Collection, source: bpy.types.Object) -> int:
    """A number that tells a graph from those before it: of its curve, which is new with each, and stays in undo."""
    curve = next((item for item in collection.objects if item.get(ROLE) == ARCS), source)
    return curve.session_uid


def arcs(obj: bpy.types.Object) -> bpy.types.Object | None:
    """The curve with the arcs of an object's graph, or None."""
    return next(_items(obj, ARCS), None)


def nodes(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """The empties of an object's graph; none if there is no graph."""
    return _items(obj, NODE)


def _items(obj: bpy.types.Object, role: str) -> Iterator[bpy.types.Object]:
    """The objects of an object's graph that have a role; none if there is no graph."""
    return (item for item in originals(wherever(obj)) if item[ROLE] == role)


def wherever(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """The objects of an object's graph, in its collection and elsewhere, with what the user has copied or converted."""
    collection = find(obj)
    return [*(inside(collection) if collection else ()), *elsewhere(obj)]


def inside(collection: bpy.types.Collection) -> list[bpy.types.Object]:
    """The objects of a graph that lie in its collection, not those of a copy of the model that was made with them."""
    source = collection[SOURCE]
    return [item for item in collection.objects if ROLE in item and not transaction.is_discarded(item)
            and (item.parent == source or not store.has_parts(item.parent))]


def originals(items: Iterable[bpy.types.Object]) -> Iterator[bpy.types.Object]:
    """Those of some objects of a graph that we made; what the user has copied or converted since is the user's."""
    known = set()
    for item in items:
        kind = str(item[ROLE]), str(item.get("node"))  # whatever a file has there
        if item.type == _TYPES.get(kind[0]) and kind not in known and (kind[0] == ARCS or is_node(item)):
            known.add(kind)
            yield item


def elsewhere(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """The objects of an object's graph that the user has moved to another collection, or whose own was deleted."""
    collection = find(obj)
    there = set(collection.objects) if collection else set()
    return [item for item in obj.children if item.get(ROLE) in ROLES and item not in there
            and not transaction.is_discarded(item)]


def exists(obj: bpy.types.Object) -> bool:
    """Whether an object has a graph, or something of one."""
    return find(obj) is not None or bool(elsewhere(obj))


def part_of(item: bpy.types.Object | None) -> tuple[bpy.types.Object, int] | None:
    """The decomposed object and the part's number that an object of a graph stands for, or None."""
    if item is None or not is_node(item) or not store.has_parts(item.parent):
        return None
    return item.parent, item["part"]


def source_of_arcs(item: bpy.types.Object | None) -> bpy.types.Object | None:
    """The decomposed object that a curve of arcs stands for, or None."""
    if item is None or item.get(ROLE) != ARCS or not store.has_parts(item.parent):
        return None
    return item.parent


def name_of_node(number: int, kind: str) -> str:
    """What a node stands for: a part and what it is in it."""
    return f"{number} {kind}"


def stands_for(item: bpy.types.Object) -> str:
    """See made_objects.StandsFor."""
    return ARCS if item[ROLE] == ARCS else name_of_node(item.get("part"), item.get("kind"))
