# SPDX-License-Identifier: GPL-3.0-or-later
"""The graph in the colors of its parts, drawn over the empties and curves that it consists of.

Blender draws empties and their kinds in one color. The marks here say which part a node is in and what
kind it is: a disc for a minimum, a square for a saddle, a triangle for a maximum. Nothing is written anywhere;
what is hidden, or was taken away, is not drawn.
"""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.arrays.int64 import arange
from ..scene import store
from ..scene.graph import graph_finding, graph_follow, graph_objects
from ..scene.ours.made_objects import ROLE
from ..scene.result import part_names
from ..scene.showing import selection
from .clipping import is_clipped
from .graph_lines import GraphLines
from .lines import Lines

SIZE = 6.0  # radius of a mark in pixels, of a screen without scaling
RIM, LIT = 1.35, 1.9  # of the dark rim, and of the bright one around it of a mark that is chosen, in radii
WIDTH = 4.0  # of the lines, too
COVER = 1.25  # radius of a mark that covers the empty behind it, in sizes of the empty
_DARK, _LIGHT = (0.05, 0.05, 0.05, 1.0), (0.9, 0.9, 0.9, 1.0)  # of the rim, around light and dark marks

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722, 0.0])

_lines: dict[int, tuple] = {}  # of each graph, with what they were built of


def _corners(count: int, start: float) -> np.ndarray:
    angle = start + 2 * np.pi * arange(count) / count
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


# Outlines around the middle, of about the same area.
SHAPES = {
    "minimum": _corners(20, 0.0),
    "saddle": 1.2 * _corners(4, 0.25 * np.pi),
    "maximum": 1.4 * _corners(3, 0.5 * np.pi),
}


def forget() -> None:
    """Free what is kept in memory."""
    _lines.clear()


def marks(places: np.ndarray, kinds: list[str], colors: np.ndarray, axes: np.ndarray, radii: np.ndarray,
          chosen: Sequence[bool] = ()) -> tuple[np.ndarray, np.ndarray]:
    """Triangles of the marks of some nodes, each with its rim behind it; chosen ones have a bright one around that.

    Parameters
    ----------
    places : (k, 3) float64
    kinds : list of str
    colors : (k, 4) float64
    axes : (2, 3) float64
        Which way is right and up in the view.
    radii : (k,) float64
    chosen : (k,) of bool, or none

    Returns
    -------
    points : (3 t, 3) float32
    point_colors : (3 t, 4) float32
    """
    points, shades = [], []
    for place, kind, color, radius, lit in zip(
            places, kinds, colors, radii, chosen or [False] * len(places), strict=True):
        outline = SHAPES[kind] @ axes * radius
        rim_color = _DARK if color @ _LUMINANCE > 0.3 else _LIGHT
        rims = ((LIT, _LIGHT), (RIM, _DARK)) if lit else ((RIM, rim_color),)
        for size, shade in (*rims, (1.0, color)):
            rim = place + size * outline
            fan = np.stack([np.broadcast_to(place, rim.shape), rim, np.roll(rim, -1, axis=0)], axis=1)
            points.append(fan.reshape(-1, 3))
            shades.append(np.broadcast_to(shade, (3 * len(rim), 4)))
    # The card reads them row by row, which concatenated broadcasts need not be in memory.
    return _by_rows(points), _by_rows(shades)


def _by_rows(blocks: list[np.ndarray]) -> np.ndarray:
    """Blocks, (k, n), below each other, (m, n) float32, row by row in memory."""
    return np.ascontiguousarray(np.concatenate(blocks), np.float32)


def draw() -> None:
    """Draw all graphs in the viewport that Blender is drawing."""
    context = bpy.context
    if not context.space_data.overlay.show_overlays:
        return
    seen = set()
    for source, items in seen_graphs(context.view_layer).items():
        seen.add(source.session_uid)
        _draw_graph(context, source, items)
    for gone in set(_lines) - seen:
        del _lines[gone]


def seen_graphs(layer: bpy.types.ViewLayer) -> dict[bpy.types.Object, list[bpy.types.Object]]:
    """The objects of each graph that are seen, by model: those of its collection, and those moved to another one."""
    found = {source: list(collection.objects) for collection in bpy.data.collections
             if (source := graph_finding.source_of(collection)) is not None}
    for item in layer.objects:
        if ROLE in item and item[ROLE] in graph_finding.ROLES and item.parent is not None:  # get() takes far longer
            found.setdefault(item.parent, []).append(item)
    found = {source: [item for item in dict.fromkeys(items) if item.name in layer.objects and item.visible_get()]
             for source, items in found.items() if source.type == "MESH" and store.has_result(source.data)}
    return {source: items for source, items in found.items() if items}


def _draw_graph(context: bpy.types.Context, source: bpy.types.Object, items: list[bpy.types.Object]) -> None:
    gpu.state.depth_test_set("NONE" if items[0].show_in_front else "LESS_EQUAL")
    gpu.state.blend_set("ALPHA")
    if any(item.get(ROLE) == graph_finding.ARCS for item in items):
        _draw_arcs(source, items)
    nodes = [item for item in items if graph_finding.is_node(item) and not graph_objects.is_folded(item)]
    if nodes:
        _draw_nodes(context, source, nodes)
    gpu.state.blend_set("NONE")
    gpu.state.depth_test_set("NONE")


def _draw_arcs(source: bpy.types.Object, items: list[bpy.types.Object]) -> None:
    key, places = state(source, items), graph_follow.places(source)[1]
    if _lines.get(source.session_uid, (None,))[0] != key:
        _lines[source.session_uid] = key, Lines.of(colored_arcs, source.data, places)
    lines = _lines[source.session_uid][1]
    if lines is not None:
        lines.draw(source.matrix_world, WIDTH)


def state(source: bpy.types.Object, items: list[bpy.types.Object]) -> tuple[object, ...]:
    """What changes when the arcs of a model have to be colored anew. items : the objects of its graph that are seen."""
    result = source.data.reeb_parts
    folded = [graph_objects.is_folded(item) for item in items]  # other ones, when parts are hidden
    return (source.data.is_editmode, result.edited, store.state_of(source.data),
            [part.color[:] for part in result.parts], graph_follow.places(source)[0], folded)


def colored_arcs(mesh: bpy.types.Mesh, places: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    """The arcs of a graph as lines in the colors of their parts, but for parts that are hidden.

    places : where its nodes and points are seen, if not where they are; as of graph_follow.

    Returns
    -------
    points : (2 k, 3) float32
        Both ends of each line, in the coordinates of the mesh.
    point_colors : (2 k, 4) float32

    Raises
    ------
    SceneError
        The parts are out of date. In Edit Mode, what is edited there does not count yet.
    """
    if mesh.is_editmode and not store.is_edited(mesh):
        stored = store.last(mesh)
    else:
        stored = store.load(mesh)
    lines = GraphLines.shown(stored, store.stretch_of(mesh))
    lines = lines.without(stored.shown, selection.hidden_parts(mesh, stored.face_numbers))
    position = places if places is not None and len(places) == len(lines.position) else lines.position
    colors = part_names.number_colors(mesh)[stored.shown[lines.candidate]]
    ends = lines.segments
    middle = position[ends].mean(axis=1)
    # Each half of a segment is in the part that its end is in.
    points = np.stack([position[ends[:, 0]], middle, middle, position[ends[:, 1]]], axis=1)
    shades = np.repeat(colors[ends], 2, axis=1)
    return points.reshape(-1, 3).astype(np.float32), shades.reshape(-1, 4).astype(np.float32)


def _draw_nodes(context: bpy.types.Context, source: bpy.types.Object, nodes: list[bpy.types.Object]) -> None:
    region, view = context.region, context.region_data
    places = np.array([node.matrix_world.translation for node in nodes])
    clipped = is_clipped(view, places, Matrix.Identity(4))
    nodes = [node for node, outside in zip(nodes, clipped, strict=True) if not outside]
    if not nodes:
        return
    matrix = np.array(view.view_matrix, np.float64)
    # Far ones first: also in front of the model, nearer ones are drawn over them.
    nodes = sorted(nodes, key=lambda node: view.view_matrix[2].xyz.dot(node.matrix_world.translation))
    places = np.array([node.matrix_world.translation for node in nodes])
    shown = part_names.number_colors(source.data)
    colors = shown[np.clip([node["part"] for node in nodes], 0, len(shown) - 1)]
    whole = np.array(view.perspective_matrix, np.float64)
    depth = np.concatenate([places, np.ones((len(places), 1))], axis=1) @ whole[3]
    # A pixel is so large where each node is.
    pixel = 2.0 * np.abs(depth) / (region.width * abs(view.window_matrix[0][0]))
    # Over what Blender draws of the empties themselves, so that each is seen once.
    own = np.array([node.empty_display_size * max(node.matrix_world.to_scale()) for node in nodes])
    radii = np.maximum(SIZE * context.preferences.system.ui_scale * pixel, COVER * own)
    points, shades = marks(places, [node["kind"] for node in nodes], colors, matrix[:2, :3], radii,
                           [node.select_get() for node in nodes])
    shader = gpu.shader.from_builtin("FLAT_COLOR")
    batch_for_shader(shader, "TRIS", {"pos": points, "color": shades}).draw(shader)
