# SPDX-License-Identifier: GPL-3.0-or-later
"""What is hidden for a while, in all view layers of the scene and in renders, and comes back as it was."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import partial

import bpy

from .. import transaction

_UNKNOWN = -1  # see schema.ReebPartsMade.rendered


def hide(context: bpy.types.Context, rendered: dict[bpy.types.Object, bool]) -> None:
    """Hide objects, and remember of each whether it is rendered when it is shown again."""
    _set_hidden(context, rendered, True)
    for obj, is_seen in rendered.items():
        _set_rendered(obj, False, int(is_seen))


def show(context: bpy.types.Context, rendered: dict[bpy.types.Object, bool]) -> None:
    """Show objects, in renders as well those that are rendered."""
    _set_hidden(context, rendered, False)
    for obj, is_seen in rendered.items():
        _set_rendered(obj, is_seen, _UNKNOWN)


def is_rendered(obj: bpy.types.Object) -> bool:
    """Whether an object is rendered, or would be if ``hide`` had not hidden it."""
    return not obj.hide_render or _known(obj) == 1


def is_known(obj: bpy.types.Object) -> bool:
    """Whether ``hide`` has hidden an object, and ``show`` not yet shown it again."""
    return _known(obj) != _UNKNOWN


def include(context: bpy.types.Context, collection: bpy.types.Collection) -> None:
    """Have the view layer show a collection, which is put into the scene if it is not there."""
    if collection not in context.scene.collection.children_recursive:
        if not transaction.is_new(collection):
            transaction.on_failure(context.scene.collection.children.unlink, collection)
        context.scene.collection.children.link(collection)
    transaction.keep(collection, "hide_viewport")
    collection.hide_viewport = False
    for layer in layers_of(context.view_layer, collection):
        for name in ("exclude", "hide_viewport"):
            if getattr(layer, name):
                transaction.on_failure(setattr, layer, name, True)
                setattr(layer, name, False)


def layers_of(
    view_layer: bpy.types.ViewLayer, collection: bpy.types.Collection | None
) -> Iterator[bpy.types.LayerCollection]:
    """Where a collection is in a view layer."""
    waiting = [view_layer.layer_collection] if collection else []
    while waiting:
        layer = waiting.pop()
        if layer.collection == collection:
            yield layer
        waiting += layer.children


def _known(obj: bpy.types.Object) -> int:
    """What is remembered: 1 if it was rendered, 0 if not."""
    return obj.reeb_parts_made.rendered if obj.is_property_set("reeb_parts_made") else _UNKNOWN  # to read would set it


def _set_rendered(obj: bpy.types.Object, rendered: bool, before: int) -> None:
    """Let an object be rendered or not. before : what is remembered, see ``_known``."""
    if _known(obj) != before:
        transaction.keep_group(obj, "reeb_parts_made")
        obj.reeb_parts_made.rendered = before
    if obj.hide_render == rendered:
        transaction.keep(obj, "hide_render")
        obj.hide_render = not rendered


def _set_hidden(context: bpy.types.Context, objects: Collection[bpy.types.Object], hidden: bool) -> None:
    """Hide objects in all view layers of the scene that have them: in each they lie where others of ours do."""
    for layer in context.scene.view_layers:
        there = set(layer.objects)
        for obj in objects:
            if obj in there and obj.hide_get(view_layer=layer) != hidden:
                transaction.on_failure(partial(obj.hide_set, not hidden, view_layer=layer))
                obj.hide_set(hidden, view_layer=layer)
