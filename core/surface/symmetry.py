# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane in which a surface, or most of it, is its own mirror image, and the mirror twin of each face.

Planes are tried across the principal axes and the axes of the coordinates, and each is improved as in the iterative
closest point method: points are mirrored, the nearest points of the surface found, and the plane laid anew halfway
between both [Podolak2006], [Besl1992].
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from .arrays import even_steps, inner_products, lengths, rounded_order, second_moments, weighted_sum
from .contact import diameter
from .labels import majority
from .mesh import TriMesh
from .mirror_plane import MirrorPlane
from .ordering import principal_axes

# In units of the size: how far a mirrored point may lie beside the surface where a plane is judged, and where twins
# are found, on a model bent to one side a little; and how much a turned normal counts where the nearest face is
# searched, so that the two sides of a wall are told apart.
MATCH, BENT, TURNED = 0.012, 0.03, 0.02
SAME = 1e-6  # difference of distances, in units of the size, that is a rounding error
LEAST = 0.85  # share of the area that must be matched for a plane to be one of symmetry
# Upper bounds of the points that stand for the surface, and that are mirrored: to choose among planes, and to find the
# place of one.
COARSE, FINE = (2_000, 200), (12_000, 1_000)
EQUAL = 0.05  # planes whose shares differ by less are equal: the first of them is taken, in all poses the same
LIKELY = 0.5  # share of the area that the best plane must match already when few points are looked at
# Number of faces from which on their centers alone are compared: faces are then much smaller than walls are thick.
DENSE = 100_000
# Number of points from which on it takes longer to search for their nearest than to start threads for it.
WORTH_THREADS = 5_000
# By how little a plane moves in a step, in its normal and its offset, when it is found, and when it is only to be told
# from others.
STILL, ROUGH = 1e-7, 3e-3
STEPS, KEPT = 30, 0.8  # how often a plane is improved, and by which share of the probes, the best ones
# Number of faces from which on they are small enough to be mirrored where the tessellation is not; share of the area
# that must have exact twins on a mesh of fewer.
MANY_FACES, MOSTLY = 3_000, 0.5
# A face is the exact twin of another if their centers, mirrored, are nearer than this, in units of its area's root; and
# a plane is exact if its share is less by this only.
EXACT = 0.02
# Planes across another are looked for by moments of z^m, m to MOST_RAYS; one is 0 if below UNEVEN of what it can be.
MOST_RAYS, UNEVEN = 6, 0.01


@dataclass(frozen=True, eq=False)
class _Elements:
    """Small faces of a surface, in units of its size and from its middle.

    Attributes
    ----------
    position, normal : (k, 3) float64
    area : (k,) float64
        Share of the area.
    """

    position: np.ndarray
    normal: np.ndarray
    area: np.ndarray

    @classmethod
    def of(cls, mesh: TriMesh) -> tuple[_Elements, np.ndarray, float]:
        """The faces of a mesh; and the middle and the size of the surface, its diameter or the root of its area."""
        area = mesh.face_area / mesh.area
        middle = weighted_sum(area, mesh.face_centroids)
        # Pieces far from each other must not make the tolerances large.
        size = min(diameter(mesh.face_centroids, mesh.face_area), np.sqrt(mesh.area))
        return cls((mesh.face_centroids - middle) / size, mesh.face_normals, area), middle, size

    def some(self, count: int) -> _Elements:
        """So many elements or fewer, at equal steps of area from the middle outwards; they count equally."""
        chosen = self._outwards[even_steps(self.area[self._outwards], count)]
        return _Elements(self.position[chosen], self.normal[chosen], np.full(len(chosen), 1.0 / len(chosen)))

    @cached_property
    def _outwards(self) -> np.ndarray:
        """(k,) int64, the elements by their distance from the middle."""
        return rounded_order((self.position**2).sum(axis=1))

    @property
    def place(self) -> np.ndarray:
        """(k, 6) or (k, 3), what is compared when the nearest element is searched."""
        if len(self.position) > DENSE:
            return self.position
        return np.hstack([self.position, TURNED * self.normal])

    @cached_property
    def tree(self) -> cKDTree:
        """Of the places."""
        return cKDTree(self.place, balanced_tree=False, compact_nodes=False)

    def nearest(self, image: _Elements) -> tuple[np.ndarray, np.ndarray]:
        """Distance of the nearest element of each of some others, (k,) float64, and this element, (k,) int64.

        Of elements equally far, as on a regular grid, the first: rounding must not choose.
        """
        if len(self.position) > DENSE:
            return self.tree.query(image.position, workers=-1)
        workers = -1 if len(image.position) > WORTH_THREADS else 1
        distance, nearest = self.tree.query(image.place, k=[1, 2, 3, 4], workers=workers)
        equal = distance <= distance[:, :1] + SAME
        return distance[:, 0], np.where(equal, nearest, len(self.position)).min(axis=1)

    @classmethod
    def joined(cls, several: list[_Elements]) -> _Elements:
        """All elements of some sets, one set after the other."""
        return cls(*(np.concatenate([getattr(one, field.name) for one in several]) for field in fields(cls)))

    def mirrored(self, plane: MirrorPlane) -> _Elements:
        """The mirror images."""
        return _Elements(plane.mirrored(self.position), plane.turned(self.normal), self.area)


def mirror_plane(mesh: TriMesh) -> MirrorPlane | None:
    """Find the plane in which most of a surface is its own mirror image.

    Parameters
    ----------
    mesh : TriMesh
        Of small faces: their centers stand for the surface. Several pieces are mirrored as one.

    Returns
    -------
    plane : MirrorPlane or None
        The one that matches most, if it matches LEAST of the area; none for a surface without an area.
    """
    if not mesh.area > 0:
        return None
    elements, middle, size = _Elements.of(mesh)
    few, probes = elements.some(COARSE[0]), elements.some(COARSE[1])
    start = [_oriented(normal, 0.0) for normal in _directions(elements)]
    tried = _improved(start, few, probes, ROUGH)
    share = max(plane.share for plane in tried)
    if share < LIKELY:
        return None
    chosen = next(k for k, plane in enumerate(tried) if plane.share >= share - EQUAL)
    many, probes = elements.some(FINE[0]), elements.some(FINE[1])
    best, = _improved([tried[chosen]], many, probes)
    if best.share < LEAST:
        return None
    if len(many.area) < mesh.n_faces:
        best, = _improved([best], elements, probes)
    # A plane through the middle, across a principal axis, is exact where the shape is, and the same in all poses.
    if (exact := _judged(start[chosen], many, probes)).share >= best.share - EXACT:
        best = exact
    return MirrorPlane(best.normal, float(size * best.offset + middle @ best.normal), best.share)


def _directions(elements: _Elements) -> np.ndarray:
    """Unit normals of the planes to try, (k, 3): the principal axes and the axes of the coordinates."""
    tried = list(principal_axes(second_moments(elements.position, elements.area), np.eye(3))[::-1])
    for axis in np.eye(3):
        if max(abs(axis @ known) for known in tried) < np.cos(np.deg2rad(3.0)):
            tried.append(axis)
    return np.array(tried)


def _improved(
    planes: list[MirrorPlane], surface: _Elements, probes: _Elements, still: float = STILL
) -> list[MirrorPlane]:
    """The planes of symmetry near given ones, and their shares; still : by how little a plane moves that is found."""
    planes, moving = list(planes), list(range(len(planes)))
    worst = int(KEPT * len(probes.area))
    for _ in range(STEPS):
        found = surface.nearest(_Elements.joined([probes.mirrored(planes[k]) for k in moving]))
        distance, nearest = (of_image.reshape(len(moving), -1) for of_image in found)
        used = distance <= np.partition(distance, worst, axis=1)[:, worst, None]
        before = [planes[k] for k in moving]
        for k, chosen, image in zip(moving, used, nearest, strict=True):
            planes[k] = _halfway(probes.position[chosen], surface.position[image[chosen]])
        moving = [k for k, plane in zip(moving, before, strict=True)
                  if np.abs(planes[k].normal - plane.normal).max() + abs(planes[k].offset - plane.offset) >= still]
        if not moving:
            break
    return [_judged(plane, surface, probes) for plane in planes]


def _judged(plane: MirrorPlane, surface: _Elements, probes: _Elements) -> MirrorPlane:
    """A plane with its share."""
    _, matched = _matched(probes.mirrored(plane), surface, MATCH)
    return MirrorPlane(plane.normal, plane.offset, float(probes.area[matched].sum()))


def _halfway(before: np.ndarray, after: np.ndarray) -> MirrorPlane:
    """The plane that mirrors points best onto others, (k, 3): across their differences, through their middles."""
    apart, middle = before - after, (before + after) / 2
    center = middle.mean(axis=0)
    every = np.ones(len(apart))
    across, along = second_moments(apart, every), second_moments(middle - center, every)
    scale = np.trace(across) or 1.0, np.trace(along) or 1.0
    normal = np.linalg.eigh(across / scale[0] - along / scale[1])[1][:, -1]
    return _oriented(normal, normal @ center)


def _oriented(normal: np.ndarray, offset: float) -> MirrorPlane:
    """A plane whose normal's component of largest size is positive."""
    size = np.abs(normal)
    largest = int(np.argmax(size > (1 - 1e-6) * size.max()))
    sign = -1.0 if normal[largest] < 0 else 1.0
    return MirrorPlane(sign * normal, float(sign * offset))


def _matched(image: _Elements, surface: _Elements, most: float) -> tuple[np.ndarray, np.ndarray]:
    """The nearest element of each image, and whether the image lies on the surface there, (k,) each."""
    _, nearest = surface.nearest(image)
    offset = image.position - surface.position[nearest]
    beside = np.abs((offset * surface.normal[nearest]).sum(axis=1))
    spacing = 2.0 / np.sqrt(len(surface.area))  # elements of a surface whose diameter and area are about 1
    aligned = (image.normal * surface.normal[nearest]).sum(axis=1) > 0.5
    within = lengths(offset) <= most + spacing
    return nearest, (beside <= most) & within & aligned


def face_twins(mesh: TriMesh, polygon: np.ndarray, n_polygons: int, plane: MirrorPlane) -> np.ndarray:
    """Find the mirror twin of each polygon.

    Parameters
    ----------
    mesh : TriMesh
        m small faces.
    polygon : (m,) int64
        In which each of them lies.
    n_polygons : int
    plane : MirrorPlane

    Returns
    -------
    twin : (n_polygons,) int64
        The polygon that is its mirror image, or on which most of its mirror image lies; -1 where there is none, and
        everywhere if there are few polygons and most of them have no exact image.
    """
    elements, middle, size = _Elements.of(mesh)
    local = MirrorPlane(plane.normal, float((plane.offset - middle @ plane.normal) / size))
    nearest, matched = _matched(elements.mirrored(local), elements, BENT)
    if n_polygons == mesh.n_faces > DENSE:
        return np.where(matched, nearest, -1)
    # Halves of a face that was split vote alike to the last digit, whatever the pose.
    weight = np.round(elements.area, 9) + 1e-12
    chosen = majority(polygon, np.where(matched, polygon[nearest] + 1, 0), weight, n_polygons) - 1
    return _exact_twins(elements, polygon, n_polygons, local, np.maximum(chosen, -1))


def exact_planes(
    mesh: TriMesh, polygon: np.ndarray, n_polygons: int, plane: MirrorPlane
) -> list[tuple[MirrorPlane, np.ndarray]]:
    """Find the planes, a given one and others across it, in which all polygons are exact mirror images.

    Parameters
    ----------
    mesh, polygon, n_polygons
        As for ``face_twins``.
    plane : MirrorPlane

    Returns
    -------
    planes : list of (MirrorPlane, twin)
        The given one first, then none, one or two others, all across each other; empty if polygons are no exact images
        in the given one. twin : (n_polygons,) int64, -1 for a polygon without an area. Which of two planes mirrors
        first makes no difference. Dense meshes are not looked at.
    """
    if plane.share < 1 - EXACT or n_polygons > DENSE:
        return []
    elements, middle, size = _Elements.of(mesh)
    given = MirrorPlane(plane.normal, float((plane.offset - middle @ plane.normal) / size), plane.share)
    whole, present = _polygons(elements, polygon, n_polygons)
    images, found = [], []
    for other in (given, *_likely_across(elements, whole, given)):
        image, same = _exact_images(whole, other)
        commutes = all(np.array_equal(image[known], known[image]) for known in images)
        if same.all() and commutes and np.array_equal(image[image], np.arange(len(image))):
            images.append(image)
            twin = np.full(n_polygons, -1)
            twin[present] = present[image]
            offset = float(size * other.offset + middle @ other.normal)
            found.append((MirrorPlane(other.normal, offset, other.share), twin))
        elif other is given:
            break
    return found


def _likely_across(elements: _Elements, whole: _Elements, plane: MirrorPlane) -> list[MirrorPlane]:
    """Planes through the middle, across a plane, that match nearly all of the surface. whole : see ``_polygons``."""
    few, probes = elements.some(COARSE[0]), elements.some(COARSE[1])
    tried = [_judged(_oriented(normal, 0.0), few, probes) for normal in _across(whole, plane.normal)]
    return [other for other in tried if other.share >= 1 - EXACT]


def _across(elements: _Elements, normal: np.ndarray) -> np.ndarray:
    """Unit normals, (k, 3), across a given one, of the planes in which what is seen along it may be its own image.

    With z = x + iy of what is seen, a mirror line at the angle t turns the moment of z^m into its conjugate times
    exp(2imt): the angle of the first moment that is not 0 tells where the lines can be, whatever the number of rays.
    """
    axes = np.linalg.svd(normal[None])[2][1:]
    seen = inner_products(elements.position, axes[0]) + 1j * inner_products(elements.position, axes[1])
    for count in range(2, MOST_RAYS + 1):
        moment = (elements.area * seen**count).sum()
        if abs(moment) > UNEVEN * (elements.area * abs(seen) ** count).sum():
            angle = np.angle(moment) / count + np.pi / 2 + np.arange(count) * np.pi / count
            return np.cos(angle)[:, None] * axes[0] + np.sin(angle)[:, None] * axes[1]
    return np.empty((0, 3))


def _exact_twins(
    elements: _Elements, polygon: np.ndarray, n_polygons: int, plane: MirrorPlane, chosen: np.ndarray
) -> np.ndarray:
    """The twins, (n_polygons,), with those polygons that are exact mirror images in their place."""
    whole, present = _polygons(elements, polygon, n_polygons)
    nearest, same = _exact_images(whole, plane)
    if n_polygons < MANY_FACES and whole.area[same].sum() < MOSTLY:
        return np.full(n_polygons, -1)
    twin = chosen.copy()
    twin[present[same]] = present[nearest[same]]
    return twin


def _polygons(elements: _Elements, polygon: np.ndarray, n_polygons: int) -> tuple[_Elements, np.ndarray]:
    """The k polygons that have an area, as elements with mean normals, and the number of each, (k,) int64."""
    area = np.bincount(polygon, elements.area, n_polygons)
    present = np.flatnonzero(area > 0)
    position, normal = (
        np.stack([np.bincount(polygon, elements.area * column, n_polygons) for column in columns.T], axis=1)[present]
        / area[present, None] for columns in (elements.position, elements.normal))
    return _Elements(position, normal, area[present]), present


def _exact_images(whole: _Elements, plane: MirrorPlane) -> tuple[np.ndarray, np.ndarray]:
    """The polygon nearest to the image of each, (k,) int64, and whether it is the exact image, (k,) bool."""
    image = whole.mirrored(plane)
    # Normals count as much as a polygon is wide: the two sides of a thin wall have the same center.
    _, nearest = whole.nearest(image)
    apart = np.linalg.norm(image.position - whole.position[nearest], axis=1)
    same = apart <= EXACT * np.sqrt(whole.area)
    same &= (image.normal * whole.normal[nearest]).sum(axis=1) > 0.99 * (whole.normal**2).sum(axis=1)
    same &= np.abs(whole.area - whole.area[nearest]) <= EXACT * whole.area
    return nearest, same
