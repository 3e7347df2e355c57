# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph is hidden when its model is, and comes back with it; whoever shows it meanwhile sees it alone."""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from . import graph_objects

# Models that are hidden, by session_uid, and whether their graph was seen before.
_shown_before: dict[int, bool] = {}


def opened(context: bpy.types.Context) -> None:
    """A file was opened: what is hidden in it was hidden before."""
    _shown_before.clear()
    wanted = context.scene.reeb_parts.graph
    _shown_before.update((source.session_uid, wanted) for source in _sources() if not _is_seen(context, source))


def is_due(context: bpy.types.Context) -> bool:
    """Whether a model with a graph was hidden or shown since its graph followed."""
    return any(_is_seen(context, source) == (source.session_uid in _shown_before) for source in _sources())


def follow(context: bpy.types.Context) -> None:
    """Hide the graphs of models that were hidden, and show again those of models that are back."""
    for source in _sources():
        if not _is_seen(context, source):
            if source.session_uid not in _shown_before:
                _shown_before[source.session_uid] = graph_objects.is_shown(context, source)
                graph_objects.set_hidden(context, source, True)
        elif _shown_before.pop(source.session_uid, False) and context.scene.reeb_parts.graph:
            graph_objects.set_hidden(context, source, False)


def forget() -> None:
    """Free what is kept in memory."""
    _shown_before.clear()


def _sources() -> Iterator[bpy.types.Object]:
    """The models that have graphs."""
    found = (collection.get(graph_objects.SOURCE) for collection in bpy.data.collections)
    return (source for source in found if source is not None)


def _is_seen(context: bpy.types.Context, source: bpy.types.Object) -> bool:
    return source.visible_get(view_layer=context.view_layer)
