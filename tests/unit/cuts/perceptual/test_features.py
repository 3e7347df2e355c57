# SPDX-License-Identifier: GPL-3.0-or-later
"""What the trees judge by, column by column: all of it worked out by hand, of four faces and of a cube."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapes

from core.cuts.perceptual.features import CUT, FEATURES, SHAPE, RegionMeasures, cut_features_, region_shape
from core.cuts.perceptual.measures import BORDER, REGION, THICKNESS_BINS, products, surface_measures
from core.field.agd import ScalarField
from core.graph.level_sets import cut_at_levels
from core.mesh.triangles import TriMesh


def row(columns, **values):
    """One row of columns by their names; zero where nothing is said."""
    made = np.zeros(columns.width)
    for name, value in values.items():
        made[getattr(columns, name)] = value
    return made


def four_faces(share=1 / 16, move=0.0, level=0.2, thickness=-2.0, bins=(1, 0), clearance=-1.0):
    """Sum of the measures of four faces around (2, 0, 0), which spread by 2 along x, 1 along y and a half along z."""
    center = np.array([(0, 1, 0.5), (4, 1, -0.5), (0, -1, -0.5), (4, -1, 0.5)]) + (move, 0, 0)
    normal = np.array([(-1.0, 0, 0), (1, 0, 0), (0, -1, 0), (1, 0, 0)])
    sign = np.array([-1, 1, -1, 1])
    logs = {"log_thickness": thickness + sign, "log_clearance": clearance + 0.5 * sign, "log_contour": 0.4 + 0.2 * sign,
            "level": level + 0.1 * sign}
    faces = [row(REGION, area=1, centroid=c, second_moment=products(c[None])[0], normal=n, support=c @ n,
                 normal_moment=products(n[None])[0], agd=k + 1, angle_defect=np.pi / 4 / share,
                 thickness_bins=[bins[k % 2]] + [0] * (THICKNESS_BINS - 2) + [1 - bins[k % 2]],
                 **{name: column[k] for name, column in logs.items()},
                 **{f"{name}_square": column[k] ** 2 for name, column in logs.items()})
             for k, (c, n) in enumerate(zip(center, normal, strict=True))]
    return share * np.sum(faces, axis=0)


def test_the_shape_of_four_faces():
    """Their area is a quarter, so that lengths are in units of a half. Of the normals half are opposite along x."""
    found = region_shape(four_faces()[None], np.array([3.0]), np.array([0.05]), np.array([0.4]))
    volume = (1 / 16) * (0 + 4 + 1 + 4 - 2) / 3  # heights over the middle, 2 of which the mean normal tells
    expected = {
        "log_area": np.log(0.25), "perimeter_ratio": 6.0, "extent_1": 4.0, "extent_2": 0.5, "extent_3": 0.25,
        "normal_moment_3": 0.0, "normal_moment_1": 0.75, "mean_normal": np.sqrt(2) / 4,
        "log_thickness": -2.0, "log_thickness_deviation": 1.0, "slenderness": -2.0 - np.log(0.5),
        "log_clearance": -1.0, "log_clearance_deviation": 0.5, "log_contour": 0.4, "log_contour_deviation": 0.2,
        "level": 0.2, "level_deviation": 0.1, "level_min": 0.05, "level_max": 0.4, "agd": 2.5,
        "volume": volume / 0.125, "angle_defect": 0.5, "hollowness": np.exp(-2) * 0.25 / volume}
    assert expected.keys() == set(SHAPE)
    assert dict(zip(SHAPE, found[0].tolist(), strict=True)) == pytest.approx(expected, abs=1e-7)


def pairs(length, slope=1.0):
    """Sum of the measures of a border of some length."""
    curvature, concavity = slope * np.array([(1, -2, 3), (0, -2, -1)])
    return length * row(BORDER, length=1, curvature=curvature, concavity=concavity, creased=(0, 1, 0.5),
                        dihedral=-0.3 * slope, level=0.3, agd=1.5, log_thickness=-1.5, log_clearance=-1.2,
                        log_contour=0.1, center=(1, 0, 2), second_moment=9.0)


def test_a_cut_between_a_larger_and_a_smaller_region():
    """The first is twice as large as the second, and 10 farther along x. The third is like the second; the fourth, the
    largest of all, has merged already."""
    sums = np.stack([four_faces(2 / 16, 10.0, 0.6, -1.0, (0, 0), -0.5), four_faces(bins=(1, 0)), four_faces(move=5.0),
                     four_faces(1.0)])
    lowest, highest = np.array([0.4, 0.05, 0.1, 0.0]), np.array([0.9, 0.45, 0.3, 1.0])
    perimeter = np.array([4.0, 2.0, 1.0, 1.0])
    cut, rest = pairs(0.5), pairs(1.5, slope=2.0)
    regions = RegionMeasures(
        sums, lowest, highest, np.array([9.0, 4.0, 5.0, 8.0]), perimeter, np.array([3.0, 2.0, 1.0, 0.0]),
        np.stack([cut, cut + rest, rest, rest]), region_shape(sums, perimeter, lowest, highest),
        np.array([True, True, True, False]))
    found = cut_features_(regions, np.array([(0, 1)]), cut[None])
    size = 0.5, np.sqrt(0.5)
    expected = {
        "log_length": np.log(0.5), "length_small": 0.5 / size[0], "length_large": 0.5 / size[1],
        "share_small": 0.5 / 2, "share_large": 0.5 / 4, "distance": 10 / size[0],
        "curvature_1": 1.0, "curvature_2": -2.0, "curvature_3": 3.0,
        "concavity_1": 0.0, "concavity_2": -2.0, "concavity_3": -1.0,
        "creased_1": 0.0, "creased_2": 1.0, "creased_3": 0.5,
        "dihedral": -0.3, "level": 0.3, "log_thickness": -1.5, "log_thickness_small": -1.5 + 2,
        "log_thickness_large": -1.5 + 1, "log_clearance": -1.2, "log_clearance_drop": -1.2 + 1,
        "narrow_small": 0.1 - 0.4, "narrow_large": 0.1 - 0.4, "facing": 1.0, "log_thickness_change": 1.0,
        "level_change": 0.2 - 0.6, "thickness_overlap": 0.5, "other_concavity_small": -4.0,
        "other_concavity_large": 0.0, "other_dihedral_small": -0.6, "other_dihedral_large": 0.0,
        "climb": 0.45 - 0.3, "descent": 0.3 - 0.05,
        "distance_small": np.sqrt(1 + 4) / size[0], "distance_large": np.sqrt(11**2 + 4) / size[1],
        "neighbors_small": 2.0, "neighbors_large": 3.0, "curvature_by_thickness": -2 * np.exp(-1.5), "bend": 3 * 0.5,
        "protrusion": (4 - 1.5) / 0.5, "second_moment": np.sqrt(9 - 5) / 0.5, "largest": 0.5,
        "siblings_small": 1.0, "siblings_union": 0.0}
    assert expected.keys() == set(CUT)
    assert dict(zip(FEATURES, found[0, :len(CUT)].tolist(), strict=False)) == pytest.approx(expected, abs=1e-7)
    small, large, union = found[0, len(CUT):].reshape(3, -1)
    np.testing.assert_array_equal(small, regions.shape[1])
    np.testing.assert_array_equal(large, regions.shape[0])
    np.testing.assert_allclose(union, region_shape(
        sums[:2].sum(axis=0)[None], np.array([4.0 + 2.0 - 2 * 0.5]), np.array([0.05]), np.array([0.9]))[0])


@pytest.mark.parametrize("scale", [1.0, 50.0])
def test_the_measures_of_a_cube(scale):
    """Twelve triangles, of which each is a twelfth of the area, 6; lengths are in units of its root. The field rises
    along z, and has one contour, around the middle."""
    mesh = TriMesh(*shapes.box())
    mesh = TriMesh(scale * (mesh.vertices - mesh.vertices.min(axis=0)) / np.ptp(mesh.vertices, axis=0), mesh.faces)
    z, unit = mesh.vertices[:, 2] / scale, np.sqrt(6.0)
    field = ScalarField(z, z, scale * (3 * z + 2))
    found = surface_measures(cut_at_levels(mesh, z, np.array([0.5])), field)
    corners = mesh.vertices[mesh.faces] / scale
    height = corners[..., 2].mean(axis=1)
    face = SimpleNamespace(**{name: 12 * found.face[:, getattr(REGION, name)] for name in (
        "area", "centroid", "second_moment", "normal", "normal_moment", "level", "level_square", "agd", "log_thickness",
        "log_thickness_square", "log_clearance", "log_clearance_square", "support", "log_contour",
        "log_contour_square", "thickness_bins")})
    center = (corners.mean(axis=1) - 0.5) / unit
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    for got, expected in (
            (face.area, np.ones(12)), (face.centroid, center), (face.second_moment, products(center)),
            (face.normal, normal), (face.normal_moment, products(normal)), (face.level, height),
            (face.level_square, height**2), (face.agd, 3 * height / unit), (face.support, np.full(12, 0.5 / unit)),
            (face.log_contour, np.full(12, np.log(4 / unit))), (face.log_contour_square, face.log_contour**2),
            (face.log_thickness_square, face.log_thickness**2), (face.log_clearance_square, face.log_clearance**2),
            (face.thickness_bins.sum(axis=1), np.ones(12)), (found.level, height), (found.agd, 3 * height / unit)):
        np.testing.assert_allclose(got, expected, atol=1e-9)
    assert found.face[:, REGION.angle_defect].sum() == pytest.approx(4 * np.pi)
    ends = mesh.edges.vertices[mesh.edges.pair_edge]
    start, end = (mesh.vertices[ends[:, k]] / scale for k in (0, 1))
    length, middle = np.linalg.norm(end - start, axis=1) / unit, ((start + end) / 2 - 0.5) / unit
    a, b = mesh.edges.pairs.T
    pair = found.pair / length[:, None]
    np.testing.assert_allclose(found.pair[:, BORDER.length], length)
    for name, expected in (
            ("concavity", np.minimum(pair[:, BORDER.curvature], 0)), ("creased", pair[:, BORDER.curvature] < -3),
            ("dihedral", np.zeros(len(a))), ("level", (height[a] + height[b]) / 2),
            ("agd", 3 * (height[a] + height[b]) / 2 / unit),
            ("log_thickness", (face.log_thickness[a] + face.log_thickness[b]) / 2),
            ("log_clearance", (face.log_clearance[a] + face.log_clearance[b]) / 2),
            ("log_contour", np.full(len(a), np.log(4 / unit))), ("center", middle),
            ("second_moment", (middle**2).sum(axis=1))):
        np.testing.assert_allclose(pair[:, getattr(BORDER, name)], expected, atol=1e-9, err_msg=name)
    edge = np.isclose(length * unit, 1)  # of the cube; the others are diagonals of its sides
    assert (pair[edge, BORDER.curvature] > 0).all()


def table_legs(areas, perimeter=3.0):
    """Measures of regions that differ in area only, a little or not; each touches each along a border of half."""
    sums = np.stack([four_faces(area / 4) for area in areas])
    count = len(areas)
    perimeter, lowest, highest = np.full(count, perimeter), np.full(count, 0.1), np.full(count, 0.3)
    return RegionMeasures(
        sums, lowest, highest, np.full(count, 4.0), perimeter, np.full(count, 1.0), np.stack([pairs(0.5)] * count),
        region_shape(sums, perimeter, lowest, highest), np.ones(count, bool))


def column(found, name):
    return found[:, FEATURES.index(name)]


def test_the_siblings_of_a_region_are_others_than_the_two_at_the_cut():
    found = cut_features_(table_legs([0.1] * 5), np.array([(0, 1), (3, 2)]), np.stack([pairs(0.5)] * 2))
    assert column(found, "siblings_small").tolist() == [3, 3]
    assert column(found, "siblings_union").tolist() == [0, 0]  # which is twice as large as any


@pytest.mark.parametrize("rounding", [0.0, 1e-15, -1e-15])
def test_of_two_regions_of_one_area_but_for_rounding_the_first_counts_as_the_smaller(rounding):
    regions = table_legs([0.1, 0.1 * (1 + rounding), 0.4])
    regions.degree[:] = 1.0, 2.0, 3.0
    found = cut_features_(regions, np.array([(0, 1), (1, 0), (2, 0)]), np.stack([pairs(0.5)] * 3))
    assert column(found, "neighbors_small").tolist() == [1, 2, 1]
    assert column(found, "neighbors_large").tolist() == [2, 1, 3]


def test_a_region_whose_borders_rounding_made_shorter_than_its_cut_has_that_alone():
    found = cut_features_(table_legs([0.1, 0.2], 0.5 * (1 - 1e-15)), np.array([(0, 1)]), pairs(0.5)[None])
    assert column(found, "share_small").tolist() == column(found, "share_large").tolist() == [1]
    assert column(found, "union_perimeter_ratio").tolist() == [0]
