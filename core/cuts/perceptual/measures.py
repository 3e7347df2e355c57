# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured on every face and every pair of faces, once, before anything merges.

Everything is relative to the whole surface - lengths to the square root of its area, areas to
the area - and every column is weighted by area or by length, so that neither scale nor pose nor the
density of the mesh matters. The columns of several faces or pairs add up, and what regions and the
borders between them look like is computed from the sums (features.py).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...field.agd import ScalarField, equalize
from ...graph.level_sets import LevelSets
from ...surface.curvature import angle_defect, curvature_across
from .thickness import LARGEST, thickness

THICKNESS_BINS = 8


class Columns:
    """Names for runs of columns: ``Columns(area=1, centroid=3).centroid`` is ``slice(1, 4)``."""

    def __init__(self, **widths: int):
        self.width = 0
        for name, width in widths.items():
            setattr(self, name, self.width if width == 1 else slice(self.width, self.width + width))
            self.width += width

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """The column of a name, or the slice of several."""


# Per face. Second moments are the six products of three coordinates; the support is the distance of the face's
# plane from the centroid of the surface; *_square is for standard deviations.
REGION = Columns(
    area=1, centroid=3, second_moment=6, normal=3, normal_moment=6, level=1, level_square=1, agd=1,
    log_thickness=1, log_thickness_square=1, log_clearance=1, log_clearance_square=1, support=1,
    log_contour=1, log_contour_square=1, angle_defect=1, thickness_bins=THICKNESS_BINS)
# Per pair of faces. Curvature, its negative part (concavity) and whether it is below CREASE, at three scales.
BORDER = Columns(
    length=1, curvature=3, concavity=3, creased=3, dihedral=1, level=1, agd=1, log_thickness=1,
    log_clearance=1, log_contour=1, center=3, second_moment=1)
CREASE = -3.0  # curvature below which a pair counts as creased, in units of 1 / sqrt(area)


@dataclass(frozen=True, eq=False)
class SurfaceMeasures:
    """Columns that add up, per face and per pair of faces.

    Attributes
    ----------
    face : (m, REGION.width) float64
        Weighted by the share of the area.
    pair : (p, BORDER.width) float64
        Weighted by the length of the edge.
    level, agd : (m,) float64
        Equalized AGD, 0..1, and the AGD above its minimum, relative to the surface.
    """

    face: np.ndarray
    pair: np.ndarray
    level: np.ndarray
    agd: np.ndarray


def surface_measures(sets: LevelSets, field: ScalarField) -> SurfaceMeasures:
    """Measure a surface once, before anything merges.

    Parameters
    ----------
    sets : LevelSets
        Of one connected component: its mesh and the contours of its field.
    field : ScalarField
        Its AGD.
    """
    mesh = sets.mesh
    level = equalize(field.normalized, mesh.vertex_area)[mesh.faces].mean(axis=1)
    unit = np.sqrt(mesh.area)
    agd = (field.agd[mesh.faces].mean(axis=1) - field.agd.min()) / unit
    log_thickness, log_clearance = (np.log(radius / LARGEST) for radius in thickness(mesh, agd))
    log_contour = np.log(_contour_length(sets))
    share = mesh.face_area / mesh.area
    center = (mesh.face_centroids - share @ mesh.face_centroids) / unit
    normal = mesh.face_normals
    face = np.column_stack([
        np.ones(mesh.n_faces), center, products(center), normal, products(normal),
        level, level**2, agd, log_thickness, log_thickness**2, log_clearance, log_clearance**2,
        (center * normal).sum(axis=1), log_contour, log_contour**2,
    ]) * share[:, None]
    face = np.column_stack([face, angle_defect(mesh), _bins(log_thickness) * share[:, None]])
    curvature = curvature_across(mesh)
    a, b = mesh.edges.pairs.T
    middle = mesh.vertices[mesh.edges.vertices[mesh.edges.pair_edge]].mean(axis=1)
    middle = (middle - share @ mesh.face_centroids) / unit
    pair = np.column_stack([
        np.ones(len(a)), *curvature, *(np.minimum(c, 0.0) for c in curvature),
        *(curvature < CREASE), np.minimum(mesh.dihedral, 0.0),
        *((x[a] + x[b]) / 2 for x in (level, agd, log_thickness, log_clearance, log_contour)),
        middle, (middle**2).sum(axis=1),
    ]) * (mesh.pair_length / unit)[:, None]
    return SurfaceMeasures(face, pair, level, agd)


def _contour_length(sets: LevelSets) -> np.ndarray:
    """(m,) mean length of the contours that bound each face's pieces, relative to the surface."""
    pieces = sets.contour_pieces.T
    total = sum(np.bincount(p, sets.contour_length, sets.n_pieces) for p in pieces)
    count = sum(np.bincount(p, minlength=sets.n_pieces) for p in pieces)
    length = np.divide(total, count, out=np.full(sets.n_pieces, np.sqrt(sets.mesh.area)),
                       where=count > 0)
    area = sets.element_area + 1e-12 * sets.mesh.area
    of_face = np.bincount(sets.element_face, area * length[sets.element_piece], sets.mesh.n_faces)
    of_face /= np.bincount(sets.element_face, area, sets.mesh.n_faces)
    return np.clip(of_face / np.sqrt(sets.mesh.area), 0.01, 20.0)


def _bins(log_thickness: np.ndarray) -> np.ndarray:
    """(m, THICKNESS_BINS) one where the logarithm of the thickness falls."""
    low, width = np.log(0.02), -np.log(0.02) / THICKNESS_BINS
    bin_ = ((log_thickness - low) / width).astype(np.int64).clip(0, THICKNESS_BINS - 1)
    return np.eye(THICKNESS_BINS)[bin_]


def products(v: np.ndarray) -> np.ndarray:
    """(n, 6) products xx, yy, zz, xy, xz, yz of (n, 3) vectors."""
    x, y, z = v.T
    return np.stack([x * x, y * y, z * z, x * y, x * z, y * z], axis=1)


def matrices(products: np.ndarray) -> np.ndarray:
    """(n, 3, 3) symmetric matrices of (n, 6) products."""
    return products[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)
