# SPDX-License-Identifier: GPL-3.0-or-later
"""Interior faces: those within a solid, in its plane of symmetry, as where a half was closed before it was mirrored.

They part the two halves, which are two closed bodies then, or one whose surface branches; no distance goes from one to
the other as it would on the surface that is seen. So they are left out before anything is measured, and have the parts
of what is nearest. Walls that the solids of an assembly have in common, as the boards of a cupboard, are none of these.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays.components import components
from ..arrays.indexing import renumbered, sums_by
from ..arrays.int64 import arange, full
from ..arrays.pairs import edge_keys
from ..arrays.vectors import inner_products, row_products, unit, weighted_sum
from .pieces import fills_its_box, pieces_by_place
from .polygons import PolygonMesh
from .triangles import TriMesh

FLAT = 1e-4  # diagonals of the mesh by which corners of faces in a plane are off it, at most
SAME, FEW = 1e-6, 4  # diagonals within which two vertices there are one; so many are sought around each, with itself
LEAST = 2e-3  # share of the area of the mesh that interior faces have, at least
# A plane of symmetry passes the middle of the surface at so many diagonals, at most; three planes are tried, those of
# the largest faces whose planes do; faces are parallel if the cosine of the angle between them is above the second.
OFF_MIDDLE, PARALLEL, TRIES = 1e-3, 1 - 1e-4, 3
# Share of the vertices beside the plane whose mirror images lie on others, within so many diagonals.
MIRRORED, IMAGE = 0.9, 1e-3
SLIVER = 1e-5  # width of a triangle, over its side, below which it is a line but for rounding
WITHIN = 0.8  # excess of the edges at which a patch runs into the solid over the others, as a share of all
MOST_OF_MESH = 0.5  # share of the area of the mesh that the body with the interior faces has, at least


def find_interior(given: PolygonMesh, place: np.ndarray, plane: np.ndarray | None = None) -> np.ndarray | None:
    """Find faces in the plane of symmetry that are within the solid.

    Parameters
    ----------
    given : PolygonMesh
    place : (n,) uint64
        Where each vertex is: equal for those at one place.
    plane : (4,) float64, optional
        Of a half model the plane of its mirror, as its normal of length 1 and its distance from the origin. Without
        it, planes in which the mesh is its own mirror image are sought.

    Returns
    -------
    is_interior : (p,) bool, or None
        Which polygons are; None if none are.
    """
    mesh = given.triangles
    for one in _planes(mesh) if plane is None else [plane]:
        height = inner_products(mesh.vertices, one[:3]) - one[3]
        near = np.abs(height) <= FLAT * mesh.diagonal
        lies = near[mesh.faces].all(axis=1)
        if mesh.face_area[lies].sum() < LEAST * mesh.area:
            continue
        if plane is None and not _is_mirrored(mesh, one, height, near):
            continue
        within = _within(mesh, one, _Section.of(mesh, _numbers(mesh, place, near), lies))
        if mesh.face_area[within].sum() < LEAST * mesh.area:
            continue
        if plane is None and not _is_body(mesh, place, one, within):
            continue
        others, its = (np.bincount(given.polygon[some], minlength=given.n_polygons) for some in (~within, within))
        is_interior = (its > 0) & (others == 0)  # a polygon may have no triangle
        return is_interior if is_interior.any() else None
    return None


def _planes(mesh: TriMesh) -> Iterator[np.ndarray]:
    """Planes of faces that pass the middle of the surface, as in ``find_interior``; those of larger faces first."""
    middle = weighted_sum(mesh.face_area, mesh.face_centroids) / mesh.area
    away = row_products(mesh.area_normals, mesh.face_centroids - middle)
    left = np.flatnonzero(np.abs(away) <= OFF_MIDDLE * mesh.diagonal * mesh.face_area)
    for _ in range(TRIES):
        if mesh.face_area[left].sum() < LEAST * mesh.area:
            return
        normal = mesh.area_normals[left]
        cosine = inner_products(unit(normal), unit(normal[mesh.face_area[left].argmax()][None])[0])
        its = np.abs(cosine) > PARALLEL
        mean = unit((np.sign(cosine[its])[:, None] * normal[its]).sum(axis=0)[None])[0]
        area, distance = mesh.face_area[left[its]], inner_products(mesh.face_centroids[left[its]], mean)
        yield np.append(mean, (area * distance).sum() / area.sum())
        left = left[~its]


def _is_mirrored(mesh: TriMesh, plane: np.ndarray, height: np.ndarray, near: np.ndarray) -> bool:
    """Whether a plane mirrors most vertices beside it onto others.

    height : (n,) float64, of all vertices above it. near : (n,) bool, which of them are in it.
    """
    from ..arrays.nearest import nearest, search_tree  # imported here for the reason that arrays.components gives

    beside = mesh.used & ~near
    above, below = (np.flatnonzero(beside & some) for some in (height > 0, height < 0))
    if not (len(above) and len(below)) or min(len(above), len(below)) < MIRRORED * max(len(above), len(below)):
        return False
    image = mesh.vertices[above] - 2 * height[above, None] * plane[:3]
    distance = nearest(search_tree(mesh.vertices[below]), image)[0]
    return bool((distance <= IMAGE * mesh.diagonal).mean() >= MIRRORED)


def _within(mesh: TriMesh, plane: np.ndarray, section: _Section) -> np.ndarray:
    """Which faces in a plane are within the solid, (m,) bool; section : the triangles in it.

    Told patch by patch, by the faces that stand on their sides: those look away from what is within.
    """
    has_standing = section.n_standing > 0
    count, patch = _patches(section.side, has_standing)
    is_border = (np.bincount(section.side.ravel(), minlength=len(has_standing)) == 1) & ~has_standing
    is_open = np.bincount(patch, is_border[section.side].any(axis=1), count) > 0
    inverted = row_products(mesh.area_normals, mesh.face_centroids - plane[3] * plane[:3]).sum() < 0
    pull = section.pull() * (-1.0 if inverted else 1.0)
    towards = np.bincount(patch, pull.sum(axis=1), count)
    is_within = ~is_open & (towards < -WITHIN * np.bincount(patch, np.abs(pull).sum(axis=1), count))
    return np.append(is_within[patch], False)[section.of_face]


@dataclass(frozen=True, eq=False)
class _Section:
    """The triangles in a plane, each place once, and what stands on their sides.

    Attributes
    ----------
    points : (c, 3) float64
        Places in the plane.
    flat : (k, 3) int64
        Places of the corners of each triangle.
    of_face : (m,) int64
        The triangle that each face of the mesh is; -1 for none.
    side : (k, 3) int64
        Edge, 0..e-1, that begins at each corner.
    n_standing : (e,) int64
        How many faces of the mesh that are not in the plane have each edge.
    outwards : (e, 3) float64
        Sum of their normals.
    """

    points: np.ndarray
    flat: np.ndarray
    of_face: np.ndarray
    side: np.ndarray
    n_standing: np.ndarray
    outwards: np.ndarray

    @classmethod
    def of(cls, mesh: TriMesh, number: np.ndarray, lies: np.ndarray) -> _Section:
        """number : (n,) int64, place of each vertex that is in the plane, -1 for others. lies : (m,) bool, faces."""
        count, corner = int(number.max()) + 1, np.sort(number[mesh.faces], axis=1)
        face = np.flatnonzero(lies & (corner[:, 0] < corner[:, 1]) & (corner[:, 1] < corner[:, 2]))
        flat, index = np.unique(corner[face], axis=0, return_inverse=True)
        of_face = full(mesh.n_faces, -1)
        of_face[face] = index.reshape(-1)
        standing = np.flatnonzero((corner[:, 0] < 0) & (corner[:, 1] >= 0) & (corner[:, 1] < corner[:, 2]))
        edge = renumbered(np.concatenate([edge_keys(flat, np.roll(flat, -1, axis=1), count=count).ravel(),
                                          edge_keys(corner[standing, 1], corner[standing, 2], count=count)]))[1]
        side, foot = edge[:flat.size].reshape(-1, 3), edge[flat.size:]
        n_edges, points = int(edge.max(initial=-1)) + 1, np.empty((count, 3))
        points[number[number >= 0]] = mesh.vertices[number >= 0]
        return cls(points, flat, of_face, side, np.bincount(foot, minlength=n_edges),
                   sums_by(foot, unit(mesh.area_normals[standing]), n_edges))

    def pull(self) -> np.ndarray:
        """How much what stands on each side looks across it to the triangle, times the side's length, (k, 3) float64.

        Above 0 where the triangle is outside, and 0 where nothing stands, or where its corners lie on a line.
        """
        corner = self.points[self.flat]
        along, across = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
        length = np.linalg.norm(along, axis=2)
        across = across - along * ((across * along).sum(axis=2) / np.maximum(length, 1e-300)**2)[:, :, None]
        far = np.linalg.norm(across, axis=2)
        across = np.where((far > SLIVER * length)[:, :, None], across / np.maximum(far, 1e-300)[:, :, None], 0.0)
        return length * (across * self.outwards[self.side]).sum(axis=2)


def _numbers(mesh: TriMesh, place: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Numbers of chosen vertices, those that are at one place but for rounding alike, and -1 of others: (n,) int64.

    place : (n,) uint64, equal for vertices at one place. chosen : (n,) bool.
    """
    from scipy.spatial import cKDTree  # imported here for the reason that arrays.components gives

    some, number = np.flatnonzero(chosen), full(mesh.n_vertices, -1)
    _, first, index = np.unique(place[some], return_index=True, return_inverse=True)
    points = mesh.vertices[some[first]]
    near = cKDTree(points).query(points, FEW, distance_upper_bound=SAME * mesh.diagonal)[1]
    found = near < len(points)
    _, group = components(len(points), np.nonzero(found)[0], near[found])
    number[some] = group[index.reshape(-1)]
    return number


def _patches(side: np.ndarray, parts: np.ndarray) -> tuple[int, np.ndarray]:
    """How many patches triangles form, and the patch of each, (k,) int64.

    side : (k, 3) int64, edges of the triangles. parts : (e,) bool, edges at which patches end.
    """
    triangle, edge = np.repeat(arange(len(side)), 3), side.ravel()
    joins = ~parts[edge]
    _, group = components(len(side) + len(parts), triangle[joins], len(side) + edge[joins])
    _, patch = renumbered(group[:len(side)])
    return int(patch.max(initial=-1)) + 1, patch


def _is_body(mesh: TriMesh, place: np.ndarray, plane: np.ndarray, within: np.ndarray) -> bool:
    """Whether the bodies with interior faces, (m,) bool, are most of the mesh, and its halves are no boards.

    place : (n,) uint64. plane : (4,) float64, in which they are.
    """
    count, piece = pieces_by_place(mesh, place)
    body = (np.bincount(piece, within, count) > 0)[piece]
    if mesh.face_area[body].sum() < MOST_OF_MESH * mesh.area:
        return False
    upper = np.flatnonzero(body & (inner_products(mesh.face_centroids, plane[:3]) > plane[3]) & ~within)
    if not len(upper):
        return False
    # Seen from a point of the plane, what closes the half there encloses nothing.
    volume = row_products(mesh.area_normals[upper], mesh.face_centroids[upper] - plane[3] * plane[:3]).sum()
    return not fills_its_box(mesh.vertices[np.unique(mesh.faces[upper])], float(abs(volume)) / 3)
