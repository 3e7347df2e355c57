# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls: closed pieces that are the two sides of a thin wall around a hollow, one surface where the hollow opens.

A shell that was given a thickness is such a piece, and so are cups, lampshades and hollow prints with a hole to drain.
Everything on it is as thick as the wall, and each limb is two tubes. So the side that looks into the hollow is left out
before anything is measured, and has the parts of the other.
"""

from __future__ import annotations

import numpy as np

from ..arrays.components import components
from ..arrays.hashes import hashed_rows
from ..arrays.indexing import place_among
from ..arrays.int64 import arange, full
from ..arrays.pairs import both_ways
from ..arrays.ties import rounded
from ..arrays.vectors import lengths, row_products, unit
from .cavities import LEAST
from .face_graph import FaceGraph, connect
from .pieces import FULL, TURN, Pieces, fills_its_box, measured, scattered
from .polygons import PolygonMesh
from .triangles import TriMesh

MOST_OF_MESH = 0.25  # share of the area of the mesh that is of such pieces, at least
THICK = 0.05  # of a wall, at most, in diameters of the piece
# Points scattered on a piece, and the share of them behind which the other side of the wall must be found before it is
# looked for behind all faces; and points that stand for that side where its faces are large.
FEW, MOST_OF_POINTS, MANY = 1_500, 0.8, 8_000
OPEN = 0.01  # sum of the normals of a surface, as a share of its area, above which it has a border
NEAREST = 3  # points of the other side that are tried for each face
# The other side looks the other way, by the cosine of the angle between the normals; it is as far from the face as it
# is from most, times these; and its point is not farther aside than so many spacings of points.
FACING, AS_THICK, ASIDE = -0.8, (0.5, 1.6), 1.5
CREASE = 0.5  # cosine of the angle of an edge that turns outwards, and may be the edge of a rim
LEAST_PATCH = 1e-3  # share of the area of the piece below which a patch is left out
LEAST_PULL = 1e-4  # share of a patch's area that must speak for a side
# Share of the area of a piece that is found to be of either side, at least; of what faces the other side that may face
# its own; and of the larger side that the smaller must have.
MOST, MOST_WRONG, LEAST_SIDE = 0.65, 0.03, 0.2


def may_have_walls(mesh: TriMesh, piece: np.ndarray, area: np.ndarray, volume: np.ndarray) -> bool:
    """Whether to look for walls at all, by what hangs together by its vertices.

    piece : (m,) int64, of each face. area, volume : (count,) float64, of each piece, as ``measured`` has them.
    """
    count = len(area)
    turned = np.stack([np.bincount(piece, mesh.area_normals[:, axis], count) for axis in range(3)], axis=1)
    is_open = lengths(turned) > OPEN * area
    if is_open.sum() == 1:  # of several, seams may part one that is closed
        is_open[:] = False
    diameter = mesh.diagonal
    thin = (_thickness(area, volume) < THICK * diameter) & (area >= LEAST * mesh.area)
    if area[is_open | thin].sum() < MOST_OF_MESH * mesh.area:
        return False
    if count > 1 or volume[0] < 0:
        return True
    some = arange(mesh.n_faces)[::max(mesh.n_faces // MANY, 1)]
    return bool(np.isfinite(_depths(mesh, some, diameter)).mean() > 0.9 * MOST_OF_POINTS)


def find_walls(given: PolygonMesh, pieces: Pieces) -> np.ndarray | None:
    """Find the sides of walls that look into the hollow, if such pieces are a good share of the mesh.

    Parameters
    ----------
    given : PolygonMesh
        m triangles.
    pieces : Pieces

    Returns
    -------
    along : (m,) int64, or None
        For each triangle of an inner side one of the outer side that it runs along, and of all others their own. None
        if there are no walls.
    """
    whole = pieces.area.sum()
    thin = (pieces.area >= LEAST * whole) & (_thickness(pieces.area, pieces.volume) < THICK * pieces.diameter)
    if pieces.area[thin].sum() < MOST_OF_MESH * whole:
        return None
    walled, along = 0.0, arange(given.triangles.n_faces)
    of_triangle = pieces.of_polygon[given.polygon]
    for k in np.flatnonzero(thin).tolist():
        face = np.flatnonzero(of_triangle == k)
        if not len(face):  # triangles of a polygon may lie in several pieces, and are of one of them
            continue
        surface, volume = _surface(given, pieces, face, inverted=bool(pieces.volume[k] < 0)), abs(pieces.volume[k])
        if fills_its_box(surface.vertices, volume / 3):
            continue
        found = _along(surface, volume, float(pieces.diameter[k]))
        if found is not None:
            walled += pieces.area[k]
            along[face] = face[found]
    return along if walled >= MOST_OF_MESH * whole else None


def _thickness(area: np.ndarray, volume: np.ndarray) -> np.ndarray:
    """Mean thickness of walls from their area and what ``measured`` has as volume, three times that of a solid."""
    return 2 / 3 * np.abs(volume) / np.maximum(area, 1e-300)


def _surface(given: PolygonMesh, pieces: Pieces, face: np.ndarray, inverted: bool) -> TriMesh:
    """Some triangles of one piece, (k,) int64, turned about if it is inverted; corners at one place are one vertex."""
    corner = pieces.place[given.triangles.faces[face]]
    used = np.zeros(len(pieces.first), bool)
    used[corner] = True
    place = np.flatnonzero(used)
    place = place[np.argsort(pieces.first[place])]  # places are numbered at random
    corner = place_among(place, len(used))[corner]
    return TriMesh(given.triangles.vertices[pieces.first[place]], corner[:, ::-1] if inverted else corner)


def _along(mesh: TriMesh, whole: float, diameter: float) -> np.ndarray | None:
    """For each face of a piece that is on the inner side of its wall one of the outer side, for others their own, (m,).

    None if it is no wall around a hollow. whole : the piece's volume, as ``measured`` has it.
    """
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    behind, usual = _behind(mesh, diameter)
    if not usual:
        return None
    side, wrong = _sides(mesh, behind, usual)
    area = np.bincount(side + 1, mesh.face_area, 3)[1:]
    if area.sum() < MOST * mesh.area or wrong > MOST_WRONG or area.min() < LEAST_SIDE * area.max():
        return None
    _, _, volume = measured(mesh, side + 1, 3)
    if volume[2] > volume[1]:
        side, volume = np.where(side < 0, -1, 1 - side), volume[[0, 2, 1]]
    if volume[2] > 0 or whole > FULL * volume[1]:
        return None
    graph = FaceGraph.of(mesh)
    is_outer = connect(graph, _filled(side, graph.pairs)) == 0
    along = np.where(is_outer, arange(mesh.n_faces), behind)
    outer = np.flatnonzero(is_outer & mesh.has_area)  # one without area has a neighbor's part
    unknown = np.flatnonzero((along < 0) | ~is_outer[along])
    along[unknown] = outer[nearest(search_tree(mesh.face_centroids[outer]), mesh.face_centroids[unknown])[1]]
    return along


def _depths(mesh: TriMesh, faces: np.ndarray, diameter: float) -> np.ndarray:
    """How far it is from points on faces, (k,) int64, through the wall to its other side; infinite if there is none.

    Returns (FEW / 4,) float64.
    """
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    its, position = scattered(mesh, faces, mesh.face_area[faces], FEW)
    normal = unit(mesh.area_normals[its])
    place, some = position / diameter, slice(None, None, 4)
    tree = search_tree(np.concatenate([place, TURN * normal], axis=1))
    point = nearest(tree, np.concatenate([place[some], -TURN * normal[some]], axis=1), NEAREST)[1].T
    aside = ASIDE * np.sqrt(mesh.area / FEW)
    return np.min([_depth(position[some], normal[some], position[k], normal[k], THICK * diameter, aside)
                   for k in point], axis=0)


def _depth(start: np.ndarray, normal: np.ndarray, end: np.ndarray, other: np.ndarray, most: float,
           aside: float) -> np.ndarray:
    """How far it is from points, against their normals, to the planes of others that face them; infinite if none does.

    start, normal, end, other : (k, 3), points and normals. most : how far at most. aside : how far the other point is
    from the line at most. Returns (k,) float64.
    """
    cosine, offset = row_products(normal, other), end - start
    found = row_products(offset, other) / np.maximum(-cosine, 1e-9)
    meets = (cosine < FACING) & (found > 0) & (found < most) & (lengths(offset + found[:, None] * normal) < aside)
    return np.where(meets, found, np.inf)


def _behind(mesh: TriMesh, diameter: float) -> tuple[np.ndarray, float]:
    """The face that lies behind each through the wall, (m,) int64, and how thick the wall is.

    -1 where no face looks the other way at about that depth, as behind a rim; everywhere if it is so of too many.
    """
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    behind = full(mesh.n_faces, -1)
    # Whatever the order of the faces, and twice as large, too.
    order = np.argsort(hashed_rows(np.frexp(mesh.face_centroids)[0]), kind="stable")
    deep = _depths(mesh, order, diameter)
    if np.isfinite(deep).mean() < MOST_OF_POINTS:
        return behind, 0.0
    usual = float(rounded(np.median(deep[np.isfinite(deep)]), 4))
    # Of all faces the nearest to where the other side is then: by their middles, or if these are far apart, by points.
    normal, aside = mesh.face_normals, ASIDE * np.sqrt(mesh.area / MANY)
    middles = arange(mesh.n_faces), mesh.face_centroids
    for its, end in (middles, scattered(mesh, order, mesh.face_area[order], MANY)):
        left = np.flatnonzero(behind < 0)
        start = mesh.face_centroids[left]
        point = nearest(search_tree(end), start - usual * normal[left])[1]
        deep = _depth(start, normal[left], end[point], normal[its[point]], THICK * diameter, aside)
        found = (deep > AS_THICK[0] * usual) & (deep < AS_THICK[1] * usual)
        behind[left[found]] = its[point[found]]
        if mesh.face_area[behind >= 0].sum() > MOST_OF_POINTS * mesh.area:
            break
    return behind, usual


def _sides(mesh: TriMesh, behind: np.ndarray, thickness: float) -> tuple[np.ndarray, float]:
    """Tell the two sides of a wall apart.

    Patches of faces that hang together are of one side, and what lies behind them is of the other one.

    behind : (m,) int64, the face of the other side that was found behind each, or -1. thickness : of the wall.
    Returns the side of each face, (m,) int64, 0 or 1, -1 where it is not known; and the share of the faces' area
    behind which a face of their own side lies.
    """
    (first, second), in_wall = mesh.edges.pairs.T, behind >= 0
    inside = in_wall[first] & in_wall[second]
    normal, middle = mesh.face_normals, mesh.face_centroids
    crease = row_products(normal[first], normal[second]) < CREASE
    crease &= row_products(middle[second] - middle[first], normal[first]) < 0
    count, patch = components(mesh.n_faces, first[inside & ~crease], second[inside & ~crease])
    area = np.bincount(patch[in_wall], mesh.face_area[in_wall], count)
    large = np.flatnonzero(area > LEAST_PATCH * mesh.area)
    if not len(large):
        return full(mesh.n_faces, -1), 1.0
    number = np.where(in_wall, place_among(large, count)[patch], -1)
    face = np.flatnonzero((number >= 0) & (number[behind] >= 0))
    facing = _between(number[face], number[behind[face]], mesh.face_area[face], len(large))
    along = inside & crease & (number[first] >= 0) & (number[second] >= 0)
    touching = _between(number[first[along]], number[second[along]], thickness * mesh.pair_length[along], len(large))
    sign = _signs(area[large], touching - facing)
    same = sign[:, None] * sign[None, :] > 0
    side = np.append(np.where(sign == 0, -1, np.where(sign < 0, 1, 0)), -1)[number]
    return side, float(facing[same].sum() / max(facing.sum(), 1e-300))


def _filled(side: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """Let both sides spread to faces whose side is not known, whatever the order of these; as many of both: the second.

    side : (m,) int64, 0, 1 or -1. pairs : (e, 2) int64, faces that touch. Returns (m,) int64, 0 or 1.
    """
    face, other = both_ways(pairs[(side[pairs] < 0).any(axis=1)]).T
    sign = np.where(side < 0, 0, 1 - 2 * side)
    while True:
        votes = np.bincount(face, sign[other], len(side))
        reached = (sign == 0) & (np.bincount(face, sign[other] != 0, len(side)) > 0)
        if not reached.any():
            return np.where(sign > 0, 0, 1)
        sign[reached] = np.where(votes[reached] > 0, 1, -1)


def _between(one: np.ndarray, two: np.ndarray, weight: np.ndarray, count: int) -> np.ndarray:
    """Sums of weights of pairs, symmetric, (count, count) float64; one, two : (k,) int64. weight : (k,)."""
    total = np.bincount(one * count + two, weight, count * count).reshape(count, count)
    return total + total.T


def _signs(area: np.ndarray, alike: np.ndarray) -> np.ndarray:
    """Signs, 1 or -1, 0 for none, from what speaks for two patches having the same sign, beginning with the largest.

    area : (c,) float64. alike : (c, c) float64, symmetric, negative where two have different signs. Returns (c,).
    """
    sign, pull, strongest, towards = np.zeros(len(area)), np.zeros(len(area)), int(area.argmax()), 1.0
    while True:
        sign[strongest] = towards
        pull += towards * alike[strongest]
        free = np.where(sign == 0, np.abs(pull), 0.0)
        strongest = int(free.argmax())
        if free[strongest] <= LEAST_PULL * area[strongest]:
            return sign
        towards = float(np.sign(pull[strongest]))
