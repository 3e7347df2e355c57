# SPDX-License-Identifier: GPL-3.0-or-later
"""Principal curvatures per vertex."""

from __future__ import annotations

import numpy as np

from .mesh import TriMesh


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
    packed = np.concatenate([tensor.reshape(-1, 9), np.zeros((0, 9))])
    sums = np.stack([
        np.bincount(start, column, mesh.n_vertices) + np.bincount(end, column, mesh.n_vertices)
        for column in packed.T], axis=1)
    normals = np.stack([
        np.bincount(mesh.faces.ravel(), np.repeat(column, 3), mesh.n_vertices)
        for column in mesh.area_normals.T], axis=1)
    area = mesh.vertex_area.copy()
    a, b = mesh.edges.vertices.T
    for _ in range(smoothing_steps):
        sums, normals, area = (_plus_neighbours(x, a, b) for x in (sums, normals, area))
    safe = np.maximum(area, 1e-12 * mesh.area)
    return _smaller_tangent_eigenvalue(sums.reshape(-1, 3, 3) / safe[:, None, None], normals)


def _plus_neighbours(values: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Each vertex's value plus those of its neighbours."""
    columns = values.reshape(len(values), -1).T
    sums = [c + np.bincount(a, c[b], len(c)) + np.bincount(b, c[a], len(c)) for c in columns]
    return np.stack(sums, axis=-1).reshape(values.shape)


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
