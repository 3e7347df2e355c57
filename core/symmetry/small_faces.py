# SPDX-License-Identifier: GPL-3.0-or-later
"""Small faces that stand for a surface, and the search for those nearest to others."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ..arrays.indexing import even_steps, rounded_order, sums_by, taken
from ..arrays.int64 import arange
from ..arrays.nearest import nearest, search_tree
from ..arrays.vectors import lengths, row_products, weighted_sum
from ..mesh.triangles import TriMesh
from ..surface.contact import diameter
from .plane import MirrorPlane

# How much a turned normal counts where the nearest face is searched, in units of the size, so that the two sides of a
# wall are told apart.
TURNED = 0.02
SAME = 1e-6  # difference of distances, in units of the size, that is a rounding error
# A face is the exact image of another if their centers are nearer than this, in units of its area's root, and their
# areas differ by less, in units of its area.
NEAR = 0.02
# Number of faces from which on their centers alone are compared: faces are then much smaller than walls are thick.
DENSE = 100_000


@dataclass(frozen=True, eq=False)
class Elements:
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

    def some(self, count: int) -> Elements:
        """So many elements or fewer, at equal steps of area from the middle outwards; they count equally."""
        chosen = self._outwards[even_steps(self.area[self._outwards], count)]
        return Elements(self.position[chosen], self.normal[chosen], np.full(len(chosen), 1.0 / len(chosen)))

    @cached_property
    def _outwards(self) -> np.ndarray:
        """(k,) int64, the elements by their distance from the middle."""
        return rounded_order(row_products(self.position, self.position))

    @property
    def _centers_alone(self) -> bool:
        """Whether normals do not matter where the nearest of these elements is searched."""
        return len(self.position) > DENSE

    @property
    def _place(self) -> np.ndarray:
        """(k, 6), what is compared where normals matter."""
        return np.hstack([self.position, TURNED * self.normal])

    @cached_property
    def tree(self) -> cKDTree:
        """Of what is compared when the nearest of these elements is searched."""
        return search_tree(self.position if self._centers_alone else self._place, balanced=False)

    def nearest(self, image: Elements) -> tuple[np.ndarray, np.ndarray]:
        """Distance of the nearest element of each of some others, (k,) float64, and this element, (k,) int64.

        Of elements equally far, as on a regular grid, the first: rounding must not choose.
        """
        if self._centers_alone:
            return nearest(self.tree, image.position)
        place = image._place
        distance, near = nearest(self.tree, place, [1, 2])
        several = np.flatnonzero(distance[:, 1] <= distance[:, 0] + SAME)
        distance, near = distance[:, 0], near[:, 0]
        if len(several):  # to search for four takes a third longer
            further, few = nearest(self.tree, place[several], [1, 2, 3, 4])
            equal = further <= further[:, :1] + SAME
            near[several] = np.where(equal, few, len(self.position)).min(axis=1)
        return distance, near

    def matched(self, image: Elements, nearest: np.ndarray, most: float) -> np.ndarray:
        """Whether images lie on the surface, or beside it by so much, at the element nearest to each, (k,) bool."""
        offset = image.position - taken(self.position, nearest)
        beside = np.abs(row_products(offset, taken(self.normal, nearest)))
        spacing = 2.0 / np.sqrt(len(self.area))  # elements of a surface whose diameter and area are about 1
        aligned = row_products(image.normal, taken(self.normal, nearest)) > 0.5
        within = lengths(offset) <= most + spacing
        return (beside <= most) & within & aligned

    def same(self, image: Elements, nearest: np.ndarray) -> np.ndarray:
        """Whether images are exactly the elements nearest to each, but for rounding, (k,) bool."""
        there = self.chosen(nearest)
        same = lengths(image.position - there.position) <= NEAR * np.sqrt(image.area)
        same &= row_products(image.normal, there.normal) > 0.99 * row_products(image.normal, image.normal)
        return same & (np.abs(image.area - there.area) <= NEAR * image.area)

    def chosen(self, which: np.ndarray) -> Elements:
        """Some elements."""
        return Elements(taken(self.position, which), taken(self.normal, which), self.area[which])

    @classmethod
    def joined(cls, several: list[Elements]) -> Elements:
        """All elements of some sets, one set after the other."""
        return cls(*(np.concatenate([getattr(one, field.name) for one in several]) for field in fields(cls)))

    def mirrored(self, plane: MirrorPlane) -> Elements:
        """The mirror images."""
        return Elements(plane.mirrored(self.position), plane.turned(self.normal), self.area)


@dataclass(frozen=True, eq=False)
class SmallFaces:
    """Small faces that stand for a surface, and the polygons in which they lie.

    Attributes
    ----------
    mesh : TriMesh
        m faces, so small that their centers stand for the surface. Several pieces are mirrored as one.
    polygon : (m,) int64
        In which polygon each face lies.
    n_polygons : int
    """

    mesh: TriMesh
    polygon: np.ndarray
    n_polygons: int

    @classmethod
    def of(cls, mesh: TriMesh) -> SmallFaces:
        """Each face a polygon of its own."""
        return cls(mesh, arange(mesh.n_faces), mesh.n_faces)

    @cached_property
    def middle(self) -> np.ndarray:
        """(3,) float64, middle of the surface."""
        return np.asarray(weighted_sum(self.mesh.face_area / self.mesh.area, self.mesh.face_centroids))

    @cached_property
    def size(self) -> float:
        """Diameter of the surface; of several pieces, the root of its area if that is less."""
        across = diameter(self.mesh.face_centroids, self.mesh.face_area)
        # Pieces far from each other must not make the tolerances large.
        return across if self.mesh.face_components[0] == 1 else min(across, np.sqrt(self.mesh.area))

    @cached_property
    def elements(self) -> Elements:
        """The faces."""
        mesh = self.mesh
        return Elements((mesh.face_centroids - self.middle) / self.size, mesh.face_normals, mesh.face_area / mesh.area)

    @cached_property
    def present(self) -> np.ndarray:
        """(k,) int64, the polygons that have an area."""
        return np.flatnonzero(np.bincount(self.polygon, self.mesh.face_area, self.n_polygons) > 0)

    @cached_property
    def polygons(self) -> Elements:
        """The k polygons that have an area, with mean normals."""
        elements, polygon = self.elements, self.polygon
        if len(self.present) == self.mesh.n_faces and np.array_equal(polygon, self.present):
            return elements
        area = np.bincount(polygon, elements.area, self.n_polygons)[self.present]
        position, normal = (
            sums_by(polygon, elements.area[:, None] * vectors, self.n_polygons)[self.present] / area[:, None]
            for vectors in (elements.position, elements.normal))
        return Elements(position, normal, area)

    def inwards(self, plane: MirrorPlane) -> MirrorPlane:
        """A plane in the frame of the elements."""
        return MirrorPlane(plane.normal, float((plane.offset - self.middle @ plane.normal) / self.size), plane.share)

    def outwards(self, plane: MirrorPlane) -> MirrorPlane:
        """A plane of the elements in the frame of the mesh."""
        return MirrorPlane(plane.normal, float(self.size * plane.offset + self.middle @ plane.normal), plane.share)
