# SPDX-License-Identifier: GPL-3.0-or-later
"""The mirror twin of each face, and the planes in which all faces are exact mirror images."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays.int64 import arange, full
from ..arrays.vectors import inner_products, second_moments
from ..mesh.labels import majority
from .plane import MirrorPlane
from .search import EXACT, is_exact, judged, oriented
from .small_faces import DENSE, Elements, SmallFaces

# How far a mirrored face may lie beside the surface where twins are found, on a model bent to one side a little; in
# units of the size.
BENT = 0.03
# Number of faces from which on they are small enough to be mirrored where the tessellation is not; share of the area
# that must have exact twins on a mesh of fewer, if its faces are to be.
MANY_FACES, MOSTLY = 3_000, 0.5
# Upper bounds of the points that stand for the surface, and that are mirrored, where a plane across another is judged.
ACROSS = 2_000, 200
# Planes across another are looked for by moments of z^m, m to MOST_RAYS; one is 0 if below UNEVEN of what it can be.
MOST_RAYS, UNEVEN = 12, 0.01
MOST_TURNED = 20_000  # number of polygons up to which planes that meet at other angles are looked for
ROUND = 0.01  # relative difference of two principal moments below which a shape may be its own image when turned
SQUARE = 0.01  # cosine of the angle from which on planes are not across each other


@dataclass(frozen=True, eq=False)
class Images:
    """What a plane does to small faces and to the polygons in which they lie.

    Attributes
    ----------
    faces : SmallFaces
    plane : MirrorPlane
    """

    faces: SmallFaces
    plane: MirrorPlane

    @cached_property
    def twins(self) -> np.ndarray:
        """(n_polygons,) int64, the polygon that is the mirror image of each, or on which most of its image lies.

        -1 where there is none.
        """
        faces, elements, n_polygons = self.faces, self.faces.elements, self.faces.n_polygons
        if n_polygons == len(elements.area) > DENSE:
            return self.small
        # Halves of a face that was split vote alike to the last digit, whatever the pose.
        weight = np.round(elements.area, 9) + 1e-12
        image_in = np.where(self.small >= 0, faces.polygon[self.small], -1)
        twin = np.maximum(majority(faces.polygon, image_in + 1, weight, n_polygons) - 1, -1)
        image, same = self._polygons
        twin[faces.present[same]] = faces.present[image[same]]
        return twin

    @cached_property
    def small(self) -> np.ndarray:
        """(m,) int64, the small face that is the mirror image of each; -1 where there is none."""
        matched = self.faces.elements.matched(self._image, self._nearest, BENT)
        return np.where(matched, self._nearest, -1)

    @cached_property
    def within(self) -> list[Images]:
        """The planes in which to mirror small faces, as polygons are too large; none where they are not.

        Polygons are too large if there are few of them and most of the area has no exact image. The first of the planes
        is this one. If it mirrors nearly all of the shape, other planes that do so follow, all at right angles to it
        and to each other.
        """
        faces = self.faces
        if faces.n_polygons >= MANY_FACES or faces.polygons.area[self._polygons[1]].sum() >= MOSTLY:
            return []
        found = [self]
        for other in self._likely_across if self.plane.share >= 1 - EXACT else []:
            if all(abs(other.plane.normal @ known.plane.normal) < SQUARE for known in found):
                found.append(other)
        return found

    @cached_property
    def exact(self) -> list[Images]:
        """Planes, this one and others across it, in which all polygons are exact mirror images.

        This one first, then none, one or two others, all across each other; empty if polygons are no exact images in
        this one. Which of two planes mirrors first makes no difference. Dense meshes are not looked at.
        """
        if self.faces.n_polygons > DENSE or not self._permutes:
            return []
        found = [self]
        for other in self._likely_across:
            image = other._polygons[0]
            known = [images._polygons[0] for images in found]
            if other._permutes and all(np.array_equal(image[before], before[image]) for before in known):
                found.append(other)
        return found

    @cached_property
    def meeting(self) -> list[Images]:
        """Two planes, next to each other, of three or more that meet in an axis, in which all polygons are exact.

        These two and those of ``exact`` generate the group of all symmetries of a star or a gear.
        Empty if there are no such planes; meshes of more than MOST_TURNED polygons are not looked at.
        """
        polygons = self.faces.polygons
        if not self.exact or self.faces.n_polygons > MOST_TURNED:
            return []
        for axis in (self.plane.normal, *_round_axes(polygons)):
            lines = [oriented(normal, 0.0) for normal in _across(polygons, axis)]
            lines = [plane for plane in lines if is_exact(polygons, plane)] if len(lines) > 2 else []
            two = [Images(self.faces, self.faces.outwards(plane)) for plane in lines[:2]]
            if len(lines) > 2 and all(images._permutes for images in two):
                return two
        return []

    @property
    def exact_twins(self) -> np.ndarray:
        """(n_polygons,) int64, the polygon nearest to the image of each; -1 for one without an area."""
        twin = full(self.faces.n_polygons, -1)
        twin[self.faces.present] = self.faces.present[self._polygons[0]]
        return twin

    @cached_property
    def _likely_across(self) -> list[Images]:
        """Planes through the middle, across this one, that match nearly all of the surface."""
        faces, elements = self.faces, self.faces.elements
        few, probes = elements.some(ACROSS[0]), elements.some(ACROSS[1])
        tried = [judged(oriented(normal, 0.0), few, probes) for normal in _across(faces.polygons, self.plane.normal)]
        return [Images(faces, faces.outwards(plane)) for plane in tried if plane.share >= 1 - EXACT]

    @property
    def _permutes(self) -> bool:
        """Whether all polygons are exact mirror images, and the image of each image is the polygon itself."""
        image, same = self._polygons
        return bool(same.all()) and np.array_equal(image[image], arange(len(image)))

    @cached_property
    def _local(self) -> MirrorPlane:
        """The plane in the frame of the elements."""
        return self.faces.inwards(self.plane)

    @cached_property
    def _image(self) -> Elements:
        """The image of each face."""
        return self.faces.elements.mirrored(self._local)

    @cached_property
    def _nearest(self) -> np.ndarray:
        """(m,) int64, the face nearest to the image of each."""
        return self.faces.elements.nearest(self._image)[1]

    @cached_property
    def _polygons(self) -> tuple[np.ndarray, np.ndarray]:
        """The polygon nearest to the image of each that has an area, (k,) int64, and whether it is exact, (k,) bool."""
        whole = self.faces.polygons
        image = self._image if whole is self.faces.elements else whole.mirrored(self._local)
        # Normals count as much as a polygon is wide: the two sides of a thin wall have the same center.
        nearest = self._nearest if whole is self.faces.elements else whole.nearest(image)[1]
        return nearest, whole.same(image, nearest)


def _round_axes(elements: Elements) -> list[np.ndarray]:
    """Unit vector along the axis about which a shape may be its own image when turned; none if moments tell of none."""
    value, vector = np.linalg.eigh(second_moments(elements.position, elements.area))
    alike = np.diff(value) <= ROUND * value[-1]
    return [vector[:, 2 * int(alike[0])]] if alike[0] != alike[1] else []


def _across(elements: Elements, normal: np.ndarray) -> np.ndarray:
    """Unit normals, (k, 3), across a given one, of the planes in which what is seen along it may be its own image.

    With z = x + iy of what is seen, a mirror line at the angle t turns the moment of z^m into its conjugate times
    exp(2imt): the angle of the first moment that is not 0 tells where the lines can be, whatever the number of rays.
    """
    axes = np.linalg.svd(normal[None])[2][1:]
    seen = inner_products(elements.position, axes[0]) + 1j * inner_products(elements.position, axes[1])
    for count in range(2, MOST_RAYS + 1):
        moment = (elements.area * seen**count).sum()
        if abs(moment) > UNEVEN * (elements.area * abs(seen) ** count).sum():
            angle = np.angle(moment) / count + np.pi / 2 + arange(count) * np.pi / count
            return np.cos(angle)[:, None] * axes[0] + np.sin(angle)[:, None] * axes[1]
    return np.empty((0, 3))
