# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces across closed curves on a body: smooth, of triangles that grow away from the curve, inside the body."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from mathutils.geometry import delaunay_2d_cdt
from scipy.sparse import coo_array

from ....core.arrays.indexing import inverse, ranges
from ....core.arrays.int64 import arange, cumsum, full
from ....core.arrays.pairs import edge_keys
from ....core.arrays.vectors import cross, cross_in_plane
from ....core.mesh.triangles import EdgeTable, vertex_components
from ....core.uses.caps.rims import is_inside
from ....core.uses.caps.sleeves import Sleeve, sleeve
from ....core.uses.caps.surfaces import away_from_curve, harmonic_weights, in_a_circle, over_a_plane, spread
from ...reading import mesh_arrays
from .body_surface import BodySurface
from .disc import Disc
from .disc_fitting import depths, pulled, pushed, steep

# So many triangles from the rim a cap follows the surface, where it cannot go straight across; the last: to the end.
_SLEEVES = (3, 10, 1000)
# At so many triangles of a cap it is asked whether they are inside.
_PLACES = 60
# Triangles are looked for in rows of so many, whose bounding boxes are known.
_ROW = 64
# What crosses the model more often than this is not tried any finer: of 36 such caps of 153 models none became sound.
_FEW = 8

#: How far to go for a surface that crosses nothing, each several times as dear as the one before: over the plane of the
#: curve or round a circle; led straight in from the rim; finer, pulled off, along the surface.
PLAIN, LED_IN, ALL = 1, 2, 3


@dataclass(frozen=True, eq=False)
class Found:
    """The best surface across a curve.

    Attributes
    ----------
    disc : Disc or None
    faults : int
        How often it crosses the mesh or itself; one more if it is outside. One that follows the surface of a part,
        which is the last resort, counts as if it did once.
    own : (j,) int64
        Vertices of the mesh that the curve has.
    """

    disc: Disc | None
    faults: int
    own: np.ndarray


class _Tries:
    """What was tried to close some curves, (k, 3) each, and the best of it.

    Attributes
    ----------
    curve : (k, 3) float64
        The points of all curves.
    is_single : bool
        Whether there is one curve only.
    rims : list of _Rims
        How they are seen in a plane.
    plain : list of Disc
        The plain surfaces.
    wide : BodySurface and float, or None
        See ``Discs._wide``.
    best : Found
    done : int
        How far it went: 0, PLAIN, LED_IN or ALL.
    follows_surface : bool
        Whether it has come to surfaces that follow that of a part.
    """

    def __init__(self, curves: Sequence[np.ndarray]) -> None:
        self.curve, self.is_single = np.concatenate(curves), len(curves) == 1
        self.rims = _seen(curves) if len(self.curve) > 3 else []
        self.plain: list[Disc] = []
        self.wide: tuple[BodySurface, float] | None = None
        self.best = Found(None, 0, np.empty(0, np.int64))
        self.done, self.follows_surface = 0, False


class Discs:
    """Surfaces across closed curves on a mesh, each made once, so that it is the same for both sides of a cut.

    Parameters
    ----------
    points : (n, 3) float64
        Of the whole mesh.
    triangles : (t, 3) int
        Its triangles.
    labels : (t,) int64
        Part of each triangle.
    """

    def __init__(self, points: np.ndarray, triangles: np.ndarray, labels: np.ndarray) -> None:
        self._points, self._triangles, self._labels = points, triangles, labels
        self._tries: dict[bytes, _Tries] = {}
        self._used: set[bytes] = set()
        self._flat: dict[bytes, bool] = {}
        #: Vertices of the curves across which the surface crosses the mesh or itself, and how often all of them do.
        self.crossing: list[np.ndarray] = []
        self.n_crossings = 0

    def across(self, *curves: np.ndarray) -> Disc | None:
        """The surface across curves, (k, 3) float64 each, or None where there is none; the same for the same points.

        Of several, the others lie within the first, seen along the normal of its area, and go round the other way.
        """
        found, key = self.tried(*curves), _key(curves)
        if key not in self._used:
            self._used.add(key)
            self.note(found.own, found.faults)
        return found.disc

    def tried(self, *curves: np.ndarray, effort: int = ALL) -> Found:
        """What ``across`` would give, and how bad it is, if it went no farther than PLAIN, LED_IN or ALL."""
        key = _key(curves)
        tries = self._tries[key] = self._tries.get(key) or _Tries(curves)
        ways = (self._plain, self._led_in, self._last)
        while tries.done < effort and (tries.best.disc is None or tries.best.faults):
            self._choose(tries, ways[tries.done](tries))
            tries.done += 1
        tries.wide = None  # which takes much more memory than what is found
        return tries.best

    def note(self, own: np.ndarray, faults: int) -> None:
        """Note that surfaces at some vertices of the mesh, (k,) int64, cross something so often."""
        if faults:
            self.crossing.append(own)
            self.n_crossings += faults

    def is_free(self, curve: np.ndarray) -> bool:
        """Whether one face in a curve, (k, 3) float64, crosses nothing and is inside, from whichever side it is."""
        key = curve.tobytes()
        if key not in self._flat:
            near = self.around(curve, curve, 0.0)
            self._flat[key] = near is None or all(self._fits(curve, order, near) for order in (1, -1))
        return self._flat[key]

    def _fits(self, curve: np.ndarray, step: int, body: BodySurface) -> bool:
        """Whether the triangles that Blender makes of a face cross nothing and are inside."""
        corners = np.arange(len(curve), dtype=np.int32)[::step]
        triangles, _ = mesh_arrays.triangulated(curve.astype(np.float32), np.array([len(curve)], np.int32), corners)
        return not len(body.crossings(curve, triangles)[0]) and not self._is_outside(curve, triangles, body)

    def _choose(self, tries: _Tries, candidates: Iterator[tuple[Disc, BodySurface]]) -> None:
        """Keep the first surface that is inside and crosses nothing, else the one that nearly does."""
        for disc, body in candidates:
            places, best = np.concatenate([tries.curve, disc.places]), tries.best
            faults = sum(map(len, body.crossings(places, disc.triangles)))
            if best.disc is None or faults < best.faults:
                faults += self._is_outside(places, disc.triangles, body)
            if best.disc is None or faults < best.faults:
                own = body.vertices[body.own[body.own >= 0]]
                tries.best = Found(disc, faults or int(tries.follows_surface), own)
            if not faults:
                break

    def _plain(self, tries: _Tries) -> Iterator[tuple[Disc, BodySurface]]:
        """Surfaces across curves with the body around each: as they are seen in a plane, then pushed off the body."""
        curve = tries.curve
        for found in filter(None, map(partial(_disc, curve), tries.rims)):
            near = tries.wide[0] if tries.wide else self.around(curve, np.concatenate([curve, found.places]), 0.0)
            if near is None:
                return
            tries.plain.append(found)
            yield found, near
            body, side = self._wide(tries)
            yield pushed(found, curve, body, side), body

    def _led_in(self, tries: _Tries) -> Iterator[tuple[Disc, BodySurface]]:
        """These surfaces led straight in."""
        for found in tries.plain:
            body, side = self._wide(tries)
            yield steep(found, tries.curve, body, side), body

    def _last(self, tries: _Tries) -> Iterator[tuple[Disc, BodySurface]]:
        """What takes long: the plain surfaces pulled off the body, with more points, and such that follow its faces."""
        if not tries.plain:
            return
        curve, (body, side) = tries.curve, self._wide(tries)
        if tries.best.faults <= _FEW:
            for found in tries.plain:
                yield pulled(pushed(found, curve, body, side), curve, body, side), body
            for found in filter(None, (_disc(curve, one, 2.0) for one in tries.rims)):
                yield steep(found, curve, body, side), body
        if tries.is_single:
            tries.follows_surface = True
            for found in self._along_surface(curve, side):
                yield found, self.around(curve, np.concatenate([curve, found.places]), 0.0) or body

    def _wide(self, tries: _Tries) -> tuple[BodySurface, float]:
        """More of the body around a curve than what is near, and whether its faces look outwards, see ``side``."""
        if tries.wide is None:
            curve, disc = tries.curve, tries.plain[0]
            body = self.around(curve, curve, 0.2) or self.around(curve, np.concatenate([curve, disc.places]), 0.0)
            assert body is not None  # or there would be no plain surface
            tries.wide = body, self.side(_samples(np.concatenate([curve, disc.places]), disc.triangles), body)
        return tries.wide

    def _along_surface(self, curve: np.ndarray, side: float) -> Iterator[Disc]:
        """Surfaces that follow the faces on one side of a curve, under them, and go across where these end."""
        body = self.around(curve, curve, 1.0)
        if body is None or (body.own < 0).any() or body.crosses_itself:
            return  # what follows a surface that crosses itself does so, too
        sides = np.unique(body.labels[np.isin(body.triangles, body.own).sum(axis=1) > 1])
        for rings in _SLEEVES:
            for label in sides.tolist():
                found = sleeve(len(body.points), body.triangles, body.labels, body.own, label, rings)
                if found is not None:
                    yield from _sleeved(found, curve, body, side)

    def _is_outside(self, places: np.ndarray, triangles: np.ndarray, body: BodySurface) -> bool:
        """Whether most of a surface lies on the wrong side of a body."""
        samples = _samples(places, triangles)
        return bool(self.side(samples, body) * np.median(body.heights(samples)) > 0)

    def side(self, places: np.ndarray, body: BodySurface) -> float:
        """Whether the faces around some places, of which most should be inside, look outwards, 1, or inwards, -1.

        If most are on the other side of the faces, a closed mesh tells which of the two is wrong; else it is the faces.
        """
        if np.median(body.heights(places)) <= 0:
            return 1.0
        component, outwards = self._outwards
        return 1.0 if outwards[component[body.vertices[body.triangles[0, 0]]]] else -1.0

    @cached_property
    def _outwards(self) -> tuple[np.ndarray, np.ndarray]:
        """The loose piece that each vertex is in, (n,) int64, and which pieces are closed and look outwards, bool."""
        n, (a, b, c) = len(self._points), self._triangles.T
        count, component = vertex_components(self._triangles, n)
        own = component[a]
        p, q, r = ((self._points - self._points.mean(axis=0))[index] for index in (a, b, c))
        volume = np.bincount(own, (p * cross(q, r)).sum(axis=1), count)
        start, end = self._triangles.ravel(), np.roll(self._triangles, -1, axis=1).ravel()
        _, index, times = np.unique(edge_keys(start, end, count=n), return_index=True, return_counts=True)
        is_open = np.bincount(component[start[index[times != 2]]], minlength=count) > 0
        return component, (volume > 0) & ~is_open

    def around(self, curve: np.ndarray, places: np.ndarray, margin: float) -> BodySurface | None:
        """The surface of the mesh in the bounding box of some places, wider by such a share of its diagonal."""
        low, high = places.min(axis=0), places.max(axis=0)
        margin *= float(np.linalg.norm(high - low))
        near = self._within(low - margin, high + margin)
        return BodySurface.of(self._points, self._triangles[near], self._labels[near], curve) if len(near) else None

    def _within(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Triangles whose bounding box meets a box; (k,) int64."""
        if not len(self._triangles):
            return np.empty(0, np.int64)
        least, most = self._bounds
        rows = np.flatnonzero(((least <= high) & (most >= low)).all(axis=1))
        near = ranges(rows * _ROW, np.minimum(len(self._triangles) - rows * _ROW, _ROW))
        a, b, c = (np.take(self._points, corner, axis=0) for corner in self._triangles[near].T)
        meets = (np.minimum(np.minimum(a, b), c) <= high) & (np.maximum(np.maximum(a, b), c) >= low)
        return near[meets.all(axis=1)]

    @cached_property
    def _bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """The bounding box of each row of triangles, which are near each other in most meshes; (r, 3) float64 each."""
        first = arange(0, len(self._triangles), _ROW)
        least, most = np.empty((2, len(first), 3))
        corners = self._triangles.ravel().astype(np.intp)
        for axis, values in enumerate(self._points.T):
            of_corners = np.ascontiguousarray(values)[corners]
            least[:, axis] = np.minimum.reduceat(of_corners, 3 * first)
            most[:, axis] = np.maximum.reduceat(of_corners, 3 * first)
        return least, most


def _key(curves: Sequence[np.ndarray]) -> bytes:
    return b"|".join(curve.tobytes() for curve in curves)


def _samples(places: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """The middles of some triangles of a surface, (j, 3) float64."""
    return places[triangles[:: max(len(triangles) // _PLACES, 1)]].mean(axis=1)


@dataclass(frozen=True, eq=False)
class _Rims:
    """Closed curves in a plane.

    Attributes
    ----------
    flat : (k, 2) float64
        The points of all, those of the first before those of the second ...
    following : (k,) int64
        The point after each on its curve.
    first : int
        So many are on the first curve; the others lie within it.
    """

    flat: np.ndarray
    following: np.ndarray
    first: int

    @classmethod
    def of(cls, flat: np.ndarray, lengths: Sequence[int]) -> _Rims:
        """Curves of so many points each."""
        ends = cumsum(lengths)
        following = arange(1, len(flat) + 1)
        following[ends - 1] = ends - lengths
        return cls(flat, following, lengths[0])


def _seen(curves: Sequence[np.ndarray]) -> list[_Rims]:
    """Curves as they are seen in a plane; one alone also round a circle."""
    over = over_a_plane(curves[0], np.concatenate([curves[0][:0], *curves[1:]]))
    found = [over, in_a_circle(curves[0]) if len(curves) == 1 else None]
    return [_Rims.of(flat, [len(curve) for curve in curves]) for flat in found if flat is not None]


def _disc(curve: np.ndarray, rims: _Rims, density: float = 1.0) -> Disc | None:
    """A surface across curves by what they look like in a plane; None where they meet themselves there."""
    flat = rims.flat
    inner = away_from_curve(flat, flat[inverse(rims.following)], density)
    for _ in range(4):
        found = _triangulated(rims, inner)
        if found is None:
            return None
        triangles, used = found
        inner = inner[used]
        # An edge between two points of the curve might be there already, in this piece or in another.
        joined = _joining(triangles, len(flat))
        if not len(joined):
            weights = harmonic_weights(np.concatenate([flat, inner]), triangles)
            return Disc(triangles, spread(weights, curve), weights, rims.following)
        inner = np.concatenate([inner, flat[joined].mean(axis=1)])
    return None


def _triangulated(rims: _Rims, inner: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Triangles that fill the curves, and which inner points are inside; None if a curve meets itself or another."""
    flat, k, first = rims.flat, len(rims.flat), rims.first
    coords = np.concatenate([flat, inner])
    holes = np.stack([arange(first, k), rims.following[first:]], axis=1)
    verts, _, faces, origin, _, _ = delaunay_2d_cdt(coords.tolist(), holes.tolist(), [list(range(first))], 1, 1e-9)
    if len(verts) != len(coords) or any(len(found) != 1 for found in origin):
        return None
    name = np.array([found[0] for found in origin])
    triangles = name[np.array(faces, np.int64).reshape(-1, 3)]
    if len(holes):
        triangles = triangles[~is_inside(coords[triangles].mean(axis=1), flat[holes])]
    used = np.zeros(len(coords), bool)
    used[triangles] = True
    n_holes = int((rims.following[first:] <= arange(first, k)).sum())
    if not used[:k].all() or len(triangles) != 2 * used[k:].sum() + k - 2 + 2 * n_holes:
        return None
    a, b, c = coords[triangles].transpose(1, 0, 2)
    turn = cross_in_plane(b - a, c - a)
    place = cumsum(used) - 1
    return place[triangles if turn.sum() > 0 else triangles[:, ::-1]], used[k:]


def _joining(triangles: np.ndarray, k: int) -> np.ndarray:
    """Edges inside that join two points of the curve, (j, 2)."""
    table = EdgeTable.of(triangles)
    return table.vertices[(table.n_faces == 2) & (table.vertices < k).all(axis=1)]


def _sleeved(found: Sleeve, curve: np.ndarray, body: BodySurface, side: float) -> Iterator[Disc]:
    """Surfaces under the faces of a sleeve, closed by one across its end; if it has none, several depths are tried."""
    k = len(curve)
    vertex, on, ways = depths(found, curve, body, side)
    number = full(len(body.points) + len(found.split), -1)
    number[body.own] = arange(k)
    number[vertex] = k + arange(len(vertex))
    around = number[found.triangles]
    following = np.roll(arange(k), -1)
    edges = around[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    along = ((edges[:, 1] == following[edges[:, 0] % k]) & (edges[:, 0] < k)).any()
    around, end = (around, number[found.end[::-1]]) if along else (around[:, ::-1], number[found.end])
    weights = harmonic_weights(np.concatenate([curve, on]), around)
    if not len(end):
        yield from (Disc(around, places, weights, following) for places in ways)
        return
    places = ways[0]
    across = next(filter(None, (_disc(places[end - k], rims) for rims in _seen([places[end - k]]))), None)
    if across is not None:
        whole = _joined(Disc(around, places, weights, following), across, end)
        stays = arange(len(whole.places)) < len(places)
        yield pulled(pushed(whole, curve, body, side, stays), curve, body, side, stays)


def _joined(disc: Disc, across: Disc, rim: np.ndarray) -> Disc:
    """A surface and another one across some of its points, (j,) int64."""
    n = disc.weights.shape[0]
    name = np.concatenate([rim, n + arange(len(across.places))])
    parts = disc.weights.tocoo(), across.weights.tocoo()
    rows = np.concatenate([parts[0].coords[0], name[parts[1].coords[0]]])
    columns = np.concatenate([parts[0].coords[1], name[parts[1].coords[1]]])
    size = n + len(across.places)
    weights = coo_array((np.concatenate([part.data for part in parts]), (rows, columns)), shape=(size, size)).tocsr()
    return Disc(np.concatenate([disc.triangles, name[across.triangles]]),
                np.concatenate([disc.places, across.places]), weights, disc.following)
