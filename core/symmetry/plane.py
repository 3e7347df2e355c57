# SPDX-License-Identifier: GPL-3.0-or-later
"""A plane of symmetry and what it does to points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.vectors import inner_products


@dataclass(frozen=True, eq=False)
class MirrorPlane:
    """A plane of symmetry: the points x of normal @ x == offset.

    Attributes
    ----------
    normal : (3,) float64
        Of length 1; its component of largest size is positive.
    offset : float
    share : float
        Of the area whose mirror image lies on the surface, 0..1.
    """

    normal: np.ndarray
    offset: float
    share: float = 0.0

    @classmethod
    def of(cls, plane: np.ndarray) -> MirrorPlane:
        """The plane that is stored as its normal and its distance from the origin along it, (4,) float64."""
        return cls(plane[:3], float(plane[3]))

    def heights(self, points: np.ndarray) -> np.ndarray:
        """Signed distance of points, (k, 3), from the plane, (k,) float64."""
        return inner_products(points, self.normal) - self.offset

    def mirrored(self, points: np.ndarray) -> np.ndarray:
        """Mirror images of points, (k, 3)."""
        return points - 2.0 * self.heights(points)[:, None] * self.normal

    def turned(self, directions: np.ndarray) -> np.ndarray:
        """Mirror images of directions, (k, 3)."""
        return directions - 2.0 * inner_products(directions, self.normal)[:, None] * self.normal

    def moved(self, matrix: np.ndarray, shift: np.ndarray) -> MirrorPlane:
        """The plane of points y = matrix @ x + shift for the points x of this one.

        matrix : (3, 3) float64, exactly invertible for a plane to be there. shift : (3,) float64.
        """
        normal = np.linalg.pinv(matrix).T @ self.normal  # covariant
        length = max(float(np.linalg.norm(normal)), 1e-300)
        normal = normal / length
        return MirrorPlane(normal, self.offset / length + float(normal @ shift), self.share)


def positive_sign(direction: np.ndarray) -> float:
    """1.0 or -1.0, which makes the component of largest size of a direction, (3,), positive; of equals the first."""
    size = np.abs(direction)
    largest = int(np.argmax(size > (1 - 1e-6) * size.max()))
    return -1.0 if direction[largest] < 0 else 1.0
