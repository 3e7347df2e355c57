# SPDX-License-Identifier: GPL-3.0-or-later
"""The Reeb graph as objects: an empty for each node and one curve for the arcs, in a collection of ours.

The objects are children of the decomposed one and live in its coordinates, so that moving and scaling it
carries them along. They are recognised by custom properties, never by name.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from typing import Any

import bpy
import numpy as np

from ..core.graph.reeb import ReebGraph
from ..core.result.numbering import NumberedParts
from . import bridge, part_names, store, transaction
from .outputs.colors import linear
from .temporary import remove_object

SOURCE = "reeb_parts_source"  # on the collection: the decomposed object
ROLE = "reeb_parts_role"  # on our objects: "node" or "arcs"
KINDS = ("minimum", "saddle", "maximum")
_DISPLAY = {"minimum": "SPHERE", "saddle": "CUBE", "maximum": "CONE"}


def find(obj: bpy.types.Object) -> bpy.types.Collection | None:
    """The graph's collection of an object, or None."""
    return next((collection for collection in bpy.data.collections if collection.get(SOURCE) == obj), None)


def arcs(obj: bpy.types.Object) -> bpy.types.Object | None:
    """The curve with the arcs of an object's graph, or None."""
    return next(_items(obj, "arcs"), None)


def _items(obj: bpy.types.Object, role: str) -> Iterator[bpy.types.Object]:
    """The objects of an object's graph that have a role, "node" or "arcs"; none if there is no graph."""
    collection = find(obj)
    return (item for item in (collection.objects if collection else ()) if item.get(ROLE) == role)


def set_hidden(context: bpy.types.Context, obj: bpy.types.Object, hidden: bool) -> bool:
    """Hide the graph of an object in the view layer, or show it again; whether there is one."""
    collection = find(obj)
    if collection is None:
        return False
    waiting = [context.view_layer.layer_collection]
    while waiting:
        layer = waiting.pop()
        if layer.collection == collection:
            transaction.keep(layer, "hide_viewport")
            layer.hide_viewport = hidden
        waiting.extend(layer.children)
    return True


def draw_graph(context: bpy.types.Context, obj: bpy.types.Object, graph: ReebGraph, stretch: np.ndarray,
               style: Any) -> None:
    """Draw a graph in place of an earlier one.

    Parameters
    ----------
    context : bpy.types.Context
    obj : bpy.types.Object
    graph : ReebGraph
    stretch : (3, 3) float64
        What took the mesh's coordinates to the graph's; undone here.
    style
        Has the values of settings.OverlayProperties.
    """
    remove(obj)
    back = bridge.unstretch(stretch).T
    collection = bpy.data.collections.new(f"Reeb Graph {obj.name}")
    collection[SOURCE] = obj
    collection.hide_render = True
    context.scene.collection.children.link(collection)
    nodes = graph.node_position @ back
    for index, position in enumerate(nodes.tolist()):
        kind = KINDS[graph.node_kind[index]]
        empty = bpy.data.objects.new(f"Reeb {kind}", None)
        empty.empty_display_type = _DISPLAY[kind]
        empty.location = position
        empty["kind"], empty["value"], empty["part"] = kind, float(graph.node_value[index]), 0
        empty["node"] = index
        _place(empty, "node", obj, collection)
    scale = float(np.cbrt(abs(np.linalg.det(back)))) or 1.0
    curve = _curve(graph, graph.point_position @ back, graph.point_radius * scale, nodes)
    _place(bpy.data.objects.new("Reeb arcs", curve), "arcs", obj, collection)
    restyle(obj, style)


def _place(item: bpy.types.Object, role: str, obj: bpy.types.Object, collection: bpy.types.Collection) -> None:
    item[ROLE] = role
    item.parent = obj
    item.hide_render = True
    collection.objects.link(item)


def _curve(graph: ReebGraph, points: np.ndarray, radii: np.ndarray, nodes: np.ndarray) -> bpy.types.Curve:
    """A poly spline for each arc, from its lower node through its centre points to its upper node."""
    curve = bpy.data.curves.new("Reeb arcs", "CURVE")
    curve.dimensions = "3D"
    for arc, (low, high) in enumerate(graph.arcs.tolist()):
        inner = slice(graph.arc_points[arc], graph.arc_points[arc + 1])
        line = np.ones((len(points[inner]) + 2, 4), np.float32)
        line[:, :3] = np.concatenate([nodes[low : low + 1], points[inner], nodes[high : high + 1]])
        radius = radii[inner] if len(points[inner]) else np.zeros(1)
        spline = curve.splines.new("POLY")
        spline.points.add(len(line) - 1)
        spline.points.foreach_set("co", line.ravel())
        ends = np.concatenate([radius[:1], radius, radius[-1:]]).astype(np.float32)
        spline.points.foreach_set("radius", ends if len(ends) == len(line) else np.zeros(len(line), np.float32))
    return curve


def update_parts(obj: bpy.types.Object, numbered: NumberedParts) -> None:
    """Tell the nodes which part they are in now; a graph of another result, as of a mesh that was replaced, goes."""
    numbers = numbered.numbers[numbered.parts.node_part].tolist()
    colors = part_names.number_colors(obj.data)
    nodes = list(_items(obj, "node"))
    if not all(0 <= node.get("node", -1) < len(numbers) for node in nodes):
        remove(obj)
        return
    for node in nodes:
        transaction.keep_keys(node, "part")
        transaction.keep(node, "color")
        node["part"] = numbers[node["node"]]
        node.color = (*linear(colors[node["part"], :3].tolist()), 1.0)


def restyle(obj: bpy.types.Object | None, style: Any) -> None:
    """Draw an object's graph in another size or thickness."""
    collection = find(obj) if obj is not None else None
    if obj is None or collection is None:
        return
    corners = np.array([corner[:] for corner in obj.bound_box])
    size = style.node_size * float(np.linalg.norm(np.ptp(corners, axis=0)))
    for item in collection.objects:
        transaction.keep(item, "empty_display_size", "show_in_front")
        if item.get(ROLE) == "node":
            item.empty_display_size = size
            item.show_in_front = style.in_front
        elif item.get(ROLE) == "arcs":
            transaction.keep(item.data, "bevel_depth")
            item.data.bevel_depth = style.line_thickness
            item.show_in_front = style.in_front


def remove(obj: bpy.types.Object) -> None:
    """Remove the graph of an object, and those of objects that are gone."""
    for collection in list(bpy.data.collections):
        if SOURCE not in collection or collection[SOURCE] not in (obj, None):
            continue
        ours = [item for item in collection.objects if ROLE in item]
        theirs = [item for item in collection.all_objects if item not in ours]
        for item in ours:
            remove_object(item)
        transaction.keep_keys(collection, SOURCE)
        del collection[SOURCE]
        if not theirs and not len(collection.children):  # else it is the user's now, who put something in it
            transaction.discard(collection)


def part_of(item: bpy.types.Object | None) -> tuple[bpy.types.Object, int] | None:
    """The decomposed object and the part's number that an object of a graph stands for, or None."""
    if item is None or item.get(ROLE) != "node" or not store.has_parts(item.parent):
        return None
    return item.parent, item["part"]


def source_of_arcs(item: bpy.types.Object | None) -> bpy.types.Object | None:
    """The decomposed object that a curve of arcs stands for, or None."""
    if item is None or item.get(ROLE) != "arcs" or not store.has_parts(item.parent):
        return None
    return item.parent


def select_nodes(obj: bpy.types.Object, numbers: Container[int]) -> None:
    """Select the nodes of some parts, and no other node."""
    for node in _items(obj, "node"):
        node.select_set(node["part"] in numbers)
