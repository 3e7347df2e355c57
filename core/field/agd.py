# SPDX-License-Identifier: GPL-3.0-or-later
"""Average geodesic distance: low on the body, high at the tips of protrusions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import frozen
from ..arrays.ties import TIE, first_largest
from ..arrays.vectors import weighted_sum
from ..mesh.triangles import TriMesh
from ..surface.coarsening import Pyramid, prolong
from .geodesic import GeodesicSolver

HISTOGRAM_BINS = 100  # number of bins of ``equalize``: each 0.01 wide, as in [Berretti2009]
# Largest number of vertices on which paths are searched. At this number, nearly five edges lie on the radius of a
# base vertex's disc, and the field is smooth at that scale.
FIELD_VERTICES = 5_000
# There are at most so many times as many base vertices as the area asks for: of 93 ordinary meshes none has 1.15, but
# the discs of a ribbon a thousand times as long as wide cover little each, and there would be thousands of them.
MOST_BASE_VERTICES = 2.0
# Range of the AGD, as a share of its maximum, below which its variation is the error of the distances.
FLAT_FIELD = 0.03


@dataclass(frozen=True, eq=False)
class BaseVertices:
    """Vertices spread evenly over the surface, each of which stands for the area nearest to it.

    Attributes
    ----------
    indices : (k,) int64
        Base vertices.
    areas : (k,) float64
        Area that each base vertex stands for, in squared units of the vertices; the sum is the area of the surface.
    distances : (k, n) float64
        Geodesic distance from each base vertex to every vertex, in the unit of the vertices.
    """

    indices: np.ndarray
    areas: np.ndarray
    distances: np.ndarray


@dataclass(frozen=True, eq=False)
class ScalarField:
    """A field on a surface: one value per vertex, before and after it is normalized and equalized.

    Attributes
    ----------
    values : (n,) float64
        The field whose level sets are taken, 0..1: ``normalized``, equalized by eq. (7) if the parameters say so.
    normalized : (n,) float64
        The AGD mapped to 0..1, eq. (3).
    agd : (n,) float64
        The average geodesic distance, eq. (2), in the unit of the vertices.
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
    """Choose base vertices by farthest-point sampling until every vertex is within a radius of one, or there are many.

    After [Hilaga2001]. The radius of [Berretti2009] is sqrt(0.005 S), S the area of the surface.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, one connected component.
    solver : GeodesicSolver
        Made of ``mesh``.
    vertex_area : (n,) float64
        Area that each vertex stands for, in squared units of the vertices.
    radius : float
        In the unit of the vertices, above 0.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    base : BaseVertices

    Raises
    ------
    DisconnectedMeshError
        The mesh has more than one component; ``error.vertices`` lists vertices that cannot be reached.

    Notes
    -----
    One search per base vertex: O(k n log n) time, 8 k n bytes. The first base vertex is the vertex farthest from
    the centroid, so that the choice depends on the shape and not on the order of the vertices.
    """
    centroid = weighted_sum(vertex_area, mesh.vertices) / vertex_area.sum()
    chosen = [first_largest(np.linalg.norm(mesh.vertices - centroid, axis=1))]
    rows = []
    nearest = np.full(mesh.n_vertices, np.inf)
    owner = np.zeros(mesh.n_vertices, np.int64)
    expected = vertex_area.sum() / (1.5 * radius**2)  # number of base vertices; the 1.5 is measured
    most = MOST_BASE_VERTICES * expected
    while True:
        row = solver.distances(chosen[-1])
        rows.append(row)
        closer = row < (1 - TIE) * nearest  # of equally near base vertices the first, despite rounding
        nearest[closer] = row[closer]
        owner[closer] = len(chosen) - 1
        if progress:
            progress(min(len(chosen) / expected, 1.0))
        farthest = first_largest(nearest)
        if nearest[farthest] <= radius or len(chosen) >= most:
            break
        chosen.append(farthest)
    areas = np.bincount(owner, vertex_area, len(chosen))
    return BaseVertices(frozen(chosen, np.int64), frozen(areas, np.float64), np.stack(rows))


def average_geodesic_distance(base: BaseVertices) -> np.ndarray:
    """Average the geodesic distance from every vertex over the surface (AGD).

    Eq. (2) of docs/method.md, after [Hilaga2001]: the surface integral of the distance, summed over the base vertices
    and divided by the area.

    Parameters
    ----------
    base : BaseVertices
        With distances to n vertices.

    Returns
    -------
    agd : (n,) float64
        In the unit of the vertices; scales with the mesh. Not normalized.
    """
    return weighted_sum(base.areas, base.distances) / base.areas.sum()


def normalize(values: np.ndarray) -> np.ndarray:
    """Map values linearly to 0..1, eq. (3).

    Parameters
    ----------
    values : (n,) float64
        At least one, none negative.

    Returns
    -------
    normalized : (n,) float64
        0 everywhere if the values differ by less than a millionth of the largest: such differences are rounding
        errors.
    """
    low, high = values.min(), values.max()
    if not high - low > 1e-6 * abs(high):
        return np.zeros_like(values)
    return (values - low) / (high - low)


def equalize(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Replace each value by the share of the area that lies at or below it, eq. (7).

    The share is read from a histogram of HISTOGRAM_BINS bins, linearly within each bin.

    Parameters
    ----------
    values : (n,) float64
        0..1, as ``normalize`` gives them.
    weights : (n,) float64
        Area of each vertex, in any unit. [Berretti2009] counts vertices instead, which favors densely meshed places.

    Returns
    -------
    equalized : (n,) float64
        Strictly monotone in ``values``, 0 at value 0 and 1 at value 1; 0 everywhere if all values are 0.
    """
    counts, edges = np.histogram(values, bins=HISTOGRAM_BINS, range=(0.0, 1.0), weights=weights)
    # An empty bin gets a millionth of the area, so that values within it keep their order.
    counts = counts + 1e-6 * weights.sum()
    cumulative = np.concatenate([[0.0], np.cumsum(counts)])
    return np.interp(values, edges, cumulative / cumulative[-1])


def coarse_agd(
    pyramid: Pyramid, radius: float, progress: Callable[[float], None] | None = None
) -> np.ndarray:
    """Compute the AGD of a mesh, from paths on a coarse copy if the mesh is dense.

    Parameters
    ----------
    pyramid : Pyramid
        Made of the mesh, n vertices.
    radius : float
        Radius of the discs that base vertices stand for, in the unit of the vertices, above 0.
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    agd : (n,) float64
        In the unit of the vertices.

    Raises
    ------
    DisconnectedMeshError
        The mesh has more than one component.

    Notes
    -----
    Paths are searched on at most FIELD_VERTICES vertices; the other work is O(n).
    """
    steps = pyramid.until(lambda mesh: mesh.n_vertices <= FIELD_VERTICES)
    coarsest, area, links = pyramid.after(steps)
    base = spread_base_vertices(coarsest, GeodesicSolver(coarsest, links), area, radius, progress)
    agd = average_geodesic_distance(base)
    for k in reversed(range(len(steps))):
        agd = prolong(pyramid.after(steps[:k])[0], steps[k], agd)
    return agd


def agd_field(mesh: TriMesh, agd: np.ndarray, equalized: bool) -> ScalarField:
    """Normalize an AGD, eq. (3), and equalize it, eq. (7), if asked to.

    Parameters
    ----------
    mesh : TriMesh
        n vertices.
    agd : (n,) float64
        Eq. (2), in the unit of the vertices.
    equalized : bool
        Whether level sets are taken of the equalized field.

    Returns
    -------
    field : ScalarField
    """
    normalized = normalize(agd)
    values = equalize(normalized, mesh.vertex_area) if equalized else normalized
    return ScalarField(*(frozen(a, np.float64) for a in (values, normalized, agd)))


def protrusion_field(
    pyramid: Pyramid, base_spacing: float, equalized: bool, progress: Callable[[float], None] | None = None
) -> ScalarField:
    """Compute the field of a component: low on its body, high where it protrudes.

    Parameters
    ----------
    pyramid : Pyramid
        Made of the component's mesh, n vertices.
    base_spacing : float
        Squared radius of a base vertex's disc over the area of the surface; 0.005 in [Berretti2009].
    equalized : bool
        Whether the field is equalized, so that ranges of values of one width cover one area, eq. (7).
    progress : callable, optional
        Called with the share done, 0..1.

    Returns
    -------
    field : ScalarField
        ``values`` and ``normalized`` are 0 everywhere if nothing protrudes: if the AGD varies by less than FLAT_FIELD
        of its maximum.

    Raises
    ------
    DisconnectedMeshError
        The mesh has more than one component.
    """
    mesh = pyramid.mesh
    field = agd_field(mesh, coarse_agd(pyramid, np.sqrt(base_spacing * mesh.area), progress), equalized)
    if np.ptp(field.agd) < FLAT_FIELD * field.agd.max():
        nothing = np.zeros(mesh.n_vertices)
        return ScalarField(nothing, nothing, field.agd)
    return field
