# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature per vertex, across pairs of faces, and per face."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array, diags_array

from ..arrays.indexing import sums_by, taken
from ..arrays.pairs import symmetric_matrix
from ..arrays.vectors import cross, lengths, row_products, second_moments_of_each, unit
from ..mesh.triangles import TriMesh, corner_sides

SCALES = (0.01, 0.02, 0.04)  # widths over which normals are smoothed, in units of sqrt(area)
MAX_CURVATURE = 60.0  # bound of ``curvature_across``, in units of 1 / sqrt(area)
SOLVER_STEPS = 60  # upper bound of the number of conjugate gradient steps
# Upper bound of the conductance between two faces: the length of their edge over the way between their centroids
# across this edge, without unit. Two equilateral triangles have 1.7.
MAX_CONDUCTANCE = 20.0


def k_min(mesh: TriMesh) -> np.ndarray:
    """Estimate the smaller principal curvature at every vertex, negative in concavities.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, faces turned outwards.

    Returns
    -------
    k_min : (n,) float64
        In units of 1 / length of the vertices.
    """
    return principal_curvatures(mesh)[:, 0]


def principal_curvatures(mesh: TriMesh, smoothing_steps: int = 2) -> np.ndarray:
    """Estimate both principal curvatures at every vertex, negative in concavities.

    The curvature tensor of [CohenSteiner2003] is the sum of the dihedral angles along the edges around a vertex,
    divided by the vertex's area. Of its two eigenvalues tangent to the surface, each is the curvature in the
    direction perpendicular to its eigenvector. [Berretti2009] uses another estimator; one that needs no fit
    withstands long thin triangles better.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, faces turned outwards.
    smoothing_steps : int
        Number of rings of neighbors over which the tensor of a vertex is summed.

    Returns
    -------
    curvatures : (n, 2) float64
        The smaller and the larger one, in units of 1 / length of the vertices.

    Notes
    -----
    O(n + m), whole arrays.
    """
    start, end = taken(mesh.edges.vertices, mesh.edges.pair_edge).T
    edge = taken(mesh.vertices, end) - taken(mesh.vertices, start)
    length = np.linalg.norm(edge, axis=1)
    direction = np.divide(edge, length[:, None], out=np.zeros_like(edge), where=length[:, None] > 0)
    turn = 0.5 * mesh.dihedral * length
    at_start, at_end = (second_moments_of_each(at, direction, turn, mesh.n_vertices) for at in (start, end))
    sums = (at_start + at_end).reshape(-1, 9)
    normals = mesh.vertex_area_normals
    area = mesh.vertex_area.copy()
    a, b = mesh.edges.vertices.T
    for _ in range(smoothing_steps):
        sums, normals, area = (_plus_neighbors(x, a, b) for x in (sums, normals, area))
    safe = np.maximum(area, 1e-12 * mesh.area)
    return _tangent_eigenvalues(sums.reshape(-1, 3, 3) / safe[:, None, None], normals)


def _plus_neighbors(values: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Sum of each vertex's value and those of its neighbors. a, b : the ends of all edges, (e,) int64."""
    return values + sums_by(a, taken(values, b), len(values)) + sums_by(b, taken(values, a), len(values))


def _tangent_eigenvalues(tensor: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Eigenvalues, (n, 2), rising, of (n, 3, 3) symmetric tensors in the planes perpendicular to (n, 3) normals."""
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normal = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0)
    normal[length[:, 0] == 0] = (0.0, 0.0, 1.0)
    axis = np.eye(3)[np.abs(normal).argmin(axis=1)]
    u = np.cross(normal, axis)
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    v = np.cross(normal, u)
    uu, uv, vv = (np.einsum("ni,nij,nj->n", p, tensor, q) for p, q in ((u, u), (u, v), (v, v)))
    mean, radius = (uu + vv) / 2, np.hypot((uu - vv) / 2, uv)
    return np.stack([mean - radius, mean + radius], axis=1)


def curvature_across(mesh: TriMesh, scales: tuple[float, ...] = SCALES) -> np.ndarray:
    """Estimate the curvature across each pair of faces at several scales.

    The curvature is the change of the smoothed normal from one face to the other, in the direction between their
    centroids, divided by the distance of the centroids.

    Parameters
    ----------
    mesh : TriMesh
        p pairs of faces, faces turned outwards.
    scales : tuple of float
        Widths over which the normals are smoothed, in units of the square root of the area.

    Returns
    -------
    curvature : (len(scales), p) float64
        In units of 1 / square root of the area, at most MAX_CURVATURE in size; negative in concavities.
    """
    root = np.sqrt(mesh.area)
    a, b = mesh.edges.pairs.T
    way = taken(mesh.face_centroids, b) - taken(mesh.face_centroids, a)
    square = np.maximum(np.einsum("ij,ij->i", way, way), 1e-12 * mesh.area)
    exchange = _exchange(mesh)
    normal, curvature = mesh.face_normals, []
    for scale in scales:
        normal = _diffuse(mesh, exchange, (scale * root) ** 2, normal)
        change = np.einsum("ij,ij->i", taken(normal, b) - taken(normal, a), way) / square * root
        curvature.append(np.clip(change, -MAX_CURVATURE, MAX_CURVATURE))
    return np.array(curvature)


def _exchange(mesh: TriMesh) -> csr_array:
    """Symmetric (m, m) conductances between faces: length of the edge over the way from centroid to centroid."""
    flow = mesh.pair_length / np.maximum(mesh.pair_distance, 1e-9 * np.sqrt(mesh.area))
    # The conductances of slivers have no bound of their own, and the solver would converge too slowly.
    flow = np.minimum(flow, MAX_CONDUCTANCE)
    return symmetric_matrix(mesh.edges.pairs, flow, mesh.n_faces)


def _diffuse(mesh: TriMesh, exchange: csr_array, time: float, guess: np.ndarray) -> np.ndarray:
    """Unit normals, (m, 3), after one implicit step of heat flow from face to face.

    time : the square of the width of the smoothing. guess : (m, 3), where the solver starts.
    """
    mass = mesh.face_area + 1e-9 * mesh.area / mesh.n_faces
    diagonal = mass + time * exchange.sum(axis=1)
    system = diags_array(diagonal).tocsr() - time * exchange
    start, x = mass[:, None] * mesh.face_normals, guess.copy()
    each = np.repeat(diagonal, 3).reshape(-1, 3)
    residual = start - system @ x
    goal = 2e-3 * np.sqrt((start**2).sum())
    gradient = residual / each
    step = gradient.copy()
    power = (residual * gradient).sum()  # in a fixed order, see ``weighted_sum``
    product = np.empty_like(x)
    # Conjugate gradients take the three coordinates as one unknown, so that the result turns with the mesh.
    for _ in range(SOLVER_STEPS):
        if np.sqrt(np.multiply(residual, residual, out=product).sum()) <= goal:
            break
        image = system @ step
        length = power / max(np.multiply(step, image, out=product).sum(), 1e-300)
        x += np.multiply(step, length, out=product)
        residual -= np.multiply(image, length, out=image)
        np.divide(residual, each, out=gradient)
        last, power = power, np.multiply(residual, gradient, out=product).sum()
        step *= power / max(last, 1e-300)
        step += gradient
    return unit(x)


def angle_defect(mesh: TriMesh) -> np.ndarray:
    """Integrate the Gaussian curvature over every face.

    The integral is the angle defect of the vertices (2 pi, at a border pi, minus the angles around the vertex). Each
    vertex shares its defect among its faces in proportion to their angles there.

    Parameters
    ----------
    mesh : TriMesh
        m faces.

    Returns
    -------
    defect : (m,) float64
        In radians. On a closed surface the sum is 2 pi times the Euler characteristic (Gauss-Bonnet).
    """
    _, u, v = corner_sides(mesh.vertices, mesh.faces)
    angle = np.arctan2(lengths(cross(u, v)), row_products(u, v)).reshape(-1, 3)
    total = np.bincount(mesh.faces.ravel(), angle.ravel(), mesh.n_vertices)
    border = np.zeros(mesh.n_vertices, bool)
    border[mesh.edges.vertices[mesh.edges.n_faces == 1]] = True
    defect = np.where(border, np.pi, 2 * np.pi) - total
    share = np.divide(defect, total, out=np.zeros_like(total), where=total > 0)
    return (angle * share[mesh.faces]).sum(axis=1)
