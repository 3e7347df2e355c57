# SPDX-License-Identifier: GPL-3.0-or-later
"""Border vertices that are one: files keep them apart where textures or normals have seams."""

from __future__ import annotations

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import first_at_place
from ..arrays.int64 import arange, full
from ..arrays.pairs import distinct_pairs, repeated_in
from ..arrays.vectors import box_diagonal, row_products
from ..sentence import Sentence

GAP = 5e-5  # share of the diagonal within which border vertices are one: seams that were moved, and rounded, apart
SAME_SIDE = 0.9  # cosine of the angle between two surfaces at a border from which on they are on one side of it
NEAREST = 8  # of the border vertices around each, itself included, so many are looked at


def border_note(n_edges: int) -> Sentence:
    """What to say of the borders of a mesh."""
    return Sentence("{n} border {n:edge|edges}: the surface is open there.", n=n_edges)


def joined_borders(
    vertices: np.ndarray, edges: np.ndarray, n_edge_faces: np.ndarray, corner_vertex: np.ndarray,
    corner_face: np.ndarray
) -> np.ndarray:
    """Find the vertex that each vertex is joined to.

    A border vertex is joined to the first border vertex at its place, any other vertex to itself: two closed surfaces
    that touch stay apart. What is still at a border then is joined to what else is, within GAP of it: so closed
    surfaces that nearly touch stay apart, too, where a file splits their vertices.

    Parameters
    ----------
    vertices : (n, 3) float64
    edges : (e, 2) int64
    n_edge_faces : (e,) int64
        Number of faces at each edge.
    corner_vertex, corner_face : (c,) int64
        Vertex and face of each corner of all faces, the corners of a face in a row.

    Returns
    -------
    joined : (n,) int64
    """
    at_border = np.zeros(len(vertices), bool)
    at_border[edges[n_edge_faces == 1]] = True
    joined = first_at_place(vertices, np.flatnonzero(at_border))
    beside = at_border[edges].all(axis=1)
    pairs, pair = distinct_pairs(*np.sort(joined[edges[beside]], axis=1).T)
    place = np.unique(pairs[np.bincount(pair, n_edge_faces[beside]) == 1])
    used = np.zeros(len(vertices), bool)
    used[corner_vertex] = True
    gap = GAP * box_diagonal(vertices[used])
    return joined_nearby(vertices, place, np.full(len(place), gap), joined[corner_vertex], corner_face)[joined]


def joined_nearby(
    vertices: np.ndarray, place: np.ndarray, within: np.ndarray, corner_vertex: np.ndarray, corner_face: np.ndarray,
    inward: np.ndarray | None = None
) -> np.ndarray:
    """Find the vertex that each vertex is joined to, if some that are near each other are one.

    Not where a face would have a corner twice: what is as small as that stays as it is.

    Parameters
    ----------
    vertices : (n, 3) float64
    place : (k,) int64
        Vertices that may be joined, rising.
    within : (k,) float64
        How near another one must be to be one with each of them, and it with that one.
    corner_vertex, corner_face : (c,) int64
        As in ``joined_borders``.
    inward : (k, 3) float64, optional
        Unit vectors from each of ``place`` into its surface: what lies on the same side as another is not one with it,
        as sheets that lie on each other.

    Returns
    -------
    joined : (n,) int64
        The first of those that are one.
    """
    from scipy.spatial import cKDTree  # here, since Blender's panels come up without SciPy

    goal = arange(len(vertices))
    if len(place) < 2:
        return goal
    distance, near = cKDTree(vertices[place]).query(
        vertices[place], k=range(2, min(NEAREST, len(place)) + 1), distance_upper_bound=float(within.max()))
    row, column = np.nonzero(distance <= np.minimum(within[:, None], np.append(within, 0.0)[near]))
    column = near[row, column]
    if inward is not None:
        apart = row_products(inward[row], inward[column]) < SAME_SIDE
        row, column = row[apart], column[apart]
    if not len(row):
        return goal
    count, group = components(len(place), row, column)
    of_vertex = full(len(vertices), -1)
    of_vertex[place] = group
    corner = of_vertex[corner_vertex]
    here = corner >= 0  # all others are no matter of this
    kept = np.ones(count, bool)
    kept[repeated_in(corner_face[here], corner[here], count=count)] = False
    first = full(count, len(vertices))
    np.minimum.at(first, group, place)
    goal[place] = np.where(kept[group], first[group], place)
    return goal
