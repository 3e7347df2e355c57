# SPDX-License-Identifier: GPL-3.0-or-later
"""Which parts are mirror images of which, for bones that are exact ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays.int64 import arange
from ...arrays.vectors import middles_of_each
from ...mesh.corners import CornerTable
from ...symmetry.plane import MirrorPlane

# Two parts have bones that are images if their middles are, within so much of the diagonal of the faces' centers, those
# of grounds left out. In 59 of 60 symmetric models of the benchmark, of artists and of a game all are, within 0.031.
_ALMOST = 0.05


@dataclass(frozen=True, eq=False)
class PartImages:
    """Which parts, or bones, are mirror images of which, so that bones are exact ones.

    Attributes
    ----------
    twin : (count,) int64
        The mirror image of each, itself if it is its own, -1 if it has none. Of two, the first is the one that is
        looked at.
    mirror : MirrorPlane or None
        In units of the vertices; None for a model that is symmetric but for its pose, whose bones are images by the
        tree that they make, not by their places.
    """

    twin: np.ndarray
    mirror: MirrorPlane | None

    @classmethod
    def of_parts(
        cls, twin: np.ndarray, mirror: MirrorPlane | None, middle: np.ndarray, size: float
    ) -> PartImages | None:
        """The parts of a mesh that is its own mirror image, or almost: what was posed beside a plane has no images.

        Parameters
        ----------
        twin : (count,) int64
            As of ``Parts``.
        mirror : MirrorPlane or None
        middle : (count, 3) float64
            Middle of the surface of each part.
        size : float
            Diagonal of the centers of all faces but those of grounds.

        Returns
        -------
        images : PartImages or None
            None if no part is its own image: one of two sides, on which nothing is between them, is the root.
        """
        if mirror is not None:
            there = np.maximum(twin, 0)
            off = np.linalg.norm(mirror.mirrored(middle) - middle[there], axis=1)
            twin = np.where((twin >= 0) & (np.maximum(off, off[there]) <= _ALMOST * size), twin, -1)
        images = cls(twin, mirror)
        return images if images.own.any() else None

    @property
    def image(self) -> np.ndarray:
        """(count,) int64, the mirror image of each, itself if it has none."""
        return np.where(self.twin < 0, arange(len(self.twin)), self.twin)

    @property
    def own(self) -> np.ndarray:
        """(count,) bool, which are their own images: their bones lie in the plane, if there is one."""
        return self.twin == arange(len(self.twin))

    @property
    def first(self) -> np.ndarray:
        """(count,) int64, the first of each and its image."""
        return np.minimum(self.image, arange(len(self.twin)))

    def of_bones(self, bone_part: np.ndarray, part_bone: np.ndarray) -> PartImages:
        """Those of bones of which several parts may have one; see ``limb_bones``."""
        twin = self.twin[bone_part]
        return PartImages(np.where(twin < 0, -1, part_bone[twin]), self.mirror)

    def onto_plane(self, points: np.ndarray) -> np.ndarray:
        """The feet of points, (k, 3), on the plane, (k, 3); without one the points."""
        return points if self.mirror is None else points - self.mirror.heights(points)[:, None] * self.mirror.normal

    def even(self, points: np.ndarray) -> np.ndarray:
        """Ends of bones, (count, 3), as images of each other: of two the first counts; their own are in the plane.

        Without a plane they stay where they are.
        """
        if self.mirror is None:
            return points
        first = points[self.first]
        image = self.first != arange(len(points))
        return np.where(self.own[:, None], self.onto_plane(points),
                        np.where(image[:, None], self.mirror.mirrored(first), points))


def face_weights(area: np.ndarray) -> np.ndarray:
    """Areas of faces, (p,), of which none is without one."""
    return np.maximum(area, 1e-12 * max(area.sum(), 1e-300))


def middles(table: CornerTable, labels: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The center of each part's surface, (count, 3), and the means of the faces' corners, (p, 3)."""
    center = table.face_means(table.vertices)
    return middles_of_each(labels, center, weight, int(labels.max()) + 1)[1], center
