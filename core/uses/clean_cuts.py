# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth curves to cut along, in place of the saw teeth of the faces' edges.

Each part's share of the surface around a vertex is diffused a few edges far, so that a vertex knows how much of its
neighborhood is in which part. A vertex then is in the part with the largest share, and a curve between two parts runs
where their shares are equal: across faces, and through a point inside a face where three parts meet. Diffusing an
indicator and taking its middle level straightens a curve [Merriman1992]; the shares are shifted by what makes the
level pass through the middle of the border as it was, so that no part grows at the cost of another. Where a plane
fits the curve, the curve is the section with the plane. A curve goes through creases that the border follows.

A border that is smooth already stays along the edges of faces, and so does one whose curve would take a part away.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array, eye_array

from ..surface.arrays import components, distinct_pairs, last_of_each, renumbered, sums_by
from ..surface.corners import CornerTable
from ..surface.labels import majority

# How often shares are diffused, half an edge each time; where that goes wrong, as often as the next says.
STEPS = (10, 4, 2)
# A cut as near to a vertex as such a share of the edge goes through the vertex; in a plane, as the second says.
SNAP, SNAP_IN_PLANE = 0.15, 0.02
# A plane fits if no point of a curve is farther from it than so many edges and such a share of the curve's radius.
PLANE_EDGES, PLANE_RADIUS = 0.25, 0.04
# Along a crease faces turn by such an angle or more, and the crease itself by less than the second from edge to edge. A
# border that follows it may leave it for twice so many edges.
CREASE, STRAIGHT, GAP = np.radians(30), np.radians(45), 2
# A curve is used if it turns at most such a share of what the border along edges turns.
WORTH = 0.85


@dataclass(frozen=True, eq=False)
class CleanCuts:
    """Where faces are divided.

    Points have numbers: 0..n-1 are the vertices, n + e is the point on edge e.

    Attributes
    ----------
    edge : (k,) int64
        Edges that a curve crosses.
    share : (k,) float64
        Where, from the first vertex of the edge, 0, to the second, 1.
    face : (q,) int64
        Face of each piece, rising; faces that neither are divided nor change their part have none.
    start : (q,) int64
        Point on the outline of the face at which the piece begins, in the direction of the face's corners; it ends
        where the next piece of the face begins. Two pieces are divided by a chord, three meet inside the face.
    label : (q,) int64
        Part of each piece.
    odd : (o,) int64
        Faces of more than three corners that must be triangles before they can be divided; if there are any, divide
        these and ask again.
    planes : int
        Curves that lie in a plane.
    kept : int
        Groups of borders that stay along the edges of faces although they are not smooth, because a part would be
        lost or torn, because more than two faces meet at one of their edges, or because it was asked for.
    """

    edge: np.ndarray
    share: np.ndarray
    face: np.ndarray
    start: np.ndarray
    label: np.ndarray
    odd: np.ndarray
    planes: int = 0
    kept: int = 0


def clean_cuts(table: CornerTable, labels: np.ndarray, whole: np.ndarray | None = None) -> CleanCuts:
    """Find smooth curves along the borders between parts.

    Parameters
    ----------
    table : CornerTable
        n vertices, p faces. Any topology; borders where more than two faces meet at an edge are left alone.
    labels : (p,) int64
        Part of each face, 0 or more.
    whole : (e,) bool, optional
        Edges at which borders are to stay along edges, with all the borders that are connected with them.

    Returns
    -------
    cuts : CleanCuts
        The same for any numbers of vertices and faces, but for rounding.

    Notes
    -----
    O(n) to find what lies near the borders; all else is for that only.
    """
    band = _Band.of(table, labels, max(STEPS) + 2)
    if band is None:
        return CleanCuts(*(np.empty(0, kind) for kind in (np.int64, float, np.int64, np.int64, np.int64, np.int64)))
    taken = np.zeros(len(band.vertices), bool)
    failed = taken
    found: list[CleanCuts] = []
    pins = _Pins.of(band)
    low, high = band.edge_labels()
    borders = np.unique(band.ends[low < high])
    for steps in STEPS:
        if taken[borders].all():
            break
        sides = _sides(band, pins, steps)
        division = _divide(band, sides)
        group, good, broken = _judged(band, sides, division)
        if whole is not None:
            asked = group[band.ends[(low < high) & whole[band.edges]]]
            broken[asked], good[asked] = True, False
        # What is chosen must not come near a curve that has been chosen before.
        good[np.unique(group[taken & (group >= 0)])] = False
        used = (group >= 0) & good[group]
        found.append(_chosen(band, sides, division, used))
        taken |= used
        failed = (group >= 0) & broken[group] & ~taken
    return _together(band, found, failed)


@dataclass(frozen=True, eq=False)
class _Band:
    """The faces near the borders between parts, with numbers of their own.

    Attributes
    ----------
    n_vertices : int
        Of the whole mesh.
    vertices, edges, faces : (v,), (e,), (f,) int64
        Those of the mesh that are in the band.
    points : (v, 3) float64
    ends : (e, 2) int64
    corner_vertex, corner_edge, corner_face : (c,) int64
    labels : (f,) int64
        0..n_labels-1.
    names : (n_labels,) int64
        The label in the mesh.
    """

    n_vertices: int
    vertices: np.ndarray
    edges: np.ndarray
    faces: np.ndarray
    points: np.ndarray
    ends: np.ndarray
    corner_vertex: np.ndarray
    corner_edge: np.ndarray
    corner_face: np.ndarray
    labels: np.ndarray
    names: np.ndarray

    @classmethod
    def of(cls, table: CornerTable, labels: np.ndarray, rings: int) -> _Band | None:
        """The faces less than so many faces away from a border between parts; None without a border."""
        low, high = table.edge_labels(labels)
        cut = low < high
        if not cut.any():
            return None
        near = np.zeros(len(table.vertices), bool)
        near[table.edges[cut]] = True
        for _ in range(rings):
            inside = np.zeros(table.n_faces, bool)
            inside[table.corner_face[near[table.corner_vertex]]] = True
            corner = inside[table.corner_face]
            near[table.corner_vertex[corner]] = True
        vertices, corner_vertex = renumbered(table.corner_vertex[corner])
        edges, corner_edge = renumbered(table.corner_edge[corner])
        faces, corner_face = renumbered(table.corner_face[corner])
        names, own = renumbered(labels[faces])
        ends = np.searchsorted(vertices, table.edges[edges])
        return cls(len(table.vertices), vertices, edges, faces, table.vertices[vertices], ends, corner_vertex,
                   corner_edge, corner_face, own, names)

    @property
    def n_corners(self) -> np.ndarray:
        """(f,) int64, of each face."""
        return np.bincount(self.corner_face, minlength=len(self.faces))

    @property
    def following(self) -> np.ndarray:
        """(c,) int64, the next corner of the face of each corner."""
        return _next(self.corner_face)

    def edge_labels(self) -> tuple[np.ndarray, np.ndarray]:
        """Smallest and largest label at each edge, (e,) int64 each."""
        low = np.full(len(self.edges), len(self.names))
        high = np.full(len(self.edges), -1)
        np.minimum.at(low, self.corner_edge, self.labels[self.corner_face])
        np.maximum.at(high, self.corner_edge, self.labels[self.corner_face])
        return low, high

    def triangles(self) -> tuple[np.ndarray, np.ndarray]:
        """A fan of triangles for each face: (t, 3) vertices, and the face of each, (t,)."""
        count = self.n_corners
        first = np.cumsum(count) - count
        face = np.repeat(np.arange(len(count)), count - 2)
        step = np.arange(len(face)) - np.repeat(np.cumsum(count - 2) - (count - 2), count - 2)
        corners = np.stack([first[face], first[face] + step + 1, first[face] + step + 2], axis=1)
        return self.corner_vertex[corners], face

    def normals(self) -> np.ndarray:
        """Normal of each face as long as its area, (f, 3)."""
        triangles, face = self.triangles()
        a, b, c = self.points[triangles].transpose(1, 0, 2)
        return sums_by(face, 0.5 * np.cross(b - a, c - a), len(self.faces))

    def edge_length(self) -> np.ndarray:
        """(e,) float64."""
        return np.linalg.norm(self.points[self.ends[:, 0]] - self.points[self.ends[:, 1]], axis=1)


def _next(owner: np.ndarray) -> np.ndarray:
    """Index of the next element of the same owner, in a circle; owners rise. (c,) int64."""
    count = np.bincount(owner)
    following = np.arange(1, len(owner) + 1)
    last = np.cumsum(count)[count > 0] - 1
    following[last] = last - count[count > 0] + 1
    return following


@dataclass(frozen=True, eq=False)
class _Sides:
    """In which part each vertex is, and where curves cross edges.

    Attributes
    ----------
    low, high : (v,) int64
        The label of the vertex; two labels if a curve goes through it.
    share : (e,) float64
        Where a curve crosses the edge; nan where none does.
    plane : (v,) int64
        Number of the plane of the curve nearby, -1 for none.
    """

    low: np.ndarray
    high: np.ndarray
    share: np.ndarray
    plane: np.ndarray


@dataclass(frozen=True, eq=False)
class _Pins:
    """Vertices that curves go through, because borders follow a crease there.

    Attributes
    ----------
    vertex : (k,) int64
    pair : (k, 2) int64
        The two labels that meet there, the lower first.
    """

    vertex: np.ndarray
    pair: np.ndarray

    @classmethod
    def of(cls, band: _Band) -> _Pins:
        """The vertices of creases that borders follow, also where they leave one for a few edges."""
        low, high = band.edge_labels()
        sharp = _sharp(band)
        both = np.flatnonzero(sharp & (low < high))
        point, angle = turning(band.points, band.ends[both])
        ends = band.ends[both].ravel()
        pair = np.full((2, len(band.vertices)), -1)
        other = pair.copy()
        for pairs, order in ((pair, slice(None)), (other, slice(None, None, -1))):
            pairs[:, ends[order]] = np.repeat(np.stack([low[both], high[both]]), 2, axis=1)[:, order]
        sure = np.zeros(len(band.vertices), bool)
        sure[point[angle < STRAIGHT]] = True
        sure &= (pair == other).all(axis=0)
        pair[:, ~sure] = -1
        member = sure.copy()
        a, b = np.concatenate([band.ends[sharp], band.ends[sharp][:, ::-1]]).T
        for _ in range(GAP):
            reached = member[a] & ~member[b]
            pair[:, b[reached]] = pair[:, a[reached]]
            member[b[reached]] = True
        for _ in range(GAP):
            outside = np.zeros(len(member), bool)
            outside[a[~member[b]]] = True
            member &= sure | ~outside
        vertex = np.flatnonzero(member)
        return cls(vertex, pair[:, vertex].T)


def _sharp(band: _Band) -> np.ndarray:
    """Whether the two faces at each edge turn by the angle of a crease, (e,) bool."""
    normal = band.normals()
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    order = np.argsort(band.corner_edge, kind="stable")
    edge, face = band.corner_edge[order], band.corner_face[order]
    two = np.flatnonzero((edge[1:] == edge[:-1]) & (np.bincount(edge)[edge[1:]] == 2))
    sharp = np.zeros(len(band.edges), bool)
    sharp[edge[two]] = (normal[face[two]] * normal[face[two + 1]]).sum(axis=1) < np.cos(CREASE)
    return sharp


def _sides(band: _Band, pins: _Pins, steps: int) -> _Sides:
    """The sides of smooth curves after so many steps of diffusion."""
    shares = _diffused(band, pins, steps)
    top = shares.top
    a, b = band.ends.T
    share = np.full(len(a), np.nan)
    apart = np.flatnonzero(top[a] != top[b])
    share[apart] = shares.crossing(band.ends[apart])
    planes = _planes(band, top, share, steps)
    top = np.where(planes.number >= 0, np.where(planes.height > 0, planes.above, planes.below), top)
    flat = (planes.number[a] >= 0) & (planes.number[a] == planes.number[b])
    gap = planes.height[a] - planes.height[b]
    along = np.divide(planes.height[a], gap, out=np.full(len(a), 0.5), where=gap != 0)
    share = np.where(top[a] != top[b], np.where(flat, along, share), np.nan)
    return _snapped(band, pins, top, share, np.where(flat, SNAP_IN_PLANE, SNAP), planes.number)


@dataclass(frozen=True, eq=False)
class _Shares:
    """How much of the surface around each vertex is in each part: an entry for each vertex and part nearby.

    Attributes
    ----------
    n_labels : int
    key : (s,) int64
        Vertex times n_labels plus label, rising.
    value : (s,) float64
    """

    n_labels: int
    key: np.ndarray
    value: np.ndarray

    def of(self, vertex: np.ndarray, label: np.ndarray) -> np.ndarray:
        """Shares of some vertices in some parts, (k,) float64."""
        key = vertex * self.n_labels + label
        place = np.minimum(np.searchsorted(self.key, key), len(self.key) - 1)
        return np.where(self.key[place] == key, self.value[place], 0.0)

    @property
    def top(self) -> np.ndarray:
        """(v,) int64, the label with the largest share at each vertex."""
        vertex, label = np.divmod(self.key, self.n_labels)
        return label[last_of_each(vertex, self.value, -label, count=int(vertex[-1]) + 1)]

    def crossing(self, ends: np.ndarray) -> np.ndarray:
        """Where between two vertices of different parts their shares are equal, (k,) float64 in 0..1.

        ends : (k, 2) int64.
        """
        a, b = self.top[ends].T
        first = self.of(ends[:, 0], a) - self.of(ends[:, 0], b)
        second = self.of(ends[:, 1], b) - self.of(ends[:, 1], a)
        total = first + second
        return np.divide(first, total, out=np.full(len(ends), 0.5), where=total > 0).clip(0.0, 1.0)


def _diffused(band: _Band, pins: _Pins, steps: int) -> _Shares:
    """Shares after so many steps, with the middle of each border where it was."""
    triangles, face = band.triangles()
    a, b, c = band.points[triangles].transpose(1, 0, 2)
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    area += 1e-6 * area.mean()
    shape = (len(band.vertices), len(band.names))
    label = np.repeat(band.labels[face], 3)
    shares = coo_array((np.repeat(area, 3), (triangles.ravel(), label)), shape=shape).tocsr()
    shares = _rows_to_one(shares)
    # What is pinned stays half and half, and nothing diffuses across it.
    moving = np.ones(shape[0])
    moving[pins.vertex] = 0.0
    held = np.repeat(pins.vertex, 2), pins.pair.ravel()
    halves = coo_array((np.full(len(held[0]), 0.5), held), shape=shape).tocsr()
    moving = diags_array(moving).tocsr()
    walk = moving @ _walk(band, triangles)
    shares = moving @ shares + halves
    for _ in range(steps):
        shares = walk @ shares + halves
    shares.sort_indices()
    vertex = np.repeat(np.arange(shape[0]), np.diff(shares.indptr))
    key = vertex * shape[1] + shares.indices
    found = _Shares(shape[1], key, shares.data)
    return replace(found, value=shares.data + _shifts(band, found)[shares.indices])


def _rows_to_one(matrix: csr_array) -> csr_array:
    """The matrix with each row divided by its sum."""
    total = matrix.sum(axis=1)
    return csr_array((matrix.data / np.repeat(total, np.diff(matrix.indptr)), matrix.indices, matrix.indptr),
                     shape=matrix.shape)


def _walk(band: _Band, triangles: np.ndarray) -> csr_array:
    """One step of diffusion, (v, v): to neighbors by the cotangents of the angles that face the edges."""
    rows, columns, weights = [], [], []
    for i in range(3):
        apex, p, q = (triangles[:, (i + k) % 3] for k in range(3))
        u, v = band.points[p] - band.points[apex], band.points[q] - band.points[apex]
        across = np.linalg.norm(np.cross(u, v), axis=1)
        cotangent = np.divide((u * v).sum(axis=1), across, out=np.zeros(len(u)), where=across > 0).clip(-10, 10)
        rows += [p, q]
        columns += [q, p]
        weights += [cotangent, cotangent]
    n = len(band.vertices)
    matrix = coo_array((np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns))), shape=(n, n)).tocsr()
    # Where angles are obtuse a weight could be negative, and shares would not stay between 0 and 1.
    matrix.data = np.maximum(matrix.data, 0.05)
    return (0.5 * eye_array(n) + 0.5 * _rows_to_one(matrix)).tocsr()


def _shifts(band: _Band, shares: _Shares) -> np.ndarray:
    """What to add to the shares of each part so that on average they are equal on the borders, (n_labels,)."""
    low, high = band.edge_labels()
    cut = np.flatnonzero(low < high)
    ends, length = band.ends[cut], band.edge_length()[cut]
    pairs, pair = distinct_pairs(low[cut], high[cut])
    gap = sum(shares.of(end, low[cut]) - shares.of(end, high[cut]) for end in ends.T) / 2
    total = sums_by(pair, length, len(pairs))
    total[total == 0] = 1.0
    mean = sums_by(pair, length * gap, len(pairs)) / total
    # As nearly as all borders allow, the shorter ones less.
    system = np.zeros((len(pairs), len(band.names)))
    weight = np.sqrt(total / total.max())
    system[np.arange(len(pairs)), pairs[:, 0]] = -weight
    system[np.arange(len(pairs)), pairs[:, 1]] = weight
    return np.linalg.lstsq(system, weight * mean, rcond=None)[0]


@dataclass(frozen=True, eq=False)
class _Planes:
    """Planes that curves lie in, near these curves.

    Attributes
    ----------
    number : (v,) int64
        Plane of the curve near each vertex, -1 for none.
    height : (v,) float64
        Distance of the vertex from it, with sign.
    above, below : (v,) int64
        Labels on the sides where the height is above 0, and where it is not.
    """

    number: np.ndarray
    height: np.ndarray
    above: np.ndarray
    below: np.ndarray


def _planes(band: _Band, top: np.ndarray, share: np.ndarray, steps: int) -> _Planes:
    """Find the curves that a plane fits, and the vertices for which it decides."""
    n = len(band.vertices)
    crossed = np.flatnonzero(~np.isnan(share))
    if not len(crossed):
        none = np.full(n, -1)
        return _Planes(none, np.zeros(n), none, none)
    curve = _curves(band, crossed)
    count = curve.max() + 1
    a, b = band.ends[crossed].T
    point = band.points[a] + share[crossed, None] * (band.points[b] - band.points[a])
    center = sums_by(curve, point, count) / np.bincount(curve, minlength=count)[:, None]
    offset = point - center[curve]
    moments = sums_by(curve, (offset[:, :, None] * offset[:, None]).reshape(-1, 9), count).reshape(-1, 3, 3)
    size, axes = np.linalg.eigh(moments / np.bincount(curve)[:, None, None])
    normal = axes[:, :, 0]
    length = sums_by(curve, band.edge_length()[crossed], count) / np.bincount(curve)
    away = np.zeros(count)
    np.maximum.at(away, curve, np.abs((offset * normal[curve]).sum(axis=1)))
    pair = np.sort(np.stack([top[a], top[b]], axis=1), axis=1)
    low, high = np.full((count, 2), len(band.names)), np.full((count, 2), -1)
    np.minimum.at(low, curve, pair)
    np.maximum.at(high, curve, pair)
    fits = (low == high).all(axis=1) & (size[:, 1] > 0.01 * size[:, 2]) & (np.bincount(curve) >= 6)
    fits &= away <= PLANE_EDGES * length + PLANE_RADIUS * np.sqrt(size.sum(axis=1).clip(0))
    rings = np.where(fits, np.ceil(away / np.maximum(length, 1e-300)).clip(max=steps) + 2, 0).astype(np.int64)
    number, ring = _owners(band, crossed, curve, rings)
    height = ((band.points - center[number]) * normal[number]).sum(axis=1)
    planes = _Planes(number, height, low[number, 0], low[number, 1])
    return _valid(band, top, crossed, curve, planes, ring, rings, fits)


def _curves(band: _Band, crossed: np.ndarray) -> np.ndarray:
    """Number of the curve that each of some crossed edges is on, 0..; curves go on across faces."""
    place = np.full(len(band.edges), -1)
    place[crossed] = np.arange(len(crossed))
    corner = np.flatnonzero(place[band.corner_edge] >= 0)
    point, face = place[band.corner_edge[corner]], band.corner_face[corner]
    same = face[1:] == face[:-1]
    return components(len(crossed), point[1:][same], point[:-1][same])[1]


def _owners(band: _Band, crossed: np.ndarray, curve: np.ndarray, rings: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The curve that each vertex is near, -1 for none, and how many edges away it is; (v,) int64 each.

    rings : (curves,) int64, how many edges each curve reaches; one of 0 has no vertices but those at its edges.
    """
    number, ring = np.full(len(band.vertices), -1), np.zeros(len(band.vertices), np.int64)
    number[band.ends[crossed]] = curve[:, None]
    start, end = np.concatenate([band.ends, band.ends[:, ::-1]]).T
    for step in range(1, int(rings.max(initial=0)) + 1):
        here = (number[start] >= 0) & (number[end] < 0)
        here[here] = (ring[start[here]] == step - 1) & (rings[number[start[here]]] >= step)
        # Of several curves that come to a vertex at once, the first.
        reached, owner = end[here], number[start[here]]
        order = np.lexsort((-owner, reached))
        number[reached[order]] = owner[order]
        ring[reached] = step
    return number, ring


def _valid(band: _Band, top: np.ndarray, crossed: np.ndarray, curve: np.ndarray, planes: _Planes, ring: np.ndarray,
           rings: np.ndarray, fits: np.ndarray) -> _Planes:
    """The planes without those that go wrong: near another curve, or where labels beyond are not as the plane says."""
    number, height = planes.number, planes.height
    owned = number >= 0
    bad = ~fits
    # The side of each plane that is above is the one where most vertices of the smaller label are.
    lean = np.where(top == planes.above, 1.0, -1.0) * np.sign(height)
    sign = np.where(sums_by(number[owned], lean[owned], len(fits)) < 0, -1.0, 1.0)
    height = np.where(owned, height * sign[number], 0.0)
    strange = owned & (top != planes.above) & (top != planes.below)
    said = np.where(height > 0, planes.above, planes.below)
    strange |= owned & (ring == rings[number]) & (top != said)
    bad[number[strange]] = True
    a, b = band.ends.T
    meet = owned[a] & owned[b] & (number[a] != number[b])
    bad[number[a[meet]]] = bad[number[b[meet]]] = True
    other = number[band.ends[crossed]] != curve[:, None]
    bad[number[band.ends[crossed]][other]] = True
    bad[curve[other.any(axis=1)]] = True
    number = np.where(owned & ~bad[number], number, -1)
    return replace(planes, number=number, height=height)


def _snapped(band: _Band, pins: _Pins, top: np.ndarray, share: np.ndarray, near: np.ndarray,
             plane: np.ndarray) -> _Sides:
    """Let a curve go through the vertices that it passes closely, if only two parts are there.

    near : (e,) float64, how closely.
    """
    n = len(band.vertices)
    a, b = band.ends.T
    apart = top[a] != top[b]
    start, end = np.concatenate([band.ends[apart], band.ends[apart][:, ::-1]]).T
    least, most = np.full(n, len(band.names)), np.full(n, -1)
    np.minimum.at(least, start, top[end])
    np.maximum.at(most, start, top[end])
    close = np.zeros(n, bool)
    with np.errstate(invalid="ignore"):
        close[a[share < near]] = True
        close[b[share > 1 - near]] = True
    through = close & (least == most)
    low = np.where(through, np.minimum(top, least), top)
    high = np.where(through, np.maximum(top, most), top)
    low[pins.vertex], high[pins.vertex] = np.where(_between(band, pins, top)[:, None], pins.pair,
                                                   top[pins.vertex][:, None]).T
    meet = (low[a] == low[b]) | (low[a] == high[b]) | (high[a] == low[b]) | (high[a] == high[b])
    # Where the curve could not be let through the vertex, it stays away from it by a little.
    share = np.where(meet, np.nan, share.clip(0.02, 0.98))
    return _Sides(low, high, share, plane)


def _between(band: _Band, pins: _Pins, top: np.ndarray) -> np.ndarray:
    """Whether all neighbors of each pinned vertex are in one of its two parts, (k,) bool."""
    place = np.full(len(band.vertices), -1)
    place[pins.vertex] = np.arange(len(pins.vertex))
    start, end = np.concatenate([band.ends, band.ends[:, ::-1]]).T
    start, end = start[place[start] >= 0], end[place[start] >= 0]
    strange = (pins.pair[place[start]] != top[end][:, None]).all(axis=1)
    fine = np.ones(len(pins.vertex), bool)
    fine[place[start[strange]]] = False
    return fine


@dataclass(frozen=True, eq=False)
class _Division:
    """The outlines of the faces taken apart where a curve enters or leaves a face.

    A portion is a stretch of an outline from one point to the next: from corner to corner, or to a crossed edge's
    point. Points have numbers: 0..v-1 are the vertices, v + e is the point on edge e, v + e + f that inside face f.

    Attributes
    ----------
    face : (o,) int64
        Face of each portion, rising.
    point : (o,) int64
        Where the portion begins; it ends where the next one of its face does.
    side : (o,) int64
        Edge and half of it, the same for the portions of the faces that meet there.
    label : (o,) int64
        Part on the side of the face.
    begins : (o,) bool
        Whether the piece of the face that the portion is part of begins here.
    piece : (o,) int64
        Which piece, in the order of where they begin.
    odd : (f,) bool
        Faces that have to be triangles before they can be divided.
    """

    face: np.ndarray
    point: np.ndarray
    side: np.ndarray
    label: np.ndarray
    begins: np.ndarray
    piece: np.ndarray
    odd: np.ndarray


def _divide(band: _Band, sides: _Sides) -> _Division:
    """Divide the faces by the sides that their corners are on."""
    face, point, side, low, high = _portions(band, sides)
    label = _decided(band, face, low, high)
    before = np.empty(len(face), np.int64)
    before[_next(face)] = np.arange(len(face))
    changes = label != label[before]
    count = np.bincount(face[changes], minlength=len(band.faces))
    # A piece that is one portion only would lie between the portion and itself: the face stays whole.
    thin = changes & changes[_next(face)]
    slim = (count == 2) & (np.bincount(face[thin], minlength=len(count)) > 0)
    odd = (count > 1) & ~slim & (band.n_corners > 3) & (~_convex(band) | (count > 3))
    whole = slim | odd | (count > 3)
    label = np.where(whole[face], _most(band, face, label, len(count))[face], label)
    changes &= ~whole[face]
    begins = changes | ((np.bincount(face[changes], minlength=len(count)) == 0)[face] & (face != np.roll(face, 1)))
    if len(face) and (face == face[0]).all():
        begins[0] |= not changes.any()
    last = np.searchsorted(face[begins], np.arange(len(count)), side="right") - 1
    piece = np.cumsum(begins) - 1
    wrapped = (piece < 0) | (face[np.flatnonzero(begins)[piece]] != face)
    return _Division(face, point, side, label, begins, np.where(wrapped, last[face], piece), odd)


def _portions(band: _Band, sides: _Sides) -> tuple[np.ndarray, ...]:
    """Face, first point, side and the one or two labels, the lower first, of each portion, (o,) int64 each."""
    n, crossed = len(band.vertices), ~np.isnan(sides.share)
    corner, following = np.arange(len(band.corner_face)), band.following
    here, there = band.corner_vertex, band.corner_vertex[following]
    cut = crossed[band.corner_edge]
    forward = band.ends[band.corner_edge, 0] == here
    low_here, high_here, low_there, high_there = sides.low[here], sides.high[here], sides.low[there], sides.high[there]
    first_common = (low_here == low_there) | (low_here == high_there)
    second_common = (high_here == low_there) | (high_here == high_there)
    low = np.where(cut | first_common, low_here, high_here)
    high = np.where(cut | second_common, high_here, low_here)
    order = np.argsort(np.concatenate([2 * corner, 2 * corner[cut] + 1]), kind="stable")
    edge = band.corner_edge
    columns = (
        (band.corner_face, band.corner_face[cut]),
        (here, n + edge[cut]),
        (2 * edge + (cut & ~forward), 2 * edge[cut] + forward[cut]),
        (low, low_there[cut]),
        (high, high_there[cut]),
    )
    return tuple(np.concatenate(column)[order].astype(np.int64) for column in columns)


def _decided(band: _Band, face: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """One label for each portion: along a curve that of two which more of the face's other portions have, (o,)."""
    open_ = low < high
    if not open_.any():
        return low
    width = len(band.names)
    key, count = np.unique(face[~open_] * width + low[~open_], return_counts=True)

    def number(label: np.ndarray) -> np.ndarray:
        wanted = face * width + label
        place = np.minimum(np.searchsorted(key, wanted), max(len(key) - 1, 0))
        own = 0.5 * (band.labels[face] == label)  # of equal ones, what the face was before
        return own + (np.where(key[place] == wanted, count[place], 0) if len(key) else 0)

    return np.where(open_ & (number(high) > number(low)), high, low)


def _most(band: _Band, face: np.ndarray, label: np.ndarray, n_faces: int) -> np.ndarray:
    """The label of most portions of each face, of equal ones that of the face before, (f,) int64."""
    own = 0.5 * (label == band.labels[face]) / np.maximum(np.bincount(face, minlength=n_faces), 1)[face]
    return majority(face, label, 1.0 + own, n_faces)


def _convex(band: _Band) -> np.ndarray:
    """Whether each face has no corner that is turned in, (f,) bool."""
    if (band.n_corners == 3).all():
        return np.ones(len(band.faces), bool)
    ahead = band.points[band.corner_vertex[band.following]] - band.points[band.corner_vertex]
    behind = np.empty_like(ahead)
    behind[band.following] = ahead
    turn = (np.cross(behind, ahead) * band.normals()[band.corner_face]).sum(axis=1)
    inward = np.zeros(len(band.faces), bool)
    inward[band.corner_face[turn <= 0]] = True
    return ~inward


def _judged(band: _Band, sides: _Sides, division: _Division) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Put together what must be divided or left as a whole, and find what is better divided.

    Returns
    -------
    group : (v,) int64
        Group of each vertex of a face that is at a border before or after; -1 of others.
    good : (groups,) bool
        Whether the curves of the group turn less than its borders do, and no part is lost or torn by them.
    broken : (groups,) bool
        Whether a part would be lost or torn, or the borders branch into several surfaces.
    """
    low, high = band.edge_labels()
    faces = np.zeros(len(band.faces), bool)
    faces[band.corner_face[(low < high)[band.corner_edge]]] = True
    several = np.bincount(division.face[division.begins], minlength=len(faces)) > 1
    faces |= several
    faces[division.face[division.label != band.labels[division.face]]] = True
    group = _groups(band, faces)
    before = _turning_by(group, band, low < high)
    after = _turning_after(group, band, sides, division)
    broken = np.zeros(len(before), bool)
    branching = (low < high) & (np.bincount(band.corner_edge, minlength=len(low)) > 2)
    broken[group[band.ends[branching]]] = True
    here = (faces & _torn(band, division))[band.corner_face]
    broken[group[band.corner_vertex[here]]] = True
    return group, (after <= WORTH * before) & ~broken, broken


def _groups(band: _Band, faces: np.ndarray) -> np.ndarray:
    """Connected groups of faces that share vertices: number of the group of each vertex, -1 for none, (v,) int64."""
    corner = np.flatnonzero(faces[band.corner_face])
    used, vertex = renumbered(band.corner_vertex[corner])
    same = band.corner_face[corner[1:]] == band.corner_face[corner[:-1]]
    _, label = components(len(used), vertex[1:][same], vertex[:-1][same])
    group = np.full(len(band.vertices), -1)
    group[used] = label
    return group


def turning(points: np.ndarray, segments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Measure by how much curves of straight segments turn at their points.

    Parameters
    ----------
    points : (n, 3) float64
    segments : (s, 2) int64
        Ends of each segment.

    Returns
    -------
    point : (k,) int64
        Points where two segments meet; where more do, curves end.
    angle : (k,) float64
        By how much the direction changes there, in radians.
    """
    ends = segments.ravel()
    order = np.argsort(ends, kind="stable")
    count = np.bincount(ends, minlength=len(points))
    point = np.flatnonzero(count == 2)
    place = np.cumsum(count)[point] - 2
    other = segments[:, ::-1].ravel()[order]
    back, ahead = points[point] - points[other[place]], points[other[place + 1]] - points[point]
    angle = np.arctan2(np.linalg.norm(np.cross(back, ahead), axis=1), (back * ahead).sum(axis=1))
    return point, angle


def _turning_by(group: np.ndarray, band: _Band, cut: np.ndarray) -> np.ndarray:
    """How much the cut edges of each group turn, (groups,) float64."""
    point, angle = turning(band.points, band.ends[cut])
    return np.bincount(group[point], angle, int(group.max(initial=-1)) + 1)


def _turning_after(group: np.ndarray, band: _Band, sides: _Sides, division: _Division) -> np.ndarray:
    """How much the curves of each group turn, (groups,) float64."""
    n, edges = len(band.vertices), len(band.ends)
    a, b = band.ends.T
    at = np.nan_to_num(sides.share, nan=0.5)[:, None]
    crossings = (1 - at) * band.points[a] + at * band.points[b]
    points = np.concatenate([band.points, crossings, np.zeros((len(band.faces), 3))])
    segments, inner = _segments(band, division)
    middle = sums_by(inner[:, 0], points[inner[:, 1]], len(band.faces))
    points[n + edges :] = middle / np.maximum(np.bincount(inner[:, 0], minlength=len(middle)), 1)[:, None]
    first = np.zeros(len(band.faces), np.int64)
    first[band.corner_face] = band.corner_vertex
    vertex = np.concatenate([np.arange(n), a, first])
    point, angle = turning(points, segments)
    of = group[vertex[point]]
    return np.bincount(of[of >= 0], angle[of >= 0], int(group.max(initial=-1)) + 1)


def _segments(band: _Band, division: _Division) -> tuple[np.ndarray, np.ndarray]:
    """What curves consist of, (s, 2) points, and the faces with a point inside, each with its marks, (m, 2)."""
    start = division.point[division.begins]
    face = division.face[division.begins]
    count = np.bincount(face, minlength=len(band.faces))
    two = count[face] == 2
    chords = start[two].reshape(-1, 2)
    three = count[face] == 3
    inner = np.stack([face[three], start[three]], axis=1)
    spokes = np.stack([len(band.vertices) + len(band.ends) + face[three], start[three]], axis=1)
    order = np.argsort(division.side, kind="stable")
    same = division.side[order[1:]] == division.side[order[:-1]]
    one, other = order[:-1][same], order[1:][same]
    along = one[division.label[one] != division.label[other]]
    stretch = np.stack([division.point[along], division.point[_next(division.face)[along]]], axis=1)
    return np.concatenate([chords, spokes, stretch]), inner


def _torn(band: _Band, division: _Division) -> np.ndarray:
    """Faces of parts that are lost, and faces in what is torn off a part, (f,) bool."""
    order = np.argsort(division.side, kind="stable")
    same = division.side[order[1:]] == division.side[order[:-1]]
    one, other = order[:-1][same], order[1:][same]
    a, b = division.face[one], division.face[other]
    kept = band.labels[a] == band.labels[b]
    count, before = components(len(band.faces), a[kept], b[kept])
    name = np.zeros(count, np.int64)
    name[before] = band.labels
    n_before = np.bincount(name, minlength=len(band.names))
    label = division.label[division.begins]
    kept = division.label[one] == division.label[other]
    count, after = components(len(label), division.piece[one[kept]], division.piece[other[kept]])
    name = np.zeros(count, np.int64)
    name[after] = label
    # Of each part as many of the largest as there were before are what is left of it; others are torn off.
    size = np.bincount(after, minlength=count)
    order = np.lexsort((np.arange(count), -size, name))
    first = np.searchsorted(name[order], name[order])
    off = np.zeros(count, bool)
    off[order] = np.arange(count) - first >= n_before[name[order]]
    torn = (np.bincount(name, minlength=len(band.names)) == 0)[band.labels]
    torn[division.face[off[after[division.piece]]]] = True
    return torn


def _chosen(band: _Band, sides: _Sides, division: _Division, used: np.ndarray) -> CleanCuts:
    """What is divided around some vertices, (v,) bool, in numbers of the whole mesh."""
    vertex = np.concatenate([band.vertices, band.n_vertices + band.edges])
    active = np.zeros(len(band.faces), bool)
    changed = division.label != band.labels[division.face]
    several = np.bincount(division.face[division.begins], minlength=len(active)) > 1
    active[division.face[changed]] = True
    active |= several
    inside = np.ones(len(active), bool)
    inside[band.corner_face[~used[band.corner_vertex]]] = False
    active &= inside
    begins = division.begins & active[division.face]
    edge = np.flatnonzero(~np.isnan(sides.share) & used[band.ends].all(axis=1))
    planes = np.unique(sides.plane[used & (sides.plane >= 0)])
    return CleanCuts(band.edges[edge], sides.share[edge], band.faces[division.face[begins]],
                     vertex[division.point[begins]], band.names[division.label[begins]],
                     band.faces[division.odd & inside], len(planes))


def _together(band: _Band, found: list[CleanCuts], failed: np.ndarray) -> CleanCuts:
    """One answer of several, and how many groups of borders are at vertices that failed, (v,) bool."""
    low, high = band.edge_labels()
    left = (low < high) & failed[band.ends].all(axis=1)
    _, vertex = renumbered(band.ends[left])
    kept = components(int(vertex.max(initial=-1)) + 1, vertex[:, 0], vertex[:, 1])[0] if left.any() else 0
    columns = {name: np.concatenate([getattr(one, name) for one in found])
               for name in ("edge", "share", "face", "start", "label", "odd")}
    order = np.argsort(columns["face"], kind="stable")
    for name in ("face", "start", "label"):
        columns[name] = columns[name][order]
    return CleanCuts(**columns, planes=sum(one.planes for one in found), kept=kept)
