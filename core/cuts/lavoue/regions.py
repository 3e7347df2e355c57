# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of [Lavoue2005]: grown from connected vertices of one class, and merged by curvature and boundary."""

from __future__ import annotations

import heapq

import numpy as np

from ...arrays.indexing import sums_by
from ...arrays.int64 import full
from ...arrays.nearest_seeds import nearest_seeds
from ...arrays.pairs import symmetric_matrix
from ...arrays.ties import rounded, whole_steps
from ...mesh.face_graph import FaceGraph
from ...mesh.labels import borders
from ...mesh.triangles import TriMesh

# Share of the area below which a region is a sliver; what parts it from its neighbors counts by the weight only.
SLIVER_AREA, SLIVER_WEIGHT = 0.02, 0.1


def grow_regions(mesh: TriMesh, label: np.ndarray) -> np.ndarray:
    """Grow regions of faces from connected vertices of one class.

    A face whose corners have one class is a seed; every other face joins the nearest seed, along ways from centroid to
    centroid. A piece without a seed is a region of its own.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, m faces.
    label : (n,) int64
        Class of each vertex.

    Returns
    -------
    region : (m,) int64
        Region of each face, 0..c-1; every region is connected.
    """
    corners = label[mesh.faces]
    seed = (corners == corners[:, :1]).all(axis=1)
    graph = FaceGraph.of(mesh)
    core = graph.regions(np.where(seed, corners[:, 0], -1))[1]
    way = whole_steps(mesh.pair_distance / np.sqrt(mesh.area))
    source = full(mesh.n_faces, -1)
    if seed.any():
        ways = symmetric_matrix(mesh.edges.pairs, way, mesh.n_faces)
        source = nearest_seeds(ways, np.flatnonzero(seed))[1]
    return graph.regions(np.where(source >= 0, core[source], -1))[1]


class CurvatureGraph:
    """Regions and the borders between them while they merge.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, m faces.
    curvature : (n, 2) float64
        Curvatures of each vertex, in any unit.
    region : (m,) int64
        Region of each face, 0..c-1.
    """

    def __init__(self, mesh: TriMesh, curvature: np.ndarray, region: np.ndarray) -> None:
        count = int(region.max()) + 1
        area = mesh.face_area + 1e-12 * mesh.area / mesh.n_faces
        self.small = SLIVER_AREA * mesh.area
        self.area = np.bincount(region, area, count)
        self.sums = sums_by(region, area[:, None] * curvature[mesh.faces].mean(axis=1), count)
        between, touching, border = borders(region, mesh.edges.pairs)
        nothing = 1e-12 * np.sqrt(mesh.area)
        length = sums_by(border, mesh.pair_length[between], len(touching)) + nothing
        at = curvature[mesh.edges.vertices[mesh.edges.pair_edge[between]]].mean(axis=1)
        sums = sums_by(border, (mesh.pair_length[between] + nothing)[:, None] * at, len(touching))
        self.perimeter = np.bincount(touching.ravel(), np.repeat(length, 2), count)
        # For each region the length of the border with each neighbor, and the sum of the curvature along it.
        self.neighbors: list[dict[int, tuple[float, np.ndarray]]] = [{} for _ in range(count)]
        for (a, b), total, along in zip(touching.tolist(), length.tolist(), sums, strict=True):
            self.neighbors[a][b] = self.neighbors[b][a] = (total, along)

    def distance(self, a: int, b: int) -> float:
        """Distance of two neighbors: how far their curvatures are from that of their border, and how short this is."""
        length, along = self.neighbors[a][b]
        border = along / length
        apart = sum(float(np.linalg.norm(self.sums[r] / self.area[r] - border)) for r in (a, b))
        nesting = max(min(self.perimeter[a], self.perimeter[b]) / length, 1.0)
        distance = apart * nesting * (SLIVER_WEIGHT if min(self.area[a], self.area[b]) < self.small else 1.0)
        return float(rounded(np.array(distance), 26))  # rounding must not order equal distances

    def merge_(self, a: int, b: int) -> None:
        """Let region b become part of region a."""
        length, _ = self.neighbors[a].pop(b)
        del self.neighbors[b][a]
        self.area[a] += self.area[b]
        self.sums[a] += self.sums[b]
        self.perimeter[a] = max(self.perimeter[a] + self.perimeter[b] - 2 * length, 0.0)
        for other, (more, along) in self.neighbors[b].items():
            del self.neighbors[other][b]
            own, beside = self.neighbors[a].get(other, (0.0, 0.0))
            self.neighbors[a][other] = self.neighbors[other][a] = (own + more, beside + along)
        self.neighbors[b] = {}


def merge_regions(graph: CurvatureGraph) -> tuple[np.ndarray, np.ndarray]:
    """Merge the two nearest neighbors, again and again, until no two regions touch.

    Parameters
    ----------
    graph : CurvatureGraph
        It is changed.

    Returns
    -------
    merges : (s, 2) int64
        The region that stays and the region that becomes part of it, in order.
    distance : (s,) float64
        Their distance, in the unit of the curvatures.
    """
    heap = [(graph.distance(a, b), a, b) for a, around in enumerate(graph.neighbors) for b in around if a < b]
    heapq.heapify(heap)
    entries = {(a, b): distance for distance, a, b in heap}
    merges, distances = [], []
    while heap:
        distance, a, b = heapq.heappop(heap)
        if entries.get((a, b)) != distance:
            continue  # the two have merged into others, or one of them has changed
        keep, gone = (a, b) if (graph.area[a], -a) >= (graph.area[b], -b) else (b, a)
        around = set(graph.neighbors[a]) | set(graph.neighbors[b])
        for other in around:
            for region in (a, b):
                entries.pop((min(region, other), max(region, other)), None)
        graph.merge_(keep, gone)
        merges.append((keep, gone))
        distances.append(distance)
        for other in sorted(graph.neighbors[keep]):
            pair = (min(keep, other), max(keep, other))
            entries[pair] = graph.distance(*pair)
            heapq.heappush(heap, (entries[pair], *pair))
    return np.array(merges, np.int64).reshape(-1, 2), np.array(distances)
