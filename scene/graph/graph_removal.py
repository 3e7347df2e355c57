# SPDX-License-Identifier: GPL-3.0-or-later
"""Removes the graph of a model; what the user has made of it, and what hangs on it, stays."""

from __future__ import annotations

from collections.abc import Collection

import bpy

from .. import transaction
from ..ours import made_objects
from ..ours.made_objects import ROLE
from ..reading import placing
from ..temporary import remove_object
from . import graph_finding
from .graph_finding import SHOWN_BEFORE, SOURCE


def remove(obj: bpy.types.Object) -> None:
    """Remove the graph of an object, and those of objects that are gone."""
    remove_earlier(obj, None)


def remove_earlier(obj: bpy.types.Object, coming: Collection[str] | None) -> made_objects.Earlier:
    """Remove the graph of an object, and those of objects that are gone, and return what ``hand_on`` needs to know.

    coming : what the nodes of a new graph stand for, see made_objects.needed; None without one.
    """
    own = graph_finding.find(obj)
    earlier = _remove_items(graph_finding.wherever(obj), coming)
    for collection in [each for each in bpy.data.collections if each.get(SOURCE, each) in (obj, None)]:
        if collection == own and coming is not None:  # the new graph lies there
            made_objects.hand_over(collection, SHOWN_BEFORE)
            continue
        if collection != own:
            _remove_items(graph_finding.inside(collection), None)
        _remove_collection(collection)
    return earlier


def remove_of_removed() -> None:
    """Remove the graphs of objects that were removed from the file."""
    for collection in list(graph_finding.of_removed()):
        _remove_items(graph_finding.inside(collection), None)
        _remove_collection(collection)


def _remove_collection(collection: bpy.types.Collection) -> None:
    """Remove the collection of a graph that is gone; it is the user's who put something in it."""
    made_objects.hand_over(collection, SOURCE, SHOWN_BEFORE)
    if all(map(transaction.is_discarded, collection.all_objects)) and not len(collection.children):
        transaction.discard(collection)


def _remove_items(items: list[bpy.types.Object], coming: Collection[str] | None) -> made_objects.Earlier:
    """Remove objects of a graph; those that others need, or that are copies, are the user's from now on.

    coming : as of ``remove_earlier``.
    """
    ours = list(graph_finding.originals(items))
    needed = made_objects.needed(ours, graph_finding.stands_for, coming) if coming is not None else set()
    going = [item for item in ours if item not in needed]
    for item in set(items) - set(going):
        made_objects.hand_over(item, ROLE)
    gone = [(graph_finding.stands_for(item), item) for item in going]
    if coming is None:
        _leave_children(set(going))
    for item in going:
        remove_object(item)
    return made_objects.Earlier(gone, len(items) - len(going))


def _leave_children(going: set[bpy.types.Object]) -> None:
    """Have what the user has made children of objects that go be children of these objects' parents, where it is."""
    for child in bpy.data.objects:
        former = child.parent
        if former not in going or child in going or child.parent_type != "OBJECT" or not child.is_editable:
            continue
        parent = former.parent if former.parent is not None and former.parent.users_scene else None
        place = placing.world_matrix(former) @ child.matrix_parent_inverse
        transaction.on_failure(setattr, child, "matrix_parent_inverse", child.matrix_parent_inverse.copy())
        transaction.keep(child, "parent")
        child.parent = parent
        if parent is not None:
            child.matrix_parent_inverse = placing.world_matrix(parent).inverted_safe() @ place
        else:
            transaction.on_failure(setattr, child, "matrix_basis", child.matrix_basis.copy())
            child.matrix_basis = place @ child.matrix_basis
