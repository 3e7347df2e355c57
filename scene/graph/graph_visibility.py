# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph is hidden when its model is, and comes back with it; whoever shows it meanwhile sees it alone.

What was done is kept with the graph, not in memory: undo leads to the moment when the model was hidden or shown already
and its graph had yet to follow. In a viewport that shows its model alone, a graph that is shown comes along
once, and leaves with the model; whoever takes it out of there does not see it again until it is hidden and shown.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from .. import transaction
from ..ours.made_objects import ROLE
from ..redraw import viewports_of
from ..showing.selection import in_layer
from . import graph_finding, graph_objects
from .graph_finding import ARCS, NODE, SHOWN_BEFORE

_along: set[tuple[int, int]] = set()  # viewports, by address, and objects of graphs, by session_uid, that came along


def forget() -> None:
    """Free what is kept in memory: after undo, graphs may be left out of local views again."""
    _along.clear()


def is_due(context: bpy.types.Context) -> bool:
    """Whether a model with a graph was hidden, shown or shown alone since its graph followed."""
    return (any(_is_seen(context, source) == (SHOWN_BEFORE in graph) for graph, source in _graphs())
            or _in_local_views(context).keys() != _along)


def follow(context: bpy.types.Context) -> None:
    """Hide the graphs of models that were hidden, show again those of models that are back, also in local views."""
    for graph, source in _graphs():
        if _is_seen(context, source) != (SHOWN_BEFORE in graph):
            continue
        if SHOWN_BEFORE in graph:
            show(context, source)
        else:
            hide(context, source)
    wanted = _in_local_views(context)
    for key in wanted.keys() - _along:
        space, item = wanted[key]
        item.local_view_set(space, True)
    _leave(context, _along - wanted.keys())
    _along.clear()
    _along.update(wanted)


def _leave(context: bpy.types.Context, gone: set[tuple[int, int]]) -> None:
    """Take objects of graphs that came along out of local views that their models have left; by keys of ``_along``."""
    for layer, space in _local_views(context) if gone else ():
        for _, source in _graphs():
            if in_layer(layer, source) and source.local_view_get(space):
                continue
            for item in source.children:
                if (space.as_pointer(), item.session_uid) in gone and in_layer(layer, item):
                    item.local_view_set(space, False)


def hide(context: bpy.types.Context, source: bpy.types.Object) -> None:
    """Hide the graph of a model that is hidden, and remember whether it was seen."""
    graph = graph_finding.find(source)
    if graph is not None and SHOWN_BEFORE not in graph:
        transaction.keep_keys(graph, SHOWN_BEFORE)
        graph[SHOWN_BEFORE] = int(graph_objects.is_shown(context, source))
        graph_objects.set_hidden(context, source, True, _view_layers(context, source, False))


def show(context: bpy.types.Context, source: bpy.types.Object) -> None:
    """Show the graph of a model that is shown again, if it was seen before and the scene shows graphs."""
    graph = graph_finding.find(source)
    if graph is not None and SHOWN_BEFORE in graph:
        transaction.keep_keys(graph, SHOWN_BEFORE)
        if graph.pop(SHOWN_BEFORE) and context.scene.reeb_parts.graph:
            graph_objects.set_hidden(context, source, False, _view_layers(context, source, True))


def _view_layers(context: bpy.types.Context, source: bpy.types.Object, seen: bool) -> list[bpy.types.ViewLayer]:
    """That of the context, and the others of the scene in which a model is seen, or those in which it is not."""
    return [layer for layer in context.scene.view_layers
            if layer == context.view_layer or source.visible_get(view_layer=layer) == seen]


def _in_local_views(context: bpy.types.Context
                    ) -> dict[tuple[int, int], tuple[bpy.types.SpaceView3D, bpy.types.Object]]:
    """The objects of graphs that are shown whose models are in the local view of a viewport; by keys of ``_along``."""
    found = {}
    for layer, space in _local_views(context):
        for _, source in _graphs():
            if not (in_layer(layer, source) and source.local_view_get(space)
                    and graph_objects.is_shown(context, source)):
                continue
            for item in source.children:
                if item.get(ROLE) in (NODE, ARCS) and in_layer(layer, item):
                    found[space.as_pointer(), item.session_uid] = space, item
    return found


def _local_views(context: bpy.types.Context) -> Iterator[tuple[bpy.types.ViewLayer, bpy.types.SpaceView3D]]:
    """The viewports that show some objects alone, with their view layers."""
    for window in context.window_manager.windows:
        for area in viewports_of(window):
            if area.spaces.active.local_view:
                yield window.view_layer, area.spaces.active


def _graphs() -> Iterator[tuple[bpy.types.Collection, bpy.types.Object]]:
    """The graphs that can be written, each with its model."""
    return ((graph, source) for graph in bpy.data.collections
            if graph.library is None and (source := graph_finding.source_of(graph)) is not None)


def _is_seen(context: bpy.types.Context, source: bpy.types.Object) -> bool:
    return source.visible_get(view_layer=context.view_layer)
