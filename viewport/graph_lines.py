# SPDX-License-Identifier: GPL-3.0-or-later
"""The arcs of a graph as lines to draw and to point at."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core.arrays.components import components
from ..core.result.decomposition import Decomposition
from ..core.uses.graph_folding import arc_segments, unfolded, without_scraps
from ..scene import bridge
from ..scene.graph import arc_curves
from ..scene.store import Stored


@dataclass(frozen=True, eq=False)
class GraphLines:
    """Every arc as a chain of points, from its lower node to its upper node.

    With m points and s segments:

    Attributes
    ----------
    position : (m, 3) float64
        In the coordinates of the mesh.
    value : (m,) float64
        Of the field.
    candidate : (m,) int64
        The candidate part that the point lies in.
    segments : (s, 2) int64
        Points that follow each other.
    n_nodes : int
        How many of the points are nodes, the first ones.
    """

    position: np.ndarray
    value: np.ndarray
    candidate: np.ndarray
    segments: np.ndarray
    n_nodes: int

    @classmethod
    def of(cls, decomposition: Decomposition, stretch: np.ndarray, arcs: np.ndarray | None = None) -> GraphLines:
        """Lines of a decomposition's graph.

        stretch : (3, 3), of the mesh when it was decomposed. arcs : (q,) bool, those that there are lines of; None for
        all.
        """
        graph = decomposition.graph
        position = arc_curves.places(graph, bridge.unstretch(stretch).T)
        value = np.concatenate([graph.node_value, graph.point_value])
        candidate = np.concatenate([decomposition.node_candidate, decomposition.point_candidate])
        found = arc_segments(graph, np.ones(graph.n_arcs, bool) if arcs is None else arcs)
        return cls(position, value, candidate, found, graph.n_nodes)

    @classmethod
    def shown(cls, stored: Stored, stretch: np.ndarray) -> GraphLines:
        """Lines of the arcs that the parts shown now need; stretch as of ``of``."""
        parts = stored.shown_parts().parts
        graph = stored.decomposition.graph
        return cls.of(stored.decomposition, stretch, unfolded(graph, parts.node_part, parts.point_part)[1])

    def without(self, numbers: np.ndarray, hidden: list[int]) -> GraphLines:
        """These lines but for those in hidden parts, or to them. numbers : (c,), the part of each candidate."""
        part = numbers[self.candidate]
        seen = without_scraps(self.segments, part, ~np.isin(part, hidden), self.n_nodes)
        return replace(self, segments=self.segments[seen[self.segments].all(axis=1)])


def nearest(points: np.ndarray, segments: np.ndarray, target: np.ndarray) -> tuple[int, float, float]:
    """The segment nearest to a point, in the plane or in space.

    Parameters
    ----------
    points : (m, d) float64
        nan for those that cannot be seen.
    segments : (s, 2) int64
    target : (d,) float64

    Returns
    -------
    segment : int
        -1 if none can be seen.
    share : float
        How far along it, 0..1.
    distance : float
    """
    share, distance = _approach(points, segments, target)
    if not len(distance) or np.isinf(distance).all():
        return -1, 0.0, np.inf
    best = int(distance.argmin())
    return best, float(share[best]), float(distance[best])


def frontmost(points: np.ndarray, segments: np.ndarray, target: np.ndarray, alike: float) -> tuple[int, float, float]:
    """The segment nearest to a place of a view; where lines cover each other there, of the one in front.

    A symmetric model has its left arcs straight behind the right ones when it is seen from the side.

    Parameters
    ----------
    points : (m, 3) float64
        Two coordinates in the view, and how deep; nan for those that cannot be seen.
    segments : (s, 2) int64
    target : (2,) float64
    alike : float
        Lines whose distances from the target differ by less cover each other.

    Returns
    -------
    segment, share, distance
        As of ``nearest``, in the view.
    """
    share, distance = _approach(points[:, :2], segments, target)
    if not len(distance) or np.isinf(distance).all():
        return -1, 0.0, np.inf
    tied = np.flatnonzero(distance < distance.min() + alike)
    ends = segments[tied]
    depth = points[ends[:, 0], 2] * (1.0 - share[tied]) + points[ends[:, 1], 2] * share[tied]
    # Of its own line the nearest place, not the one that is most in front.
    _, line = components(len(points), ends[:, 0], ends[:, 1])
    own = tied[line[ends[:, 0]] == line[ends[depth.argmin(), 0]]]
    best = int(own[distance[own].argmin()])
    return best, float(share[best]), float(distance[best])


def _approach(points: np.ndarray, segments: np.ndarray, target: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How far along each segment the place nearest to a point is, and how far away; inf where it cannot be seen."""
    start, end = points[segments[:, 0]], points[segments[:, 1]]
    way = end - start
    square = np.maximum((way**2).sum(axis=1), np.finfo(float).tiny)
    share = np.clip(((np.asarray(target) - start) * way).sum(axis=1) / square, 0.0, 1.0)
    distance = np.linalg.norm(start + share[:, None] * way - target, axis=1)
    distance[np.isnan(distance)] = np.inf
    return share, distance
