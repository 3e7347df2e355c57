# SPDX-License-Identifier: GPL-3.0-or-later
"""Second skins: the mesh once more, a little larger or smaller and turned inside out, such as an outline or a lining.

The outline of a drawn figure is made so, and cloth with two sides. Two such skins hold each other's parts together
wherever they come near. So the one that is inside out is left out before anything is measured, and has the parts of the
other.
"""

from __future__ import annotations

import numpy as np

from ..arrays.hashes import hashed_sets, rehashed
from ..arrays.int64 import arange, full
from ..arrays.vectors import lengths, row_products
from .pieces import Pieces, measured_polygons, nearest_polygons
from .polygons import PolygonMesh

# Of the area of a skin so much is near what it is a skin of, and turned about: not farther off than the first of these,
# in diameters of the mesh, the cosine of the angle between both normals being below the second.
MOST_OF_PIECE, FAR, FACING = 0.7, 0.03, -0.5
MIDDLE = 0.1  # diameters of the mesh between the middles of both, at most
MOST_OF_MESH = 0.9  # so much of the area of the mesh, at least, is of skins and of what has one


def find_skins(given: PolygonMesh, pieces: Pieces) -> np.ndarray | None:
    """Find pieces that have the same faces as others near them, turned about, if that is nearly the whole mesh.

    Parameters
    ----------
    given : PolygonMesh
    pieces : Pieces

    Returns
    -------
    base : (count,) int64, or None
        Of each piece that is a skin, the piece that has it; -1 for all others. None if there are no skins.
    """
    base = full(pieces.count, -1)
    one, two = _alike(given, pieces).T
    # The one of larger volume looks outwards.
    inverted = pieces.volume[one] < pieces.volume[two]
    base[np.where(inverted, one, two)] = np.where(inverted, two, one)
    if not _are_most(pieces, base):
        return None
    below = nearest_polygons(given, pieces, base, 0)
    of_skin = np.flatnonzero(base[pieces.of_polygon] >= 0)
    area, middle, normal = measured_polygons(given)
    near = lengths(middle[of_skin] - middle[below[of_skin]]) <= FAR * given.triangles.diagonal
    near &= row_products(normal[of_skin], normal[below[of_skin]]) < FACING
    along = np.bincount(pieces.of_polygon[of_skin], near * area[of_skin], pieces.count)
    base[along < MOST_OF_PIECE * pieces.area] = -1
    return base if _are_most(pieces, base) else None


def _are_most(pieces: Pieces, base: np.ndarray) -> bool:
    """Whether skins and what has one are most of a mesh; base : (count,) int64."""
    skin = np.flatnonzero(base >= 0)
    return len(skin) > 0 and pieces.area[np.append(skin, base[skin])].sum() >= MOST_OF_MESH * pieces.area.sum()


def _alike(given: PolygonMesh, pieces: Pieces) -> np.ndarray:
    """Pairs of pieces with the same polygons and with middles near each other, nearer than others, (k, 2) int64."""
    from scipy.spatial import cKDTree  # imported here for the reason that arrays.components gives

    kind, has_like = _kinds(given, pieces)
    some, far = np.flatnonzero(has_like), MIDDLE * given.triangles.diagonal
    if not len(some):
        return np.empty((0, 2), np.int64)
    point = np.column_stack([pieces.middle[some], 2 * far * kind[some]])
    near = cKDTree(point).query(point, 2, distance_upper_bound=far)[1]
    other = np.where(near[:, 0] == arange(len(some)), near[:, 1], near[:, 0])
    pair = np.flatnonzero(np.append(other, -1)[other] == arange(len(some)))
    pair = pair[pair < other[pair]]
    return some[np.stack([pair, other[pair]], axis=1)]


def _kinds(given: PolygonMesh, pieces: Pieces) -> tuple[np.ndarray, np.ndarray]:
    """A number for each piece, (count,) int64, that is the same for pieces with the same polygons.

    And whether there are others of its number, (count,) bool. Polygons are the same if as many meet at their corners.
    """
    n_places = len(pieces.first)
    corner = np.unique(given.polygon[:, None] * n_places + pieces.place[given.triangles.faces])
    polygon, place = np.divmod(corner, n_places)
    number = hashed_sets(polygon, np.bincount(place)[place], given.n_polygons)
    total = np.zeros(pieces.count, np.uint64)
    np.add.at(total, pieces.of_polygon, rehashed(number))
    _, kind, count = np.unique(total, return_inverse=True, return_counts=True)
    return kind, (count[kind] > 1) & (pieces.area > 0)
