# SPDX-License-Identifier: GPL-3.0-or-later
"""What a part is like, in numbers: its size, its shape and its place in the Reeb graph, nearly the same in every pose.

Lengths are in units of the square root of the area of the model, or of the part where the name says so, so that the
scale of a model is of no account. What stands on a ground, such as a floor, is described as if that were not there.
``distances`` compares parts of any models.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from ..arrays.indexing import underflow_is_zero
from ..arrays.int64 import arange
from ..arrays.pairs import both_ways
from ..arrays.vectors import middles_of_each, second_moments_of_each
from ..errors import MeshError, ParameterError, wrong_kind
from ..graph.critical import MAXIMUM
from ..mesh.arguments import numbers
from ..mesh.copies import find_copies
from ..mesh.grounds import are_ground, grounds_among
from ..mesh.polygons import PolygonMesh
from ..mesh.triangles import TriMesh
from ..result.parts import Parts
from ..sentence import Sentence
from ..surface.ordering import sorted_by_place
from ..surface.orientation import without_copies
from ..surface.preparation import repair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

QUANTILES = (0.1, 0.5, 0.9)
N_POINTS = 48  # points of a part between which distances in space are measured
LEAST = 1e-3  # lengths, in units of the part's size, below which differences are of no account

NAMES = (
    "log_share", "field_10", "field_50", "field_90", "depth_50", "depth_90", "depth_100", "log_radius_10",
    "log_radius_50", "log_radius_90", "log_length", "log_width", "log_height", "apart_50", "apart_90",
    "cut_length", "n_neighbors", "n_leaves", "n_arcs", "neighbor_share", "neighbor_field", "hops", "has_twin",
)
"""Columns of a descriptor.

``share`` of the area of what is no ground; quantiles of the ``field``, of the ``depth``, the geodesic distance from the
cuts, of the ``radius`` of the contours of the graph, and of the distances ``apart`` of points of the part in space; its
``length``, ``width`` and ``height`` along its principal axes; the length of its cuts, as all lengths in units of its
size, the root of its area; parts that it touches; tips and arcs of the graph in it; share and field of what it touches,
weighted by the length of the cuts; how many cuts lie between it and the largest; whether it has a mirror image. A
ground touches nothing here.
"""

# Typical differences of each column between parts of one kind: the root of half the mean square over parts of one
# category that people cut alike, on half of the Princeton Segmentation Benchmark.
SCALE = np.array([
    0.27, 0.11, 0.12, 0.15, 0.13, 0.25, 0.28, 0.39,
    0.28, 0.36, 0.17, 0.21, 0.21, 0.05, 0.13,
    0.74, 0.23, 0.21, 0.30, 0.12, 0.09, 0.23, 0.28,
])


@dataclass(frozen=True, eq=False)
class _Surface:
    """The repaired surface with the parts on it.

    Attributes
    ----------
    mesh : TriMesh
        m faces, n vertices; lengths in units of the square root of the area of what is no ground.
    label : (m,) int64
        Part of each face.
    field : (n,) float64
        Normalized average geodesic distance.
    area : (count,) float64
        Area of each part as ``Parts.area``, but without faces that lie on others with the same corners.
    unit : float
        Length that is 1 in ``mesh``, in the unit of the caller's vertices.
    is_ground : (count,) bool
        Which parts are grounds.
    """

    mesh: TriMesh
    label: np.ndarray
    field: np.ndarray
    area: np.ndarray
    unit: float
    is_ground: np.ndarray

    @classmethod
    def of(cls, vertices: ArrayLike, faces: ArrayLike | Sequence[Sequence[int]], polygon: ArrayLike | None,
           parts: Parts) -> _Surface:
        """The surface of a mesh as ``decompose`` takes it, in an order that does not depend on the caller's."""
        if not isinstance(parts, Parts):
            raise wrong_kind("parts", "the parts of a result", parts)
        given, result = PolygonMesh.of(vertices, faces, polygon), parts.decomposition
        label, field, area = parts.labels, result.field, parts.area
        if (given.n_polygons, given.triangles.n_vertices) != (len(label), len(field)):
            raise MeshError(Sentence("The parts are of another mesh: give the one that was decomposed."))
        copies = find_copies(given)
        # By hand a face can be in one part and its copy in another.
        if copies and (label == label[copies.polygon][copies.original]).all():
            before = _areas(given, label, parts.count)
            given, label, field = without_copies(given, copies), label[copies.polygon], field[copies.vertex]
            area = area * _areas(given, label, parts.count) / np.maximum(before, 1e-300)
        is_ground = are_ground(given)
        given, ordering = sorted_by_place(given)
        working = repair(given)
        standing = working.mesh.face_area @ ~is_ground[ordering.polygon][working.polygon]
        return cls(TriMesh(working.mesh.vertices / np.sqrt(standing), working.mesh.faces),
                   label[ordering.polygon][working.polygon],
                   np.nan_to_num(field[ordering.vertex][working.vertex_source]), area,
                   float(np.sqrt(area.sum() * (standing / working.mesh.area))), grounds_among(label, is_ground))

    @property
    def count(self) -> int:
        """Number of parts."""
        return len(self.area)

    @property
    def share(self) -> np.ndarray:
        """Area of each part as a share of that of what is no ground, (count,)."""
        return self.area / self.unit**2

    @property
    def size(self) -> np.ndarray:
        """Root of the share of each part, (count,)."""
        return np.sqrt(np.maximum(self.share, 1e-12))

    def between_standing(self, parts: Parts) -> np.ndarray:
        """Which cuts lie between parts that are no grounds, (e,) bool."""
        return ~self.is_ground[parts.cuts].any(axis=1)

    def mean_field(self) -> np.ndarray:
        """Field of each face, (m,)."""
        return self.field[self.mesh.faces].mean(axis=1)

    def depth(self) -> np.ndarray:
        """Geodesic distance of each face from the cuts along its own part, (m,); 0 in a part without cuts."""
        pairs, length = self.mesh.edges.pairs, self.mesh.pair_distance
        low, high = self.label[pairs].T
        inside = low == high
        border = np.unique(pairs[~inside])
        if not len(border):
            return np.zeros(self.mesh.n_faces)
        graph = coo_array((np.maximum(length[inside], 1e-12), pairs[inside].T), (self.mesh.n_faces,) * 2).tocsr()
        depth = dijkstra(graph, directed=False, indices=border, min_only=True)
        return np.where(np.isfinite(depth), depth, 0.0)

    def quantiles(self, values: np.ndarray, shares: tuple[float, ...]) -> np.ndarray:
        """Quantiles of values of faces, (m,), over the area of each part, (count, len(shares))."""
        return _quantiles(values, self.mesh.face_area, self.label, self.count, shares)


def _areas(mesh: PolygonMesh, label: np.ndarray, count: int) -> np.ndarray:
    """Area of the polygons with each label, (count,); label : (n_polygons,) int64."""
    return np.bincount(label[mesh.polygon], mesh.triangles.face_area, count)


def _quantiles(values: np.ndarray, weight: np.ndarray, group: np.ndarray, count: int,
               shares: tuple[float, ...]) -> np.ndarray:
    """Weighted quantiles of the values of each group, (count, len(shares)); 0 for a group of none."""
    found = np.zeros((count, len(shares)))
    order = np.lexsort((values, group))
    start = np.searchsorted(group[order], arange(count + 1))
    for index in range(count):
        own = order[start[index]:start[index + 1]]
        if len(own):
            total = np.cumsum(weight[own])
            place = np.searchsorted(total, np.array(shares) * total[-1] * (1 - 1e-9))
            found[index] = values[own][place.clip(max=len(own) - 1)]
    return found


@underflow_is_zero
def part_descriptors(
    vertices: ArrayLike, faces: ArrayLike | Sequence[Sequence[int]], parts: Parts, polygon: ArrayLike | None = None
) -> np.ndarray:
    """Describe each part.

    Parameters
    ----------
    vertices, faces
        The mesh that was decomposed, as ``decompose`` takes it.
    parts : Parts
    polygon
        As ``decompose`` took it.

    Returns
    -------
    descriptors : (count, len(NAMES)) float64
        In the order of NAMES.

    Raises
    ------
    MeshError
        As ``decompose`` raises it, or the mesh has other numbers of faces or vertices than the one that was decomposed.
    ParameterError
        ``parts`` are none.

    Notes
    -----
    One search for shortest paths from all cuts at a time; O(m log m).
    """
    surface = _Surface.of(vertices, faces, polygon, parts)
    size = surface.size
    columns = {
        "log_share": np.log(size) * 2,
        "has_twin": ((parts.twin >= 0) & (parts.twin != arange(parts.count))).astype(float),
        "n_leaves": np.log1p(np.bincount(parts.node_part[parts.decomposition.graph.node_kind == MAXIMUM],
                                         minlength=parts.count)),
        "n_arcs": np.log1p(np.bincount(parts.arc_part, minlength=parts.count)),
        "hops": np.log1p(_hops(surface, parts)),
        **_neighborhood(surface, parts), **_shape(surface),
    }
    field = surface.quantiles(surface.mean_field(), QUANTILES)
    depth = surface.quantiles(surface.depth(), (0.5, 0.9, 1.0)) / size[:, None]
    radius = np.log(_radii(surface, parts))
    for place, quantile in enumerate((10, 50, 90)):
        columns |= {f"field_{quantile}": field[:, place], f"log_radius_{quantile}": radius[:, place]}
    columns |= {"depth_50": depth[:, 0], "depth_90": depth[:, 1], "depth_100": depth[:, 2]}
    return np.column_stack([columns[name] for name in NAMES])


def _hops(surface: _Surface, parts: Parts) -> np.ndarray:
    """How many cuts lie between each part and the largest one, (count,); the number of parts where there is no way.

    Grounds do not count, and are 0 cuts from themselves.
    """
    cuts, ground = parts.cuts[surface.between_standing(parts)], surface.is_ground
    graph = coo_array((np.ones(len(cuts)), cuts.T), (parts.count,) * 2).tocsr()
    start = np.append(np.flatnonzero(ground), np.where(ground, -1.0, surface.area).argmax())
    hops = dijkstra(graph, directed=False, unweighted=True, indices=start, min_only=True)
    return np.where(np.isfinite(hops), hops, (~ground).sum())


def _neighborhood(surface: _Surface, parts: Parts) -> dict[str, np.ndarray]:
    """How a part touches others, and what these are like."""
    between = surface.between_standing(parts)
    owner, other = both_ways(parts.cuts[between]).T
    weight = np.maximum(np.tile(parts.cut_length[between], 2), 1e-9 * surface.unit)
    field = surface.quantiles(surface.mean_field(), (0.5,))[:, 0]
    around = np.stack([surface.share, field], axis=1)[other]
    length, mean = middles_of_each(owner, around, weight, parts.count)
    return {"cut_length": length / surface.unit / surface.size,
            "n_neighbors": np.log1p(np.bincount(owner, minlength=parts.count)),
            "neighbor_share": mean[:, 0], "neighbor_field": mean[:, 1]}


def _radii(surface: _Surface, parts: Parts) -> np.ndarray:
    """Quantiles of the radius of the contours in each part, (count, 3), in units of its size.

    A part without a contour counts as a ball of its area.
    """
    radius, size = parts.decomposition.graph.point_radius / surface.unit, surface.size
    found = _quantiles(radius, np.ones(len(radius)), parts.point_part, parts.count, QUANTILES)
    found = np.where(found > 0, found, (size / np.sqrt(4 * np.pi))[:, None])
    return np.maximum(found / size[:, None], LEAST)


def _shape(surface: _Surface) -> dict[str, np.ndarray]:
    """Extent of each part along its principal axes, and distances between points of it, in units of its size."""
    mesh, label, count, size = surface.mesh, surface.label, surface.count, surface.size
    area = mesh.face_area
    total, middle = middles_of_each(label, mesh.face_centroids, area, count)
    offset = mesh.face_centroids - middle[label]
    moment = second_moments_of_each(label, offset, area, count)
    spread = np.linalg.eigvalsh(moment / np.maximum(total, 1e-300)[:, None, None])[:, ::-1]
    spread = np.log(np.maximum(np.sqrt(np.maximum(spread, 0.0)) / size[:, None], LEAST))
    apart = _apart(surface) / size[:, None]
    return {"log_length": spread[:, 0], "log_width": spread[:, 1], "log_height": spread[:, 2],
            "apart_50": apart[:, 0], "apart_90": apart[:, 1]}


def _apart(surface: _Surface) -> np.ndarray:
    """Median and 0.9 quantile of the distances in space between points spread over each part, (count, 2)."""
    mesh, label = surface.mesh, surface.label
    order = np.lexsort((surface.mean_field(), label))
    total = np.cumsum(mesh.face_area[order])
    end = np.cumsum(np.bincount(label, mesh.face_area, surface.count))
    begin = np.concatenate([[0.0], end[:-1]])
    step = (arange(N_POINTS) + 0.5) / N_POINTS
    place = begin[:, None] + step[None] * (end - begin)[:, None]
    point = mesh.face_centroids[order[np.searchsorted(total, place).clip(max=len(order) - 1)]]  # (count, N_POINTS, 3)
    first, second = np.triu_indices(N_POINTS, 1)
    return np.quantile(np.linalg.norm(point[:, first] - point[:, second], axis=2), QUANTILES[1:], axis=1).T


def distances(one: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Measure how different parts are.

    Parameters
    ----------
    one : (len(NAMES),) float64
        Descriptor of a part.
    others : (k, len(NAMES)) float64
        Descriptors of others.

    Returns
    -------
    distance : (k,) float64
        0 for the same part; about 1 between parts of one kind on different models, 2 and more between others.

    Raises
    ------
    ParameterError
        One of them has another shape, or values that are no numbers; ``error.name`` says which.
    """
    difference = _described("others", others, 2) - _described("one", one, 1)
    return (np.abs(difference) / SCALE).mean(axis=1)


def _described(name: str, values: np.ndarray, n_axes: int) -> np.ndarray:
    """An argument as descriptors, an array of so many axes; raises ParameterError if it is none."""
    found = numbers(values)
    if found is None or found.ndim != n_axes or found.shape[-1] != len(NAMES):
        raise ParameterError(Sentence("{name} must have {n} numbers for each part, as descriptors do.", name=name,
                                      n=len(NAMES)), name)
    return found
