# SPDX-License-Identifier: GPL-3.0-or-later
"""The mirror symmetry of a mesh's polygons as they hang together, whatever the pose: that of Blender's Topology Mirror.

A figure that was modelled with a mirror and posed has no plane of symmetry, but its polygons still have twins. Their
half-edges are told apart by what lies round them, as vertices of a graph are by color refinement [Weisfeiler1968]: once
going one way round, and once the other. A half-edge whose color is that of a single other one the other way round is
its image. From there images are found neighbor by neighbor, so that a watch on one wrist, or a border that was cut on
one side, hides nothing but itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..arrays.components import components
from ..arrays.hashes import GOLDEN
from ..arrays.int64 import arange, full
from ..arrays.pairs import distinct_pairs
from ..arrays.vectors import middles_of_each, weighted_sum
from ..mesh.half_edges import HalfEdges
from ..mesh.triangles import TriMesh
from .plane import positive_sign

MOST_POLYGONS = 50_000  # denser meshes are scans, or subdivided: each polygon is like its neighbors
# Steps from half-edge to half-edge after which colors are compared: after few of them asymmetric details hide little,
# after many more half-edges are told apart.
ROUNDS = (4, 8, 16)
# After so many rounds at least this share of the half-edges of a symmetric mesh has a color that occurs the other way
# round: of 38 posed models 0.66 and more, of scans 0 to 0.7, mostly below 0.5.
LOOK, ALIKE = 6, 0.5
COVERED = 0.75  # share of the area that must have a twin for a mesh to be symmetric
UNLIKE = 0.25  # mean difference of the logarithms of lengths of edges and images up to which two pieces are images
STRETCHED = 1.1  # the same of one edge: where a joint is bent, edges become longer or shorter
TINY = 1e-3  # in units of the mean length of edges: what is added to lengths before they are compared
ON_ITSELF = 0.05  # share of the area of regions that are their own images up to which a mesh is mirrored, not turned
# Of a region and its image the sides, -1..1, of the polygons nearest to them must differ by so much on the mean for
# the two to have sides.
BESIDE = 0.5


@dataclass(frozen=True, eq=False)
class TopologyMirror:
    """Which polygons are mirror images of each other, of p.

    Attributes
    ----------
    twin : (p,) int64
        The image of each polygon, itself for one in the middle; -1 for none.
    side : (p,) int64
        1 or -1, the side on which a polygon lies; 0 for one that is its own image, or has none. The way from side -1 to
        side 1 has a component of largest size that is positive.
    """

    twin: np.ndarray
    side: np.ndarray


def topology_mirror(mesh: TriMesh, polygon: np.ndarray, n_polygons: int) -> TopologyMirror | None:
    """Find the mirror symmetry of a mesh's polygons.

    Parameters
    ----------
    mesh : TriMesh
        Welded: m triangles.
    polygon : (m,) int64
        The polygon in which each lies, 0..n_polygons-1.
    n_polygons : int
        p.

    Returns
    -------
    mirror : TopologyMirror or None
        None if less than COVERED of the area has a twin on the other side, or if there are too many polygons.
    """
    if n_polygons > MOST_POLYGONS or not mesh.area > 0:
        return None
    half = HalfEdges.of(mesh, polygon)
    area = np.bincount(polygon, mesh.face_area, n_polygons)
    weight = area[half.polygon]
    found = [_consistent(half, partner, weight) for partner in _only_images(half)]
    if not found:
        return None
    partner = _grown(half, max(found, key=lambda known: weight[known >= 0].sum()))
    twin = _twins(half, _alike(half, partner), n_polygons)
    if area[twin >= 0].sum() < COVERED * mesh.area:
        return None
    _, middle = middles_of_each(polygon, mesh.face_centroids, mesh.face_area, n_polygons)
    return _with_sides(_Regions.of(half, twin, area), twin, area, middle)


def _only_images(half: HalfEdges) -> list[np.ndarray]:
    """The only possible image of each half-edge, (h,) int64 or -1, by what lies round it, after each of ROUNDS.

    Empty if too few have any.
    """
    start, end = half.valence
    forward, backward = _mixed(half.corners, start, end), _mixed(half.corners, end, start)
    colors = []
    for step in range(1, max(ROUNDS) + 1):
        forward, backward = (
            _mixed(forward, forward[half.following], forward[half.before], _across(half, forward)),
            _mixed(backward, backward[half.before], backward[half.following], _across(half, backward)))
        if step == LOOK and np.isin(forward, backward).mean() < ALIKE:
            return []
        if step in ROUNDS:
            colors.append((forward, backward))
    return [_paired(*of_round) for of_round in colors]


def _across(half: HalfEdges, color: np.ndarray) -> np.ndarray:
    """Color of the half-edge across each edge, (h,) uint64; 1 at borders."""
    return np.where(half.opposite >= 0, color[half.opposite], np.uint64(1))


def _mixed(*values: np.ndarray) -> np.ndarray:
    """A color of several whole numbers in their order, (h,) uint64."""
    color = np.zeros(len(values[0]), np.uint64)
    for value in values:
        color = (color ^ value.astype(np.uint64)) * GOLDEN
        color ^= color >> np.uint64(29)
    return color


def _paired(forward: np.ndarray, backward: np.ndarray) -> np.ndarray:
    """The half-edge whose color backward is each one's forward, (h,) int64, where either occurs once; else -1."""
    count = len(forward)
    # The lowest bits of each color are replaced by the number of its half-edge, so that one sort brings together those
    # of one color and tells whose they are.
    bits = np.uint64((2 * count).bit_length())
    key = np.concatenate([forward, backward]) >> bits << bits | np.arange(2 * count, dtype=np.uint64)
    key.sort()
    owner = (key & ((np.uint64(1) << bits) - np.uint64(1))).astype(np.int64)
    other_color = np.concatenate([[True], np.diff(key >> bits) != 0, [True, True]])
    two = np.flatnonzero(other_color[:-3] & ~other_color[1:-2] & other_color[2:-1])
    one, other = owner[two], owner[two + 1]
    partner = full(count, -1)
    each = (one < count) & (other >= count)
    partner[one[each]] = other[each] - count
    return partner


def _consistent(half: HalfEdges, partner: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Images, (h,), of the largest group of half-edges of each piece whose neighbors' images are neighbors; else -1.

    weight : (h,) float64, by which groups are large.
    """
    agreeing = []
    for there, image in ((half.following, half.before), (half.opposite, half.opposite)):
        here = np.flatnonzero((partner >= 0) & (there >= 0))
        here = here[(partner[there[here]] >= 0) & (partner[there[here]] == image[partner[here]])]
        agreeing.append(np.stack([here, there[here]]))
    count, group = components(half.count, *np.concatenate(agreeing, axis=1))
    size = np.bincount(group, np.where(partner >= 0, weight, 0.0), count)
    by_size = np.argsort(size, kind="stable")
    piece_of_group = np.empty(count, np.int64)
    piece_of_group[group] = half.piece
    largest = np.empty(int(half.piece.max()) + 1, np.int64)
    largest[piece_of_group[by_size]] = by_size  # NumPy keeps the last of the values written to one place
    return np.where(largest[half.piece] == group, partner, -1)


def _grown(half: HalfEdges, partner: np.ndarray) -> np.ndarray:
    """Images, (h,), found from those that are known, neighbor by neighbor, as far as both sides are alike."""
    partner = partner.copy()
    (start, end), length = half.valence, _log_length(half)
    taken = np.zeros(half.count, bool)
    front = np.flatnonzero(partner >= 0)
    taken[partner[front]] = True
    while len(front):
        image = partner[front]
        one = np.concatenate([half.following[front], half.opposite[front]])
        other = np.concatenate([half.before[image], half.opposite[image]])
        new = (one >= 0) & (other >= 0) & (partner[one] < 0) & ~taken[other]
        one, other = one[new], other[new]
        like = (half.corners[one] == half.corners[other]) & (start[one] == end[other])
        like &= np.abs(length[one] - length[other]) < STRETCHED
        front, image = _undisputed(one[like], other[like])
        partner[front], taken[image] = image, True
    return partner


def _undisputed(one: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The pairs, (k,) each, of which neither occurs in a different one: no order decides which of two holds."""
    one, other = distinct_pairs(one, other)[0].T
    times, times_of_other = np.bincount(one), np.bincount(other)
    alone = (times[one] == 1) & (times_of_other[other] == 1)
    return one[alone], other[alone]


def _log_length(half: HalfEdges) -> np.ndarray:
    """Logarithms of the lengths of half-edges, (h,) float64; very short ones are alike."""
    return np.log(half.length + TINY * half.length.mean())


def _alike(half: HalfEdges, partner: np.ndarray) -> np.ndarray:
    """Images, (h,), that are images of their own, on pieces whose edges are about as long as their images."""
    partner = np.where((partner >= 0) & (partner[partner] == arange(half.count)), partner, -1)
    has, length = np.flatnonzero(partner >= 0), _log_length(half)
    count = np.bincount(half.piece[has], minlength=int(half.piece.max()) + 1)
    unlike = np.bincount(half.piece[has], np.abs(length[has] - length[partner[has]]), len(count))
    return np.where((unlike < UNLIKE * count)[half.piece], partner, -1)


def _twins(half: HalfEdges, partner: np.ndarray, n_polygons: int) -> np.ndarray:
    """The polygon that is the image of each, (n_polygons,) int64, if all its sides say so, and that one's; else -1."""
    image = np.where(partner >= 0, half.polygon[partner], -1)
    low, high = full(n_polygons, n_polygons), full(n_polygons, -1)
    np.minimum.at(low, half.polygon, image)
    np.maximum.at(high, half.polygon, image)
    twin = np.where(low == high, low, -1)
    return np.where((twin >= 0) & (twin[twin] == arange(n_polygons)), twin, -1)


@dataclass(frozen=True, eq=False)
class _Regions:
    """What the middle divides a mesh of p polygons into: k regions.

    Attributes
    ----------
    of_polygon : (p,) int64
        Region of each polygon.
    image : (k,) int64
        Region that is the image of each, another one; -1 for none.
    area : (k,) float64
        Share of the area.
    beside : (k,) bool
        Whether a region and its image lie on one piece, on both sides of its middle.
    turned : float
        Share of the area that lies in regions that are their own images.
    """

    of_polygon: np.ndarray
    image: np.ndarray
    area: np.ndarray
    beside: np.ndarray
    turned: float

    @classmethod
    def of(cls, half: HalfEdges, twin: np.ndarray, area: np.ndarray) -> _Regions:
        """Divide a mesh. twin, area : (p,), of the polygons."""
        own = arange(len(twin))
        across = np.flatnonzero(half.opposite >= 0)
        one, other = half.polygon[across], half.polygon[half.opposite[across]]
        apart = (twin >= 0) & (twin != own)
        inner = apart[one] & apart[other] & (twin[one] != other)
        count, region = components(len(twin), one[inner], other[inner])
        share = np.bincount(region, area, count) / area.sum()
        image = full(count, -1)
        image[region[apart]] = region[twin[apart]]
        itself = image == arange(count)
        image[itself | (image[image] != arange(count))] = -1
        piece = components(len(twin), one, other)[1]
        beside = np.zeros(count, bool)
        beside[region[apart]] = piece[apart] == piece[twin[apart]]
        return cls(region, image, share, beside & (image >= 0), float(share[itself].sum()))


def _with_sides(regions: _Regions, twin: np.ndarray, area: np.ndarray, middle: np.ndarray) -> TopologyMirror | None:
    """The twins, (p,), that have sides; None if these cover too little. area, middle : (p,) and (p, 3) float64."""
    if regions.turned > ON_ITSELF or not regions.beside.any():
        return None
    first = int(np.argmax(np.where(regions.beside, regions.area, -1.0)))
    side = (regions.of_polygon == first).astype(np.int64) - (regions.of_polygon == regions.image[first])
    side = _by_nearest(side, regions, area, middle)
    twin = np.where((side != 0) | (twin == arange(len(twin))), twin, -1)
    if area[twin >= 0].sum() < COVERED * area.sum():
        return None
    way = np.asarray(weighted_sum(area * side, middle))
    return TopologyMirror(twin, int(positive_sign(way)) * side)


def _by_nearest(side: np.ndarray, regions: _Regions, area: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """The side of each polygon, (p,) int64: in other regions that of the polygons nearest to them of the first two.

    side : (p,) int64, 0 outside of the first two regions. area, middle : (p,) and (p, 3) float64, of polygons.
    """
    known = np.flatnonzero(side)
    near = side[known[cKDTree(middle[known]).query(middle)[1]]]
    of_region = np.bincount(regions.of_polygon, area, len(regions.area)) + 1e-300
    mean = np.bincount(regions.of_polygon, area * near, len(regions.area)) / of_region
    lean = np.where(regions.image >= 0, mean - mean[regions.image], 0.0)
    sure = np.where(np.abs(lean) >= BESIDE, np.sign(lean), 0.0).astype(np.int64)
    return np.where(side != 0, side, sure[regions.of_polygon])
