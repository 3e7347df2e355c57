# SPDX-License-Identifier: GPL-3.0-or-later
"""Where pieces come near each other, against distances between points by hand."""

import numpy as np
import pytest
import shapes

from core import TriMesh
from core.arrays.components import components
from core.surface import contact
from core.surface.contact import FEW_LABELS, MAX_POINTS, NEAR, SurfacePoints, bridges, diameter, near_pairs


def points_at(position):
    count = len(position)
    return SurfacePoints(np.array(position, float), np.arange(count), np.arange(count), np.ones(count))


def two_boxes(gap):
    """Two unit boxes beside each other along x, a gap apart in units of the diameter of both."""
    def pair(apart):
        return TriMesh(*shapes.together(*(shapes.moved(shapes.subdivide(shapes.subdivide(shapes.box())), (x, 0, 0))
                                          for x in (0, 1 + apart))))

    mesh = pair(gap)
    points = SurfacePoints.of(mesh, mesh.face_components[1])
    return pair(gap * diameter(points.position, points.area))


def test_pieces_of_the_mirror_image_are_linked_where_the_pieces_are():
    """A face with two equal sides has two corners that are equally near its middle."""
    solids = shapes.subdivide(shapes.together(
        shapes.lathe([0, 1, 0.6, 1, 0], [0, 1, 2, 3, 4], 10), shapes.moved(shapes.icosphere(1), (1.4, 0.5, 1)),
        shapes.moved(shapes.torus(9, 6, 0.8, 0.2), (0.3, -0.2, 2.2))))
    one = bridges(TriMesh(*solids))
    other = bridges(TriMesh(solids.vertices * (-1, 1, 1), solids.faces[:, [0, 2, 1]]))
    assert len(one.faces) > 0
    np.testing.assert_array_equal(one.vertices, other.vertices)
    np.testing.assert_array_equal(one.faces, other.faces)


def test_of_points_that_are_equally_near_the_first_is_linked_in_any_pose():
    """Over the middle of a square are four corners; the search found two of them, others in the mirror image."""
    corner = np.stack(np.meshgrid(np.arange(4.0), np.arange(4.0), [0.0]), axis=-1).reshape(-1, 3)
    above = np.stack(np.meshgrid(np.arange(3.0) + 0.5, np.arange(3.0) + 0.5, [0.25]), axis=-1).reshape(-1, 3)
    position, label = np.concatenate([corner, above]), np.repeat([0, 1], [16, 9])
    equal = np.isclose(np.linalg.norm(above[:, None] - corner, axis=2), np.sqrt(0.5 + 0.25**2))
    for pose in ((1, 1, 1), (-1, 1, 1), (1, -1, 1), (-1, -1, 1)):
        for axes in ((0, 1, 2), (1, 0, 2), (2, 1, 0)):
            pairs, _ = near_pairs(points_at((position * pose)[:, axes]), label, 0.8)
            assert pairs[16:].tolist() == [[16 + at, first] for at, first in enumerate(equal.argmax(axis=1))]


def test_boxes_are_linked_where_they_come_near_or_where_all_are_to_hang_together():
    for gap, connected, linked in ((0.029, False, True), (0.031, False, False), (0.1, True, True)):
        mesh = two_boxes(gap)
        found = bridges(mesh, connected)
        assert found.vertices.shape == found.faces.shape
        assert (len(found.faces) > 0) == linked
        piece = mesh.face_components[1]
        assert (piece[found.faces[:, 0]] != piece[found.faces[:, 1]]).all()
        for end in (0, 1):  # each vertex is a corner of its face
            assert (mesh.faces[found.faces[:, end]] == found.vertices[:, end, None]).any(axis=1).all()
        np.testing.assert_allclose(mesh.vertices[found.vertices][..., 0].min(axis=1), 1)  # on the sides that face


def test_two_pieces_are_linked_as_far_as_they_are_hardly_farther_apart_than_where_they_are_nearest():
    flat, slope = shapes.flat_grid(60, 6), 0.01
    rising = shapes.moved(shapes.Shape(flat.vertices + flat.vertices[:, :1] * (0, 0, slope), flat.faces), (0, 0, 0.1))
    mesh = TriMesh(*shapes.together(flat, rising))
    points = SurfacePoints.of(mesh, mesh.face_components[1])
    farthest = 0.005 * diameter(points.position, points.area) / slope
    along = mesh.vertices[bridges(mesh).vertices][..., 0]
    assert along.min() == 0
    assert farthest - 1 < along.max() <= farthest + 1


def size_of(shape):
    """The diameter of a shape."""
    points = SurfacePoints.of(TriMesh(*shape), np.zeros(len(shape.faces), np.int64))
    return diameter(points.position, points.area)


@pytest.mark.parametrize(("share", "linked"), [(0.0095, True), (0.0105, False)])
def test_what_hangs_together_by_others_is_linked_where_it_touches(share, linked):
    """Two towers on a base, so far from each other in diameters of all three."""
    def towers(gap):
        return shapes.together(*(shapes.subdivide(shapes.subdivide(shapes.moved(shapes.box(size), offset)))
                                 for size, offset in (((3, 1, 1), (0, 0, -1)), ((1.5, 1, 3), (-gap / 2, 0, 0)),
                                                      ((1.5, 1, 3), (1.5 + gap / 2, 0, 0)))))

    mesh = TriMesh(*towers(share * size_of(towers(0.04))))
    pairs = np.sort(mesh.face_components[1][bridges(mesh).faces], axis=1)
    expected = [[0, 1], [0, 2], [1, 2]] if linked else [[0, 1], [0, 2]]
    assert np.unique(pairs, axis=0).tolist() == expected


def chests(count, gap, lid=0.02):
    """A row of boxes, each with a lid that floats over it; gaps in units of their size."""
    return shapes.together(*(shapes.moved(shapes.subdivide(shapes.box((1, 1, height))), (k * (1 + gap), 0, z))
                             for k in range(count) for height, z in ((0.7, 0), (0.3, 0.7 + lid))))


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_things_of_a_scene_are_linked_within_and_not_to_each_other(scale):
    """They are nearer to each other than NEAR of the row's length."""
    row = chests(30, 0.4)
    mesh = TriMesh(scale * row.vertices, row.faces)
    points = SurfacePoints.of(mesh, mesh.face_components[1])
    assert NEAR * diameter(points.position, points.area) > 2 * 0.4 * scale
    piece = mesh.face_components[1]
    found = bridges(mesh)
    assert {tuple(pair) for pair in np.sort(piece[found.faces], axis=1).tolist()} == {
        (2 * k, 2 * k + 1) for k in range(30)}
    count, _ = components(60, *piece[bridges(mesh, connected=True).faces].T)
    assert count == 1


@pytest.mark.parametrize(("share", "linked"), [(0.058, True), (0.062, False)])
def test_pieces_of_a_scene_are_one_thing_if_they_are_near_beside_what_they_form(share, linked):
    row = TriMesh(*chests(30, 0.6, share * size_of(chests(1, 0, 0.13))))
    assert (len(bridges(row).faces) > 0) == linked


@pytest.mark.parametrize(("thing", "is_scene"), [(shapes.octahedron(), False), (shapes.box((1.0, 1.0, 1.0)), True)])
def test_things_of_a_scene_have_ten_faces_in_the_mean(thing, is_scene):
    mesh = TriMesh(*shapes.together(*(shapes.moved(thing, (2.6 * k, 0, 0)) for k in range(100))))
    assert (len(bridges(mesh).faces) == 0) == is_scene


@pytest.mark.parametrize(("share", "is_scene"), [(0.31, True), (0.36, False)])
def test_a_scene_has_no_thing_as_long_as_a_third_of_it(share, is_scene):
    row = chests(30, 0.4)
    plank = shapes.subdivide(shapes.subdivide(shapes.box((share * size_of(row), 0.1, 0.1))))
    mesh = TriMesh(*shapes.together(row, shapes.moved(plank, (0, 3, 0))))
    pairs = mesh.face_components[1][bridges(mesh).faces] // 2
    assert (pairs[:, 0] == pairs[:, 1]).all() == is_scene


def test_many_things_of_a_scene_are_not_linked_to_each_other():
    row = TriMesh(*chests(contact.CROWD, 0.4))
    count, _ = components(2 * contact.CROWD, *row.face_components[1][bridges(row).faces].T)
    assert count == contact.CROWD


@pytest.mark.parametrize("shape", [
    chests(4, 0.05), shapes.together(chests(30, 0.4), shapes.moved(shapes.box((41.6, 1, 0.1)), (0, 0, -0.1))),
    shapes.together(*(shapes.moved(shapes.tetrahedron(), (2.6 * k, 0, 0)) for k in range(300)))],
    ids=["few and near", "on a plank", "confetti"])
def test_what_is_no_scene_is_one_body(shape):
    mesh = TriMesh(*shape)
    count, piece = mesh.face_components
    assert components(count, *piece[bridges(mesh).faces].T)[0] == 1


def test_one_piece_needs_no_bridge():
    assert bridges(TriMesh(*shapes.tube_tree(2, step=0.2)), connected=True).vertices.shape == (0, 2)


@pytest.mark.parametrize("make", [shapes.box, lambda: shapes.icosphere(5), shapes.two_spheres])
def test_areas_of_points_sum_to_the_area(make):
    mesh = TriMesh(*make())
    points = SurfacePoints.of(mesh, mesh.face_components[1])
    assert points.area.sum() == pytest.approx(mesh.area)
    assert len(points.face) <= min(MAX_POINTS + 2, mesh.n_vertices + mesh.n_faces)
    assert (mesh.faces[points.face] == points.vertex[:, None]).any(axis=1).all()


def test_diameter_of_a_rod_is_its_length():
    along = np.linspace(0, 5, 1001)[:, None] * (0.6, 0.8, 0)
    assert diameter(along, np.ones(1001)) == pytest.approx(5, rel=2e-3)
    assert diameter(3 * along + 7, np.full(1001, 2.0)) == pytest.approx(15, rel=2e-3)


@pytest.mark.parametrize("few", [0, 10])
def test_near_pairs_by_hand(few, monkeypatch):
    monkeypatch.setattr(contact, "FEW_LABELS", few)  # compared all at once, and label by label
    points = points_at([(0, 0, 0), (1, 0, 0), (2.5, 0, 0), (1, 3, 0), (9, 9, 9)])
    pairs, distance = near_pairs(points, np.array([0, 0, 1, 2, 3]), 3.0)
    found = dict(zip(map(tuple, pairs.tolist()), distance.tolist(), strict=True))
    assert found == {(0, 2): 2.5, (1, 2): 1.5, (1, 3): 3.0, (2, 1): 1.5, (3, 1): 3.0}


def test_both_ways_of_finding_near_pairs_agree(monkeypatch):
    rng = np.random.default_rng(0)
    points, label = points_at(rng.random((900, 3))), rng.integers(0, FEW_LABELS + 6, 900)
    one = near_pairs(points, label, 0.3)
    monkeypatch.setattr(contact, "MAX_PAIRS", 0)
    monkeypatch.setattr(contact, "MORE_PAIRS", 0)
    two = near_pairs(points, label, 0.3)
    np.testing.assert_array_equal(one[0], two[0])
    np.testing.assert_array_equal(one[1], two[1])


def test_of_a_crowd_that_hangs_together_what_touches_is_linked_as_before(monkeypatch):
    """A chain of small triangles; with one far off, which no touch joins, and without."""
    rng = np.random.default_rng(0)
    corners = np.linspace((0, 0, 0), (1, 0, 0), 400)[:, None] + 0.003 * rng.normal(size=(400, 3, 3))
    searched, search = [], contact.near_pairs

    def counted(points, label, radius):
        searched.append(radius)
        return search(points, label, radius)

    monkeypatch.setattr(contact, "near_pairs", counted)
    for far in (0.0, 2.0):
        corners[-1] += (far, 0, 0)
        mesh = TriMesh(corners.reshape(-1, 3), np.arange(1200).reshape(-1, 3))
        expected = bridges(mesh, connected=True)
        with monkeypatch.context() as patch:
            patch.setattr(contact, "CROWD", 100)
            searched.clear()
            found = bridges(mesh, connected=True)
        assert (len(searched) == 1) == (far == 0)
        np.testing.assert_array_equal(found.vertices, expected.vertices)
        np.testing.assert_array_equal(found.faces, expected.faces)


def test_of_very_many_links_those_farther_off_join_only_what_does_not_hang_together(monkeypatch):
    """A cloud of small triangles that hardly touch, and one far off."""
    rng = np.random.default_rng(0)
    corners = rng.random((60, 1, 3)) + 0.05 * rng.normal(size=(60, 3, 3))
    corners[-1] += (2.0, 0, 0)
    mesh = TriMesh(corners.reshape(-1, 3), np.arange(180).reshape(-1, 3))
    every = bridges(mesh, connected=True)
    monkeypatch.setattr(contact, "MANY_LINKS", 0)
    some = bridges(mesh, connected=True)
    assert components(60, *every.faces.T)[0] == components(60, *some.faces.T)[0] == 1
    assert len(some.faces) < 0.3 * len(every.faces)
    assert (some.faces[:, 0] != some.faces[:, 1]).all()
    monkeypatch.setattr(contact, "LONGEST", 0.0)  # as if it were no scene
    near = bridges(mesh).faces  # what is found first stays
    assert some.faces[: len(near)].tolist() == near.tolist()
