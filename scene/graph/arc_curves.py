# SPDX-License-Identifier: GPL-3.0-or-later
"""The arcs of a graph as splines of a curve: those that are shown, as far as they are seen."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import bpy
import numpy as np

from ...core.arrays.int64 import arange
from ...core.graph.reeb import ReebGraph

NAME = "Reeb arcs"


def curve(graph: ReebGraph, back: np.ndarray, stretches: np.ndarray,
          like: bpy.types.Curve | None = None) -> bpy.types.Curve:
    """A new curve with a poly spline for each stretch of an arc.

    back : (3, 3) float64, takes the graph's positions to the mesh's. stretches : (s, 3) int64, see ``seen_stretches``.
    like : one from which all else is, such as materials and how round it is.
    """
    made = bpy.data.curves.new(NAME, "CURVE") if like is None else like.copy()
    made.splines.clear()
    made.dimensions = "3D"
    scale = float(np.cbrt(abs(np.linalg.det(back)))) or 1.0
    drawn = lines(graph, places(graph, back), stretches)
    for line, (arc, first, last) in zip(drawn, stretches.tolist(), strict=True):
        radius = graph.point_radius[graph.arc_points[arc] : graph.arc_points[arc + 1]] * scale
        if len(radius):
            radius = np.concatenate([radius[:1], radius, radius[-1:]])[first : last + 1]
        spline = made.splines.new("POLY")
        spline.points.add(len(line) - 1)
        spline.points.foreach_set("co", line.ravel())
        spline.points.foreach_set("radius", radius.astype(np.float32) if len(radius) else np.zeros(2, np.float32))
    return made


def places(graph: ReebGraph, back: np.ndarray) -> np.ndarray:
    """Positions of the nodes, then of the center points, (k + r, 3) float64. back : (3, 3), from the graph's space."""
    return np.concatenate([graph.node_position, graph.point_position]) @ back


def _chain(graph: ReebGraph, arc: int) -> np.ndarray:
    """An arc from its lower node through its center points to its upper node: rows of ``places``, (m,) int64."""
    low, high = graph.arcs[arc]
    inner = graph.n_nodes + arange(graph.arc_points[arc], graph.arc_points[arc + 1])
    return np.concatenate([[low], inner, [high]])


def lines(graph: ReebGraph, points: np.ndarray, stretches: np.ndarray) -> Iterator[np.ndarray]:
    """The points of each stretch of an arc in Blender's four coordinates; points : as of ``places``."""
    for arc, first, last in stretches.tolist():
        line = points[_chain(graph, arc)[first : last + 1]]
        yield np.concatenate([line, np.ones((len(line), 1))], axis=1).astype(np.float32)


def whole(graph: ReebGraph, arcs: Iterable[int]) -> np.ndarray:
    """Some arcs as stretches from end to end, (s, 3) int64."""
    counts = np.diff(graph.arc_points)
    return np.array([(arc, 0, counts[arc] + 1) for arc in arcs], np.int64).reshape(-1, 3)


def seen_stretches(graph: ReebGraph, arcs: Iterable[int], seen: np.ndarray) -> np.ndarray:
    """The stretches of some arcs that are seen: as far as the overlay draws them, to the last point that is.

    Parameters
    ----------
    graph : ReebGraph
    arcs : of int
    seen : (k + r,) bool
        Whether each node and each center point is seen.

    Returns
    -------
    stretches : (s, 3) int64
        The arc, and the first and the last of its points, see ``_chain``.
    """
    found = []
    for arc in arcs:
        chain = seen[_chain(graph, arc)]
        drawn = np.concatenate([[False], chain[:-1] & chain[1:], [False]])
        found += [(arc, first, last) for first, last in np.flatnonzero(drawn[1:] != drawn[:-1]).reshape(-1, 2)]
    return np.array(found, np.int64).reshape(-1, 3)
