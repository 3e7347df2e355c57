# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise of a surface, as that of a scan: how much of it there is, and the surface without it.

Curvature and thickness are measured over a few edges, where noise of a tenth of an edge already outweighs the shape.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from ..arrays.indexing import sums_by, taken
from ..arrays.pairs import symmetric_matrix
from ..arrays.vectors import row_products, unit
from ..mesh.triangles import TriMesh

# Correlation of neighbors, see ``roughness``, from which on a surface has no noise, and at and below which all that
# varies from vertex to vertex is taken for noise. Independent noise of every vertex of a grid of triangles has -5/21.
CLEAN, NOISY = 0.25, 0.1
LEAST = 0.02  # roughness, in edges, up to which a surface has no noise that matters
OUTLIERS = 0.2  # share of the vertices, those that stand out most, that count as less: corners and ridges
# The two factors of a step of [Taubin1995], and how many steps are made. What is longer than some 8 edges stays.
SHRINK, GROW, STEPS = 0.5, -0.53, 10


def denoised(mesh: TriMesh) -> TriMesh:
    """The surface without its noise: a mesh that has none is returned as it is.

    Vertices move as far as the noise outweighs the shape, see ``noise_share``; those at borders stay where they are.
    Smoothed by [Taubin1995], which does not shrink the surface.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, faces turned outwards.

    Returns
    -------
    mesh : TriMesh
        The same faces.
    """
    share = noise_share(*roughness(mesh))
    if share == 0.0:
        return mesh
    average, inner = _neighbor_average(mesh), _inner(mesh)[:, None]
    smooth = mesh.vertices
    for _ in range(STEPS):
        for factor in (SHRINK, GROW):
            smooth = np.where(inner, smooth + factor * (average @ smooth - smooth), smooth)
    return TriMesh(mesh.vertices + share * (smooth - mesh.vertices), mesh.faces)


def noise_share(correlation: float, size: float) -> float:
    """How much of what varies from vertex to vertex is noise, 0..1; of what ``roughness`` returns."""
    return float(np.interp(correlation, [NOISY, CLEAN], [1.0, 0.0])) if size > LEAST else 0.0


def roughness(mesh: TriMesh) -> tuple[float, float]:
    """How far vertices stand out from their neighbors, and whether these do so, too.

    Where a smooth surface bends, or at the ridge of an edge, neighboring vertices stand out to the same side. With
    noise they do so independently, and each against the mean of the others.

    Parameters
    ----------
    mesh : TriMesh
        n vertices; those at borders are left out.

    Returns
    -------
    correlation : float
        Of how far the two ends of an edge stand out, -1..1; 1 if none does.
    size : float
        Median of how far vertices stand out, in units of the mean length of their edges.
    """
    inner = _inner(mesh)
    if not inner.any():
        return 1.0, 0.0
    n, (a, b) = mesh.n_vertices, mesh.edges.vertices.T
    total = sums_by(a, taken(mesh.vertices, b), n) + sums_by(b, taken(mesh.vertices, a), n)
    degree = np.bincount(a, minlength=n) + np.bincount(b, minlength=n)
    length = np.bincount(a, mesh.edge_length, n) + np.bincount(b, mesh.edge_length, n)
    normal = unit(mesh.vertex_area_normals)
    height = np.divide(row_products(degree[:, None] * mesh.vertices - total, normal), length,
                       out=np.zeros(n), where=inner & (length > 0))
    bound = np.quantile(np.abs(height[inner]), 1.0 - OUTLIERS)
    height = np.clip(height, -bound, bound)
    square = (height[inner] ** 2).mean()
    both = inner[a] & inner[b]
    if square == 0.0 or not both.any():
        return 1.0, 0.0
    return float((height[a[both]] * height[b[both]]).mean() / square), float(np.median(np.abs(height[inner])))


def _neighbor_average(mesh: TriMesh) -> csr_array:
    """Matrix, (n, n), whose product with values at the vertices is the mean over the neighbors of each."""
    edges = mesh.edges.vertices
    degree = np.bincount(edges.ravel(), minlength=mesh.n_vertices)
    matrix = symmetric_matrix(edges, np.ones(len(edges)), mesh.n_vertices)
    matrix.data /= np.repeat(degree, np.diff(matrix.indptr))
    return matrix


def _inner(mesh: TriMesh) -> np.ndarray:
    """(n,) bool, the vertices of faces at whose edges two faces meet everywhere."""
    inner = mesh.used.copy()
    inner[mesh.edges.vertices[mesh.edges.n_faces != 2]] = False
    return inner
