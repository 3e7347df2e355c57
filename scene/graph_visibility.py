# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph is hidden when its model is, and comes back with it; whoever shows it meanwhile sees it alone.

What was done is kept with the graph, not in memory: undo leads to the moment when the model was hidden or shown already
and its graph had yet to follow.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from . import graph_objects, transaction
from .graph_objects import SHOWN_BEFORE


def is_due(context: bpy.types.Context) -> bool:
    """Whether a model with a graph was hidden or shown since its graph followed."""
    return any(_is_seen(context, source) == (SHOWN_BEFORE in graph) for graph, source in _graphs())


def follow(context: bpy.types.Context) -> None:
    """Hide the graphs of models that were hidden, and show again those of models that are back."""
    for graph, source in _graphs():
        if _is_seen(context, source) != (SHOWN_BEFORE in graph):
            continue
        if SHOWN_BEFORE in graph:
            show(context, source)
        else:
            hide(context, source)


def hide(context: bpy.types.Context, source: bpy.types.Object) -> None:
    """Hide the graph of a model that is hidden, and remember whether it was seen."""
    graph = graph_objects.find(source)
    if graph is not None and SHOWN_BEFORE not in graph:
        transaction.keep_keys(graph, SHOWN_BEFORE)
        graph[SHOWN_BEFORE] = int(graph_objects.is_shown(context, source))
        graph_objects.set_hidden(context, source, True)


def show(context: bpy.types.Context, source: bpy.types.Object) -> None:
    """Show the graph of a model that is shown again, if it was seen before and the scene shows graphs."""
    graph = graph_objects.find(source)
    if graph is not None and SHOWN_BEFORE in graph:
        transaction.keep_keys(graph, SHOWN_BEFORE)
        if graph.pop(SHOWN_BEFORE) and context.scene.reeb_parts.graph:
            graph_objects.set_hidden(context, source, False)


def _graphs() -> Iterator[tuple[bpy.types.Collection, bpy.types.Object]]:
    """The graphs that can be written, each with its model."""
    return ((graph, source) for graph in bpy.data.collections
            if graph.library is None and (source := graph.get(graph_objects.SOURCE)) is not None)


def _is_seen(context: bpy.types.Context, source: bpy.types.Object) -> bool:
    return source.visible_get(view_layer=context.view_layer)
