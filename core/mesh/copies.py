# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that lie on others with the same corners: some models have every face twice, once for each side.

At the edges of such faces three and more meet, as if the surface branched there, and what is said of the bend, the
borders and the inside of a surface holds no more. So a copy is left out before anything is measured, and has the part
of the face on which it lies. So is a second skin, which runs along the whole mesh at a small distance, the side of a
thin wall that looks into a hollow, and what lies within the solid in its plane of symmetry.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays.hashes import hashed_rows
from ..arrays.indexing import begins_run, inverse
from ..arrays.int64 import arange, cumsum
from ..sentence import Sentence
from .cavities import LEAST, POINTS, find_cavities
from .interior import find_interior
from .pieces import (
    Pieces,
    measured,
    measured_polygons,
    nearest_polygons,
    nearest_vertices,
    pieces_by_place,
    solid_polygons,
)
from .polygons import MIN_FACES, PolygonMesh, hashed_polygons
from .skins import MOST_OF_MESH, find_skins
from .triangles import TriMesh
from .walls import find_walls, may_have_walls

# Share of the area of a piece above which what is copied of it is its other side. Of less these are walls that touching
# solids, such as the boards of a cupboard, have in common: without its wall a solid would be open.
MOST = 0.9
TWICE, SKIN, INTERIOR = "twice", "skin", "interior"
ASIDE = 1e-3  # diagonals of the mesh by which the nearest to an interior face is sought on its own side


@dataclass(frozen=True, eq=False)
class Copies:
    """Which of p polygons are copies of others, and which of n vertices belong to copies alone.

    Attributes
    ----------
    polygon : (k,) int64
        The polygons that are no copies, rising: the first at each place.
    original : (p,) int64
        For each polygon, the place in ``polygon`` of the one of which it is a copy; of the others their own.
    vertex : (m,) int64
        The vertices that belong to other polygons than copies, or to none, rising.
    home : (n,) int64
        For each vertex, the place in ``vertex`` of one where it is; of most their own.
    turned : (p,) bool
        Whether each polygon is the other side of the one of which it is a copy.
    kind : str
        What is called a copy here: TWICE, what lies on its original; SKIN, what runs along it; INTERIOR, what lies
        within the solid and has the part of what is nearest.
    n_rims : int
        Number of edges where copies go on in what they are copies of: borders of what is left, but not of the mesh.
    """

    polygon: np.ndarray
    original: np.ndarray
    vertex: np.ndarray
    home: np.ndarray
    turned: np.ndarray
    kind: str = TWICE
    n_rims: int = 0

    @property
    def n_copies(self) -> int:
        """Number of polygons that are copies."""
        return len(self.original) - len(self.polygon)

    @property
    def is_copy(self) -> np.ndarray:
        """(p,) bool, whether each polygon is a copy."""
        return self.polygon[self.original] != arange(len(self.original))

    @property
    def note(self) -> Sentence:
        """What to say of them."""
        if self.kind == INTERIOR:
            return Sentence("{n} {n:face lies|faces lie} within the solid, in its plane of symmetry, and {n:has|have} "
                            "the parts of what is nearest.", n=self.n_copies)
        if self.kind == SKIN:
            return Sentence("{n} {n:face runs|faces run} along others as a second skin, such as an outline or an inner "
                            "wall, and {n:has|have} their parts.", n=self.n_copies)
        return Sentence("{n} {n:face lies|faces lie} on another one with the same corners, and {n:has|have} its part.",
                        n=self.n_copies)

    @property
    def has_other_side(self) -> np.ndarray:
        """(k,) bool, whether there is a copy of each polygon that is none which is its other side."""
        return np.bincount(self.original, self.turned) > 0

    def without(self, given: PolygonMesh) -> PolygonMesh:
        """The mesh in which they were found, without copies: k polygons and m vertices."""
        return given.submesh(self.polygon, self.vertex, self.home)

    def images(self, twin: np.ndarray) -> np.ndarray:
        """Mirror images of all polygons, from those of the ones that are no copies.

        twin : (k,) int64, place in ``polygon`` of the image of each; -1 for none. Returns (p,) int64: the image of a
        copy is a copy of the image, if there is one. Interior faces have none.
        """
        if self.kind == INTERIOR:
            image = np.where(self.is_copy, -1, twin[self.original])
            return np.where(image >= 0, self.polygon[image], -1)
        order = np.lexsort((self.is_copy, self.original))
        count = np.bincount(self.original)
        first = cumsum(count) - count
        rank = inverse(order) - first[self.original]
        image = twin[self.original]
        return np.where(image >= 0, order[first[image] + np.minimum(rank, count[image] - 1)], -1)


def find_copies(given: PolygonMesh, plane: np.ndarray | None = None) -> Copies | None:
    """Find polygons with the same corners as others, in either order; or else interior faces, skins or walls.

    Only in pieces that are copied nearly whole. Corners are the same where their coordinates are, whether they are one
    vertex or several.

    Parameters
    ----------
    given : PolygonMesh
    plane : (4,) float64, optional
        Of a half model, see ``find_interior``.

    Returns
    -------
    copies : Copies or None
        None if there are none, or if too few polygons would be left.
    """
    mesh, place = given.triangles, hashed_rows(given.triangles.vertices)
    if found := _with_same_corners(given, place):
        return found
    if found := _interior(given, find_interior(given, place, plane), half=plane is not None):
        return found
    count, piece = mesh.vertex_components
    piece = piece[mesh.faces[:, 0]]
    area, _, volume = measured(mesh, piece, count)
    skins, walls = _may_have_skins(mesh, piece, area, volume), may_have_walls(mesh, piece, area, volume)
    if not (skins or walls):
        return None
    pieces = Pieces.of(given, place)
    found = (_skins(given, pieces) if skins else None) or (_inner_sides(given, pieces) if walls else None)
    if skins and not found:
        # An outline and what it is drawn around may have places in common, where a normal is 0, but no vertices.
        found = _skins(given, Pieces.of(given, arange(mesh.n_vertices)))
    return found


def _interior(given: PolygonMesh, is_interior: np.ndarray | None, *, half: bool) -> Copies | None:
    """Interior faces, (p,) bool, as copies of what is nearest, on the side from which they look away.

    half : whether the mesh is one side of what is decomposed, and its borders in the plane are none.
    """
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    if is_interior is None:
        return None
    mesh, original, home = given.triangles, arange(given.n_polygons), arange(given.triangles.n_vertices)
    _, middle, normal = measured_polygons(given)
    kept = np.flatnonzero(~is_interior & solid_polygons(given))
    inverted = measured(mesh, np.zeros(mesh.n_faces, np.int64), 1)[2][0] < 0
    start = middle[is_interior] + ASIDE * mesh.diagonal * normal[is_interior] * (1.0 if inverted else -1.0)
    original[is_interior] = kept[nearest(search_tree(middle[kept]), start)[1]]
    is_kept = ~mesh.used
    is_kept[mesh.faces[~is_interior[given.polygon]]] = True
    its, others = np.flatnonzero(is_kept & mesh.used), np.flatnonzero(~is_kept)
    home[others] = its[nearest(search_tree(mesh.vertices[its]), mesh.vertices[others])[1]]
    found = _apart(original, home, INTERIOR)
    n_rims = 0 if half else _rims(mesh, ~is_interior[given.polygon])
    return None if found is None else replace(found, n_rims=n_rims)


def _inner_sides(given: PolygonMesh, pieces: Pieces) -> Copies | None:
    """Inner sides of walls as copies of what they run along."""
    mesh, along = given.triangles, find_walls(given, pieces)
    if along is None:
        return None
    polygon, original = given.polygon, _outer_polygons(given, along)
    is_kept = original == arange(given.n_polygons)
    of_copy = np.flatnonzero(~is_kept[polygon])
    triangle = np.empty(given.n_polygons, np.int64)
    triangle[polygon] = arange(mesh.n_faces)
    near = np.where(is_kept[polygon[along[of_copy]]], along[of_copy], triangle[original[polygon[of_copy]]])
    home = arange(mesh.n_vertices)
    home[mesh.faces[of_copy]] = _nearest_corners(mesh, of_copy, near)
    kept = mesh.faces[is_kept[polygon]]
    home[kept] = kept
    found = _apart(original, home)
    return None if found is None else replace(found, n_rims=_rims(mesh, is_kept[polygon]))


def _rims(mesh: TriMesh, is_kept: np.ndarray) -> int:
    """At how many edges one of the triangles that are kept, (m,) bool, touches others."""
    edge, count = mesh.edges.face_edges, len(mesh.edges.vertices)
    kept, others = (np.bincount(edge[some].ravel(), minlength=count) for some in (is_kept, ~is_kept))
    return int(((kept == 1) & (others > 0)).sum())


def _outer_polygons(given: PolygonMesh, along: np.ndarray) -> np.ndarray:
    """The polygon along which each runs, (p,) int64, of outer sides its own; along : (m,) int64, of triangles."""
    own = arange(given.n_polygons)
    inner = np.flatnonzero(along != arange(len(along)))
    area, inner_area = (np.bincount(given.polygon[some], given.triangles.face_area[some], given.n_polygons)
                        for some in (slice(None), inner))
    is_inner, original = inner_area > 0.5 * area, own.copy()
    original[given.polygon[inner]] = given.polygon[along[inner]]
    return np.where(is_inner & ~is_inner[original], original, own)


def _nearest_corners(mesh: TriMesh, face: np.ndarray, other: np.ndarray) -> np.ndarray:
    """The corner of another face that is nearest to each of a face, (k, 3) int64; face, other : (k,) int64."""
    offset = mesh.vertices[mesh.faces[face]][:, :, None] - mesh.vertices[mesh.faces[other]][:, None]
    nearest = np.linalg.norm(offset, axis=3).argmin(axis=2)
    return np.take_along_axis(mesh.faces[other], nearest, axis=1)


def _apart(original: np.ndarray, home: np.ndarray, kind: str = SKIN) -> Copies | None:
    """The copies that lie apart from polygons, (p,) int64, and vertices, (n,) int64; None if too few are left."""
    is_kept, vertex = original == arange(len(original)), np.flatnonzero(home == arange(len(home)))
    if is_kept.sum() < MIN_FACES:
        return None
    return Copies(np.flatnonzero(is_kept), (cumsum(is_kept) - 1)[original], vertex, np.searchsorted(vertex, home),
                  np.zeros(len(original), bool), kind)


def _skins(given: PolygonMesh, pieces: Pieces) -> Copies | None:
    """Second skins and cavities as copies of what they run along."""
    n_points = 0
    if (base := find_skins(given, pieces)) is None:
        base, n_points = find_cavities(given, pieces), POINTS
    if base is None:
        return None
    return _apart(nearest_polygons(given, pieces, base, n_points), nearest_vertices(given, pieces, base))


def _may_have_skins(mesh: TriMesh, piece: np.ndarray, area: np.ndarray, volume: np.ndarray) -> bool:
    """Whether to look for skins and cavities at all, by what hangs together by its vertices.

    Of a skin there are pieces of as many faces each, also where seams part them, and a cavity is inside out.

    piece : (m,) int64, of each face. area, volume : (count,) float64, of each piece, as ``measured`` has them.
    """
    if len(area) == 1:
        return False
    size = np.bincount(piece, minlength=len(area))
    has_like = np.bincount(size)[size] > 1
    return bool(area[has_like].sum() >= MOST_OF_MESH * mesh.area or ((volume < 0) & (area >= LEAST * mesh.area)).any())


def _with_same_corners(given: PolygonMesh, place: np.ndarray) -> Copies | None:
    """Polygons with the same corners as others; place : (n,) uint64, where each vertex is."""
    mesh = given.triangles
    number, backwards = hashed_polygons(given, place)
    in_order = np.sort(number)
    if not (in_order[1:] == in_order[:-1]).any():
        return None
    _, first, group, count = np.unique(number, return_index=True, return_inverse=True, return_counts=True)
    is_copied = (number > 0) & (count[group.reshape(-1)] > 1)
    is_copied &= _mostly_copied(given, place, is_copied)
    original = np.where(is_copied, first[group.reshape(-1)], arange(len(number)))
    is_kept = original == arange(len(number))
    if is_kept.all() or is_kept.sum() < MIN_FACES:
        return None
    kept = np.zeros(mesh.n_vertices, bool)
    kept[mesh.faces[is_kept[given.polygon]]] = True
    home = _first_kept(place, kept)
    # Sides that a polygon goes along there and back are not in its outline: it may have corners that no other has.
    elsewhere = np.unique(given.polygon[~kept[home][mesh.faces].all(axis=1)])
    is_kept[elsewhere], original[elsewhere] = True, elsewhere
    if is_kept.all():
        return None
    kept[mesh.faces[is_kept[given.polygon]]] = True
    vertex = np.flatnonzero(kept | ~mesh.used)
    home[vertex] = vertex
    return Copies(np.flatnonzero(is_kept), (cumsum(is_kept) - 1)[original], vertex, np.searchsorted(vertex, home),
                  backwards != backwards[original])


def _first_kept(place: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """The first vertex at the place of each, (n,) int64, those that are kept before others; place, kept : (n,)."""
    order = np.lexsort((~kept, place))
    new = begins_run(place[order])
    first = np.empty(len(place), np.int64)
    first[order] = order[new][cumsum(new) - 1]
    return first


def _mostly_copied(given: PolygonMesh, place: np.ndarray, is_copied: np.ndarray) -> np.ndarray:
    """Whether each polygon, (p,) bool, is of a piece that is copied for more than MOST of its area.

    is_copied : (p,) bool, whether there are two and more of a polygon. place : (n,) uint64, where each vertex is.
    """
    mesh = given.triangles
    count, of_triangle = pieces_by_place(mesh, place)
    copied = np.bincount(of_triangle, mesh.face_area * is_copied[given.polygon], count)
    mostly = copied > MOST * np.bincount(of_triangle, mesh.face_area, count)
    of_polygon = np.zeros(given.n_polygons, bool)
    of_polygon[given.polygon] = mostly[of_triangle]
    return of_polygon
