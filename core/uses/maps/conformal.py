# SPDX-License-Identifier: GPL-3.0-or-later
"""How a map that keeps angles would shrink and grow a surface, without making the map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array, diags_array

from ...arrays.indexing import sums_by
from ...arrays.pairs import distinct_pairs, symmetric_matrix
from ...arrays.systems import solved
from ...arrays.vectors import cross, lengths, row_products
from ...mesh.corners import CornerTable
from ...mesh.triangles import corner_sides

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
        n, (triangles, _) = len(table.vertices), table.fans()
        ends, u, v = corner_sides(table.vertices, triangles)
        sine, cosine = lengths(cross(u, v)), row_products(u, v)
        angle = np.zeros(n)
        for corner, turn in zip(triangles.T, np.arctan2(sine, cosine).reshape(-1, 3).T, strict=True):
            angle += np.bincount(corner, turn, n)
        longest = np.maximum(row_products(u, u), row_products(v, v))
        cotangent = cosine / np.maximum(sine, 1e-12 * np.maximum(longest, np.finfo(float).tiny))
        pairs, which = distinct_pairs(*np.sort(ends, axis=1).T)
        weight = sums_by(which, 0.5 * cotangent.clip(-_STEEPEST, _STEEPEST), len(pairs))
        weights = symmetric_matrix(pairs, np.maximum(weight, _WEAKEST), n)
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
