# SPDX-License-Identifier: GPL-3.0-or-later
"""The Reeb graph as objects: an empty for each node and one curve for the arcs, in a collection of ours.

The objects are children of the decomposed one and live in its coordinates, so that moving and scaling it
carries them along.
"""

from __future__ import annotations

from collections.abc import Container, Iterable
from functools import partial
from itertools import chain
from typing import Any

import bpy
import numpy as np

from ...core.arrays.vectors import box_diagonal
from ...core.graph.critical import KINDS
from ...core.graph.reeb import ReebGraph
from ...core.result.numbering import NumberedParts
from ...core.uses.colors import linear
from ...core.uses.graph_folding import arc_segments, unfolded, without_scraps
from .. import bridge, store, transaction
from ..ours import made_objects
from ..ours.made_objects import ROLE
from ..result import part_names
from ..showing import visibility
from ..showing.selection import hidden_parts, in_layer
from . import arc_curves, graph_finding, graph_removal

_GRAPH_OF = "Reeb Graph "  # how its name begins
_DISPLAY = {"minimum": "SPHERE", "saddle": "CUBE", "maximum": "CONE"}
_WORDS = {"minimum": "middle", "saddle": "joint", "maximum": "tip"}  # behind the name of the part
_STRETCHES = "stretches"  # on the curve: what its splines are, see ``arc_curves.seen_stretches``
FOLDED = "folded"  # on a node: the parts that are shown do not need it
_SIZE, _NOTHING = "reeb_parts_size", 1e-4  # its size when it is not folded, and when it is
_LOCKS = ("lock_location", "lock_rotation", "lock_scale")


def set_hidden(context: bpy.types.Context, obj: bpy.types.Object, hidden: bool,
               layers: Iterable[bpy.types.ViewLayer] = ()) -> bool:
    """Hide the graph of an object, or show it again; whether it has a collection.

    layers : in which view layers of the scene; in that of the context without.
    """
    layers = [*layers] or [context.view_layer]
    for view_layer in layers:
        for item in _elsewhere_in_layer(view_layer, obj):
            transaction.on_failure(partial(item.hide_set, item.hide_get(view_layer=view_layer), view_layer=view_layer))
            item.hide_set(hidden, view_layer=view_layer)
    collection = graph_finding.find(obj)
    if collection is None:
        return False
    if not hidden:
        visibility.include(context, collection)
    for layer in chain.from_iterable(visibility.layers_of(view_layer, collection) for view_layer in layers):
        transaction.keep(layer, "hide_viewport")
        layer.hide_viewport = hidden
    return True


def is_shown(context: bpy.types.Context, obj: bpy.types.Object) -> bool:
    """Whether an object has a graph that is not hidden in the view layer, nor left out of it."""
    return (any(not (layer.hide_viewport or layer.exclude or layer.collection.hide_viewport)
                for layer in visibility.layers_of(context.view_layer, graph_finding.find(obj)))
            or any(item.visible_get() for item in _elsewhere_in_layer(context.view_layer, obj)))


def _elsewhere_in_layer(view_layer: bpy.types.ViewLayer, obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Those objects of ``graph_finding.elsewhere`` that a view layer has."""
    return [item for item in graph_finding.elsewhere(obj) if in_layer(view_layer, item)]


def draw_graph(context: bpy.types.Context, obj: bpy.types.Object, numbered: NumberedParts, style: Any) -> int:
    """Draw the graph of parts that are stored with an object's mesh, in place of an earlier one.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    numbered : NumberedParts
        The graph is that of their decomposition.
    style
        Has the values of properties.OverlayProperties.

    Returns
    -------
    kept : int
        Earlier nodes that were left alone, since other objects need them.
    """
    graph = numbered.parts.decomposition.graph
    numbers = numbered.numbers[numbered.parts.node_part].tolist()
    kinds = [KINDS[kind] for kind in graph.node_kind.tolist()]
    coming = [*map(graph_finding.name_of_node, numbers, kinds), graph_finding.ARCS]
    back = bridge.unstretch(store.stretch_of(obj.data)).T
    before = graph_finding.arcs(obj)
    name = before.data.name if before is not None else arc_curves.NAME
    curve = arc_curves.curve(graph, back, arc_curves.whole(graph, range(graph.n_arcs)), before and before.data)
    earlier = graph_removal.remove_earlier(obj, coming)
    curve.name = name
    collection = _make_collection(context, obj)
    nodes = graph.node_position @ back
    for index, position in enumerate(nodes.tolist()):
        kind = kinds[index]
        empty = bpy.data.objects.new(f"Reeb {kind}", None)
        empty.empty_display_type = _DISPLAY[kind]
        empty.location = position
        empty["kind"], empty["value"], empty["part"] = kind, float(graph.node_value[index]), numbers[index]
        empty["node"], empty[FOLDED] = index, False
        _place(empty, graph_finding.NODE, obj, collection)
    _place(bpy.data.objects.new(arc_curves.NAME, curve), graph_finding.ARCS, obj, collection)
    restyle(obj, style)
    made_objects.hand_on(
        earlier.gone, [(graph_finding.stands_for(item), item) for item in graph_finding.inside(collection)])
    update_parts(obj, numbered)
    graph_finding.know(obj)
    return earlier.kept


def _make_collection(context: bpy.types.Context, obj: bpy.types.Object) -> bpy.types.Collection:
    """The collection for a new graph of an object: that of the one before, where the user has it, or a new one."""
    collection, name = graph_finding.find(obj), _GRAPH_OF + obj.name
    if collection is None:
        collection = bpy.data.collections.new(name)
        collection[graph_finding.SOURCE] = obj
        collection.hide_render = True
    elif collection.name.startswith(_GRAPH_OF) and part_names.without_number(collection.name) != name:
        transaction.keep(collection, "name")
        collection.name = name  # the object was renamed
    visibility.include(context, collection)
    return collection


def _place(item: bpy.types.Object, role: str, obj: bpy.types.Object, collection: bpy.types.Collection) -> None:
    item[ROLE] = role
    item.parent = obj
    item.hide_render = True
    for lock in _LOCKS:  # selected with all else and moved, it stays where the graph has it
        setattr(item, lock, (True, True, True))
    collection.objects.link(item)


def _drawn(item: bpy.types.Object, graph: ReebGraph) -> np.ndarray:
    """The stretches that the curve of a graph consists of, (s, 3) int64."""
    if _STRETCHES in item:
        kept = np.array(list(item[_STRETCHES]), np.int64).reshape(-1, 3)
        return kept[kept[:, 0] < graph.n_arcs]
    # An earlier version has told the arcs.
    return arc_curves.whole(graph, [arc for arc in item.get("arcs", range(graph.n_arcs)) if arc < graph.n_arcs])


def shift(obj: bpy.types.Object, graph: ReebGraph, back: np.ndarray, seen: np.ndarray) -> bool:
    """Show the graph of an object elsewhere than it is; whether anything has changed.

    back : as of ``arc_curves.places``, where the graph is. seen : (k + r, 3) float64, where it is to be seen.
    """
    nodes, item = list(graph_finding.nodes(obj)), graph_finding.arcs(obj)
    if not _are_of(nodes, graph.n_nodes):
        return False
    offset = (seen - arc_curves.places(graph, back)).astype(np.float32)
    moved = [node for node in nodes if node.delta_location[:] != tuple(offset[node["node"]].tolist())]
    for node in moved:
        node.delta_location = offset[node["node"]]
    if item is not None and (moved or not nodes):
        for spline, line in zip(item.data.splines, arc_curves.lines(graph, seen, _drawn(item, graph)), strict=False):
            if len(spline.points) == len(line):
                spline.points.foreach_set("co", line.ravel())
        item.data.update_tag()
    return bool(moved)


def put_back(obj: bpy.types.Object, graph: ReebGraph, back: np.ndarray, scale: float) -> None:
    """Put the graph of an object where it is in the mesh, which was moved: Blender keeps children where they are.

    back : as of ``arc_curves.places``. scale : how much larger the mesh has become.
    """
    nodes, item, points = list(graph_finding.nodes(obj)), graph_finding.arcs(obj), arc_curves.places(graph, back)
    if not _are_of(nodes, graph.n_nodes):
        return
    for node in nodes:
        _unmove(node)
        node.location = points[node["node"]]
        _set_size(node, scale * _size(node))
    if item is not None:
        _unmove(item)
        _draw_curve(item, graph, back, _drawn(item, graph))


def _are_of(nodes: Iterable[bpy.types.Object], count: int) -> bool:
    """Whether all of some empties stand for nodes of a graph that has so many, be it another graph than theirs."""
    return all(0 <= node["node"] < count for node in nodes)


def _unmove(item: bpy.types.Object) -> None:
    """Let an object be where its parent is."""
    transaction.keep(item, "location", "rotation_euler", "scale")
    transaction.on_failure(setattr, item, "matrix_parent_inverse", item.matrix_parent_inverse.copy())
    item.location, item.rotation_euler, item.scale = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
    item.matrix_parent_inverse.identity()


def update_parts(obj: bpy.types.Object, numbered: NumberedParts) -> None:
    """Tell the nodes which part they are in now, and show those that the parts need, but for those of hidden parts.

    A graph of another result, as of a mesh that was replaced, goes.
    """
    nodes = list(graph_finding.nodes(obj))
    if not nodes:
        return
    parts = numbered.parts
    numbers = numbered.numbers[parts.node_part].tolist()
    if not _are_of(nodes, len(numbers)):
        graph_removal.remove(obj)
        return
    graph = parts.decomposition.graph
    shown, arcs_shown = unfolded(graph, parts.node_part, parts.point_part)
    hidden = hidden_parts(obj.data, numbered.numbers[parts.labels])
    part = numbered.numbers[np.concatenate([parts.node_part, parts.point_part])]
    seen = without_scraps(arc_segments(graph, arcs_shown), part, ~np.isin(part, hidden), graph.n_nodes)
    shown &= seen[: graph.n_nodes]
    colors = part_names.number_colors(obj.data)
    for node in nodes:
        transaction.keep_keys(node, "part")
        transaction.keep(node, "color")
        node["part"] = numbers[node["node"]]
        node.color = (*linear(colors[node["part"], :3]), 1.0)
        _fold(node, not shown[node["node"]])
    _show_arcs(obj, graph, arc_curves.seen_stretches(graph, np.flatnonzero(arcs_shown).tolist(), seen))
    update_names(obj)


def _fold(node: bpy.types.Object, folded: bool) -> None:
    """Make a node next to nothing, which no click meets, or what it was before.

    Hidden it is not: Blender computes no place in the world of what is hidden, which scripts ask for.
    """
    if is_folded(node) == folded:
        return
    transaction.keep_keys(node, FOLDED, _SIZE)
    transaction.keep(node, "empty_display_size", "hide_select")
    if folded:
        node[_SIZE] = node.empty_display_size
        node.empty_display_size = _NOTHING
    else:
        node.empty_display_size = _size(node)
    node[FOLDED] = node.hide_select = folded


def is_folded(node: bpy.types.Object) -> bool:
    """Whether a node of a graph is not needed by the parts that are shown."""
    return bool(node.get(FOLDED, False))


def _show_arcs(obj: bpy.types.Object, graph: ReebGraph, stretches: np.ndarray) -> None:
    """Let the curve have some stretches of the arcs, (s, 3) int64: see ``arc_curves.seen_stretches``."""
    item = graph_finding.arcs(obj)
    if item is None or np.array_equal(_drawn(item, graph), stretches):
        return
    transaction.keep_keys(item, _STRETCHES)
    item[_STRETCHES] = stretches.ravel().tolist()
    _draw_curve(item, graph, bridge.unstretch(store.stretch_of(obj.data)).T, stretches)


def _draw_curve(item: bpy.types.Object, graph: ReebGraph, back: np.ndarray, stretches: np.ndarray) -> None:
    """Draw the curve of a graph anew. back, stretches : as of ``arc_curves.curve``."""
    transaction.keep(item, "data")
    before = item.data
    name = before.name
    curve = arc_curves.curve(graph, back, stretches, before)
    item.data = curve
    if before.users == 0:
        transaction.discard(before)
        curve.name = name


def update_names(obj: bpy.types.Object) -> None:
    """Name each node by its part and its kind: "head tip"."""
    nodes = list(graph_finding.nodes(obj))
    names = {part.number: part.name for part in obj.data.reeb_parts.parts}
    wanted = [f"{names.get(node['part'], '')} {_WORDS.get(node['kind'], node['kind'])}".strip() for node in nodes]
    changed = [(node, name) for node, name in zip(nodes, wanted, strict=True)
               if part_names.without_number(node.name) != name]
    for node, _ in changed:
        transaction.keep(node, "name")
        node.name = "Reeb node"  # no name is in the way of another one
    for node, name in changed:
        node.name = name


def restyle(obj: bpy.types.Object | None, style: Any) -> None:
    """Draw an object's graph, if it has one, in another size or thickness."""
    if obj is None:
        return
    corners = np.array([corner[:] for corner in obj.bound_box])
    size = style.node_size * box_diagonal(corners)
    for item in graph_finding.originals(graph_finding.wherever(obj)):
        transaction.keep(item, "show_in_front")
        item.show_in_front = style.in_front
        if item[ROLE] == graph_finding.NODE:
            _set_size(item, size)
        else:
            transaction.keep(item.data, "bevel_depth")
            item.data.bevel_depth = style.line_thickness


def _size(node: bpy.types.Object) -> float:
    """How large a node is when it is not folded."""
    size = node.get(_SIZE) if is_folded(node) else None
    return size if isinstance(size, float) else node.empty_display_size


def _set_size(node: bpy.types.Object, size: float) -> None:
    """Let a node be so large, if it is folded once it is so no more."""
    if is_folded(node):
        transaction.keep_keys(node, _SIZE)
        node[_SIZE] = size
    else:
        transaction.keep(node, "empty_display_size")
        node.empty_display_size = size


def select_nodes(obj: bpy.types.Object, numbers: Container[int]) -> None:
    """Select the nodes of some parts that are shown, and no other node."""
    for node in graph_finding.nodes(obj):
        node.select_set(node["part"] in numbers and not is_folded(node))
