# SPDX-License-Identifier: GPL-3.0-or-later
"""Grounds: that on which, or before or in which, the rest of a mesh stands, such as a floor, a plinth or a collider.

A floor has most of the area of a mesh, and beside it whatever stands on it is too small to be cut: a person on a floor
three times as wide was one part. So a ground is left out before anything is measured, and is a part of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays.hashes import hashed_rows
from ..arrays.indexing import place_among, spread_evenly, taken
from ..arrays.vectors import box_diagonal, cross, inner_products, lengths, row_products, second_moments, weighted_sum
from .copies import find_copies
from .polygons import MIN_FACES, PolygonMesh
from .terrain import WIDER as WIDER_TERRAIN
from .terrain import outline_area, rising_faces
from .triangles import TriMesh

if TYPE_CHECKING:
    from scipy.spatial import ConvexHull

# A ground has at least this share of the area, and the rest at least a millionth.
SHARE, LEAST = 0.2, 1e-6
# Its two long sides are not shorter than those of the rest and, multiplied, so many times as large. Of no more than a
# share of the faces that is all: a backdrop, a dome, a room.
WIDER, FEW_FACES = 3.0, 0.05
# Otherwise these are the sides that lie across, and it is flat: its points are spread about its plane less than within
# it by the first of these, or by the second with few faces. Doors and shields are slabs of many.
SHEET, SLAB = 0.05, 0.4
SHEET_BELOW_FEET = 0.25  # if something stands on several feet on it, and is one surface with it
# The rest is so high then, at least, in units of the root of the area of its outline, seen from above, and no more than
# a share of its area is on the other side: hands lie on a clock, and a vase stands on a table, which is no ground.
HIGH, BELOW = 0.1, 0.05
# Or it is a relief, such as hills or a room that is open in front, seen from one direction: its shadow has at least
# the first of these as a share of its area, and but for the second no face is turned from there, by a cosine below the
# third. The rest has at least the fourth, is as high, seen from there, and on one side.
SHADOW, TURNED, AWAY, REST = 0.3, 0.02, -0.05, 0.002
# A ground, too, is a convex shell - its area is that of its hull but for this share - of no more faces than this if the
# rest is within it but for a share of its diameter, and deep within: by this share of it, in the mean. The marks on a
# ruler are not. Nor is the inner wall of a box: the rest has less than this share of the volume of its own hull.
CONVEX, MOST_OF_SHELL, OUTSIDE, DEEP, HOLLOW = 0.02, 2000, 1e-3, 0.01, 0.98
# The depth is that of so many faces.
DEPTHS = 2000


@dataclass(frozen=True, eq=False)
class Standing:
    """What stands on grounds: which of p polygons, and of n vertices.

    Attributes
    ----------
    polygon : (k,) int64
        The polygons that are no ground, rising.
    vertex : (m,) int64
        The vertices that belong to these, or to none, rising.
    """

    polygon: np.ndarray
    vertex: np.ndarray

    def without_grounds(self, given: PolygonMesh) -> PolygonMesh:
        """The mesh in which they were found, without grounds: k polygons and m vertices."""
        return given.submesh(self.polygon, self.vertex, place_among(self.vertex, given.triangles.n_vertices))


def find_standing(given: PolygonMesh, terrain: bool = True) -> Standing | None:
    """Find what stands on grounds.

    Grounds are pieces of their own, and without one that was found there may be another, such as a wall behind what
    stands on a floor. If there are none, part of the largest piece may be one: its terrain.

    Parameters
    ----------
    given : PolygonMesh
    terrain : bool
        Whether part of a piece can be a ground.

    Returns
    -------
    standing : Standing or None
        None if there are no grounds, or if too few polygons would be left.
    """
    mesh = given.triangles
    stands = _standing_faces(mesh)
    # The tiles of a floor share places, and may share no vertices.
    if stands.all() and mesh.vertex_components[0] > 1 and (joined := _joined_by_place(mesh)) is not None:
        mesh = joined
        stands = _standing_faces(mesh)
    if terrain and stands.all():
        stands = _faces_on_terrain(mesh)
    is_standing = np.zeros(given.n_polygons, bool)
    is_standing[given.polygon[stands]] = True
    if is_standing.all() or is_standing.sum() < MIN_FACES:
        return None
    vertex = ~given.triangles.used
    vertex[given.triangles.faces[is_standing[given.polygon]]] = True
    return Standing(np.flatnonzero(is_standing), np.flatnonzero(vertex))


def are_ground(given: PolygonMesh) -> np.ndarray:
    """Find the polygons that are ground, as ``decompose`` does: copies of faces do not count.

    Parameters
    ----------
    given : PolygonMesh
        With p polygons.

    Returns
    -------
    is_ground : (p,) bool
    """
    copies = find_copies(given)
    standing = find_standing(copies.without(given) if copies else given)
    is_ground = np.full(len(copies.polygon) if copies else given.n_polygons, standing is not None)
    if standing is not None:
        is_ground[standing.polygon] = False
    return is_ground[copies.original] if copies else is_ground


def grounds_among(labels: np.ndarray, is_ground: np.ndarray) -> np.ndarray:
    """Which of some parts are grounds.

    Parameters
    ----------
    labels : (p,) int64
        Part of each face, 0..count-1, all in use.
    is_ground : (p,) bool
        Whether each is ground, see ``are_ground``.

    Returns
    -------
    ground : (count,) bool
        Those of such faces alone; none of them if all are.
    """
    ground = np.bincount(labels, ~is_ground) == 0
    return ground & (not ground.all())


def _standing_faces(mesh: TriMesh) -> np.ndarray:
    """Which faces are on no piece that is ground, (m,) bool; all of them of one piece."""
    count, of_vertex = mesh.vertex_components
    piece = of_vertex[mesh.faces[:, 0]]
    stands = np.bincount(piece, minlength=count) > 0
    if stands.sum() > 1:
        area = np.bincount(piece, mesh.face_area, count)
        while (found := _ground(mesh, piece, area, stands)) is not None:
            stands[found] = False
    return stands[piece]


def _joined_by_place(mesh: TriMesh) -> TriMesh | None:
    """The mesh with vertices at one place as one; None if no two of them are."""
    names, first, place = np.unique(hashed_rows(mesh.vertices), return_index=True, return_inverse=True)
    if len(names) == mesh.n_vertices:
        return None
    return TriMesh(mesh.vertices, first[place.reshape(-1)[mesh.faces]])


def _faces_on_terrain(mesh: TriMesh) -> np.ndarray:
    """Which faces stand on terrain that is one piece with some of them, (m,) bool; all of them if there is none."""
    _, of_vertex = mesh.vertex_components
    piece = of_vertex[mesh.faces[:, 0]]
    area = np.bincount(piece, mesh.face_area)
    ground, stands = piece == area.argmax(), np.ones(mesh.n_faces, bool)
    if area.max() < SHARE * mesh.area:
        return stands
    part, elsewhere = np.flatnonzero(ground), ~ground
    for rising, on_feet in rising_faces(mesh if ground.all() else mesh.submesh(part)[0]):
        ground[part] = ~rising
        own, its = mesh.face_area[ground].sum(), mesh.face_area[~ground].sum()
        if own >= SHARE * mesh.area and its > LEAST * own and _is_ground(
                mesh, ground, ~ground, elsewhere, WIDER_TERRAIN, SHEET_BELOW_FEET if on_feet else SHEET):
            return ~ground
    return stands


def _ground(mesh: TriMesh, piece: np.ndarray, area: np.ndarray, stands: np.ndarray) -> int | None:
    """A piece on which all others stand, of those that do so far; piece : (m,) int64. area, stands : (q,)."""
    least = SHARE * area[stands].sum()
    for k in np.flatnonzero(stands & (area >= least)).tolist():
        others = stands.copy()
        others[k] = False
        mine, rest = piece == k, others[piece]
        if area[others].sum() > LEAST * area[k] and (_is_ground(mesh, mine, rest) or _is_shell(mesh, mine, rest)):
            return k
    return None


def _is_ground(
    mesh: TriMesh, mine: np.ndarray, others: np.ndarray, loose: np.ndarray | None = None, wider: float = WIDER,
    sheet: float = SHEET,
) -> bool:
    """Whether some faces are large beside others, and plain, or flat with the others on one side; both : (m,) bool.

    loose : (m,) bool, those of the others that may be on the other side of a relief than most are; all of them without
    it. wider, sheet : float, as WIDER and SHEET.
    """
    (weight, points), (its_weight, its_points) = (_weighted(mesh, some) for some in (mine, others))
    middle = weighted_sum(weight, points) / weight.sum()
    spread, axes = np.linalg.eigh(second_moments(points - middle, weight))
    own, its = inner_products(points - middle, axes.T), inner_products(its_points - middle, axes.T)
    sides, its_sides = np.ptp(own, axis=0), np.ptp(its, axis=0)
    few = mine.sum() <= FEW_FACES * (mine | others).sum()
    if _is_larger(np.sort(sides)[1:], np.sort(its_sides)[1:], wider) and (
            few or _is_relief(mesh, mine, others, others if loose is None else loose)):
        return True
    if spread[0] > (SLAB if few else sheet) ** 2 * spread[1] or not _is_larger(sides[1:], its_sides[1:], wider):
        return False
    thickness = np.abs(own[:, 0]).max()
    beyond = min(its_weight[side * its[:, 0] > thickness].sum() for side in (-1, 1))
    return _is_high(its_points, axes[:, 0]) and bool(beyond <= BELOW * its_weight.sum())


def _is_high(points: np.ndarray, up: np.ndarray) -> bool:
    """Whether points, (n, 3), are as high as what stands on a ground; up : (3,), of length 1."""
    return bool(np.ptp(inner_products(points, up)) >= HIGH * np.sqrt(outline_area(points, up)))


def _weighted(mesh: TriMesh, some: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices of some faces, (k, 3), and the area of these around each, (k,); some : (m,) bool."""
    weight = np.bincount(mesh.faces[some].ravel(), np.repeat(mesh.face_area[some], 3), mesh.n_vertices)
    there = np.flatnonzero(weight)
    return weight[there], taken(mesh.vertices, there)


def _is_relief(mesh: TriMesh, mine: np.ndarray, others: np.ndarray, loose: np.ndarray) -> bool:
    """Whether some faces are all seen from one direction, with the others before them; all : (m,) bool."""
    area, weight = mesh.face_area[mine], mesh.face_area[others]
    direction = mesh.area_normals[mine].sum(axis=0)
    shadow = np.linalg.norm(direction)
    if shadow < SHADOW * area.sum() or weight.sum() < REST * area.sum():
        return False
    turned = inner_products(mesh.area_normals[mine], direction / shadow) < AWAY * lengths(mesh.area_normals[mine])
    if area[turned].sum() > TURNED * area.sum() or not _is_high(_weighted(mesh, others)[1], direction / shadow):
        return False
    if not loose.any():
        return True
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    middle, place, theirs = mesh.face_centroids[mine], mesh.face_centroids[loose], mesh.face_area[loose]
    below = nearest(search_tree(middle), place)[1]
    above = theirs * np.sign(row_products(place - middle[below], mesh.area_normals[mine][below]))
    rising = mesh.face_centroids[others & ~loose]
    side = above.sum() if not len(rising) else (rising.mean(axis=0) - middle.mean(axis=0)) @ direction
    return bool(theirs[above < 0 if side >= 0 else above > 0].sum() <= BELOW * weight.sum())


def _is_shell(mesh: TriMesh, mine: np.ndarray, others: np.ndarray) -> bool:
    """Whether some faces are a convex solid deep in which the others are; both : (m,) bool."""
    if mine.sum() > min(others.sum(), MOST_OF_SHELL):
        return False
    corners, theirs = mesh.corners[mine].reshape(-1, 3), mesh.corners[others]
    diameter = box_diagonal(corners)
    outside = OUTSIDE * diameter
    if (theirs.min(axis=(0, 1)) < corners.min(axis=0) - outside).any() or (
            theirs.max(axis=(0, 1)) > corners.max(axis=0) + outside).any():
        return False
    from scipy.spatial import ConvexHull, QhullError  # imported here for the reason that arrays.components gives

    try:
        shell, whole = ConvexHull(corners), ConvexHull(theirs.reshape(-1, 3))
    except QhullError:  # flat
        return False
    a, b, c = np.moveaxis(theirs - theirs[0, 0], 1, 0)
    volume = abs(row_products(cross(a, b), c).sum()) / 6
    if abs(mesh.face_area[mine].sum() - shell.area) > CONVEX * shell.area or volume >= HOLLOW * whole.volume:
        return False
    middle = theirs.mean(axis=1)
    some = spread_evenly(np.ones(len(middle)), lengths(middle - corners.mean(axis=0)), DEPTHS)
    weight = mesh.face_area[others][some]
    return bool(weight @ _depth(shell, middle[some]) >= DEEP * diameter * weight.sum()
                and _depth(shell, whole.points[whole.vertices]).min() >= -outside)


def _depth(hull: ConvexHull, points: np.ndarray) -> np.ndarray:
    """How deep points are in a hull, (n,) float64, below 0 outside; points : (n, 3)."""
    depth = np.full(len(points), np.inf)
    for a, b, c, d in np.unique(hull.equations, axis=0).tolist():  # one after the other, as there may be thousands
        np.minimum(depth, -(points[:, 0] * a + points[:, 1] * b + points[:, 2] * c + d), out=depth)
    return depth


def _is_larger(sides: np.ndarray, its_sides: np.ndarray, times: float) -> bool:
    """Whether a rectangle of two sides has room for another, (2,) each, and is so many times as large."""
    return bool((sides >= its_sides).all() and sides.prod() >= times * its_sides.prod())
