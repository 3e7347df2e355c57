# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured on regions and on the cuts between them.

Everything is relative to the whole surface - lengths to the square root of its area, areas to
the area - and every sum is weighted by area or by length, so that neither scale nor pose nor the
density of the mesh matters. Sums over faces and over border edges add up when regions merge; what
a cut looks like is computed from the sums.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...field.agd import ScalarField, equalize
from ...graph.level_sets import LevelSets
from ...surface.curvature import angle_defect, curvature_across
from .thickness import LARGEST, thickness

CREASE = -3.0  # below this curvature a cut counts as creased
THICKNESS_BINS = 8


class Columns:
    """Names for runs of columns: ``Columns(area=1, centroid=3).centroid`` is ``slice(1, 4)``."""

    def __init__(self, **widths: int):
        self.width = 0
        for name, width in widths.items():
            setattr(self, name, self.width if width == 1 else slice(self.width, self.width + width))
            self.width += width


REGION = Columns(area=1, centroid=3, spread=6, normal=3, normal_spread=6, level=1, level2=1, agd=1,
                 inside=1, inside2=1, outside=1, outside2=1, reach=1, contour=1, contour2=1,
                 gauss=1, inside_bins=THICKNESS_BINS)
BORDER = Columns(length=1, curvature=3, hollow=3, creased=3, turn=1, level=1, agd=1, inside=1,
                 outside=1, contour=1, center=3, spread=1)


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
    inside, outside = (np.log(t / LARGEST) for t in thickness(mesh, agd))
    contour = np.log(_contour_length(sets))
    share = mesh.face_area / mesh.area
    center = (mesh.face_centroids - share @ mesh.face_centroids) / unit
    normal = mesh.face_normals
    face = np.column_stack([
        np.ones(mesh.n_faces), center, _products(center), normal, _products(normal),
        level, level**2, agd, inside, inside**2, outside, outside**2,
        (center * normal).sum(axis=1), contour, contour**2,
    ]) * share[:, None]
    face = np.column_stack([face, angle_defect(mesh), _bins(inside) * share[:, None]])
    curvature = curvature_across(mesh)
    a, b = mesh.edges.pairs.T
    middle = mesh.vertices[mesh.edges.vertices[mesh.edges.pair_edge]].mean(axis=1)
    middle = (middle - share @ mesh.face_centroids) / unit
    pair = np.column_stack([
        np.ones(len(a)), *curvature, *(np.minimum(c, 0.0) for c in curvature),
        *(curvature < CREASE), np.minimum(mesh.dihedral, 0.0),
        *((x[a] + x[b]) / 2 for x in (level, agd, inside, outside, contour)),
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


def _bins(inside: np.ndarray) -> np.ndarray:
    """(m, THICKNESS_BINS) one where the logarithm of the thickness falls."""
    low, width = np.log(0.02), -np.log(0.02) / THICKNESS_BINS
    bin_ = ((inside - low) / width).astype(np.int64).clip(0, THICKNESS_BINS - 1)
    return np.eye(THICKNESS_BINS)[bin_]


def _products(v: np.ndarray) -> np.ndarray:
    """(n, 6) products xx, yy, zz, xy, xz, yz of (n, 3) vectors."""
    x, y, z = v.T
    return np.stack([x * x, y * y, z * z, x * y, x * z, y * z], axis=1)


def _matrices(products: np.ndarray) -> np.ndarray:
    """(n, 3, 3) symmetric matrices of (n, 6) products."""
    return products[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)


SHAPE = ("area", "roundness", "extent", "extent_2", "extent_3", "flat_3", "flat_1", "facing",
         "inside", "inside_spread", "slenderness", "outside", "outside_spread", "contour",
         "contour_spread", "level", "level_spread", "level_min", "level_max", "agd", "volume",
         "gauss", "hollowness")


def region_shape(sums: np.ndarray, perimeter: np.ndarray, level_min, level_max) -> np.ndarray:
    """Shape of regions from their sums.

    Parameters
    ----------
    sums : (r, REGION.width) float64
    perimeter, level_min, level_max : (r,) float64

    Returns
    -------
    shape : (r, len(SHAPE)) float64
    """
    c = REGION
    area = np.maximum(sums[:, c.area], 1e-9)
    mean = sums / area[:, None]
    size = np.sqrt(area)
    center = mean[:, c.centroid]
    extent = np.sqrt(np.maximum(np.linalg.eigvalsh(
        _matrices(mean[:, c.spread] - _products(center))), 0.0))
    long = np.maximum(extent[:, 2], 1e-9)
    facing = np.linalg.eigvalsh(_matrices(mean[:, c.normal_spread]))
    inside, outside, contour, level = (mean[:, k] for k in (c.inside, c.outside, c.contour, c.level))

    def deviation(square, of):
        return np.sqrt(np.maximum(mean[:, square] - of**2, 0.0))

    volume = (sums[:, c.reach] - (center * sums[:, c.normal]).sum(axis=1)) / 3
    log_size = 0.5 * np.log(area)
    return np.stack([
        2 * log_size, perimeter / size, extent[:, 2] / size, extent[:, 1] / long,
        extent[:, 0] / long, facing[:, 0], facing[:, 2], np.linalg.norm(mean[:, c.normal], axis=1),
        inside, deviation(c.inside2, inside), inside - log_size,
        outside, deviation(c.outside2, outside), contour, deviation(c.contour2, contour),
        level, deviation(c.level2, level), level_min, level_max, mean[:, c.agd],
        volume / (area * size), sums[:, c.gauss] / (2 * np.pi),
        np.exp(inside) * area / np.maximum(volume, 0.003 * area),
    ], axis=1)


SIBLING = (0.4, 0.3, 0.15)  # how much log area, log thickness and level of like regions may differ
CUT = ("length", "length_small", "length_large", "share_small", "share_large", "distance",
       "curvature_1", "curvature_2", "curvature_3", "hollow_1", "hollow_2", "hollow_3", "creased_1",
       "creased_2", "creased_3", "turn", "level", "inside", "inside_small", "inside_large", "outside", "outside_drop",
       "narrow_small", "narrow_large", "facing", "inside_change", "level_change", "inside_overlap",
       "other_hollow_small", "other_hollow_large", "other_turn_small", "other_turn_large",
       "climb", "descent", "reach_small", "reach_large", "neighbours_small", "neighbours_large",
       "hollow_by_inside", "bend", "protrusion", "apart", "largest", "siblings_small", "siblings_union")
FEATURES = (*CUT, *(f"small_{s}" for s in SHAPE), *(f"large_{s}" for s in SHAPE),
            *(f"union_{s}" for s in SHAPE))


@dataclass(frozen=True, eq=False)
class RegionMeasures:
    """Live regions and borders while they merge, as their sums.

    Attributes
    ----------
    sums : (r, REGION.width) float64
    level_min, level_max, agd_max, perimeter, degree : (r,) float64
        Degree is the number of neighbors; perimeters leave out the borders of the surface.
    around : (r, BORDER.width) float64
        Sums over all borders of each region.
    shape : (r, len(SHAPE)) float64
        Of ``region_shape``; kept beside the sums because it is needed often.
    alive : (r,) bool
    """

    sums: np.ndarray
    level_min: np.ndarray
    level_max: np.ndarray
    agd_max: np.ndarray
    perimeter: np.ndarray
    degree: np.ndarray
    around: np.ndarray
    shape: np.ndarray
    alive: np.ndarray


def cut_features(regions: RegionMeasures, ends: np.ndarray, border: np.ndarray) -> np.ndarray:
    """What the cut between two regions looks like.

    Parameters
    ----------
    regions : RegionMeasures
    ends : (k, 2) int64
        The two regions of each cut.
    border : (k, BORDER.width) float64
        Sums over their common border.

    Returns
    -------
    features : (k, len(FEATURES)) float64
        Of the cut, of the smaller region, of the larger and of both together.
    """
    r, b = REGION, BORDER
    swap = regions.sums[ends[:, 0], r.area] > regions.sums[ends[:, 1], r.area]
    small, large = np.where(swap[:, None], ends[:, ::-1], ends).T
    length = np.maximum(border[:, b.length], 1e-9)
    union = region_shape(
        regions.sums[small] + regions.sums[large],
        np.maximum(regions.perimeter[small] + regions.perimeter[large] - 2 * length, 0.0),
        np.minimum(regions.level_min[small], regions.level_min[large]),
        np.maximum(regions.level_max[small], regions.level_max[large]))
    sides = [_Side.of(regions, index, border) for index in (small, large)]
    cut = _cut_columns(regions, *sides, border / length[:, None], length, union)
    return np.column_stack([*cut, regions.shape[small], regions.shape[large], union])


@dataclass(frozen=True, eq=False)
class _Side:
    """One side of each cut; rows follow the cuts."""

    index: np.ndarray
    mean: np.ndarray  # sums over the area
    size: np.ndarray  # square root of the area
    shape: dict
    other: np.ndarray  # means over the region's other borders

    @classmethod
    def of(cls, regions: RegionMeasures, index: np.ndarray, border: np.ndarray) -> _Side:
        area = np.maximum(regions.sums[index, REGION.area], 1e-9)
        rest = regions.around[index] - border
        least = 1e-3 * border[:, BORDER.length] + 1e-12
        other = rest / np.maximum(rest[:, BORDER.length], least)[:, None]
        shape = dict(zip(SHAPE, regions.shape[index].T, strict=True))
        return cls(index, regions.sums[index] / area[:, None], np.sqrt(area), shape, other)


def _cut_columns(regions, small, large, mean, length, union) -> list[np.ndarray]:
    """The columns named CUT."""
    r, b = REGION, BORDER
    u = dict(zip(SHAPE, union.T, strict=True))
    middle = mean[:, b.center]
    inside, outside, contour, level = (
        mean[:, k] for k in (b.inside, b.outside, b.contour, b.level))
    curvature, hollow = mean[:, b.curvature], mean[:, b.hollow]
    apart = np.linalg.norm(small.mean[:, r.centroid] - large.mean[:, r.centroid], axis=1)
    normals = [side.mean[:, r.normal] for side in (small, large)]
    norm = np.linalg.norm(normals[0], axis=1) * np.linalg.norm(normals[1], axis=1)
    reach = [np.linalg.norm(side.mean[:, r.centroid] - middle, axis=1) / side.size
             for side in (small, large)]
    overlap = np.minimum(small.mean[:, r.inside_bins], large.mean[:, r.inside_bins]).sum(axis=1)
    largest = np.full(len(length), regions.sums[regions.alive, r.area].max())
    like_small = _siblings(regions, small.shape, small.index, large.index)
    like_union = _siblings(regions, u, small.index, large.index)
    return [
        np.log(length), length / small.size, length / large.size,
        length / np.maximum(regions.perimeter[small.index], length),
        length / np.maximum(regions.perimeter[large.index], length), apart / small.size,
        *curvature.T, *hollow.T, *mean[:, b.creased].T, mean[:, b.turn], level,
        inside, inside - small.shape["inside"], inside - large.shape["inside"],
        outside, outside - np.minimum(small.shape["outside"], large.shape["outside"]),
        contour - small.shape["contour"], contour - large.shape["contour"],
        (normals[0] * normals[1]).sum(axis=1) / np.maximum(norm, 1e-9),
        np.abs(small.shape["inside"] - large.shape["inside"]),
        small.shape["level"] - large.shape["level"], overlap,
        small.other[:, b.hollow.start + 1], large.other[:, b.hollow.start + 1],
        small.other[:, b.turn], large.other[:, b.turn],
        small.shape["level_max"] - level, level - small.shape["level_min"], *reach,
        regions.degree[small.index], regions.degree[large.index],
        curvature[:, 1] * np.exp(inside), curvature[:, 2] * length,
        (regions.agd_max[small.index] - mean[:, b.agd]) / length,
        np.sqrt(np.maximum(mean[:, b.spread] - (middle**2).sum(axis=1), 0.0)) / length, largest,
        like_small, like_union,
    ]


def _siblings(regions: RegionMeasures, shape: dict, small, large) -> np.ndarray:
    """How many other live regions are as large, as thick and as far out: legs have siblings."""
    live = np.flatnonzero(regions.alive)
    like = (live != small[:, None]) & (live != large[:, None])
    for name, limit in zip(("area", "inside", "level"), SIBLING, strict=True):
        of_live = regions.shape[live, SHAPE.index(name)]
        like &= np.abs(of_live - shape[name][:, None]) < limit
    return like.sum(axis=1).astype(float)
