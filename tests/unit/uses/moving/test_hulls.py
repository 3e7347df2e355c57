# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex hulls of parts: closed, convex, around their parts, and not too fine."""

import numpy as np
import pytest
import shapes
from scipy.spatial import ConvexHull

from core.mesh.corners import CornerTable
from core.uses.moving.hulls import part_hulls, part_volumes


def several(shape, labels=None, **more):
    vertices, faces = shape
    return part_hulls(CornerTable.of(vertices, faces), np.zeros(len(faces), int) if labels is None else labels, **more)


def hulls(shape, labels=None, **more):
    return [hull for (hull,) in several(shape, labels, **more)]


def check(hull):
    """Closed, looking outward, and convex."""
    sides = np.concatenate([hull.triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    assert {tuple(side) for side in sides.tolist()} == {tuple(side) for side in sides[:, ::-1].tolist()}
    assert len(np.unique(sides, axis=0)) == len(sides)
    a, b, c = hull.vertices[hull.triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    double_area = np.linalg.norm(normal, axis=1)
    normal /= double_area[:, None]
    size = np.linalg.norm(np.ptp(hull.vertices, axis=0))
    outside = (hull.vertices @ normal.T - (a * normal).sum(axis=1)).max(axis=0)
    # Far from the origin coordinates are rounded, and the narrower a triangle is, the more its normal is off by that.
    height = double_area / np.linalg.norm([b - a, c - b, a - c], axis=2).max(axis=0)
    rounding = np.spacing(np.abs(hull.vertices).max())
    assert (outside < 1e-9 * size + 4 * rounding * size / height).all()


@pytest.mark.parametrize("size", [1e-5, 1.0, 1e5])
def test_a_box_is_its_own_hull(size):
    vertices, faces = shapes.box_quads()
    (hull,) = hulls((size * vertices, faces))
    check(hull)
    assert {tuple(v) for v in hull.vertices.tolist()} == {tuple(v) for v in (size * vertices).tolist()}
    assert hull.volume == pytest.approx(np.prod(np.ptp(size * vertices, axis=0)))


def test_each_part_has_one_around_it():
    vertices, faces = shapes.two_spheres()
    labels = (vertices[faces].mean(axis=1)[:, 0] > vertices[:, 0].mean()).astype(int)
    found = hulls((vertices, faces), labels)
    assert len(found) == 2
    for label, hull in enumerate(found):
        check(hull)
        assert {tuple(v) for v in hull.vertices.tolist()} <= {tuple(v) for v in vertices[faces[labels == label]]
                                                              .reshape(-1, 3).tolist()}


def test_a_fine_ball_gets_few_corners_and_keeps_its_size():
    vertices, faces = shapes.icosphere(4)
    (hull,) = hulls((vertices, faces))
    check(hull)
    assert len(hull.vertices) <= 64
    assert hull.volume > 0.85 * ConvexHull(vertices).volume


@pytest.mark.parametrize("stretched", [(1, 1, 8), (1, 0.1, 8), (1e-3, 1e-3, 1)])
def test_what_is_long_has_as_many_corners_as_it_may(stretched):
    """Of directions that are spread evenly around it, many have the same corner."""
    vertices, faces = shapes.icosphere(3)
    (hull,) = hulls((vertices * stretched, faces))
    check(hull)
    assert len(hull.vertices) == 64
    assert hull.volume > 0.9 * ConvexHull(vertices * stretched).volume


@pytest.mark.parametrize("points", [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
                                    [[1, 2, 3], [1, 2, 3], [1, 2, 3]]])
def test_what_is_flat_gets_a_thin_one(points):
    (hull,) = hulls((np.array(points, float), np.array([[0, 1, 2]])))
    check(hull)
    assert 0 < hull.volume < 0.1


def thin_boxes(sizes, place=100.0):
    """Boxes of such sizes in one model, each part of it, turned so that none is along the axes."""
    vertices, faces = shapes.box_quads()
    vertices = (vertices - vertices.min(axis=0)) / np.ptp(vertices, axis=0)
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    every = np.concatenate([(vertices * size + (0, 0, place * k)) @ turn.T for k, size in enumerate(sizes)])
    count = len(sizes)
    return (every, np.concatenate([faces + k * len(vertices) for k in range(count)])), np.repeat(np.arange(count), 6)


def test_what_is_thin_keeps_its_thickness():
    """A pane beside a rod, in a model 100 times as large: hulls were as thick as a share of the whole model."""
    sizes = [(2, 1, 0.005), (0.006, 0.006, 1.5), (1, 1, 1)]
    for hull, size in zip(hulls(*thin_boxes(sizes)), sizes, strict=True):
        check(hull)
        assert hull.volume == pytest.approx(np.prod(size))


@pytest.mark.parametrize("place", [0.0, 1.0, 1000.0])
def test_what_is_flat_is_as_thick_as_a_share_of_itself(place):
    """However large the model around it is: a sheet of 2 x 1, and one that is flat but for its rounding."""
    sizes = [(2, 1, 0), (2, 1, 1e-6), (1, 1, 1)]
    for hull in hulls(*thin_boxes(sizes, place))[:2]:
        check(hull)
        assert hull.volume == pytest.approx(0.01 * 2 * (2 * 1), rel=1e-3)


def angle(size=1.0):
    """Two bars, 4 x 1 x 1 and 1 x 3 x 1, that make an L: a volume of 7 in a hull of 11.5."""
    outline = np.array([[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]], float)
    vertices = size * np.concatenate([np.c_[outline, np.zeros(6)], np.c_[outline, np.ones(6)]])
    sides = [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    caps = [[3, 2, 1, 0], [5, 4, 3, 0], [6, 7, 8, 9], [6, 9, 10, 11]]
    return vertices, np.array(sides + caps)


@pytest.mark.parametrize("size", [1e-5, 1.0, 1e5])
def test_two_hulls_fit_an_angle_and_more_are_not_made(size):
    (one,), = several(angle(size))
    assert one.volume == pytest.approx(11.5 * size**3)
    (two,) = several(angle(size), per_part=2)
    for hull in two:
        check(hull)
    assert len(two) == 2
    assert sum(hull.volume for hull in two) < 9 * size**3
    (many,) = several(angle(size), per_part=8)
    assert sum(hull.volume for hull in many) == pytest.approx(7 * size**3, rel=0.1)
    vertices, faces = shapes.icosphere(3)
    (ball,) = several((size * vertices, faces), per_part=8)
    assert len(ball) == 1


@pytest.mark.parametrize("count", [4, 8])
def test_every_point_of_a_part_lies_in_one_of_its_hulls(count):
    vertices, faces = shapes.torus(12, 8)  # of so few points that no hull has too many corners
    (found,) = several((vertices, faces), per_part=count)
    assert 1 < len(found) <= count
    samples = np.concatenate([vertices, vertices[faces].mean(axis=1)])
    inside = np.zeros(len(samples), bool)
    for hull in found:
        a, b, c = hull.vertices[hull.triangles].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        inside |= ((samples @ normal.T - (a * normal).sum(axis=1)) < 1e-9).all(axis=1)
    assert inside.all()
    fewer = several((vertices, faces), per_part=count // 2)[0]
    assert sum(hull.volume for hull in found) < sum(hull.volume for hull in fewer)


def bowl():
    angle = np.linspace(0.0, 0.5 * np.pi, 12)
    radius = np.append(np.sin(angle), 0.9 * np.sin(angle[::-1]))
    return shapes.lathe(radius, np.append(-np.cos(angle), -0.9 * np.cos(angle[::-1])))


def test_a_bowl_is_divided_crosswise():
    """Half a bowl has half the hull: with two hulls nothing is gained, with four much is."""
    whole = [sum(hull.volume for hull in several(bowl(), per_part=count)[0]) for count in (1, 2, 4)]
    assert whole[1] > 0.9 * whole[0]
    assert whole[2] < 0.8 * whole[0]


@pytest.mark.parametrize("count", [2, 3, 5, 6, 8])
def test_two_bowls_have_no_more_hulls_than_they_may(count):
    """Apart they are best divided in four each, for which there is room once only with six hulls."""
    both = shapes.together(bowl(), shapes.moved(bowl(), (3.0, 0.0, 0.0)))
    assert len(several(both, per_part=count)[0]) <= count


def test_volumes_of_parts_with_their_holes_closed():
    vertices, faces = shapes.box_quads()
    table = CornerTable.of(vertices, faces)
    size = np.prod(np.ptp(vertices, axis=0))
    assert part_volumes(table, np.zeros(6, int)) == pytest.approx([size])
    # A fan closes the hole of five sides; one side encloses nothing, however it is closed.
    assert part_volumes(table, (np.arange(6) == 0).astype(int)) == pytest.approx([size, 0], abs=1e-9 * size)
    inside_out = CornerTable.of(vertices, faces[:, ::-1])
    assert part_volumes(inside_out, np.zeros(6, int)) == pytest.approx([-size])
