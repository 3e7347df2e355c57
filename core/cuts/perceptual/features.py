# SPDX-License-Identifier: GPL-3.0-or-later
"""Features by which the model judges a cut: the shape of the cut, of the regions on both sides, and of their union.

All features are computed from sums of the measures (measures.py), which add up when regions merge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...surface.arrays import rounded, square_roots
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
    moment = np.linalg.eigvalsh(matrices(mean[:, c.second_moment] - products(center)))
    extent = square_roots(moment, (np.abs(moment).max(axis=1) + (center**2).sum(axis=1))[:, None])
    long = np.maximum(extent[:, 2], 1e-9)
    normal_moment = np.linalg.eigvalsh(matrices(mean[:, c.normal_moment]))
    thickness = mean[:, c.log_thickness]
    volume = (sums[:, c.support] - (center * sums[:, c.normal]).sum(axis=1)) / 3
    log_size = 0.5 * np.log(area)

    def deviation(square: int, of: int) -> np.ndarray:
        """Standard deviation of column ``of``, whose squares are in column ``square``."""
        return square_roots(mean[:, square] - mean[:, of] ** 2, mean[:, square])

    columns = {
        "log_area": 2 * log_size,
        "perimeter_ratio": perimeter / size,
        "extent_1": extent[:, 2] / size,
        "extent_2": extent[:, 1] / long,
        "extent_3": extent[:, 0] / long,
        "normal_moment_3": normal_moment[:, 0],
        "normal_moment_1": normal_moment[:, 2],
        "mean_normal": np.linalg.norm(mean[:, c.normal], axis=1),
        "log_thickness": thickness,
        "log_thickness_deviation": deviation(c.log_thickness_square, c.log_thickness),
        "slenderness": thickness - log_size,
        "log_clearance": mean[:, c.log_clearance],
        "log_clearance_deviation": deviation(c.log_clearance_square, c.log_clearance),
        "log_contour": mean[:, c.log_contour],
        "log_contour_deviation": deviation(c.log_contour_square, c.log_contour),
        "level": mean[:, c.level],
        "level_deviation": deviation(c.level_square, c.level),
        "level_min": level_min,
        "level_max": level_max,
        "agd": mean[:, c.agd],
        "volume": volume / (area * size),
        "angle_defect": sums[:, c.angle_defect] / (2 * np.pi),
        "hollowness": np.exp(thickness) * area / np.maximum(volume, 0.003 * area),
    }
    return np.stack([columns[name] for name in SHAPE], axis=1)


@dataclass(frozen=True, eq=False)
class RegionMeasures:
    """What is measured on regions while they merge; a region that merged into another keeps its row.

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


def cut_features(regions: RegionMeasures, ends: np.ndarray, border: np.ndarray) -> np.ndarray:
    """Describe cuts between two regions by the features that the model judges.

    Parameters
    ----------
    regions : RegionMeasures
        Measures of r regions.
    ends : (k, 2) int64
        The two regions of each cut.
    border : (k, BORDER.width) float64
        Sum over each cut of ``SurfaceMeasures.pair``.

    Returns
    -------
    features : (k, len(FEATURES)) float64
        The features FEATURES, in this order: of the cut, of the smaller region, of the larger region, of their union.
    """
    r, b = REGION, BORDER
    area = rounded(regions.sums[:, r.area])
    swap = area[ends[:, 0]] > area[ends[:, 1]]
    small, large = np.where(swap[:, None], ends[:, ::-1], ends).T
    length = np.maximum(border[:, b.length], 1e-9)
    union = region_shape(
        regions.sums[small] + regions.sums[large],
        np.maximum(regions.perimeter[small] + regions.perimeter[large] - 2 * length, 0.0),
        np.minimum(regions.level_min[small], regions.level_min[large]),
        np.maximum(regions.level_max[small], regions.level_max[large]))
    cut = _cut_columns(regions, _Side.of(regions, small, border), _Side.of(regions, large, border),
                       border / length[:, None], length, union)
    return np.column_stack([*(cut[name] for name in CUT), regions.shape[small], regions.shape[large], union])


@dataclass(frozen=True, eq=False)
class _Side:
    """The regions on one side of k cuts, one row per cut.

    Attributes
    ----------
    index : (k,) int64
        Region.
    mean : (k, REGION.width) float64
        Mean of ``SurfaceMeasures.face`` over the region, weighted by area.
    size : (k,) float64
        Square root of the region's area.
    shape : dict of str -> (k,) float64
        Shape of the region, by feature of SHAPE.
    other : (k, BORDER.width) float64
        Mean of ``SurfaceMeasures.pair`` over the region's other borders, weighted by length.
    """

    index: np.ndarray
    mean: np.ndarray
    size: np.ndarray
    shape: dict
    other: np.ndarray

    @classmethod
    def of(cls, regions: RegionMeasures, index: np.ndarray, border: np.ndarray) -> _Side:
        """Look up the regions ``index``, (k,), beside cuts whose sums are ``border``, (k, BORDER.width)."""
        area = np.maximum(regions.sums[index, REGION.area], 1e-9)
        rest = regions.around[index] - border
        least = 1e-3 * border[:, BORDER.length] + 1e-12
        other = rest / np.maximum(rest[:, BORDER.length], least)[:, None]
        shape = dict(zip(SHAPE, regions.shape[index].T, strict=True))
        return cls(index, regions.sums[index] / area[:, None], np.sqrt(area), shape, other)


def _cut_columns(
    regions: RegionMeasures, small: _Side, large: _Side, mean: np.ndarray, length: np.ndarray, union: np.ndarray
) -> dict[str, np.ndarray]:
    """The features CUT by name, (k,) each.

    mean : (k, BORDER.width), mean of the measures over each cut, weighted by length. length : (k,), of each cut.
    union : (k, len(SHAPE)), shape of the two regions of each cut together.
    """
    r, b = REGION, BORDER
    u = dict(zip(SHAPE, union.T, strict=True))
    middle, level = mean[:, b.center], mean[:, b.level]
    thickness, clearance, contour = (mean[:, k] for k in (b.log_thickness, b.log_clearance, b.log_contour))
    curvature = mean[:, b.curvature]
    apart = np.linalg.norm(small.mean[:, r.centroid] - large.mean[:, r.centroid], axis=1)
    normals = [side.mean[:, r.normal] for side in (small, large)]
    norm = np.linalg.norm(normals[0], axis=1) * np.linalg.norm(normals[1], axis=1)
    spread = mean[:, b.second_moment] - (middle**2).sum(axis=1)
    columns = {
        "log_length": np.log(length),
        "distance": apart / small.size,
        "dihedral": mean[:, b.dihedral],
        "level": level,
        "log_thickness": thickness,
        "log_clearance": clearance,
        "log_clearance_drop": clearance - np.minimum(small.shape["log_clearance"], large.shape["log_clearance"]),
        "facing": (normals[0] * normals[1]).sum(axis=1) / np.maximum(norm, 1e-9),
        "log_thickness_change": np.abs(small.shape["log_thickness"] - large.shape["log_thickness"]),
        "level_change": small.shape["level"] - large.shape["level"],
        "thickness_overlap": np.minimum(small.mean[:, r.thickness_bins], large.mean[:, r.thickness_bins]).sum(axis=1),
        "climb": small.shape["level_max"] - level,
        "descent": level - small.shape["level_min"],
        "curvature_by_thickness": curvature[:, 1] * np.exp(thickness),
        "bend": curvature[:, 2] * length,
        "protrusion": (regions.agd_max[small.index] - mean[:, b.agd]) / length,
        "second_moment": square_roots(spread, mean[:, b.second_moment]) / length,
        "largest": np.full(len(length), regions.sums[regions.alive, r.area].max()),
        "siblings_small": _siblings(regions, small.shape, small.index, large.index),
        "siblings_union": _siblings(regions, u, small.index, large.index),
    }
    for name, side in (("small", small), ("large", large)):
        columns[f"length_{name}"] = length / side.size
        columns[f"share_{name}"] = length / np.maximum(regions.perimeter[side.index], length)
        columns[f"log_thickness_{name}"] = thickness - side.shape["log_thickness"]
        columns[f"narrow_{name}"] = contour - side.shape["log_contour"]
        columns[f"other_concavity_{name}"] = side.other[:, b.concavity.start + 1]
        columns[f"other_dihedral_{name}"] = side.other[:, b.dihedral]
        columns[f"distance_{name}"] = np.linalg.norm(side.mean[:, r.centroid] - middle, axis=1) / side.size
        columns[f"neighbors_{name}"] = regions.degree[side.index]
    for name, runs in (("curvature", b.curvature), ("concavity", b.concavity), ("creased", b.creased)):
        columns |= {f"{name}_{scale + 1}": column for scale, column in enumerate(mean[:, runs].T)}
    return columns


def _siblings(
    regions: RegionMeasures, shape: dict[str, np.ndarray], small: np.ndarray, large: np.ndarray
) -> np.ndarray:
    """Number of siblings, (k,): other regions of nearly that area, thickness and level, such as a table's other legs.

    shape : dict of str -> (k,), what regions are compared with. small, large : (k,), regions that do not count.
    """
    live = np.flatnonzero(regions.alive)
    like = (live != small[:, None]) & (live != large[:, None])
    for name, limit in SIBLING.items():
        of_live = regions.shape[live, SHAPE.index(name)]
        like &= np.abs(of_live - shape[name][:, None]) < limit
    return like.sum(axis=1).astype(float)
