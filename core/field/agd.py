# SPDX-License-Identifier: GPL-3.0-or-later
"""Average geodesic distance: low on the body, high at the tips of protrusions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..surface.arrays import first_largest, frozen
from ..surface.coarsening import Pyramid, prolong
from ..surface.mesh import TriMesh
from .geodesic import GeodesicSolver

HISTOGRAM_BINS = 100  # the paper's bin width of 0.01
# Paths are searched on at most so many vertices: five or more lie on the radius of a base
# vertex's disc then, and the field is smooth at that scale.
FIELD_VERTICES = 20_000
# Below this share of its maximum, the variation of the AGD is the error of the distances.
FLAT_FIELD = 0.03


@dataclass(frozen=True, eq=False)
class BaseVertices:
    """Vertices spread evenly over the surface, each standing for the area nearest to it.

    Attributes
    ----------
    indices : (k,) int64
    areas : (k,) float64
        They sum to the area of the surface.
    distances : (k, n) float32
        From each base vertex to every vertex; found while spreading them.
    """

    indices: np.ndarray
    areas: np.ndarray
    distances: np.ndarray


@dataclass(frozen=True, eq=False)
class ScalarField:
    """One value per vertex.

    Attributes
    ----------
    values : (n,) float64
        What level sets are taken of: normalized, and equalized where asked for, 0..1.
    normalized : (n,) float64
        Eq. (3): the AGD mapped to 0..1, before equalization.
    agd : (n,) float64
        Eq. (2), in the unit of the vertices.
    """

    values: np.ndarray
    normalized: np.ndarray
    agd: np.ndarray


def spread_base_vertices(
    mesh: TriMesh,
    solver: GeodesicSolver,
    vertex_area: np.ndarray,
    radius: float,
    progress: Callable[[float], None] | None = None,
) -> BaseVertices:
    """Farthest-point sampling until every vertex is within ``radius`` of a base vertex.

    After [Hilaga2001]; the paper separates base vertices by 2 sqrt(0.005 S), S the area.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, one connected component.
    solver : GeodesicSolver
        Of that mesh.
    vertex_area : (n,) float64
    radius : float
        In the unit of the vertices, above 0.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    base : BaseVertices

    Notes
    -----
    One search per base vertex: O(k n log n) time, 4 k n bytes. Starts at the vertex farthest
    from the centroid, so the choice depends on the shape, not on the order of the vertices.
    """
    centroid = vertex_area @ mesh.vertices / vertex_area.sum()
    chosen = [first_largest(np.linalg.norm(mesh.vertices - centroid, axis=1))]
    rows = []
    nearest = np.full(mesh.n_vertices, np.inf)
    owner = np.zeros(mesh.n_vertices, np.int64)
    expected = vertex_area.sum() / (1.5 * radius**2)  # measured: discs of this radius overlap about so
    while True:
        row = solver.distances(chosen[-1])
        rows.append(row.astype(np.float32))
        closer = row < (1 - 1e-9) * nearest  # of equals the first, whatever the last bit says
        nearest[closer] = row[closer]
        owner[closer] = len(chosen) - 1
        if progress:
            progress(min(len(chosen) / expected, 1.0))
        farthest = first_largest(nearest)
        if nearest[farthest] <= radius:
            break
        chosen.append(farthest)
    areas = np.bincount(owner, vertex_area, len(chosen))
    return BaseVertices(frozen(chosen, np.int64), frozen(areas, np.float64), np.stack(rows))


def average_geodesic_distance(base: BaseVertices) -> np.ndarray:
    """Mean geodesic distance from every vertex to the surface (AGD).

    Eq. (2) of docs/method.md, after [Hilaga2001]: the surface integral of the distance, summed
    over the base vertices and divided by the area.

    Returns
    -------
    agd : (n,) float64
        In the unit of the vertices; scales with the mesh. Not normalized.
    """
    agd = np.zeros(base.distances.shape[1])
    for area, row in zip(base.areas, base.distances, strict=True):
        agd += area * row  # a product with the whole matrix would copy it to float64
    return agd / base.areas.sum()


def normalize(values: np.ndarray) -> np.ndarray:
    """Map values to 0..1, eq. (3); 0 everywhere where they do not differ.

    Differences below a millionth of the largest value are rounding, not shape.
    """
    low, high = values.min(), values.max()
    if not high - low > 1e-6 * abs(high):
        return np.zeros_like(values)
    return (values - low) / (high - low)


def equalize(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Share of the area at or below each value, eq. (7), on a histogram of 100 bins.

    Parameters
    ----------
    values : (n,) float64
        Normalized, 0..1.
    weights : (n,) float64
        Area of each vertex; counting vertices, as the paper does, would favour dense regions.

    Returns
    -------
    equalized : (n,) float64
        Monotone in ``values``; 0 at their minimum and 1 at their maximum, or all 0.
    """
    if values.max() <= 0:
        return np.zeros_like(values)
    counts, edges = np.histogram(values, bins=HISTOGRAM_BINS, range=(0.0, 1.0), weights=weights)
    # An empty bin keeps a sliver of width: order within it must survive.
    counts = counts + 1e-6 * weights.sum()
    cumulative = np.concatenate([[0.0], np.cumsum(counts)]) / counts.sum()
    return np.interp(values, edges, cumulative)


def coarse_agd(
    pyramid: Pyramid, radius: float, progress: Callable[[float], None] | None = None
) -> np.ndarray:
    """AGD of a mesh, by paths on a coarse copy where the mesh is dense.

    Parameters
    ----------
    pyramid : Pyramid
        Of the mesh, n vertices.
    radius : float
        Of the discs that base vertices stand for, in the unit of the vertices.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    agd : (n,) float64
        In the unit of the vertices.

    Raises
    ------
    DisconnectedMeshError
        The mesh is more than one component.

    Notes
    -----
    Path searches run on at most FIELD_VERTICES vertices; the rest is O(n).
    """
    steps = pyramid.until(lambda mesh: mesh.n_vertices <= FIELD_VERTICES)
    meshes = [pyramid.mesh, *(step.mesh for step in steps)]
    coarsest, area, links = meshes[-1], pyramid.mesh.vertex_area, None
    if steps:
        area, links = steps[-1].area, steps[-1].links
    base = spread_base_vertices(coarsest, GeodesicSolver(coarsest, links), area, radius, progress)
    agd = average_geodesic_distance(base)
    for fine, step in zip(reversed(meshes[:-1]), reversed(steps), strict=True):
        agd = prolong(fine, step, agd)
    return agd


def agd_field(mesh: TriMesh, agd: np.ndarray, equalized: bool) -> ScalarField:
    """The field that level sets are taken of, eqs. (2), (3) and (7)."""
    normalized = normalize(agd)
    values = equalize(normalized, mesh.vertex_area) if equalized else normalized
    return ScalarField(*(frozen(a, np.float64) for a in (values, normalized, agd)))


def protrusion_field(
    pyramid: Pyramid, base_spacing: float, equalized: bool, progress: Callable[[float], None] | None = None
) -> ScalarField:
    """The field of a component: low on its body, high where it protrudes, 0 everywhere if nothing does.

    Parameters
    ----------
    pyramid : Pyramid
        Of the component's mesh.
    base_spacing : float
        Share of the area that the square of a base vertex's radius is (paper: 0.005).
    equalized : bool
        Whether every range of values gets the same area, eq. (7).
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    field : ScalarField

    Raises
    ------
    DisconnectedMeshError
        The mesh is more than one component.
    """
    mesh = pyramid.mesh
    field = agd_field(mesh, coarse_agd(pyramid, np.sqrt(base_spacing * mesh.area), progress), equalized)
    if np.ptp(field.agd) < FLAT_FIELD * field.agd.max():
        nothing = np.zeros(mesh.n_vertices)
        return ScalarField(nothing, nothing, field.agd)
    return field
