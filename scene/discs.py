# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces across closed curves on a body: smooth, of triangles that grow away from the curve, inside the body."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from mathutils.bvhtree import BVHTree
from mathutils.geometry import delaunay_2d_cdt
from scipy.sparse import csr_array
from scipy.spatial import cKDTree

from ..core.uses.cap_surfaces import away_from_curve, harmonic_weights, in_a_circle, over_a_plane, spread

# How often a surface that leaves the body is pushed back, and how near to the body's surface it may come, as a share
# of the distance from the curve.
_ROUNDS, _MARGIN = 10, 0.5


@dataclass(frozen=True, eq=False)
class Disc:
    """A surface across a closed curve of k points.

    Attributes
    ----------
    triangles : (t, 3) int64
        0..k-1 are the points of the curve, in whose direction the triangles go round; k, k+1, ... those inside.
    places : (m, 3) float64
        Of the points inside.
    weights : csr_array, (k + m, k + m)
        What each point adds to a point inside that lies between them, see core.uses.cap_surfaces.
    """

    triangles: np.ndarray
    places: np.ndarray
    weights: csr_array

    def spread(self, values: np.ndarray) -> np.ndarray:
        """What the points inside have if those of the curve have some values, (k, c): (m, c) float64."""
        return spread(self.weights, values)


class Discs:
    """Surfaces across closed curves on a mesh, each made once, so that it is the same for both sides of a cut.

    Parameters
    ----------
    points : (n, 3) float64
        Of the whole mesh.
    triangles : (t, 3) int
        Its triangles.
    """

    def __init__(self, points: np.ndarray, triangles: np.ndarray) -> None:
        self._points, self._triangles = points, triangles
        self._found: dict[bytes, Disc | None] = {}
        #: Vertices of the curves across which the surface crosses the mesh or itself, and how often all of them do.
        self.crossing: list[np.ndarray] = []
        self.n_crossings = 0

    def across(self, curve: np.ndarray) -> Disc | None:
        """The surface across a curve, (k, 3) float64, or None where there is none; the same for the same points."""
        key = curve.tobytes()
        if key not in self._found:
            self._found[key] = self._best(curve)
        return self._found[key]

    def _best(self, curve: np.ndarray) -> Disc | None:
        """The first surface that stays inside, of those over a plane and in a circle, else the one that nearly does."""
        best, least, body = None, 1 << 30, None
        for flat in (over_a_plane(curve), in_a_circle(curve)):
            found = _disc(curve, flat) if flat is not None and len(curve) > 3 else None
            if found is None:
                continue
            near = self._around(curve, np.concatenate([curve, found.places]), 0.0)
            for push in (False, True):
                if push:
                    body = body or self._around(curve, curve, 0.2)
                    if body is None:
                        break
                    found, near = _pushed(found, curve, body), body
                count = _crossings(found, curve, near) if near else 0
                if count < least:
                    best, least = found, count
                if not count:
                    return best
        if best is not None and body is not None:
            self.crossing.append(body.vertices[body.own[body.own >= 0]])
            self.n_crossings += least
        return best

    def _around(self, curve: np.ndarray, places: np.ndarray, margin: float) -> _Body | None:
        """The surface of the mesh in the bounding box of some places, wider by such a share of its diagonal."""
        low, high = places.min(axis=0), places.max(axis=0)
        margin *= float(np.linalg.norm(high - low))
        near = self._triangles[self._within(low - margin, high + margin)]
        if not len(near):
            return None
        on = np.zeros(len(self._points), bool)
        on[near] = True
        used = np.flatnonzero(on)
        number = np.empty(len(on), np.int64)
        number[used] = np.arange(len(used))
        points, triangles = self._points[used], number[near]
        maybe = np.flatnonzero(np.isin(points[:, 0], curve[:, 0]))
        place = {bytes(points[index]): index for index in maybe.tolist()}
        tree = BVHTree.FromPolygons(points.tolist(), triangles.tolist(), all_triangles=True)
        own = np.array([place.get(bytes(point), -1) for point in np.ascontiguousarray(curve)])
        return _Body(tree, triangles, own, used)

    def _within(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Triangles whose bounding box meets a box; (k,) int64."""
        side = np.zeros(len(self._points), np.uint8)  # a bit for each side of the box that a point is beyond
        for axis in range(3):
            side |= (self._points[:, axis] < low[axis]).astype(np.uint8) << 2 * axis
            side |= (self._points[:, axis] > high[axis]).astype(np.uint8) << 2 * axis + 1
        a, b, c = side[self._triangles].T
        return np.flatnonzero((a & b & c) == 0)


@dataclass(frozen=True, eq=False)
class _Body:
    """The surface around a curve.

    Attributes
    ----------
    tree : BVHTree
    triangles : (t, 3) int64
        With numbers of their own for the vertices.
    own : (k,) int64
        That of each point of the curve; -1 for one that is no vertex of the mesh.
    vertices : (v,) int64
        The vertex of the mesh for each of these numbers.
    """

    tree: BVHTree
    triangles: np.ndarray
    own: np.ndarray
    vertices: np.ndarray


def _disc(curve: np.ndarray, flat: np.ndarray) -> Disc | None:
    """A surface across a curve by what it looks like in a plane, (k, 2); None where it meets itself there."""
    inner = away_from_curve(flat)
    for _ in range(4):
        found = _triangulated(flat, inner)
        if found is None:
            return None
        triangles, used = found
        inner = inner[used]
        # An edge between two points of the curve might be there already, in this piece or in another.
        joined = _joining(triangles, len(flat))
        if not len(joined):
            weights = harmonic_weights(np.concatenate([flat, inner]), triangles)
            return Disc(triangles, spread(weights, curve), weights)
        inner = np.concatenate([inner, flat[joined].mean(axis=1)])
    return None


def _triangulated(flat: np.ndarray, inner: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Triangles that fill the curve, and which inner points are inside; None if the curve meets itself."""
    k = len(flat)
    coords = np.concatenate([flat, inner])
    verts, _, faces, origin, _, _ = delaunay_2d_cdt(coords.tolist(), [], [list(range(k))], 1, 1e-9)
    if len(verts) != len(coords) or any(len(found) != 1 for found in origin):
        return None
    name = np.array([found[0] for found in origin])
    triangles = name[np.array(faces, np.int64).reshape(-1, 3)]
    used = np.zeros(len(coords), bool)
    used[triangles] = True
    if not used[:k].all() or len(triangles) != 2 * used[k:].sum() + k - 2:
        return None
    a, b, c = coords[triangles].transpose(1, 0, 2)
    turn = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    place = np.cumsum(used) - 1
    return place[triangles if turn.sum() > 0 else triangles[:, ::-1]], used[k:]


def _joining(triangles: np.ndarray, k: int) -> np.ndarray:
    """Edges inside that join two points of the curve, (j, 2)."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    return edges[(count == 2) & (edges < k).all(axis=1)]


def _crossings(disc: Disc, curve: np.ndarray, body: _Body) -> int:
    """How many pairs of triangles, one of the surface, cross; where they have a point in common, they may touch."""
    k = len(curve)
    corners = np.concatenate([curve, disc.places])
    tree = BVHTree.FromPolygons(corners.tolist(), disc.triangles.tolist(), all_triangles=True)
    pairs = np.array(tree.overlap(body.tree), np.int64).reshape(-1, 2)
    own = np.concatenate([body.own, np.full(len(corners) - k, -2)])[disc.triangles[pairs[:, 0]]]
    touch = (own[:, :, None] == body.triangles[pairs[:, 1]][:, None]).any(axis=(1, 2))
    within = np.array(tree.overlap(tree), np.int64).reshape(-1, 2)
    within = within[within[:, 0] < within[:, 1]]
    share = (disc.triangles[within[:, 0]][:, :, None] == disc.triangles[within[:, 1]][:, None]).any(axis=(1, 2))
    return int((~touch).sum() + (~share).sum())


def _pushed(disc: Disc, curve: np.ndarray, body: _Body) -> Disc:
    """The surface with the points that leave the body held a little inside it, and the others smooth between them."""
    k = len(curve)
    places = disc.places
    held = np.zeros(len(places), bool)
    margin = _MARGIN * cKDTree(curve).query(places)[0]
    side = 0.0
    for _ in range(_ROUNDS):
        nearest = [body.tree.find_nearest(place) for place in places.tolist()]
        on = np.array([found[0][:] for found in nearest])
        normal = np.array([found[1][:] for found in nearest])
        height = ((places - on) * normal).sum(axis=1)
        # Whichever way the faces look, most of the surface is inside.
        side = side or (1.0 if np.median(height) <= 0 else -1.0)
        out = side * height > -0.5 * margin
        if not out.any():
            break
        places = places.copy()
        places[out] = on[out] - side * normal[out] * margin[out, None]
        held |= out
        fixed = np.concatenate([np.ones(k, bool), held])
        places = spread(disc.weights, np.concatenate([curve, places])[fixed], fixed)[k:]
    return replace(disc, places=places)
