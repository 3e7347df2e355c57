# SPDX-License-Identifier: GPL-3.0-or-later
"""What is one surface with the ground on which it stands has parts as if it stood alone."""

import numpy as np
import pytest
import shapes
from floors import column

from core import Parameters, decompose
from core.mesh.grounds import find_standing
from core.mesh.polygons import PolygonMesh
from core.mesh.terrain import outline_area

RNG = np.random.default_rng(5)
PATCH = shapes.figure_on_ground(7.0)
GROUNDS = {"patch": PATCH, "narrow patch": shapes.figure_on_ground(4.5), "hills": shapes.figure_on_ground(9.0, 0.4),
           "slab": shapes.figure_on_ground(7.0, deep=0.15),
           "thick slab": shapes.figure_on_ground(7.0, deep=0.9)}


def standing(vertices, faces):
    """Which faces stand on grounds."""
    found = find_standing(PolygonMesh.of(vertices, faces))
    stands = np.full(len(faces), found is None)
    if found:
        stands[found.polygon] = True
    return stands


def noisy(shape, size):
    return shape.vertices + size * RNG.normal(size=shape.vertices.shape)


@pytest.mark.parametrize("name", GROUNDS)
def test_what_stands_on_terrain_has_its_limbs(name):
    """With a patch of ground that is three times as wide, a figure was one part."""
    shape = GROUNDS[name]
    found = decompose(*shape)
    parts = found.parts()
    assert parts.ground.sum() == 1
    ground = parts.labels == parts.ground.argmax()
    np.testing.assert_array_equal(ground, ~standing(*shape))
    x, _, z = shape.vertices[shape.faces].mean(axis=1).T
    assert not ground[z > -1.0].any()
    assert ground[(np.abs(x) > 1.0) & (z < -0.6)].all()
    middle = shape.vertices[shape.faces].mean(axis=1)
    tips = [(1.5, 0.1, 1.0), (-1.5, 0.1, 1.0), (0.5, 0, -1.0), (-0.5, 0, -1.0), (0, 0, 0.6), (2, 2, -1.5)]
    of_tip = [parts.labels[np.linalg.norm(middle - tip, axis=1).argmin()] for tip in tips]
    assert len(set(of_tip)) == len(tips)
    left = find_standing(PolygonMesh.of(*shape)).without_grounds(PolygonMesh.of(*shape)).triangles
    np.testing.assert_array_equal(found.candidates[~ground], decompose(left.vertices, left.faces).candidates)


@pytest.mark.parametrize("name", GROUNDS)
def test_it_is_found_however_the_mesh_is_given(name):
    shape, stands = GROUNDS[name], standing(*GROUNDS[name])
    assert 0 < stands.sum() < len(stands)
    turn = shapes.rotation(RNG)
    np.testing.assert_array_equal(standing(1e-30 * shape.vertices @ turn.T, shape.faces), stands)
    other, _, faces = shapes.shuffled(shape, RNG)
    np.testing.assert_array_equal(standing(*other), stands[faces])
    np.testing.assert_array_equal(standing(*shapes.inside_out(shape)), stands)
    np.testing.assert_array_equal(standing(*shapes.unjoined(shape)), stands)
    for size in (0.01, 0.03):  # a quarter of an edge
        assert (standing(noisy(shape, size), shape.faces) != stands).mean() < 0.02


def mesa(*profile, n=64):
    """What the profile, (radius, height) from the middle outwards, is when it is turned around the third axis.

    Returns the shape, and the segment of the profile that each face is of.
    """
    radius, height = np.transpose([(0, profile[0][1]), *profile])
    vertices, faces = shapes.lathe([*radius, 0], [*height, height[-1]], n)
    ring = np.append(np.repeat(np.arange(1, len(radius)), n), 0)  # of each vertex
    faces = faces[:-n]  # open below
    return shapes.Shape(vertices[:-1], faces), ring[faces].max(axis=1) - 1


def rising_segments(*profile):
    """The segments of the profile that stand on the others; all of them if there is no terrain."""
    shape, segment = mesa(*profile)
    stands = standing(*shape)
    for one in set(segment):
        assert len(set(stands[segment == one])) == 1
    return sorted(set(segment[stands].tolist()))


@pytest.mark.parametrize(("degrees", "found"), [(58, [0, 1, 2]), (62, [0, 1])])
def test_what_rises_by_less_than_60_degrees_is_terrain(degrees, found):
    foot = 1 + 1 / np.tan(np.radians(degrees))
    assert rising_segments((1, 1), (foot, 0), (4, 0)) == found


@pytest.mark.parametrize(("ratio", "found"), [(1.45, [0, 1, 2, 3]), (1.55, [0, 1, 2])])
def test_terrain_is_half_as_large_again_as_what_stands_there(ratio, found):
    """A mushroom."""
    assert rising_segments((1, 1), (0.3, 0.9), (0.29, 0), (np.sqrt(ratio), 0)) == found


@pytest.mark.parametrize(("high", "low", "found"), [
    (2, 0.38, False), (2, 0.42, True), (0.6, 0.14, False), (0.6, 0.16, True)])
def test_what_is_no_higher_than_a_hill_is_terrain_but_beside_low_things(high, low, found):
    """A hill is 0.05 of the root of the outline, here 0.4, or a quarter of the highest thing."""
    vertices, faces = plain_with((high, low), (3, 5))
    stands = standing(vertices, faces)
    high_one, low_one = ((vertices[faces][..., 2] == height).all(axis=1) for height in (high, low))
    assert stands[high_one].all()
    assert not stands.all()
    assert stands[low_one].all() == stands[low_one].any() == found


def plain_with(height, x):
    """A plain of 8 by 8 in which squares of 1 are raised to a height each, their middles at (x, 4)."""
    vertices, faces = shapes.flat_grid(160, 160, 0.05)
    for z, at_x in zip(height, x, strict=True):
        vertices[np.abs(vertices - (at_x, 4, 0)).max(axis=1) < 0.5, 2] = z
    return vertices, faces


@pytest.mark.parametrize("lift", [0, 50, -50])
def test_what_is_low_stands_on_low_ground(lift):
    """Lower than a hill, of 0.4; with hills beside it of a fifth of its height, whose outline is wide."""
    vertices, faces = plain_with((0.3,), (4,))
    away = np.abs(vertices[:, :2] - 4).max(axis=1)
    vertices[(away > 2.9) & (away < 3.6), 2] = 0.06
    vertices[:, 2] += lift
    stands = standing(vertices, faces)
    assert not stands.all()
    assert (vertices[faces[stands]][..., 2].max(axis=1) == lift + 0.3).all()


@pytest.mark.parametrize(("pit", "found"), [(0.5, [0, 1, 2, 3]), (2, [0, 1, 2, 3, 4])])
def test_what_is_in_a_pit_is_terrain_if_the_middle_is_lower_than_the_rim(pit, found):
    """A pole of an area of 1 above the rim of a pit of 0.8 or 13."""
    assert rising_segments((0.1, 1.5), (0.11, -0.3), (pit, -0.3), (pit + 0.01, 0), (4, 0)) == found


@pytest.mark.parametrize("slope", [18, -18])
def test_rough_ground_without_a_level_face_is_terrain(slope):
    """Furrows, whose sides are turned from what is up by as much as faces may be that tell it."""
    vertices, faces = plain_with((2,), (4,))
    vertices[:, 2] += 0.05 * np.tan(np.radians(slope)) * (np.rint(vertices[:, 0] / 0.05) % 2)
    stands = standing(vertices, faces)
    np.testing.assert_array_equal(stands, vertices[faces][..., 2].max(axis=1) > 1)


def test_the_largest_region_is_terrain_however_many_faces_it_has():
    rings = np.linspace(0.1, 1, 10)
    assert rising_segments(*((radius, 1) for radius in rings), (1.01, 0), (4, 0)) == list(range(11))


@pytest.mark.parametrize(("share", "found"), [(0.45, False), (0.55, True)])
def test_terrain_covers_half_of_the_outline_at_one_height(share, found):
    """A tower with a step on terrain that has a deep rim: all of it faces up, but not all within a hill."""
    profile, outer = [], 4 * np.sqrt([(0.92 - share) / 2, 0.92 - share, 0.92, 1])
    for radius, height in zip(outer, (3, 2, 0, -0.5), strict=True):
        profile += [(profile[-1][0] + 0.001, height), (radius, height)] if profile else [(radius, height)]
    assert standing(*mesa(*profile)[0]).all() != found


@pytest.mark.parametrize(("kept", "found"), [(0.45, False), (0.55, True)])
def test_terrain_covers_half_of_the_outline(kept, found):
    """Spokes around a mesa that is but for them alone."""
    (vertices, faces), segment = mesa((0.5, 1), (0.51, 0), (0.6, 0), (4, 0), n=400)
    angle = np.arctan2(*vertices[faces][..., :2].mean(axis=1).T)
    spokes = (segment < 3) | (angle % (np.pi / 5) < kept * np.pi / 5)
    assert standing(vertices, faces[spokes]).all() != found


@pytest.mark.parametrize(("depth", "found"), [(0.6, True), (0.7, False)])
def test_solid_terrain_is_thin(depth, found):
    """A skirt of which the lower half is lower than a hill: 0.097 and 0.11 of the area."""
    shape, _ = mesa((1, 2), (1.01, 0), (4, 0), (4.001, -depth / 2), (4.002, -depth))
    assert standing(*shape).all() != found


def test_noise_of_half_an_edge_is_averaged():
    slab = GROUNDS["slab"]
    vertices = slab.vertices + 0.06 * np.random.default_rng(1).normal(size=slab.vertices.shape)
    assert (standing(vertices, slab.faces) != standing(*slab)).mean() < 0.01


def slab_with_legs(size, bar):
    """A slab of cubes on which two legs stand, one above the other, or a bar between them."""
    solid = np.zeros((*size[:2], 12), bool)
    solid[:, :, :size[2]] = True
    solid[np.ix_([9, 10, 19, 20], [6, 7])] = True
    if bar:
        solid[9:21, 6:8, 8:10] = True
    return shapes.blocks(solid)


@pytest.mark.parametrize(("bar", "found"), [(False, False), (True, True)])
@pytest.mark.parametrize("size", [(30, 30, 3), (44, 44, 2)], ids=["thick", "no sheet"])
def test_what_stands_on_several_feet_may_stand_on_a_thick_slab(size, bar, found):
    """A table on its head does so only with a bar between its legs."""
    assert standing(*slab_with_legs(size, bar)).all() != found


@pytest.mark.parametrize(("size", "found"), [((30, 30, 4), True), ((30, 30, 5), False),
                                             ((60, 15, 2), True), ((60, 15, 4), False)])
def test_a_slab_below_feet_is_a_quarter_as_deep_as_wide(size, found):
    """By the spread of its points; and of less than 0.15 of the root of its outline."""
    assert standing(*slab_with_legs(size, True)).all() != found


@pytest.mark.parametrize(("side", "found"), [(4, True), (5, False)])
def test_a_foot_has_three_tenths_of_the_longest_seam(side, found):
    """An arch whose one leg is 1 wide and has a seam of 4, or 5.7 by averaged normals, beside one of 16 or 20."""
    solid = np.zeros((30, 30, 12), bool)
    solid[:, :, :3] = True
    solid[9:9 + side, 9:9 + side] = True
    solid[19, 9] = True
    solid[9:20, 9, 8:10] = True
    assert standing(*shapes.blocks(solid)).all() != found


@pytest.mark.parametrize(("height", "found"), [(0.01, True), (0.001, False)])
def test_what_stands_on_terrain_has_a_millionth_of_its_area(height, found):
    """A peg on 50, of 2 pi times the square of its height, and a half more."""
    assert standing(*mesa((height, height), (1.01 * height, 0), (4, 0))[0]).all() != found


@pytest.mark.parametrize(("share", "found"), [(0.21, True), (0.19, False)])
def test_terrain_is_a_fifth_of_the_area(share, found):
    """Around a mesa, with six columns above it, each of them smaller than its piece."""
    ground = mesa((1, 1), (1.01, 0), (4, 0))[0]
    area = np.pi * (4**2 - 1)
    each = (area / share - area - 3 * np.pi) / 6
    columns = [shapes.moved(column((each - 2) / 4, 0), (x, y, 3)) for x in (-1.6, -0.5, 0.6) for y in (-1.1, 0.1)]
    assert standing(*shapes.together(ground, *columns)).all() != found


@pytest.mark.parametrize("away", [0, 1e7])
def test_the_area_of_an_outline_is_that_of_a_polygon_of_32_sides(away):
    angle = np.pi * np.arange(96) / 48
    disc = np.column_stack([np.cos(angle), np.sin(angle), np.arange(96)]) + (away, away, 0)
    assert outline_area(disc, np.array([0.0, 0.0, 1.0])) == pytest.approx(16 * np.sin(np.pi / 16), rel=1e-6)


def test_other_pieces_stand_there_too():
    bird = shapes.moved(shapes.icosphere(2, 0.3), (1.0, 1.0, 2.0))
    stands = standing(*shapes.together(bird, PATCH))
    n = len(bird.faces)
    assert stands[:n].all()
    np.testing.assert_array_equal(stands[n:], standing(*PATCH))
    below = shapes.moved(bird, (0, 0, -5.0))
    assert standing(*shapes.together(below, below, PATCH)).all()


def test_methods_of_papers_get_the_surface_whole():
    found = decompose(*GROUNDS["narrow patch"], Parameters.preset("Berretti 2009"))
    assert not any("such as a floor" in str(note) for note in found.notes)
    assert (found.field > 0).mean() > 0.99  # 0 at one vertex, and on what is left out


def test_what_is_no_terrain():
    figure = shapes.mirrored_figure()
    assert standing(*figure).all()
    assert standing(*shapes.figure_on_ground(2.5)).all()  # narrower than its arms
    assert standing(*shapes.figure_on_ground(7.0, deep=1.2)).all()  # a block
    assert standing(*shapes.table_of_blocks()).all()
    vertices, faces = shapes.flat_grid(30, 30, 0.2)
    away = vertices[:, :2] - vertices[:, :2].mean(axis=0)
    hill = vertices + np.outer(0.8 * np.exp(-(away**2).sum(axis=1)), (0, 0, 1))
    assert standing(hill, faces).all()
    assert standing(*shapes.flat_grid(20, 20)).all()
