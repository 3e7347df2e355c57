# SPDX-License-Identifier: GPL-3.0-or-later
"""What a part looks like by itself: where it is, how large and how far it extends, and what of it a model is asked.

Everything is relative to the whole: lengths to its diameter, areas to its area.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...arrays.int64 import arange, cumsum
from ...arrays.ties import square_roots
from ...arrays.vectors import middles_of_each, second_moments_of_each
from ...mesh.triangles import TriMesh
from ...surface.contact import SurfacePoints
from ...surface.ordering import EQUAL

ALIKE = 0.1  # how much the logarithms of area and extents of parts that repeat each other may differ
MOST_ALIKE = 10_000  # parts among which a part's repeats are counted; of more, as in heaps of loose faces, every few
# Lengths in units of the diameter. THIN is added to extents before their logarithms are taken, as those of a sheet are
# 0 but for rounding; SPREAD before they divide what may lie far outside, and LEAST is what they are when they divide
# each other, as those of a point are 0, too.
THIN, SPREAD, LEAST = 0.003, 0.01, 1e-6
FARTHEST = 5.0  # standard deviations of a part that a point may be outside of it; farther is as far

#: Features of one part, see ``PartShapes.columns``.
PART = ("log_area", "extent_1", "extent_2", "extent_3", "repeats", "agd", "agd_deviation", "touched", "log_piece_area",
        "parts_of_piece", "flatness")


@dataclass(frozen=True, eq=False)
class PartShapes:
    """What c parts are like, each by itself; lengths in units of the diameter.

    Attributes
    ----------
    piece : (c,) int64
        Piece that each part lies in.
    area, piece_area : (c,) float64
        Of each part and of its piece, share of the whole.
    center : (c, 3) float64
    extents : (c, 3) float64
        Standard deviations along the principal axes, the largest first.
    axes : (c, 3, 3) float64
        The principal axes, unit vectors, as columns in the order of the extents.
    space : (c, 3) int64
        Axes of equal extents have the same number: every direction of the space between them is a principal axis, and
        which of them are in ``axes`` is up to rounding.
    agd, agd_deviation : (c,) float64
        Mean of the normalized AGD over each part, and its standard deviation.
    """

    piece: np.ndarray
    area: np.ndarray
    piece_area: np.ndarray
    center: np.ndarray
    extents: np.ndarray
    axes: np.ndarray
    space: np.ndarray
    agd: np.ndarray
    agd_deviation: np.ndarray

    @classmethod
    def of(cls, mesh: TriMesh, label: np.ndarray, points: SurfacePoints, agd: np.ndarray) -> PartShapes:
        """Measure the parts of a mesh at points of its surface.

        Parameters
        ----------
        mesh : TriMesh
            m faces, n vertices.
        label : (m,) int64
            Part of each face, 0..c-1; a part lies in one piece.
        points : SurfacePoints
            Of the mesh, some of each part and each of more than no area; lengths in units of the diameter.
        agd : (n,) float64
            Normalized, 0..1.

        Returns
        -------
        shapes : PartShapes
        """
        part, weight, level = label[points.face], points.area, agd[points.vertex]
        count = int(label.max()) + 1
        area, center = middles_of_each(part, points.position, weight, count)
        moments = second_moments_of_each(part, points.position - center[part], weight, count) / area[:, None, None]
        mean = np.bincount(part, weight * level, count) / area
        square = np.bincount(part, weight * level**2, count) / area
        piece = np.zeros(count, np.int64)
        piece[label] = mesh.face_components[1]
        return cls(piece, area, np.bincount(piece, area)[piece], center, *_principal_axes(moments),
                   mean, square_roots(square - mean**2, square))

    def columns(self, touched: np.ndarray) -> dict[str, np.ndarray]:
        """The features PART by name, (c,) each. touched : (c,) float64, share of each part that is near another."""
        first, second, third = self.extents.T
        width = np.sqrt(self.area)  # of a square of the part's area
        return {
            "log_area": np.log(self.area), "extent_1": first / width, "extent_2": second / np.maximum(first, LEAST),
            "extent_3": third / np.maximum(first, LEAST), "repeats": self._repeats().astype(float), "agd": self.agd,
            "agd_deviation": self.agd_deviation, "touched": touched, "log_piece_area": np.log(self.piece_area),
            "parts_of_piece": np.bincount(self.piece)[self.piece].astype(float), "flatness": third / width,
        }

    def _repeats(self) -> np.ndarray:
        """(c,) int64, how many other parts are as large as each and extend as far."""
        logs = np.column_stack([0.5 * np.log(self.area), np.log(self.extents + THIN)])
        some = arange(len(logs)) % (len(logs) // MOST_ALIKE + 1) == 0
        tree = cKDTree(logs[some])
        return tree.query_ball_point(logs, np.nextafter(ALIKE, 0), p=np.inf, return_length=True) - some

    def unlikeness(self, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        """How much the extents of pairs of parts differ: (e,) float64, the largest difference of their logarithms.

        first, second : (e,) int64.
        """
        return np.abs(np.log(self.extents[first] + THIN) - np.log(self.extents[second] + THIN)).max(axis=1)

    def outside(self, one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """How far out the middle of a part lies in the spread of another, in its standard deviations, at most FARTHEST.

        Along the axis where this is most. Around the axis of a solid of revolution any turn of the others would do: one
        of them then points at that middle.

        one, other : (e,) int64. Returns (e,) float64.
        """
        offset = self.center[one] - self.center[other]
        along = np.einsum("ni,nij->nj", offset, self.axes[other])
        space = self.space[other]
        along = np.sqrt((along[:, :, None] ** 2 * (space[:, :, None] == space[:, None, :])).sum(axis=1))
        return np.minimum((along / (self.extents[other] + SPREAD)).max(axis=1), FARTHEST)


def _principal_axes(moments: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Extents, axes and spaces of parts, see ``PartShapes``; moments : (c, 3, 3), second central moments by area."""
    values, axes = np.linalg.eigh(moments)  # rising
    values, axes = values[:, ::-1], axes[:, :, ::-1]
    equal = np.diff(values) >= -EQUAL * values[:, :1] - 1e-16  # of what is but a point, too
    space = cumsum(np.insert(~equal, 0, False, axis=1), axis=1)
    return square_roots(values, values[:, :1]), axes, space
