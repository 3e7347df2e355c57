# SPDX-License-Identifier: GPL-3.0-or-later
"""Features by which the model judges a cut: the shape of the cut, of the regions on both sides, and of their union.

All features are computed from sums of the measures (measures.py), which add up when regions merge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays.ties import rounded, square_roots
from ...arrays.vectors import lengths, row_products
from .measures import BORDER, REGION, matrices, products

#: Features of one region. perimeter_ratio and extent_1 are in units of the square root of the region's area, extent_2
#: and extent_3 are shares of the longest extent, and other lengths are in units of the square root of the area of the
#: surface. "deviation" is a standard deviation.
SHAPE = (
    "log_area", "perimeter_ratio", "extent_1", "extent_2", "extent_3", "normal_moment_3", "normal_moment_1",
    "mean_normal", "log_thickness", "log_thickness_deviation", "slenderness", "log_clearance",
    "log_clearance_deviation", "log_contour", "log_contour_deviation", "level", "level_deviation", "level_min",
    "level_max", "agd", "volume", "angle_defect", "hollowness")
#: Features of the cut between a smaller and a larger region. 1, 2, 3 are the scales of curvature.SCALES, finest first;
#: "other" means the other borders of the region.
CUT = (
    "log_length", "length_small", "length_large", "share_small", "share_large", "distance",
    "curvature_1", "curvature_2", "curvature_3", "concavity_1", "concavity_2", "concavity_3",
    "creased_1", "creased_2", "creased_3", "dihedral", "level", "log_thickness", "log_thickness_small",
    "log_thickness_large", "log_clearance", "log_clearance_drop", "narrow_small", "narrow_large", "facing",
    "log_thickness_change", "level_change", "thickness_overlap", "other_concavity_small",
    "other_concavity_large", "other_dihedral_small", "other_dihedral_large", "climb", "descent",
    "distance_small", "distance_large", "neighbors_small", "neighbors_large", "curvature_by_thickness", "bend",
    "protrusion", "second_moment", "largest", "siblings_small", "siblings_union")
FEATURES = (*CUT, *(f"small_{s}" for s in SHAPE), *(f"large_{s}" for s in SHAPE),
            *(f"union_{s}" for s in SHAPE))
# Columns of REGION whose standard deviation is a feature: those of the squares, and of what they are squares of.
SQUARE = [REGION.log_thickness_square, REGION.log_clearance_square, REGION.log_contour_square, REGION.level_square]
SQUARE_OF = [REGION.log_thickness, REGION.log_clearance, REGION.log_contour, REGION.level]
# Least volume over area that a region counts with, in units of the square root of the area of the surface.
LEAST_VOLUME = 0.003
# Largest difference, in the unit of each feature, at which two regions count as siblings.
SIBLING = {"log_area": 0.4, "log_thickness": 0.3, "level": 0.15}


def region_shape(
    sums: np.ndarray, perimeter: np.ndarray, level_min: np.ndarray, level_max: np.ndarray
) -> np.ndarray:
    """Compute the shape of regions from their sums.

    Parameters
    ----------
    sums : (r, REGION.width) float64
        Sum over each region of ``SurfaceMeasures.face``.
    perimeter : (r,) float64
        Length of the cuts around each region, in units of the square root of the area of the surface.
    level_min, level_max : (r,) float64
        Lowest and highest level in each region, 0..1.

    Returns
    -------
    shape : (r, len(SHAPE)) float64
        The features SHAPE, in this order.
    """
    c = REGION
    area = np.maximum(sums[:, c.area], 1e-9)
    mean = sums / area[:, None]
    size = np.sqrt(area)
    center = mean[:, c.centroid]
    moments = np.concatenate([mean[:, c.second_moment] - products(center), mean[:, c.normal_moment]])
    moment, normal_moment = np.linalg.eigvalsh(matrices(moments)).reshape(2, -1, 3)
    extent = square_roots(moment, (np.abs(moment).max(axis=1) + row_products(center, center))[:, None])
    long = np.maximum(extent[:, 2], 1e-9)
    thickness = mean[:, c.log_thickness]
    volume = (sums[:, c.support] - row_products(center, sums[:, c.normal])) / 3
    log_size = 0.5 * np.log(area)
    square = mean[:, SQUARE]
    deviation = square_roots(square - mean[:, SQUARE_OF] ** 2, square)
    return _table({
        "log_area": 2 * log_size,
        "perimeter_ratio": perimeter / size,
        "extent_1": extent[:, 2] / size,
        "extent_2": extent[:, 1] / long,
        "extent_3": extent[:, 0] / long,
        "normal_moment_3": normal_moment[:, 0],
        "normal_moment_1": normal_moment[:, 2],
        "mean_normal": lengths(mean[:, c.normal]),
        "log_thickness": thickness,
        "log_thickness_deviation": deviation[:, 0],
        "slenderness": thickness - log_size,
        "log_clearance": mean[:, c.log_clearance],
        "log_clearance_deviation": deviation[:, 1],
        "log_contour": mean[:, c.log_contour],
        "log_contour_deviation": deviation[:, 2],
        "level": mean[:, c.level],
        "level_deviation": deviation[:, 3],
        "level_min": level_min,
        "level_max": level_max,
        "agd": mean[:, c.agd],
        "volume": volume / (area * size),
        "angle_defect": sums[:, c.angle_defect] / (2 * np.pi),
        "hollowness": np.exp(thickness) * area / np.maximum(volume, LEAST_VOLUME * area),
    }, SHAPE)


def _table(columns: dict[str, np.ndarray], names: tuple[str, ...]) -> np.ndarray:
    """Columns, (k,) each, side by side in the order of some names, (k, len(names))."""
    table = np.empty((len(columns[names[0]]), len(names)))
    for place, name in enumerate(names):  # a few short columns: np.stack takes three times as long
        table[:, place] = columns[name]
    return table


@dataclass(eq=False)
class RegionMeasures:
    """What is measured on regions while they merge, and changed by it; a region that merged keeps its row.

    Attributes
    ----------
    sums : (r, REGION.width) float64
        Sum over each region of ``SurfaceMeasures.face``.
    level_min, level_max : (r,) float64
        Lowest and highest level in each region, 0..1.
    agd_max : (r,) float64
        Highest AGD in each region above the lowest of the surface, in units of the square root of the area.
    perimeter : (r,) float64
        Length of the borders between each region and others, in units of the square root of the area; the border of
        an open surface does not count.
    degree : (r,) float64
        Number of neighbors of each region.
    around : (r, BORDER.width) float64
        Sum over all borders of each region of ``SurfaceMeasures.pair``.
    shape : (r, len(SHAPE)) float64
        Result of ``region_shape``, stored because it is needed often.
    alive : (r,) bool
        Whether each region has not yet merged into another.
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


def cut_features_(
    regions: RegionMeasures, ends: np.ndarray, border: np.ndarray, changed: Sequence[int] = ()
) -> np.ndarray:
    """Describe cuts between two regions by the features that the model judges.

    Parameters
    ----------
    regions : RegionMeasures
        Measures of r regions.
    ends : (k, 2) int64
        The two regions of each cut.
    border : (k, BORDER.width) float64
        Sum over each cut of ``SurfaceMeasures.pair``.
    changed : sequence of int
        Regions whose ``shape`` is out of date: it is brought up to date here.

    Returns
    -------
    features : (k, len(FEATURES)) float64
        The features FEATURES, in this order: of the cut, of the smaller region, of the larger region, of their union.
    """
    area = rounded(regions.sums[ends, REGION.area])
    index = np.where(area[:, 0] > area[:, 1], ends[:, ::-1].T, ends.T)
    length = np.maximum(border[:, BORDER.length], 1e-9)
    union = _shapes_(regions, index, length, changed)
    cut = _cut_columns(regions, _Sides.of(regions, index, border), border / length[:, None], length, union)
    return np.hstack([_table(cut, CUT), *regions.shape[index], union])


def _shapes_(regions: RegionMeasures, index: np.ndarray, length: np.ndarray, changed: Sequence[int]) -> np.ndarray:
    """Shape of the union of each two regions, (k, len(SHAPE)); brings up to date that of the changed ones.

    index : (2, k), the regions. length : (k,), of the cut between them. Few regions take as long as one: all in one go.
    """
    r, changed = regions, list(changed)
    perimeter, lowest, highest = r.perimeter[index], r.level_min[index], r.level_max[index]
    shape = region_shape(
        np.concatenate([r.sums[changed], r.sums[index].sum(axis=0)]),
        np.concatenate([r.perimeter[changed], np.maximum(perimeter[0] + perimeter[1] - 2 * length, 0.0)]),
        np.concatenate([r.level_min[changed], lowest.min(axis=0)]),
        np.concatenate([r.level_max[changed], highest.max(axis=0)]))
    r.shape[changed] = shape[:len(changed)]
    return shape[len(changed):]


@dataclass(frozen=True, eq=False)
class _Sides:
    """The smaller and the larger region beside each of k cuts, in this order.

    Attributes
    ----------
    index : (2, k) int64
        Region.
    mean : (2, k, REGION.width) float64
        Mean of ``SurfaceMeasures.face`` over the region, weighted by area.
    size : (2, k) float64
        Square root of the region's area.
    shape : dict of str -> (2, k) float64
        Shape of the region, by feature of SHAPE.
    other : (2, k, BORDER.width) float64
        Mean of ``SurfaceMeasures.pair`` over the region's other borders, weighted by length.
    """

    index: np.ndarray
    mean: np.ndarray
    size: np.ndarray
    shape: dict[str, np.ndarray]
    other: np.ndarray

    @classmethod
    def of(cls, regions: RegionMeasures, index: np.ndarray, border: np.ndarray) -> _Sides:
        """Look up the regions ``index``, (2, k), beside cuts whose sums are ``border``, (k, BORDER.width)."""
        sums = regions.sums[index]
        area = np.maximum(sums[..., REGION.area], 1e-9)
        rest = regions.around[index] - border
        least = 1e-3 * border[:, BORDER.length] + 1e-12
        other = rest / np.maximum(rest[..., BORDER.length], least)[..., None]
        shape = dict(zip(SHAPE, regions.shape[index].transpose(2, 0, 1), strict=True))
        return cls(index, sums / area[..., None], np.sqrt(area), shape, other)


def _cut_columns(
    regions: RegionMeasures, sides: _Sides, mean: np.ndarray, length: np.ndarray, union: np.ndarray
) -> dict[str, np.ndarray]:
    """The features CUT by name, (k,) each.

    mean : (k, BORDER.width), mean of the measures over each cut, weighted by length. length : (k,), of each cut.
    union : (k, len(SHAPE)), shape of the two regions of each cut together.
    """
    columns = _columns_of_cut(regions, sides, mean, length)
    siblings = _siblings(regions, np.stack([regions.shape[sides.index[0]], union]), sides.index)
    columns["siblings_small"], columns["siblings_union"] = siblings
    columns |= {f"{name}_{side}": of_side for name, both in _columns_of_sides(regions, sides, mean, length).items()
                for side, of_side in zip(("small", "large"), both, strict=True)}
    for name, runs in (("curvature", BORDER.curvature), ("concavity", BORDER.concavity), ("creased", BORDER.creased)):
        columns |= {f"{name}_{scale + 1}": column for scale, column in enumerate(mean[:, runs].T)}
    return columns


def _columns_of_cut(
    regions: RegionMeasures, sides: _Sides, mean: np.ndarray, length: np.ndarray
) -> dict[str, np.ndarray]:
    """Features of the cut itself and of how its two sides differ, (k,) each; parameters as of ``_cut_columns``."""
    r, b = REGION, BORDER
    middle, level, thickness, clearance = (mean[:, k] for k in (b.center, b.level, b.log_thickness, b.log_clearance))
    centroid, normal = sides.mean[..., r.centroid], sides.mean[..., r.normal]
    norm = np.linalg.norm(normal, axis=2)
    curvature = mean[:, b.curvature]
    spread = mean[:, b.second_moment] - row_products(middle, middle)
    return {
        "log_length": np.log(length),
        "distance": lengths(centroid[0] - centroid[1]) / sides.size[0],
        "dihedral": mean[:, b.dihedral],
        "level": level,
        "log_thickness": thickness,
        "log_clearance": clearance,
        "log_clearance_drop": clearance - sides.shape["log_clearance"].min(axis=0),
        "facing": row_products(*normal) / np.maximum(norm[0] * norm[1], 1e-9),
        "log_thickness_change": np.abs(np.subtract(*sides.shape["log_thickness"])),
        "level_change": np.subtract(*sides.shape["level"]),
        "thickness_overlap": sides.mean[..., r.thickness_bins].min(axis=0).sum(axis=1),
        "climb": sides.shape["level_max"][0] - level,
        "descent": level - sides.shape["level_min"][0],
        "curvature_by_thickness": curvature[:, 1] * np.exp(thickness),
        "bend": curvature[:, 2] * length,
        "protrusion": (regions.agd_max[sides.index[0]] - mean[:, b.agd]) / length,
        "second_moment": square_roots(spread, mean[:, b.second_moment]) / length,
        "largest": np.full(len(length), regions.sums[regions.alive, r.area].max()),
    }


def _columns_of_sides(
    regions: RegionMeasures, sides: _Sides, mean: np.ndarray, length: np.ndarray
) -> dict[str, np.ndarray]:
    """Features of the cut in relation to each of its sides, (2, k) each; parameters as of ``_cut_columns``."""
    b = BORDER
    return {
        "length": length / sides.size,
        "share": length / np.maximum(regions.perimeter[sides.index], length),
        "log_thickness": mean[:, b.log_thickness] - sides.shape["log_thickness"],
        "narrow": mean[:, b.log_contour] - sides.shape["log_contour"],
        "other_concavity": sides.other[..., b.concavity.start + 1],
        "other_dihedral": sides.other[..., b.dihedral],
        "distance": np.linalg.norm(sides.mean[..., REGION.centroid] - mean[:, b.center], axis=2) / sides.size,
        "neighbors": regions.degree[sides.index],
    }


def _siblings(regions: RegionMeasures, shape: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Number of siblings, (s, k): other regions of nearly that area, thickness and level, such as a table's other legs.

    shape : (s, k, len(SHAPE)), what regions are compared with. ends : (2, k), regions that do not count.
    """
    live = np.flatnonzero(regions.alive)
    like = np.empty((*shape.shape[:2], len(live)), bool)
    like[:] = (live != ends[0][:, None]) & (live != ends[1][:, None])
    for name, limit in SIBLING.items():
        column = SHAPE.index(name)
        apart = regions.shape[live, column] - shape[..., column, None]
        like &= np.abs(apart, out=apart) < limit
    return like.sum(axis=2).astype(float)
