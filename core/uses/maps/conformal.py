# SPDX-License-Identifier: GPL-3.0-or-later
"""How a map that keeps angles would shrink and grow a surface, without making the map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import splu

from ...arrays.indexing import sums_by
from ...arrays.pairs import distinct_pairs, symmetric_matrix
from ...mesh.corners import CornerTable

# Cotangents of the angles of needles and the sum at an edge are kept within these, so that none outweighs all others
# and the matrix stays positive definite.
_STEEPEST, _WEAKEST = 50.0, 0.01


@dataclass(frozen=True, eq=False)
class ConformalFactor:
    """The matrix of a mesh that ``solve`` needs, made once.

    Attributes
    ----------
    laplacian : (n, n) scipy.sparse.csr_array
        Positive semidefinite; the cotangent weights of all edges.
    curvature : (n,) float64
        Gaussian curvature at each vertex: 2 pi less the angles around it.
    """

    laplacian: csr_array
    curvature: np.ndarray

    @classmethod
    def of(cls, table: CornerTable) -> ConformalFactor:
        """Make the matrix. table : CornerTable of n vertices. Returns a ConformalFactor."""
        points, n = table.vertices, len(table.vertices)
        ends, weight, angle = [], [], np.zeros(n)
        triangles, _ = table.fans()
        for a, b, c in (np.roll(triangles, -k, axis=1).T for k in range(3)):
            x, y = points[b] - points[a], points[c] - points[a]
            sine, cosine = np.linalg.norm(np.cross(x, y), axis=1), (x * y).sum(axis=1)
            angle += np.bincount(a, np.arctan2(sine, cosine), n)
            longest = np.maximum((x * x).sum(axis=1), (y * y).sum(axis=1))
            cotangent = cosine / np.maximum(sine, 1e-12 * np.maximum(longest, np.finfo(float).tiny))
            ends.append(np.sort(np.stack([b, c], axis=1), axis=1))
            weight.append(0.5 * cotangent.clip(-_STEEPEST, _STEEPEST))
        pairs, which = distinct_pairs(*np.concatenate(ends).reshape(-1, 2).T)
        weights = symmetric_matrix(
            pairs, np.maximum(sums_by(which, np.concatenate(weight), len(pairs)), _WEAKEST), n)
        return cls(diags_array(weights.sum(axis=1)).tocsr() - weights, 2 * np.pi - angle)

    def solve(self, free: np.ndarray) -> np.ndarray:
        """Find the logarithm of the scale of lengths at each vertex, of the map that keeps lengths at all others.

        Of all maps of a disc into the plane that keep angles, the one that keeps the lengths of the border changes
        areas least [Springborn2008]. The curvature K that it takes away at the vertices inside and the logarithm u of
        its scale are related by L u = -K, with L the Laplacian [BenChen2008].

        Parameters
        ----------
        free : (k,) int64
            Vertices inside; all others keep their lengths, and where they divide the mesh, each piece is solved alone.

        Returns
        -------
        scale : (n,) float64
            0 at vertices that are not free, negative where the map shrinks the surface, positive where it grows.
        """
        scale = np.zeros(len(self.curvature))
        if len(free):
            scale[free] = solved(self.laplacian[free][:, free], -self.curvature[free])
        return scale


def solved(matrix: csr_array, right: np.ndarray) -> np.ndarray:
    """Solve a system whose matrix is symmetric and positive definite.

    matrix : (k, k) scipy.sparse.csr_array. right : (k,) float64. Returns (k,) float64.
    """
    # Surfaces fill in so little that narrow panels are a quarter faster than SuperLU's own.
    factors = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, relax=20, panel_size=2,
                   options={"SymmetricMode": True})
    return factors.solve(right)
