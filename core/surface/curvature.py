# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature per vertex, across pairs of faces, and per face."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array, diags_array

from .arrays import sums_by, symmetric_matrix
from .mesh import TriMesh

SCALES = (0.01, 0.02, 0.04)  # widths over which normals are smoothed, in units of sqrt(area)
MAX_CURVATURE = 60.0  # in units of 1 / sqrt(area); what is sharper counts as this sharp
SOLVER_STEPS = 60  # conjugate gradient steps at most
# Edge length over the distance of two faces' centers over the edge: 1.7 for equilateral triangles.
MAX_CONDUCTANCE = 20.0


def k_min(mesh: TriMesh, smoothing_steps: int = 2) -> np.ndarray:
    """Smaller principal curvature of every vertex, negative in concavities.

    From the curvature tensor of [CohenSteiner2003]: dihedral angles along the edges, summed
    around each vertex and divided by its area; of the two eigenvalues tangent to the surface,
    each belongs to the direction across its eigenvector. The paper takes another estimator; a
    discrete one that needs no fit stands long thin triangles better.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, faces turned outwards.
    smoothing_steps : int
        The tensor is summed over this many rings around the vertex.

    Returns
    -------
    k_min : (n,) float64
        1 / length. Times the radius of a contour it has no unit.

    Notes
    -----
    O(n + m), whole arrays.
    """
    start, end = mesh.edges.vertices[mesh.edges.pair_edge].T
    edge = mesh.vertices[end] - mesh.vertices[start]
    length = np.linalg.norm(edge, axis=1)
    direction = np.divide(edge, length[:, None], out=np.zeros_like(edge), where=length[:, None] > 0)
    tensor = (0.5 * mesh.dihedral * length)[:, None, None] * (
        direction[:, :, None] * direction[:, None, :])
    tensor = tensor.reshape(-1, 9)
    sums = sums_by(start, tensor, mesh.n_vertices) + sums_by(end, tensor, mesh.n_vertices)
    normals = sums_by(mesh.faces.ravel(), np.repeat(mesh.area_normals, 3, axis=0), mesh.n_vertices)
    area = mesh.vertex_area.copy()
    a, b = mesh.edges.vertices.T
    for _ in range(smoothing_steps):
        sums, normals, area = (_plus_neighbors(x, a, b) for x in (sums, normals, area))
    safe = np.maximum(area, 1e-12 * mesh.area)
    return _smaller_tangent_eigenvalue(sums.reshape(-1, 3, 3) / safe[:, None, None], normals)


def _plus_neighbors(values: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Each vertex's value plus those of its neighbors."""
    return values + sums_by(a, values[b], len(values)) + sums_by(b, values[a], len(values))


def _smaller_tangent_eigenvalue(tensor: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Smaller eigenvalue of (n, 3, 3) symmetric tensors in the planes across (n, 3) normals."""
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normal = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0)
    normal[length[:, 0] == 0] = (0.0, 0.0, 1.0)
    axis = np.eye(3)[np.abs(normal).argmin(axis=1)]
    u = np.cross(normal, axis)
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    v = np.cross(normal, u)
    uu, uv, vv = (np.einsum("ni,nij,nj->n", p, tensor, q) for p, q in ((u, u), (u, v), (v, v)))
    return (uu + vv) / 2 - np.hypot((uu - vv) / 2, uv)


def curvature_across(mesh: TriMesh, scales: tuple[float, ...] = SCALES) -> np.ndarray:
    """Change of the smoothed normal across each pair of faces, per way.

    Parameters
    ----------
    mesh : TriMesh
    scales : tuple of float
        Widths of the smoothing, in units of the square root of the area.

    Returns
    -------
    curvature : (len(scales), p) float64
        Dimensionless: times the square root of the area. Negative in concavities.
    """
    unit = np.sqrt(mesh.area)
    a, b = mesh.edges.pairs.T
    way = mesh.face_centroids[b] - mesh.face_centroids[a]
    square = np.maximum(np.einsum("ij,ij->i", way, way), 1e-12 * mesh.area)
    exchange = _exchange(mesh)
    normal, curvature = mesh.face_normals, []
    for scale in scales:
        normal = _diffuse(mesh, exchange, (scale * unit) ** 2, normal)
        change = np.einsum("ij,ij->i", normal[b] - normal[a], way) / square * unit
        curvature.append(np.clip(change, -MAX_CURVATURE, MAX_CURVATURE))
    return np.array(curvature)


def _exchange(mesh: TriMesh) -> csr_array:
    """Symmetric (m, m) conductances between faces: edge length over way."""
    flow = mesh.pair_length / np.maximum(mesh.pair_distance, 1e-9 * np.sqrt(mesh.area))
    # A sliver exchanges with its neighbors in no time; bounded, or the solver would stall.
    flow = np.minimum(flow, MAX_CONDUCTANCE)
    return symmetric_matrix(mesh.edges.pairs, flow, mesh.n_faces)


def _diffuse(mesh: TriMesh, exchange: csr_array, time: float, guess: np.ndarray) -> np.ndarray:
    """Unit normals after one implicit step of heat flow from face to face."""
    mass = mesh.face_area + 1e-9 * mesh.area / mesh.n_faces
    diagonal = mass + time * exchange.sum(axis=1)
    system = diags_array(diagonal).tocsr() - time * exchange
    start, x = mass[:, None] * mesh.face_normals, guess
    residual = start - system @ x
    goal = 2e-3 * np.linalg.norm(start)
    step = gradient = residual / diagonal[:, None]
    power = np.vdot(residual, gradient)
    # Conjugate gradients; the three coordinates as one unknown, so that turning changes nothing.
    for _ in range(SOLVER_STEPS):
        if np.linalg.norm(residual) <= goal:
            break
        image = system @ step
        length = power / max(np.vdot(step, image), 1e-300)
        x = x + length * step
        residual = residual - length * image
        gradient = residual / diagonal[:, None]
        last, power = power, np.vdot(residual, gradient)
        step = gradient + step * (power / max(last, 1e-300))
    return x / np.maximum(np.linalg.norm(x, axis=1, keepdims=True), 1e-300)


def angle_defect(mesh: TriMesh) -> np.ndarray:
    """Gaussian curvature of every face: the angle defect of its vertices, shared among their faces by angle.

    Parameters
    ----------
    mesh : TriMesh
        m faces.

    Returns
    -------
    defect : (m,) float64
        Radians; on a closed surface it sums to 2 pi times the Euler characteristic (Gauss-Bonnet).
    """
    side = np.roll(mesh.corners, -1, axis=1) - mesh.corners
    back = -np.roll(side, 1, axis=1)
    sine = np.linalg.norm(np.cross(side, back), axis=2)
    angle = np.arctan2(sine, (side * back).sum(axis=2))
    total = np.bincount(mesh.faces.ravel(), angle.ravel(), mesh.n_vertices)
    border = np.zeros(mesh.n_vertices, bool)
    border[mesh.edges.vertices[mesh.edges.n_faces == 1]] = True
    defect = np.where(border, np.pi, 2 * np.pi) - total
    share = np.divide(defect, total, out=np.zeros_like(total), where=total > 0)
    return (angle * share[mesh.faces]).sum(axis=1)
