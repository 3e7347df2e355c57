# SPDX-License-Identifier: GPL-3.0-or-later
"""Critical points of a piecewise linear field.

Vertices are compared by value, and vertices of equal value by index. In this total order no two vertices are equal, so
that flat regions need no code of their own [Edelsbrunner2001].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.indexing import inverse
from ..mesh.triangles import TriMesh

MINIMUM, SADDLE, MAXIMUM = 0, 1, 2
KINDS = ("minimum", "saddle", "maximum")  # name of each kind


@dataclass(frozen=True, eq=False)
class CriticalPoints:
    """Vertices at which the topology of the level set changes.

    Attributes
    ----------
    vertex : (c,) int64
        Critical vertices, rising in the total order.
    kind : (c,) int8
        MINIMUM, SADDLE or MAXIMUM.
    multiplicity : (c,) int64
        k for a saddle whose lower link has k + 1 components; 1 for a minimum or a maximum.
    """

    vertex: np.ndarray
    kind: np.ndarray
    multiplicity: np.ndarray

    def count(self, kind: int) -> int:
        """Count the points of a kind, MINIMUM, SADDLE or MAXIMUM, each with its multiplicity."""
        return int(self.multiplicity[self.kind == kind].sum())


def total_order(values: np.ndarray) -> np.ndarray:
    """Sort vertices by (value, index).

    values : (n,) float64. Returns the place of each vertex in this total order, (n,) int64, 0..n-1.
    """
    return inverse(np.argsort(values, kind="stable"))


def critical_points(mesh: TriMesh, rank: np.ndarray) -> CriticalPoints:
    """Classify every vertex by its lower link.

    Parameters
    ----------
    mesh : TriMesh
        n vertices, m faces. On a closed manifold, minima - saddles + maxima is the Euler characteristic. A vertex at
        a border is classified by the faces that it has.
    rank : (n,) int64
        Place of each vertex in the total order, as ``total_order`` gives it.

    Returns
    -------
    points : CriticalPoints

    Notes
    -----
    O(n + m). The Euler characteristic of a vertex's lower link (lower neighbors minus edges
    between them, opposite the vertex) is 1 at a regular vertex, 0 at a minimum or a maximum
    inside, and k + 1 at a saddle of multiplicity k.
    """
    n = mesh.n_vertices
    start, end = mesh.edges.vertices.T
    rises = rank[start] < rank[end]
    upper_end = np.where(rises, end, start)
    lower_end = np.where(rises, start, end)
    n_lower = np.bincount(upper_end, minlength=n)
    n_upper = np.bincount(lower_end, minlength=n)
    # In each face, the edge opposite the highest vertex belongs to the lower link of that vertex.
    highest = np.take_along_axis(mesh.faces, rank[mesh.faces].argmax(axis=1)[:, None], axis=1)
    link_edges = np.bincount(highest[:, 0], minlength=n)
    euler = n_lower - link_edges

    minimum = (n_lower == 0) & (n_upper > 0)
    maximum = (n_upper == 0) & (n_lower > 0)
    kind = np.full(n, -1, np.int8)
    # Where several fans of faces meet, as at a border, a maximum has as many lower links, too.
    kind[euler >= 2], kind[minimum], kind[maximum] = SADDLE, MINIMUM, MAXIMUM
    vertex = np.flatnonzero(kind >= 0)
    vertex = vertex[np.argsort(rank[vertex])]
    multiplicity = np.where(kind[vertex] == SADDLE, euler[vertex] - 1, 1)
    return CriticalPoints(vertex, kind[vertex], multiplicity)
