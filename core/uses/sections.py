# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies that are longer than a box: where to cut them in planes, and which triangles lie in such a section."""

from __future__ import annotations

import numpy as np

from ..arrays.components import components
from ..arrays.int64 import arange, full
from ..arrays.pairs import are_among, distinct_pairs
from ..arrays.vectors import cross_in_plane
from ..mesh.triangles import EdgeTable

# A piece is a little smaller than the box.
_ROOM = 1 - 1e-4


def planes_to_fit(points: np.ndarray, areas: np.ndarray, box: np.ndarray,
                  axes: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Find planes that cut a body towards pieces which fit into a box, along one of its axes.

    Parameters
    ----------
    points : (k, 3) float64
        On its surface.
    areas : (k,) float64
        What each stands for.
    box : (3,) float64
        In the unit of the points; it may be turned.
    axes : (a, 3, 3) float64
        Rows of three axes each that are tried besides the body's own and those of its coordinates.

    Returns
    -------
    axis : (3,) float64
        Normal of the planes: of the axes with which the fewest pieces will fit, the longest that is longer than the
        side of the box for it.
    levels : (c,) float64
        Where they are along it, rising; the pieces are equally long.
    axes : (3, 3) float64
        The three axes, for the pieces.

        None instead of all if the body fits.
    """
    sides = np.sort(box)[::-1]
    out = points - np.average(points, axis=0, weights=areas if areas.any() else None)
    _, vectors = np.linalg.eigh((out * areas[:, None]).T @ out)
    frames = [*axes, np.eye(3), vectors.T]
    extents = [np.ptp(points @ frame.T, axis=0) for frame in frames]
    orders = [np.argsort(-extent, kind="stable") for extent in extents]
    counts = np.array([np.maximum(np.ceil(extent[order] / (_ROOM * sides)), 1)
                       for extent, order in zip(extents, orders, strict=True)])
    best = int(counts.prod(axis=1).argmin())
    if (counts[best] == 1).all():
        return None
    k = int(np.argmax(counts[best] > 1))
    axis = frames[best][orders[best][k]]
    low, length, count = (points @ axis).min(), extents[best][orders[best][k]], int(counts[best][k])
    return axis, low + length * arange(1, count) / count, frames[best]


def inside_section(flat: np.ndarray, edges: np.ndarray, triangles: np.ndarray) -> np.ndarray | None:
    """Choose the triangles that lie inside of closed curves in a plane: between an outer one and those in it.

    Parameters
    ----------
    flat : (n, 2) float64
    edges : (e, 2) int64
        Of the curves, each in some triangle.
    triangles : (t, 3) int64
        A triangulation of all points with these edges.

    Returns
    -------
    chosen : (s, 3) int64 or None
        Counterclockwise; None unless the curves are all that bounds them.
    """
    table, edges = EdgeTable.of(triangles), np.sort(edges, axis=1)
    wall = are_among(table.vertices, edges)
    open_ = wall[table.pair_edge]
    count, label = components(len(triangles), *table.pairs[~open_].T)
    # Across each curve, what is outside is inside; at the rim of all triangles, it is known.
    inside = full(count, -1)
    face, side = np.nonzero(table.n_faces[table.face_edges] == 1)
    inside[label[face]] = wall[table.face_edges[face, side]]
    beyond = distinct_pairs(*label[table.pairs[open_]].T)[0]
    for _ in range(count):
        known = inside[beyond] >= 0
        for here, there in ((0, 1), (1, 0)):
            some = known[:, here] & ~known[:, there]
            inside[beyond[some, there]] = 1 - inside[beyond[some, here]]
        if known.all():
            break
    chosen = triangles[inside[label] == 1]
    a, b, c = flat[chosen].transpose(1, 0, 2)
    turn = cross_in_plane(b - a, c - a)
    chosen = np.where(turn[:, None] > 0, chosen, chosen[:, ::-1])
    table = EdgeTable.of(chosen)
    same = np.array_equal(table.vertices[table.n_faces == 1], distinct_pairs(*edges.T)[0])
    return chosen if same else None
