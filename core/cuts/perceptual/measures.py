# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of every face and of every pair of faces, taken once, before regions merge.

Lengths are in units of the square root of the area of the surface, areas are shares of it, and every column is weighted
by area or by length, so that neither scale nor pose nor the density of the mesh matters. The columns of several faces
or pairs add up; features.py computes the shape of regions and of the borders between them from the sums.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...arrays.vectors import row_products, weighted_sum
from ...field.agd import ScalarField, equalize
from ...graph.level_sets import LevelSets
from ...surface.curvature import angle_defect, curvature_across
from .thickness import LARGEST_BALL, thickness

THICKNESS_BINS = 8  # number of bins of the histogram of the logarithm of the thickness
THINNEST = 0.02  # thickness at which the first of these bins begins, in units of LARGEST_BALL, at which the last ends
SHORTEST, LONGEST = 0.01, 20.0  # bounds of the length of contours, in units of the square root of the area


class Columns:
    """Names for groups of consecutive columns.

    ``Columns(area=1, centroid=3)`` has the attributes ``area``, which is 0, ``centroid``, which is ``slice(1, 4)``, and
    ``width``, the number of columns, which is 4.

    Parameters
    ----------
    **widths : int
        Number of columns of each group, in order.
    """

    def __init__(self, **widths: int) -> None:
        self.width = 0
        for name, width in widths.items():
            setattr(self, name, self.width if width == 1 else slice(self.width, self.width + width))
            self.width += width

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Index of a column, or slice of a group of columns."""


# Columns per face. Moments are the six products of three coordinates; the support is the distance of the face's plane
# from the centroid of the surface; squares are there for standard deviations.
REGION = Columns(
    area=1, centroid=3, second_moment=6, normal=3, normal_moment=6, level=1, level_square=1, agd=1,
    log_thickness=1, log_thickness_square=1, log_clearance=1, log_clearance_square=1, support=1,
    log_contour=1, log_contour_square=1, angle_defect=1, thickness_bins=THICKNESS_BINS)
# Columns per pair of faces. Curvature, concavity (the negative part of curvature) and creased (1 if curvature is below
# CREASE) have one column per scale.
BORDER = Columns(
    length=1, curvature=3, concavity=3, creased=3, dihedral=1, level=1, agd=1, log_thickness=1,
    log_clearance=1, log_contour=1, center=3, second_moment=1)
CREASE = -3.0  # curvature below which a pair counts as creased, in units of 1 / sqrt(area)


@dataclass(frozen=True, eq=False)
class SurfaceMeasures:
    """Measures of each face and of each pair of faces; the sums over a region or a border describe its shape.

    Attributes
    ----------
    face : (m, REGION.width) float64
        Measures of each face, multiplied by its share of the area of the surface.
    pair : (p, BORDER.width) float64
        Measures of each pair of faces, multiplied by the length of their edge in units of the square root of the area.
    level : (m,) float64
        Equalized AGD of each face, 0..1.
    agd : (m,) float64
        AGD of each face above the lowest of the surface, in units of the square root of the area.
    """

    face: np.ndarray
    pair: np.ndarray
    level: np.ndarray
    agd: np.ndarray


def surface_measures(sets: LevelSets, field: ScalarField) -> SurfaceMeasures:
    """Measure every face and every pair of faces of a surface.

    Parameters
    ----------
    sets : LevelSets
        Level sets of one connected component, m faces and p pairs of faces.
    field : ScalarField
        AGD of the component.

    Returns
    -------
    measures : SurfaceMeasures
    """
    mesh = sets.mesh
    level = equalize(field.normalized, mesh.vertex_area)[mesh.faces].mean(axis=1)
    unit = np.sqrt(mesh.area)
    agd = (field.agd[mesh.faces].mean(axis=1) - field.agd.min()) / unit
    log_thickness, log_clearance = (np.log(radius / LARGEST_BALL) for radius in thickness(mesh, agd))
    log_contour = np.log(_contour_length(sets))
    share = mesh.face_area / mesh.area
    centroid = weighted_sum(share, mesh.face_centroids)
    center = (mesh.face_centroids - centroid) / unit
    normal = mesh.face_normals
    face = np.column_stack([
        np.ones(mesh.n_faces), center, products(center), normal, products(normal),
        level, level**2, agd, log_thickness, log_thickness**2, log_clearance, log_clearance**2,
        row_products(center, normal), log_contour, log_contour**2,
    ]) * share[:, None]
    face = np.column_stack([face, angle_defect(mesh), _bins(log_thickness) * share[:, None]])
    curvature = curvature_across(mesh)
    a, b = mesh.edges.pairs.T
    middle = (mesh.pair_middle - centroid) / unit
    pair = np.column_stack([
        np.ones(len(a)), *curvature, *(np.minimum(c, 0.0) for c in curvature),
        *(curvature < CREASE), np.minimum(mesh.dihedral, 0.0),
        *((x[a] + x[b]) / 2 for x in (level, agd, log_thickness, log_clearance, log_contour)),
        middle, row_products(middle, middle),
    ]) * (mesh.pair_length / unit)[:, None]
    return SurfaceMeasures(face, pair, level, agd)


def _contour_length(sets: LevelSets) -> np.ndarray:
    """Mean length of the contours at the slab pieces of each face, (m,), in units of the square root of the area."""
    pieces = sets.contour_pieces.T
    total = sum(np.bincount(p, sets.contour_length, sets.n_pieces) for p in pieces)
    count = sum(np.bincount(p, minlength=sets.n_pieces) for p in pieces)
    length = np.divide(total, count, out=np.full(sets.n_pieces, np.sqrt(sets.mesh.area)),
                       where=count > 0)
    area = sets.element_weight
    of_face = (np.bincount(sets.element_face, area * length[sets.element_piece], sets.mesh.n_faces)
               / np.bincount(sets.element_face, area, sets.mesh.n_faces))
    return np.clip(of_face / np.sqrt(sets.mesh.area), SHORTEST, LONGEST)


def _bins(log_thickness: np.ndarray) -> np.ndarray:
    """1 in the bin into which the logarithm of each thickness falls, 0 in the others: (m, THICKNESS_BINS)."""
    low, width = np.log(THINNEST), -np.log(THINNEST) / THICKNESS_BINS
    bin_ = ((log_thickness - low) / width).astype(np.int64).clip(0, THICKNESS_BINS - 1)
    return np.eye(THICKNESS_BINS)[bin_]


def products(v: np.ndarray) -> np.ndarray:
    """Multiply the coordinates of vectors with each other.

    v : (n, 3) float64. Returns the products xx, yy, zz, xy, xz, yz, (n, 6) float64.
    """
    x, y, z = v.T
    return np.stack([x * x, y * y, z * z, x * y, x * z, y * z], axis=1)


def matrices(products: np.ndarray) -> np.ndarray:
    """Arrange products of coordinates as symmetric matrices.

    products : (n, 6) float64, as ``products`` returns them. Returns (n, 3, 3) float64.
    """
    return products[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)
